// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tracked_mcf {

enum class PlyType { None, Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

std::size_t size_of(PlyType type);
const char* name_of(PlyType type);

/// Returns the number of type `type` at `bytes`, in this machine's byte order.
double number_at(const char* bytes, PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::None;
    PlyType count_type = PlyType::None;  ///< of a list's length; None unless it is a list

    bool is_list() const { return count_type != PlyType::None; }
};

/// Returns the number of entries of the list at `field`.
inline std::size_t list_length(const PlyProperty& list, const char* field) {
    return static_cast<std::size_t>(number_at(field, list.count_type));
}

/// One kind of item in a PLY file, such as its vertices: `count` packed rows.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
    std::string rows;

    /// Returns the property of that name, or null.
    const PlyProperty* find(std::string_view property_name) const;

    /// Returns the size of a row in bytes; 0 if lists make it vary.
    std::size_t row_size() const;

    /// Returns one number per row: the property of that name. Empty if there is none or if it is a
    /// list.
    std::vector<double> numbers(std::string_view property_name) const;

    /// Gives each row a Double of that name, in place of a property that has the name, or else
    /// after all others.
    void set_numbers(std::string_view property_name, const std::vector<double>& numbers);

    /// Calls visit(row, property, bytes) for every field: a number, or a list with its length.
    template <class Visit>
    void for_each_field(Visit visit) const {
        const char* at = rows.data();
        for (std::size_t row = 0; row < count; ++row) {
            for (const PlyProperty& property : properties) {
                std::size_t size = size_of(property.type);
                if (property.is_list()) {
                    size = size_of(property.count_type) + size * list_length(property, at);
                }
                visit(row, property, std::string_view(at, size));
                at += size;
            }
        }
    }
};

/// A PLY file, whatever its properties mean. In memory it is binary in this machine's byte order,
/// whatever its encoding was.
struct PlyTable {
    std::vector<std::string> comments;  ///< lines that begin with "comment" or "obj_info"
    std::vector<PlyElement> elements;

    /// Returns the element of that name, or null.
    const PlyElement* find(std::string_view element_name) const;
};

/// Parses a file. Throws UnreadableFile unless everything that the header announces is there.
PlyTable parse_ply_table(std::string_view text);

}  // namespace tracked_mcf
