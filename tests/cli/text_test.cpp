// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/text.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

std::uint64_t bits_of(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    return bits;
}

// parse_number uses std::from_chars where the standard library has it for doubles.
TEST(ReadDoubleByStrtod, ReadsWhatParseNumberReads) {
    for (const char* text : {"0",
                             "-0",
                             "1",
                             "-1.5",
                             ".5",
                             "-.5",
                             "5.",
                             "1e5",
                             "1E-5",
                             "1.25e+10",
                             "inf",
                             "-inf",
                             "Infinity",
                             "1e400",
                             "-1e400",
                             "1e-400",
                             "0.1",
                             "00017",
                             "9007199254740993",
                             "2.2250738585072011e-308"}) {
        const auto number = read_double_by_strtod(text);
        ASSERT_TRUE(number) << text;
        EXPECT_EQ(bits_of(*number), bits_of(parse_number(text))) << text;
    }
    EXPECT_TRUE(std::isnan(read_double_by_strtod("nan").value()));
}

TEST(ReadDoubleByStrtod, RefusesWhatParseNumberRefuses) {
    using std::string_view_literals::operator""sv;
    for (const std::string_view text :
         {""sv,     "-"sv,      "."sv,   "e5"sv,  "1e"sv, "1e+"sv,  "1x"sv,
          "0x10"sv, "-0X1p3"sv, "1,5"sv, " 1"sv,  "1 "sv, "\v1"sv,  "--1"sv,
          "-+1"sv,  "- 1"sv,    "1\0"sv, "one"sv, "in"sv, "1.2.3"sv}) {
        EXPECT_FALSE(read_double_by_strtod(text)) << text;
        EXPECT_THROW(parse_number(text), UnreadableFile) << text;
    }
}

TEST(ReadDoubleByStrtod, ReadsBackWhatFormatNumberWrites) {
    std::mt19937_64 generator(7);
    for (int i = 0; i < 10000; ++i) {
        const std::uint64_t bits = generator();
        double number = 0;
        std::memcpy(&number, &bits, sizeof(number));
        if (!std::isfinite(number)) continue;
        EXPECT_EQ(bits_of(read_double_by_strtod(format_number(number)).value()), bits);
    }
}

}  // namespace

}  // namespace tracked_mcf
