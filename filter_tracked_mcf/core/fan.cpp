#include "filter_tracked_mcf/core/fan.h"

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

}  // namespace tracked_mcf
