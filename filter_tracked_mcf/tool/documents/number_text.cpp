#include "filter_tracked_mcf/tool/documents/number_text.h"

#include <array>
#include <charconv>
#include <cstdlib>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// Reads all of `text`, less a leading plus, which from_chars does not take.
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
    // Beyond the range of doubles: strtod rounds to zero or to infinity.
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

std::vector<std::string_view> split_at_blanks(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<std::string_view> parts;
    for (std::size_t begin = line.find_first_not_of(blanks); begin < line.size();) {
        const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
        parts.push_back(line.substr(begin, end - begin));
        begin = line.find_first_not_of(blanks, end);
    }
    return parts;
}

}  // namespace tracked_mcf
