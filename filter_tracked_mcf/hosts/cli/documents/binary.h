// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

// Little-endian files have numbers as they are in memory. MSVC, which lacks the macro, compiles for
// little-endian machines alone.
#ifdef __BYTE_ORDER__
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "PLY and STL files can be read and written only on little-endian machines");
#endif

/// Returns the number of this type at `bytes`.
template <class Number>
Number number_from(const char* bytes) {
    Number number;
    std::memcpy(&number, bytes, sizeof number);
    return number;
}

/// Returns the bytes of a number, or of an array of numbers, which must outlive the view.
template <class Numbers>
std::string_view as_bytes(const Numbers& numbers) {
    return {reinterpret_cast<const char*>(&numbers), sizeof numbers};
}

/// Returns the bytes of a number in the other byte order.
inline std::string reversed(std::string_view bytes) {
    return {bytes.rbegin(), bytes.rend()};
}

/// Removes `count` times `size` bytes, at most 8, from the front and returns them.
inline std::string_view take_bytes(std::string_view& bytes, std::size_t count, std::size_t size) {
    if (count > bytes.size() || count * size > bytes.size()) {
        throw UnreadableFile("it ends too early; it is truncated");
    }
    const std::string_view result = bytes.substr(0, count * size);
    bytes.remove_prefix(result.size());
    return result;
}

}  // namespace tracked_mcf
