// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/fair/factorisation.h"
#include "filter_tracked_mcf/core/fair/patches.h"
#include "filter_tracked_mcf/core/mesh/change.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "filter_tracked_mcf/core/pi.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Points = Factorisation::Points;

/// Added to the squares of a triangle's sides, relative to the largest: triangles without area get
/// finite weights.
constexpr double kThickening = 1e-6;
/// The same for the first membrane. Then no weight is negative, so the membrane stays in the convex
/// hull of its seam.
constexpr double kRoundThickening = 1;

/// A patch may be this far from its membrane, relative to the size of the hole.
constexpr double kFarthest = 1;
/// Smaller changes of the shape are none, in the same unit. A pass that makes one is the last.
constexpr double kDone = 5e-4;
/// Passes for each continuity. The first metric is that of less continuity. Each pass divides the
/// error of the metric by 3 to 30, so two do not suffice for large holes.
constexpr int kPasses = 5;
/// A system is solved if a further solve for its residual moves no vertex farther than this, in the
/// same unit.
constexpr double kSolved = 1e-5;
/// Most iterations of conjugate gradients. With the factors of the same metric, rounding needs 2 or
/// 3: the condition number of the equation of curvature is that of L to the third power. With those
/// of the pass before, these take less time than new factors of a large patch.
constexpr int kSolves = 15;
/// A vertex with a smaller mass than this, relative to the squared size of the hole, has no
/// curvature but rounding.
constexpr double kCollapsed = 1e-9;
/// Surroundings are rough if their turn from vertex to vertex, over the radius of the hole, makes
/// so many times the rise of the patch. With holes cut into scans, this told best where the
/// membrane was closer.
constexpr double kRough = 5;

/// Bytes for each vertex and each triangle of the mesh, and for each vertex that moves.
constexpr double kBytesPerVertexOfPatches = 60, kBytesPerTriangleOfPatches = 90,
                 kBytesPerMoving[] = {1300, 3200, 6500};  // by continuity

/// The integral of the squared mean curvature over the area of some vertices.
struct Bending {
    double squares = 0, area = 0;
    std::int64_t vertices = 0;

    /// Returns the RMS.
    double curvature() const { return area > 0 ? std::sqrt(squares / area) : 0; }
    /// Returns the RMS angle by which the surface turns from vertex to vertex.
    double turn() const {
        return vertices > 0 ? std::sqrt(squares / static_cast<double>(vertices)) : 0;
    }
    void operator+=(const Bending& other) {
        squares += other.squares;
        area += other.area;
        vertices += other.vertices;
    }
};

/// Returns the diameter of the smallest ball around points, up to 1 %, by the method of Badoiu and
/// Clarkson; and its centre.
std::pair<double, Eigen::RowVector3d> ball_around(const Points& points) {
    Eigen::RowVector3d centre = points.colwise().mean();
    constexpr int steps = 100;
    for (int i = 1;; ++i) {
        Eigen::Index farthest = 0;
        const double square =
            (points.rowwise() - centre).rowwise().squaredNorm().maxCoeff(&farthest);
        if (i == steps) return {2 * std::sqrt(square), centre};
        centre += (points.row(farthest) - centre) / (i + 1);
    }
}

/// The equation of a patch, and its solution.
class Fairing {
public:
    Fairing(const Patch& patch, Points positions)
        : patch_(patch), positions_(std::move(positions)), membrane_(positions_) {
        std::tie(size_, centre_) =
            ball_around(positions_.middleRows(patch.moving, patch.held - patch.moving));
    }

    /// Solves the equation with as much of the continuity as the surroundings tell: the patch stays
    /// near the membrane, and every continuity changes it by no more than the one before. On a
    /// smooth surface, the changes decrease; noise and bad triangles add the more to them, the
    /// higher the derivatives are. Returns the continuity, or -1 if not even the membrane is found:
    /// then nothing moves.
    int solve(int continuity) {
        if (!find_membrane()) return -1;
        double change = std::numeric_limits<double>::infinity();
        for (int present = 1; present <= continuity; ++present) {
            const Points before = positions_;
            if (!converge(present) || distance(before) > change) {
                positions_ = before;
                return present - 1;
            }
            change = std::max(distance(before), kDone * size_);
        }
        return continuity;
    }

    const Points& positions() const { return positions_; }
    int passes() const { return made_; }
    /// Returns the largest distance from the membrane, relative to the size of the hole.
    double height() const {
        return std::sqrt((positions_ - membrane_).rowwise().squaredNorm().maxCoeff()) / size_;
    }

    /// Returns the bending of the patch, and of the second ring around it.
    std::pair<Bending, Bending> bending() {
        assemble(kThickening);
        const Points forces = stiffness_ * positions_;
        const auto of = [&](Eigen::Index begin, Eigen::Index end) {
            Bending sum;
            for (Eigen::Index i = begin; i < end; ++i) {
                if (weights_[i] > 0 && masses_[i] > kCollapsed * size_ * size_)
                    sum += {weights_[i] * forces.row(i).squaredNorm() / 4, masses_[i], 1};
            }
            return sum;
        };
        return {of(0, patch_.moving), of(patch_.held, patch_.inner)};
    }

    /// Returns whether the surroundings turn so much from vertex to vertex that chance alone may
    /// have made the patch rise from its membrane as it does.
    bool is_rough(const Bending& inside, const Bending& around) const {
        const double radius = std::sqrt(inside.area / kPi);
        return around.turn() * radius > kRough * std::max(distance(membrane_), kDone * size_);
    }

private:
    /// Moves the patch to its membrane in the metric of the given positions. Returns false if that
    /// fails.
    bool find_membrane() {
        bool is_found = false;
        for (const double thickening : {kThickening, kRoundThickening}) {
            positions_ = membrane_;
            is_factorised_ = false;
            assemble(thickening);
            is_found = step(0);
            if (is_found && is_in_hole()) break;
        }
        membrane_ = positions_;
        return is_found;
    }

    /// Solves the equation in the metric of the result. Returns false if there is no solution near
    /// the membrane.
    bool converge(int continuity) {
        is_factorised_ = false;
        for (int pass = 0; pass < kPasses; ++pass) {
            const Points before = positions_;
            assemble(kThickening);
            if (!step(continuity) || height() > kFarthest) return false;
            ++made_;
            // Vertices slide along the surface in each pass, for there the equation has no
            // solution.
            if (distance_along_normals(before) <= kDone * size_) break;
        }
        return true;
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

    /// Returns the matrix of product() for the vertices that move, with their rows of L.
    Eigen::SparseMatrix<double> matrix(int continuity) const {
        const Matrix rows = stiffness_.topRows(patch_.moving);
        if (continuity == 0) return rows.leftCols(patch_.moving);
        Matrix left = rows * weights_.asDiagonal();
        for (int i = 1; i < continuity; ++i) {
            poll_progress();
            left = Matrix(left * stiffness_) * weights_.asDiagonal();
        }
        poll_progress();
        return left * Matrix(rows.transpose());
    }

    /// Moves the vertices to the solution. Returns false if none is found. Mostly, the factors of
    /// the pass before suffice.
    bool step(int continuity) {
        if (is_factorised_ && solve_with_factors(continuity)) return true;
        const Eigen::SparseMatrix<double> equation = matrix(continuity);
        poll_progress();
        if (!is_factorised_) factors_.analyse(equation);
        is_factorised_ = factors_.factorise(equation);
        return is_factorised_ && solve_with_factors(continuity);
    }

    /// Moves the vertices to the solution by conjugate gradients, which the factors precondition.
    /// Returns false and moves none if the result is not good. The coordinates share the step
    /// lengths, so the result turns with the mesh.
    bool solve_with_factors(int continuity) {
        const Points before = positions_;
        Points direction = Points::Zero(positions_.rows(), 3);
        auto moving = direction.topRows(patch_.moving);
        double square = 0;
        for (int i = 0; i < kSolves; ++i) {
            const Points residual = -product(continuity, positions_);
            const Points solved = factors_.solve(residual);
            const double farthest = std::sqrt(solved.rowwise().squaredNorm().maxCoeff());
            if (farthest <= kSolved * size_) return true;
            const double previous = square;
            square = residual.cwiseProduct(solved).sum();
            moving = (solved + (i == 0 ? 0 : square / previous) * moving).eval();
            const double curvature = moving.cwiseProduct(product(continuity, direction)).sum();
            if (!(square > 0) || !(curvature > 0)) break;
            positions_.topRows(patch_.moving) += square / curvature * moving;
        }
        positions_ = before;
        return false;
    }

    /// Returns whether the patch is in the ball around its seam.
    bool is_in_hole() const {
        const auto inside = positions_.topRows(patch_.moving).rowwise() - centre_;
        constexpr double margin = 1.01;
        return 2 * std::sqrt(inside.rowwise().squaredNorm().maxCoeff()) <= margin * size_;
    }

    /// Returns the RMS distance of the vertices that move from other positions of them.
    double distance(const Points& others) const {
        const auto moved = (positions_ - others).topRows(patch_.moving);
        return std::sqrt(moved.squaredNorm() / static_cast<double>(patch_.moving));
    }

    /// Returns the RMS of the part of this distance along the normals of the triangles.
    double distance_along_normals(const Points& others) const {
        double squares = 0, area = 0;
        for (const Triangle& t : patch_.triangles) {
            const Eigen::RowVector3d origin = positions_.row(t[0]);
            const Eigen::RowVector3d normal =
                (positions_.row(t[1]) - origin).cross(positions_.row(t[2]) - origin);
            const double twice_area = normal.norm();
            if (!(twice_area > 0)) continue;
            for (const std::int32_t i : t) {
                if (i >= patch_.moving) continue;
                const double along = normal.dot(positions_.row(i) - others.row(i));
                squares += along * along / twice_area;
                area += twice_area;
            }
        }
        return area > 0 ? std::sqrt(squares / area) : 0;
    }

    const Patch& patch_;
    Points positions_, membrane_;
    Eigen::RowVector3d centre_;  ///< of the hole
    double size_ = 0;            ///< diameter of the hole: see FairReport::height
    int made_ = 0;
    Matrix stiffness_;
    Eigen::VectorXd masses_, weights_;  ///< the weights are the diagonal of M⁻¹
    Factorisation factors_;
    bool is_factorised_ = false;
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
    const ProgressMeter meter(progress);
    validate(parameters);
    const ThreadTeam team(parameters.threads);
    const Stopwatch watch;
    enter_phase(0, "Finding the patches");
    validate(mesh, Inputs{selection, {}});
    const auto wanted = static_cast<int>(parameters.continuity);
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
                          kBytesPerMoving[wanted] / 2 * static_cast<double>(report.triangles),
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
    std::vector<std::uint8_t> moves(after.size(), 0);
    Bending inside, around;
    std::int64_t done = 0;
    for (const Patch& patch : patches) {
        enter_phase(0.1 + 0.85 * static_cast<double>(done) / static_cast<double>(report.vertices),
                    "Fairing");
        Fairing fairing(patch, points_of(patch, mesh, scale));
        if (fairing.solve(wanted) < wanted) ++report.flatter_patches;
        const Points before = points_of(patch, mesh, scale);
        for (std::int32_t i = 0; i < patch.moving; ++i) {
            const Eigen::Vector3d moved =
                scale * (fairing.positions().row(i) - before.row(i)).transpose();
            after[patch.vertices[i]] += moved;
            moves[patch.vertices[i]] = 1;
        }
        const auto [patch_bending, seam_bending] = fairing.bending();
        if (wanted > 0 && fairing.is_rough(patch_bending, seam_bending)) ++report.rough_patches;
        inside += patch_bending;
        around += seam_bending;
        report.height = std::max(report.height, fairing.height());
        report.iterations = std::max(report.iterations, fairing.passes());
        done += patch.moving;
    }
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Eigen::Vector3d moved = after[welded[i]] - mesh.positions[welded[i]];
        // Adding 0 to -0 would change its bits.
        if (welded[i] != static_cast<std::int32_t>(i) && !moved.isZero(0)) after[i] += moved;
    }
    report.patch_curvature = inside.curvature() / scale;
    report.seam_curvature = around.curvature() / scale;
    static_cast<ChangeReport&>(report) = change_of(mesh, after, moves, selection, false);
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
