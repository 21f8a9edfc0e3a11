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

/// Returns the power of two by which a right-hand side of this norm is divided, so that its norm is
/// about a million. Conjugate gradients square numbers: single precision loses the squares of very
/// small and large ones, and processors take a hundred times as long for numbers that are almost
/// lost. Rounding leaves such ones, 1e-20 of the norm, wherever most of a surface is smooth.
double unit_of(double norm) {
    constexpr int most = 126;  // so that the inverse is a float, too
    constexpr int millions = 20;
    if (!(norm > 0) || !std::isfinite(norm)) return 1;
    return std::exp2(std::clamp(std::ilogb(norm) - millions, -most, most));
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

template <class Body>
void MeshSolver::for_each_active(const Separators& separators, const Body& body) {
    parallel_for(static_cast<std::int64_t>(separators.size()), [&](std::int64_t i) {
        const Part& part = parts_[separators[i].part];
        if (part.is_active) body(part, i);
    });
}

template <class Body>
void MeshSolver::sum_over(const Separators& separators, double Part::*sum, const Body& body) {
    std::vector<double> sums(separators.size(), 0);
    for_each_active(separators,
                    [&](const Part& /*part*/, std::int64_t i) { sums[i] = body(separators[i]); });
    for (std::size_t i = 0; i < sums.size(); ++i) parts_[separators[i].part].*sum += sums[i];
}

double MeshSolver::sum_of(std::int32_t part) const {
    const auto [first, last] = system_.blocks().of_part(part);
    return std::accumulate(sums_.begin() + first, sums_.begin() + last, 0.0);
}

double MeshSolver::choose_units(const Field& b) {
    const PartBlocks& blocks = system_.blocks();
    blocks.for_each([&](std::int32_t block) { sums_[block] = squared_norm(blocks[block], b); });
    for (std::int32_t part = 0; part < blocks.part_count(); ++part)
        parts_[part].unit = unit_of(std::sqrt(sum_of(part)));
    return std::sqrt(std::accumulate(sums_.begin(), sums_.end(), 0.0));
}

void MeshSolver::begin(const Field& b) {
    for_each_active([&](const Part& part, std::int32_t number) {
        const Block& block = system_.blocks()[number];
        const Eigen::Index rows = block.end - block.begin;
        const auto factor = static_cast<float>(1 / part.unit);
        r_.middleCols(block.begin, rows) = factor * b.middleCols(block.begin, rows);
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
    // What the V-cycle has given may be no number, which entries that are 0 must not meet.
    set_zero(z_, z_.cols());
    if (std::any_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.has_octree; }))
        return;
    multigrid_.reset();
    octree_.reset();
}

void MeshSolver::precondition(bool moves) {
    const PartBlocks& blocks = system_.blocks();
    const Elimination& elimination = system_.elimination();
    for_each_active([&](const Part& part, std::int32_t number) {
        const Block& block = blocks[number];
        if (moves) {
            for (std::int32_t row = block.begin; row < block.end; ++row)
                r_.col(row) -= part.search.step * q_.col(row);
        }
        sums_[number] = system_.solve_lower(elimination.inside(number), r_, z_);
    });
    for (const std::int32_t part : active_) parts_[part].square = sum_of(part);
    for (const Separators& separators : elimination.later_stages()) {
        sum_over(separators, &Part::square, [&](const Elimination::Separator& separator) {
            return system_.solve_lower(separator.rows, r_, z_);
        });
    }
    const auto has_octree = [](const Part& part) { return part.has_octree; };
    const Parts with_octree = choose(active_, has_octree);
    if (with_octree.empty()) return;
    solve_upper_at_separators(has_octree);
    for_each_active([&](const Part& part, std::int32_t block) {
        if (part.has_octree) system_.solve_upper(elimination.inside(block), z_);
    });
    precondition_by_octree(with_octree);
}

void MeshSolver::precondition_by_octree(const Parts& with_octree) {
    octree_->restrict(r_, coarse_b_);
    multigrid_->cycle(coarse_b_, coarse_x_);
    const PartBlocks& blocks = system_.blocks();
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

template <class Wanted>
void MeshSolver::solve_upper_at_separators(const Wanted& wanted) {
    const auto& stages = system_.elimination().later_stages();
    for (auto separators = stages.rbegin(); separators != stages.rend(); ++separators) {
        for_each_active(*separators, [&](const Part& part, std::int64_t i) {
            if (wanted(part)) system_.solve_upper((*separators)[i].rows, z_);
        });
    }
}

void MeshSolver::search() {
    const Elimination& elimination = system_.elimination();
    solve_upper_at_separators([](const Part& part) { return !part.has_octree; });
    // Rows inside of a block have neighbours in this block and at separators only.
    for_each_active([&](const Part& part, std::int32_t block) {
        const Elimination::Rows rows = elimination.inside(block);
        if (!part.has_octree) system_.solve_upper(rows, z_);
        sums_[block] = system_.advance(rows, part.search, z_, x_, p_, q_);
    });
    for (const std::int32_t part : active_) parts_[part].energy = sum_of(part);
    for (const Separators& separators : elimination.later_stages()) {
        sum_over(separators, &Part::energy, [&](const Elimination::Separator& separator) {
            return system_.advance(separator.rows, parts_[separator.part].search, z_, x_, p_, q_);
        });
    }
    for (const std::int32_t number : active_) {
        Part& part = parts_[number];
        part.search.is_first = false;
        part.search.step = part.energy > 0 ? static_cast<float>(part.square / part.energy) : 0;
    }
}

double MeshSolver::reduction_left() const {
    double most = 1;
    for (const std::int32_t part : active_)
        most = std::max(most, parts_[part].square / parts_[part].limit);
    return std::log(most);
}

void MeshSolver::descend() {
    for (const std::int32_t part : active_) parts_[part].search = {};
    const double start = reduction_left();
    while (!active_.empty()) {
        search();
        keep_active([](const Part& part) { return part.search.step > 0; });
        for (const std::int32_t part : active_) parts_[part].previous = parts_[part].square;
        precondition(true);
        for (const std::int32_t number : active_) {
            Part& part = parts_[number];
            ++part.iterations;
            part.search.beta = static_cast<float>(part.square / part.previous);
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

void MeshSolver::solve_tiny_parts(const Field& b, std::vector<Eigen::Vector3d>& x) {
    Parts all = active_;
    keep_active([](const Part& part) { return part.is_tiny; });
    for_each_active([&](const Part& part, std::int32_t number) {
        const Block& block = system_.blocks()[number];
        system_.solve(block, b, part.unit, x);
        system_.residual(block, b, part.unit, x, r_);
    });
    precondition_positively();
    activate(std::move(all));
}

MeshConvergence MeshSolver::solve(const Field& b, double tolerance,
                                  std::vector<Eigen::Vector3d>& x) {
    const PartBlocks& blocks = system_.blocks();
    MeshConvergence result;
    result.residual_before = choose_units(b);
    for (Field* const field : {&x_, &r_, &p_, &q_}) field->resize(4, b.cols());
    set_zero(z_, b.cols());  // entries that are 0 must not meet a number that is none
    x.assign(static_cast<std::size_t>(b.cols()), Eigen::Vector3d::Zero());
    Parts all(parts_.size());
    std::iota(all.begin(), all.end(), 0);
    for (Part& part : parts_) part.iterations = 0;
    activate(std::move(all));
    begin(b);
    solve_tiny_parts(b, x);
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
        for_each_active([&](const Part& part, std::int32_t block) {
            for (std::int32_t row = blocks[block].begin; row < blocks[block].end; ++row) {
                const Eigen::Vector4f sum = x_.col(row) + part.search.step * p_.col(row);
                x[row] += sum.head<3>().cast<double>();
            }
        });
        keep_active([](const Part& part) {
            return part.has_octree && !(part.square >= 0 && part.square <= part.limit);
        });
        if (!active_.empty()) {
            mend_octree(active_);
            begin(b);
        }
        activate(choose(round, [&](const Part& part) {
            return part.is_mended || (refines && part.iterations < kMostMeshIterations);
        }));
        for_each_active([&](const Part& part, std::int32_t block) {
            system_.residual(blocks[block], b, part.unit, x, r_);
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
