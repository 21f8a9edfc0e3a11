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

/// Returns another filter's report as far as a flow's report says the same.
template <class Report>
FlowReport as_flow_report(Report made) {
    FlowReport report;
    report.area_before = made.area_before;
    report.area_after = made.area_after;
    report.largest_displacement = made.largest_displacement;
    report.rms_displacement = made.rms_displacement;
    report.quality = std::move(made.quality);
    return report;
}

FlowReport filtered(TriangleMesh& mesh, const Case& run_case, int threads, bool& is_loss_told) {
    if (run_case.noise) {
        NoiseParameters parameters = *run_case.noise;
        parameters.threads = threads;
        const NoiseReport made = remove_noise(mesh, run_case.inputs, parameters);
        is_loss_told = made.shrunken_parts > 0;
        FlowReport report = as_flow_report(made);
        report.detail_size = made.detail_size;
        report.volume_change = made.volume_change;
        report.volume_before = made.volume_before;
        return report;
    }
    if (run_case.fair) {
        FairParameters parameters = *run_case.fair;
        parameters.threads = threads;
        return as_flow_report(fair(mesh, run_case.inputs.selection, parameters));
    }
    FlowParameters parameters = run_case.parameters;
    parameters.threads = threads;
    return evolve(mesh, run_case.inputs, parameters);
}

}  // namespace

Run run(const Case& run_case, int threads) {
    Run made;
    made.mesh = run_case.mesh;
    const double start = cpu_seconds();
    try {
        made.report = filtered(made.mesh, run_case, threads, made.is_loss_told);
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
