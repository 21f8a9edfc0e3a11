#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace tracked_mcf {

enum class PlyType { None, Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

std::size_t size_of(PlyType type);
const char* name_of(PlyType type);

/// The number of type `type` that lies at `bytes`, in this machine's byte order.
double number_at(const char* bytes, PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::None;
    PlyType count_type = PlyType::None;  ///< of a list's length; None unless it is a list

    bool is_list() const { return count_type != PlyType::None; }
};

/// The number of entries of a list that lies at `field`.
inline std::size_t list_length(const PlyProperty& list, const char* field) {
    return static_cast<std::size_t>(number_at(field, list.count_type));
}

/// One kind of things in a PLY file, such as its vertices: `count` rows, packed one after the
/// other.
struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
    std::string rows;

    /// The property of that name, or null.
    const PlyProperty* find(std::string_view property_name) const;

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

/// A PLY file as it is, whatever its properties mean; in memory as binary in the byte order of this
/// machine, whatever its encoding was.
struct PlyTable {
    std::vector<std::string> comments;  ///< lines that begin with "comment" or "obj_info"
    std::vector<PlyElement> elements;

    /// The element of that name, or null.
    const PlyElement* find(std::string_view element_name) const;
};

/// Throws UnreadableFile unless everything that the header announces is there.
PlyTable parse_ply_table(std::string_view text);

}  // namespace tracked_mcf
