// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/cotangent_flow.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "tests/support/measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The stiffness of a triangle is that of one with at least this quality. Larger cotangents would
/// drown all others; this one still keeps collinear vertices collinear.
constexpr double kLeastQuality = 1e-6;

/// A vertex keeps at least this share of its initial mass. Otherwise the matrix would become
/// singular where the surface has shrunk to nothing.
constexpr double kLeastMassRatio = 1e-4;

/// Below one of these, a triangle counts as degenerated.
constexpr double kDoubtfulQuality = 0.01;
constexpr double kDoubtfulAreaRatio = 0.01;

/// Above this relative residual, the solution is refined once.
constexpr double kResidualGoal = 1e-12;

double area(const TriangleMesh& mesh, const Triangle& t) {
    return 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]])
                     .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                     .norm();
}

/// Returns, as columns, the edges opposite to the corners, in the order of the corners.
Matrix3d opposite_edges(const TriangleMesh& mesh, const Triangle& t) {
    Matrix3d edges;
    for (int i = 0; i < 3; ++i) {
        edges.col(i) = mesh.positions[t[(i + 2) % 3]] - mesh.positions[t[(i + 1) % 3]];
    }
    return edges;
}

/// A triangle's part of the linear system for the displacement: one linear function per corner.
struct Element {
    Matrix3d matrix;       ///< mass + δ stiffness
    Matrix3d right_sides;  ///< columns: -δ times the gradient of the area, corner by corner
};

/// The gradient S x is computed as n × edge / 2: in the product with S, the rounding errors of
/// large cotangents would not cancel.
Element element_of(const TriangleMesh& mesh, const Triangle& t, double step_size) {
    const Matrix3d edges = opposite_edges(mesh, t);
    if (edges.isZero(0)) return {Matrix3d::Zero(), Matrix3d::Zero()};
    const double least_area = kLeastQuality * edges.squaredNorm() / (4 * std::sqrt(3.0));
    const Vector3d normal = edges.col(0).cross(edges.col(1)).normalized();
    Element element;
    element.matrix =
        area(mesh, t) / 12 * (Matrix3d::Ones() + Matrix3d::Identity()) +
        step_size / (4 * std::max(area(mesh, t), least_area)) * (edges.transpose() * edges);
    for (int i = 0; i < 3; ++i) {
        element.right_sides.col(i) = -0.5 * step_size * normal.cross(edges.col(i));
    }
    return element;
}

/// Returns, per welded vertex, whether it lies on the boundary.
std::vector<std::uint8_t> boundary_vertices(const TriangleMesh& mesh) {
    const Surface surface = surface_of(mesh);
    std::vector<std::uint8_t> on_boundary(mesh.positions.size());
    for (std::size_t i = 0; i < on_boundary.size() && surface.stars.has_rim(); ++i) {
        const std::int32_t vertex = surface.vertices[i];
        if (vertex >= 0) on_boundary[i] = surface.stars.on_rim[vertex];
    }
    return on_boundary;
}

}  // namespace

double triangle_quality(const TriangleMesh& mesh, const Triangle& triangle) {
    const double squares = opposite_edges(mesh, triangle).squaredNorm();
    return squares > 0 ? 4 * std::sqrt(3.0) * area(mesh, triangle) / squares : 0;
}

CotangentFlow::CotangentFlow(const TriangleMesh& mesh, double step_size, BoundaryCondition boundary)
    : mesh_(mesh),
      welded_(weld_coincident_vertices(mesh, referenced_vertices(mesh))),
      constrained_(mesh.positions.size()),
      degenerated_(mesh.triangles.size()) {
    const double side = longest_side(mesh);
    step_size_ = step_size * side * side;
    if (boundary != BoundaryCondition::Free) constrained_ = boundary_vertices(mesh);
    for (const Triangle& t : mesh.triangles) initial_areas_.push_back(area(mesh, t));
    initial_masses_ = masses();
    look_for_degenerated();
}

void CotangentFlow::step() {
    assemble();
    const Points displacement = solve();
    for (std::size_t i = 0; i < welded_.size(); ++i) {
        mesh_.positions[i] += displacement.row(welded_[i]).transpose();
    }
    look_for_degenerated();
}

std::vector<double> CotangentFlow::masses() const {
    std::vector<double> masses(mesh_.positions.size());
    for (const Triangle& t : mesh_.triangles) {
        for (const std::int32_t vertex : t) masses[welded_[vertex]] += area(mesh_, t) / 3;
    }
    return masses;
}

/// The pattern is the same in every step: entries of constrained vertices are stored as zeros.
void CotangentFlow::assemble() {
    const auto size = static_cast<Eigen::Index>(mesh_.positions.size());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * mesh_.triangles.size() + mesh_.positions.size());
    right_side_.setZero(size, 3);
    for (const Triangle& t : mesh_.triangles) {
        const Element element = element_of(mesh_, t, step_size_);
        for (int i = 0; i < 3; ++i) {
            const std::int32_t row = welded_[t[i]];
            for (int j = 0; j < 3; ++j) {
                const std::int32_t column = welded_[t[j]];
                const bool counts = constrained_[row] == 0 && constrained_[column] == 0;
                entries.emplace_back(row, column, counts ? element.matrix(i, j) : 0);
            }
            if (constrained_[row] == 0)
                right_side_.row(row) += element.right_sides.col(i).transpose();
        }
    }
    const std::vector<double> masses = this->masses();
    for (std::int32_t i = 0; i < size; ++i) {
        const double missing = std::max(0.0, kLeastMassRatio * initial_masses_[i] - masses[i]);
        // A constrained vertex, or one in no triangle, has an empty row and no right-hand side.
        const bool is_empty = constrained_[i] != 0 || masses[i] + missing == 0;
        entries.emplace_back(i, i, is_empty ? step_size_ : missing);
    }
    matrix_.resize(size, size);
    matrix_.setFromTriplets(entries.begin(), entries.end());
}

CotangentFlow::Points CotangentFlow::solve() {
    if (!is_analyzed_) solver_.analyzePattern(matrix_);
    is_analyzed_ = true;
    solver_.factorize(matrix_);
    if (solver_.info() != Eigen::Success) {
        throw std::runtime_error("The cotangent flow's matrix cannot be factorised.");
    }
    const double norm = std::max(right_side_.norm(), 1e-300);
    Points displacement = solver_.solve(right_side_);
    Points residual = right_side_ - matrix_ * displacement;
    if (residual.norm() > kResidualGoal * norm) {
        displacement += solver_.solve(residual);
        residual = right_side_ - matrix_ * displacement;
    }
    relative_residual_ = residual.norm() / norm;
    return displacement;
}

void CotangentFlow::look_for_degenerated() {
    smallest_quality_ = 1;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        const Triangle& t = mesh_.triangles[i];
        const double quality = triangle_quality(mesh_, t);
        smallest_quality_ = std::min(smallest_quality_, quality);
        if (quality < kDoubtfulQuality || area(mesh_, t) < kDoubtfulAreaRatio * initial_areas_[i]) {
            degenerated_[i] = 1;
        }
    }
}

}  // namespace tracked_mcf
