// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/same_bits.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {

/// The parameters of a flow of order 1. The step size is for the mesh scaled to longest side 1, if
/// it is as large as the unit sphere, which most shapes of the tests are.
inline FlowParameters parameters(int depth, double relative_step_size, int iterations) {
    FlowParameters p;
    p.order = 1;  // the flow itself
    p.depth = depth;
    p.step_size = 4 * relative_step_size;
    p.iterations = iterations;
    return p;
}

/// Scales the step size with a mesh that is not as large as the unit sphere.
inline FlowParameters scaled_to(const TriangleMesh& mesh, FlowParameters p) {
    p.step_size *= std::pow(longest_side(mesh) / 2, 2);
    return p;
}

inline FlowParameters preserving(Preserve preserve, double step_size = 1e-3, int iterations = 5) {
    FlowParameters p = parameters(5, step_size, iterations);
    p.preserve = preserve;
    return p;
}

inline TriangleMesh evolved(TriangleMesh mesh, const FlowParameters& p) {
    evolve(mesh, p);
    return mesh;
}

/// Returns the largest distance between vertices of the same index.
inline double distance(const TriangleMesh& a, const TriangleMesh& b) {
    return worst_distance(a, b);
}

/// Returns the volume between two states of a surface.
inline double volume_between(const TriangleMesh& before, const TriangleMesh& after) {
    double sum = 0;
    for (const Triangle& t : before.triangles) {
        sum += swept_volume(corners_of(before.positions, t), corners_of(after.positions, t));
    }
    return sum;
}

inline TriangleMesh turned(const TriangleMesh& mesh, double angle, const Eigen::Vector3d& axis) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::AngleAxisd(angle, axis.normalized())));
}

inline const double kQuarterTurn = 0.5 * std::acos(-1.0);

/// Adds random numbers between -size and size to all coordinates.
inline TriangleMesh noisy(TriangleMesh mesh, double size) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-size, size);
    for (auto& position : mesh.positions) {
        position += Eigen::Vector3d(noise(random), noise(random), noise(random));
    }
    return mesh;
}

/// Selects the triangles whose first corner is higher than `height`.
inline Selection above(const TriangleMesh& mesh, double height) {
    Selection selection;
    for (const Triangle& t : mesh.triangles) {
        selection.push_back(mesh.positions[t[0]][2] > height ? 1 : 0);
    }
    return selection;
}

/// Returns all vertices of a mesh, and its selected triangles.
inline TriangleMesh part_of(const TriangleMesh& mesh, const Selection& selection) {
    TriangleMesh part{mesh.positions, {}};
    for (std::size_t i = 0; i < selection.size(); ++i) {
        if (selection[i] != 0) part.triangles.push_back(mesh.triangles[i]);
    }
    return part;
}

/// An open mesh without symmetry. Its boundary has corners.
inline TriangleMesh bumpy_cap(int frequency, double height = 0.1) {
    const TriangleMesh sphere = shapes::bumpy_sphere(frequency);
    return part_of(sphere, above(sphere, height));
}

}  // namespace tracked_mcf
