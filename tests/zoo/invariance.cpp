// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/invariance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/mesh/weld.h"
#include "tests/support/shapes.h"
#include "tests/zoo/reports.h"

namespace tracked_mcf::zoo {

namespace {

/// Returns the numbers from 0 to count - 1.
std::vector<std::int32_t> counted(std::size_t count) {
    std::vector<std::int32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

void shuffle(std::vector<std::int32_t>& items, Random& random) {
    for (auto i = static_cast<int>(items.size()); i > 1; --i) {
        std::swap(items[i - 1], items[random.below(i)]);
    }
}

/// Returns whether the same flow of an equal mesh should give an equal result: every system was
/// solved, and no decision was made that rounding could turn.
bool is_regular(const Case& made, const FlowReport& report) {
    if (!made.makes_flow()) return true;
    if (report.stop != Stop::None) return false;
    return std::all_of(report.steps.begin(), report.steps.end(), [](const StepReport& step) {
        return step.reached_tolerance && step.collapsed_samples == 0;
    });
}

/// Runs a case in other forms and collects failures.
class Invariance {
public:
    Invariance(const Case& checked, const Run& base, Random& random)
        : case_(checked),
          base_(base),
          random_(random),
          flows_(vertices_of(checked.mesh, checked.inputs.selection)),
          box_(box_of(checked.mesh, flows_)) {}

    std::vector<Failure> check() {
        check_scale();
        check_order();
        check_soup();
        check_translation();
        return std::move(failures_);
    }

private:
    void fail(Property property, const std::string& what) { failures_.push_back({property, what}); }

    void check_scale();
    void check_order();
    void check_soup();
    void check_translation();
    double difference(const Case& base, const Run& base_run, const Case& other,
                      const Run& other_run, const std::vector<std::int32_t>& vertex_of) const;
    double effect_of_rounding(const Case& base, const Run& base_run);
    void compare(Property property, const Case& base, const Run& base_run, const Case& other,
                 const std::vector<std::int32_t>& vertex_of);

    const Case& case_;
    const Run& base_;
    Random& random_;
    std::vector<bool> flows_;  ///< per vertex
    Eigen::AlignedBox3d box_;  ///< of the vertices that flow
    std::vector<Failure> failures_;
};

/// A power of two scales all numbers without rounding, unless they leave the range of doubles.
void Invariance::check_scale() {
    const double unit = std::ldexp(1.0, random_.integer(1, 20));
    constexpr double largest_side = 1e60;  // that evolve() accepts
    if (box_.sizes().maxCoeff() * unit > largest_side) return;
    Case scaled = case_;
    for (Eigen::Vector3d& position : scaled.mesh.positions) position *= unit;
    if (scaled.noise) {
        scaled.noise->noise *= unit;
        scaled.noise->noise_size *= unit;
        scaled.noise->detail_size *= unit;
        scaled.noise->largest_movement *= unit;
    }
    scaled.parameters.detail_size *= unit;
    scaled.parameters.step_size *= unit * unit;
    const Run other = run(scaled);
    if (!other.made()) {
        fail(Property::Scale, "by " + number(unit) + ": refused: " + other.refusal + other.foreign);
        return;
    }
    constexpr double rounding = 1e-9;
    const double size = box_.diagonal().norm();
    const std::string differing =
        differing_number(base_.values, other.values, unit, size, rounding, false);
    if (!differing.empty()) fail(Property::Report, "by " + number(unit) + ": " + differing);
    // Denormal numbers are rounded; by the equation of a smooth rim, once for each of its sides.
    const bool is_smooth = case_.noise && case_.noise->boundary == NoiseBoundary::Smooth;
    const double sides = is_smooth ? 3.0 * static_cast<double>(case_.mesh.triangles.size()) : 1;
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        const Eigen::Vector3d expected = unit * base_.mesh.positions[i];
        if (!flows_[i] || (other.mesh.positions[i] - expected).lpNorm<Eigen::Infinity>() <=
                              unit * sides * std::numeric_limits<double>::denorm_min()) {
            continue;
        }
        fail(Property::Scale, "by " + number(unit) + ": vertex " + std::to_string(i));
        return;
    }
}

/// Returns how far apart two runs move a vertex that flows, at most, mesh units. Vertex i of
/// `other` is the vertex vertex_of[i] of `base`.
double Invariance::difference(const Case& base, const Run& base_run, const Case& other,
                              const Run& other_run,
                              const std::vector<std::int32_t>& vertex_of) const {
    double largest = 0;
    for (std::size_t i = 0; i < vertex_of.size(); ++i) {
        const std::int32_t j = vertex_of[i];
        if (!flows_[j]) continue;
        const Eigen::Vector3d d = base_run.mesh.positions[j] - base.mesh.positions[j];
        const Eigen::Vector3d e = other_run.mesh.positions[i] - other.mesh.positions[i] - d;
        largest = std::max(largest, e.norm());
    }
    return largest;
}

/// Returns the largest difference() to eight runs that move each position by up to the rounding of
/// clipping, 2^-30 of a cell. The removal of noise rounds to single precision, and chooses among a
/// few candidates: 32 runs find those that are as good. Coincident vertices stay coincident.
double Invariance::effect_of_rounding(const Case& base, const Run& base_run) {
    const std::vector<std::int32_t> first =
        weld_coincident_vertices(base.mesh, referenced_vertices(base.mesh));
    const double rounding = !base.makes_flow() ? std::ldexp(box_.diagonal().norm(), -24)
                                               : std::ldexp(base_run.report.cell_size, -30);
    double largest = 0;
    for (int i = 0; i < (base.makes_flow() ? 8 : 32); ++i) {
        Case moved = base;
        std::vector<Eigen::Vector3d>& at = moved.mesh.positions;
        for (Eigen::Vector3d& position : at) position += rounding * random_.point();
        for (std::size_t j = 0; j < at.size(); ++j) at[j] = at[first[j]];
        const Run moved_run = run(moved);
        if (!moved_run.made() || !is_regular(base, moved_run.report)) continue;
        largest =
            std::max(largest, difference(base, base_run, moved, moved_run, counted(at.size())));
    }
    return largest;
}

/// Compares `base` with a case whose vertex i is the vertex vertex_of[i] of `base`. Both are solved
/// to the tolerance, in the energy norm. No bound for single vertices follows, but their errors are
/// of the same order: ten times the tolerance for each solve of a step. The W-cycle makes the same
/// error in both. Single precision adds 1e-5 of the diagonal.
///
/// Some flows magnify rounding errors by more than that:
/// - only its mass holds a surface much smaller than √δ in its place, and rounding errors of the
///   stiffness move it by up to 6e-8 δ cells, with δ in squared cells, and further once its mass
///   has shrunk;
/// - scaling a surface that is much smaller than a cell scales its rounding errors, too;
/// - triangles much thinner than a cell may make the system nearly singular.
/// Such a flow magnifies a rounding of its input as much, so the bound is measured: four times the
/// largest effect of eight roundings.
void Invariance::compare(Property property, const Case& base, const Run& base_run,
                         const Case& other, const std::vector<std::int32_t>& vertex_of) {
    const Run other_run = run(other);
    if (base_run.made() != other_run.made()) {
        fail(property, "refused: " + base_run.refusal + other_run.refusal);
        return;
    }
    if (!base_run.made()) return;
    // On both sides of a crack, vertices take the strength of the first.
    const bool is_joined = base_run.report.cracks.joined_vertices > 0;
    if (property == Property::Order && is_joined && !base.inputs.strength.empty()) return;
    const FlowParameters& parameters = base.parameters;
    if (!is_regular(base, base_run.report) || !is_regular(base, other_run.report)) return;
    const double distance = difference(base, base_run, other, other_run, vertex_of);
    // Scaling multiplies the error of the step before it.
    const double solves = parameters.order * (parameters.preserve == Preserve::None ? 1 : 4);
    const double diagonal = box_.diagonal().norm();
    const double furthest = base_run.report.largest_displacement;
    double allowed = 10 * solves * parameters.tolerance * furthest + 1e-5 * diagonal;
    if (distance <= allowed) {
        if (property != Property::Order) return;
        const std::string differing =
            differing_number(base_run.values, other_run.values, 1, diagonal,
                             1e-4 + 10 * solves * parameters.tolerance, true);
        if (!differing.empty()) fail(Property::Report, differing);
        return;
    }
    allowed = std::max(allowed, 4 * effect_of_rounding(base, base_run));
    if (distance <= allowed) return;
    fail(property,
         number(distance / diagonal) + " diagonals, allowed " + number(allowed / diagonal));
}

void Invariance::check_order() {
    std::vector<std::int32_t> vertex_of = counted(flows_.size());
    std::vector<std::int32_t> triangle_of = counted(case_.mesh.triangles.size());
    shuffle(vertex_of, random_);
    shuffle(triangle_of, random_);
    std::vector<std::int32_t> new_index(vertex_of.size());
    Case other = case_;
    for (std::size_t i = 0; i < vertex_of.size(); ++i) {
        new_index[vertex_of[i]] = static_cast<std::int32_t>(i);
        other.mesh.positions[i] = case_.mesh.positions[vertex_of[i]];
        if (!case_.inputs.strength.empty())
            other.inputs.strength[i] = case_.inputs.strength[vertex_of[i]];
    }
    for (std::size_t i = 0; i < triangle_of.size(); ++i) {
        const Triangle& t = case_.mesh.triangles[triangle_of[i]];
        other.mesh.triangles[i] = {new_index[t[0]], new_index[t[1]], new_index[t[2]]};
        if (!case_.inputs.selection.empty())
            other.inputs.selection[i] = case_.inputs.selection[triangle_of[i]];
    }
    // Where a surface has one side, a seam counts as a crease, and which one depends on the order.
    // The normals of triangles on a line are rounding.
    if (case_.noise && (case_.kind == "moebius" || case_.kind == "one_line")) return;
    compare(Property::Order, case_, base_, other, vertex_of);
}

/// A soup, in which each triangle has vertices of its own, is the same surface.
void Invariance::check_soup() {
    Case other = case_;
    other.mesh = shapes::soup(case_.mesh);
    std::vector<std::int32_t> vertex_of;
    for (const Triangle& t : case_.mesh.triangles)
        vertex_of.insert(vertex_of.end(), t.begin(), t.end());
    if (!case_.inputs.strength.empty()) {
        other.inputs.strength.clear();
        for (const std::int32_t vertex : vertex_of)
            other.inputs.strength.push_back(case_.inputs.strength[vertex]);
    }
    if (case_.noise && (case_.kind == "moebius" || case_.kind == "one_line")) return;
    compare(Property::Order, case_, base_, other, vertex_of);
}

/// The coordinates are rounded to multiples of a unit first, so that the translated mesh has the
/// same shape to the bit. Triangles that are not selected go along, because a relative step size is
/// in proportion to the whole mesh.
void Invariance::check_translation() {
    const std::vector<bool> used = vertices_of(case_.mesh, {});
    const Eigen::AlignedBox3d box = box_of(case_.mesh, used);
    const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    const double unit = std::ldexp(1.0, std::ilogb(reach) - 30);
    const Eigen::Vector3d step = random_.offset(1e3, 1e10).array().round() * unit;
    Case rounded = case_, translated = case_;
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        if (!used[i]) continue;
        rounded.mesh.positions[i] = (case_.mesh.positions[i] / unit).array().round() * unit;
        translated.mesh.positions[i] = rounded.mesh.positions[i] + step;
    }
    compare(Property::Translation, rounded, run(rounded), translated, counted(flows_.size()));
}

}  // namespace

std::vector<Failure> check_invariance(const Case& checked, const Run& base, Random& random) {
    return Invariance(checked, base, random).check();
}

}  // namespace tracked_mcf::zoo
