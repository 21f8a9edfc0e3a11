// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/text.h"

#include <fast_float/fast_float.h>
#include <cmath>
#include <ostream>

#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

/// from_chars() does not take a leading plus.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
    return text;
}

/// Returns whether all of `text` is a whole number in range, and sets it.
template <class Integer>
bool read_all(std::string_view text, Integer& number) {
    const char* const end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, number);
    return result.ec == std::errc() && result.ptr == end;
}

/// Returns whether all of `text` is a number, and sets the nearest double, zero or infinity.
bool read_double(std::string_view text, double& number) {
    const char* const end = text.data() + text.size();
    // Not every standard library has std::from_chars for doubles.
    const fast_float::from_chars_result result = fast_float::from_chars(text.data(), end, number);
    return result.ec != std::errc::invalid_argument && result.ptr == end;
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

bool ends_line(char c) {
    return c == '\n' || c == '\r';
}

/// Zeros and Ctrl-Z end some files.
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\f' || c == '\v' || c == '\0' || c == '\x1A';
}

}  // namespace

double parse_number(std::string_view text) {
    const std::string_view digits = without_plus(text);
    std::int32_t whole = 0;  // most are, and are read faster; -0 is none
    if (digits.substr(0, 1) != "-" && read_all(digits, whole)) return whole;
    double number = 0;
    if (read_double(digits, number)) return number;
    if (digits.substr(digits.substr(0, 1) == "-" ? 1 : 0, 3) == "1.#") return std::nan("");
    throw UnreadableFile(quoted(text) + " stands where a number should");
}

std::int64_t parse_integer(std::string_view text) {
    std::int64_t number = 0;
    if (read_all(without_plus(text), number)) return number;
    throw UnreadableFile(quoted(text) + " stands where a whole number should");
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

TextReader::TextReader(std::string_view text, Syntax syntax, std::size_t lines_before)
    : text_(text), syntax_(syntax), line_number_(lines_before) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text_.substr(0, mark.size()) == mark) text_.remove_prefix(mark.size());
}

bool TextReader::is_comment(std::size_t at) const {
    return text_[at] == '#' && syntax_ != Syntax::Plain && (at == 0 || text_[at - 1] != '.');
}

/// Appends the words up to the end of the line.
void TextReader::read_words() {
    const std::size_t size = text_.size();
    for (;;) {
        while (at_ < size && is_blank(text_[at_])) ++at_;
        if (at_ == size || ends_line(text_[at_])) return;
        const std::size_t begin = at_;
        while (at_ < size && !is_blank(text_[at_]) && !ends_line(text_[at_]) && !is_comment(at_)) {
            ++at_;
        }
        if (at_ > begin) words_.push_back(text_.substr(begin, at_ - begin));
        if (at_ == size || !is_comment(at_)) continue;
        while (at_ < size && !ends_line(text_[at_])) ++at_;
    }
}

void TextReader::end_line() {
    line_end_ = at_;
    ++line_number_;
    if (at_ == text_.size()) return;
    const bool is_return = text_[at_++] == '\r';
    const bool has_feed = is_return && at_ < text_.size() && text_[at_] == '\n';
    // Binary data may follow a line that CR ends, and may begin with LF.
    if (line_number_ == 1) only_returns_ = is_return && !has_feed;
    if (has_feed && !only_returns_) ++at_;
}

bool TextReader::find_line() {
    words_.clear();
    next_ = 0;
    bool goes_on = false;
    while (at_ < text_.size() && (goes_on || words_.empty())) {
        read_words();
        goes_on = syntax_ == Syntax::CommentsAndContinuedLines && !words_.empty() &&
                  words_.back().back() == '\\';
        end_line();
        if (goes_on) words_.back().remove_suffix(1);
        if (goes_on && words_.back().empty()) words_.pop_back();
    }
    return !words_.empty();
}

void TextReader::advance() {
    if (!find_line()) throw UnreadableFile("it ends too early; it is truncated");
}

std::string_view TextReader::word() {
    if (words_left() == 0) advance();
    return words_[next_++];
}

std::size_t TextReader::count_lines() const {
    std::size_t count = 0;
    for (TextReader copy(*this); copy.find_line();) ++count;
    return count;
}

void TextReader::fail(const std::string& what) const {
    throw UnreadableFile("line " + std::to_string(line_number_) + ": " + what);
}

void Patch::replace(std::string_view part, std::string_view replacement) {
    const auto before = static_cast<std::size_t>(part.data() - rest_.data());
    block_ += rest_.substr(0, before);
    block_ += replacement;
    rest_.remove_prefix(before + part.size());
    constexpr std::size_t block_size = 1 << 16;
    if (block_.size() < block_size) return;
    out_ << block_;
    block_.clear();
}

void Patch::finish() {
    out_ << block_ << rest_;
}

}  // namespace tracked_mcf
