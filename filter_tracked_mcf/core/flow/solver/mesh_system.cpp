// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The least mass of a vertex, relative to its first mass and to its stiffness in A. It is much
/// larger than rounding, and much smaller than what any wave on a mesh needs.
constexpr float kLeastMass = 3e-6F;

/// Entries of a group: loops over whole groups have hardly a branch that processors cannot predict,
/// and are twice as fast as loops over rows of six or so entries.
constexpr std::uint32_t kGroup = 4;

/// Returns the sum of the entries of some groups times the columns of x.
inline Eigen::Vector4f sum_of_groups(const float* entries, const std::int32_t* columns,
                                     std::uint32_t begin, std::uint32_t end, const float* x) {
    const auto term = [=](std::uint32_t i) -> Eigen::Vector4f {
        return entries[i] * Eigen::Map<const Eigen::Vector4f, Eigen::Aligned16>(
                                x + std::int64_t{4} * columns[i]);
    };
    Eigen::Vector4f even = Eigen::Vector4f::Zero(), odd = Eigen::Vector4f::Zero();
    for (std::uint32_t i = begin; i < end; i += kGroup) {
        even += term(i);
        odd += term(i + 1);
        even += term(i + 2);
        odd += term(i + 3);
    }
    return even + odd;
}

/// Where an entry of a row is stored.
enum Part { Lower, Upper, Other };

Part part_of(std::int32_t row, std::int32_t column) {
    constexpr auto chunk = static_cast<std::int32_t>(kChunkSize);
    if (row / chunk != column / chunk) return Other;
    return column < row ? Lower : Upper;
}

}  // namespace

MeshSystem::MeshSystem(const Stars& stars, const std::vector<std::uint8_t>& fixed)
    : stars_(stars),
      fixed_(fixed),
      weights_(stars.neighbours.size()),
      rows_(fixed.size() + 1),
      masses_(fixed.size()),
      diagonal_(fixed.size()),
      inverse_pivots_(fixed.size()) {
    make_rows();
}

void MeshSystem::make_rows() {
    const auto for_each_neighbour = [&](std::int32_t row, const auto& visit) {
        for (auto i = stars_.neighbour_begin[row]; i < stars_.neighbour_begin[row + 1]; ++i) {
            visit(stars_.neighbours[i]);
        }
    };
    const auto sizes_of = [&](std::int32_t row) {
        std::array<std::uint32_t, 3> sizes = {0, 0, 0};
        for_each_neighbour(row, [&](std::int32_t column) { ++sizes[part_of(row, column)]; });
        for (std::uint32_t& size : sizes) size = (size + kGroup - 1) / kGroup * kGroup;
        return sizes;
    };
    const std::int32_t count = stars_.count();
    const auto size_of_row = [&](std::int64_t row) {
        const auto sizes = sizes_of(static_cast<std::int32_t>(row));
        return sizes[0] + sizes[1] + sizes[2];
    };
    const auto total = parallel_scan<std::uint32_t>(
        count, size_of_row, [&](std::int64_t begin, std::int64_t end, std::uint32_t next) {
            for (std::int64_t row = begin; row < end; ++row) {
                const auto sizes = sizes_of(static_cast<std::int32_t>(row));
                rows_[row] = {next, next + sizes[Lower], next + sizes[Lower] + sizes[Upper]};
                next = rows_[row].upper + sizes[Other];
            }
        });
    rows_[count].begin = total;
    columns_.resize(total);
    entries_.resize(total);
    parallel_for_rows(count, [&](std::int32_t row) {
        std::fill(columns_.begin() + rows_[row].begin, columns_.begin() + rows_[row + 1].begin,
                  row);
        std::array<std::uint32_t, 3> next = {rows_[row].begin, rows_[row].lower, rows_[row].upper};
        for_each_neighbour(
            row, [&](std::int32_t column) { columns_[next[part_of(row, column)]++] = column; });
    });
}

void MeshSystem::take(const TriangleElements& elements, double step_size, bool takes_stiffness) {
    step_size_ = static_cast<float>(step_size);
    const bool is_first = least_masses_.empty();
    if (is_first) least_masses_.resize(masses_.size());
    const auto take_row = [&](std::vector<float>& mass_entries, std::int32_t row) {
        const std::uint32_t begin = stars_.neighbour_begin[row];
        const std::uint32_t end = stars_.neighbour_begin[row + 1];
        mass_entries.assign(end - begin, 0.0F);
        if (takes_stiffness) std::fill(weights_.begin() + begin, weights_.begin() + end, 0.0F);
        float mass = 0;
        for (std::uint32_t i = stars_.corner_begin[row]; i < stars_.corner_begin[row + 1]; ++i) {
            const TriangleElement& element = elements[stars_.corners[i] / 3];
            const std::uint32_t corner = stars_.corners[i] % 3;
            const auto [next, previous] = stars_.places[i];
            mass += element.mass;
            mass_entries[next - begin] += element.mass / 8;  // half of a quarter
            mass_entries[previous - begin] += element.mass / 8;
            if (!takes_stiffness) continue;
            weights_[next] += element.weights[(corner + 2) % 3];
            weights_[previous] += element.weights[(corner + 1) % 3];
        }
        std::fill(entries_.begin() + rows_[row].begin, entries_.begin() + rows_[row + 1].begin,
                  0.0F);
        std::array<std::uint32_t, 3> next = {rows_[row].begin, rows_[row].lower, rows_[row].upper};
        float stiffness = 0;
        for (std::uint32_t i = begin; i < end; ++i) {
            const float weight = step_size_ * weights_[i];
            stiffness += weight;
            entries_[next[part_of(row, stars_.neighbours[i])]++] = mass_entries[i - begin] - weight;
        }
        if (is_first) least_masses_[row] = kLeastMass * mass;
        masses_[row] = std::max({mass, least_masses_[row], kLeastMass * stiffness});
        diagonal_[row] = 0.75F * mass + (masses_[row] - mass) + stiffness;
    };
    parallel_for_chunks_with(
        stars_.count(), [] { return std::vector<float>(); },
        [&](std::vector<float>& mass_entries, std::int64_t begin, std::int64_t end) {
            for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
                take_row(mass_entries, row);
            }
            factorise(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
        });
}

void MeshSystem::factorise(std::int32_t begin, std::int32_t end) {
    for (std::int32_t row = begin; row < end; ++row) {
        float pivot = diagonal_[row];
        // Entries that fill a group up have the row's own column.
        for (std::uint32_t i = rows_[row].begin; i < rows_[row].lower && columns_[i] < row; ++i) {
            pivot -= entries_[i] * entries_[i] * inverse_pivots_[columns_[i]];
        }
        // Pivots of an M-matrix are as large as this. Obtuse triangles make entries positive and
        // pivots smaller, and then solutions would grow from row to row.
        float sum = 0;
        for (std::uint32_t i = rows_[row].lower; i < rows_[row].upper; ++i) {
            sum += std::abs(entries_[i]);
        }
        pivot = std::max(pivot, sum + masses_[row]);
        inverse_pivots_[row] = fixed_[row] != 0 ? 0 : 1 / pivot;
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
        if (fixed_[row] != 0) sum.setZero();
        product.col(row) << (factor * step_size_ * sum).cast<float>(), 0;
    });
}

void MeshSystem::residual(const Field& b, const std::vector<Eigen::Vector3d>& x,
                          Field& residual) const {
    residual.resize(4, stars_.count());
    parallel_for_rows(stars_.count(), [&](std::int32_t row) {
        Eigen::Vector3d sum = b.col(row).head<3>().cast<double>() - double{diagonal_[row]} * x[row];
        for (std::uint32_t i = rows_[row].begin; i < rows_[row + 1].begin; ++i) {
            sum -= double{entries_[i]} * x[columns_[i]];
        }
        if (fixed_[row] != 0) sum.setZero();
        residual.col(row) << sum.cast<float>(), 0;
    });
}

double MeshSystem::advance(const Field& z, float keep, Field& p, Field& q) const {
    const float* const entries = entries_.data();
    const std::int32_t* const columns = columns_.data();
    return parallel_sum(stars_.count(), 0.0, [&](std::int64_t begin, std::int64_t end) {
        Eigen::Vector4f energy = Eigen::Vector4f::Zero();
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
            Eigen::Vector4f sum = diagonal_[row] * z.col(row);
            sum +=
                sum_of_groups(entries, columns, rows_[row].begin, rows_[row + 1].begin, z.data());
            if (fixed_[row] != 0) sum.setZero();
            const Eigen::Vector4f direction = z.col(row) + keep * p.col(row);
            sum += keep * q.col(row);
            p.col(row) = direction;
            q.col(row) = sum;
            energy += direction.cwiseProduct(sum);
        }
        return double{energy.sum()};
    });
}

double MeshSystem::relax(std::int32_t begin, std::int32_t end, const Field& r, Field& z) const {
    const float* const entries = entries_.data();
    const std::int32_t* const columns = columns_.data();
    // Entries that fill a group up are 0, but must not meet a number that is none.
    for (std::int32_t row = begin; row < end; ++row) z.col(row).setZero();
    for (std::int32_t row = begin; row < end; ++row) {
        const Eigen::Vector4f sum =
            sum_of_groups(entries, columns, rows_[row].begin, rows_[row].lower, z.data());
        z.col(row) = inverse_pivots_[row] * (r.col(row) - sum);
    }
    Eigen::Vector4f product_with_r = Eigen::Vector4f::Zero();
    for (std::int32_t row = end; row-- > begin;) {
        const Eigen::Vector4f sum =
            sum_of_groups(entries, columns, rows_[row].lower, rows_[row].upper, z.data());
        const Eigen::Vector4f relaxed = z.col(row) - inverse_pivots_[row] * sum;
        z.col(row) = relaxed;
        product_with_r += relaxed.cwiseProduct(r.col(row));
    }
    return double{product_with_r.sum()};
}

}  // namespace tracked_mcf
