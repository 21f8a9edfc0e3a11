// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/paper_memory.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/flow/cells/cubature.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// Bytes of the flow (threads, program code) and of each of its items.
/// tests/unit/flow/plan/calibrate.cpp measures the peaks of many flows beside the estimate. Run it
/// again after a change of the data that the flow keeps.
constexpr double kBytesOfFlow = 1.8e6, kBytesPerPosition = 75, kBytesPerSurfaceVertex = 140,
                 kBytesPerFragment = 36, kBytesPerSample = 10.5, kBytesPerUnknown = 150,
                 kBytesPerElement = 770;
/// The same for orders above 1: the stiffness of an element, and an unknown of each solution.
constexpr double kBytesPerStiffness = 108, kBytesPerSolution = 30;

/// Sums over a surface that give the expected numbers of its fragments and elements on any grid,
/// in mesh units.
struct Sizes {
    double extents = 0;  ///< total length of the sides of the triangles' bounding boxes
    double shadows = 0;  ///< total area of the triangles' projections along the three axes
    double rim = 0;      ///< total length of the sides of the boundary edges' bounding boxes
    double spheres = 0;  ///< Euler characteristic, if it is positive
};

Sizes sizes_of(const Stars& stars, const Positions& positions) {
    Sizes sizes;
    for (std::size_t i = 0; i < stars.triangles.size(); ++i) {
        const auto corners = corners_of(positions, stars.triangles[i]);
        const auto& [a, b, c] = corners;
        sizes.extents += (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).sum();
        sizes.shadows += 0.5 * twice_vector_area(a, b, c).lpNorm<1>();
        for (std::size_t side = 0; side < 3 && stars.has_rim(); ++side) {
            if (stars.rim_sides[3 * i + side] != 0)
                sizes.rim += (corners[(side + 1) % 3] - corners[side]).lpNorm<1>();
        }
    }
    sizes.spheres = std::max(0.0, static_cast<double>(stars.count() - stars.edge_count()) +
                                      static_cast<double>(stars.triangles.size()));
    return sizes;
}

}  // namespace

double paper_flow_bytes(const Surface& surface, const Positions& positions, const Grid& grid,
                        Cubature cubature, int order) {
    const Sizes sizes = sizes_of(surface.stars, positions);
    const auto triangles = static_cast<double>(surface.stars.triangles.size());
    double elements = 0, unknowns = 0;  // of all levels
    double fragments = 0, split_triangles = 0;
    for (int depth = 0; depth <= grid.depth; ++depth) {
        const double cell = std::ldexp(grid.cell_size, grid.depth - depth);
        const double extents = sizes.extents / cell;
        const double shadows = sizes.shadows / (cell * cell);
        const double rim = sizes.rim / cell;
        // A triangle meets one cell, and another for each grid plane and each grid line that
        // crosses it. The polygons have a corner for each corner of the triangle, two for each
        // crossing of a side and a plane, and four for each crossing of the triangle and a line. A
        // polygon has two split triangles less than corners.
        fragments = triangles + extents + shadows;
        split_triangles = fragments + extents + shadows;
        // The surface meets a cell for each grid line that crosses it, half a one for each grid
        // plane that crosses its rim, and one more for each sphere. The supports of the unknowns
        // are the cells of eight shifted grids with sides twice as long.
        elements +=
            std::min({sizes.spheres + rim / 2 + shadows, fragments, std::ldexp(1.0, 3 * depth)});
        unknowns += std::min({8 * sizes.spheres + 2 * rim + 2 * shadows, 8 * fragments,
                              std::pow(std::ldexp(1.0, depth) + 1, 3)});
    }
    const auto vertices = static_cast<double>(surface.vertices.size());
    const double samples = split_triangles * static_cast<double>(cubature_rule(cubature).size());
    double bytes = kBytesOfFlow + kBytesPerPosition * vertices +
                   kBytesPerSurfaceVertex * static_cast<double>(surface.stars.count()) +
                   kBytesPerFragment * fragments + kBytesPerSample * samples +
                   kBytesPerUnknown * unknowns + kBytesPerElement * elements;
    if (order > 1) bytes += kBytesPerStiffness * elements;
    return bytes + (order - 1) * kBytesPerSolution * unknowns;
}

}  // namespace tracked_mcf
