// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair/fairing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

using Points = Fairing::Points;

/// Added to the squares of a triangle's sides, relative to the largest: triangles without area get
/// finite weights.
constexpr double kThickening = 1e-6;
/// The same for the first membrane. Then no weight is negative, so the membrane stays in the convex
/// hull of its seam.
constexpr double kRoundThickening = 1;
/// Added to the squares, too, so that the area of no triangle underflows to 0. The mesh has size 1.
constexpr double kSmallestSquare = 1e-140;
/// If the squared size of a hole is less, the masses of its vertices come from kSmallestSquare
/// alone.
constexpr double kSmallestHole = 1e-120;

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

}  // namespace

Fairing::Fairing(const Patch& patch, Points positions)
    : patch_(patch), positions_(std::move(positions)), membrane_(positions_) {
    std::tie(size_, centre_) =
        ball_around(positions_.middleRows(patch.moving, patch.held - patch.moving));
}

int Fairing::solve(int continuity) {
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

std::pair<Bending, Bending> Fairing::bending() {
    assemble(kThickening);
    const Points forces = stiffness_ * positions_;
    const double collapsed = kCollapsed * std::max(size_ * size_, kSmallestHole);
    const auto of = [&](Eigen::Index begin, Eigen::Index end) {
        Bending sum;
        for (Eigen::Index i = begin; i < end; ++i) {
            if (weights_[i] > 0 && masses_[i] > collapsed)
                sum += {weights_[i] * forces.row(i).squaredNorm() / 4, masses_[i], 1};
        }
        return sum;
    };
    return {of(0, patch_.moving), of(patch_.held, patch_.inner)};
}

bool Fairing::is_rough(const Bending& inside, const Bending& around) const {
    const double radius = std::sqrt(inside.area / kPi);
    return around.turn() * radius > kRough * std::max(distance(membrane_), kDone * size_);
}

bool Fairing::find_membrane() {
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

bool Fairing::converge(int continuity) {
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

void Fairing::assemble(double thickening) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(12 * patch_.triangles.size());
    masses_.setZero(positions_.rows());
    for (const Triangle& t : patch_.triangles) {
        SquaredSides<double> squares;
        for (int k = 0; k < 3; ++k) {
            squares[k] =
                (positions_.row(t[(k + 1) % 3]) - positions_.row(t[(k + 2) % 3])).squaredNorm();
        }
        squares += thickening * squares.maxCoeff() + kSmallestSquare;
        const auto element = triangle_element(squares, four_areas_of(squares));
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
            const double weight = element.weights[k];
            entries.emplace_back(a, a, weight);
            entries.emplace_back(b, b, weight);
            entries.emplace_back(a, b, -weight);
            entries.emplace_back(b, a, -weight);
            masses_[t[k]] += element.mass;
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

Fairing::Points Fairing::product(int continuity, const Points& x) const {
    Points result = stiffness_ * x;
    for (int i = 0; i < continuity; ++i) {
        result.array().colwise() *= weights_.array();
        result = (stiffness_ * result).eval();
    }
    return result.topRows(patch_.moving);
}

Eigen::SparseMatrix<double> Fairing::matrix(int continuity) const {
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

bool Fairing::step(int continuity) {
    if (is_factorised_ && solve_with_factors(continuity)) return true;
    const Eigen::SparseMatrix<double> equation = matrix(continuity);
    poll_progress();
    if (!is_factorised_) factors_.analyse(equation);
    is_factorised_ = factors_.factorise(equation);
    return is_factorised_ && solve_with_factors(continuity);
}

bool Fairing::solve_with_factors(int continuity) {
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

bool Fairing::is_in_hole() const {
    const auto inside = positions_.topRows(patch_.moving).rowwise() - centre_;
    constexpr double margin = 1.01;
    return 2 * std::sqrt(inside.rowwise().squaredNorm().maxCoeff()) <= margin * size_;
}

double Fairing::distance(const Points& others) const {
    const auto moved = (positions_ - others).topRows(patch_.moving);
    return std::sqrt(moved.squaredNorm() / static_cast<double>(patch_.moving));
}

double Fairing::distance_along_normals(const Points& others) const {
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

}  // namespace tracked_mcf
