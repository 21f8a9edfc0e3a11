// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/documents/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// std::from_chars does not take a leading plus.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
    return text;
}

/// Reads all of `text`.
template <class Number>
std::errc read_all(std::string_view text, Number& number) {
    const char* const end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, number);
    return result.ptr == end ? result.ec : std::errc::invalid_argument;
}

#ifdef __cpp_lib_to_chars
std::optional<double> read_double(std::string_view text) {
    double number = 0;
    const std::errc error = read_all(text, number);
    if (error == std::errc()) return number;
    // strtod rounds numbers beyond the range of doubles to zero or to infinity.
    if (error == std::errc::result_out_of_range) return read_double_by_strtod(text);
    return {};
}
#else  // libc++ has no std::from_chars for doubles.
std::optional<double> read_double(std::string_view text) {
    return read_double_by_strtod(text);
}
#endif

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

}  // namespace

std::optional<double> read_double_by_strtod(std::string_view text) {
    const std::string_view digits = text.substr(text.substr(0, 1) == "-" ? 1 : 0);
    // strtod skips blanks and a plus, and reads hexadecimal numbers.
    if (digits.find_first_of(".0123456789iInN") != 0) return {};
    if (digits.find_first_of("xX") == 1) return {};
    const std::string terminated(text);
    char* end = nullptr;
    const double number = std::strtod(terminated.c_str(), &end);
    if (end != terminated.c_str() + terminated.size()) return {};
    return number;
}

double parse_number(std::string_view text) {
    if (const auto number = read_double(without_plus(text))) return *number;
    throw UnreadableFile(quoted(text) + " stands where a number should");
}

std::int64_t parse_integer(std::string_view text) {
    std::int64_t number = 0;
    if (read_all(without_plus(text), number) == std::errc()) return number;
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
