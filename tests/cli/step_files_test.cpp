// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/step_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program_fixture.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(StepFiles, AreNamedAfterTheOutput) {
    EXPECT_EQ(step_path("folder/a.b.ply", 10), std::filesystem::path("folder/a.b_0010.ply"));
    EXPECT_EQ(step_path("smooth.obj", 1000000), std::filesystem::path("smooth_1000000.obj"));
}

class NumberedFiles : public ProgramFixture {
protected:
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
};

TEST_F(NumberedFiles, HoldWhatFewerStepsGive) {
    write_file(folder_ / "grid.off", grid(20));
    const std::string options = " --depth 4 --boundary free --step-size 1e-4 --iterations ";
    const ProgramRun result = run("grid.off out.ply --every 2" + options + "5");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.errors, IsEmpty());
    ASSERT_EQ(run("grid.off four.ply" + options + "4").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "out_0004.ply"), read_file(folder_ / "four.ply"));
    EXPECT_NE(read_file(folder_ / "out_0002.ply"), read_file(folder_ / "four.ply"));
    for (const char* name : {"out_0001.ply", "out_0003.ply", "out_0005.ply"}) {
        EXPECT_FALSE(exists(name)) << name;
    }
    ASSERT_EQ(run("grid.off five.ply --every 5" + options + "5").exit_code, 0);
    EXPECT_EQ(read_file(folder_ / "five_0005.ply"), read_file(folder_ / "five.ply"));
}

TEST_F(NumberedFiles, AreRemovedIfTheirStepIsTakenBack) {
    const std::string options = " --depth 4 --step-size 5e-2 --every 1 --report r.json --quiet";
    ASSERT_EQ(run("a.off out.off --iterations 100" + options).exit_code, 0);
    const auto report = nlohmann::json::parse(read_file(folder_ / "r.json"));
    ASSERT_EQ(report["stop"], "vanished");
    const int last = report["iterations"];
    ASSERT_GT(last, 1);
    EXPECT_EQ(read_file(step_path(folder_ / "out.off", last)), read_file(folder_ / "out.off"));
    EXPECT_FALSE(std::filesystem::exists(step_path(folder_ / "out.off", last + 1)));
}

TEST_F(NumberedFiles, DoNotReplaceOtherFilesOfTheRun) {
    for (const char* name : {"b_0004.off", "b_4.off", "c_0004.off", "b.off"}) {
        write_file(folder_ / name, kTetrahedron);
    }
    const std::string few = " --depth 3 --step-size 1e-5 --iterations 1 --every ";
    const ProgramRun refused = run("b_0004.off b.off" + few + "2");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.errors,
                HasSubstr("--every would overwrite b_0004.off; give OUTPUT another"));
    EXPECT_EQ(run("a.off b.off --report ./b_0002.off" + few + "2").exit_code, 2);
    for (const char* files : {"b_0004.off b.off --every 3", "b_4.off b.off --every 2",
                              "c_0004.off b.off --every 2", "b.off b.off --every 1"}) {
        EXPECT_EQ(run(files + std::string(" --depth 3 --step-size 1e-5 --iterations 1")).exit_code,
                  0)
            << files;
    }
}

TEST_F(NumberedFiles, RefusesANumberThatIsNone) {
    for (const char* number : {"0", "-1", "x", "1.5"}) {
        const ProgramRun result = run("a.off b.off --every " + std::string(number));
        EXPECT_EQ(result.exit_code, 2) << number;
        EXPECT_THAT(result.errors, HasSubstr("--every")) << number;
    }
}

}  // namespace
}  // namespace tracked_mcf
