// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/kernels.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {
namespace {

/// Restores TRACKED_MCF_INSTRUCTIONS at the end of a test.
class InstructionSets : public ::testing::Test {
protected:
    InstructionSets() {
        const char* const value = std::getenv(kVariable);
        if (value != nullptr) before_ = value;
    }
    ~InstructionSets() override { set(before_); }

    static void set(const std::string& value) {
#ifdef _WIN32
        _putenv_s(kVariable, value.c_str());
#else
        setenv(kVariable, value.c_str(), 1);
#endif
    }

private:
    static constexpr const char* kVariable = "TRACKED_MCF_INSTRUCTIONS";
    std::string before_;
};

TEST_F(InstructionSets, TheBestIsChosenByDefault) {
    set("");
    EXPECT_EQ(choose_instruction_set(), available_instruction_sets().back());
}

TEST_F(InstructionSets, TheVariableChoosesAnyAvailableOne) {
    for (const InstructionSet instructions : available_instruction_sets()) {
        set(std::string(name_of(instructions)));
        EXPECT_EQ(choose_instruction_set(), instructions);
        EXPECT_NE(kernels_for(instructions).integrate_elements, nullptr);
    }
}

TEST_F(InstructionSets, BaselineIsAlwaysAvailable) {
    EXPECT_EQ(available_instruction_sets().front(), InstructionSet::Baseline);
}

TEST_F(InstructionSets, UnknownNamesThrow) {
    for (const char* const value : {"sse9", "AVX2", "avx2 "}) {
        set(value);
        EXPECT_THROW(choose_instruction_set(), InvalidParameter);
    }
}

TEST_F(InstructionSets, UnavailableOnesThrow) {
    const auto best = available_instruction_sets().back();
    if (best == InstructionSet::Avx2) GTEST_SKIP() << "This machine has all instruction sets.";
    set("avx2");
    EXPECT_THROW(choose_instruction_set(), InvalidParameter);
    EXPECT_THROW(kernels_for(InstructionSet::Avx2), InvalidParameter);
}

TEST(Kernels, EachInstructionSetHasItsOwn) {
    for (const InstructionSet a : available_instruction_sets()) {
        for (const InstructionSet b : available_instruction_sets()) {
            EXPECT_EQ(a == b,
                      kernels_for(a).integrate_elements == kernels_for(b).integrate_elements);
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
