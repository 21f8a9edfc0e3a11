// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace tracked_mcf {

/// A text in which numbers look the same whatever locale a host has set: none groups digits, and
/// all have a decimal point.
class PlainText : public std::ostringstream {
public:
    /// Numbers have at most this many significant digits.
    explicit PlainText(int digits) {
        imbue(std::locale::classic());
        precision(digits);
    }
};

/// Returns a number with at most this many significant digits, without zeros at the end.
inline std::string plain(double number, int digits) {
    PlainText text(digits);
    text << number;
    return text.str();
}

}  // namespace tracked_mcf
