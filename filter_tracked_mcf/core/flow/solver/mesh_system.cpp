// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The least mass of a vertex, relative to its first mass and to its stiffness in A. It is much
/// larger than rounding, and much smaller than what any wave on a mesh needs.
constexpr float kLeastMass = 3e-6F;

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

/// Where an entry of a row is stored.
enum Place { Lower, Upper, Other };

Place place_of(const PartBlocks::Block& block, std::int32_t row, std::int32_t column) {
    if (column < block.begin || column >= block.end) return Other;
    return column < row ? Lower : Upper;
}

}  // namespace

MeshSystem::MeshSystem(const Stars& stars, const std::vector<std::uint8_t>& held,
                       const std::vector<std::int32_t>& parts)
    : stars_(stars),
      held_(held),
      blocks_(parts),
      weights_(stars.neighbours.size()),
      rows_(held.size() + 1),
      masses_(held.size()),
      diagonal_(held.size()),
      inverse_pivots_(held.size()) {
    make_rows();
}

void MeshSystem::make_rows() {
    const auto for_each_neighbour = [&](std::int32_t row, const auto& visit) {
        for (auto i = stars_.neighbour_begin[row]; i < stars_.neighbour_begin[row + 1]; ++i) {
            visit(stars_.neighbours[i]);
        }
    };
    // First the sizes of the rows, then their prefix sum.
    blocks_.for_each([&](std::int32_t number) {
        const Block& block = blocks_[number];
        for (std::int32_t row = block.begin; row < block.end; ++row) {
            std::array<std::uint32_t, 3> sizes = {0, 0, 0};
            for_each_neighbour(row,
                               [&](std::int32_t column) { ++sizes[place_of(block, row, column)]; });
            for (std::uint32_t& size : sizes) size = (size + kGroup - 1) / kGroup;
            rows_[row] = {sizes[Lower] + sizes[Upper] + sizes[Other], sizes[Lower],
                          sizes[Lower] + sizes[Upper]};
        }
    });
    const std::int32_t count = stars_.count();
    const auto total = parallel_scan<std::uint32_t>(
        count, [&](std::int64_t row) { return rows_[row].begin; },
        [&](std::int64_t begin, std::int64_t end, std::uint32_t next) {
            for (std::int64_t row = begin; row < end; ++row) {
                const std::uint32_t size = std::exchange(rows_[row].begin, next);
                rows_[row].lower += next;
                rows_[row].upper += next;
                next += size;
            }
        });
    rows_[count].begin = total;
    columns_.resize(first_entry(total));
    entries_.resize(first_entry(total));
    blocks_.for_each([&](std::int32_t number) {
        const Block& block = blocks_[number];
        for (std::int32_t row = block.begin; row < block.end; ++row) {
            std::fill(columns_.begin() + first_entry(rows_[row].begin),
                      columns_.begin() + first_entry(rows_[row + 1].begin), row);
            std::array<std::size_t, 3> next = {first_entry(rows_[row].begin),
                                               first_entry(rows_[row].lower),
                                               first_entry(rows_[row].upper)};
            for_each_neighbour(row, [&](std::int32_t column) {
                columns_[next[place_of(block, row, column)]++] = column;
            });
        }
    });
}

void MeshSystem::take(const TriangleElements& elements, double step_size, bool takes_stiffness) {
    step_size_ = static_cast<float>(step_size);
    const bool is_first = least_masses_.empty();
    if (is_first) least_masses_.resize(masses_.size());
    const auto take_row = [&](std::vector<float>& mass_entries, const Block& block,
                              std::int32_t row) {
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
        std::fill(entries_.begin() + first_entry(rows_[row].begin),
                  entries_.begin() + first_entry(rows_[row + 1].begin), 0.0F);
        std::array<std::size_t, 3> next = {first_entry(rows_[row].begin),
                                           first_entry(rows_[row].lower),
                                           first_entry(rows_[row].upper)};
        float stiffness = 0;
        for (std::uint32_t i = begin; i < end; ++i) {
            const float weight = step_size_ * weights_[i];
            stiffness += weight;
            entries_[next[place_of(block, row, stars_.neighbours[i])]++] =
                mass_entries[i - begin] - weight;
        }
        if (is_first) least_masses_[row] = kLeastMass * mass;
        masses_[row] = std::max({mass, least_masses_[row], kLeastMass * stiffness});
        diagonal_[row] = 0.75F * mass + (masses_[row] - mass) + stiffness;
    };
    blocks_.for_each([&](std::int32_t number) {
        const Block& block = blocks_[number];
        std::vector<float> mass_entries;
        for (std::int32_t row = block.begin; row < block.end; ++row) {
            take_row(mass_entries, block, row);
        }
        factorise(block);
    });
}

void MeshSystem::factorise(const Block& block) {
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        float pivot = diagonal_[row];
        // Entries that fill a group up have the row's own column.
        const std::size_t lower = first_entry(rows_[row].lower);
        for (std::size_t i = first_entry(rows_[row].begin); i < lower && columns_[i] < row; ++i) {
            pivot -= entries_[i] * entries_[i] * inverse_pivots_[columns_[i]];
        }
        // Pivots of an M-matrix are as large as this. Obtuse triangles make entries positive and
        // pivots smaller, and then solutions would grow from row to row.
        float sum = 0;
        for (std::size_t i = lower; i < first_entry(rows_[row].upper); ++i) {
            sum += std::abs(entries_[i]);
        }
        pivot = std::max(pivot, sum + masses_[row]);
        inverse_pivots_[row] = held_[row] != 0 ? 0 : 1 / pivot;
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

void MeshSystem::residual(const Block& block, const Field& b, const std::vector<Eigen::Vector3d>& x,
                          Field& residual) const {
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        Eigen::Vector3d sum = b.col(row).head<3>().cast<double>() - double{diagonal_[row]} * x[row];
        const std::size_t end = first_entry(rows_[row + 1].begin);
        for (std::size_t i = first_entry(rows_[row].begin); i < end; ++i)
            sum -= double{entries_[i]} * x[columns_[i]];
        if (held_[row] != 0) sum.setZero();
        residual.col(row) << sum.cast<float>(), 0;
    }
}

void MeshSystem::solve(const Block& block, const Field& b, std::vector<Eigen::Vector3d>& x) const {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kFewRows, kFewRows>;
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kFewRows, 3>;
    const std::int32_t rows = block.end - block.begin;
    Matrix lower = Matrix::Identity(rows, rows);  // so it is for held vertices
    Columns solution = Columns::Zero(rows, 3);
    for (std::int32_t i = 0; i < rows; ++i) {
        const std::int32_t row = block.begin + i;
        if (held_[row] != 0) continue;
        lower(i, i) = double{diagonal_[row]};
        solution.row(i) = b.col(row).head<3>().cast<double>();
        const std::size_t end = first_entry(rows_[row].lower);
        for (std::size_t k = first_entry(rows_[row].begin); k < end && columns_[k] < row; ++k) {
            if (held_[columns_[k]] == 0) lower(i, columns_[k] - block.begin) = double{entries_[k]};
        }
    }
    Eigen::LLT<Matrix>(lower).solveInPlace(solution);
    for (std::int32_t i = 0; i < rows; ++i) x[block.begin + i] = solution.row(i);
}

double MeshSystem::advance(const Block& block, const Field& z, float keep, Field& p,
                           Field& q) const {
    const float* const entries = entries_.data();
    const std::int32_t* const columns = columns_.data();
    Eigen::Vector4f energy = Eigen::Vector4f::Zero();
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        Eigen::Vector4f sum = diagonal_[row] * z.col(row);
        sum += sum_of_groups(entries, columns, rows_[row].begin, rows_[row + 1].begin, z.data());
        if (held_[row] != 0) sum.setZero();
        const Eigen::Vector4f direction = z.col(row) + keep * p.col(row);
        sum += keep * q.col(row);
        p.col(row) = direction;
        q.col(row) = sum;
        energy += direction.cwiseProduct(sum);
    }
    return double{energy.sum()};
}

double MeshSystem::relax(const Block& block, const Field& r, Field& z) const {
    const float* const entries = entries_.data();
    const std::int32_t* const columns = columns_.data();
    // Entries that fill a group up are 0, but must not meet a number that is none.
    for (std::int32_t row = block.begin; row < block.end; ++row) z.col(row).setZero();
    for (std::int32_t row = block.begin; row < block.end; ++row) {
        const Eigen::Vector4f sum =
            sum_of_groups(entries, columns, rows_[row].begin, rows_[row].lower, z.data());
        z.col(row) = inverse_pivots_[row] * (r.col(row) - sum);
    }
    Eigen::Vector4f product_with_r = Eigen::Vector4f::Zero();
    for (std::int32_t row = block.end; row-- > block.begin;) {
        const Eigen::Vector4f sum =
            sum_of_groups(entries, columns, rows_[row].lower, rows_[row].upper, z.data());
        const Eigen::Vector4f relaxed = z.col(row) - inverse_pivots_[row] * sum;
        z.col(row) = relaxed;
        product_with_r += relaxed.cwiseProduct(r.col(row));
    }
    return double{product_with_r.sum()};
}

}  // namespace tracked_mcf
