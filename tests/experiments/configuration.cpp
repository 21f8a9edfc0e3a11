#include "tests/experiments/configuration.h"

#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

namespace tracked_mcf::experiments {

namespace {

void set_paper(FlowParameters& parameters) {
    parameters.solver = Solver::OneWCycle;
    parameters.stabilization = 0;
    parameters.separate_sheets = false;
}

/// Words of the form name=value.
void set_value(const std::string& name, double value, FlowParameters& parameters) {
    if (name == "kappa") {
        parameters.stabilization = value;
    } else if (name == "tolerance") {
        parameters.tolerance = value;
    } else if (name == "cycles") {
        parameters.cycles = static_cast<int>(value);
    } else if (name == "spring") {
        parameters.boundary_spring = value;
    } else {
        throw std::invalid_argument("there is no '" + name + "=' in a configuration");
    }
}

/// Words that stand alone.
const std::map<std::string, std::function<void(FlowParameters&)>>& words_alone() {
    static const std::map<std::string, std::function<void(FlowParameters&)>> words = {
        {"converged", [](FlowParameters&) {}},
        {"paper", set_paper},
        {"separate", [](FlowParameters& p) { p.separate_sheets = true; }},
        {"glued", [](FlowParameters& p) { p.separate_sheets = false; }},
        {"unanchored", [](FlowParameters& p) { p.anchor_pinches = false; }},
        {"conformalized", [](FlowParameters& p) { p.flow = FlowKind::Conformalized; }},
        {"locked", [](FlowParameters& p) { p.boundary = BoundaryCondition::Locked; }},
        {"locked-cells", [](FlowParameters& p) { p.boundary = BoundaryCondition::LockedCells; }},
        {"spring-alone", [](FlowParameters& p) { p.take_up_boundary = false; }},
        {"free", [](FlowParameters& p) { p.boundary = BoundaryCondition::Free; }},
        {"keep-area", [](FlowParameters& p) { p.rescale = Rescaling::KeepArea; }},
    };
    return words;
}

void apply_word(const std::string& word, FlowParameters& parameters) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos) {
        set_value(word.substr(0, equals), std::stod(word.substr(equals + 1)), parameters);
        return;
    }
    const auto known = words_alone().find(word);
    if (known == words_alone().end()) {
        throw std::invalid_argument("there is no '" + word + "' in a configuration");
    }
    known->second(parameters);
}

}  // namespace

FlowParameters parse_configuration(const std::string& words) {
    FlowParameters parameters;
    std::istringstream stream(words);
    for (std::string word; std::getline(stream, word, ',');) apply_word(word, parameters);
    return parameters;
}

}  // namespace tracked_mcf::experiments
