// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/experiments/configuration.h"

#include <map>
#include <sstream>
#include <stdexcept>

namespace tracked_mcf::experiments {

namespace {

using Change = void (*)(FlowParameters&);
using ChangeTo = void (*)(FlowParameters&, double);

void set_paper(FlowParameters& p) {
    p.solver = Solver::OneWCycle;
    p.stabilization = 0;
    p.separate_sheets = false;
}

const std::map<std::string, Change> kWords = {
    {"converged", [](FlowParameters&) {}},
    {"paper", set_paper},
    {"separate", [](FlowParameters& p) { p.separate_sheets = true; }},
    {"glued", [](FlowParameters& p) { p.separate_sheets = false; }},
    {"free-pinches", [](FlowParameters& p) { p.constrain_pinches = false; }},
    {"locked", [](FlowParameters& p) { p.boundary = BoundaryCondition::Locked; }},
    {"locked-cells", [](FlowParameters& p) { p.boundary = BoundaryCondition::LockedCells; }},
    {"free", [](FlowParameters& p) { p.boundary = BoundaryCondition::Free; }},
};

Cubature cubature_of(double points) {
    if (points == 1) return Cubature::OnePoint;
    return points == 3 ? Cubature::ThreePoints : Cubature::Degree6;
}

const std::map<std::string, ChangeTo> kWordsWithValue = {
    {"cubature", [](FlowParameters& p, double value) { p.cubature = cubature_of(value); }},
    {"kappa", [](FlowParameters& p, double value) { p.stabilization = value; }},
    {"tolerance", [](FlowParameters& p, double value) { p.tolerance = value; }},
    {"cycles", [](FlowParameters& p, double value) { p.cycles = static_cast<int>(value); }},
};

template <class Changes>
auto change_of(const Changes& changes, const std::string& word) {
    const auto found = changes.find(word);
    if (found != changes.end()) return found->second;
    throw std::invalid_argument("there is no '" + word + "' in a configuration");
}

}  // namespace

FlowParameters parse_configuration(const std::string& words) {
    FlowParameters parameters;
    std::istringstream stream(words);
    for (std::string word; std::getline(stream, word, ',');) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) {
            change_of(kWords, word)(parameters);
        } else {
            change_of(kWordsWithValue, word.substr(0, equals))(parameters,
                                                               std::stod(word.substr(equals + 1)));
        }
    }
    return parameters;
}

}  // namespace tracked_mcf::experiments
