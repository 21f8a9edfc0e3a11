// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

#include "filter_tracked_mcf/core/fair.h"

namespace tracked_mcf {

using Inside = std::function<bool(const Eigen::Vector3d&)>;

/// Selects the triangles with a vertex inside.
inline Selection star_of(const TriangleMesh& mesh, const Inside& inside) {
    Selection selection;
    for (const Triangle& t : mesh.triangles) {
        const auto is_inside = [&](std::int32_t vertex) { return inside(mesh.positions[vertex]); };
        selection.push_back(std::any_of(t.begin(), t.end(), is_inside) ? 1 : 0);
    }
    return selection;
}

inline Inside cap(double degrees) {
    const double height = std::cos(degrees * std::acos(-1.0) / 180);
    return [height](const Eigen::Vector3d& p) { return p[2] > height; };
}

inline FairParameters with(Continuity continuity) {
    FairParameters parameters;
    parameters.continuity = continuity;
    return parameters;
}

/// A mesh, part of which is replaced by its membrane, as if a hole had been filled.
struct Filled {
    Filled(const TriangleMesh& original, const Inside& inside)
        : mesh(original), selection(star_of(original, inside)) {
        fair(mesh, selection, with(Continuity::Position));
    }

    TriangleMesh mesh;
    Selection selection;
};

inline double from_sphere(const Eigen::Vector3d& p) {
    return p.norm() - 1;
}

}  // namespace tracked_mcf
