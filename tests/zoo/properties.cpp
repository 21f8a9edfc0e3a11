// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/properties.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow/confinement.h"
#include "filter_tracked_mcf/core/flow/preserving.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/process_time.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::zoo {

namespace {

struct Run {
    TriangleMesh mesh;
    FlowReport report;
    std::string refusal;  ///< message of an exception of errors.h
    std::string foreign;  ///< message of any other exception
    double cpu_seconds = 0;
    bool made() const { return refusal.empty() && foreign.empty(); }
};

/// Returns another filter's report as far as a flow's report says the same.
template <class Report>
FlowReport as_flow_report(Report made) {
    FlowReport report;
    report.area_before = made.area_before;
    report.area_after = made.area_after;
    report.largest_displacement = made.largest_displacement;
    report.rms_displacement = made.rms_displacement;
    report.quality = std::move(made.quality);
    return report;
}

FlowReport filtered(TriangleMesh& mesh, const Case& run_case, int threads) {
    if (run_case.noise) {
        NoiseParameters parameters = *run_case.noise;
        parameters.threads = threads;
        const NoiseReport made = remove_noise(mesh, run_case.inputs, parameters);
        FlowReport report = as_flow_report(made);
        report.detail_size = made.detail_size;
        report.volume_change = made.volume_change;
        return report;
    }
    if (run_case.fair) {
        FairParameters parameters = *run_case.fair;
        parameters.threads = threads;
        return as_flow_report(fair(mesh, run_case.inputs.selection, parameters));
    }
    FlowParameters parameters = run_case.parameters;
    parameters.threads = threads;
    return evolve(mesh, run_case.inputs, parameters);
}

Run run(const Case& run_case, int threads = 1) {
    Run made;
    made.mesh = run_case.mesh;
    const double start = cpu_seconds();
    try {
        made.report = filtered(made.mesh, run_case, threads);
    } catch (const Error& error) {
        made.refusal = error.what();
    } catch (const std::exception& error) {
        made.foreign = error.what();
    }
    made.cpu_seconds = cpu_seconds() - start;
    return made;
}

std::array<std::uint64_t, 3> bits_of(const Eigen::Vector3d& vector) {
    std::array<std::uint64_t, 3> bits{};
    std::memcpy(bits.data(), vector.data(), sizeof(bits));
    return bits;
}

/// Unlike ==, it distinguishes -0 from 0, and a NaN equals itself.
bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return bits_of(a) == bits_of(b);
}

bool same_bits(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& p, const auto& q) { return same_bits(p, q); });
}

/// Returns, per vertex, whether a selected triangle uses it.
std::vector<bool> vertices_of(const TriangleMesh& mesh, const Selection& selection) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) used[vertex] = true;
    }
    return used;
}

/// Returns, per vertex, whether it keeps its place though a selected triangle may use it: where the
/// strength is 0, and, for fair(), where a triangle that is not selected uses it, too.
std::vector<bool> held_vertices(const Case& of) {
    const TriangleMesh& mesh = of.mesh;
    std::vector<bool> held(mesh.positions.size(), false);
    for (std::size_t i = 0; i < of.inputs.strength.size(); ++i)
        held[i] = of.inputs.strength[i] == 0;
    if (!of.fair) return held;
    const std::vector<std::int32_t> first = weld_coincident_vertices(mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (of.inputs.selection[i] != 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) held[first[vertex]] = true;
    }
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = held[first[i]];
    return held;
}

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh, const std::vector<bool>& vertices) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (vertices[i]) box.extend(mesh.positions[i]);
    }
    return box;
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

/// Returns the case with every triangle split in four. The surface is the same.
Case split_in_four(const Case& coarse) {
    Case fine = coarse;
    fine.mesh = shapes::split_in_four(coarse.mesh);
    fine.inputs.selection.clear();
    for (const auto is_selected : coarse.inputs.selection)
        fine.inputs.selection.insert(fine.inputs.selection.end(), 4, is_selected);
    return fine;
}

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

/// Returns whether conjugate gradients solve the system as they say. With little stabilisation, it
/// is nearly singular. Beside a large one, single precision loses the rest of the system.
bool is_well_posed(const FlowParameters& parameters) {
    const double weight = stabilization_of(parameters);
    return weight >= 1e-3 && weight <= 10;
}

/// Returns whether the same flow of an equal mesh should give an equal result: every system was
/// solved, and no decision was made that rounding could turn.
bool is_regular(const Case& made, const FlowReport& report) {
    if (!made.makes_flow()) return true;
    const FlowParameters& parameters = made.parameters;
    if (parameters.solver == Solver::Converged && !is_well_posed(parameters)) return false;
    if (report.stop != Stop::None) return false;
    return std::all_of(report.steps.begin(), report.steps.end(), [](const StepReport& step) {
        return step.reached_tolerance && step.collapsed_samples == 0;
    });
}

std::string number(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

/// How far the removal of noise may take a vertex out of the box, in its diagonals.
const double kNoiseMargin = 0.1 * std::sqrt(3.0);
/// The same for fair(), which takes no vertex farther than the size of the hole from the membrane.
constexpr double kFairMargin = 1.001;

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
        if (all_properties && base_.made()) check_invariance();
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
    void check_area();
    void check_unmoved();
    void check_threads();
    void check_invariance();
    void check_scale();
    void check_order();
    void check_translation();
    double difference(const Case& base, const Run& base_run, const Case& other,
                      const Run& other_run, const std::vector<std::int32_t>& vertex_of) const;
    double effect_of_rounding(const Case& base, const Run& base_run);
    void compare(Property property, const Case& base, const Run& base_run, const Case& other,
                 const std::vector<std::int32_t>& vertex_of);

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

/// The slowest of 4,000 cases took a tenth of this.
void Checker::check_time() {
    if (!case_.makes_flow()) {
        return allow_time(0.5 + 2e-3 * static_cast<double>(case_.mesh.triangles.size()));
    }
    const double fragments =
        std::max(fragments_at(case_.mesh, case_.inputs.selection, case_.parameters.depth),
                 static_cast<double>(base_.report.fragments));
    const double size = static_cast<double>(case_.mesh.triangles.size()) + fragments;
    const FlowParameters& parameters = case_.parameters;
    const int cycles = parameters.solver == Solver::OneWCycle ? parameters.cycles : 1;
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
    check_unmoved();
}

void Checker::check_finite() {
    const FlowReport& report = base_.report;
    std::vector<double> numbers = {report.detail_size,          report.step_size,
                                   report.area_after,           report.volume_change,
                                   report.largest_displacement, report.rms_displacement};
    numbers.insert(numbers.end(), report.quality.begin(), report.quality.end());
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        if (flows_[i]) numbers.push_back(base_.mesh.positions[i].sum());
    }
    for (const StepReport& step : report.steps) {
        numbers.insert(numbers.end(), {step.area, step.error_estimate, step.residual_after});
    }
    const auto bad = std::count_if(numbers.begin(), numbers.end(),
                                   [](double result) { return !std::isfinite(result); });
    if (bad > 0) fail(Property::Finite, std::to_string(bad) + " numbers");
}

/// Both flows obey a maximum principle for each coordinate, which the grid's functions keep up to
/// the margin of flow/confinement.h. A surface that is scaled, or inflated by a pressure, keeps to
/// the cube of flow/preserving.cpp around each of its components.
///
/// Steps of fourth order, which remove noise, obey no maximum principle. They keep to a larger box,
/// see confinement() in core/noise/noisy_surface.h.
void Checker::check_box() {
    const FlowParameters& parameters = case_.parameters;
    const double diagonal = box_.diagonal().norm();
    if (case_.noise) return check_box_within(kNoiseMargin * diagonal);
    if (case_.fair) return check_box_within(kFairMargin * diagonal);
    double allowed = Confinement::kMarginInDiagonals * diagonal +
                     Confinement::kMarginInCells * base_.report.cell_size;
    if (parameters.order > 1) allowed += Confinement::kMarginInDetail * diagonal;
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

/// A step of order 1 minimises ½ d·D d + δ E(x + d), with the Dirichlet energy E for the metric of
/// the surface x, or of the initial surface. E(x) is the area of x, and at least the area in any
/// other metric. So the area does not exceed the initial one, with any quadrature, and with any
/// solver that only lowers the energy. Besides, there are
/// - single precision: 1e-5 of the area;
/// - the force that holds a boundary: it lags a step behind, and its work was at most 2.4e-4 of the
///   area in 4,000 cases.
///
/// The samples' coordinates are multiples of 5e-7 of a cell. So the area of a triangle changes by
/// that times its longest side.
///
/// The area of the mesh is not that of the tracked surface. Vertices are displaced by the samples'
/// coordinates again, and by
/// - the solver's tolerance in the energy norm, which for a single vertex may be a thousandth of
/// the
///   displacement, where a part is much thinner than a cell;
/// - a part of a cell beside constrained vertices, which keep their place while the functions of
///   their cell move.
/// A triangle that crosses several cells is bent there; only its corners are in the mesh. So the
/// area of a mesh that has grown is measured again with every triangle split in four.
///
/// The other filters lower other energies, which bound no area.
void Checker::check_area() {
    if (!case_.makes_flow()) return;
    const FlowReport& report = base_.report;
    const FlowParameters& parameters = case_.parameters;
    if (parameters.order > 1 || parameters.preserve != Preserve::None) return;
    const double factor = parameters.boundary == BoundaryCondition::Locked ? 1 + 1e-3 : 1 + 1e-5;
    const double sides = sum_of_sides(case_.mesh, case_.inputs.selection);
    for (const StepReport& step : report.steps) {
        const double before = report.steps.front().area;
        if (step.area <= factor * before + 1e-6 * report.cell_size * sides) continue;
        fail(Property::Area, "tracked surface: " + number(step.area / before) + " times");
        return;
    }
    const bool to_tolerance = parameters.solver == Solver::Converged && is_well_posed(parameters);
    const bool is_line = report.area_before < 1e-9 * box_.diagonal().norm() * sides;
    if (!to_tolerance || is_line || parameters.flow != FlowKind::MeanCurvature) return;
    const double in_cells = report.constrained_vertices > 0 ? 0.1 : 1e-6;
    const double error = in_cells * report.cell_size + 1e-3 * report.largest_displacement;
    const double allowed = 1.001 * report.area_before + error * sides;
    if (report.area_after <= allowed) return;
    const Run split = run(split_in_four(case_));
    if (split.made() && split.report.area_after <= allowed) return;
    fail(Property::Area, "mesh: " + number(report.area_after / report.area_before) +
                             " times, split in four " +
                             number(split.report.area_after / report.area_before));
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

void Checker::check_invariance() {
    check_scale();
    check_order();
    check_translation();
}

/// A power of two scales all numbers without rounding, unless they leave the range of doubles.
void Checker::check_scale() {
    const double unit = std::ldexp(1.0, random_.integer(1, 20));
    constexpr double largest_side = 1e60;  // that evolve() accepts
    if (box_.sizes().maxCoeff() * unit > largest_side) return;
    Case scaled = case_;
    for (Eigen::Vector3d& position : scaled.mesh.positions) position *= unit;
    if (scaled.noise) {
        scaled.noise->noise *= unit;
        scaled.noise->detail_size *= unit;
        scaled.noise->largest_movement *= unit;
    }
    scaled.parameters.detail_size *= unit;
    if (scaled.parameters.absolute) scaled.parameters.step_size *= unit * unit;
    const Run other = run(scaled);
    if (!other.made()) {
        fail(Property::Scale, "by " + number(unit) + ": refused: " + other.refusal + other.foreign);
        return;
    }
    for (std::size_t i = 0; i < flows_.size(); ++i) {
        const Eigen::Vector3d expected = unit * base_.mesh.positions[i];
        // Denormal numbers are rounded.
        if (!flows_[i] || (other.mesh.positions[i] - expected).lpNorm<Eigen::Infinity>() <=
                              unit * std::numeric_limits<double>::denorm_min()) {
            continue;
        }
        fail(Property::Scale, "by " + number(unit) + ": vertex " + std::to_string(i));
        return;
    }
}

/// Returns how far apart two runs move a vertex that flows, at most, mesh units. Vertex i of
/// `other` is the vertex vertex_of[i] of `base`.
double Checker::difference(const Case& base, const Run& base_run, const Case& other,
                           const Run& other_run, const std::vector<std::int32_t>& vertex_of) const {
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
/// few treatments: 32 runs find those that are as good. Coincident vertices stay coincident.
double Checker::effect_of_rounding(const Case& base, const Run& base_run) {
    const std::vector<std::int32_t> first = weld_coincident_vertices(base.mesh);
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
void Checker::compare(Property property, const Case& base, const Run& base_run, const Case& other,
                      const std::vector<std::int32_t>& vertex_of) {
    const Run other_run = run(other);
    if (base_run.made() != other_run.made()) {
        fail(property, "refused: " + base_run.refusal + other_run.refusal);
        return;
    }
    if (!base_run.made()) return;
    const FlowParameters& parameters = base.parameters;
    if (!is_regular(base, base_run.report) || !is_regular(base, other_run.report)) return;
    const double distance = difference(base, base_run, other, other_run, vertex_of);
    // Scaling multiplies the error of the step before it.
    const double solves = parameters.order * (parameters.preserve == Preserve::None ? 1 : 4);
    const double diagonal = box_.diagonal().norm();
    const double furthest = base_run.report.largest_displacement;
    double allowed = 10 * solves * parameters.tolerance * furthest + 1e-5 * diagonal;
    if (distance <= allowed) return;
    allowed = std::max(allowed, 4 * effect_of_rounding(base, base_run));
    if (distance <= allowed) return;
    fail(property,
         number(distance / diagonal) + " diagonals, allowed " + number(allowed / diagonal));
}

void Checker::check_order() {
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

/// The coordinates are rounded to multiples of a unit first, so that the translated mesh has the
/// same shape to the bit. Triangles that are not selected go along, because a relative step size is
/// in proportion to the whole mesh.
void Checker::check_translation() {
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

Outcome check(const Case& checked, bool all_properties, Random& random) {
    return Checker(checked, random).check(all_properties);
}

}  // namespace tracked_mcf::zoo
