// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <Eigen/Core>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <optional>

#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/patches.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Added to the squares of a triangle's sides, relative to the largest: triangles without area get
/// finite weights.
constexpr double kThickening = 1e-6;
/// The same for the first membrane. Then no weight is negative, so the membrane stays in the convex
/// hull of its seam.
constexpr double kRoundThickening = 1;

/// A patch may be this far from its membrane, relative to the size of the hole.
constexpr double kFarthest = 1;
/// A patch is done if an iteration moves no vertex farther than this, in the same unit.
constexpr double kDone = 1e-4;
/// Iterations with less continuity, which give a metric to begin with.
constexpr int kFirstIterations = 2;
/// Surroundings are rough if their curvature is so many times that of the patch.
constexpr double kRough = 3;

/// Conjugate gradients stop at this residual, relative to the first one. The next iteration in the
/// metric of the result removes what is left.
constexpr double kTolerance = 1e-3;
constexpr int kIterationLimit = 2000;

/// Bytes for each vertex and each triangle of the mesh, and for each vertex that moves.
constexpr double kBytesPerVertexOfPatches = 60, kBytesPerTriangleOfPatches = 90,
                 kBytesPerMoving = 1200;

/// The integral of the squared mean curvature over an area.
struct Bending {
    double squares = 0, area = 0;

    /// Returns the RMS.
    double curvature() const { return area > 0 ? std::sqrt(squares / area) : 0; }
    void operator+=(const Bending& other) {
        squares += other.squares;
        area += other.area;
    }
};

/// The equation of a patch, and its solution.
class Fairing {
public:
    Fairing(const Patch& patch, Points positions)
        : patch_(patch), positions_(std::move(positions)), membrane_(positions_) {
        const auto seam = positions_.middleRows(patch.moving, patch.held - patch.moving);
        centre_ = seam.colwise().mean();
        size_ = 2 * std::sqrt((seam.rowwise() - centre_).rowwise().squaredNorm().maxCoeff());
    }

    /// Solves the equation with as much of the continuity as leaves the patch near the membrane.
    /// Returns the continuity.
    int solve(int continuity, int iterations) {
        find_membrane();
        for (int present = 1; present <= continuity; ++present) {
            const int most = present < continuity ? kFirstIterations : iterations;
            for (int i = 0; i < most; ++i) {
                const Points before = positions_;
                assemble(kThickening);
                if (!step(present) || distance(membrane_) > kFarthest) {
                    positions_ = before;
                    if (i == 0) return present - 1;
                    break;
                }
                ++made_;
                if (distance(before) <= kDone) break;
            }
        }
        return continuity;
    }

    const Points& positions() const { return positions_; }
    int iterations() const { return made_; }
    /// Returns the largest distance from the membrane, relative to the size of the hole.
    double height() const { return distance(membrane_); }

    /// Returns the bending of the patch, and of the second ring around it.
    std::pair<Bending, Bending> bending() {
        assemble(kThickening);
        const Points forces = stiffness_ * positions_;
        const auto of = [&](Eigen::Index begin, Eigen::Index end) {
            Bending sum;
            for (Eigen::Index i = begin; i < end; ++i) {
                sum += {weights_[i] * forces.row(i).squaredNorm() / 4,
                        weights_[i] > 0 ? masses_[i] : 0};
            }
            return sum;
        };
        return {of(0, patch_.moving), of(patch_.held, patch_.inner)};
    }

private:
    /// Moves the patch to its membrane in the metric of the given positions.
    void find_membrane() {
        for (const double thickening : {kThickening, kRoundThickening}) {
            positions_ = membrane_;
            assemble(thickening);
            if (step(0) && is_in_hole()) break;
        }
        membrane_ = positions_;
    }

    /// Takes the metric of the positions.
    void assemble(double thickening) {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(12 * patch_.triangles.size());
        masses_.setZero(positions_.rows());
        for (const Triangle& t : patch_.triangles) {
            Eigen::Vector3d squares;
            for (int k = 0; k < 3; ++k) {
                squares[k] =
                    (positions_.row(t[(k + 1) % 3]) - positions_.row(t[(k + 2) % 3])).squaredNorm();
            }
            squares.array() += thickening * squares.maxCoeff();
            const double sum = squares.sum();
            const double four_areas = std::sqrt(sum * sum - 2 * squares.squaredNorm());
            for (int k = 0; k < 3; ++k) {
                const std::int32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
                const double weight = (sum - 2 * squares[k]) / (2 * four_areas);
                entries.emplace_back(a, a, weight);
                entries.emplace_back(b, b, weight);
                entries.emplace_back(a, b, -weight);
                entries.emplace_back(b, a, -weight);
                masses_[t[k]] += four_areas / 12;
            }
        }
        stiffness_.resize(positions_.rows(), positions_.rows());
        stiffness_.setFromTriplets(entries.begin(), entries.end());
        weights_.setZero(positions_.rows());
        for (Eigen::Index i = 0; i < patch_.inner; ++i) {
            // At a rim, L x / M is no curvature.
            if (i < patch_.moving || patch_.has_normal[i] != 0) weights_[i] = 1 / masses_[i];
        }
    }

    /// Returns the rows of (L M⁻¹)^continuity L x for the vertices that move.
    Points product(int continuity, const Points& x) const {
        Points result = stiffness_ * x;
        for (int i = 0; i < continuity; ++i) {
            result.array().colwise() *= weights_.array();
            result = (stiffness_ * result).eval();
        }
        return result.topRows(patch_.moving);
    }

    /// Solves (L M⁻¹)^continuity L x = b with the L and M of the vertices that move alone. This
    /// differs from the equation's matrix only near the seam, so it is a good preconditioner.
    Points precondition(int continuity, const Points& b) const {
        Points x = factors_.permutationP() * b;
        for (int i = 0;; ++i) {
            solve_factors(x);
            if (i == continuity) return factors_.permutationPinv() * x;
            x.array().colwise() *= permuted_masses_.array();
        }
    }

    /// Solves for three columns at once, which Eigen would do one after the other.
    void solve_factors(Points& x) const {
        const auto& lower = factors_.matrixL().nestedExpression();
        using Entry = Eigen::SparseMatrix<double>::InnerIterator;
        for (Eigen::Index j = 0; j < lower.cols(); ++j) {
            for (Entry i(lower, j); i; ++i) x.row(i.row()) -= i.value() * x.row(j);
        }
        x.array().colwise() /= factors_.vectorD().array();
        for (Eigen::Index j = lower.cols() - 1; j >= 0; --j) {
            for (Entry i(lower, j); i; ++i) x.row(j) -= i.value() * x.row(i.row());
        }
    }

    /// Moves the vertices by the solution, which conjugate gradients find. Returns false and moves
    /// none if there is none. The coordinates share the step lengths, so the result turns with the
    /// mesh.
    bool step(int continuity) {
        const Eigen::Index count = patch_.moving;
        const Eigen::SparseMatrix<double> inside = stiffness_.topLeftCorner(count, count);
        if (!analysed_) factors_.analyzePattern(inside);
        analysed_ = true;
        factors_.factorize(inside);
        if (factors_.info() != Eigen::Success) return false;
        permuted_masses_ = factors_.permutationP() * masses_.head(count).eval();

        Points residual = -product(continuity, positions_), moved = Points::Zero(count, 3);
        Points direction = Points::Zero(positions_.rows(), 3);
        double square = 0, limit = 0;
        for (int i = 0; i < kIterationLimit; ++i) {
            poll_progress();
            const Points solved = precondition(continuity, residual);
            const double before = square;
            square = residual.cwiseProduct(solved).sum();
            if (i == 0) limit = kTolerance * kTolerance * square;
            if (!(square > limit)) break;
            direction.topRows(count) =
                solved + (i == 0 ? 0 : square / before) * direction.topRows(count);
            const Points image = product(continuity, direction);
            const double length = square / direction.topRows(count).cwiseProduct(image).sum();
            moved += length * direction.topRows(count);
            residual -= length * image;
        }
        if (!moved.allFinite()) return false;
        positions_.topRows(count) += moved;
        return true;
    }

    /// Returns whether the patch is in the sphere around its seam but for rounding.
    bool is_in_hole() const {
        const auto inside = positions_.topRows(patch_.moving).rowwise() - centre_;
        return std::sqrt(inside.rowwise().squaredNorm().maxCoeff()) <= (0.5 + kDone) * size_;
    }

    /// Returns the largest distance from the vertices there, relative to the size.
    double distance(const Points& others) const {
        return std::sqrt((positions_ - others).rowwise().squaredNorm().maxCoeff()) / size_;
    }

    const Patch& patch_;
    Points positions_, membrane_;
    Eigen::RowVector3d centre_;  ///< of the hole
    double size_ = 0;            ///< diameter of the hole: see FairReport::height
    int made_ = 0;
    Matrix stiffness_;
    Eigen::VectorXd masses_, weights_;  ///< the weights are the diagonal of M⁻¹
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;  ///< of L of what moves
    Eigen::VectorXd permuted_masses_;
    bool analysed_ = false;
};

/// Returns the positions of the patch's vertices, from the first one, so that coordinates are
/// small.
Points points_of(const Patch& patch, const TriangleMesh& mesh, double scale) {
    Points points(static_cast<Eigen::Index>(patch.vertices.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        points.row(i) =
            (mesh.positions[patch.vertices[i]] - mesh.positions[patch.vertices[0]]) / scale;
    }
    return points;
}

}  // namespace

FairReport fair(TriangleMesh& mesh, const Selection& selection, const FairParameters& parameters,
                const Progress& progress) {
    std::optional<ProgressMeter> meter;
    if (progress) meter.emplace(progress);
    validate(parameters);
    const ThreadTeam team(parameters.threads);
    const Stopwatch watch;
    enter_phase(0, "Finding the patches");
    validate(mesh, Inputs{selection, {}});
    FairReport report;
    report.triangles = static_cast<std::int64_t>(selection.size()) -
                       std::count(selection.begin(), selection.end(), 0);
    if (report.triangles == static_cast<std::int64_t>(selection.size())) {
        throw InvalidMesh(
            "All faces are selected, so there is nothing around them to continue. Select the faces "
            "that fill the hole.");
    }
    check_free_memory(kBytesPerVertexOfPatches * static_cast<double>(mesh.positions.size()) +
                          kBytesPerTriangleOfPatches * static_cast<double>(mesh.triangles.size()) +
                          kBytesPerMoving / 2 * static_cast<double>(report.triangles),
                      "Fairing", "Select less, or simplify the mesh.");
    const double scale = longest_side(mesh);
    MeshTopology topology = topology_of(mesh);
    const std::vector<Patch> patches = patches_of(topology, selection);
    const std::vector<std::int32_t> welded = std::move(topology.welded);
    report.cracks = topology.cracks;
    topology = {};
    report.patches = static_cast<std::int64_t>(patches.size());
    for (const Patch& patch : patches) report.vertices += patch.moving;
    if (patches.empty()) {
        throw InvalidMesh(
            "The selected faces have no inner vertices, so nothing can move. Close Holes leaves "
            "long "
            "triangles: refine the selected faces first, such as by Isotropic Explicit Remeshing.");
    }

    std::vector<Eigen::Vector3d> after = mesh.positions;
    Bending inside, around;
    double squares = 0;
    std::int64_t done = 0;
    for (const Patch& patch : patches) {
        enter_phase(0.1 + 0.85 * static_cast<double>(done) / static_cast<double>(report.vertices),
                    "Fairing");
        Fairing fairing(patch, points_of(patch, mesh, scale));
        const auto wanted = static_cast<int>(parameters.continuity);
        if (fairing.solve(wanted, parameters.iterations) < wanted) ++report.flatter_patches;
        const Points before = points_of(patch, mesh, scale);
        for (std::int32_t i = 0; i < patch.moving; ++i) {
            const Eigen::Vector3d moved =
                scale * (fairing.positions().row(i) - before.row(i)).transpose();
            after[patch.vertices[i]] += moved;
            squares += moved.squaredNorm();
            report.largest_displacement = std::max(report.largest_displacement, moved.norm());
        }
        const auto [patch_bending, seam_bending] = fairing.bending();
        if (seam_bending.curvature() > kRough * patch_bending.curvature()) ++report.rough_patches;
        inside += patch_bending;
        around += seam_bending;
        report.height = std::max(report.height, fairing.height());
        report.iterations = std::max(report.iterations, fairing.iterations());
        done += patch.moving;
    }
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Eigen::Vector3d moved = after[welded[i]] - mesh.positions[welded[i]];
        // Adding 0 to -0 would change its bits.
        if (welded[i] != static_cast<std::int32_t>(i) && !moved.isZero(0)) after[i] += moved;
    }
    report.rms_displacement = std::sqrt(squares / static_cast<double>(report.vertices));
    report.patch_curvature = inside.curvature() / scale;
    report.seam_curvature = around.curvature() / scale;
    report.area_before = surface_area(mesh, selection);
    report.area_after = surface_area({after, mesh.triangles}, selection);
    if (parameters.quality == Quality::Displacement)
        report.quality = displacements_along_normals(mesh, after, selection);
    report.seconds = watch.seconds();
    report.peak_memory_bytes = peak_memory_bytes();
    enter_phase(1, "Done");
    // Nothing can fail from here on.
    mesh.positions.swap(after);
    return report;
}

}  // namespace tracked_mcf
