#include "filter_tracked_mcf/parameters/early_stop.h"

namespace tracked_mcf {

namespace {

std::string vanished(std::size_t made, const std::string& iterations) {
    if (made == 0) {
        return "Nothing has moved: the first step would have left no surface. Take a smaller step "
               "size.";
    }
    const std::string last = std::to_string(made);
    return "The flow stopped after step " + last + " of " + iterations + ": step " +
           std::to_string(made + 1) + " would have left no surface.";
}

std::string pinched(std::size_t made, const std::string& iterations) {
    return "The flow stopped after step " + std::to_string(made) + " of " + iterations +
           ": so much has pinched that rescaling would blow up what is left.";
}

std::string nothing_moves(std::size_t made, const std::string& iterations) {
    if (made == 0) {
        return "Nothing has moved: all of the surface is held. Free the boundary, or select more; "
               "where cells are locked, take a greater depth.";
    }
    return "The flow stopped after step " + std::to_string(made) + " of " + iterations +
           ": everything that could move has pinched.";
}

}  // namespace

std::string early_stop(const FlowReport& report, int iterations) {
    const std::size_t made = report.steps.size();
    switch (report.stop) {
        case Stop::None:
            break;
        case Stop::Vanished:
            return vanished(made, std::to_string(iterations));
        case Stop::Pinched:
            return pinched(made, std::to_string(iterations));
        case Stop::NothingMoves:
            return nothing_moves(made, std::to_string(iterations));
    }
    return {};
}

}  // namespace tracked_mcf
