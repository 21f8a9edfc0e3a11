#include "filter_tracked_mcf/core/flow_parameters.h"

#include <cmath>
#include <sstream>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

void check_range(const char* name, int value, int smallest, int largest, const char* note) {
    if (value >= smallest && value <= largest) return;
    throw InvalidParameter(std::string(name) + " is " + std::to_string(value) + "; give " +
                           std::to_string(smallest) + " to " + std::to_string(largest) + note +
                           ".");
}

[[noreturn]] void refuse(const char* name, double value, const std::string& what_to_give) {
    std::ostringstream message;
    message << name << " is " << value << "; give a number " << what_to_give << ".";
    throw InvalidParameter(message.str());
}

std::string shortest(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

// All are written so that what is not a number is refused as well.

void check_step_size(double step_size, bool absolute) {
    if (absolute) {
        if (step_size > 0 && std::isfinite(step_size)) return;
        refuse("step_size", step_size, "greater than 0, in squared units of the mesh");
    }
    if (step_size > 0 && step_size <= kMaximumStepSize) return;
    refuse("step_size", step_size,
           "greater than 0 and at most " + shortest(kMaximumStepSize) + ", such as 1e-5");
}

void check_tolerance(double tolerance) {
    if (tolerance > 0 && tolerance < 1) return;
    refuse("tolerance", tolerance, "greater than 0 and less than 1, such as 1e-3");
}

void check_stabilization(double weight) {
    if (weight >= 0 && weight <= kMaximumStabilization) return;
    refuse("stabilization", weight,
           "from 0, which is none, to " + shortest(kMaximumStabilization) + ", such as " +
               shortest(kDefaultStabilization));
}

void check_spring(double spring) {
    if (spring > 0 && spring <= kMaximumSpring) return;
    refuse("boundary_spring", spring,
           "greater than 0 and at most " + shortest(kMaximumSpring) + ", such as 10");
}

}  // namespace

double stabilization_of(const FlowParameters& parameters) {
    const bool needed = parameters.solver == Solver::Converged;
    return parameters.stabilization.value_or(needed ? kDefaultStabilization : 0.0);
}

void validate(const FlowParameters& parameters) {
    check_range("depth", parameters.depth, 0, kMaximumDepth, ", where 0 chooses automatically");
    check_range("iterations", parameters.iterations, 1, kMaximumIterations, "");
    check_range("cycles", parameters.cycles, 1, kMaximumCycles, "");
    check_range("threads", parameters.threads, 0, kMaximumThreads,
                ", where 0 takes all that OpenMP offers");
    check_step_size(parameters.step_size, parameters.absolute);
    check_spring(parameters.boundary_spring);
    check_tolerance(parameters.tolerance);
    check_stabilization(stabilization_of(parameters));
}

}  // namespace tracked_mcf
