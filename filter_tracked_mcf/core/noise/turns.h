// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/noise/noisy_surface.h"

namespace tracked_mcf {

/// Returns the length of the difference of two unit normals across a crease of this angle, in
/// degrees.
double crease_of(double angle);

/// How much normals differ across the triangles of a surface.
class Turns {
public:
    Turns(const Stars& stars, const Positions& positions, const Vectors& normals);

    /// Returns the share of the area in triangles that a crease crosses.
    double share_of(double crease) const;

    /// Returns the angle by which the normals of half the area differ, degrees. Sorts the turns.
    double median_angle();

private:
    struct Turn {
        double chord;  ///< largest difference of the unit normals at two corners
        double area;
    };

    std::vector<Turn> turns_;
    double area_ = 0;
};

}  // namespace tracked_mcf
