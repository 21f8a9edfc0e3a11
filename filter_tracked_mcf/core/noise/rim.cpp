// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/rim.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tracked_mcf {

namespace {

using CurveMatrix = Eigen::SparseMatrix<double>;
using CurvePoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// δ for positions and for tangents, in squared edges.
constexpr double kRimStepSize = 2.4, kTangentStepSize = 6;
/// The length s of the metric, relative to that at which the least corner is as wide as an edge.
constexpr double kTangentLength = 4;

/// A step that would take a vertex out of the box is made with a quarter of its size, at most so
/// many times.
constexpr int kMostSmallerSteps = 8;

/// Sides count as at least so long, in edges.
constexpr double kShortest = 0.1;

/// The curves of a rim, whose vertices have numbers of their own.
struct Curves {
    std::vector<std::int32_t> vertices;              ///< of the surface
    std::vector<std::array<Eigen::Index, 2>> sides;  ///< the numbers of their ends, as oriented
    std::vector<std::uint8_t> is_held;               ///< per vertex
    std::vector<double> fidelity;                    ///< per vertex
};

/// Lists the curves. Vertices stay where not one side ends and another one begins.
Curves curves_of(const NoisySurface& surface) {
    const Stars& stars = surface.stars;
    Curves curves;
    std::vector<std::int32_t> numbers(stars.on_rim.size(), -1);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (stars.on_rim[i] == 0) continue;
        numbers[i] = static_cast<std::int32_t>(curves.vertices.size());
        curves.vertices.push_back(static_cast<std::int32_t>(i));
        curves.fidelity.push_back(double{surface.fidelity[i]});
    }
    std::vector<int> begins(curves.vertices.size(), 0), ends(curves.vertices.size(), 0);
    for (std::size_t i = 0; i < stars.rim_sides.size(); ++i) {
        if (stars.rim_sides[i] == 0) continue;
        const Triangle& t = stars.triangles[i / 3];
        const std::int32_t from = numbers[t[i % 3]], to = numbers[t[(i + 1) % 3]];
        curves.sides.push_back({from, to});
        ++begins[from];
        ++ends[to];
    }
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const bool is_regular = begins[i] == 1 && ends[i] == 1;
        curves.is_held.push_back(is_regular && curves.fidelity[i] > 0 ? 0 : 1);
    }
    return curves;
}

/// Mass and stiffness of linear elements on the curves.
struct CurveElements {
    Eigen::VectorXd masses;
    CurveMatrix stiffness;
};

CurveElements elements_of(const Curves& curves, const CurvePoints& positions,
                          const CurvePoints& tangents, double tangent_length) {
    const Eigen::Index count = tangents.rows();
    CurveElements elements{Eigen::VectorXd::Zero(count), CurveMatrix(count, count)};
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [i, j] : curves.sides) {
        const double turn = tangent_length * (tangents.row(j) - tangents.row(i)).norm();
        const double side = std::max(kShortest, (positions.row(j) - positions.row(i)).norm());
        const double length = side * std::hypot(1, turn);
        elements.masses[i] += length / 2;
        elements.masses[j] += length / 2;
        const auto add = [&, inverse = 1 / length](Eigen::Index row, Eigen::Index column,
                                                   int sign) {
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), sign * inverse);
        };
        add(i, i, 1);
        add(j, j, 1);
        add(i, j, -1);
        add(j, i, -1);
    }
    elements.stiffness.setFromTriplets(entries.begin(), entries.end());
    return elements;
}

/// Returns the solution of (diagonal + matrix) x = b.
CurvePoints solution(const Eigen::VectorXd& diagonal, CurveMatrix matrix, const CurvePoints& b) {
    matrix.diagonal() += diagonal;
    return Eigen::SimplicialLDLT<CurveMatrix>(matrix).solve(b);
}

/// Leaves rows without a direction as they are.
void normalize_rows(CurvePoints& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i).normalize();
}

/// Returns unit tangents of the curves, smoothed as normals are.
CurvePoints smooth_tangents(const Curves& curves, const CurvePoints& positions,
                            double tangent_length) {
    CurvePoints mean = CurvePoints::Zero(positions.rows(), 3);
    for (const auto& [i, j] : curves.sides) {
        mean.row(i) += positions.row(j) - positions.row(i);
        mean.row(j) += positions.row(j) - positions.row(i);
    }
    normalize_rows(mean);
    CurvePoints tangents = mean;
    for (const double length : {0.0, tangent_length}) {
        const CurveElements elements = elements_of(curves, positions, tangents, length);
        tangents = solution(elements.masses, kTangentStepSize * elements.stiffness,
                            elements.masses.asDiagonal() * mean);
        normalize_rows(tangents);
    }
    return tangents;
}

/// Returns the displacements of a step, δ.
CurvePoints displacements(const Curves& curves, const CurveElements& elements, double step_size,
                          const CurvePoints& x) {
    const Eigen::VectorXd inverse = step_size * step_size * elements.masses.cwiseInverse();
    CurveMatrix bending = elements.stiffness * inverse.asDiagonal() * elements.stiffness;
    CurvePoints force = -(bending * x);
    Eigen::VectorXd fidelities(x.rows());
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const auto vertex = static_cast<std::size_t>(i);
        fidelities[i] = elements.masses[i] * curves.fidelity[vertex];
        if (curves.is_held[vertex] == 0) continue;
        fidelities[i] = 1;
        force.row(i).setZero();
    }
    bending.prune([&](Eigen::Index row, Eigen::Index column, double /*value*/) {
        return row == column || (curves.is_held[static_cast<std::size_t>(row)] == 0 &&
                                 curves.is_held[static_cast<std::size_t>(column)] == 0);
    });
    return solution(fidelities, bending, force);
}

}  // namespace

void smooth_rim(const NoisySurface& surface, double crease, const Eigen::AlignedBox3d& box,
                Positions& positions) {
    if (surface.stars.on_rim.empty()) return;
    const Curves curves = curves_of(surface);
    const auto count = static_cast<Eigen::Index>(curves.vertices.size());
    CurvePoints x(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        x.row(i) = positions[curves.vertices[static_cast<std::size_t>(i)]].transpose();
    }
    const double tangent_length = crease > 0 ? kTangentLength / crease : 0;
    const CurveElements elements =
        elements_of(curves, x, smooth_tangents(curves, x, tangent_length), tangent_length);
    const auto leaves_box = [&](const CurvePoints& moved) {
        for (Eigen::Index i = 0; i < count; ++i) {
            if (!box.contains(Eigen::Vector3d(moved.row(i)))) return true;
        }
        return false;
    };
    double step_size = kRimStepSize;
    CurvePoints moved = x + displacements(curves, elements, step_size, x);
    for (int tries = 0; tries < kMostSmallerSteps && leaves_box(moved); ++tries) {
        step_size /= 4;
        moved = x + displacements(curves, elements, step_size, x);
    }
    if (leaves_box(moved)) return;
    for (Eigen::Index i = 0; i < count; ++i) {
        positions[curves.vertices[static_cast<std::size_t>(i)]] = moved.row(i).transpose();
    }
}

}  // namespace tracked_mcf
