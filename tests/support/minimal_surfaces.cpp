// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/minimal_surfaces.h"

#include <Eigen/LU>
#include <cmath>

namespace tracked_mcf {

namespace {

using Eigen::Vector3d;

const double kTurn = 2 * std::acos(-1.0);

double root_mean_square(double squares, std::size_t count) {
    return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace

Catenoid::Catenoid(double distance) : height_(distance), neck_(1) {
    // Starting from above, the iteration finds the root with the wider neck.
    for (int i = 0; i < 1000; ++i) neck_ = 1 / std::cosh(0.5 * distance / neck_);
}

double Catenoid::radius(double z) const {
    return neck_ * std::cosh(z / neck_);
}

double Catenoid::offset(const Vector3d& point) const {
    return std::hypot(point[0], point[1]) - radius(point[2]);
}

double Catenoid::rms_offset(const std::vector<Vector3d>& points) const {
    double squares = 0;
    for (const Vector3d& point : points) squares += offset(point) * offset(point);
    return root_mean_square(squares, points.size());
}

double Catenoid::rms_of_chords(const std::vector<Vector3d>& points, const Grid& grid) const {
    double squares = 0;
    for (const Vector3d& point : points) {
        const double z = grid.to_grid(point)[2];
        const double low = grid.origin[2] + grid.cell_size * std::floor(z);
        const double share = z - std::floor(z);
        const double chord = (1 - share) * radius(low) + share * radius(low + grid.cell_size);
        squares += (chord - radius(point[2])) * (chord - radius(point[2]));
    }
    return root_mean_square(squares, points.size());
}

Vector3d Enneper::point(double u, double v) const {
    return {u - u * u * u / 3 + u * v * v, v - v * v * v / 3 + v * u * u, u * u - v * v};
}

TriangleMesh Enneper::cone(int n, int m) const {
    TriangleMesh mesh;
    mesh.positions.emplace_back(Vector3d::Zero());
    for (int ring = 1; ring <= m; ++ring) {
        for (int i = 0; i < n; ++i) {
            const double angle = kTurn * i / n;
            mesh.positions.emplace_back(
                static_cast<double>(ring) / m *
                point(radius_ * std::cos(angle), radius_ * std::sin(angle)));
        }
    }
    const auto vertex = [n](int ring, int i) { return 1 + (ring - 1) * n + i % n; };
    for (int i = 0; i < n; ++i) {
        mesh.triangles.push_back({0, vertex(1, i), vertex(1, i + 1)});
        for (int ring = 1; ring < m; ++ring) {
            mesh.triangles.push_back(
                {vertex(ring, i), vertex(ring + 1, i), vertex(ring + 1, i + 1)});
            mesh.triangles.push_back(
                {vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring, i + 1)});
        }
    }
    return mesh;
}

double Enneper::distance(const Vector3d& point) const {
    // Gauss-Newton: the surface is nearly flat over the distance to the point.
    Eigen::Vector2d parameters = point.head<2>();
    Vector3d miss;
    for (int i = 0; i < 50; ++i) {
        const double u = parameters[0];
        const double v = parameters[1];
        miss = point - this->point(u, v);
        Eigen::Matrix<double, 3, 2> slopes;
        slopes << 1 - u * u + v * v, 2 * u * v, 2 * u * v, 1 - v * v + u * u, 2 * u, -2 * v;
        parameters += (slopes.transpose() * slopes).inverse() * slopes.transpose() * miss;
    }
    return (point - this->point(parameters[0], parameters[1])).norm();
}

}  // namespace tracked_mcf
