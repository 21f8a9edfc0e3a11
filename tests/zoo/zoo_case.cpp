// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/zoo_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "tests/support/shapes.h"
#include "tests/zoo/bad_meshes.h"
#include "tests/zoo/case_run.h"

namespace tracked_mcf::zoo {

namespace {

/// With these, a case takes 0.05 s on average.
constexpr double kMostFragments = 20000;

bool is_selected(const Selection& selection, std::size_t triangle) {
    return selection.empty() || selection[triangle] != 0;
}

Eigen::AlignedBox3d box_of_selected(const TriangleMesh& mesh, const Selection& selection) {
    return box_of(mesh, vertices_of(mesh, selection));
}

/// The triangles on one side of a plane, or random ones.
Selection random_selection(const TriangleMesh& mesh, Random& random) {
    Selection selection;
    const Eigen::Vector3d normal = random.direction();
    const bool is_random = random.chance(0.3);
    for (const Triangle& t : mesh.triangles) {
        const bool above = normal.dot(mesh.positions[t[0]]) > 0;
        selection.push_back((is_random ? random.chance(0.5) : above) ? 1 : 0);
    }
    return selection;
}

/// A vertex and one of its neighbours.
struct Vertex {
    std::int32_t at, neighbour;
};

/// The triangles in a ball around a vertex.
Selection random_patch(const TriangleMesh& mesh, double side, Random& random) {
    Selection selection;
    if (mesh.positions.empty()) return selection;
    const Eigen::Vector3d centre =
        mesh.positions[random.below(static_cast<int>(mesh.positions.size()))];
    const double radius = side * random.between(0.2, 0.8);
    for (const Triangle& t : mesh.triangles) {
        const bool is_inside = (mesh.positions[t[0]] - centre).stableNorm() < radius;
        selection.push_back(is_inside ? 1 : 0);
    }
    return selection;
}

/// Changes random vertices of triangles that are not selected, or adds triangles without area that
/// link any places. Returns the kind.
std::string spoil_surroundings(Case& of, Random& random) {
    std::vector<Vertex> around;
    for (std::size_t i = 0; i < of.mesh.triangles.size(); ++i) {
        const Triangle& t = of.mesh.triangles[i];
        if (of.inputs.selection[i] == 0) around.push_back({t[0], t[1]});
    }
    if (around.empty()) return "smooth_around";
    std::vector<Eigen::Vector3d>& at = of.mesh.positions;
    const auto any = [&] { return around[random.below(static_cast<int>(around.size()))]; };
    const double share = random.log_between(1e-3, 1);
    const int count = 1 + static_cast<int>(share * static_cast<double>(around.size()));
    switch (random.below(4)) {
        case 0:
            return "smooth_around";
        case 1: {
            const double edge = (at[around[0].at] - at[around[0].neighbour]).norm();
            const double size = edge * random.log_between(1e-3, 1);
            for (Eigen::Vector3d& position : at) position += size * random.point();
            return "noise_around";
        }
        case 2:
            for (int i = 0; i < count; ++i) {
                const Vertex moved = any();
                const double left =
                    random.chance(0.5) ? random.unit() : random.log_between(1e-12, 1);
                at[moved.at] = at[moved.neighbour] + left * (at[moved.at] - at[moved.neighbour]);
            }
            return "needles_around";
        default:
            for (int i = 0; i < count; ++i) {
                const std::int32_t first = any().at;
                const auto other =
                    static_cast<std::int32_t>(random.below(static_cast<int>(at.size())));
                of.mesh.triangles.push_back({first, first, other});
                of.inputs.selection.push_back(random.chance(0.5) ? 1 : 0);
            }
            return "degenerate_around";
    }
}

/// Replaces the mesh by one that is fine enough for a patch, selects the patch, and changes what is
/// around it.
void make_patch(Case& made, Random& random) {
    const int n = random.integer(6, 16);
    switch (random.below(4)) {
        case 0:
            made.mesh = shapes::torus(4 * n, 2 * n, 1, 0.4);
            break;
        case 1:
            made.mesh = shapes::tube(3 * n, 2 * n, 4);
            break;
        case 2:
            made.mesh = shapes::square(2 * n);
            break;
        default:
            made.mesh = shapes::bumpy_sphere(n);
    }
    made.inputs.selection = random_patch(made.mesh, 1, random);
    made.kind = spoil_surroundings(made, random);
}

void set_step_size(FlowParameters& parameters, double side, Random& random) {
    switch (random.below(4)) {
        case 0:
            break;  // the default detail size
        case 1:
            parameters.detail_size = side * random.log_between(1e-6, 1e3);
            break;
        default:
            parameters.step_size = side * side * random.log_between(1e-12, 1e6);
    }
    // The size of a mesh that is not finite, or of 1e150, is none that parameters may have.
    if (!std::isfinite(parameters.detail_size)) parameters.detail_size = 0;
    if (!std::isfinite(parameters.step_size)) parameters.step_size = 0;
}

/// Parameters that change the discretisation or the solver. Most cases have the defaults.
void set_numerics(FlowParameters& parameters, Random& random) {
    if (random.chance(0.2)) parameters.tolerance = random.pick({0.5, 1e-1, 1e-6});
    if (random.chance(0.2)) parameters.cycles = random.integer(2, 5);
    if (random.chance(0.2)) {
        parameters.cubature = random.pick({Cubature::OnePoint, Cubature::Degree6});
    }
}

/// Takes the paper's method, and nothing that it does not have.
void make_papers(FlowParameters& parameters) {
    parameters.method = Method::Paper;
    parameters.flow = FlowKind::MeanCurvature;
    parameters.preserve = Preserve::None;
}

FlowParameters random_parameters(double side, Random& random) {
    FlowParameters parameters;
    parameters.depth = random.integer(0, 9);
    set_step_size(parameters, side, random);
    parameters.iterations = random.chance(0.3) ? random.integer(4, 50) : random.integer(1, 3);
    // Only steps of order 1 obey a maximum principle and lower the area.
    parameters.order = random.chance(0.5) ? 1 : random.integer(2, kMaximumOrder);
    parameters.flow = random.pick({FlowKind::MeanCurvature, FlowKind::Conformalized});
    parameters.boundary = random.pick({BoundaryCondition::Locked, BoundaryCondition::Free});
    if (random.chance(0.4)) parameters.preserve = random.pick({Preserve::Area, Preserve::Volume});
    // Scaling needs a free boundary; most of the other cases would only be refused.
    if (parameters.preserve != Preserve::None && random.chance(0.7)) {
        parameters.boundary = BoundaryCondition::Free;
    }
    if (random.chance(0.3)) parameters.quality = Quality::Displacement;
    if (random.chance(0.3)) parameters.quality = Quality::MeanCurvature;
    set_numerics(parameters, random);
    if (random.chance(0.15)) make_papers(parameters);
    return parameters;
}

/// Returns strengths of which many are 0 or 1. Coincident vertices have the same.
std::vector<double> random_strength(const TriangleMesh& mesh, Random& random) {
    std::map<std::array<std::uint64_t, 3>, double> at;
    std::vector<double> strength;
    for (const Eigen::Vector3d& position : mesh.positions) {
        const Eigen::Vector3d without_negative_zero = position.array() + 0.0;
        std::array<std::uint64_t, 3> bits{};
        std::memcpy(bits.data(), without_negative_zero.data(), sizeof bits);
        const double drawn = random.pick({0.0, 1.0, random.unit()});
        strength.push_back(at.emplace(bits, drawn).first->second);
    }
    return strength;
}

/// Returns the shortest text that is read as this number.
std::string exact(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
    return {text.begin(), end};
}

}  // namespace

double fragments_at(const TriangleMesh& mesh, const Selection& selection, int depth) {
    const double side = box_of_selected(mesh, selection).sizes().maxCoeff();
    if (!(side > 0) || !std::isfinite(side)) return 0;
    const double cells_per_unit = std::ldexp(1.0, depth) / (1.1 * side);
    double fragments = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!is_selected(selection, i)) continue;
        const Triangle& t = mesh.triangles[i];
        const Eigen::Vector3d u = cells_per_unit * (mesh.positions[t[1]] - mesh.positions[t[0]]);
        const Eigen::Vector3d v = cells_per_unit * (mesh.positions[t[2]] - mesh.positions[t[0]]);
        // On average over positions, a triangle meets about as many cells as this, see
        // core/plan/paper_memory.cpp.
        fragments += 1 + u.lpNorm<1>() + v.lpNorm<1>() + u.cross(v).lpNorm<1>();
    }
    return fragments;
}

void limit_work(Case& limited, double most_fragments) {
    FlowParameters& parameters = limited.parameters;
    const auto fragments = [&](int depth) {
        return fragments_at(limited.mesh, limited.inputs.selection, depth);
    };
    while (parameters.depth > 1 && fragments(parameters.depth) > most_fragments) --parameters.depth;
    // The automatic depth is hardly ever deeper than this for meshes of a few thousand vertices.
    constexpr int automatic = 5;
    const int depth = parameters.depth == 0 ? automatic : parameters.depth;
    const double solves = 5 * most_fragments / std::max(1.0, fragments(depth)) / parameters.order;
    const int most = static_cast<int>(std::clamp(solves, 1.0, 50.0));
    parameters.iterations = std::min(parameters.iterations, most);
}

Case case_of(std::uint64_t seed, std::int64_t number) {
    Random random(seed, static_cast<std::uint64_t>(number));
    Case made;
    const Kind& kind = kinds()[random.below(static_cast<int>(kinds().size()))];
    made.kind = kind.name;
    made.mesh = kind.make(random);
    if (random.chance(0.1)) made.inputs.selection = random_selection(made.mesh, random);
    made.parameters = random_parameters(
        box_of_selected(made.mesh, made.inputs.selection).sizes().maxCoeff(), random);
    limit_work(made, kMostFragments);
    if (random.chance(0.1)) made.inputs.strength = random_strength(made.mesh, random);
    if (made.parameters.method == Method::Paper) made.inputs = {};
    return made;
}

Case noise_case_of(std::uint64_t seed, std::int64_t number) {
    Case made = case_of(seed, number);
    Random random(seed, ~static_cast<std::uint64_t>(number));
    const double side = box_of_selected(made.mesh, made.inputs.selection).sizes().maxCoeff();
    const auto length = [&](double probability) {
        const double drawn = side * random.log_between(1e-6, 1e2);
        return random.chance(probability) && std::isfinite(drawn) ? drawn : 0.0;
    };
    NoiseParameters& noise = made.noise.emplace();
    noise.crease_angle = random.pick({25.0, 25.0, 0.0, random.between(0, 179)});
    noise.noise = length(0.2);
    noise.noise_size = length(0.2);
    noise.detail_size = length(0.2);
    noise.largest_movement = length(0.2);
    noise.along_normals = random.chance(0.2);
    noise.boundary = random.pick(
        {NoiseBoundary::Free, NoiseBoundary::Free, NoiseBoundary::Locked, NoiseBoundary::Smooth});
    if (random.chance(0.3)) noise.quality = Quality::Displacement;
    return made;
}

Case fair_case_of(std::uint64_t seed, std::int64_t number) {
    Case made = case_of(seed, number);
    Random random(seed, ~static_cast<std::uint64_t>(number));
    const double side = box_of_selected(made.mesh, {}).sizes().maxCoeff();
    if (made.inputs.selection.empty())
        made.inputs.selection = random_patch(made.mesh, side, random);
    made.inputs.strength.clear();
    FairParameters& fair = made.fair.emplace();
    fair.continuity =
        random.pick({Continuity::Position, Continuity::Tangent, Continuity::Curvature});
    if (random.chance(0.3)) fair.quality = Quality::Displacement;
    if (random.chance(0.5)) make_patch(made, random);
    return made;
}

namespace {

/// Writes the options that differ from their defaults.
template <class Parameters>
void write_options(const Parameters& parameters, std::ostream& text) {
    for (const auto& parameter : parameter_table<Parameters>()) {
        const ParameterValue value = parameter.get(parameters);
        if (value == parameter.initial) continue;
        std::string option = parameter.name;
        std::replace(option.begin(), option.end(), '_', '-');
        text << " --" << option;
        if (const double* const number = std::get_if<double>(&value)) text << ' ' << exact(*number);
        if (const int* const number = std::get_if<int>(&value)) {
            text << ' ';
            if (parameter.type == Parameter::Type::Choice) {
                text << parameter.choices[*number].name;
            } else {
                text << *number;
            }
        }
    }
}

}  // namespace

std::string options_of(const Case& described) {
    std::ostringstream text;
    if (described.noise) {
        text << "remove-noise";
        write_options(*described.noise, text);
    } else if (described.fair) {
        text << "fair";
        write_options(*described.fair, text);
    } else {
        write_options(described.parameters, text);
    }
    if (!described.inputs.selection.empty()) text << " --selected selected";
    if (!described.inputs.strength.empty()) text << " --strength strength";
    return text.str();
}

void write_ply(const Case& written, const std::string& path) {
    std::ofstream file(path);
    file.precision(std::numeric_limits<double>::max_digits10);
    const bool has_selection = !written.inputs.selection.empty();
    const bool has_strength = !written.inputs.strength.empty();
    file << "ply\nformat ascii 1.0\nelement vertex " << written.mesh.positions.size()
         << "\nproperty double x\nproperty double y\nproperty double z\n"
         << (has_strength ? "property double strength\n" : "") << "element face "
         << written.mesh.triangles.size() << "\nproperty list uchar int vertex_indices\n"
         << (has_selection ? "property uchar selected\n" : "") << "end_header\n";
    for (std::size_t i = 0; i < written.mesh.positions.size(); ++i) {
        const Eigen::Vector3d& p = written.mesh.positions[i];
        file << p[0] << ' ' << p[1] << ' ' << p[2];
        if (has_strength) file << ' ' << written.inputs.strength[i];
        file << '\n';
    }
    for (std::size_t i = 0; i < written.mesh.triangles.size(); ++i) {
        const Triangle& t = written.mesh.triangles[i];
        file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2];
        if (has_selection) file << ' ' << static_cast<int>(written.inputs.selection[i]);
        file << '\n';
    }
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace tracked_mcf::zoo
