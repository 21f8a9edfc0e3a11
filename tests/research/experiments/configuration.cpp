// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/experiments/configuration.h"

#include <map>
#include <sstream>
#include <stdexcept>

#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "filter_tracked_mcf/core/flow/stepping/mesh_flow.h"
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"

namespace tracked_mcf::experiments {

namespace {

Cubature cubature_of(double points) {
    if (points == 1) return Cubature::OnePoint;
    return points == 3 ? Cubature::ThreePoints : Cubature::Degree6;
}

/// A word ends with "=" if a value follows it.
const std::map<std::string, void (*)(FlowParameters&, double)> kWords = {
    {"converged", [](FlowParameters& p, double) { p.method = Method::Converged; }},
    {"paper", [](FlowParameters& p, double) { p.method = Method::Paper; }},
    {"locked", [](FlowParameters& p, double) { p.boundary = BoundaryCondition::Locked; }},
    {"free", [](FlowParameters& p, double) { p.boundary = BoundaryCondition::Free; }},
    {"tolerance=", [](FlowParameters& p, double value) { p.tolerance = value; }},
    {"cycles=", [](FlowParameters& p, double value) { p.cycles = static_cast<int>(value); }},
    {"cubature=", [](FlowParameters& p, double value) { p.cubature = cubature_of(value); }},
    {"order=", [](FlowParameters& p, double value) { p.order = static_cast<int>(value); }},
};

}  // namespace

FlowParameters parse_configuration(const std::string& words) {
    FlowParameters parameters;
    parameters.order = 1;
    std::istringstream stream(words);
    for (std::string word; std::getline(stream, word, ',');) {
        const std::size_t end = word.find('=');
        const auto found = kWords.find(word.substr(0, end == std::string::npos ? end : end + 1));
        if (found == kWords.end())
            throw std::invalid_argument("there is no '" + word + "' in a configuration");
        found->second(parameters, end == std::string::npos ? 0 : std::stod(word.substr(end + 1)));
    }
    return parameters;
}

std::unique_ptr<SurfaceFlow> make_flow(const TriangleMesh& mesh, const FlowParameters& parameters) {
    if (parameters.method == Method::Paper)
        return std::make_unique<PaperFlow>(paper_plan_of(mesh, parameters));
    return std::make_unique<MeshFlow>(mesh_plan_of(mesh, {}, parameters));
}

}  // namespace tracked_mcf::experiments
