#include "filter_tracked_mcf/tool/documents/polygons.h"

#include <Eigen/Geometry>

namespace tracked_mcf {

Eigen::Vector3d area_vector(const Points& positions, const Polygons& polygons, std::size_t i) {
    const auto point = [&](std::size_t corner) -> const Eigen::Vector3d& {
        return positions[static_cast<std::size_t>(polygons.corners[corner])];
    };
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t apex = polygons.first[i];
    for (std::size_t corner = apex + 1; corner + 1 < polygons.first[i + 1]; ++corner) {
        sum += (point(corner) - point(apex)).cross(point(corner + 1) - point(apex));
    }
    return sum;
}

Points normals_where_corners_meet(const Points& positions, const Polygons& polygons,
                                  const std::vector<std::int32_t>& place, std::size_t count) {
    Points normals(count, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const Eigen::Vector3d area = area_vector(positions, polygons, i);
        for (std::size_t corner = polygons.first[i]; corner < polygons.first[i + 1]; ++corner) {
            if (place[corner] >= 0) normals[static_cast<std::size_t>(place[corner])] += area;
        }
    }
    // stableNormalize leaves zero vectors alone, and tiny models' normals do not underflow.
    for (Eigen::Vector3d& normal : normals) normal.stableNormalize();
    return normals;
}

}  // namespace tracked_mcf
