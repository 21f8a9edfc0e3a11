// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tracked_mcf::benchmark {

/// Prints the error of a sphere after `steps` steps of δ, against the exact radius of semi-implicit
/// steps, r(t + δ) = r³ / (r² + 2δ): the signed error of the mean radius, and the RMS and the
/// largest error of the vertices. The errors of a noisy sphere include the remaining noise. Prints
/// nothing for other meshes.
void print_sphere_error(const std::string& name, const std::vector<Eigen::Vector3d>& positions,
                        double step_size, int steps);

}  // namespace tracked_mcf::benchmark
