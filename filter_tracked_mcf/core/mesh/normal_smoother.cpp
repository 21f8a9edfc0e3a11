// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/normal_smoother.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// More sharpen edges little, and keep more noise.
constexpr int kFits = 2;

/// Conjugate gradients stop at this residual, relative to the right-hand side. Normals need not be
/// more accurate, since the metric averages them over triangles.
constexpr double kTolerance = 2e-2;
constexpr int kMostIterations = 500;

/// The least ratio of a triangle's area to its sides' squares, in any metric, so that all
/// cotangents are finite.
constexpr double kLeastAreaRatio = 1e-6;

/// The standard deviation of two differences from the mean of the neighbours, for noise of 1 and
/// vertices that have six neighbours each.
constexpr double kNoiseGain = 1.359;

/// One number for each coordinate.
using Numbers = Eigen::Array4d;

Numbers ratio(const Numbers& a, const Numbers& b) {
    return (b > 0).select(a / b, 0);
}

/// Returns the sum of body(row), a number for each coordinate, over the rows. Chunks are short
/// enough for single precision.
template <class Body>
Numbers sum_over_rows(std::size_t rows, const Body& body) {
    const auto count = static_cast<std::int64_t>(rows);
    return parallel_sum(count, Numbers(Numbers::Zero()), [&](std::int64_t begin, std::int64_t end) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (auto row = static_cast<std::int32_t>(begin); row < end; ++row) sum += body(row);
        return Numbers(sum.cast<double>().array());
    });
}

}  // namespace

NormalSmoother::NormalSmoother(const MeshTopology& topology, std::vector<double> densities)
    : triangles_(topology.triangles), densities_(std::move(densities)) {
    orient(topology);
    find_stars(topology.welded.size());
    find_rows();
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

void NormalSmoother::find_rows() {
    const auto count = static_cast<std::int64_t>(star_begin_.size()) - 1;
    using Row = std::vector<std::int32_t>;
    const auto for_each_row = [&](const auto& body) {
        parallel_for_chunks_with(
            count, [] { return Row(); },
            [&](Row& row, std::int64_t begin, std::int64_t end) {
                for (std::int64_t vertex = begin; vertex < end; ++vertex) {
                    row.clear();
                    for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
                        const Triangle& t = triangles_[stars_[i] / 3];
                        row.insert(row.end(), t.begin(), t.end());
                    }
                    std::sort(row.begin(), row.end());
                    row.erase(std::unique(row.begin(), row.end()), row.end());
                    body(vertex, row);
                }
            });
    };
    std::vector<std::size_t> sizes(static_cast<std::size_t>(count));
    for_each_row([&](std::int64_t vertex, const Row& row) { sizes[vertex] = row.size(); });
    parallel_prefix_sum(
        count, [&](std::int64_t vertex) { return sizes[vertex]; }, row_begin_);
    columns_.resize(row_begin_.back());
    slots_.resize(stars_.size());
    for_each_row([&](std::int64_t vertex, const Row& row) {
        std::copy(row.begin(), row.end(), columns_.begin() + row_begin_[vertex]);
        for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
            const Triangle& t = triangles_[stars_[i] / 3];
            for (int k = 0; k < 3; ++k) {
                const auto place = std::lower_bound(row.begin(), row.end(), t[k]);
                slots_[i][k] = static_cast<std::uint32_t>(place - row.begin());
            }
        }
    });
}

const NormalSmoother::Normals& NormalSmoother::smooth(const std::vector<Eigen::Vector3d>& positions,
                                                      double step_size, double normal_length) {
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
        for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
            const std::uint32_t triangle = stars_[i] / 3;
            const auto [a, b, c] = corners_of(positions, triangles_[triangle]);
            const Eigen::Vector3d area = twice_vector_area(a, b, c);
            sum += flipped_[triangle] != 0 ? Eigen::Vector3d(-area) : area;
        }
        averages_[vertex] << sum.normalized().cast<float>(), 0;
    });
}

double NormalSmoother::vertex_density(std::int32_t vertex) const {
    double sum = 0;
    for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
        sum += density(stars_[i] / 3);
    }
    return sum / static_cast<double>(star_begin_[vertex + 1] - star_begin_[vertex]);
}

double NormalSmoother::noise(const std::vector<Eigen::Vector3d>& positions) {
    average_normals(positions);
    const auto count = static_cast<std::int64_t>(positions.size());
    const auto has_neighbours = [&](std::int32_t vertex) {
        return row_begin_[vertex + 1] - row_begin_[vertex] > 1;
    };
    // A row has the vertex itself, too, whose difference is 0.
    const auto from_mean = [&](const auto& x, std::int32_t vertex) {
        const auto& own = x[vertex];
        using Vector = std::decay_t<decltype(own)>;
        Vector sum = Vector::Zero();
        for (std::size_t i = row_begin_[vertex]; i < row_begin_[vertex + 1]; ++i) {
            sum += own - x[columns_[i]];
        }
        const std::size_t neighbours = row_begin_[vertex + 1] - row_begin_[vertex] - 1;
        return Vector(sum / static_cast<typename Vector::Scalar>(neighbours));
    };
    residual_.assign(positions.size(), Eigen::Vector4f::Zero());
    parallel_for_rows(count, [&](std::int32_t vertex) {
        if (!has_neighbours(vertex)) return;
        residual_[vertex].head<3>() = from_mean(positions, vertex).cast<float>();
    });
    RawVector<float> heights(positions.size());
    parallel_for_rows(count, [&](std::int32_t vertex) {
        heights[vertex] = kNoMagnitude;
        if (!has_neighbours(vertex)) return;
        heights[vertex] = std::abs(from_mean(residual_, vertex).dot(averages_[vertex])) *
                          static_cast<float>(std::sqrt(vertex_density(vertex)));
    });
    return robust_deviation(heights) / kNoiseGain;
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
    values_.resize(columns_.size());
    masses_.resize(positions.size());
    inverse_.resize(positions.size());
    parallel_for_rows(static_cast<std::int64_t>(positions.size()), [&](std::int32_t vertex) {
        float* const row = values_.data() + row_begin_[vertex];
        std::fill(row, values_.data() + row_begin_[vertex + 1], 0.0F);
        float mass = 0, diagonal = 0;
        for (std::int64_t i = star_begin_[vertex]; i < star_begin_[vertex + 1]; ++i) {
            const auto& weights = weights_[stars_[i] / 3];
            const std::uint32_t own = stars_[i] % 3, next = (own + 1) % 3, last = (own + 2) % 3;
            const float entry = weights[next] + weights[last] + weights[3];
            row[slots_[i][own]] += entry;
            row[slots_[i][next]] -= weights[last];
            row[slots_[i][last]] -= weights[next];
            diagonal += entry;
            mass += weights[3];
        }
        masses_[vertex] = mass;
        inverse_[vertex] = diagonal > 0 ? 1 / diagonal : 0;
    });
}

Eigen::Vector4f NormalSmoother::product(const Normals& x, std::int32_t vertex) const {
    Eigen::Vector4f sum = Eigen::Vector4f::Zero();
    for (std::size_t i = row_begin_[vertex]; i < row_begin_[vertex + 1]; ++i) {
        sum += values_[i] * x[columns_[i]];
    }
    return sum;
}

/// Conjugate gradients, preconditioned by the diagonal, for the coordinates side by side.
void NormalSmoother::solve() {
    const std::size_t count = normals_.size();
    const auto squares = [&](std::int32_t row) -> Eigen::Vector4f {
        return inverse_[row] * residual_[row].cwiseAbs2();
    };
    residual_.resize(count);
    product_.resize(count);
    direction_.assign(count, Eigen::Vector4f::Zero());
    const Numbers right_hand_side = sum_over_rows(count, [&](std::int32_t row) {
        residual_[row] = masses_[row] * averages_[row];
        return squares(row);
    });
    const double limit = kTolerance * kTolerance * right_hand_side.sum();
    Numbers squared = sum_over_rows(count, [&](std::int32_t row) {
        residual_[row] -= product(normals_, row);
        return squares(row);
    });
    Numbers beta = Numbers::Zero();
    for (int i = 0; i < kMostIterations && squared.sum() > limit; ++i) {
        const Eigen::Vector4f keep = beta.matrix().cast<float>();
        parallel_for_rows(static_cast<std::int64_t>(count), [&](std::int32_t row) {
            direction_[row] = inverse_[row] * residual_[row] + keep.cwiseProduct(direction_[row]);
        });
        const Numbers energy = sum_over_rows(count, [&](std::int32_t row) {
            product_[row] = product(direction_, row);
            return direction_[row].cwiseProduct(product_[row]);
        });
        const Eigen::Vector4f step = ratio(squared, energy).matrix().cast<float>();
        const Numbers before = squared;
        squared = sum_over_rows(count, [&](std::int32_t row) {
            normals_[row] += step.cwiseProduct(direction_[row]);
            residual_[row] -= step.cwiseProduct(product_[row]);
            return squares(row);
        });
        beta = ratio(squared, before);
    }
}

}  // namespace tracked_mcf
