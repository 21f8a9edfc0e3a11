#include "filter_tracked_mcf/parameters/shortfall.h"

#include <algorithm>
#include <sstream>

namespace tracked_mcf {

namespace {

/// Orders steps by how far from solved they were left.
bool is_better(const StepReport& a, const StepReport& b) {
    if (a.reached_tolerance != b.reached_tolerance) return a.reached_tolerance;
    return a.relative_residual < b.relative_residual;
}

}  // namespace

std::string shortfall(const FlowReport& report, double tolerance) {
    const auto& steps = report.steps;
    const auto count = std::count_if(
        steps.begin(), steps.end(), [](const StepReport& step) { return !step.reached_tolerance; });
    if (count == 0) return {};
    const auto worst = std::max_element(steps.begin(), steps.end(), is_better);
    std::ostringstream text;
    text.precision(2);
    text << "The solver stopped short of the tolerance " << tolerance << " in " << count << " of "
         << steps.size() << " steps: " << (count > 1 ? "the worst is " : "") << "step "
         << worst - steps.begin() + 1 << ", at " << worst->relative_residual << " after "
         << worst->solver_iterations << " iterations.";
    return text.str();
}

}  // namespace tracked_mcf
