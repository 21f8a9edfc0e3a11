// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
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

/// A negative product is rounding if it is less than this, relative to the whole.
constexpr double kRoundedProduct = 1e-5;

/// Returns the power of two by which a right-hand side of this norm is divided: conjugate gradients
/// square numbers, and single precision loses the squares of very small and large ones.
double power_of_two_of(double norm) {
    constexpr int most = 126;  // so that the inverse is a float, too
    return norm > 0 && std::isfinite(norm) ? std::exp2(std::clamp(std::ilogb(norm), -most, most))
                                           : 1;
}

double squared_norm(const PartBlocks::Block& block, const Field& field) {
    return field.middleCols(block.begin, block.end - block.begin).cast<double>().squaredNorm();
}

}  // namespace

MeshSolver::MeshSolver(const Stars& stars, const std::vector<std::uint8_t>& held,
                       const std::vector<std::int32_t>& parts)
    : system_(stars, held, parts),
      parts_(static_cast<std::size_t>(system_.blocks().part_count())),
      sums_(static_cast<std::size_t>(system_.blocks().count())) {
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (held[i] != 0) parts_[parts[i]].is_held = true;
    }
    const PartBlocks& blocks = system_.blocks();
    for (std::int32_t i = 0; i < blocks.count(); ++i) {
        const Block& block = blocks[i];
        const auto [first, last] = blocks.of_part(block.part);
        parts_[block.part].is_tiny =
            last - first == 1 && block.end - block.begin <= MeshSystem::kFewRows;
    }
}

void MeshSolver::use(std::unique_ptr<VertexOctree> octree) {
    octree_ = std::move(octree);
    multigrid_.emplace(octree_->levels());
    const PartBlocks& blocks = system_.blocks();
    for (std::int32_t part = 0; part < blocks.part_count(); ++part) {
        const std::int32_t vertex = blocks[blocks.of_part(part).first].begin;
        parts_[part].has_octree = octree_->has_functions(vertex);
    }
}

void MeshSolver::take(const TriangleElements& elements, double step_size, bool takes_stiffness) {
    system_.take(elements, step_size, takes_stiffness);
    if (!octree_) return;
    octree_->assemble(system_, elements, matrices_);
    const double cell = octree_->cell_size();
    multigrid_->refresh(matrices_, step_size / (cell * cell));
}

void MeshSolver::activate(Parts parts) {
    for (const std::int32_t part : active_) parts_[part].is_active = false;
    active_ = std::move(parts);
    active_chunks_.clear();
    const PartBlocks& blocks = system_.blocks();
    for (const std::int32_t part : active_) {
        parts_[part].is_active = true;
        const auto [first, last] = blocks.of_part(part);
        for (std::int32_t block = first; block < last; ++block) {
            const std::int32_t chunk = blocks[block].chunk;
            if (active_chunks_.empty() || active_chunks_.back() != chunk)
                active_chunks_.push_back(chunk);
        }
    }
}

template <class Chosen>
MeshSolver::Parts MeshSolver::choose(const Parts& parts, const Chosen& chosen) const {
    Parts result;
    std::copy_if(parts.begin(), parts.end(), std::back_inserter(result),
                 [&](std::int32_t part) { return chosen(parts_[part]); });
    return result;
}

template <class GoesOn>
void MeshSolver::keep_active(const GoesOn& goes_on) {
    Parts kept = choose(active_, goes_on);
    if (kept.size() < active_.size()) activate(std::move(kept));
}

template <class Body>
void MeshSolver::for_each_active(const Body& body) {
    const PartBlocks& blocks = system_.blocks();
    parallel_for(static_cast<std::int64_t>(active_chunks_.size()), [&](std::int64_t i) {
        const auto [first, last] = blocks.of_chunk(active_chunks_[i]);
        for (std::int32_t block = first; block < last; ++block) {
            const Part& part = parts_[blocks[block].part];
            if (part.is_active) body(part, block);
        }
    });
}

double MeshSolver::sum_of(std::int32_t part) const {
    const auto [first, last] = system_.blocks().of_part(part);
    return std::accumulate(sums_.begin() + first, sums_.begin() + last, 0.0);
}

double MeshSolver::scale(const Field& b) {
    const PartBlocks& blocks = system_.blocks();
    blocks.for_each([&](std::int32_t block) { sums_[block] = squared_norm(blocks[block], b); });
    for (std::int32_t part = 0; part < blocks.part_count(); ++part) {
        parts_[part].unit = power_of_two_of(std::sqrt(sum_of(part)));
    }
    b_.resize(4, b.cols());
    blocks.for_each([&](std::int32_t number) {
        const Block& block = blocks[number];
        const auto factor = static_cast<float>(1 / parts_[block.part].unit);
        const Eigen::Index rows = block.end - block.begin;
        b_.middleCols(block.begin, rows) = factor * b.middleCols(block.begin, rows);
    });
    return std::sqrt(std::accumulate(sums_.begin(), sums_.end(), 0.0));
}

void MeshSolver::begin() {
    for_each_active([&](const Part& /*part*/, std::int32_t number) {
        const Block& block = system_.blocks()[number];
        const Eigen::Index rows = block.end - block.begin;
        r_.middleCols(block.begin, rows) = b_.middleCols(block.begin, rows);
    });
    precondition_positively();
    for (const std::int32_t part : active_) parts_[part].first = parts_[part].square;
}

void MeshSolver::precondition_positively() {
    for (;;) {
        precondition(false);
        const Parts failed =
            choose(active_, [](const Part& part) { return part.has_octree && part.square < 0; });
        if (failed.empty()) return;
        mend_octree(failed);
    }
}

void MeshSolver::mend_octree(const Parts& failed) {
    const auto is_negative = [&](std::int32_t part) { return parts_[part].square < 0; };
    const bool widened =
        std::any_of(failed.begin(), failed.end(), is_negative) && multigrid_->widen_spectrum();
    for (const std::int32_t part : failed) {
        parts_[part].is_mended = true;
        if (!widened || !is_negative(part)) parts_[part].has_octree = false;
    }
    if (std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.has_octree; }))
        return;
    multigrid_.reset();
    octree_.reset();
}

void MeshSolver::precondition(bool moves) {
    const PartBlocks& blocks = system_.blocks();
    for_each_active([&](const Part& part, std::int32_t number) {
        const Block& block = blocks[number];
        if (moves) {
            for (std::int32_t row = block.begin; row < block.end; ++row) {
                x_.col(row) += part.step * p_.col(row);
                r_.col(row) -= part.step * q_.col(row);
            }
        }
        sums_[number] = system_.relax(block, r_, z_);
    });
    for (const std::int32_t part : active_) parts_[part].square = sum_of(part);
    const Parts with_octree = choose(active_, [](const Part& part) { return part.has_octree; });
    if (with_octree.empty()) return;
    octree_->restrict(r_, coarse_b_);
    multigrid_->cycle(coarse_b_, coarse_x_);
    for_each_active([&](const Part& part, std::int32_t block) {
        if (part.has_octree)
            sums_[block] = octree_->add_prolongated(system_, blocks[block], coarse_x_, r_, z_);
    });
    for (const std::int32_t number : with_octree) {
        Part& part = parts_[number];
        const double coarse = sum_of(number);
        const bool is_negative = coarse < -kRoundedProduct * part.square;
        part.square = is_negative ? coarse : part.square + coarse;
    }
}

double MeshSolver::reduction_left() const {
    double most = 1;
    for (const std::int32_t part : active_)
        most = std::max(most, parts_[part].square / parts_[part].limit);
    return std::log(most);
}

void MeshSolver::descend() {
    set_zero(x_, r_.cols());
    set_zero(p_, r_.cols());
    set_zero(q_, r_.cols());
    for (const std::int32_t part : active_) parts_[part].keep = 0;
    const double start = reduction_left();
    while (!active_.empty()) {
        for_each_active([&](const Part& part, std::int32_t block) {
            sums_[block] = system_.advance(system_.blocks()[block], z_, part.keep, p_, q_);
        });
        for (const std::int32_t number : active_) {
            Part& part = parts_[number];
            const double energy = sum_of(number);
            part.step = energy > 0 ? static_cast<float>(part.square / energy) : 0;
            part.previous = part.square;
        }
        keep_active([](const Part& part) { return part.step > 0; });
        precondition(true);
        for (const std::int32_t number : active_) {
            Part& part = parts_[number];
            ++part.iterations;
            part.keep = static_cast<float>(part.square / part.previous);
        }
        keep_active([](const Part& part) {
            return part.square > part.limit && part.iterations < part.most;
        });
        // Every iteration reduces the error by about the same factor.
        advance_progress(1 - reduction_left() / start);
    }
}

double MeshSolver::finish(std::vector<Eigen::Vector3d>& x) {
    const PartBlocks& blocks = system_.blocks();
    // Of each block: the sum of the residuals, and of the masses.
    std::vector<Eigen::Vector4d> drifts(static_cast<std::size_t>(blocks.count()));
    blocks.for_each([&](std::int32_t number) {
        const Block& block = blocks[number];
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (std::int32_t row = block.begin; row < block.end; ++row) {
            sum.head<3>() += r_.col(row).head<3>().cast<double>();
            sum[3] += double{system_.mass(row)};
        }
        drifts[number] = sum;
        const double unit = parts_[block.part].unit;
        sums_[number] = unit * unit * squared_norm(block, r_);
    });
    std::vector<Eigen::Vector3d> translations(parts_.size(), Eigen::Vector3d::Zero());
    for (std::int32_t part = 0; part < blocks.part_count(); ++part) {
        if (parts_[part].is_held) continue;
        const auto [first, last] = blocks.of_part(part);
        const Eigen::Vector4d sum = std::accumulate(drifts.begin() + first, drifts.begin() + last,
                                                    Eigen::Vector4d(Eigen::Vector4d::Zero()));
        translations[part] = sum.head<3>() / sum[3];
    }
    blocks.for_each([&](std::int32_t number) {
        const auto [begin, end, part, chunk] = blocks[number];
        for (std::int32_t row = begin; row < end; ++row)
            x[row] = parts_[part].unit * (x[row] + translations[part]);
    });
    return std::sqrt(std::accumulate(sums_.begin(), sums_.end(), 0.0));
}

void MeshSolver::solve_tiny_parts(std::vector<Eigen::Vector3d>& x) {
    Parts all = active_;
    keep_active([](const Part& part) { return part.is_tiny; });
    for_each_active([&](const Part& /*part*/, std::int32_t number) {
        const Block& block = system_.blocks()[number];
        system_.solve(block, b_, x);
        system_.residual(block, b_, x, r_);
    });
    precondition_positively();
    activate(std::move(all));
}

MeshConvergence MeshSolver::solve(const Field& b, double tolerance,
                                  std::vector<Eigen::Vector3d>& x) {
    const PartBlocks& blocks = system_.blocks();
    MeshConvergence result;
    result.residual_before = scale(b);
    r_.resize(4, b.cols());
    z_.resize(4, b.cols());
    x.assign(static_cast<std::size_t>(b.cols()), Eigen::Vector3d::Zero());
    Parts all(parts_.size());
    std::iota(all.begin(), all.end(), 0);
    for (Part& part : parts_) part.iterations = 0;
    activate(std::move(all));
    begin();
    solve_tiny_parts(x);
    const bool refines = tolerance < kSinglePrecision;
    const auto goal = [&](const Part& part) { return tolerance * tolerance * part.first; };
    keep_active([&](const Part& part) { return !part.is_tiny && part.square > goal(part); });
    while (!active_.empty()) {
        const Parts round = active_;
        for (const std::int32_t number : round) {
            Part& part = parts_[number];
            constexpr double reach = kSinglePrecision * kSinglePrecision;
            part.limit = refines ? std::max(goal(part), reach * part.square) : goal(part);
            part.most = part.has_octree ? part.iterations + kMostWithOctree : kMostMeshIterations;
            part.before = part.square;
            part.is_mended = false;
        }
        descend();
        activate(round);
        for_each_active([&](const Part& /*part*/, std::int32_t block) {
            for (std::int32_t row = blocks[block].begin; row < blocks[block].end; ++row)
                x[row] += x_.col(row).head<3>().cast<double>();
        });
        keep_active([](const Part& part) {
            return part.has_octree && !(part.square >= 0 && part.square <= part.limit);
        });
        if (!active_.empty()) {
            mend_octree(active_);
            begin();
        }
        activate(choose(round, [&](const Part& part) {
            return part.is_mended || (refines && part.iterations < kMostMeshIterations);
        }));
        for_each_active([&](const Part& /*part*/, std::int32_t block) {
            system_.residual(blocks[block], b_, x, r_);
        });
        precondition_positively();
        keep_active([&](const Part& part) {
            const bool progresses = part.square < kWorthRefining * kWorthRefining * part.before;
            return part.square > goal(part) && (part.is_mended || progresses);
        });
    }
    result.residual_after = finish(x);
    for (const Part& part : parts_) {
        const double error =
            part.first > 0 ? std::sqrt(part.square / part.first) : std::sqrt(part.first);
        result.error_estimate = worse_of(result.error_estimate, error);
        result.iterations = std::max(result.iterations, part.iterations);
    }
    return result;
}

}  // namespace tracked_mcf
