// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "tests/experiments/csv.h"
#include "tests/experiments/experiments.h"
#include "tests/experiments/meshes.h"
#include "tests/experiments/options.h"
#include "tests/experiments/reference.h"
#include "tests/experiments/slip.h"
#include "tests/support/plans.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf::experiments {

namespace {

/// Vertices farther than five edges from the boundary are one ring.
constexpr int kLastRing = 6;

/// Returns each vertex's distance from the boundary in edges, at most kLastRing.
std::vector<int> rings_of(const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    const std::vector<std::uint8_t>& boundary = topology.boundary;
    std::vector<int> rings(mesh.positions.size(), kLastRing);
    for (std::size_t t = 0; t < boundary.size(); ++t) {
        for (int i = 0; i < 3; ++i) {
            if ((boundary[t] >> i & 1) == 0) continue;
            rings[topology.triangles[t][i]] = 0;
            rings[topology.triangles[t][(i + 1) % 3]] = 0;
        }
    }
    for (int ring = 1; ring < kLastRing; ++ring) {
        for (const Triangle& t : topology.triangles) {
            const int nearest = std::min({rings[t[0]], rings[t[1]], rings[t[2]]});
            if (nearest != ring - 1) continue;
            for (const std::int32_t vertex : t) rings[vertex] = std::min(rings[vertex], ring);
        }
    }
    for (std::size_t i = 0; i < rings.size(); ++i) rings[i] = rings[topology.welded[i]];
    return rings;
}

/// Returns the root mean square over the vertices that `left_out` does not mark, not weighted by
/// area.
double rms_distance(const TriangleMesh& a, const TriangleMesh& b,
                    const std::vector<std::uint8_t>& left_out) {
    double squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < left_out.size(); ++i) {
        if (left_out[i] != 0) continue;
        squares += (a.positions[i] - b.positions[i]).squaredNorm();
        ++count;
    }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

struct Case {
    int depth;
    std::string configuration;
    int steps;
};

void print_rings(const TriangleMesh& mesh, const std::vector<int>& rings,
                 const Reference& reference, const TriangleMesh& moved, const Slip& slip,
                 const Case& run) {
    const double unit = diagonal(mesh);
    const std::vector<std::uint8_t> referenced = referenced_vertices(mesh);
    for (int ring = 0; ring <= kLastRing; ++ring) {
        std::vector<std::uint8_t> left_out = reference.left_out;
        for (std::size_t i = 0; i < rings.size(); ++i) {
            if (rings[i] != ring || !referenced[i]) left_out[i] = 1;
        }
        const NormalDistance distance = normal_distance(moved, reference.mesh, left_out);
        print_row(run.depth, run.configuration, run.steps, ring,
                  std::count(left_out.begin(), left_out.end(), 0), distance.rms / unit,
                  distance.worst / unit, rms_distance(moved, reference.mesh, left_out) / unit,
                  normal_distance(mesh, reference.mesh, left_out).rms / unit,
                  rms_distance(mesh, reference.mesh, left_out) / unit, slip.rms / unit,
                  slip.worst / unit);
    }
}

void measure(const TriangleMesh& mesh, const std::map<int, Reference>& references,
             const Options& options, int depth, const std::string& configuration) {
    const FlowParameters parameters = options.parameters(depth, configuration);
    const std::vector<int> rings = rings_of(mesh);
    Flow flow(plan_of(mesh, parameters));
    for (int step = 1; step <= references.rbegin()->first && flow.step(); ++step) {
        const auto reference = references.find(step);
        if (reference == references.end()) continue;
        TriangleMesh moved = mesh;
        flow.move_vertices(moved.positions);
        print_rings(mesh, rings, reference->second, moved, slip_at_constrained_edges(flow),
                    {flow.report().depth, configuration, step});
    }
}

void run(const Options& options) {
    print_row("depth", "configuration", "steps", "ring", "vertices", "normal_rms", "normal_worst",
              "whole_rms", "moved_normal", "moved_whole", "slip_rms", "slip_worst");
    const TriangleMesh mesh = named_mesh(options.mesh);
    const std::map<int, Reference> references =
        cotangent_flow(mesh, options.step_size(), options.steps, BoundaryCondition::Locked);
    options.for_each_case([&](int depth, const std::string& configuration) {
        measure(mesh, references, options, depth, configuration);
    });
}

}  // namespace

void add_boundary(CLI::App& app) {
    add_experiment(
        app, "boundary",
        "Prints the distance to the cotangent flow with fixed boundary vertices, in diagonals of "
        "the "
        "initial bounding box, for rings of vertices: ring 0 is the boundary, ring 6 all vertices "
        "from there on. Prints the distance along the normal, weighted by area, and the whole "
        "distance; 'moved' is the distance of the initial mesh. Omits vertices where the cotangent "
        "flow's triangles have degenerated. 'slip' is the surface's distance from the constrained "
        "edges.",
        run, Options());
}

}  // namespace tracked_mcf::experiments
