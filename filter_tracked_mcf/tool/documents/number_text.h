#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tracked_mcf {

/// Numbers in files, independent of the locale. The parsers throw UnreadableFile, quoting the text,
/// unless all of it is a number.
double parse_number(std::string_view text);
std::int64_t parse_integer(std::string_view text);

/// The shortest text that reads back as the same double.
std::string format_number(double number);

/// The parts of a line between blanks (space, tab, carriage return), as views into it.
std::vector<std::string_view> split_at_blanks(std::string_view line);

}  // namespace tracked_mcf
