// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tracked_mcf {

using Words = std::vector<std::string_view>;

/// Parses a number, independent of the locale. Throws UnreadableFile with the text unless all of it
/// is a number.
double parse_number(std::string_view text);

/// Returns the number that all of `text` is, or nothing: what std::from_chars takes, as the nearest
/// double, zero or infinity. For standard libraries without std::from_chars for doubles; far
/// slower.
std::optional<double> read_double_by_strtod(std::string_view text);

/// Parses a whole number likewise.
std::int64_t parse_integer(std::string_view text);

/// Returns the shortest text that reads back as the same double.
std::string format_number(double number);

/// Returns the words of a line, which blanks (space, tab, carriage return) separate, as views.
Words split_at_blanks(std::string_view line);

/// Reads the words of a text, line after line. Lines that begin with '#' are skipped.
class WordReader {
public:
    explicit WordReader(std::string_view text) : rest_(text) {}

    /// Returns whether there is a next word, in this line or in one of the next ones.
    bool has_more() { return words_left() > 0 || find_line(); }

    /// Goes to the next line that has words. Throws UnreadableFile if there is none.
    void advance();

    /// Returns the next word, of the next line if this one has no more.
    std::string_view word();

    /// Returns the number of words that this line still has.
    std::size_t words_left() const { return words_.size() - next_; }

    /// Returns the next `count` words of this line, at most words_left().
    Words take(std::size_t count);

    /// Throws UnreadableFile with the number of this line: `what` is wrong with it.
    [[noreturn]] void fail(const std::string& what) const;

private:
    bool find_line();

    std::string_view rest_;
    Words words_;
    std::size_t next_ = 0, line_number_ = 0;
};

}  // namespace tracked_mcf
