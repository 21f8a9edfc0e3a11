// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>
#include <string_view>

namespace tracked_mcf {

// Binary PLY and STL files are little-endian, and their numbers are copied as they are. MSVC, which
// lacks the macro, compiles for little-endian machines alone.
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

}  // namespace tracked_mcf
