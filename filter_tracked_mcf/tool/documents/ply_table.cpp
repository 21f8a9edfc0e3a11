// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/documents/ply_table.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "filter_tracked_mcf/tool/documents/binary.h"
#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// A zero of any type that PLY has.
using Zero = std::variant<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                          std::uint32_t, float, double>;

/// A PlyType: its two names and its C++ type.
struct Type {
    const char *name, *other_name;
    Zero zero;
};

constexpr std::array<Type, 9> kTypes = {{{"", "", double{}},
                                         {"char", "int8", std::int8_t{}},
                                         {"uchar", "uint8", std::uint8_t{}},
                                         {"short", "int16", std::int16_t{}},
                                         {"ushort", "uint16", std::uint16_t{}},
                                         {"int", "int32", std::int32_t{}},
                                         {"uint", "uint32", std::uint32_t{}},
                                         {"float", "float32", float{}},
                                         {"double", "float64", double{}}}};

/// Calls visit with a zero of the C++ type of `type`, and returns what it returns.
template <class Visit>
auto with_type(PlyType type, Visit visit) {
    return std::visit(visit, kTypes[static_cast<std::size_t>(type)].zero);
}

/// Appends the number that `text` is, which must fit its type.
void append_text(std::string_view text, PlyType type, std::string& bytes) {
    with_type(type, [&](auto number) {
        using Number = decltype(number);
        if constexpr (std::is_integral_v<Number>) {
            const std::int64_t wide = parse_integer(text);
            number = static_cast<Number>(wide);
            if (number != wide) {
                throw UnreadableFile(std::string(text) + " is too large for its property's type");
            }
        } else {
            number = static_cast<Number>(parse_number(text));
        }
        bytes += as_bytes(number);
    });
}

/// The part of the file that has not been read yet.
class Content {
public:
    explicit Content(std::string_view text) : rest_(text) {}

    std::string_view line() {
        const std::size_t end = rest_.find('\n');
        if (end == std::string_view::npos) throw UnreadableFile("it ends within its header");
        const std::string_view result = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        return result;
    }

    std::string_view word() {
        constexpr std::string_view blanks = " \t\r\n\f\v";
        rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
        return bytes(1, std::min(rest_.find_first_of(blanks), rest_.size()));
    }

    /// Returns `count` times `size` bytes.
    std::string_view bytes(std::size_t count, std::size_t size) {
        if (rest_.empty() || size > rest_.size() / count) {
            throw UnreadableFile("it ends before all that its header announces; it is truncated");
        }
        const std::string_view result = rest_.substr(0, count * size);
        rest_.remove_prefix(result.size());
        return result;
    }

private:
    std::string_view rest_;
};

enum class Encoding { Ascii, LittleEndian, BigEndian };

/// Appends the next `count` numbers of the file to `bytes`.
void read_numbers(Content& content, Encoding encoding, PlyType type, std::size_t count,
                  std::string& bytes) {
    const std::size_t size = size_of(type);
    if (encoding == Encoding::LittleEndian) {
        bytes.append(content.bytes(count, size));
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (encoding == Encoding::Ascii) {
            append_text(content.word(), type, bytes);
        } else {
            bytes.append(content.bytes(1, size));
            std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(size), bytes.end());
        }
    }
}

void read_list(Content& content, Encoding encoding, const PlyProperty& list, std::string& bytes) {
    const std::size_t begin = bytes.size();
    read_numbers(content, encoding, list.count_type, 1, bytes);
    if (number_at(bytes.data() + begin, list.count_type) < 0) {
        throw UnreadableFile("a list " + list.name + " has a negative length");
    }
    const std::size_t length = list_length(list, bytes.data() + begin);
    if (length > 0) read_numbers(content, encoding, list.type, length, bytes);
}

void read_rows(Content& content, Encoding encoding, PlyElement& element) {
    if (element.properties.empty() || element.count == 0) return;
    if (const std::size_t size = element.row_size();
        size > 0 && encoding == Encoding::LittleEndian) {
        element.rows = content.bytes(element.count, size);
        return;
    }
    for (std::size_t row = 0; row < element.count; ++row) {
        for (const PlyProperty& property : element.properties) {
            if (property.is_list()) {
                read_list(content, encoding, property, element.rows);
            } else {
                read_numbers(content, encoding, property.type, 1, element.rows);
            }
        }
    }
}

PlyType type_named(std::string_view name) {
    for (std::size_t type = 1; type < kTypes.size(); ++type) {
        if (name == kTypes[type].name || name == kTypes[type].other_name) return PlyType(type);
    }
    throw UnreadableFile("its header has the unknown type '" + std::string(name) + "'");
}

PlyProperty parse_property(const Words& words) {
    if (words.size() == 3) return {std::string(words[2]), type_named(words[1]), PlyType::None};
    if (words.size() != 5 || words[1] != "list") {
        throw UnreadableFile("its header has a property that is not 'property TYPE NAME'");
    }
    PlyProperty list{std::string(words[4]), type_named(words[3]), type_named(words[2])};
    if (list.count_type == PlyType::Float || list.count_type == PlyType::Double) {
        throw UnreadableFile("the length of list " + list.name + " is not a whole number");
    }
    return list;
}

PlyElement parse_element(const Words& words, const PlyTable& table) {
    if (words.size() != 3) throw UnreadableFile("an element of its header is not 'element NAME N'");
    PlyElement element;
    element.name = words[1];
    const std::int64_t count = parse_integer(words[2]);
    if (count < 0 || count > std::numeric_limits<std::int32_t>::max()) {
        throw UnreadableFile("the number of " + element.name + " elements is out of range");
    }
    if (table.find(element.name)) throw UnreadableFile("it has two elements " + element.name);
    element.count = static_cast<std::size_t>(count);
    return element;
}

Encoding parse_format(const Words& words) {
    const std::string_view name = words.size() == 3 ? words[1] : "";
    if (name == "ascii") return Encoding::Ascii;
    if (name == "binary_little_endian") return Encoding::LittleEndian;
    if (name == "binary_big_endian") return Encoding::BigEndian;
    throw UnreadableFile("its header has no format that PLY knows");
}

std::pair<PlyTable, Encoding> parse_header(Content& content) {
    if (content.line().substr(0, 3) != "ply") {
        throw UnreadableFile("it is not a PLY file: it does not begin with 'ply'");
    }
    PlyTable table;
    std::optional<Encoding> encoding;
    for (;;) {
        std::string_view line = content.line();
        while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        const Words words = split_at_blanks(line);
        const std::string_view keyword = words.empty() ? "" : words[0];
        if (keyword == "end_header") break;
        if (keyword == "comment" || keyword == "obj_info") {
            table.comments.emplace_back(line);
        } else if (keyword == "format") {
            encoding = parse_format(words);
        } else if (keyword == "element") {
            table.elements.push_back(parse_element(words, table));
        } else if (keyword == "property" && !table.elements.empty()) {
            table.elements.back().properties.push_back(parse_property(words));
        } else {
            throw UnreadableFile("its header has a line that PLY does not know: '" +
                                 std::string(line.substr(0, 40)) + "'");
        }
    }
    if (!encoding) throw UnreadableFile("its header does not say in which format it is");
    return {std::move(table), *encoding};
}

template <class Range>
auto find_by_name(const Range& range, std::string_view name) {
    const auto found = std::find_if(range.begin(), range.end(),
                                    [name](const auto& item) { return item.name == name; });
    return found == range.end() ? nullptr : &*found;
}

}  // namespace

std::size_t size_of(PlyType type) {
    return with_type(type, [](auto number) { return sizeof number; });
}

const char* name_of(PlyType type) {
    return kTypes[static_cast<std::size_t>(type)].name;
}

double number_at(const char* bytes, PlyType type) {
    return with_type(type, [bytes](auto number) {
        return static_cast<double>(number_from<decltype(number)>(bytes));
    });
}

const PlyProperty* PlyElement::find(std::string_view property_name) const {
    return find_by_name(properties, property_name);
}

std::size_t PlyElement::row_size() const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties) {
        if (property.is_list()) return 0;
        size += size_of(property.type);
    }
    return size;
}

std::vector<double> PlyElement::numbers(std::string_view property_name) const {
    const PlyProperty* const wanted = find(property_name);
    std::vector<double> numbers;
    if (!wanted || wanted->is_list()) return numbers;
    numbers.reserve(count);
    for_each_field([&](std::size_t, const PlyProperty& property, std::string_view bytes) {
        if (&property == wanted) numbers.push_back(number_at(bytes.data(), property.type));
    });
    return numbers;
}

void PlyElement::set_numbers(std::string_view property_name, const std::vector<double>& numbers) {
    const PlyProperty* const replaced = find(property_name);
    std::string changed;
    changed.reserve(rows.size() + sizeof(double) * count);
    for_each_field([&](std::size_t row, const PlyProperty& property, std::string_view bytes) {
        if (&property != replaced) changed += bytes;
        if (&property != (replaced ? replaced : &properties.back())) return;
        changed += as_bytes(numbers[row]);
    });
    rows = std::move(changed);
    const PlyProperty number{std::string(property_name), PlyType::Double, PlyType::None};
    if (!replaced) return properties.push_back(number);
    properties[static_cast<std::size_t>(replaced - properties.data())] = number;
}

const PlyElement* PlyTable::find(std::string_view element_name) const {
    return find_by_name(elements, element_name);
}

PlyTable parse_ply_table(std::string_view text) {
    Content content(text);
    auto [table, encoding] = parse_header(content);
    for (PlyElement& element : table.elements) read_rows(content, encoding, element);
    return std::move(table);
}

}  // namespace tracked_mcf
