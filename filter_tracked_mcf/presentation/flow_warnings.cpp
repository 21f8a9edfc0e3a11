// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/flow_warnings.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/plain_text.h"
#include "filter_tracked_mcf/presentation/surface_warnings.h"

namespace tracked_mcf {

namespace {

/// Orders steps by their error estimate; a step that reached the tolerance is better than any
/// other.
bool is_better(const StepReport& a, const StepReport& b) {
    if (a.reached_tolerance != b.reached_tolerance) return a.reached_tolerance;
    return a.error_estimate < b.error_estimate;
}

/// Empty if the flow made all of its steps.
std::string early_stop(const FlowReport& report, int iterations) {
    const std::size_t made = report.steps.size();
    const std::string stopped = "The flow stopped after step " + std::to_string(made) + " of " +
                                std::to_string(iterations) + ": ";
    const std::string ended = made > 0 ? stopped : "Nothing has moved: ";
    const std::string next_step = ended + "step " + std::to_string(made + 1);
    switch (report.stop) {
        case Stop::None:
            return {};
        case Stop::Vanished:
            if (made > 0) {
                return stopped + "step " + std::to_string(made + 1) +
                       " would have left no surface.";
            }
            return "Nothing has moved: the first step would have left no surface. Take a smaller "
                   "detail size or step size.";
        case Stop::Pinched:
            return ended + "so much has pinched that preserving would inflate what is left.";
        case Stop::StepFailed:
            return next_step +
                   " failed: the surface left its bounds, or the equations could not be solved. "
                   "Take a smaller detail size or step size.";
        case Stop::Grew:
            return next_step +
                   " would have made the surface larger, which no such flow does: some faces are "
                   "needles, too narrow for their length. Remesh them, or take a smaller detail "
                   "size or step size.";
        case Stop::NotPreserved:
            return next_step +
                   " would have changed the surface so much that its volume cannot be restored. "
                   "Take more steps, or a smaller detail size or step size.";
        case Stop::NothingMoves:
            return "Nothing has moved: all of the surface is held. Free the boundary, or "
                   "select more; with the method Paper, take a greater depth.";
    }
    return {};
}

/// Empty unless the step size was limited.
std::string limited_step_size(const FlowReport& report) {
    if (report.step_size >= report.asked_step_size || report.stop != Stop::None) return {};
    PlainText text(3);
    text << "The step size is limited to " << report.step_size << " squared units of the mesh, "
         << "instead of " << report.asked_step_size << ": waves longer than " << report.detail_size
         << " keep more than half of their amplitude. More steps go further.";
    return text.str();
}

/// Empty unless the detail is finer than that of the mesh.
std::string fine_detail(const FlowParameters& parameters, const FlowReport& report) {
    const double edges = report.detail_size / report.mean_edge;
    const bool is_fine = parameters.step_size == 0 && edges < 0.99 * kFinestDetailInEdges;
    if (!is_fine || report.stop != Stop::None) return {};
    PlainText text(3);
    text << "The detail size is " << edges << " mean edges; below " << kFinestDetailInEdges
         << " little changes. The default is " << kDefaultDetailInEdges << " edges, "
         << kDefaultDetailInEdges * report.mean_edge << ".";
    return text.str();
}

/// Empty unless a conformalized flow cannot end at a sphere.
std::string handles(const FlowReport& report) {
    if (report.genus == 0 || report.stop == Stop::NothingMoves) return {};
    return "The surface has " + std::to_string(report.genus) +
           (report.genus == 1 ? " handle" : " handles") +
           ", so it cannot become a sphere. Close its tunnels first.";
}

/// A flow that removes more of the area than this has changed more than noise.
constexpr double kLargeLoss = 0.1;

/// Empty unless a flow that preserves nothing has removed much of the area.
std::string lost_area(const FlowParameters& parameters, const FlowReport& report) {
    const double lost = 1 - report.area_after / report.area_before;
    if (parameters.preserve != Preserve::None || report.steps.empty() ||
        report.stop == Stop::Vanished || !(lost > kLargeLoss))
        return {};
    const bool exceeds_mesh = report.detail_size > report.longest_side;
    const bool chose_detail = parameters.detail_size > 0 || parameters.step_size > 0;
    // A minimal surface may be small.
    if (exceeds_mesh && chose_detail && report.boundary_edges > 0) return {};
    PlainText text(3);
    text << "The flow has removed " << 100 * lost << " % of the area";
    if (exceeds_mesh) {
        text << ": the detail size " << report.detail_size
             << " is longer than the mesh. Take a smaller one, such as 2 % of the diagonal.";
    } else {
        text << ". If that is more than noise, take a smaller detail size, or a greater order to "
                "keep the shape.";
    }
    return text.str();
}

/// Empty if all steps reached the tolerance.
std::string shortfall(const FlowReport& report, double tolerance) {
    const auto& steps = report.steps;
    const auto count = std::count_if(
        steps.begin(), steps.end(), [](const StepReport& step) { return !step.reached_tolerance; });
    if (count == 0) return {};
    const auto worst = std::max_element(steps.begin(), steps.end(), is_better);
    PlainText text(2);
    text << "The solver stopped short of the tolerance " << tolerance << " in " << count << " of "
         << steps.size() << " steps: " << (count > 1 ? "the worst is " : "") << "step "
         << worst - steps.begin() + 1 << ", at " << worst->error_estimate << " after "
         << worst->solver_iterations
         << " iterations. Look at the result; a smaller detail size may help.";
    return text.str();
}

}  // namespace

bool converged(const FlowReport& report) {
    return std::all_of(report.steps.begin(), report.steps.end(),
                       [](const StepReport& step) { return step.reached_tolerance; });
}

std::vector<std::string> warnings_of(const FlowParameters& parameters, const FlowReport& report) {
    std::vector<std::string> warnings = surface_warnings(report);
    for (const std::string& warning :
         {early_stop(report, parameters.iterations), limited_step_size(report),
          fine_detail(parameters, report), handles(report), lost_area(parameters, report)}) {
        if (!warning.empty()) warnings.push_back(warning);
    }
    const std::string short_steps = shortfall(report, parameters.tolerance);
    if (!short_steps.empty()) warnings.push_back(short_steps);
    return warnings;
}

}  // namespace tracked_mcf
