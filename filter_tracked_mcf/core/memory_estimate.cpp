#include "filter_tracked_mcf/core/memory_estimate.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/cubature.h"
#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/kernels/local_systems.h"
#include "filter_tracked_mcf/core/marks.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

namespace {

// What is held, in bytes of each item: the sizes of the structures where there are any. Who changes
// what the flow holds changes these; MemoryEstimate.* of the unit tests compares them with what a
// process takes.

constexpr double kIndex = sizeof(std::int32_t);
constexpr double kOffset = sizeof(std::int64_t);
constexpr double kPosition = sizeof(Eigen::Vector3d);

/// Domain: the welded vertices, and which are held.
constexpr double kDomainPerVertex = kIndex + 1;
/// Domain: corners, edges, which of these are held, and which triangles are slivers.
constexpr double kDomainPerTriangle = 2.0 * sizeof(Triangle) + 2;

/// Finding edges: the sides of a triangle, and as much again to sort them.
constexpr double kSortedSidesPerTriangle = 2 * 3 * 16;

/// Clipping: fragments, and as much again to collect and to sort them.
constexpr double kClipPerFragment = 2.0 * sizeof(FragmentEntry);
/// Counting unknowns: a cell, its eight corners, and as much again to sort these.
constexpr double kCountPerCell = (2 + 2 * 8) * sizeof(MortonCode);

/// A Level: cell, unknowns, parent.
constexpr double kLevelPerElement = sizeof(MortonCode) + 8 * kIndex + kIndex;
/// TrackedElements: where fragments and samples begin.
constexpr double kTrackedPerElement = 2 * kOffset + 1;
/// TrackedElements: where vertices lie, and which are held.
constexpr double kTrackedPerVertex = sizeof(VertexPlace) + 1;

/// Sampling: the clipped surface, and who claims a vertex.
constexpr double kSamplingPerVertex = kPosition + kIndex;

/// MatrixBlocks.
constexpr double kPerMatrix = sizeof(MatrixBlock) / static_cast<double>(kBlockElements);

/// ElementSystems, and the stabilisation's tensors.
constexpr double kSystemPerElement =
    kPerMatrix + sizeof(ElementVector) + sizeof(float) + 6 * sizeof(float);
/// Flow: displacement, the one before, and the solution.
constexpr double kEmbeddingPerUnknown = 3.0 * 3 * sizeof(double);
/// Flow: what rescaling has the next step expect, and what that is made from.
constexpr double kGuessPerUnknown = 2.0 * 3 * sizeof(double);

constexpr double kFieldPerUnknown = 4 * sizeof(float);

/// ElementMultigrid at every level: inverse, share and entries apart, children.
constexpr double kSmootherPerElement = kPerMatrix + 2 * kIndex + kIndex + 1;
/// At every level: a residual and flags. And at all but the finest: right side and solution.
constexpr double kCyclePerUnknown = kFieldPerUnknown + 2;
constexpr double kCoarsePerUnknown = 2 * kFieldPerUnknown;
/// CoarseSolver: a pseudo-inverse, and what points to it.
constexpr double kCoarsestPerElement = 8 * 8 * sizeof(double) + 48;
/// At the finest: the vectors of conjugate gradients, and the workspace of the smoother.
constexpr double kIterationPerUnknown = 7 * kFieldPerUnknown + sizeof(Couplings);

/// Multigrid at every level: a number and its column.
constexpr double kPerEntry = sizeof(float) + kIndex;
/// A fine function is part of so many coarse ones: of 1, 2, 4 or 8, by where its corner is.
constexpr double kProlongationEntries = 27.0 / 8;
/// The prolongation there and back, diagonals, orders and flags.
constexpr double kMatrixPerUnknown = 2 * kProlongationEntries * kPerEntry + 6 * kIndex + kOffset;
/// At the finest: right side, solution and residual.
constexpr double kCycleSolverPerUnknown = 3 * kFieldPerUnknown;
/// Where an unknown occurs, and the children.
constexpr double kMatrixPerElement = 8 * kIndex + kIndex + kOffset;

/// What an allocator leaves unused, and what is too small to be listed above.
constexpr double kMargin = 1.05;

double sizes_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).sum();
}

/// Number of different edges that the surface's triangles have.
std::int64_t count_edges(const MeshTopology& topology) {
    Marks used(topology.edge_count);
    parallel_for_rows(static_cast<std::int64_t>(topology.edges.size()), [&](std::int32_t triangle) {
        for (const std::int32_t edge : topology.edges[triangle]) {
            if (edge != MeshTopology::kNoEdge) used.set(edge);
        }
    });
    return used.count();
}

/// Sets what depends on how triangles hang together.
void set_topology(const MeshTopology& topology, SurfaceSize& size) {
    const auto triangles = static_cast<std::int64_t>(topology.triangles.size());
    const auto has_area = [&](std::int64_t i) {
        const auto& edges = topology.edges[i];
        return std::count(edges.begin(), edges.end(), MeshTopology::kNoEdge) == 0;
    };
    const auto faces = static_cast<double>(parallel_count(triangles, has_area));
    size.edges = static_cast<double>(count_edges(topology));
    const auto vertices = static_cast<double>(count_vertices(topology));
    size.characteristic = std::max(0.0, vertices - size.edges + faces);
    // An edge inside has two sides, one on the boundary has one, and is as long as others are.
    const double rim_edges = std::max(0.0, 2 * size.edges - 3 * faces);
    const double mean_extents = 2 * size.extents / (3 * size.triangles);
    size.rim = rim_edges * mean_extents;
}

/// Of one level, a cell of which is `cell` long.
struct LevelCounts {
    double elements, unknowns;
    double entries;  ///< of the matrix
};

double fragments_at(const SurfaceSize& size, double cell) {
    return size.triangles + size.extents / cell + size.shadows / (cell * cell);
}

LevelCounts level_counts(const SurfaceSize& size, const Grid& grid, int depth,
                         bool separate_sheets) {
    const double cell = std::ldexp(grid.cell_size, grid.depth - depth);
    const double rim = size.rim / cell;
    const double shadows = size.shadows / (cell * cell);
    LevelCounts counts{size.characteristic + rim / 2 + shadows,
                       8 * size.characteristic + 2 * rim + 2 * shadows,
                       64 * size.characteristic + 24 * rim + 36 * shadows};
    counts.elements = std::clamp(counts.elements, 1.0, fragments_at(size, cell));
    if (!separate_sheets) {
        counts.elements = std::min(counts.elements, std::ldexp(1.0, 3 * depth));
        counts.unknowns = std::min(counts.unknowns, std::pow(std::ldexp(1.0, depth) + 1, 3));
    }
    counts.unknowns = std::clamp(counts.unknowns, 8.0, 8 * counts.elements);
    counts.entries = std::clamp(counts.entries, 64.0, 64 * counts.elements);
    return counts;
}

double edges_bytes(const SurfaceSize& size) {
    return kIndex * size.vertices + (sizeof(Triangle) + kSortedSidesPerTriangle) * size.triangles;
}

double sampling_bytes(const SurfaceSize& size, const ExpectedCounts& counts) {
    return estimate_domain_bytes(size) + (kSamplingPerVertex + kTrackedPerVertex) * size.vertices +
           (sizeof(FragmentEntry) + sizeof(Fragment)) * counts.fragments +
           Samples::kBytesPerSample * counts.samples + kLevelPerElement * counts.all_elements +
           kTrackedPerElement * counts.elements;
}

double solver_bytes(const ExpectedCounts& counts, Solver solver) {
    const double coarse_bytes = kPerMatrix * (counts.all_elements - counts.elements) +
                                kCoarsePerUnknown * (counts.all_unknowns - counts.unknowns) +
                                kCyclePerUnknown * counts.all_unknowns +
                                kCoarsestPerElement * counts.coarsest_elements;
    if (solver == Solver::OneWCycle) {
        return coarse_bytes + kMatrixPerElement * counts.all_elements +
               kMatrixPerUnknown * counts.all_unknowns + kPerEntry * counts.all_entries +
               kCycleSolverPerUnknown * counts.unknowns;
    }
    return coarse_bytes + kSmootherPerElement * counts.all_elements +
           kIterationPerUnknown * counts.unknowns;
}

double stepping_bytes(const SurfaceSize& size, const ExpectedCounts& counts,
                      const FlowParameters& parameters) {
    const double tracked = kTrackedPerVertex * size.vertices + sizeof(Fragment) * counts.fragments +
                           Samples::kBytesPerSample * counts.samples +
                           kLevelPerElement * counts.all_elements +
                           kTrackedPerElement * counts.elements;
    const double guess = parameters.rescale == Rescaling::None ? 0 : kGuessPerUnknown;
    const double result = kPosition * size.vertices + sizeof(Triangle) * size.triangles;
    return tracked + kSystemPerElement * counts.elements +
           (kEmbeddingPerUnknown + guess) * counts.unknowns +
           solver_bytes(counts, parameters.solver) + result;
}

}  // namespace

SurfaceSize size_of(const Domain& domain) {
    const TriangleMesh& surface = domain.surface();
    const auto triangles = static_cast<std::int64_t>(surface.triangles.size());
    // Extents and shadows.
    const Eigen::Vector2d sums =
        parallel_sum(triangles, Eigen::Vector2d(0, 0), [&](std::int64_t begin, std::int64_t end) {
            Eigen::Vector2d sum(0, 0);
            for (std::int64_t i = begin; i < end; ++i) {
                const Triangle& t = surface.triangles[i];
                sum[0] += sizes_of(surface.positions[t[0]], surface.positions[t[1]],
                                   surface.positions[t[2]]);
                sum[1] += 0.5 * twice_vector_area(surface, t).lpNorm<1>();
            }
            return sum;
        });
    SurfaceSize size;
    size.vertices = static_cast<double>(surface.positions.size());
    size.triangles = static_cast<double>(triangles);
    size.is_part = domain.is_part();
    size.extents = sums[0];
    size.shadows = sums[1];
    set_topology(domain.topology(), size);
    return size;
}

ExpectedCounts expected_counts(const SurfaceSize& size, const Grid& grid,
                               const FlowParameters& parameters) {
    const double extents = size.extents / grid.cell_size;
    const double shadows = size.shadows / (grid.cell_size * grid.cell_size);
    ExpectedCounts counts;
    // A triangle meets its one cell, one more for every plane of the grid that crosses it, and one
    // more for every line. Of its fragments' corners, each corner of its own is one, where a plane
    // crosses an edge there are two, and where a line crosses the triangle four; and a fragment has
    // two split triangles less than corners.
    counts.fragments = fragments_at(size, grid.cell_size);
    const double split_triangles = size.triangles + 2 * extents + 2 * shadows;
    counts.samples =
        split_triangles * static_cast<double>(cubature_rule(parameters.cubature).size());
    // The same goes for the surface as a whole and its rim. It meets supports as it meets cells, of
    // twice the size and as many for each cell; and pairs of functions that are both somewhere, the
    // entries of a matrix, by the boxes that their supports have in common.
    for (int depth = 0; depth <= grid.depth; ++depth) {
        const LevelCounts level = level_counts(size, grid, depth, parameters.separate_sheets);
        counts.elements = level.elements;
        counts.unknowns = level.unknowns;
        counts.all_elements += level.elements;
        counts.all_unknowns += level.unknowns;
        counts.all_entries += level.entries;
        if (depth == 0) counts.coarsest_elements = level.elements;
    }
    return counts;
}

double estimate_domain_bytes(const SurfaceSize& size) {
    const double part =
        size.is_part ? kPosition * size.vertices + sizeof(Triangle) * size.triangles : 0;
    return kDomainPerVertex * size.vertices + kDomainPerTriangle * size.triangles + part;
}

double estimate_clip_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters) {
    const ExpectedCounts counts = expected_counts(size, grid, parameters);
    const double clipping = kClipPerFragment * counts.fragments;
    const double counting =
        sizeof(FragmentEntry) * counts.fragments + kCountPerCell * counts.elements;
    return kMargin * (estimate_domain_bytes(size) + (kPosition + 1) * size.vertices +
                      std::max(clipping, counting));
}

double estimate_flow_bytes(const SurfaceSize& size, const Grid& grid,
                           const FlowParameters& parameters) {
    const ExpectedCounts counts = expected_counts(size, grid, parameters);
    return kMargin * std::max({edges_bytes(size), sampling_bytes(size, counts),
                               stepping_bytes(size, counts, parameters)});
}

}  // namespace tracked_mcf
