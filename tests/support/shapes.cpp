// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace tracked_mcf::shapes {

namespace {

using Eigen::Vector3d;

/// Collects triangles by their corners' positions and welds corners that agree to rounding.
class Welder {
public:
    std::int32_t vertex(const Vector3d& position) {
        const std::array<std::int64_t, 3> key = {round(position[0]), round(position[1]),
                                                 round(position[2])};
        const auto [entry, is_new] =
            index_.try_emplace(key, static_cast<std::int32_t>(mesh_.positions.size()));
        if (is_new) mesh_.positions.push_back(position);
        return entry->second;
    }
    void triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        mesh_.triangles.push_back({vertex(a), vertex(b), vertex(c)});
    }
    TriangleMesh mesh() && { return std::move(mesh_); }

private:
    static std::int64_t round(double x) { return std::llround(x * 1e9); }

    TriangleMesh mesh_;
    std::map<std::array<std::int64_t, 3>, std::int32_t> index_;
};

/// Adds n by m quads of two triangles between the points of a grid.
void add_quads(Welder& welder, int n, int m, const std::function<Vector3d(int, int)>& point) {
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            welder.triangle(point(i, j), point(i + 1, j), point(i + 1, j + 1));
            welder.triangle(point(i, j), point(i + 1, j + 1), point(i, j + 1));
        }
    }
}

/// Adds the square spanned by two edges as n by n quads.
void add_square(Welder& welder, const Vector3d& origin, const Vector3d& u, const Vector3d& v,
                int n) {
    add_quads(welder, n, n, [&](int i, int j) -> Vector3d {
        return origin + (static_cast<double>(i) / n) * u + (static_cast<double>(j) / n) * v;
    });
}

/// Returns the icosahedron's corners, which do not lie on the unit sphere.
std::array<Vector3d, 12> icosahedron_corners() {
    const double g = (1 + std::sqrt(5.0)) / 2;
    return {Vector3d(-1, g, 0), Vector3d(1, g, 0), Vector3d(-1, -g, 0), Vector3d(1, -g, 0),
            Vector3d(0, -1, g), Vector3d(0, 1, g), Vector3d(0, -1, -g), Vector3d(0, 1, -g),
            Vector3d(g, 0, -1), Vector3d(g, 0, 1), Vector3d(-g, 0, -1), Vector3d(-g, 0, 1)};
}
constexpr std::array<Triangle, 20> kIcosahedronFaces = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// Splits the faces of an icosahedron into frequency² triangles each, on the sphere. Vertices that
/// faces share are found by their position on an edge, without a search: spheres may be large.
class GeodesicSphere {
public:
    explicit GeodesicSphere(int frequency)
        : frequency_(frequency),
          row_length_(static_cast<std::size_t>(frequency) + 1),
          on_edge_(12 * 12 * row_length_, kNone) {
        const auto n = static_cast<std::size_t>(frequency);
        mesh_.positions.reserve(10 * n * n + 2);
        mesh_.triangles.reserve(20 * n * n);
        for (const Triangle& face : kIcosahedronFaces) add_face(face);
    }
    TriangleMesh mesh() && { return std::move(mesh_); }

private:
    static constexpr std::int32_t kNone = -1;

    void add_face(const Triangle& face) {
        in_face_.assign(row_length_ * row_length_, kNone);
        for (int i = 0; i < frequency_; ++i) {
            for (int j = 0; i + j < frequency_; ++j) {
                // In braces, so that vertices are numbered in this order.
                mesh_.triangles.push_back(
                    {vertex(face, i, j), vertex(face, i + 1, j), vertex(face, i, j + 1)});
                if (i + j + 1 == frequency_) continue;
                mesh_.triangles.push_back(
                    {vertex(face, i + 1, j), vertex(face, i + 1, j + 1), vertex(face, i, j + 1)});
            }
        }
    }

    /// Returns the vertex of a face that is i steps from its first corner towards the second and j
    /// towards the third. The first call for a vertex adds it.
    std::int32_t vertex(const Triangle& face, int i, int j) {
        std::int32_t& in_face = in_face_[i * row_length_ + j];
        if (in_face != kNone) return in_face;
        std::int32_t* const shared = number_on_edge(face, i, j);
        if (shared != nullptr && *shared != kNone) return in_face = *shared;
        in_face = static_cast<std::int32_t>(mesh_.positions.size());
        if (shared != nullptr) *shared = in_face;
        mesh_.positions.emplace_back((corners_[face[0]] * (frequency_ - i - j) +
                                      corners_[face[1]] * i + corners_[face[2]] * j)
                                         .normalized());
        return in_face;
    }

    /// Returns where the number of a vertex on the boundary of a face is stored; null inside.
    std::int32_t* number_on_edge(const Triangle& face, int i, int j) {
        const std::array<int, 3> steps = {frequency_ - i - j, i, j};
        for (int corner = 0; corner < 3; ++corner) {
            if (steps[corner] == frequency_) return entry(face[corner], face[corner], 0);
        }
        for (int opposite = 0; opposite < 3; ++opposite) {
            if (steps[opposite] != 0) continue;
            const int from = (opposite + 1) % 3;
            const int to = (opposite + 2) % 3;
            return face[from] < face[to] ? entry(face[from], face[to], steps[to])
                                         : entry(face[to], face[from], steps[from]);
        }
        return nullptr;
    }
    std::int32_t* entry(std::int32_t first_corner, std::int32_t last_corner, int step) {
        return &on_edge_[(std::size_t{12} * first_corner + last_corner) * row_length_ + step];
    }

    int frequency_;
    std::size_t row_length_;  ///< vertices along an edge
    std::array<Vector3d, 12> corners_ = icosahedron_corners();
    std::vector<std::int32_t> on_edge_;  ///< by first corner, last corner and steps between them
    std::vector<std::int32_t> in_face_;  ///< of the current face, by i and j
    TriangleMesh mesh_;
};

}  // namespace

TriangleMesh geodesic_sphere(int frequency) {
    return GeodesicSphere(frequency).mesh();
}

TriangleMesh square(int n) {
    Welder welder;
    add_square(welder, Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), n);
    return std::move(welder).mesh();
}

TriangleMesh box(int n, const Vector3d& sizes) {
    const Vector3d x(sizes[0], 0, 0);
    const Vector3d y(0, sizes[1], 0);
    const Vector3d z(0, 0, sizes[2]);
    Welder welder;
    add_square(welder, Vector3d::Zero(), y, x, n);
    add_square(welder, z, x, y, n);
    add_square(welder, Vector3d::Zero(), x, z, n);
    add_square(welder, y, z, x, n);
    add_square(welder, Vector3d::Zero(), z, y, n);
    add_square(welder, x, y, z, n);
    return std::move(welder).mesh();
}

TriangleMesh torus(int n, int m, double radius, double tube_radius) {
    const double turn = 2 * std::acos(-1.0);
    Welder welder;
    add_quads(welder, n, m, [&](int i, int j) -> Vector3d {
        const double u = turn * i / n;
        const double v = turn * j / m;
        const double r = radius + tube_radius * std::cos(v);
        return {r * std::cos(u), r * std::sin(u), tube_radius * std::sin(v)};
    });
    return std::move(welder).mesh();
}

TriangleMesh tube(int n, int m, double height) {
    Welder welder;
    add_quads(welder, n, m, [&](int i, int j) -> Vector3d {
        const double u = 2 * std::acos(-1.0) * i / n;
        return {std::cos(u), std::sin(u), height * (static_cast<double>(j) / m - 0.5)};
    });
    return std::move(welder).mesh();
}

TriangleMesh annulus(int n, int m, double inner_radius, double outer_radius) {
    Welder welder;
    add_quads(welder, n, m, [&](int i, int j) -> Vector3d {
        const double u = 2 * std::acos(-1.0) * i / n;
        const double r = outer_radius + (inner_radius - outer_radius) * j / m;
        return {r * std::cos(u), r * std::sin(u), 0};
    });
    return std::move(welder).mesh();
}

TriangleMesh moebius_band(int n, int m) {
    Welder welder;
    add_quads(welder, n, m, [&](int i, int j) -> Vector3d {
        const double u = 2 * std::acos(-1.0) * i / n;
        const double across = 0.8 * (static_cast<double>(j) / m - 0.5);
        const double r = 1 + across * std::cos(0.5 * u);
        return {r * std::cos(u), r * std::sin(u), across * std::sin(0.5 * u)};
    });
    return std::move(welder).mesh();
}

TriangleMesh bumpy_sphere(int frequency) {
    TriangleMesh mesh = geodesic_sphere(frequency);
    for (Vector3d& p : mesh.positions) {
        p *= 1 + 0.1 * std::sin(3 * p[0] + 1) * std::cos(4 * p[1]) +
             0.07 * std::sin(5 * p[2] + p[0]);
    }
    return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const Eigen::Affine3d& transformation) {
    for (Vector3d& position : mesh.positions) position = transformation * position;
    return mesh;
}

TriangleMesh merged(TriangleMesh first, const TriangleMesh& second) {
    const auto offset = static_cast<std::int32_t>(first.positions.size());
    first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
    for (const Triangle& t : second.triangles) {
        first.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    return first;
}

TriangleMesh inside_out(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

TriangleMesh soup(const TriangleMesh& mesh) {
    TriangleMesh loose;
    for (const Triangle& triangle : mesh.triangles) {
        const auto first = static_cast<std::int32_t>(loose.positions.size());
        for (const std::int32_t vertex : triangle)
            loose.positions.push_back(mesh.positions[vertex]);
        loose.triangles.push_back({first, first + 1, first + 2});
    }
    return loose;
}

TriangleMesh fan(int triangles) {
    TriangleMesh mesh;
    mesh.positions.emplace_back(Vector3d::Zero());
    for (std::int32_t i = 0; i < triangles; ++i) {
        const double u = 2 * std::acos(-1.0) * i / triangles;
        mesh.positions.emplace_back(std::cos(u), std::sin(u), 0.1 * std::sin(5 * u));
        mesh.triangles.push_back({0, i + 1, (i + 1) % triangles + 1});
    }
    return mesh;
}

TriangleMesh stack(const TriangleMesh& sheet, int count, double distance) {
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i) {
        const Eigen::Translation3d shift(0, 0, i * distance);
        mesh = merged(std::move(mesh), transformed(sheet, Eigen::Affine3d(shift)));
    }
    return mesh;
}

TriangleMesh split_in_four(const TriangleMesh& mesh) {
    TriangleMesh split{mesh.positions, {}};
    std::map<std::array<std::int32_t, 2>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto next = static_cast<std::int32_t>(split.positions.size());
        const auto [entry, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, next);
        if (is_new) {
            split.positions.emplace_back((mesh.positions[a] + mesh.positions[b]) / 2);
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::int32_t ab = middle(a, b);
        const std::int32_t bc = middle(b, c);
        const std::int32_t ca = middle(c, a);
        split.triangles.insert(split.triangles.end(),
                               {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return split;
}

TriangleMesh separate_triangles(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto point = [&]() -> Vector3d {
        const double x = uniform(random);
        const double y = uniform(random);
        return {x, y, uniform(random)};
    };
    TriangleMesh mesh;
    for (std::int32_t i = 0; i < count; ++i) {
        const Vector3d middle = point();
        for (int corner = 0; corner < 3; ++corner) {
            mesh.positions.emplace_back(middle + 0.004 * point());
        }
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

TriangleMesh voxels(int begin, int end,
                    const std::function<bool(const Eigen::Vector3i&)>& is_solid) {
    const int side = end - begin;
    const auto is_filled = [&](const Eigen::Vector3i& at) {
        return at.minCoeff() >= begin && at.maxCoeff() < end && is_solid(at);
    };
    Welder welder;
    for (int i = 0; i < side * side * side; ++i) {
        const Eigen::Vector3i at =
            Eigen::Vector3i(i % side, i / side % side, i / side / side).array() + begin;
        if (!is_filled(at)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            Vector3d u = Vector3d::Unit((axis + 1) % 3), v = Vector3d::Unit((axis + 2) % 3);
            const Eigen::Vector3i up = Eigen::Vector3i::Unit(axis);
            if (!is_filled(at + up)) add_square(welder, (at + up).cast<double>(), u, v, 1);
            if (!is_filled(at - up)) add_square(welder, at.cast<double>(), v, u, 1);
        }
    }
    return std::move(welder).mesh();
}

namespace {

using Points = std::array<Eigen::Vector3i, 4>;

/// Returns the corners of a side of the cube at a point, in their order seen from outside.
Points corners_of_side(const Eigen::Vector3i& at, int axis, bool is_upper) {
    Eigen::Vector3i u = Eigen::Vector3i::Unit((axis + 1) % 3),
                    v = Eigen::Vector3i::Unit((axis + 2) % 3);
    if (!is_upper) std::swap(u, v);
    const Eigen::Vector3i first = at + (is_upper ? 1 : 0) * Eigen::Vector3i::Unit(axis);
    return {first, first + u, first + u + v, first + v};
}

using Point = std::array<double, 3>;

}  // namespace

TriangleMesh marching_cubes(int begin, int end,
                            const std::function<double(const Eigen::Vector3i&)>& field) {
    const auto value_at = [&](const Eigen::Vector3i& at) {
        return at.minCoeff() >= begin && at.maxCoeff() < end ? field(at) : 0;
    };
    const auto is_filled = [&](const Eigen::Vector3i& at) { return value_at(at) > 0.5; };
    const auto crossing = [&](const Eigen::Vector3i& filled, const Eigen::Vector3i& empty) {
        const double high = value_at(filled), low = value_at(empty);
        const Vector3d point =
            filled.cast<double>() + (high - 0.5) / (high - low) * (empty - filled).cast<double>();
        return Point{point[0], point[1], point[2]};
    };
    const int side = end - begin + 1;
    Welder welder;
    for (int i = 0; i < side * side * side; ++i) {
        const Eigen::Vector3i at =
            Eigen::Vector3i(i % side, i / side % side, i / side / side).array() + begin - 1;
        // On each side of the cube, segments cut off the corners that are empty.
        std::map<Point, Point> next;
        for (int face = 0; face < 6; ++face) {
            const Points corners = corners_of_side(at, face / 2, face % 2 == 0);
            for (std::size_t k = 0; k < 4; ++k) {
                std::size_t j = k;
                if (!is_filled(corners[k]) || is_filled(corners[(k + 1) % 4])) continue;
                do {
                    j = (j + 1) % 4;
                } while (!is_filled(corners[(j + 1) % 4]));
                next[crossing(corners[(j + 1) % 4], corners[j])] =
                    crossing(corners[k], corners[(k + 1) % 4]);
            }
        }
        while (!next.empty()) {
            std::vector<Vector3d> loop;
            for (auto entry = next.begin(); entry != next.end();) {
                loop.emplace_back(entry->first.data());
                const Point point = entry->second;
                next.erase(entry);
                entry = next.find(point);
            }
            for (std::size_t k = 2; k < loop.size(); ++k)
                welder.triangle(loop[0], loop[k - 1], loop[k]);
        }
    }
    return std::move(welder).mesh();
}

double volume(const TriangleMesh& mesh) {
    double six = 0;
    for (const Triangle& t : mesh.triangles) {
        six += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]]));
    }
    return six / 6;
}

Vector3d surface_centroid(const TriangleMesh& mesh) {
    // Relative to a vertex, so that a mesh far from the origin loses no digits.
    const Vector3d& near = mesh.positions[mesh.triangles.front()[0]];
    Vector3d moment = Vector3d::Zero();
    double weight = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vector3d a = mesh.positions[t[0]] - near;
        const Vector3d b = mesh.positions[t[1]] - near;
        const Vector3d c = mesh.positions[t[2]] - near;
        const double area = (b - a).cross(c - a).norm();
        moment += area * (a + b + c);
        weight += 3 * area;
    }
    return near + moment / weight;
}

}  // namespace tracked_mcf::shapes
