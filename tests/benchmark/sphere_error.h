#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace tracked_mcf::benchmark {

/// If the mesh of that name was a sphere: prints how far it is, after `steps` steps of δ, from the
/// exact radius of semi-implicit steps, r(t + δ) = r³ / (r² + 2δ): the mean radius, signed, and the
/// worst vertex. Of a noisy one that is what is left of the noise, too.
void print_sphere_error(const std::string& name, const std::vector<Eigen::Vector3d>& positions,
                        double step_size, int steps);

}  // namespace tracked_mcf::benchmark
