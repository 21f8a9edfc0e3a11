// SPDX-License-Identifier: GPL-3.0-or-later
/// The program with what only Unix has: pipes, devices, links, limits of a shell.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program_fixture.h"

namespace tracked_mcf {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using ProgramOnUnix = ProgramFixture;

const std::string kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(ProgramOnUnix, MaterialsAreNotOpened) {
    ASSERT_EQ(mkfifo((folder_ / "pipe.mtl").c_str(), 0600), 0);
    // Both would be read without end.
    for (const char* material : {"/dev/zero", "pipe.mtl"}) {
        write_file(folder_ / "a.obj", "mtllib " + std::string(material) + '\n' + kTriangleObj);
        const ProgramRun result = run_program(folder_, "a.obj b.obj --depth 3", "timeout 60");
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_THAT(read_file(folder_ / "b.obj"),
                    StartsWith("mtllib " + std::string(material) + "\nv "));
    }
}

TEST_F(ProgramOnUnix, PipesAreReadInEveryFormat) {
    write_file(folder_ / "a.obj", kTriangleObj);
    for (const std::string extension : {"ply", "obj", "off", "stl"}) {
        const std::string file = "a." + extension, pipe = "pipe." + extension;
        if (extension == "ply" || extension == "stl") {
            ASSERT_EQ(run("a.off " + file + " --depth 3").exit_code, 0);
        }
        std::filesystem::create_symlink("/dev/stdin", folder_ / pipe);
        ASSERT_EQ(run(file + " b.ply --depth 3 --overwrite").exit_code, 0);
        const ProgramRun result = run_program(folder_, pipe + " c.ply --depth 3 --overwrite",
                                              "cat " + file + " | timeout 60");
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(read_file(folder_ / "c.ply"), read_file(folder_ / "b.ply")) << extension;
    }
    const ProgramRun result = run_program(folder_, "/dev/stdin c.off", "cat a.off | timeout 60");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.errors, HasSubstr("/dev/stdin: the extension tells the format"));
}

TEST_F(ProgramOnUnix, PipesAreWrittenInEveryFormat) {
    write_file(folder_ / "a.obj", kTriangleObj);
    for (const std::string extension : {"ply", "obj", "off", "stl"}) {
        const std::string file = "b." + extension, pipe = "out." + extension;
        const std::string input = extension == "obj" ? "a.obj " : "a.off ";
        std::filesystem::create_symlink("/dev/stdout", folder_ / pipe);
        ASSERT_EQ(run(input + file + " --depth 3").exit_code, 0);
        const ProgramRun result = run(input + pipe + " --depth 3 --quiet | cat >piped");
        EXPECT_EQ(read_file(folder_ / "piped"), read_file(folder_ / file)) << extension;
        EXPECT_TRUE(std::filesystem::is_symlink(folder_ / pipe));
    }
}

TEST_F(ProgramOnUnix, AFullStandardOutputExitsWith3) {
    for (const char* arguments : {"--help", "--version", "a.off b.ply --depth 3"}) {
        const ProgramRun result = run(std::string(arguments) + " >/dev/full");
        EXPECT_EQ(result.exit_code, 3) << arguments;
        EXPECT_THAT(
            result.errors,
            EndsWith("tracked_mcf: cannot write to the standard output; the disk may be full.\n"));
    }
}

TEST_F(ProgramOnUnix, FullDiskExitsWith3AndLeavesTheOldFile) {
    write_file(folder_ / "grid.off", grid(20));
    for (const char* name : {"b.ply", "b.off", "b.stl"}) {
        write_file(folder_ / name, "before");
        // `ulimit -f 1` limits each file to one block, so writing fails as on a full disk.
        const ProgramRun result =
            run_program(folder_, "grid.off " + std::string(name) + " --depth 3", "ulimit -f 1;");
        EXPECT_EQ(result.exit_code, 3) << name;
        EXPECT_THAT(result.errors, StartsWith("tracked_mcf: cannot write ")) << name;
        EXPECT_EQ(read_file(folder_ / name), "before");
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        EXPECT_TRUE(entry.is_regular_file()) << entry << " is left behind";
    }
}

TEST_F(ProgramOnUnix, TooLittleMemoryExitsWith4BeforeTheWork) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    write_file(folder_ / "b.ply", "before");
    const ProgramRun result = run_program(
        folder_, "a.off b.ply --method paper --depth 12 --report r.json", "ulimit -v 2000000;");
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_THAT(result.errors,
                StartsWith("tracked_mcf: Depth 12 of the paper's method would need about "));
    EXPECT_THAT(result.errors, HasSubstr(" GB are free. Choose a smaller depth"));
    EXPECT_THAT(result.output, IsEmpty());
    EXPECT_EQ(read_file(folder_ / "b.ply"), "before");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "r.json"));
}

TEST_F(ProgramOnUnix, TooLittleMemoryToReadDoesNotBlameTheDepth) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    write_file(folder_ / "grid.off", grid(500));
    const ProgramRun result = run_program(folder_, "grid.off b.ply", "ulimit -v 60000;");
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_EQ(result.errors,
              "tracked_mcf: there is not enough memory; simplify the mesh, free memory, or raise "
              "the memory limit of this process.\n");
}

TEST_F(ProgramOnUnix, GermanLocaleChangesNoNumber) {
    ASSERT_EQ(run("a.off plain.off --depth 3 --step-size 1.5e-5").exit_code, 0);
    const ProgramRun german = run_program(
        folder_, "a.off german.off --depth 3 --step-size 1.5e-5 --verbose --report r.json",
        "LC_ALL=de_DE.UTF-8");
    ASSERT_EQ(german.exit_code, 0);
    EXPECT_THAT(german.output, HasSubstr("\nStep size 1.5e-05, "));
    EXPECT_EQ(read_file(folder_ / "german.off"), read_file(folder_ / "plain.off"));
    EXPECT_THAT(read_file(folder_ / "r.json"), HasSubstr("\"step_size\": 1.5e-05"));
}

TEST_F(ProgramOnUnix, LinksThatLeadToThemselvesAndLongNamesAreNamed) {
    std::filesystem::create_symlink("loop.ply", folder_ / "loop.ply");
    const std::string long_name = std::string(300, 'a') + ".ply";
    for (const auto& [name, why] :
         {std::pair<std::string, std::string>{"loop.ply", "Too many levels of symbolic links"},
          {long_name, "File name too long"}}) {
        const ProgramRun result = run(name + " out.ply");
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.errors, StartsWith("tracked_mcf: cannot read " + name));
        EXPECT_THAT(result.errors,
                    EndsWith(": " + why + "; check the name and the permissions.\n"));
    }
}

TEST_F(ProgramOnUnix, DeviceIsNotRead) {
    std::filesystem::create_symlink("/dev/null", folder_ / "a.ply");
    const ProgramRun result = run("a.ply out.ply");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.errors, "tracked_mcf: a.ply is a device; give a mesh file.\n");
}

TEST_F(ProgramOnUnix, ThePeakOfTheMemoryIsNotThatOfTheProgramBefore) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers take memory of their own";
    const ProgramRun result =
        run_program(folder_, "a.off b.ply --depth 3 --report r.json",
                    "python3 -c 'import os, sys; big = b\"x\" * 300000000; os.execv(sys.argv[1], "
                    "sys.argv[1:])'");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_LT(nlohmann::json::parse(read_file(folder_ / "r.json"))["peak_memory_bytes"], 200000000);
}

TEST_F(ProgramOnUnix, AReportMustNotOverwriteTheMeshThroughALink) {
    std::filesystem::create_symlink("b.ply", folder_ / "link.ply");
    const ProgramRun result = run("a.off b.ply --report link.ply");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.errors, StartsWith("tracked_mcf: --report would overwrite the mesh b.ply"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply"));
}

}  // namespace
}  // namespace tracked_mcf
