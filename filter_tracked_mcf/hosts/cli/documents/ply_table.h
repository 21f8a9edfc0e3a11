// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "filter_tracked_mcf/hosts/cli/documents/text.h"

namespace tracked_mcf {

enum class PlyType { None, I8, U8, I16, U16, I32, U32, I64, U64, Float, Double };

const char* name_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::None;
    PlyType count_type = PlyType::None;  ///< of a list's length; None unless it is a list
    std::string_view type_words;         ///< in the header
    std::size_t index = 0;               ///< among the properties of all elements

    bool is_list() const { return count_type != PlyType::None; }
};

/// One kind of item, such as vertices.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
    std::string_view line_end;  ///< of its last line in the header

    /// Returns the property of that name, or else of that name in upper case; or null.
    const PlyProperty* find(std::string_view property_name) const;
};

/// A PLY file, whatever its properties mean: its content, and how the header divides it.
class PlyTable {
public:
    /// Parses the header. Throws UnreadableFile if it makes no sense.
    explicit PlyTable(std::string content);

    // Elements have views into the content.
    PlyTable(const PlyTable&) = delete;
    PlyTable& operator=(const PlyTable&) = delete;

    const std::string& content() const { return content_; }
    std::string_view header() const { return std::string_view(content_).substr(0, body_); }
    const std::vector<PlyElement>& elements() const { return elements_; }
    std::size_t property_count() const { return property_count_; }  ///< of all elements
    bool is_text() const { return encoding_ == Encoding::Text; }

    /// Returns the element of that name, or null; as PlyElement::find() does.
    const PlyElement* find(std::string_view element_name) const;

    /// Calls visit(element, row, property, words) for every field in the order of the file. A word
    /// is a view into the content: the text or the bytes of a number. The length of a list is its
    /// first word. Throws UnreadableFile unless everything that the header announces is there.
    template <class Visit>
    void for_each_field(Visit visit) const {
        Body body = this->body();
        Words words;
        for (const PlyElement& element : elements_) {
            if (element.properties.empty()) continue;
            for (std::size_t row = 0; row < element.count; ++row) {
                if (rows_are_lines_) body.text.advance();
                for (const PlyProperty& property : element.properties) {
                    read_field(body, property, words);
                    visit(element, row, property, words);
                }
            }
        }
    }

    /// Returns the number of a word. It is rounded to a float if that is its type.
    double number(std::string_view word, PlyType type) const;

    /// Returns the word for a number of type Float or Double.
    std::string word(double number, PlyType type) const;

private:
    enum class Encoding { Text, LittleEndian, BigEndian };

    /// What follows the header and has not been read.
    struct Body {
        TextReader text;
        std::string_view bytes;
    };

    void parse_header();
    Body body() const;
    void read_word(Body& body, PlyType type, Words& words) const;
    void read_field(Body& body, const PlyProperty& property, Words& words) const;

    std::string content_;
    std::vector<PlyElement> elements_;
    Encoding encoding_ = Encoding::Text;
    std::size_t property_count_ = 0, body_ = 0, header_lines_ = 0;
    bool rows_are_lines_ = false;  ///< each row has a line, whose further words are ignored
};

}  // namespace tracked_mcf
