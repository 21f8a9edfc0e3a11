// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/ply_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/hosts/cli/documents/binary.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

/// The names of PlyTable's encodings.
constexpr std::array<std::string_view, 3> kEncodings = {"ascii", "binary_little_endian",
                                                        "binary_big_endian"};

struct Type {
    const char *name, *other_name;
    std::size_t size;
    double (*read)(const char* bytes);
};

template <class Number>
constexpr Type type_of(const char* name, const char* other_name) {
    return {name, other_name, sizeof(Number),
            [](const char* bytes) { return static_cast<double>(number_from<Number>(bytes)); }};
}

/// The types by PlyType.
constexpr std::array<Type, 11> kTypes = {type_of<double>("", ""),
                                         type_of<std::int8_t>("char", "int8"),
                                         type_of<std::uint8_t>("uchar", "uint8"),
                                         type_of<std::int16_t>("short", "int16"),
                                         type_of<std::uint16_t>("ushort", "uint16"),
                                         type_of<std::int32_t>("int", "int32"),
                                         type_of<std::uint32_t>("uint", "uint32"),
                                         type_of<std::int64_t>("int64", "int64"),
                                         type_of<std::uint64_t>("uint64", "uint64"),
                                         type_of<float>("float", "float32"),
                                         type_of<double>("double", "float64")};

const Type& row_of(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)];
}

PlyType type_named(std::string_view word) {
    const std::string name = lower_case(word);
    for (std::size_t type = 1; type < kTypes.size(); ++type) {
        if (name == kTypes[type].name || name == kTypes[type].other_name) return PlyType(type);
    }
    throw UnreadableFile("its header has the unknown type '" + name.substr(0, 40) + "'");
}

PlyProperty parse_property(const Words& words) {
    const bool is_list = words.size() == 5 && lower_case(words[1]) == "list";
    if (!is_list && words.size() != 3) {
        throw UnreadableFile("its header has a property that is not 'property TYPE NAME'");
    }
    const std::string_view type = words[words.size() - 2];
    const std::string_view type_words(words[1].data(), type.data() + type.size() - words[1].data());
    return {std::string(words.back()), type_named(type),
            is_list ? type_named(words[2]) : PlyType::None, type_words, 0};
}

template <class Range>
auto find_by_name(const Range& range, std::string_view name) {
    auto found = std::find_if(range.begin(), range.end(),
                              [name](const auto& item) { return item.name == name; });
    if (found == range.end()) {
        found = std::find_if(range.begin(), range.end(),
                             [name](const auto& item) { return lower_case(item.name) == name; });
    }
    return found == range.end() ? nullptr : &*found;
}

PlyElement parse_element(const Words& words, const std::vector<PlyElement>& elements) {
    if (words.size() != 3) throw UnreadableFile("an element of its header is not 'element NAME N'");
    const std::string name(words[1]);
    const std::int64_t count = parse_integer(words[2]);
    if (count < 0 || count > std::numeric_limits<std::int32_t>::max()) {
        throw UnreadableFile("the number of " + name + " elements is out of range");
    }
    if (find_by_name(elements, name)) throw UnreadableFile("it has two elements " + name);
    return {name, static_cast<std::size_t>(count), {}, {}};
}

}  // namespace

const char* name_of(PlyType type) {
    return row_of(type).name;
}

const PlyProperty* PlyElement::find(std::string_view property_name) const {
    return find_by_name(properties, property_name);
}

PlyTable::PlyTable(std::string content) : content_(std::move(content)) {
    parse_header();
    if (!is_text()) return;
    std::size_t row_count = 0;
    for (const PlyElement& element : elements_) {
        if (!element.properties.empty()) row_count += element.count;
    }
    rows_are_lines_ = body().text.count_lines() == row_count;
}

/// Lines that begin with another keyword, or have none, say nothing.
void PlyTable::parse_header() {
    TextReader reader(content_);
    if (!reader.find_line() || lower_case(reader.words()[0]) != "ply") {
        throw UnreadableFile("it is not a PLY file: it does not begin with 'ply'");
    }
    std::string format;
    for (std::string keyword; keyword != "end_header";) {
        if (!reader.find_line()) throw UnreadableFile("it ends within its header");
        const Words& words = reader.words();
        keyword = lower_case(words[0]);
        if (keyword == "format" && words.size() > 1) {
            format = lower_case(words[1]);
        } else if (keyword == "element") {
            elements_.push_back(parse_element(words, elements_));
            elements_.back().line_end = reader.line_end();
        } else if (keyword == "property" && !elements_.empty()) {
            PlyElement& element = elements_.back();
            element.properties.push_back(parse_property(words));
            element.properties.back().index = property_count_++;
            element.line_end = reader.line_end();
        }
    }
    const auto found = std::find(kEncodings.begin(), kEncodings.end(), format);
    if (found == kEncodings.end()) throw UnreadableFile("its header has no format that PLY knows");
    encoding_ = Encoding(found - kEncodings.begin());
    body_ = content_.size() - reader.rest().size();
    header_lines_ = reader.line_number();
}

PlyTable::Body PlyTable::body() const {
    const std::string_view bytes = std::string_view(content_).substr(body_);
    return {TextReader(bytes, TextReader::Syntax::Plain, header_lines_), bytes};
}

void PlyTable::read_word(Body& body, PlyType type, Words& words) const {
    if (rows_are_lines_ && body.text.words_left() == 0) {
        body.text.fail("it has fewer numbers than the header announces");
    }
    const std::string_view word =
        is_text() ? body.text.word() : take_bytes(body.bytes, 1, row_of(type).size);
    words.emplace_back(word.data(), word.size());  // faster than a copy of the view
}

void PlyTable::read_field(Body& body, const PlyProperty& property, Words& words) const {
    words.clear();
    if (!property.is_list()) return read_word(body, property.type, words);
    read_word(body, property.count_type, words);
    const double length = number(words[0], property.count_type);
    const auto count = static_cast<std::size_t>(length >= 0 && length < 1e18 ? length : 0);
    if (static_cast<double>(count) != length) {
        throw UnreadableFile("the length of a list " + property.name + " is " +
                             format_number(length));
    }
    for (std::size_t i = 0; i < count; ++i) read_word(body, property.type, words);
}

double PlyTable::number(std::string_view word, PlyType type) const {
    if (is_text()) {
        const double number = parse_number(word);
        return type == PlyType::Float ? static_cast<float>(number) : number;
    }
    const bool is_reversed = encoding_ == Encoding::BigEndian;
    return row_of(type).read(is_reversed ? reversed(word).data() : word.data());
}

std::string PlyTable::word(double number, PlyType type) const {
    const auto rounded = static_cast<float>(number);
    const bool is_float = type == PlyType::Float;
    if (is_text()) return is_float ? format_number(rounded) : format_number(number);
    const std::string_view bytes = is_float ? as_bytes(rounded) : as_bytes(number);
    return encoding_ == Encoding::BigEndian ? reversed(bytes) : std::string(bytes);
}

const PlyElement* PlyTable::find(std::string_view element_name) const {
    return find_by_name(elements_, element_name);
}

}  // namespace tracked_mcf
