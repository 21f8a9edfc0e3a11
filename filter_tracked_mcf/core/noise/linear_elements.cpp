// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/linear_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "filter_tracked_mcf/core/mesh/triangle_elements.h"

namespace tracked_mcf {

namespace {

/// Conjugate gradients for displacements stop at this residual, relative to the first one.
constexpr double kToleranceOfPositions = 1e-3;
constexpr int kMostIterations = 500;

/// The share of the squared lengths of sides along the surface in the metric of the stiffness.
constexpr float kOwnShare = 0.3F;

/// The least square of four times a triangle's area, relative to that of the sum of its sides'
/// squares: above rounding, which very long sides have.
constexpr float kThinnest = 1e-6F;

/// Returns the squared lengths of a triangle's sides at right angles to a normal.
SquaredSides<float> sides_along_surface(const Positions& positions, const Triangle& t,
                                        const Eigen::Vector4f& normal) {
    const Eigen::Vector3f unit = normal.head<3>().normalized();
    SquaredSides<float> squares;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3f side =
            (positions[t[(k + 1) % 3]] - positions[t[(k + 2) % 3]]).cast<float>();
        squares[k] = (side - side.dot(unit) * unit).squaredNorm();
    }
    return squares;
}

}  // namespace

LinearElements::LinearElements(const NoisySurface& surface) : surface_(surface) {}

void LinearElements::assemble(const Vectors& normals, double normal_length,
                              const Positions* positions) {
    const Stars& stars = surface_.stars;
    const auto scale = static_cast<float>(normal_length * normal_length);
    TriangleElements elements(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(elements.size()), [&](std::int32_t i) {
        const Triangle& t = stars.triangles[i];
        const Eigen::Vector4f &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
        SquaredSides<float> squares =
            1 + scale * SquaredSides<float>((b - c).squaredNorm(), (c - a).squaredNorm(),
                                            (a - b).squaredNorm());
        const float mass = four_areas_of(squares, kThinnest) / 12;
        if (positions != nullptr) {
            squares += kOwnShare * (sides_along_surface(*positions, t, a + b + c) - 1);
        }
        elements[i] = triangle_element(squares, four_areas_of(squares, kThinnest));
        elements[i].mass = mass;
    });
    const bool has_flux = positions != nullptr && !stars.on_rim.empty();
    flux_.assign(has_flux ? static_cast<std::size_t>(stars.count()) : 0, Eigen::Vector4f::Zero());
    values_.resize(stars.neighbours.size());
    masses_.resize(static_cast<std::size_t>(stars.count()));
    diagonal_.resize(masses_.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const std::uint32_t begin = stars.neighbour_begin[vertex];
        const std::uint32_t end = stars.neighbour_begin[vertex + 1];
        std::fill(values_.begin() + begin, values_.begin() + end, 0.0F);
        float mass = 0;
        for (std::uint32_t i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1];
             ++i) {
            const TriangleElement<float>& element = elements[stars.corners[i] / 3];
            const std::uint32_t corner = stars.corners[i] % 3;
            values_[stars.places[i][0]] += element.weights[(corner + 2) % 3];
            values_[stars.places[i][1]] += element.weights[(corner + 1) % 3];
            mass += element.mass;
        }
        masses_[vertex] = mass;
        diagonal_[vertex] = std::accumulate(values_.begin() + begin, values_.begin() + end, 0.0F);
        if (!has_flux || stars.on_rim[vertex] == 0) return;
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
            flux_[vertex].head<3>() +=
                rim_flux(stars, triangle, corner, elements[triangle], *positions);
        });
    });
}

/// Returns row `vertex` of L x.
Eigen::Vector4f LinearElements::stiffness(const Vectors& x, std::int32_t vertex) const {
    const Stars& stars = surface_.stars;
    Eigen::Vector4f sum = diagonal_[vertex] * x[vertex];
    for (std::uint32_t i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
         ++i) {
        sum -= values_[i] * x[stars.neighbours[i]];
    }
    return sum;
}

/// Returns the square of the residual's norm that the preconditioner defines.
double LinearElements::residual_square() const {
    return sum_over_rows(surface_.stars.count(), [&](std::int32_t row) {
        return double{inverse_[row] * residual_[row].squaredNorm()};
    });
}

/// Solves for x by conjugate gradients until residual_square() is at most `limit`. The residual is
/// that of the given x. `multiply` sets product_ to the matrix times direction_. The coordinates
/// share the step lengths, so the result turns with the surface. Returns the number of iterations.
template <class Product>
int LinearElements::solve(const Product& multiply, double limit, Vectors& x) {
    const std::int32_t count = surface_.stars.count();
    product_.resize(x.size());
    direction_.assign(x.size(), Eigen::Vector4f::Zero());
    double square = residual_square();
    float keep = 0;
    int iterations = 0;
    for (; iterations < kMostIterations && square > limit; ++iterations) {
        parallel_for_rows(count, [&](std::int32_t row) {
            direction_[row] = inverse_[row] * residual_[row] + keep * direction_[row];
        });
        multiply();
        const double energy = sum_over_rows(
            count, [&](std::int32_t row) { return double{direction_[row].dot(product_[row])}; });
        if (!(energy > 0)) break;
        const auto step = static_cast<float>(square / energy);
        const double before = square;
        square = sum_over_rows(count, [&](std::int32_t row) {
            x[row] += step * direction_[row];
            residual_[row] -= step * product_[row];
            return double{inverse_[row] * residual_[row].squaredNorm()};
        });
        keep = static_cast<float>(square / before);
    }
    return iterations;
}

int LinearElements::smooth(double step_size, const Vectors& b, double tolerance, Vectors& x) {
    const std::int32_t count = surface_.stars.count();
    const auto delta = static_cast<float>(step_size);
    inverse_.resize(masses_.size());
    residual_.resize(masses_.size());
    parallel_for_rows(count, [&](std::int32_t row) {
        inverse_[row] = 1 / (masses_[row] + delta * diagonal_[row]);
        residual_[row] = masses_[row] * b[row];
    });
    const double limit = tolerance * tolerance * residual_square();
    parallel_for_rows(count, [&](std::int32_t row) {
        residual_[row] -= masses_[row] * x[row] + delta * stiffness(x, row);
    });
    const auto multiply = [&] {
        parallel_for_rows(count, [&](std::int32_t row) {
            product_[row] = masses_[row] * direction_[row] + delta * stiffness(direction_, row);
        });
    };
    return solve(multiply, limit, x);
}

int LinearElements::displace(double step_size, const Positions& positions, const Vectors& normals,
                             const std::vector<float>& heights, Vectors& d) {
    const Stars& stars = surface_.stars;
    const std::int32_t count = stars.count();
    const std::vector<float>& fidelity = surface_.fidelity;
    const auto delta = static_cast<float>(step_size);
    inverse_.resize(masses_.size());
    residual_.resize(masses_.size());
    inner_.resize(masses_.size());
    // The differences of positions, not positions, are rounded to single precision.
    parallel_for_rows(count, [&](std::int32_t row) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        float diagonal = diagonal_[row] * diagonal_[row] / masses_[row];
        float sum_of_heights = 0;
        for (std::uint32_t i = stars.neighbour_begin[row]; i < stars.neighbour_begin[row + 1];
             ++i) {
            const std::int32_t neighbour = stars.neighbours[i];
            sum += double{values_[i]} * (positions[row] - positions[neighbour]);
            diagonal += values_[i] * values_[i] / masses_[neighbour];
            if (heights.empty()) continue;
            sum_of_heights += values_[i] * (heights[row] - heights[neighbour]);
        }
        inner_[row] << (step_size / masses_[row] * sum).cast<float>(),
            delta / masses_[row] * sum_of_heights;
        if (!flux_.empty()) {
            const Eigen::Vector4f along = flux_[row].dot(normals[row]) * normals[row];
            inner_[row] -= delta / masses_[row] * (flux_[row] - along);
        }
        inverse_[row] =
            fidelity[row] > 0 ? 1 / (fidelity[row] * masses_[row] + delta * delta * diagonal) : 0;
    });
    parallel_for_rows(count, [&](std::int32_t row) {
        residual_[row] = -delta * stiffness(inner_, row);
        if (fidelity[row] == 0) residual_[row].setZero();
    });
    const auto multiply = [&] {
        parallel_for_rows(count, [&](std::int32_t row) {
            inner_[row] = delta / masses_[row] * stiffness(direction_, row);
        });
        parallel_for_rows(count, [&](std::int32_t row) {
            product_[row] =
                fidelity[row] * masses_[row] * direction_[row] + delta * stiffness(inner_, row);
            if (fidelity[row] == 0) product_[row].setZero();
        });
    };
    d.assign(masses_.size(), Eigen::Vector4f::Zero());
    return solve(multiply, kToleranceOfPositions * kToleranceOfPositions * residual_square(), d);
}

}  // namespace tracked_mcf
