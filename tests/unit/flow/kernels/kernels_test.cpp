// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/kernels.h"

#include <gtest/gtest.h>

#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/environment_variable.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

class InstructionSets : public ::testing::Test {
protected:
    void set(const std::string& value) const { variable_.set(value); }

private:
    const EnvironmentVariable variable_{"TRACKED_MCF_INSTRUCTIONS"};
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

TEST_F(InstructionSets, ABadChoiceIsRefusedBeforeTheWorkBegins) {
    set("sse9");
    TriangleMesh mesh = shapes::geodesic_sphere(3);
    int calls = 0;
    EXPECT_THROW(
        evolve(mesh, FlowParameters(), [&](double, std::string_view) { return ++calls > 0; }),
        InvalidParameter);
    EXPECT_EQ(calls, 0);
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
