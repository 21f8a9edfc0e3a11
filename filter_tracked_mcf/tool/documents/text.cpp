// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/documents/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// Reads all of `text`. from_chars does not take a leading plus.
template <class Number>
std::from_chars_result read_all(std::string_view text, Number& number) {
    if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    std::from_chars_result result = std::from_chars(text.data(), end, number);
    if (result.ptr != end) result.ec = std::errc::invalid_argument;
    return result;
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

}  // namespace

double parse_number(std::string_view text) {
    double number = 0;
    const std::errc error = read_all(text, number).ec;
    if (error == std::errc()) return number;
    // strtod rounds numbers beyond the range of doubles to zero or to infinity.
    if (error == std::errc::result_out_of_range) {
        return std::strtod(std::string(text).c_str(), nullptr);
    }
    throw UnreadableFile(quoted(text) + " stands where a number should");
}

std::int64_t parse_integer(std::string_view text) {
    std::int64_t number = 0;
    if (read_all(text, number).ec == std::errc()) return number;
    throw UnreadableFile(quoted(text) + " stands where a whole number should");
}

std::string format_number(double number) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

Words split_at_blanks(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    Words words;
    for (std::size_t begin = line.find_first_not_of(blanks); begin < line.size();) {
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blanks, end);
    }
    return words;
}

bool WordReader::find_line() {
    next_ = 0;
    do {
        words_.clear();
        if (rest_.empty()) return false;
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        words_ = split_at_blanks(rest_.substr(0, end));
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_number_;
    } while (words_.empty() || words_.front().front() == '#');
    return true;
}

void WordReader::advance() {
    if (!find_line()) throw UnreadableFile("it ends too early; it is truncated");
}

std::string_view WordReader::word() {
    if (words_left() == 0) advance();
    return words_[next_++];
}

Words WordReader::take(std::size_t count) {
    const auto begin = words_.begin() + static_cast<std::ptrdiff_t>(next_);
    next_ += count;
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

void WordReader::fail(const std::string& what) const {
    throw UnreadableFile("line " + std::to_string(line_number_) + ": " + what);
}

}  // namespace tracked_mcf
