// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"

namespace tracked_mcf {

/// Returns the grid of an octree of these vertices.
inline Grid grid_around(const std::vector<Eigen::Vector3d>& positions, int depth) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : positions) box.extend(position);
    return with_depth(cube_around(box), depth);
}

inline TriangleElements elements_of(const Surface& surface) {
    return elements_in_own_metric(surface.stars, surface.positions, {});
}

/// Returns half the lumped and half the consistent mass.
inline Eigen::MatrixXd dense_mass(const Stars& stars, const TriangleElements& elements) {
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(stars.count(), stars.count());
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const double area = 3 * double{elements[i].mass};
        for (const std::int32_t row : stars.triangles[i]) {
            mass(row, row) += area / 6;
            for (const std::int32_t column : stars.triangles[i]) {
                mass(row, column) += area / 24 * (row == column ? 2 : 1);
            }
        }
    }
    return mass;
}

inline Eigen::MatrixXd dense_stiffness(const Stars& stars, const TriangleElements& elements) {
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(stars.count(), stars.count());
    for (std::size_t i = 0; i < elements.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = stars.triangles[i][(k + 1) % 3];
            const std::int32_t b = stars.triangles[i][(k + 2) % 3];
            const double weight = elements[i].weights[k];
            stiffness(a, a) += weight;
            stiffness(b, b) += weight;
            stiffness(a, b) -= weight;
            stiffness(b, a) -= weight;
        }
    }
    return stiffness;
}

/// Returns the rows of a system that are eliminated together, in the order of their elimination.
inline std::vector<Elimination::Rows> rows_in_order(const MeshSystem& system) {
    const Elimination& elimination = system.elimination();
    std::vector<Elimination::Rows> rows;
    rows.reserve(static_cast<std::size_t>(system.blocks().count()));
    for (std::int32_t block = 0; block < system.blocks().count(); ++block)
        rows.push_back(elimination.inside(block));
    for (const auto& separators : elimination.later_stages()) {
        for (const Elimination::Separator& separator : separators) rows.push_back(separator.rows);
    }
    return rows;
}

/// Returns A x.
inline Field product_of(const MeshSystem& system, const Field& x) {
    Field other = Field::Zero(4, x.cols()), p = other, product = other;
    for (const Elimination::Rows& rows : rows_in_order(system))
        system.advance(rows, {}, x, other, p, product);
    return product;
}

/// Returns b / unit - A x.
inline Field residual_of(const MeshSystem& system, const Field& b,
                         const std::vector<Eigen::Vector3d>& x, double unit = 1) {
    Field residual(4, b.cols());
    for (std::int32_t i = 0; i < system.blocks().count(); ++i)
        system.residual(system.blocks()[i], b, unit, x, residual);
    return residual;
}

/// Returns random numbers from -1 to 1; 0 at held vertices.
inline Field random_at_vertices(const Surface& surface, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Field field = Field::Zero(4, surface.stars.count());
    for (std::int32_t vertex = 0; vertex < surface.stars.count(); ++vertex) {
        if (surface.held[vertex] != 0) continue;
        for (int axis = 0; axis < 3; ++axis) field(axis, vertex) = uniform(random);
    }
    return field;
}

/// Returns a field as one row per vertex.
inline Eigen::MatrixXd rows_of(const Field& field) {
    return field.topRows<3>().cast<double>().transpose();
}

inline Eigen::MatrixXd rows_of(const std::vector<Eigen::Vector3d>& positions) {
    Eigen::MatrixXd rows(positions.size(), 3);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        rows.row(static_cast<Eigen::Index>(i)) = positions[i].transpose();
    }
    return rows;
}

/// Sets the rows of held vertices to zero.
inline Eigen::MatrixXd without_held_rows(const Surface& surface, Eigen::MatrixXd matrix) {
    for (std::int32_t vertex = 0; vertex < surface.stars.count(); ++vertex) {
        if (surface.held[vertex] != 0) matrix.row(vertex).setZero();
    }
    return matrix;
}

}  // namespace tracked_mcf
