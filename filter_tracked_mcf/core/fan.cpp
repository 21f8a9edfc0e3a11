#include "filter_tracked_mcf/core/fan.h"

#include <Eigen/Geometry>

namespace tracked_mcf {

namespace {

/// Squared distances that differ by less count as equal, so that rounding cannot choose the fan.
constexpr double kTie = 1e-9;

bool nearer(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
            const std::array<Eigen::Vector3d, 3>& triangle) {
    for (const Eigen::Vector3d& corner : triangle) {
        const double difference = (p - corner).squaredNorm() - (q - corner).squaredNorm();
        if (difference < -kTie) return true;
        if (difference > kTie) return false;
    }
    return false;
}

}  // namespace

int fan_apex(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle) {
    int apex = 0;
    for (int i = 1; i < polygon.size; ++i) {
        if (nearer(polygon.points[i], polygon.points[apex], triangle)) apex = i;
    }
    return apex;
}

double triangle_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

}  // namespace tracked_mcf
