// SPDX-License-Identifier: GPL-3.0-or-later
// Fits the coefficients of memory_estimate.cpp to the measured peaks of many flows, and prints the
// peaks, the present estimates and the fits. Usage: tracked_mcf_calibrate_memory [MESH.off]...
//
// A child process makes each flow, so that no flow reuses another one's memory. Linux only.
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/plan/memory_estimate.h"
#include "tests/support/off_file.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

/// The quantities of a BytesPer in memory_estimate.cpp.
constexpr int kQuantities = 6;
constexpr const char* kNames = "flow, vertex, fragment, sample, unknown, element";
using Quantities = Eigen::Matrix<double, kQuantities, 1>;

struct Measurement {
    int depth = 0;
    double unknowns = 0;
    Quantities quantities;
    double peak = 0, clipping_peak = 0;
    double estimate = 0, clipping_estimate = 0;
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
    const TriangleMesh initial = mesh;
    const double before = resident_bytes();
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak becomes what is resident now
    Measurement result;
    const auto peak = [&] { return static_cast<double>(peak_memory_bytes()) - before; };
    const FlowReport report = evolve(mesh, flow.parameters, [&](double, std::string_view phase) {
        if (phase == "Building the octree" && result.clipping_peak == 0)
            result.clipping_peak = peak();
        return true;
    });
    result.peak = peak();
    result.depth = report.depth;
    result.unknowns = static_cast<double>(report.unknowns);
    const SurfaceSize size = size_of(Domain(initial, flow.parameters.boundary));
    const Grid grid = enclosing_grid(initial, report.depth);
    const ExpectedCounts counts = expected_counts(size, grid, discretisation_of(flow.parameters));
    result.quantities << 1, size.vertices, counts.fragments, counts.samples, counts.all_unknowns,
        counts.all_elements;
    result.estimate = static_cast<double>(report.estimated_memory_bytes) - before;
    result.clipping_estimate = estimate_clip_bytes(size, grid, flow.parameters);
    return result;
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

/// Prints the coefficients, none negative, that fit `bytes` with least squares of relative errors.
void print_fit(const char* name, const std::vector<Quantities>& rows,
               const std::vector<double>& bytes) {
    if (rows.empty()) return;
    std::vector<int> used = {0, 1, 2, 3, 4, 5};
    Quantities fit;
    for (;;) {
        Eigen::MatrixXd matrix(rows.size(), used.size());
        for (std::size_t row = 0; row < rows.size(); ++row) {
            for (std::size_t i = 0; i < used.size(); ++i) {
                const auto entry = rows[row][used[i]] / bytes[row];
                matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) = entry;
            }
        }
        const Eigen::VectorXd ones = Eigen::VectorXd::Ones(matrix.rows());
        const Eigen::VectorXd solution = matrix.completeOrthogonalDecomposition().solve(ones);
        fit.setZero();
        for (std::size_t i = 0; i < used.size(); ++i)
            fit[used[i]] = solution[static_cast<Eigen::Index>(i)];
        Eigen::Index lowest = 0;
        if (solution.minCoeff(&lowest) >= 0) break;
        used.erase(used.begin() + lowest);
    }
    double least = 1, most = 1;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        least = std::min(least, fit.dot(rows[row]) / bytes[row]);
        most = std::max(most, fit.dot(rows[row]) / bytes[row]);
    }
    std::printf(
        "%-10s {%.3g, %.3g, %.3g, %.3g, %.3g, %.3g}  fit/measured %.2f to %.2f, %zu flows\n", name,
        fit[0], fit[1], fit[2], fit[3], fit[4], fit[5], least, most, rows.size());
}

/// What print_fit takes.
struct Fit {
    std::vector<Quantities> rows;
    std::vector<double> bytes;
    void add(const Quantities& row, double measured) {
        rows.push_back(row);
        bytes.push_back(measured);
    }
};

FlowParameters with_option(const std::string& option, int depth) {
    FlowParameters p;
    p.solver = Solver::Grid;
    p.depth = depth;
    p.iterations = 3;
    p.threads = 2;
    p.step_size = 1e-4;  // long enough for the solver to use all levels
    p.boundary = option == "locked" ? BoundaryCondition::Locked : BoundaryCondition::Free;
    if (option.find("w-cycle") == 0) p.solver = Solver::OneWCycle;
    if (option == "area") p.preserve = Preserve::Area;
    if (option == "volume") p.preserve = Preserve::Volume;
    if (option == "curvature") p.quality = Quality::MeanCurvature;
    if (option == "order 2") p.order = 2;
    if (option == "1 sample") p.cubature = Cubature::OnePoint;
    if (option.find("12") != std::string::npos) p.cubature = Cubature::Degree6;
    if (option == "joined") p.separate_sheets = false;
    if (option == "conformal") p.flow = FlowKind::Conformalized;
    return p;
}

void calibrate(const std::vector<std::pair<std::string, std::function<TriangleMesh()>>>& meshes) {
    Fit clipping, converged, w_cycle, area, volume, curvature, order;
    std::printf("%-24s %-10s depth  peak MB  estimate/peak  clipping MB  estimate/peak\n", "mesh",
                "option");
    for (const auto& [name, make] : meshes) {
        const auto automatic = measure_apart({name, make, "free", with_option("free", 0)});
        if (automatic.empty()) continue;
        const int depth = automatic[0].depth;
        for (const int offset : {0, -2, 1, 2, 3, 4}) {
            // Depths finer than the mesh, but not the largest flows.
            if (offset > 1 && std::ldexp(automatic[0].unknowns, 2 * offset) > 4e5) break;
            double plain_peak = 0;
            for (const char* option :
                 {"free", "area", "volume", "curvature", "order 2", "w-cycle", "w-cycle 12",
                  "locked", "1 sample", "12 samples", "joined", "conformal"}) {
                const Flow flow = {name, make, option,
                                   with_option(option, std::max(1, depth + offset))};
                for (const Measurement& m : measure_apart(flow)) {
                    std::printf("%-24s %-10s %5d %8.1f %14.2f %12.1f %14.2f\n", name.c_str(),
                                option, m.depth, 1e-6 * m.peak, m.estimate / m.peak,
                                1e-6 * m.clipping_peak, m.clipping_estimate / m.clipping_peak);
                    std::fflush(stdout);
                    if (flow.option == "free") plain_peak = m.peak;
                    clipping.add(m.quantities, m.clipping_peak);
                    // A flow that hardly moves leaves its coarse levels untouched.
                    if (m.peak < 0.7 * plain_peak) continue;
                    const bool is_w_cycle = flow.parameters.solver == Solver::OneWCycle;
                    if (flow.option == "area") {
                        area.add(m.quantities, m.peak - plain_peak);
                    } else if (flow.option == "volume") {
                        volume.add(m.quantities, m.peak - plain_peak);
                    } else if (flow.option == "curvature") {
                        curvature.add(m.quantities, m.peak - plain_peak);
                    } else if (flow.option == "order 2") {
                        order.add(m.quantities, m.peak - plain_peak);
                    } else {
                        (is_w_cycle ? w_cycle : converged).add(m.quantities, m.peak);
                    }
                }
            }
        }
    }
    std::printf("Bytes per %s:\n", kNames);
    print_fit("clipping", clipping.rows, clipping.bytes);
    print_fit("converged", converged.rows, converged.bytes);
    print_fit("w-cycle", w_cycle.rows, w_cycle.bytes);
    print_fit("area", area.rows, area.bytes);
    print_fit("volume", volume.rows, volume.bytes);
    print_fit("curvature", curvature.rows, curvature.bytes);
    print_fit("order 2", order.rows, order.bytes);
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
    calibrate(meshes);
}
