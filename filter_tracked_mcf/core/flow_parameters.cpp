#include "filter_tracked_mcf/core/flow_parameters.h"

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
    const double step = parameters.step_size;
    if (!(step > 0 && step <= kMaximumStepSize)) {
        std::ostringstream message;
        message << "step_size is " << step << "; give a number greater than 0 and at most "
                << kMaximumStepSize << ", such as 1e-5.";
        throw InvalidParameter(message.str());
    }
}

}  // namespace tracked_mcf
