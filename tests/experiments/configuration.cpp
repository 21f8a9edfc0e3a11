#include "tests/experiments/configuration.h"

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
    } else {
        throw std::invalid_argument("there is no '" + name + "=' in a configuration");
    }
}

void apply(const std::string& word, FlowParameters& parameters) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos) {
        set_value(word.substr(0, equals), std::stod(word.substr(equals + 1)), parameters);
    } else if (word == "paper") {
        set_paper(parameters);
    } else if (word == "separate" || word == "glued") {
        parameters.separate_sheets = word == "separate";
    } else if (word == "unanchored") {
        parameters.anchor_pinches = false;
    } else if (word != "converged") {
        throw std::invalid_argument("there is no '" + word + "' in a configuration");
    }
}

}  // namespace

FlowParameters parse_configuration(const std::string& words) {
    FlowParameters parameters;
    std::istringstream stream(words);
    for (std::string word; std::getline(stream, word, ',');) apply(word, parameters);
    return parameters;
}

}  // namespace tracked_mcf::experiments
