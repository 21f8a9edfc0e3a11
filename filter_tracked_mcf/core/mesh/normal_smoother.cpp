// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/normal_smoother.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Edges hardly change after this many solves.
constexpr int kFits = 3;

/// Conjugate gradients stop at this residual, relative to the right-hand side. Normals need not be
/// more accurate, since the metric averages them over triangles.
constexpr double kTolerance = 1e-3;
constexpr int kMostIterations = 500;

/// The least ratio of a triangle's area to its sides' squares, in any metric, so that all
/// cotangents are finite.
constexpr double kLeastAreaRatio = 1e-6;

/// One number for each coordinate.
using Numbers = Eigen::Array3d;

Numbers inner_product(const std::vector<Eigen::Vector3f>& a, const std::vector<Eigen::Vector3f>& b,
                      const std::vector<float>& divisors) {
    const auto count = static_cast<std::int64_t>(a.size());
    return parallel_sum(count, Numbers(Numbers::Zero()), [&](std::int64_t begin, std::int64_t end) {
        Numbers sum = Numbers::Zero();
        for (std::int64_t i = begin; i < end; ++i) {
            const double scale = divisors.empty() ? 1 : divisors[i] > 0 ? 1 / divisors[i] : 0;
            sum += scale * a[i].cast<double>().array() * b[i].cast<double>().array();
        }
        return sum;
    });
}

Numbers ratio(const Numbers& a, const Numbers& b) {
    return (b > 0).select(a / b, 0);
}

}  // namespace

NormalSmoother::NormalSmoother(const MeshTopology& topology, std::vector<double> densities)
    : triangles_(topology.triangles), densities_(std::move(densities)) {
    orient(topology);
    find_stars(topology.welded.size());
}

void NormalSmoother::orient(const MeshTopology& topology) {
    struct Side {
        std::int32_t triangle;
        bool forwards;  ///< from the edge's smaller vertex to the larger one
    };
    // The sides of each edge.
    std::vector<std::int32_t> begin(static_cast<std::size_t>(topology.edge_count) + 1, 0);
    const auto count = static_cast<std::int32_t>(triangles_.size());
    const auto for_each_side = [&](std::int32_t triangle, const auto& visit) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge == MeshTopology::kNoEdge) continue;
            const Triangle& t = triangles_[triangle];
            visit(edge, t[side] < t[(side + 1) % 3]);
        }
    };
    for (std::int32_t t = 0; t < count; ++t) {
        for_each_side(t, [&](std::int32_t edge, bool) { ++begin[edge + 1]; });
    }
    for (std::size_t edge = 1; edge < begin.size(); ++edge) begin[edge] += begin[edge - 1];
    std::vector<Side> sides(static_cast<std::size_t>(begin.back()));
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (std::int32_t t = 0; t < count; ++t) {
        for_each_side(t, [&](std::int32_t edge, bool forwards) {
            sides[next[edge]++] = {t, forwards};
        });
    }
    // Orients each component like its first triangle, by a search in breadth.
    constexpr std::uint8_t unknown = 2;
    flipped_.assign(triangles_.size(), unknown);
    std::vector<std::int32_t> queue;
    for (std::int32_t first = 0; first < count; ++first) {
        if (flipped_[first] != unknown) continue;
        flipped_[first] = 0;
        queue.assign(1, first);
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::uint8_t here = flipped_[queue[i]];
            for_each_side(queue[i], [&](std::int32_t edge, bool forwards) {
                // Where more than two triangles meet, none continues another.
                if (begin[edge + 1] - begin[edge] != 2) return;
                for (std::int32_t s = begin[edge]; s < begin[edge + 1]; ++s) {
                    if (flipped_[sides[s].triangle] != unknown) continue;
                    const bool alike = sides[s].forwards != forwards;
                    flipped_[sides[s].triangle] = alike ? here : std::uint8_t(1 - here);
                    queue.push_back(sides[s].triangle);
                }
            });
            poll_progress();
        }
    }
}

void NormalSmoother::find_stars(std::size_t vertex_count) {
    star_begin_.assign(vertex_count + 1, 0);
    for (const Triangle& t : triangles_) {
        for (const std::int32_t vertex : t) ++star_begin_[vertex + 1];
    }
    for (std::size_t i = 1; i <= vertex_count; ++i) star_begin_[i] += star_begin_[i - 1];
    stars_.resize(3 * triangles_.size());
    std::vector<std::int64_t> next(star_begin_.begin(), star_begin_.end() - 1);
    for (std::uint32_t corner = 0; corner < stars_.size(); ++corner) {
        stars_[next[triangles_[corner / 3][corner % 3]]++] = corner;
    }
}

template <class Visit>
void NormalSmoother::for_each_corner(std::int32_t vertex, const Visit& visit) const {
    for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
        visit(stars_[i] / 3, static_cast<int>(stars_[i] % 3));
    }
}

const std::vector<Eigen::Vector3f>& NormalSmoother::smooth(
    const std::vector<Eigen::Vector3d>& positions, double step_size, double normal_length) {
    average_normals(positions);
    normals_ = averages_;
    for (int fit = 0; fit < kFits; ++fit) {
        assemble(positions, step_size, fit == 0 ? 0 : normal_length);
        solve();
        parallel_for_rows(static_cast<std::int64_t>(normals_.size()),
                          [&](std::int32_t vertex) { normals_[vertex].normalize(); });
    }
    return normals_;
}

void NormalSmoother::average_normals(const std::vector<Eigen::Vector3d>& positions) {
    averages_.resize(positions.size());
    parallel_for_rows(static_cast<std::int64_t>(positions.size()), [&](std::int32_t vertex) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for_each_corner(vertex, [&](std::uint32_t triangle, int) {
            const auto [a, b, c] = corners_of(positions, triangles_[triangle]);
            const Eigen::Vector3d area = twice_vector_area(a, b, c);
            sum += flipped_[triangle] != 0 ? Eigen::Vector3d(-area) : area;
        });
        averages_[vertex] = sum.normalized().cast<float>();
    });
}

void NormalSmoother::assemble(const std::vector<Eigen::Vector3d>& positions, double step_size,
                              double normal_length) {
    weights_.resize(triangles_.size());
    parallel_for_rows(static_cast<std::int64_t>(triangles_.size()), [&](std::int32_t i) {
        const Triangle& t = triangles_[i];
        const double scale = normal_length * normal_length / density(i);
        std::array<double, 3> squares;  // of the side opposite to each corner
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
            squares[k] = (positions[a] - positions[b]).squaredNorm() +
                         scale * double{(normals_[a] - normals_[b]).squaredNorm()};
        }
        const double sum = squares[0] + squares[1] + squares[2];
        const double squared_sum =
            squares[0] * squares[0] + squares[1] * squares[1] + squares[2] * squares[2];
        // Heron's formula
        const double area = std::max(std::sqrt(std::max(sum * sum - 2 * squared_sum, 0.0)) / 4,
                                     kLeastAreaRatio * sum);
        for (int k = 0; k < 3; ++k) {
            const double cotangent = area > 0 ? (sum - 2 * squares[k]) / (4 * area) : 0;
            weights_[i][k] = static_cast<float>(0.5 * step_size * cotangent);
        }
        weights_[i][3] = static_cast<float>(density(i) * area / 3);
    });
    masses_.resize(positions.size());
    diagonal_.resize(positions.size());
    parallel_for_rows(static_cast<std::int64_t>(positions.size()), [&](std::int32_t vertex) {
        float mass = 0, stiffness = 0;
        for_each_corner(vertex, [&](std::uint32_t triangle, int corner) {
            const auto& weights = weights_[triangle];
            mass += weights[3];
            stiffness += weights[(corner + 1) % 3] + weights[(corner + 2) % 3];
        });
        masses_[vertex] = mass;
        diagonal_[vertex] = mass + stiffness;
    });
}

Eigen::Vector3f NormalSmoother::product(const Field& x, std::int32_t vertex) const {
    const Eigen::Vector3f& own = x[vertex];
    Eigen::Vector3f sum = masses_[vertex] * own;
    for_each_corner(vertex, [&](std::uint32_t triangle, int corner) {
        const int next = (corner + 1) % 3, last = (corner + 2) % 3;
        sum += weights_[triangle][last] * (own - x[triangles_[triangle][next]]) +
               weights_[triangle][next] * (own - x[triangles_[triangle][last]]);
    });
    return sum;
}

/// Conjugate gradients, preconditioned by the diagonal, for the three coordinates side by side.
void NormalSmoother::solve() {
    const auto count = static_cast<std::int64_t>(normals_.size());
    residual_.resize(normals_.size());
    direction_.assign(normals_.size(), Eigen::Vector3f::Zero());
    product_.resize(normals_.size());
    parallel_for_rows(count, [&](std::int32_t i) {
        product_[i] = masses_[i] * averages_[i];
        residual_[i] = product_[i] - product(normals_, i);
    });
    const double limit =
        kTolerance * kTolerance * inner_product(product_, product_, diagonal_).sum();
    Numbers squared = inner_product(residual_, residual_, diagonal_), beta = Numbers::Zero();
    for (int i = 0; i < kMostIterations && squared.sum() > limit; ++i) {
        poll_progress();
        parallel_for_rows(count, [&](std::int32_t row) {
            if (diagonal_[row] <= 0) return;
            direction_[row] = residual_[row] / diagonal_[row] +
                              beta.matrix().cast<float>().cwiseProduct(direction_[row]);
        });
        parallel_for_rows(count,
                          [&](std::int32_t row) { product_[row] = product(direction_, row); });
        const Numbers alpha = ratio(squared, inner_product(direction_, product_, {}));
        const Eigen::Vector3f step = alpha.matrix().cast<float>();
        parallel_for_rows(count, [&](std::int32_t row) {
            normals_[row] += step.cwiseProduct(direction_[row]);
            residual_[row] -= step.cwiseProduct(product_[row]);
        });
        beta = ratio(inner_product(residual_, residual_, diagonal_), squared);
        squared *= beta;
    }
}

}  // namespace tracked_mcf
