// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a process can apply the filter ten thousand times and its memory does not grow.

#include <malloc.h>
#include <unistd.h>
#include <vcg/complex/algorithms/create/platonic.h>

#include <fstream>
#include <random>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

constexpr int kRounds = 5, kApplicationsPerRound = 2000;

/// Returns the number of bytes that the program has allocated and not freed.
std::ptrdiff_t allocated_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<std::ptrdiff_t>(info.uordblks + info.hblkhd);
}

/// Returns the number of bytes of memory that the process occupies, with its threads' stacks.
std::ptrdiff_t resident_bytes() {
    std::ptrdiff_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

void make_small_layer(MeshModel& layer) {
    vcg::tri::Torus(layer.cm, 2, 1, 8, 5);
    for (std::size_t i = 0; i < layer.cm.face.size(); i += 3) layer.cm.face[i].SetS();
    update_box_and_normals(layer);
}

bool cancel(int percent, const char*) {
    return percent < 50;
}

bool apply_again(int, const char*) {
    MeshDocument empty;
    return !filter().apply(empty, {}).succeeded;
}

/// A closed layer and one with a boundary, and random values of all parameters.
class Growth : public testing::Test {
protected:
    Growth() {
        make_small_layer(host::add_layer(document, "closed"));
        make_small_layer(host::add_layer(document, "open"));
        delete_first_vertex(*document.mm());
        parameters = filter().parameters(document);
    }

    int random(int count) { return std::uniform_int_distribution<int>(0, count - 1)(generator); }

    /// Sets random values. One set in ten is invalid.
    void set_random_values() {
        parameters.setValue("selected", BoolValue(random(2) == 1));
        const std::pair<const char*, int> choices[] = {
            {"preserve", 3}, {"boundary", 2}, {"quality", 3}, {"flow", 2}, {"method", 2}};
        for (const auto& [name, count] : choices) {
            parameters.setValue(name, *host::choice(random(count)));
        }
        parameters.setValue("order", IntValue(1 + random(4)));
        parameters.setValue("iterations", IntValue(1 + random(2)));
        parameters.setValue("step_size", FloatValue(random(2) == 1 ? 1e-3F : 0));
        parameters.setValue("depth", IntValue(random(10) == 0 ? -1 : 1 + random(3)));
    }

    /// Applies the filter with random values to one of the layers, and takes back the result. One
    /// application in ten is cancelled, and one in ten is applied again while it runs.
    void apply_once() {
        set_random_values();
        document.setCurrentMesh(random(2));
        const std::vector<CVertexO> before = document.mm()->cm.vert;
        const int way = random(10);
        vcg::CallBackPos* const callback = way == 0 ? cancel : way == 1 ? apply_again : nullptr;
        const host::Outcome outcome = filter().apply(document, parameters, callback);
        ++(outcome.succeeded ? successes : failures);
        for (std::size_t i = 0; i < before.size(); ++i) {
            document.mm()->cm.vert[i].P() = before[i].cP();
        }
    }

    /// Applies the filter many times, with the same values in every round.
    void make_round() {
        generator.seed(14);
        for (int i = 0; i < kApplicationsPerRound; ++i) apply_once();
    }

    MeshDocument document;
    RichParameterList parameters;
    std::mt19937 generator;
    int successes = 0, failures = 0;
};

TEST_F(Growth, TenThousandApplicationsLeaveNoMemoryAllocated) {
    make_round();  // fills the host's caches and those of the allocator
    const std::ptrdiff_t allocated = allocated_bytes(), resident = resident_bytes();
    for (int round = 0; round < kRounds; ++round) make_round();
    const int applications = kRounds * kApplicationsPerRound;
    EXPECT_LT(allocated_bytes() - allocated, applications)
        << "Set GLIBC_TUNABLES=glibc.malloc.tcache_count=0, as ctest does: chunks in the "
           "allocator's caches count as allocated.";
    EXPECT_LT(resident_bytes() - resident, 100 * applications);
    EXPECT_GT(successes, applications / 3);
    EXPECT_GT(failures, applications / 3);
}

}  // namespace

}  // namespace tracked_mcf
