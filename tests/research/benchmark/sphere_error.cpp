// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/sphere_error.h"

#include <algorithm>
#include <cmath>

#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"

namespace tracked_mcf::benchmark {

void print_sphere_error(const std::string& name, const std::vector<Eigen::Vector3d>& positions,
                        double step_size, int steps) {
    if (!is_sphere(name)) return;
    double exact = kSphereRadius;
    for (int step = 0; step < steps; ++step) {
        exact = exact * exact * exact / (exact * exact + 2 * step_size);
    }
    double mean = 0;
    double squares = 0;
    double worst = 0;
    for (const Eigen::Vector3d& position : positions) {
        const double error = position.norm() - exact;
        mean += error / static_cast<double>(positions.size());
        squares += error * error;
        worst = std::max(worst, std::abs(error));
    }
    print_quantity("mean_radius_error", steps, mean);
    print_quantity("rms_radius_error", steps,
                   std::sqrt(squares / static_cast<double>(positions.size())));
    print_quantity("worst_radius_error", steps, worst);
}

}  // namespace tracked_mcf::benchmark
