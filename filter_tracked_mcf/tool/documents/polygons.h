#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tracked_mcf {

using Points = std::vector<Eigen::Vector3d>;

/// The faces of a file, of any number of corners: polygon i owns the corners first[i] to
/// first[i + 1] - 1.
struct Polygons {
    std::vector<std::int32_t> corners;  ///< vertex indices
    std::vector<std::size_t> first{0};

    std::size_t size() const { return first.size() - 1; }
    std::size_t corner_count(std::size_t i) const { return first[i + 1] - first[i]; }

    /// Makes a polygon of the corners added since the last one.
    void close() { first.push_back(corners.size()); }
};

/// The sum of the normals of a polygon's fan triangles, each as long as twice its area.
Eigen::Vector3d area_vector(const Points& positions, const Polygons& polygons, std::size_t i);

/// Unit normals of `count` places where corners meet: `place` says for every corner where it
/// belongs, or -1. With the vertices as places these are area-weighted vertex normals; places that
/// several faces of one vertex do not share keep a crease sharp. Zero where no face has an area.
Points normals_where_corners_meet(const Points& positions, const Polygons& polygons,
                                  const std::vector<std::int32_t>& place, std::size_t count);

}  // namespace tracked_mcf
