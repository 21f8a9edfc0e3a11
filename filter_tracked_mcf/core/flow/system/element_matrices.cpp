// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"

#include <algorithm>
#include <numeric>

#include "filter_tracked_mcf/core/flow/system/moments.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

int bit(int corner, int axis) {
    return corner_bit(corner, axis);
}

/// The moments of four elements.
using BatchMoments = Lanes[kMoments];

/// Adds x or subtracts it. The sign is a product of slopes, which are 1 or -1.
void add_signed(Lanes& sum, bool positive, const Lanes& x) {
    if (positive) {
        sum += x;
    } else {
        sum -= x;
    }
}

/// Returns ∫ ∇B_I · G ∇B_J, a sum of moments. ∂B_I/∂x is a slope times the linear functions of y
/// and z in B_I; these linear functions choose the moment.
Lanes stiffness_entry(const BatchMoments& moments, int row, int column) {
    const int xi = bit(row, 0), yi = bit(row, 1), zi = bit(row, 2);
    const int xj = bit(column, 0), yj = bit(column, 1), zj = bit(column, 2);
    Lanes sum = Lanes::Zero();
    add_signed(sum, xi == xj, moments[kXX + 3 * (yi + yj) + zi + zj]);
    add_signed(sum, yi == yj, moments[kYY + 3 * (zi + zj) + xi + xj]);
    add_signed(sum, zi == zj, moments[kZZ + 3 * (xi + xj) + yi + yj]);
    add_signed(sum, xi == yj, moments[kXY + 6 * xj + 3 * yi + zi + zj]);
    add_signed(sum, yi == xj, moments[kXY + 6 * xi + 3 * yj + zi + zj]);
    add_signed(sum, yi == zj, moments[kYZ + 6 * yj + 3 * zi + xi + xj]);
    add_signed(sum, zi == yj, moments[kYZ + 6 * yi + 3 * zj + xi + xj]);
    add_signed(sum, zi == xj, moments[kZX + 6 * zj + 3 * xi + yi + yj]);
    add_signed(sum, xi == zj, moments[kZX + 6 * zi + 3 * xj + yi + yj]);
    return sum;
}

Lanes mass_entry(const BatchMoments& moments, int row, int column) {
    return moments[kMass + 9 * (bit(row, 0) + bit(column, 0)) + 3 * (bit(row, 1) + bit(column, 1)) +
                   bit(row, 2) + bit(column, 2)];
}

/// Returns ∫ ∇B_I · G ∇X_t for one coordinate of X_t.
Lanes flux_entry(const BatchMoments& moments, int axis, int row) {
    const int x = bit(row, 0), y = bit(row, 1), z = bit(row, 2);
    Lanes sum = Lanes::Zero();
    add_signed(sum, x == 1, moments[kFluxX + 4 * axis + 2 * y + z]);
    add_signed(sum, y == 1, moments[kFluxY + 4 * axis + 2 * z + x]);
    add_signed(sum, z == 1, moments[kFluxZ + 4 * axis + 2 * x + y]);
    return sum;
}

/// Returns the area in the metric of the mass: the sum of ∫ B_I B_J over all I and J, because the
/// functions B sum to 1.
Lanes area_of_mass(const BatchMoments& moments) {
    Lanes area = Lanes::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Lanes* const m = moments + kMass + 9 * i + 3 * j;
            const auto products = static_cast<float>((1 + i % 2) * (1 + j % 2));
            area += products * (2 * m[1] + m[0] + m[2]);
        }
    }
    return area;
}

/// Sets the systems of `count` elements from their moments.
void expand(const BatchMoments& moments, float step_size, std::int64_t first, int count,
            ElementSystems& systems) {
    for (int row = 0; row < 8; ++row) {
        for (int column = row; column < 8; ++column) {
            const Lanes stiffness = step_size * stiffness_entry(moments, row, column);
            const Lanes sum = stiffness + mass_entry(moments, row, column);
            for (int lane = 0; lane < count; ++lane) {
                systems.matrices[first + lane](row, column) = sum[lane];
                if (!systems.stiffnesses.empty())
                    systems.stiffnesses[first + lane](row, column) = stiffness[lane];
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes force = -step_size * flux_entry(moments, axis, row);
            for (int lane = 0; lane < count; ++lane)
                systems.right_sides(axis, 8 * (first + lane) + row) = force[lane];
        }
        for (int lane = 0; lane < count; ++lane)
            systems.right_sides(3, 8 * (first + lane) + row) = 0;
    }
    const Lanes area = area_of_mass(moments);
    for (int lane = 0; lane < count; ++lane) systems.areas[first + lane] = area[lane];
}

/// Sets the systems of the elements from `begin` to `end` - 1, four at a time. Returns the number
/// of collapsed samples.
std::int64_t integrate(const TrackedElements& elements, const Coefficients& displacement,
                       float step_size, std::int64_t begin, std::int64_t end,
                       ElementSystems& systems) {
    Pacer pacer;
    std::int64_t collapsed = 0;
    for (std::int64_t first = begin; first < end; first += kLanes) {
        const int count = static_cast<int>(std::min<std::int64_t>(kLanes, end - first));
        Moments of_elements[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) {
            of_elements[lane].setZero();
            if (lane < count)
                collapsed += add_moments(elements, displacement, first + lane, of_elements[lane]);
        }
        BatchMoments moments;
        for (int m = 0; m < kMoments; ++m) {
            for (int lane = 0; lane < kLanes; ++lane) moments[m][lane] = of_elements[lane][m];
        }
        expand(moments, step_size, first, count, systems);
        pacer.did(elements.sample_begin[first + count] - elements.sample_begin[first]);
    }
    return collapsed;
}

}  // namespace

void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       double step_size, bool keep_stiffness, ElementSystems& systems) {
    const auto count = static_cast<std::size_t>(elements.finest().element_count());
    systems.matrices.resize(count);
    systems.right_sides.resize(4, 8 * elements.finest().element_count());
    systems.areas.resize(count);
    if (keep_stiffness) systems.stiffnesses.resize(count);
    systems.collapsed_samples =
        parallel_sum(elements.finest().element_count(), std::int64_t{0},
                     [&](std::int64_t begin, std::int64_t end) {
                         return integrate(elements, displacement, static_cast<float>(step_size),
                                          begin, end, systems);
                     });
    systems.area = std::accumulate(systems.areas.begin(), systems.areas.end(), 0.0);
}

void multiply(const TrackedElements& elements, const MatrixBlocks& matrices,
              const Coefficients& vector, Eigen::Matrix<float, 4, Eigen::Dynamic>& products) {
    products.resize(4, 8 * elements.finest().element_count());
    parallel_for_rows(elements.finest().element_count(), [&](std::int32_t element) {
        const auto& unknowns = elements.finest().unknowns[element];
        for (int row = 0; row < 8; ++row) {
            Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
            for (int corner = 0; corner < 8; ++corner)
                sum += matrices[element](row, corner) * vector.row(unknowns[corner]);
            products.col(8 * std::int64_t{element} + row) << sum.transpose().cast<float>(), 0;
        }
    });
}

}  // namespace tracked_mcf
