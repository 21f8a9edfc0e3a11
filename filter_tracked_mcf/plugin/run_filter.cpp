#include "filter_tracked_mcf/plugin/run_filter.h"

#include <exception>
#include <new>
#include <numeric>
#include <sstream>

#include "filter_tracked_mcf/parameters/early_stop.h"
#include "filter_tracked_mcf/parameters/shortfall.h"

namespace tracked_mcf {

FilterOutcome guard(const std::function<FilterOutcome()>& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return {false, "There is not enough memory for this; choose a smaller depth.", {}};
    } catch (const std::exception& error) {
        return {false, error.what(), {}};
    } catch (...) {
        return {false, "An unknown error occurred.", {}};
    }
}

namespace run_filter_detail {

namespace {

double seconds_of(const std::vector<StepReport>& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.0, [](double sum, const StepReport& step) {
        return sum + step.assemble_seconds + step.solve_seconds;
    });
}

double final_residual(Solver solver, const StepReport& step) {
    if (solver == Solver::Converged) return step.relative_residual;
    return step.residual_before == 0 ? 0 : step.residual_after / step.residual_before;
}

/// What is amiss with a run that has succeeded, with a blank before; empty if nothing.
std::string warnings(const FlowParameters& parameters, const FlowReport& report) {
    std::string text;
    const std::string stop = early_stop(report, parameters.iterations);
    if (!stop.empty()) text += " Warning: " + stop;
    const std::string short_steps = shortfall(report, parameters.tolerance);
    if (!short_steps.empty()) {
        text += " Warning: " + short_steps +
                " Look at the result; a smaller step size or depth may help.";
    }
    return text;
}

}  // namespace

Progress as_progress(HostCallback* callback) {
    if (callback == nullptr) return {};
    return [callback](double fraction, std::string_view phase) {
        return callback(static_cast<int>(100 * fraction), std::string(phase).c_str());
    };
}

std::string summary(const FlowParameters& parameters, const FlowReport& report) {
    std::ostringstream text;
    text.precision(3);
    text << "Smoothed " << report.vertices << " vertices";
    if (report.held_vertices > 0) text << ", of which " << report.held_vertices << " are held,";
    text << " by " << report.steps.size() << (report.steps.size() == 1 ? " step of " : " steps of ")
         << (parameters.flow == FlowKind::Conformalized ? "conformalized " : "")
         << "mean-curvature flow: depth " << report.depth << ", " << report.unknowns << " unknowns";
    if (report.locked_unknowns > 0) text << " (" << report.locked_unknowns << " locked)";
    text << ", " << report.setup_seconds << " s for the set-up and " << seconds_of(report.steps)
         << " s for the steps.";
    if (report.degenerate_triangles > 0) {
        text << " " << report.degenerate_triangles << " faces have no area and had no say.";
    }
    text << warnings(parameters, report);
    return text.str();
}

Outputs outputs_of(const FlowParameters& parameters, const FlowReport& report) {
    double residual = 0;
    if (!report.steps.empty()) residual = final_residual(parameters.solver, report.steps.back());
    return {{"unknowns", static_cast<int>(report.unknowns)},
            {"depth", report.depth},
            {"steps", static_cast<int>(report.steps.size())},
            {"final_residual", residual},
            {"area_before", report.area_before},
            {"area_after", report.area_after}};
}

}  // namespace run_filter_detail

}  // namespace tracked_mcf
