// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

constexpr int kMostMeshIterations = 1000;

/// An octree is left if conjugate gradients with its V-cycle take as many iterations.
constexpr int kMostWithOctree = 200;

/// Below this fraction of its initial norm, a residual from recurrences in single precision differs
/// from the true residual.
constexpr double kSinglePrecision = 1e-5;

/// A round of refinement makes progress if it reduces the error by this factor.
constexpr double kWorthRefining = 0.5;

/// Returns the power of two by which a right-hand side of this norm is divided: conjugate gradients
/// square numbers, and single precision loses the squares of very small and large ones.
double power_of_two_of(double norm) {
    constexpr int most = 126;  // so that the inverse is a float, too
    return norm > 0 && std::isfinite(norm) ? std::exp2(std::clamp(std::ilogb(norm), -most, most))
                                           : 1;
}

}  // namespace

MeshSolver::MeshSolver(const Stars& stars, const std::vector<std::uint8_t>& fixed,
                       const std::vector<std::int32_t>& components)
    : system_(stars, fixed), components_(components) {
    for (std::size_t i = 0; i < fixed.size(); ++i) {
        const auto component = static_cast<std::size_t>(components[i]);
        if (component >= is_held_.size()) is_held_.resize(component + 1);
        if (fixed[i] != 0) is_held_[component] = 1;
    }
}

void MeshSolver::use(std::unique_ptr<VertexOctree> octree) {
    octree_ = std::move(octree);
    multigrid_.emplace(octree_->levels());
}

void MeshSolver::mend_octree(double square) {
    if (square < 0 && multigrid_->widen_spectrum()) return;
    multigrid_.reset();
    octree_.reset();
}

double MeshSolver::begin(const Field& b) {
    for (;;) {
        r_ = b;
        const double square = precondition(0);
        if (!octree_ || square >= 0) return square;
        mend_octree(square);
    }
}

void MeshSolver::take(const TriangleElements& elements, double step_size, bool takes_stiffness) {
    system_.take(elements, step_size, takes_stiffness);
    if (!octree_) return;
    octree_->assemble(system_, elements, matrices_);
    const double cell = octree_->cell_size();
    multigrid_->refresh(matrices_, step_size / (cell * cell));
}

void MeshSolver::remove_drift(std::vector<Eigen::Vector3d>& x) const {
    struct Sums {
        Eigen::Vector3d residual = Eigen::Vector3d::Zero();
        double mass = 0;
    };
    std::vector<Sums> sums(is_held_.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto vertex = static_cast<std::int32_t>(i);
        Sums& of_component = sums[components_[i]];
        of_component.residual += r_.col(vertex).head<3>().cast<double>();
        of_component.mass += double{system_.mass(vertex)};
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (is_held_[i] != 0) sums[i].residual.setZero();
    }
    parallel_for_rows(static_cast<std::int64_t>(x.size()), [&](std::int32_t i) {
        const Sums& of_component = sums[components_[i]];
        x[i] += of_component.residual / of_component.mass;
    });
}

double MeshSolver::precondition(float step) {
    const double square = parallel_sum(r_.cols(), 0.0, [&](std::int64_t begin, std::int64_t end) {
        if (step != 0) {
            for (auto row = begin; row < end; ++row) {
                x_.col(row) += step * p_.col(row);
                r_.col(row) -= step * q_.col(row);
            }
        }
        return system_.relax(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end), r_,
                             z_);
    });
    if (!octree_) return square;
    octree_->restrict(r_, coarse_b_);
    multigrid_->cycle(coarse_b_, coarse_x_);
    octree_->add_prolongated(system_, coarse_x_, z_);
    const double coarse_square = dot(coarse_b_, coarse_x_).sum();
    return coarse_square < 0 ? coarse_square : square + coarse_square;
}

double MeshSolver::descend(double square, double limit, int& iterations) {
    const int most = octree_ ? iterations + kMostWithOctree : kMostMeshIterations;
    set_zero(x_, r_.cols());
    set_zero(p_, r_.cols());
    set_zero(q_, r_.cols());
    const double start = square;
    float keep = 0;
    while (square > limit && iterations < most) {
        const double energy = system_.advance(z_, keep, p_, q_);
        if (!(energy > 0)) break;
        ++iterations;
        const double before = square;
        square = precondition(static_cast<float>(square / energy));
        keep = static_cast<float>(square / before);
        // Every iteration reduces the error by about the same factor.
        if (square > 0) advance_progress(std::log(start / square) / std::log(start / limit));
    }
    return square;
}

MeshConvergence MeshSolver::solve(const Field& b, double tolerance,
                                  std::vector<Eigen::Vector3d>& x) {
    MeshConvergence result;
    result.residual_before = norm(b);
    const double unit = power_of_two_of(result.residual_before);
    Field scaled = static_cast<float>(1 / unit) * b;
    z_.resize(4, scaled.cols());
    x.assign(static_cast<std::size_t>(scaled.cols()), Eigen::Vector3d::Zero());
    double first = begin(scaled);
    const bool refines = tolerance < kSinglePrecision;
    double square = first;
    const auto goal = [&] { return tolerance * tolerance * first; };
    while (square > goal()) {
        const double before = square;
        constexpr double reach = kSinglePrecision * kSinglePrecision;
        const double limit = refines ? std::max(goal(), reach * square) : goal();
        square = descend(square, limit, result.iterations);
        parallel_for_rows(
            r_.cols(), [&](std::int32_t row) { x[row] += x_.col(row).head<3>().cast<double>(); });
        const bool octree_fails = octree_ && !(square >= 0 && square <= limit);
        if (octree_fails) {
            mend_octree(square);
            first = begin(scaled);
        } else if (!refines || result.iterations >= kMostMeshIterations) {
            break;
        }
        system_.residual(scaled, x, r_);
        square = precondition(0);
        if (octree_fails) continue;
        if (!(square < kWorthRefining * kWorthRefining * before)) break;
    }
    remove_drift(x);
    parallel_for_rows(r_.cols(), [&](std::int32_t row) { x[row] *= unit; });
    result.error_estimate = first > 0 ? std::sqrt(square / first) : std::sqrt(first);
    result.residual_after = unit * norm(r_);
    return result;
}

}  // namespace tracked_mcf
