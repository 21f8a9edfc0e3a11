// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/linear_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "filter_tracked_mcf/core/noise/chebyshev.h"

namespace tracked_mcf {

namespace {

/// The error of the filter t / (1 + t²). It changes what a wave keeps by up to the largest t times
/// as much, which has a bound, too. With both, distances and angles of 60 noisy parts and scans are
/// on average within 0.3 % of those with conjugate gradients to 1e-3.
constexpr double kErrorOfFilter = 3e-3, kErrorOfWaves = 5e-2;
/// Conjugate gradients for displacements stop at this residual, relative to the first one.
constexpr double kToleranceOfPositions = 3e-3;
constexpr int kMostIterations = 500;

/// The bound of the largest eigenvalue of δ L on a triangle, relative to its mass: this one, or
/// twice that of an equilateral triangle if that is more. Waves keep less than 1 / 250 there, and
/// stiffer triangles would only make the series longer. Chosen on the same meshes.
constexpr float kStiffest = 16, kTwiceEquilateral = 12;

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

/// Returns the larger one of the two eigenvalues of a triangle's stiffness that are not 0: their
/// sum is that of the cotangents, and their product 3/4.
float stiffness_of(const TriangleElement<float>& element) {
    const float sum = 2 * (element.weights[0] + element.weights[1] + element.weights[2]);
    return (sum + std::sqrt(std::max(sum * sum - 3, 0.0F))) / 2;
}

/// A number that parallel_sum() joins to the largest one.
struct Largest {
    double number = 0;
    Largest operator+(const Largest& other) const { return {std::max(number, other.number)}; }
};

/// Returns the largest body(row).
template <class Body>
double max_over_rows(std::int64_t rows, const Body& body) {
    const auto largest_of = [&](std::int64_t begin, std::int64_t end) {
        Largest largest;
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) {
            largest = largest + Largest{body(row)};
        }
        return largest;
    };
    return parallel_sum(rows, Largest(), largest_of).number;
}

}  // namespace

LinearElements::LinearElements(const NoisySurface& surface) : surface_(surface) {}

void LinearElements::assemble(const Vectors& normals, double normal_length, double step_size,
                              const Positions* positions) {
    const Stars& stars = surface_.stars;
    delta_ = static_cast<float>(step_size);
    const auto scale = static_cast<float>(normal_length * normal_length);
    triangles_.resize(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(triangles_.size()), [&](std::int32_t i) {
        const Triangle& t = stars.triangles[i];
        const Eigen::Vector4f &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
        SquaredSides<float> squares =
            1 + scale * SquaredSides<float>((b - c).squaredNorm(), (c - a).squaredNorm(),
                                            (a - b).squaredNorm());
        const float mass = four_areas_of(squares, kThinnest) / 12;
        if (positions != nullptr) {
            squares += kOwnShare * (sides_along_surface(*positions, t, a + b + c) - 1);
        }
        triangles_[i] = triangle_element(squares, four_areas_of(squares, kThinnest));
        triangles_[i].mass = mass;
        const float largest = std::max(kStiffest, kTwiceEquilateral * delta_) * mass,
                    stiffness = delta_ * stiffness_of(triangles_[i]);
        if (stiffness <= largest) return;
        for (float& weight : triangles_[i].weights) weight *= largest / stiffness;
    });
    const bool has_flux = positions != nullptr && !stars.on_rim.empty();
    flux_.assign(has_flux ? static_cast<std::size_t>(stars.count()) : 0, Eigen::Vector4f::Zero());
    values_.resize(stars.neighbours.size());
    masses_.resize(static_cast<std::size_t>(stars.count()));
    diagonal_.resize(masses_.size());
    // x · L x is the sum over triangles of less than their eigenvalue times Σ x² at their corners.
    largest_eigenvalue_ = max_over_rows(stars.count(), [&](std::int32_t vertex) {
        const std::uint32_t begin = stars.neighbour_begin[vertex];
        const std::uint32_t end = stars.neighbour_begin[vertex + 1];
        std::fill(values_.begin() + begin, values_.begin() + end, 0.0F);
        float mass = 0, largest = 0;
        for (std::uint32_t i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1];
             ++i) {
            const TriangleElement<float>& element = triangles_[stars.corners[i] / 3];
            const std::uint32_t corner = stars.corners[i] % 3;
            values_[stars.places[i][0]] += element.weights[(corner + 2) % 3];
            values_[stars.places[i][1]] += element.weights[(corner + 1) % 3];
            mass += element.mass;
            largest += stiffness_of(element);
        }
        masses_[vertex] = mass;
        diagonal_[vertex] = std::accumulate(values_.begin() + begin, values_.begin() + end, 0.0F);
        if (has_flux && stars.on_rim[vertex] != 0) {
            for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
                flux_[vertex].head<3>() +=
                    rim_flux(stars, triangle, corner, triangles_[triangle], *positions);
            });
        }
        return double{delta_ * largest / mass};
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

/// Solves x = J(x) as ChebyshevAcceleration says; jacobi(x, row) returns a row of J(x). Returns the
/// number of iterations.
template <class Jacobi>
int LinearElements::accelerate(const Jacobi& jacobi, double low, double high, double reduction,
                               Vectors& x) {
    ChebyshevAcceleration acceleration(low, high);
    const int steps = acceleration.steps(reduction);
    Vectors& before = residual_;
    before.resize(x.size());
    for (int step = 0; step < steps; ++step) {
        acceleration.advance();
        const float omega = acceleration.omega(), gamma = acceleration.gamma();
        const bool has_before = step > 0;
        parallel_for_rows(surface_.stars.count(), [&](std::int32_t row) {
            Eigen::Vector4f next = x[row] + gamma * (jacobi(x, row) - x[row]);
            if (has_before) next = omega * next + (1 - omega) * before[row];
            before[row] = next;
        });
        x.swap(before);
    }
    return steps;
}

int LinearElements::smooth(const Vectors& b, double reduction, Vectors& x) {
    const Stars& stars = surface_.stars;
    const auto diagonal = [&](std::int32_t row) { return masses_[row] + delta_ * diagonal_[row]; };
    // Gershgorin's bound; only obtuse angles make it larger than 2.
    const double high = max_over_rows(stars.count(), [&](std::int32_t row) {
        float sum = 0;
        for (auto i = stars.neighbour_begin[row]; i < stars.neighbour_begin[row + 1]; ++i) {
            sum += std::abs(values_[i]);
        }
        return 1 + double{delta_ * sum / diagonal(row)};
    });
    // About that of a constant. The error of a wave with a smaller eigenvalue falls a little less.
    const double masses =
        sum_over_rows(stars.count(), [&](std::int32_t row) { return double{masses_[row]}; });
    const double diagonals =
        sum_over_rows(stars.count(), [&](std::int32_t row) { return double{diagonal(row)}; });
    const auto jacobi = [&](const Vectors& from, std::int32_t row) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (auto i = stars.neighbour_begin[row]; i < stars.neighbour_begin[row + 1]; ++i) {
            sum += values_[i] * from[stars.neighbours[i]];
        }
        return Eigen::Vector4f((masses_[row] * b[row] + delta_ * sum) / diagonal(row));
    };
    return accelerate(jacobi, masses / diagonals, high, reduction, x);
}

int LinearElements::smooth_evenly(double step_size, const Vectors& b, double reduction,
                                  Vectors& x) {
    const Stars& stars = surface_.stars;
    // A row of D⁻¹ (M + δ L) is x - share * (the mean of x at the other corners of the star). This
    // has eigenvalues from -1/2, as in a single triangle, to 1.
    const double share = 4 * step_size / (1 + 4 * step_size);
    const auto of_mean = static_cast<float>(share), of_b = static_cast<float>(1 - share);
    const auto jacobi = [&](const Vectors& from, std::int32_t row) {
        const std::uint32_t begin = stars.neighbour_begin[row],
                            end = stars.neighbour_begin[row + 1], first = stars.corner_begin[row],
                            last = stars.corner_begin[row + 1];
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        float count = 0;
        if (end - begin == last - first && (stars.on_rim.empty() || stars.on_rim[row] == 0)) {
            // Each side has two triangles.
            for (std::uint32_t i = begin; i < end; ++i) sum += from[stars.neighbours[i]];
            count = static_cast<float>(end - begin);
        } else {
            for (std::uint32_t i = first; i < last; ++i) {
                for (const std::uint32_t place : stars.places[i])
                    sum += from[stars.neighbours[place]];
            }
            count = static_cast<float>(2 * (last - first));
        }
        return Eigen::Vector4f(of_b * b[row] + of_mean / count * sum);
    };
    return accelerate(jacobi, 1 - share, 1 + share / 2, reduction, x);
}

/// Finds δ M⁻¹ (L X - f), and the same of heights. The differences of positions, not positions, are
/// rounded to single precision.
void LinearElements::find_curvatures(const Positions& positions, const Vectors& normals,
                                     const std::vector<float>& heights, Vectors& curvatures) const {
    const Stars& stars = surface_.stars;
    curvatures.resize(masses_.size());
    parallel_for_rows(stars.count(), [&](std::int32_t row) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        float sum_of_heights = 0;
        for (auto i = stars.neighbour_begin[row]; i < stars.neighbour_begin[row + 1]; ++i) {
            const std::int32_t neighbour = stars.neighbours[i];
            sum += double{values_[i]} * (positions[row] - positions[neighbour]);
            if (heights.empty()) continue;
            sum_of_heights += values_[i] * (heights[row] - heights[neighbour]);
        }
        Eigen::Vector4f all;
        all << sum.cast<float>(), sum_of_heights;
        if (!flux_.empty()) {
            all -= flux_[row] - flux_[row].dot(normals[row]) * normals[row];
        }
        curvatures[row] = delta_ / masses_[row] * all;
    });
}

int LinearElements::displace(const Positions& positions, const Vectors& normals,
                             const std::vector<float>& heights, Vectors& d) {
    const std::vector<float>& fidelity = surface_.fidelity;
    find_curvatures(positions, normals, heights, inner_);
    const auto is_one = [](float each) { return each == 1; };
    return std::all_of(fidelity.begin(), fidelity.end(), is_one)
               ? displace_by_series(d)
               : displace_by_conjugate_gradients(d);
}

/// Returns -g(K) c for K = δ M⁻¹ L, g(t) = t / (1 + t²) and the curvatures c, by Clenshaw's
/// recurrence y_k = a_k c + 2 S y_(k+1) - y_(k+2), where S = 2 K / (its largest eigenvalue) - 1.
/// The poles of g are away from the real axis, so this converges faster than conjugate gradients
/// for 1 + K².
int LinearElements::displace_by_series(Vectors& d) {
    const std::int32_t count = surface_.stars.count();
    const std::vector<double> series = series_of_filter(
        largest_eigenvalue_, std::min(kErrorOfFilter, kErrorOfWaves / largest_eigenvalue_));
    const auto degree = static_cast<int>(series.size()) - 1;
    const auto scale = static_cast<float>(2 / largest_eigenvalue_);
    Vectors& y = direction_;
    y.resize(inner_.size());
    d.resize(inner_.size());
    const auto last = static_cast<float>(-series[degree]);
    parallel_for_rows(count, [&](std::int32_t row) { y[row] = last * inner_[row]; });
    for (int k = degree - 1; k >= 0; --k) {
        const auto coefficient = static_cast<float>(-series[k]);
        const float of_product = k > 0 ? 2 : 1;
        const bool is_first = k == degree - 1;
        parallel_for_rows(count, [&](std::int32_t row) {
            const Eigen::Vector4f sum =
                coefficient * inner_[row] + of_product * (scale * curvature(y, row) - y[row]);
            d[row] = is_first ? sum : sum - d[row];
        });
        y.swap(d);
    }
    y.swap(d);
    return degree;
}

/// Solves by conjugate gradients. The coordinates share the step lengths, so the result turns with
/// the surface.
int LinearElements::displace_by_conjugate_gradients(Vectors& d) {
    const Stars& stars = surface_.stars;
    const std::int32_t count = stars.count();
    const std::vector<float>& fidelity = surface_.fidelity;
    const float delta = delta_;
    inverse_.resize(masses_.size());
    residual_.resize(masses_.size());
    product_.resize(masses_.size());
    direction_.assign(masses_.size(), Eigen::Vector4f::Zero());
    d.assign(masses_.size(), Eigen::Vector4f::Zero());
    double square = sum_over_rows(count, [&](std::int32_t row) {
        float diagonal = diagonal_[row] * diagonal_[row] / masses_[row];
        for (auto i = stars.neighbour_begin[row]; i < stars.neighbour_begin[row + 1]; ++i) {
            diagonal += values_[i] * values_[i] / masses_[stars.neighbours[i]];
        }
        inverse_[row] =
            fidelity[row] > 0 ? 1 / (fidelity[row] * masses_[row] + delta * delta * diagonal) : 0;
        residual_[row] = -delta * stiffness(inner_, row);
        if (fidelity[row] == 0) residual_[row].setZero();
        return double{inverse_[row] * residual_[row].squaredNorm()};
    });
    const double limit = kToleranceOfPositions * kToleranceOfPositions * square;
    float keep = 0;
    int iterations = 0;
    for (; iterations < kMostIterations && square > limit; ++iterations) {
        parallel_for_rows(count, [&](std::int32_t row) {
            direction_[row] = inverse_[row] * residual_[row] + keep * direction_[row];
        });
        parallel_for_rows(count,
                          [&](std::int32_t row) { inner_[row] = curvature(direction_, row); });
        const double energy = sum_over_rows(count, [&](std::int32_t row) {
            product_[row] =
                fidelity[row] * masses_[row] * direction_[row] + delta * stiffness(inner_, row);
            if (fidelity[row] == 0) product_[row].setZero();
            return double{direction_[row].dot(product_[row])};
        });
        if (!(energy > 0)) break;
        const auto step = static_cast<float>(square / energy);
        const double before = square;
        square = sum_over_rows(count, [&](std::int32_t row) {
            d[row] += step * direction_[row];
            residual_[row] -= step * product_[row];
            return double{inverse_[row] * residual_[row].squaredNorm()};
        });
        keep = static_cast<float>(square / before);
    }
    return iterations;
}

}  // namespace tracked_mcf
