// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/case_run.h"

#include <exception>
#include <sstream>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::zoo {

namespace {

/// Keeps another filter's report, and what a flow's report says, too.
template <class Parameters, class Report>
void keep(const Parameters& parameters, Report made, Run& run) {
    run.values = report_values(parameters, {}, made, {});
    static_cast<FilterReport&>(run.report) = std::move(made);
}

void filter(const Case& run_case, int threads, Run& run) {
    if (run_case.noise) {
        NoiseParameters parameters = *run_case.noise;
        parameters.threads = threads;
        const NoiseReport made = remove_noise(run.mesh, run_case.inputs, parameters);
        run.is_loss_told = made.shrunken_parts > 0;
        run.report.detail_size = made.detail_size;
        return keep(parameters, made, run);
    }
    if (run_case.fair) {
        FairParameters parameters = *run_case.fair;
        parameters.threads = threads;
        return keep(parameters, fair(run.mesh, run_case.inputs.selection, parameters), run);
    }
    FlowParameters parameters = run_case.parameters;
    parameters.threads = threads;
    run.report = evolve(run.mesh, run_case.inputs, parameters);
    run.values = report_values(parameters, {}, run.report, {});
}

}  // namespace

Run run(const Case& run_case, int threads) {
    Run made;
    made.mesh = run_case.mesh;
    const double start = cpu_seconds();
    try {
        filter(run_case, threads, made);
    } catch (const Error& error) {
        made.refusal = error.what();
    } catch (const std::exception& error) {
        made.foreign = error.what();
    }
    made.cpu_seconds = cpu_seconds() - start;
    return made;
}

std::vector<bool> vertices_of(const TriangleMesh& mesh, const Selection& selection) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) used[vertex] = true;
    }
    return used;
}

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh, const std::vector<bool>& vertices) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i]) box.extend(mesh.positions[i]);
    }
    return box;
}

std::string number(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

}  // namespace tracked_mcf::zoo
