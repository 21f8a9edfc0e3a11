// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <utility>

#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

std::uint64_t bits_of(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    return bits;
}

TEST(ParseNumber, ReadsTheNearestDoubleZeroOrInfinity) {
    const std::pair<const char*, double> numbers[] = {
        {"0", 0.},
        {"-0", -0.},
        {"+1", 1.},
        {"-1.5", -1.5},
        {".5", .5},
        {"5.", 5.},
        {"1E-5", 1e-5},
        {"1.25e+10", 1.25e10},
        {"00017", 17.},
        {"inf", HUGE_VAL},
        {"-Infinity", -HUGE_VAL},
        {"1e400", HUGE_VAL},
        {"-1e-400", -0.},
        {"9007199254740993", 9007199254740992.},
        {"2.2250738585072011e-308", 2.2250738585072011e-308}};
    for (const auto& [text, number] : numbers)
        EXPECT_EQ(bits_of(parse_number(text)), bits_of(number)) << text;
    EXPECT_TRUE(std::isnan(parse_number("nan")));
    EXPECT_TRUE(std::isnan(parse_number("-1.#IND")));
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
    using std::string_view_literals::operator""sv;
    for (const std::string_view text :
         {""sv,     "-"sv,      "."sv,   "e5"sv,  "1e"sv, "1e+"sv,  "1x"sv,
          "0x10"sv, "-0X1p3"sv, "1,5"sv, " 1"sv,  "1 "sv, "\v1"sv,  "--1"sv,
          "-+1"sv,  "- 1"sv,    "1\0"sv, "one"sv, "in"sv, "1.2.3"sv}) {
        EXPECT_THROW(parse_number(text), UnreadableFile) << text;
    }
}

TEST(ParseNumber, ReadsBackWhatFormatNumberWrites) {
    std::mt19937_64 generator(7);
    for (int i = 0; i < 10000; ++i) {
        const std::uint64_t bits = generator();
        double number = 0;
        std::memcpy(&number, &bits, sizeof(number));
        if (!std::isfinite(number)) continue;
        EXPECT_EQ(bits_of(parse_number(format_number(number))), bits);
    }
}

}  // namespace

}  // namespace tracked_mcf
