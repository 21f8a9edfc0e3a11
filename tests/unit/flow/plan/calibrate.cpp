// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the measured peaks of the memory of many flows by the paper's method, and how the
// estimates of paper_memory.cpp compare. Usage: tracked_mcf_calibrate_memory [MESH.off]...
//
// A child process makes each flow, so that no flow reuses another one's memory. Linux only.
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/support/off_file.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

struct Measurement {
    int depth = 0;
    double unknowns = 0;
    double peak = 0;
    double estimate = 0;
};

struct Flow {
    std::string mesh;
    std::function<TriangleMesh()> make;
    std::string option;
    FlowParameters parameters;
};

double resident_bytes() {
    malloc_trim(0);  // else the flow would reuse memory that is free but still resident
    std::ifstream statm("/proc/self/statm");
    double size = 0, resident = 0;
    statm >> size >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

Measurement measure(const Flow& flow) {
    TriangleMesh mesh = flow.make();
    const double before = resident_bytes();
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak becomes what is resident now
    const FlowReport report = evolve(mesh, flow.parameters);
    return {report.depth, static_cast<double>(report.unknowns),
            static_cast<double>(peak_memory_bytes()) - before,
            static_cast<double>(report.estimated_memory_bytes) - before};
}

/// Measures in a child process. Returns nothing if the flow fails.
std::vector<Measurement> measure_apart(const Flow& flow) {
    int ends[2];
    if (pipe(ends) != 0) return {};
    const pid_t child = fork();
    if (child == 0) {
        try {
            const Measurement result = measure(flow);
            if (write(ends[1], &result, sizeof(result)) < 0) _exit(1);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s: %s\n", flow.mesh.c_str(), error.what());
        }
        _exit(0);
    }
    close(ends[1]);
    Measurement result;
    const bool complete = read(ends[0], &result, sizeof(result)) == sizeof(result);
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return complete ? std::vector<Measurement>{result} : std::vector<Measurement>{};
}

FlowParameters with_option(const std::string& option, int depth) {
    FlowParameters p;
    p.method = Method::Paper;
    p.order = option == "order 2" ? 2 : 1;
    p.depth = depth;
    p.threads = 2;
    p.step_size = 1e-4;  // long enough for the solver to use all levels
    p.boundary = option == "locked" ? BoundaryCondition::Locked : BoundaryCondition::Free;
    if (option == "12 samples") p.cubature = Cubature::Degree6;
    return p;
}

void compare(const std::vector<std::pair<std::string, std::function<TriangleMesh()>>>& meshes) {
    std::printf("%-24s %-10s depth  peak MB  estimate/peak\n", "mesh", "option");
    for (const auto& [name, make] : meshes) {
        const auto automatic = measure_apart({name, make, "free", with_option("free", 0)});
        if (automatic.empty()) continue;
        for (const int offset : {0, -2, 1, 2, 3, 4}) {
            // Depths finer than the mesh, but not the largest flows.
            if (offset > 1 && std::ldexp(automatic[0].unknowns, 2 * offset) > 4e5) break;
            for (const char* option : {"free", "order 2", "locked", "12 samples"}) {
                const int depth = std::max(1, automatic[0].depth + offset);
                for (const Measurement& m :
                     measure_apart({name, make, option, with_option(option, depth)})) {
                    std::printf("%-24s %-10s %5d %8.1f %14.2f\n", name.c_str(), option, m.depth,
                                1e-6 * m.peak, m.estimate / m.peak);
                    std::fflush(stdout);
                }
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf

int main(int count, char** arguments) {
    using namespace tracked_mcf;
    std::vector<std::pair<std::string, std::function<TriangleMesh()>>> meshes = {
        {"sphere", [] { return shapes::geodesic_sphere(100); }},
        {"coarse sphere", [] { return shapes::geodesic_sphere(15); }},
        {"bumpy sphere", [] { return shapes::bumpy_sphere(60); }},
        {"tube", [] { return shapes::tube(450, 150, 2); }},
        {"soup", [] { return shapes::soup(shapes::geodesic_sphere(60)); }},
        {"fan", [] { return shapes::fan(5000); }},
        {"needles", [] { return shapes::tube(4000, 1, 2); }},
        {"copies", [] { return shapes::stack(shapes::geodesic_sphere(40), 10, 0); }},
        {"stack", [] { return shapes::stack(shapes::square(9), 500, 1e-6); }},
        {"separate triangles", [] { return shapes::separate_triangles(20000); }},
        {"one triangle", [] { return shapes::separate_triangles(1); }},
        {"box, long triangles", [] {
             return shapes::box(40, {1, 0.02, 0.02});
         }}};
    for (int i = 1; i < count; ++i) {
        const std::string path = arguments[i];
        meshes.emplace_back(path.substr(path.rfind('/') + 1), [path] { return read_off(path); });
    }
    compare(meshes);
}
