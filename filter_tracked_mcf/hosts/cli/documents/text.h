// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace tracked_mcf {

using Words = std::vector<std::string_view>;

/// Parses a number as the nearest double, zero or infinity, independent of the locale. 1.#IND and
/// the like of old Microsoft libraries are not a number. Throws UnreadableFile with the text unless
/// all of it is a number.
double parse_number(std::string_view text);

/// Parses a whole number likewise.
std::int64_t parse_integer(std::string_view text);

/// Returns the shortest text that reads back as the same float or double.
template <class Number>
std::string format_number(Number number) {
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// Returns the text with the letters A to Z in lower case.
std::string lower_case(std::string_view text);

/// Reads the lines and words of a text. LF, CR and LF, or CR end a line. Blanks, zeros and Ctrl-Z
/// separate words. A byte order mark is skipped.
class TextReader {
public:
    /// Comments last from '#' to the end of a line; none begins in 1.#IND. A backslash continues a
    /// line.
    enum class Syntax { Plain, Comments, CommentsAndContinuedLines };

    /// `lines_before` lines precede the text in its file.
    explicit TextReader(std::string_view text, Syntax syntax = Syntax::Plain,
                        std::size_t lines_before = 0);

    /// Goes to the next line that has words. Returns false at the end.
    bool find_line();

    /// Goes there, too. Throws UnreadableFile at the end.
    void advance();

    /// Returns the next word, of the next line that has one if this one has no more.
    std::string_view word();

    /// Returns the word that word() will return, which this line must have.
    std::string_view next_word() const { return words_[next_]; }

    const Words& words() const { return words_; }  ///< all of this line
    std::size_t words_left() const { return words_.size() - next_; }

    std::size_t line_number() const { return line_number_; }
    std::string_view line_end() const { return text_.substr(line_end_, at_ - line_end_); }
    std::string_view rest() const { return text_.substr(at_); }  ///< what follows this line

    /// Returns the number of lines with words that follow.
    std::size_t count_lines() const;

    /// Throws UnreadableFile with the number of this line: `what` is wrong with it.
    [[noreturn]] void fail(const std::string& what) const;

private:
    bool is_comment(std::size_t at) const;
    void read_words();
    void end_line();

    std::string_view text_;
    Syntax syntax_;
    Words words_;
    std::size_t next_ = 0, at_ = 0, line_end_ = 0, line_number_;
    bool only_returns_ = false;  ///< whether CR alone ends the first line, and so all lines
};

/// Writes a text, or bytes, with parts replaced from the first to the last.
class Patch {
public:
    Patch(std::ostream& out, std::string_view text) : out_(out), rest_(text) {}

    /// Writes what precedes `part`, a view into the text, and then `replacement`.
    void replace(std::string_view part, std::string_view replacement);

    /// Writes what is left of the text.
    void finish();

private:
    std::ostream& out_;
    std::string_view rest_;
    std::string block_;  // a stream takes a few large blocks much faster than many small ones
};

}  // namespace tracked_mcf
