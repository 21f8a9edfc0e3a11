// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/fragments.h"
#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// Number of steps into which a cell's side is divided for the local coordinates of samples, at
/// most 2^21. The rounding error is at most 2.5e-7 of a side, close to that of single precision, in
/// two thirds of the memory. Thirds, fifths and 2^-17 of a side are exact, so a sample aligned with
/// the grid stays aligned.
inline constexpr int kSampleSteps = 15 << 17;

/// The samples of a surface.
class Samples {
public:
    /// Every sample must be set before it is read.
    void resize(std::int64_t count) {
        steps_.resize(static_cast<std::size_t>(count));
        weight_.resize(static_cast<std::size_t>(count));
    }
    void set(std::int64_t sample, const Eigen::Vector3d& local, double weight) {
        steps_[sample] = rounded(kSampleSteps * local[0]) |
                         rounded(kSampleSteps * local[1]) << kBits |
                         rounded(kSampleSteps * local[2]) << 2 * kBits;
        weight_[sample] = static_cast<float>(weight);
    }

    std::int64_t size() const { return static_cast<std::int64_t>(weight_.size()); }
    /// Returns a local coordinate of a sample in its cell, in steps.
    std::int32_t steps(std::int64_t sample, unsigned axis) const {
        return static_cast<std::int32_t>(steps_[sample] >> axis * kBits & ((1U << kBits) - 1));
    }
    /// Returns the local coordinates of a sample in its cell, 0 to 1.
    Eigen::Vector3d local(std::int64_t sample) const {
        return Eigen::Vector3d(steps(sample, 0), steps(sample, 1), steps(sample, 2)) / kSampleSteps;
    }
    /// Returns w_p, the area of the initial surface that a sample stands for, in grid units².
    float weight(std::int64_t sample) const { return weight_[sample]; }

private:
    static constexpr unsigned kBits = 21;  ///< of a coordinate

    /// Returns what std::lround would, which is a slow call. The number is negative by rounding
    /// errors at most.
    static std::uint64_t rounded(double number) {
        const auto below = static_cast<std::int32_t>(number);
        return static_cast<std::uint64_t>(below) + (number - below >= 0.5 ? 1 : 0);
    }

    RawVector<std::uint64_t> steps_;  ///< of the three coordinates, x lowest
    RawVector<float> weight_;
};

/// The integrals' data of a fragment, the part of a triangle in a cell.
struct Fragment {
    float normal[3];            ///< unit normal of the initial triangle; 0 if degenerate
    std::int32_t sample_count;  ///< number of its samples, which are consecutive
};

/// The location of a vertex: a finest element and local coordinates in its cell.
struct VertexLocation {
    static constexpr std::int32_t kNoElement = -1;  ///< of vertices that no triangle uses
    std::int32_t element = kNoElement;
    Eigen::Vector3d local = Eigen::Vector3d::Zero();
};

/// Coefficients of a map from the surface to space, one row per unknown of the finest level.
using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Everything that is computed once from the initial surface and then tracked (section 4.1): the
/// octree, the test functions pulled back to the mesh, and the samples. It does not change during
/// the flow. All lengths are in grid units.
struct TrackedElements {
    Grid grid;
    std::vector<Level> levels;  ///< coarsest first

    RawVector<Fragment> fragments;             ///< sorted by finest element
    Samples samples;                           ///< sorted by fragment
    std::vector<std::int64_t> fragment_begin;  ///< per finest element, and the end
    std::vector<std::int64_t> sample_begin;    ///< per finest element, and the end

    RawVector<VertexLocation> vertices;         ///< of the mesh, equal for coincident vertices
    std::vector<std::uint8_t> vertex_held;      ///< per vertex: whether it keeps its bits
    std::vector<std::uint8_t> meets_held_side;  ///< per finest element

    std::int64_t split_triangle_count = 0;
    std::int64_t fragment_count = 0;  ///< without fragments of degenerate triangles

    const Level& finest() const { return levels.back(); }
};

/// Builds the octree over a clipped surface, and computes its samples and the locations of the
/// mesh's vertices. Throws InvalidMesh if all triangles are degenerate.
TrackedElements build_tracked_elements(const Surface& surface, ClippedSurface clipped,
                                       Cubature cubature);

/// Returns the map with these coefficients at a vertex that has an element: the paper's
/// EvaluateVertex (section 4.3).
Eigen::Vector3d evaluate_vertex(const TrackedElements& elements, const Coefficients& coefficients,
                                const VertexLocation& vertex);

/// Adds the map with these coefficients, in mesh units, to `vectors`, one for each vertex of the
/// mesh. Leaves those of vertices that do not move, or that the map takes to zero, as they are.
void add_at_vertices(const TrackedElements& elements, const Coefficients& coefficients,
                     std::vector<Eigen::Vector3d>& vectors);

}  // namespace tracked_mcf
