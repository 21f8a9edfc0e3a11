// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/properties.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/flow/stepping/preserving.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "tests/support/same_bits.h"
#include "tests/zoo/case_run.h"
#include "tests/zoo/invariance.h"
#include "tests/zoo/reports.h"

namespace tracked_mcf::zoo {

namespace {

/// Returns, per vertex, whether it keeps its place though a selected triangle may use it: where the
/// strength is 0, and, for fair(), where a triangle that is not selected uses it, too.
std::vector<bool> held_vertices(const Case& of) {
    const TriangleMesh& mesh = of.mesh;
    std::vector<bool> held(mesh.positions.size(), false);
    if (!of.inputs.strength.empty()) {
        // Vertices at one place, or on both sides of a crack, take the strength of the first one.
        const Surface surface = surface_of(mesh);
        std::vector<double> strengths(surface.positions.size());
        for (std::size_t i = held.size(); i-- > 0;) {
            if (surface.vertices[i] >= 0) strengths[surface.vertices[i]] = of.inputs.strength[i];
        }
        for (std::size_t i = 0; i < held.size(); ++i)
            held[i] = surface.vertices[i] >= 0 && strengths[surface.vertices[i]] == 0;
    }
    if (!of.fair) return held;
    const std::vector<std::int32_t> first =
        weld_coincident_vertices(mesh, referenced_vertices(mesh));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (of.inputs.selection[i] != 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) held[first[vertex]] = true;
    }
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = held[first[i]];
    return held;
}

/// Returns how far vertices are from the one that they are joined with, at most, mesh units. They
/// move with it.
double width_of_cracks(const TriangleMesh& mesh, const std::vector<bool>& vertices) {
    const Surface surface = surface_of(mesh);
    double width = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (!vertices[i] || surface.vertices[i] < 0) continue;
        const std::int32_t other = surface.mesh_vertices[surface.vertices[i]];
        width = std::max(width, (mesh.positions[i] - mesh.positions[other]).norm());
    }
    return width;
}

/// Returns how far the vertices leave the box, mesh units.
double distance_outside(const Eigen::AlignedBox3d& box, const TriangleMesh& mesh,
                        const std::vector<bool>& vertices) {
    double furthest = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i]) furthest = std::max(furthest, box.exteriorDistance(mesh.positions[i]));
    }
    return furthest;
}

/// Returns the sum of the longest sides of the triangles.
double sum_of_sides(const TriangleMesh& mesh, const Selection& selection) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        double longest = 0;
        for (int corner = 0; corner < 3; ++corner) {
            const Eigen::Vector3d side = mesh.positions[mesh.triangles[i][corner]] -
                                         mesh.positions[mesh.triangles[i][(corner + 1) % 3]];
            longest = std::max(longest, side.norm());
        }
        sum += longest;
    }
    return sum;
}

/// How far the removal of noise may take a vertex out of the box, in its diagonals.
const double kNoiseMargin = 0.1 * std::sqrt(3.0);
/// The same for fair(), which takes no vertex farther than the size of the hole from the membrane.
/// Its size is that of a ball around the seam, up to 1 %.
constexpr double kFairMargin = 1.01;

/// Runs a case and collects failures.
class Checker {
public:
    Checker(const Case& checked, Random& random)
        : case_(checked),
          random_(random),
          flows_(vertices_of(checked.mesh, checked.inputs.selection)),
          box_(box_of(checked.mesh, flows_)),
          base_(run(checked)) {}

    Outcome check(bool all_properties) {
        check_errors();
        check_time();
        if (base_.made()) check_result();
        if (all_properties) check_threads();
        if (all_properties && base_.made()) {
            for (Failure& failure : check_invariance(case_, base_, random_))
                outcome_.failures.push_back(std::move(failure));
        }
        outcome_.refusal = base_.refusal;
        return std::move(outcome_);
    }

private:
    void fail(Property property, const std::string& what) {
        outcome_.failures.push_back({property, what});
    }

    void check_errors();
    void check_time();
    void allow_time(double allowed);
    void check_result();
    void check_finite();
    void check_box();
    void check_box_within(double allowed);
    void check_distance_from_membrane();
    void check_area();
    void check_loss();
    void check_unmoved();
    void check_threads();

    const Case& case_;
    Random& random_;
    std::vector<bool> flows_;  ///< per vertex
    Eigen::AlignedBox3d box_;  ///< of the vertices that flow
    Run base_;
    Outcome outcome_;
};

void Checker::check_errors() {
    if (base_.made()) return;
    if (!base_.foreign.empty()) fail(Property::Error, "not of errors.h: " + base_.foreign);
    if (!same_bits(base_.mesh.positions, case_.mesh.positions)) {
        fail(Property::Error, "the mesh has changed");
    }
}

/// Allows time in proportion to the size: ten times what it takes, so that a busy or slower machine
/// passes.
void Checker::check_time() {
    if (!case_.makes_flow()) {
        return allow_time(0.5 + 2e-3 * static_cast<double>(case_.mesh.triangles.size()));
    }
    const double fragments =
        std::max(fragments_at(case_.mesh, case_.inputs.selection, case_.parameters.depth),
                 static_cast<double>(base_.report.fragments));
    const double size = static_cast<double>(case_.mesh.triangles.size()) + fragments;
    const FlowParameters& parameters = case_.parameters;
    const int cycles = parameters.method == Method::Paper ? parameters.cycles : 1;
    const double solves = 1.0 * parameters.iterations * parameters.order * cycles;
    allow_time(0.5 + 1e-4 * size * (10 + solves));
}

void Checker::allow_time(double allowed) {
    if (base_.cpu_seconds > allowed) {
        fail(Property::Time, number(base_.cpu_seconds) + " s, allowed " + number(allowed) + " s");
    }
}

void Checker::check_result() {
    check_finite();
    check_box();
    check_area();
    check_loss();
    const std::string wrong = wrong_number(case_, base_.mesh, base_.values);
    if (!wrong.empty()) fail(Property::Report, wrong);
    check_unmoved();
}

void Checker::check_finite() {
    std::vector<double> numbers = base_.report.quality;
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        if (flows_[i]) numbers.push_back(base_.mesh.positions[i].sum());
    }
    const auto bad = std::count_if(numbers.begin(), numbers.end(),
                                   [](double result) { return !std::isfinite(result); });
    if (bad > 0) fail(Property::Finite, std::to_string(bad) + " numbers");
    const std::string key = key_without_number(base_.values);
    if (!key.empty()) fail(Property::Finite, key);
}

/// Both flows obey a maximum principle for each coordinate. On the mesh, steps of order 1 keep it;
/// others, and the paper's, do up to the margins of flow/mesh_flow.cpp and flow/paper_flow.h. A
/// surface that is scaled, or inflated by a pressure, keeps to the cube of flow/preserving.cpp
/// around each of its components.
///
/// Steps of fourth order, which remove noise, obey no maximum principle. They keep to a larger box,
/// see confinement() in core/noise/noisy_surface.h.
void Checker::check_box() {
    const FlowParameters& parameters = case_.parameters;
    const double diagonal = box_.diagonal().norm();
    if (case_.noise) return check_box_within(kNoiseMargin * diagonal);
    if (case_.fair) check_distance_from_membrane();
    if (case_.fair) return check_box_within(kFairMargin * diagonal);
    if (parameters.method == Method::Converged && parameters.order == 1 &&
        parameters.preserve == Preserve::None) {
        const double farthest =
            std::max(box_.min().cwiseAbs().maxCoeff(), box_.max().cwiseAbs().maxCoeff());
        const double rounding = 1e-10 * diagonal + 1e-15 * farthest;
        return check_box_within(rounding + width_of_cracks(case_.mesh, flows_));
    }
    constexpr double of_paper = 0.1, of_orders = 0.1 + 0.02;
    double allowed = parameters.method == Method::Paper ? of_paper * diagonal : 0;
    if (parameters.order > 1) allowed = std::max(allowed, of_orders * diagonal);
    if (parameters.preserve != Preserve::None) {
        const double growth = parameters.flow == FlowKind::Conformalized
                                  ? kLargestConformalizedGrowth
                                  : kLargestGrowth;
        const double sphere = std::sqrt(base_.report.area_before / std::acos(-1.0));
        allowed += growth / 2 * std::max(box_.sizes().maxCoeff(), sphere);
    }
    check_box_within(std::sqrt(3.0) * allowed);  // along a diagonal of the box
}

void Checker::check_box_within(double allowed) {
    const double diagonal = box_.diagonal().norm();
    const double distance = distance_outside(box_, base_.mesh, flows_);
    if (!(distance <= allowed)) {
        fail(Property::Box, number(distance / diagonal) + " diagonals outside, allowed " +
                                number(allowed / diagonal));
    }
}

void Checker::check_distance_from_membrane() {
    Case flat = case_;
    flat.fair->continuity = Continuity::Position;
    const Run membrane = run(flat);
    const double diagonal = box_.diagonal().norm();
    double farthest = 0;
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        if (!flows_[i]) continue;
        const Eigen::Vector3d away = base_.mesh.positions[i] - membrane.mesh.positions[i];
        farthest = std::max(farthest, away.norm());
    }
    if (!(farthest <= kFairMargin * diagonal)) {
        fail(Property::Box, number(farthest / diagonal) + " diagonals from the membrane, allowed " +
                                number(kFairMargin));
    }
}

/// A step of order 1 minimises ½ d·D d + δ E(x + d), with the Dirichlet energy E for the metric of
/// the surface x, or of the initial surface. E(x) is the area of x, and at least the area in any
/// other metric. So the area does not exceed the initial one, with any quadrature, and with any
/// solver that only lowers the energy. Besides, there are
/// - with the paper's method, single precision: 1e-5 of the area;
/// - on the mesh, triangles that are longer in the metric than in space: a step that multiplies
///   the area by more than kMostGrowth of mesh_flow.cpp is refused, with Stop::Grew. The test
///   allows this factor once for the whole flow;
/// - the coordinates of the paper's samples, which are multiples of 5e-7 of a cell; on the mesh,
///   single precision has about as much of an edge. So the area of a triangle changes by that times
///   its longest side.
///
/// With the paper's method, the tracked surface obeys this, and the mesh does not: only the corners
/// of a triangle that the flow bends are in the mesh. The other filters lower other energies, which
/// bound no area.
void Checker::check_area() {
    if (!case_.makes_flow()) return;
    const FlowReport& report = base_.report;
    const FlowParameters& parameters = case_.parameters;
    if (parameters.order > 1 || parameters.preserve != Preserve::None) return;
    const bool is_paper = parameters.method == Method::Paper;
    const double unit = 1e-6 * std::max(report.cell_size, report.mean_edge);
    const double rounding = unit * sum_of_sides(case_.mesh, case_.inputs.selection);
    std::vector<double> areas;
    areas.reserve(report.steps.size() + 1);
    for (const StepReport& step : report.steps) areas.push_back(step.area);
    if (!is_paper) areas.push_back(report.area_after);
    for (const double area : areas) {
        const double times = area / areas.front();
        if (area <= (is_paper ? 1 + 1e-5 : 1.001) * areas.front() + rounding) continue;
        return fail(Property::Area, number(times) + " times");
    }
}

/// Noise adds to an area. So the area before is that of the triangles seen along their normals
/// afterwards, all of the surface together. A warning is due from 3 % for a part, so 4 % of all of
/// it need one. Where noise folds a surface, or the boundary is smoothed, no area is known.
void Checker::check_loss() {
    if (!case_.noise || base_.is_loss_told) return;
    double before = 0, after = 0, all = 0;
    const double unit = box_.diagonal().norm();
    const auto area_of = [unit](const TriangleMesh& mesh, const Triangle& t) {
        const auto [a, b, c] = corners_of(mesh.positions, t);
        return twice_vector_area(a / unit, b / unit, c / unit);
    };
    for (std::size_t i = 0; i < case_.mesh.triangles.size(); ++i) {
        if (!case_.inputs.selection.empty() && case_.inputs.selection[i] == 0) continue;
        const Triangle& t = case_.mesh.triangles[i];
        const Eigen::Vector3d old = area_of(case_.mesh, t), present = area_of(base_.mesh, t);
        before += present.isZero(0) ? old.norm() : old.dot(present.stableNormalized());
        after += present.norm();
        all += old.norm();
    }
    if (all < 1e-9) return;  // a line
    if (after < 0.96 * before) {
        fail(Property::Loss, number(1 - after / before) + " of the area");
    }
    const bool is_closed = !std::isnan(base_.report.volume_before);
    const double change = base_.report.volume_change / base_.report.volume_before;
    // Rounding is all that a flat surface encloses.
    const double volume = base_.report.volume_before / std::pow(unit, 3);
    const bool is_flat = std::abs(volume) < 1e-6 * std::pow(all, 1.5);
    if (is_closed && !is_flat && std::abs(change) > 0.04) {
        fail(Property::Loss, number(change) + " of the volume");
    }
}

void Checker::check_unmoved() {
    const std::vector<bool> held = held_vertices(case_);
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        const bool moves = flows_[i] && !held[i];
        if (moves || same_bits(base_.mesh.positions[i], case_.mesh.positions[i])) continue;
        fail(Property::Unmoved, "vertex " + std::to_string(i));
        return;
    }
}

void Checker::check_threads() {
    for (const int threads : {1, 2, 3, 8}) {
        const Run other = run(case_, threads);
        if (other.refusal == base_.refusal && other.foreign == base_.foreign &&
            same_bits(other.mesh.positions, base_.mesh.positions) &&
            other.report.quality == base_.report.quality) {
            continue;
        }
        fail(Property::Threads, std::to_string(threads) + " threads");
        return;
    }
}

}  // namespace

Outcome check(const Case& checked, bool all_properties, Random& random) {
    return Checker(checked, random).check(all_properties);
}

}  // namespace tracked_mcf::zoo
