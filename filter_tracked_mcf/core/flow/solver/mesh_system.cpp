// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The least mass of a vertex, relative to its first mass: that of a surface that has vanished.
constexpr float kLeastMass = 3e-6F;

/// The least mass of a vertex, relative to its stiffness in A: five times the rounding of their
/// sum. At small edges of a scan with wide detail, masses of ten times as much change a step by a
/// hundredth.
constexpr float kLeastOfStiffness = 3e-7F;

/// Entries of a group: loops over whole groups have hardly a branch that processors cannot predict,
/// and are twice as fast as loops over rows of six or so entries.
constexpr std::uint32_t kGroup = 4;

inline std::size_t first_entry(std::uint32_t group) {
    return std::size_t{kGroup} * group;
}

/// Returns the sum of the entries of some groups times the columns of x.
inline Eigen::Vector4f sum_of_groups(const float* entries, const std::int32_t* columns,
                                     std::uint32_t begin, std::uint32_t end, const float* x) {
    const auto term = [=](std::size_t i) -> Eigen::Vector4f {
        return entries[i] * Eigen::Map<const Eigen::Vector4f, Eigen::Aligned16>(
                                x + std::int64_t{4} * columns[i]);
    };
    Eigen::Vector4f even = Eigen::Vector4f::Zero(), odd = Eigen::Vector4f::Zero();
    for (std::size_t i = first_entry(begin); i < first_entry(end); i += kGroup) {
        even += term(i);
        odd += term(i + 1);
        even += term(i + 2);
        odd += term(i + 3);
    }
    return even + odd;
}

/// A search through so many entries is no slower than a binary one.
constexpr std::size_t kShortRow = 8;

/// The least pivot of the factorisation, relative to the diagonal. Those of an M-matrix are
/// positive but for rounding; only last rows of small parts may have smaller ones.
constexpr float kLeastPivot = 1e-3F;

}  // namespace

MeshSystem::MeshSystem(const Stars& stars, const std::vector<std::uint8_t>& held,
                       const std::vector<std::int32_t>& parts)
    : stars_(stars),
      held_(held),
      blocks_(parts),
      elimination_(stars, blocks_),
      weights_(stars.neighbours.size()),
      rows_(held.size() + 1),
      masses_(held.size()),
      diagonal_(held.size()),
      inverse_pivots_(held.size()) {
    make_rows();
}

void MeshSystem::make_rows() {
    // First the sizes of the rows, then their prefix sum.
    const std::int32_t count = stars_.count();
    parallel_for_rows(count, [&](std::int32_t row) {
        std::uint32_t lower = 0, upper = 0;
        for_each_neighbour(stars_, row, [&](std::int32_t column) {
            ++(elimination_.precedes(column, row) ? lower : upper);
        });
        const std::uint32_t groups = (lower + kGroup - 1) / kGroup;
        rows_[row] = {groups + (upper + kGroup - 1) / kGroup, groups};
    });
    const auto total = parallel_scan<std::uint32_t>(
        count, [&](std::int64_t row) { return rows_[row].begin; },
        [&](std::int64_t begin, std::int64_t end, std::uint32_t next) {
            for (std::int64_t row = begin; row < end; ++row) {
                const std::uint32_t size = std::exchange(rows_[row].begin, next);
                rows_[row].lower += next;
                next += size;
            }
        });
    rows_[count].begin = total;
    columns_.resize(first_entry(total));
    entries_.resize(first_entry(total));
    factors_.resize(first_entry(total));
    parallel_for_rows(count, [&](std::int32_t row) {
        const std::size_t lower = first_entry(rows_[row].lower);
        const std::size_t end = first_entry(rows_[row + 1].begin);
        std::size_t next_lower = first_entry(rows_[row].begin), next_upper = lower;
        for_each_neighbour(stars_, row, [&](std::int32_t column) {
            columns_[(elimination_.precedes(column, row) ? next_lower : next_upper)++] = column;
        });
        if (!elimination_.is_inside(row)) {
            std::sort(columns_.begin() + first_entry(rows_[row].begin),
                      columns_.begin() + next_lower,
                      [&](std::int32_t a, std::int32_t b) { return elimination_.precedes(a, b); });
        }
        const auto fill_up = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                columns_[i] = row;
                entries_[i] = 0;
            }
        };
        fill_up(next_lower, lower);
        fill_up(next_upper, end);
    });
}

void MeshSystem::take(const TriangleElements& elements, double step_size, bool takes_stiffness) {
    step_size_ = static_cast<float>(step_size);
    least_masses_.resize(masses_.size(), 0);
    blocks_.for_each([&](std::int32_t number) {
        const Block& block = blocks_[number];
        std::vector<float> entries;
        for (std::int32_t row = block.begin; row < block.end; ++row)
            take_row(elements, takes_stiffness, row, entries);
        factorise(elimination_.inside(number));
    });
    for (const auto& separators : elimination_.later_stages()) {
        parallel_for(static_cast<std::int64_t>(separators.size()),
                     [&](std::int64_t i) { factorise(separators[i].rows); });
    }
    blocks_.for_each([&](std::int32_t number) { mirror_factors(blocks_[number]); });
}

void MeshSystem::take_row(const TriangleElements& elements, bool takes_stiffness, std::int32_t row,
                          std::vector<float>& mass_entries) {
    const std::uint32_t begin = stars_.neighbour_begin[row];
    const std::uint32_t end = stars_.neighbour_begin[row + 1];
    mass_entries.assign(end - begin, 0.0F);
    if (takes_stiffness) std::fill(weights_.begin() + begin, weights_.begin() + end, 0.0F);
    float mass = 0;
    for (std::uint32_t i = stars_.corner_begin[row]; i < stars_.corner_begin[row + 1]; ++i) {
        const TriangleElement<float>& element = elements[stars_.corners[i] / 3];
        const std::uint32_t corner = stars_.corners[i] % 3;
        const auto [next, previous] = stars_.places[i];
        mass += element.mass;
        mass_entries[next - begin] += element.mass / 8;  // half of a quarter
        mass_entries[previous - begin] += element.mass / 8;
        if (!takes_stiffness) continue;
        weights_[next] += element.weights[(corner + 2) % 3];
        weights_[previous] += element.weights[(corner + 1) % 3];
    }
    float stiffness = 0;
    const bool is_inside = elimination_.is_inside(row);
    std::size_t next_lower = first_entry(rows_[row].begin);
    std::size_t next_upper = first_entry(rows_[row].lower);
    for (std::uint32_t i = begin; i < end; ++i) {
        const float weight = step_size_ * weights_[i];
        stiffness += weight;
        const bool is_before = elimination_.precedes(stars_.neighbours[i], row);
        const std::size_t next = (is_before ? next_lower : next_upper)++;
        const bool is_sorted = is_inside || !is_before;
        entries_[is_sorted ? next : lower_entry(row, stars_.neighbours[i])] =
            mass_entries[i - begin] - weight;
    }
    float& least_mass = least_masses_[row];
    if (least_mass == 0) least_mass = kLeastMass * mass;
    masses_[row] = std::max({mass, least_mass, kLeastOfStiffness * stiffness});
    diagonal_[row] = 0.75F * mass + (masses_[row] - mass) + stiffness;
}

std::size_t MeshSystem::lower_entry(std::int32_t row, std::int32_t column) const {
    const std::size_t begin = first_entry(rows_[row].begin), end = first_entry(rows_[row].lower);
    if (end - begin <= kShortRow) {
        for (std::size_t i = begin; i < end; ++i) {
            if (columns_[i] == column) return i;
        }
        return end;
    }
    const auto found = std::lower_bound(
        columns_.begin() + begin, columns_.begin() + end, column,
        [&](std::int32_t a, std::int32_t b) { return elimination_.precedes(a, b); });
    const auto i = static_cast<std::size_t>(found - columns_.begin());
    return i < end && columns_[i] == column ? i : end;
}

void MeshSystem::factorise(Rows rows) {
    for (const std::int32_t row : rows) {
        const std::size_t begin = first_entry(rows_[row].begin);
        const std::size_t lower = first_entry(rows_[row].lower);
        float pivot = diagonal_[row];
        for (std::size_t i = begin; i < first_entry(rows_[row + 1].begin); ++i) {
            pivot += std::max(entries_[i], 0.0F);
            factors_[i] = std::min(entries_[i], 0.0F);
        }
        for (std::size_t i = begin; i < lower && columns_[i] != row; ++i) {
            const std::int32_t column = columns_[i];
            const std::size_t other_begin = first_entry(rows_[column].begin);
            const std::size_t other_end = first_entry(rows_[column].lower);
            float factor = factors_[i];
            const auto eliminate = [&](std::size_t own, std::size_t other) {
                factor -= factors_[own] * inverse_pivots_[columns_[own]] * factors_[other];
            };
            // Both rows may have neighbours that are eliminated before them. One row may be that of
            // a hub with thousands of neighbours: the shorter one is gone through.
            if (i - begin <= other_end - other_begin) {
                for (std::size_t own = begin; own < i; ++own) {
                    const std::size_t other = lower_entry(column, columns_[own]);
                    if (other < other_end) eliminate(own, other);
                }
            } else {
                for (std::size_t other = other_begin; other < other_end; ++other) {
                    const std::size_t own = lower_entry(row, columns_[other]);
                    if (own < i) eliminate(own, other);
                }
            }
            factors_[i] = factor;
            pivot -= factor * factor * inverse_pivots_[column];
        }
        pivot = std::max(pivot, kLeastPivot * diagonal_[row]);
        inverse_pivots_[row] = held_[row] != 0 ? 0 : 1 / pivot;
    }
}

void MeshSystem::mirror_factors(const Block& block) {
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        const std::size_t end = first_entry(rows_[row + 1].begin);
        for (std::size_t i = first_entry(rows_[row].lower); i < end && columns_[i] != row; ++i)
            factors_[i] = factors_[lower_entry(columns_[i], row)];
    }
}

void MeshSystem::multiply_stiffness(const std::vector<Eigen::Vector3d>& x, double factor,
                                    Field& product) const {
    product.resize(4, stars_.count());
    parallel_for_rows(stars_.count(), [&](std::int32_t row) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (auto i = stars_.neighbour_begin[row]; i < stars_.neighbour_begin[row + 1]; ++i) {
            sum += double{weights_[i]} * (x[row] - x[stars_.neighbours[i]]);
        }
        if (held_[row] != 0) sum.setZero();
        product.col(row) << (factor * step_size_ * sum).cast<float>(), 0;
    });
}

void MeshSystem::residual(const Block& block, const Field& b, double unit,
                          const std::vector<Eigen::Vector3d>& x, Field& residual) const {
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        // A row sums to its mass. Where that is a small part of the diagonal, the diagonal's
        // rounding is not small beside it.
        Eigen::Vector3d sum =
            b.col(row).head<3>().cast<double>() / unit - double{masses_[row]} * x[row];
        const std::size_t end = first_entry(rows_[row + 1].begin);
        for (std::size_t i = first_entry(rows_[row].begin); i < end; ++i)
            sum -= double{entries_[i]} * (x[columns_[i]] - x[row]);
        if (held_[row] != 0) sum.setZero();
        residual.col(row) << sum.cast<float>(), 0;
    }
}

void MeshSystem::solve(const Block& block, const Field& b, double unit,
                       std::vector<Eigen::Vector3d>& x) const {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kFewRows, kFewRows>;
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kFewRows, 3>;
    const std::int32_t rows = block.end - block.begin;
    Matrix lower = Matrix::Identity(rows, rows);  // so it is for held vertices
    Columns solution = Columns::Zero(rows, 3);
    for (std::int32_t i = 0; i < rows; ++i) {
        const std::int32_t row = block.begin + i;
        if (held_[row] != 0) continue;
        lower(i, i) = double{masses_[row]};  // as in residual()
        for (auto k = first_entry(rows_[row].begin); k < first_entry(rows_[row + 1].begin); ++k)
            lower(i, i) -= double{entries_[k]};
        solution.row(i) = b.col(row).head<3>().cast<double>() / unit;
        const std::size_t end = first_entry(rows_[row].lower);
        for (std::size_t k = first_entry(rows_[row].begin); k < end && columns_[k] != row; ++k) {
            if (held_[columns_[k]] == 0) lower(i, columns_[k] - block.begin) = double{entries_[k]};
        }
    }
    Eigen::LLT<Matrix>(lower).solveInPlace(solution);
    for (std::int32_t i = 0; i < rows; ++i) x[block.begin + i] = solution.row(i);
}

double MeshSystem::advance(Rows rows, const Search& search, const Field& z, Field& x, Field& p,
                           Field& q) const {
    const float* const entries = entries_.data();
    const std::int32_t* const columns = columns_.data();
    const auto [is_first, step, beta] = search;
    Eigen::Vector4f energy = Eigen::Vector4f::Zero();
    for (const std::int32_t row : rows) {
        Eigen::Vector4f direction = z.col(row);
        Eigen::Vector4f product = diagonal_[row] * direction;
        product +=
            sum_of_groups(entries, columns, rows_[row].begin, rows_[row + 1].begin, z.data());
        if (held_[row] != 0) product.setZero();
        if (is_first) {
            x.col(row).setZero();
        } else {
            const Eigen::Vector4f before = p.col(row);
            x.col(row) += step * before;
            direction += beta * before;
            product += beta * q.col(row);
        }
        p.col(row) = direction;
        q.col(row) = product;
        energy += direction.cwiseProduct(product);
    }
    return double{energy.sum()};
}

double MeshSystem::solve_lower(Rows rows, const Field& r, Field& z) const {
    const float* const factors = factors_.data();
    const std::int32_t* const columns = columns_.data();
    Eigen::Vector4f product = Eigen::Vector4f::Zero();
    for (const std::int32_t row : rows) {
        const Eigen::Vector4f rest = r.col(row) - sum_of_groups(factors, columns, rows_[row].begin,
                                                                rows_[row].lower, z.data());
        const Eigen::Vector4f solved = inverse_pivots_[row] * rest;
        z.col(row) = solved;
        product += solved.cwiseProduct(rest);
    }
    return double{product.sum()};
}

void MeshSystem::solve_upper(Rows rows, Field& z) const {
    const float* const factors = factors_.data();
    const std::int32_t* const columns = columns_.data();
    for (const std::int32_t* row = rows.last; row-- != rows.first;) {
        const Eigen::Vector4f sum =
            sum_of_groups(factors, columns, rows_[*row].lower, rows_[*row + 1].begin, z.data());
        z.col(*row) -= inverse_pivots_[*row] * sum;
    }
}

}  // namespace tracked_mcf
