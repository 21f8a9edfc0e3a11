// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/edge_metric.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "filter_tracked_mcf/core/elements/densities.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// How fast the step factor grows with the noise, relative to the detail size. Chosen for small
/// errors in tests/experiments/denoising.py, as are the next numbers.
constexpr double kStepsPerNoise = 100;

/// Noise counts as at most this fraction of the detail size. With more, no detail of that size is
/// left to keep.
constexpr double kMostNoise = 0.25;

/// The first step moves most vertices of a smooth surface by at most about this many times the
/// noise.
constexpr double kNoiseMovement = 0.9;

/// The power of the excess movement by which steps are shortened.
constexpr int kShortening = 5;

/// A step is not made again for one that is longer than this many times it.
constexpr double kLittleShorter = 0.9;

/// Lengths count at most about this many times. An edge needs no more, and where noise is larger
/// than the triangles the solver would need many iterations.
constexpr double kLongest = 12;

}  // namespace

double EdgeSize::normal_length() const {
    return detail_size / (2 * std::sin(angle * std::acos(-1.0) / 360));
}

EdgeMetric::EdgeMetric(const Domain& domain, const TrackedElements& elements, const EdgeSize& size,
                       bool local_detail_size)
    : positions_(domain.mesh().positions),
      grid_(elements.grid),
      size_(size),
      smoother_(domain.topology(), triangle_densities(domain, local_detail_size)),
      noise_(smoother_.noise(positions_) / grid_.cell_size),
      step_factor_(1 + kStepsPerNoise * std::min(noise_ / size_.detail_size, kMostNoise)) {}

bool EdgeMetric::shorten_steps(double movement) {
    if (movement <= kNoiseMovement * noise_) return false;
    const double excess = movement / (kNoiseMovement * noise_);
    const double factor = std::max(1.0, step_factor_ / std::pow(excess, kShortening));
    if (factor > kLittleShorter * step_factor_) return false;
    step_factor_ = factor;
    return true;
}

/// Smoothing by δ_N leaves noise of about σ / √δ_N in N, in waves about as long as √δ_N. So with
/// δ_N = s σ it turns N by about the angle θ within ℓ, which is what an edge does. Normals are not
/// smoothed farther than ℓ: for a small angle, noise counts as edges.
void EdgeMetric::update(const TrackedElements& elements, const Coefficients& displacement) {
    std::vector<Eigen::Vector3d> present = positions_;
    add_at_vertices(elements, displacement, present);
    for (Eigen::Vector3d& position : present) position = grid_.to_grid(position);
    const double s = size_.normal_length();
    const NormalSmoother::Normals& normals =
        smoother_.smooth(present, std::min(s * noise_, size_.detail_size * size_.detail_size), s);
    tensors_.resize(smoother_.triangles().size());
    parallel_for_rows(static_cast<std::int64_t>(tensors_.size()), [&](std::int32_t triangle) {
        tensors_[triangle] = tensor_of(triangle, normals);
    });
}

/// With the sides e_1 and e_2 that begin opposite to corners 1 and 2, and the differences d_1 and
/// d_2 of the normals there to that at corner 0, n × ∇N_a is -(d_1a e_1 + d_2a e_2) / 2A.
EdgeTensor EdgeMetric::tensor_of(std::int64_t triangle,
                                 const NormalSmoother::Normals& normals) const {
    EdgeTensor tensor = {};
    const Triangle& t = smoother_.triangles()[triangle];
    std::array<Eigen::Vector3d, 3> corners = corners_of(positions_, t);
    for (Eigen::Vector3d& corner : corners) corner = grid_.to_grid(corner);
    const double twice_area = twice_vector_area(corners[0], corners[1], corners[2]).norm();
    const Eigen::Vector3d e1 = corners[0] - corners[2], e2 = corners[1] - corners[0];
    const Eigen::Vector3d d1 = (normals[t[1]] - normals[t[0]]).head<3>().cast<double>();
    const Eigen::Vector3d d2 = (normals[t[2]] - normals[t[0]]).head<3>().cast<double>();
    const Eigen::Matrix3d mixed = d1.dot(d2) * e1 * e2.transpose();
    const Eigen::Matrix3d adjugate = d1.squaredNorm() * e1 * e1.transpose() + mixed +
                                     mixed.transpose() + d2.squaredNorm() * e2 * e2.transpose();
    if (!(adjugate.trace() > 0)) return tensor;
    const double s = size_.normal_length() / std::sqrt(smoother_.density(triangle));
    const double scale = std::min(s / twice_area, kLongest / std::sqrt(adjugate.trace()));
    constexpr int rows[] = {0, 1, 2, 0, 1, 2}, columns[] = {0, 1, 2, 1, 2, 0};
    for (int e = 0; e < 6; ++e) {
        tensor.adjugate[e] = static_cast<float>(scale * scale * adjugate(rows[e], columns[e]));
    }
    const double determinant = scale * scale * d1.cross(d2).norm() * twice_area;
    tensor.determinant = static_cast<float>(determinant * determinant);
    return tensor;
}

double EdgeMetric::edge_share() const {
    using Areas = Eigen::Vector2d;  // of edges, of all
    const auto count = static_cast<std::int64_t>(tensors_.size());
    const Areas sum = parallel_sum(count, Areas(0, 0), [&](std::int64_t begin, std::int64_t end) {
        Areas areas(0, 0);
        for (std::int64_t i = begin; i < end; ++i) {
            const auto [a, b, c] = corners_of(positions_, smoother_.triangles()[i]);
            const double area = twice_vector_area(a, b, c).norm();
            const float* const adjugate = tensors_[i].adjugate;
            areas += Areas(adjugate[0] + adjugate[1] + adjugate[2] > 1 ? area : 0, area);
        }
        return areas;
    });
    return sum[1] > 0 ? sum[0] / sum[1] : 0;
}

}  // namespace tracked_mcf
