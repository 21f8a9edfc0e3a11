// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/memory_estimate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "filter_tracked_mcf/core/cells/cubature.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Bytes of a flow and of each of its items.
struct BytesPer {
    double flow;  ///< threads, program code
    double vertex, fragment, sample;
    double unknown, element;  ///< of all levels
};

// tests/unit/plan/calibrate.cpp measures the peaks of many flows and fits these numbers to them.
// Run it again after a change of the data that a flow keeps. The bytes of a converged flow itself
// are those of the smallest flows, one triangle and coarse spheres.
constexpr BytesPer kClipping = {0.9e6, 40, 56, 0, 0, 0};
constexpr BytesPer kConverged = {1.3e6, 75, 40, 11, 12, 865};
constexpr BytesPer kOneWCycle = {1.8e6, 75, 36, 10.5, 150, 770};
/// Added if the area is preserved: positions and triangles, and the prediction.
constexpr BytesPer kArea = {0, 90, 0, 0, 0, 140};
/// Added if the volume is preserved: positions, velocities and triangles, and the response.
constexpr BytesPer kVolume = {0, 130, 0, 0, 30, 0};
/// Added for the mean curvature: the velocities of three states.
constexpr BytesPer kVelocity = {0, 0, 0, 0, 75, 0};
/// Added for orders above 1: the stiffness.
constexpr BytesPer kStiffness = {0, 0, 0, 0, 0, 108};
/// Added for each order above 1: a solution and its guess.
constexpr BytesPer kSolution = {0, 0, 0, 0, 30, 0};

double bytes_of(const BytesPer& bytes, const SurfaceSize& size, const ExpectedCounts& counts) {
    return bytes.flow + bytes.vertex * size.vertices + bytes.fragment * counts.fragments +
           bytes.sample * counts.samples + bytes.unknown * counts.all_unknowns +
           bytes.element * counts.all_elements;
}

double box_sides(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).sum();
}

/// The number of the surface's edges, and the total length of the sides of their bounding boxes.
using Edges = Eigen::Vector2d;

Edges edges_of(const Domain& domain) {
    const MeshTopology& topology = domain.topology();
    const std::vector<Eigen::Vector3d>& positions = domain.surface().positions;
    // All triangles of an edge store the same number.
    std::vector<std::atomic<double>> extents(static_cast<std::size_t>(topology.edge_count));
    parallel_for_rows(static_cast<std::int64_t>(topology.edges.size()), [&](std::int32_t triangle) {
        const Triangle& t = topology.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge == MeshTopology::kNoEdge) continue;
            const Eigen::Vector3d sides = positions[t[(side + 1) % 3]] - positions[t[side]];
            extents[edge].store(sides.lpNorm<1>(), std::memory_order_relaxed);
        }
    });
    return parallel_sum(topology.edge_count, Edges(0, 0),
                        [&](std::int64_t begin, std::int64_t end) {
                            Edges sum(0, 0);
                            for (std::int64_t i = begin; i < end; ++i) {
                                const double extent = extents[i].load(std::memory_order_relaxed);
                                if (extent > 0) sum += Edges(1, extent);
                            }
                            return sum;
                        });
}

/// Sets the rim, the copies and the characteristic.
///
/// A grid plane cuts the surface into curves. Inside a curve, it crosses as many edges as
/// triangles; where a curve ends, at the rim, it crosses half an edge more. If it crosses more
/// triangles than edges, the edges have more than two triangles: copies of each other.
void set_topology(const Domain& domain, SurfaceSize& size) {
    const MeshTopology& topology = domain.topology();
    const auto triangles = static_cast<std::int64_t>(topology.triangles.size());
    const auto has_area = [&](std::int64_t i) {
        const auto& edges = topology.edges[i];
        return std::count(edges.begin(), edges.end(), MeshTopology::kNoEdge) == 0;
    };
    const auto faces = static_cast<double>(parallel_count(triangles, has_area));
    const auto vertices = static_cast<double>(count_vertices(topology));
    const Edges edges = edges_of(domain);
    if (size.extents > edges[1] && edges[1] > 0) size.copies = size.extents / edges[1];
    size.rim = 2 * std::max(0.0, edges[1] - size.extents);
    // Without copies, an edge has two triangles at most.
    size.characteristic = vertices - edges[0] + std::min(faces, 2 * edges[0] / 3);
}

/// Returns the share of the split triangles, beside one of each fragment, that fragments of more
/// than half a cell have: none where triangles are smaller than a cell, most where they are large
/// in both directions, and 0.6 where they are long and thin. A test compares the
/// formula with the samples of a sphere at many depths.
double share_of_large(double triangles, double extents, double shadows) {
    const double crossings = extents + shadows;
    if (crossings <= triangles) return 0;
    const double wide = shadows / (shadows + extents / 7);
    return (1 - triangles / crossings) * (0.6 + 0.4 * wide);
}

struct LevelCounts {
    double elements, unknowns;
};

/// Returns the expected number of fragments that meet no side of their triangle. The sides cross
/// grid planes twice as often as the triangle does, and each crossing leads to another cell. Small
/// triangles have no such fragments.
double inner_fragments(const SurfaceSize& size, double cell) {
    const double extents = size.extents / cell;
    if (extents < 2 * size.triangles) return 0;
    return std::max(0.0, size.triangles - extents + size.shadows / (cell * cell));
}

/// Returns the expected counts of a level with cells of side `cell`.
///
/// The expected number of parts of a surface in the cells is its characteristic, plus half the
/// number of its rim's crossings with grid planes, plus the number of its crossings with grid
/// lines. The supports of the unknowns are the cells of eight shifted grids with sides twice as
/// long. Copies of triangles are connected where a cell meets their sides; elsewhere each copy is a
/// part. Handles and holes smaller than a cell leave a part whole.
LevelCounts level_counts(const SurfaceSize& size, double cell, int depth, double fragments,
                         bool separate_sheets) {
    const double rim = size.rim / cell;
    const double shadows = size.shadows / size.copies / (cell * cell);
    LevelCounts counts{std::max(0.0, size.characteristic + rim / 2) + shadows,
                       std::max(0.0, 8 * size.characteristic + 2 * rim) + 2 * shadows};
    const double others = 1 - 1 / size.copies;  // all copies but one
    counts.elements += others * inner_fragments(size, cell);
    counts.unknowns += others * 8 * inner_fragments(size, 2 * cell);
    counts.elements = std::clamp(counts.elements, 1.0, fragments);
    if (!separate_sheets) {
        counts.elements = std::min(counts.elements, std::ldexp(1.0, 3 * depth));
        counts.unknowns = std::min(counts.unknowns, std::pow(std::ldexp(1.0, depth) + 1, 3));
    }
    counts.unknowns = std::clamp(counts.unknowns, 8.0, 8 * counts.elements);
    return counts;
}

}  // namespace

SurfaceSize size_of(const Domain& domain) {
    const SurfaceView surface = domain.surface();
    const auto triangles = static_cast<std::int64_t>(surface.triangles.size());
    const Eigen::Vector2d extents_and_shadows =
        parallel_sum(triangles, Eigen::Vector2d(0, 0), [&](std::int64_t begin, std::int64_t end) {
            Eigen::Vector2d sum(0, 0);
            for (std::int64_t i = begin; i < end; ++i) {
                const Triangle& t = surface.triangles[i];
                sum[0] += box_sides(surface.positions[t[0]], surface.positions[t[1]],
                                    surface.positions[t[2]]);
                sum[1] += 0.5 * twice_vector_area(surface, t).lpNorm<1>();
            }
            return sum;
        });
    SurfaceSize size;
    size.vertices = static_cast<double>(surface.positions.size());
    size.triangles = static_cast<double>(triangles);
    size.extents = extents_and_shadows[0];
    size.shadows = extents_and_shadows[1];
    set_topology(domain, size);
    return size;
}

ExpectedCounts expected_counts(const SurfaceSize& size, const Grid& grid,
                               const Discretisation& discretisation) {
    ExpectedCounts counts;
    for (int depth = 0; depth <= grid.depth; ++depth) {
        const double cell = std::ldexp(grid.cell_size, grid.depth - depth);
        const double extents = size.extents / cell;
        const double shadows = size.shadows / (cell * cell);
        // A triangle meets one cell, and another for each grid plane and each grid line that
        // crosses it. The polygons have a corner for each corner of the triangle, two for each
        // crossing of an edge and a plane, and four for each crossing of the triangle and a line. A
        // polygon has two split triangles less than corners.
        counts.fragments = size.triangles + extents + shadows;
        const double large =
            discretisation.whole_fragments ? share_of_large(size.triangles, extents, shadows) : 1;
        counts.samples = (counts.fragments + large * (extents + shadows)) *
                         static_cast<double>(cubature_rule(discretisation.cubature).size());
        const LevelCounts level =
            level_counts(size, cell, depth, counts.fragments, discretisation.separate_sheets);
        counts.elements = level.elements;
        counts.unknowns = level.unknowns;
        counts.all_elements += level.elements;
        counts.all_unknowns += level.unknowns;
    }
    return counts;
}

double estimate_clip_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters) {
    return bytes_of(kClipping, size, expected_counts(size, grid, discretisation_of(parameters)));
}

double estimate_flow_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters) {
    const ExpectedCounts counts = expected_counts(size, grid, discretisation_of(parameters));
    const BytesPer& solver = parameters.solver != Solver::OneWCycle ? kConverged : kOneWCycle;
    double bytes = bytes_of(solver, size, counts);
    if (parameters.preserve == Preserve::Area) bytes += bytes_of(kArea, size, counts);
    if (parameters.preserve == Preserve::Volume) bytes += bytes_of(kVolume, size, counts);
    if (parameters.quality == Quality::MeanCurvature) bytes += bytes_of(kVelocity, size, counts);
    if (parameters.order > 1) bytes += bytes_of(kStiffness, size, counts);
    return bytes + (parameters.order - 1) * bytes_of(kSolution, size, counts);
}

}  // namespace tracked_mcf
