// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/bad_meshes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tests/support/not_finite.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::zoo {

namespace {

using Eigen::Vector3d;

Eigen::Affine3d placed(const Vector3d& translation, double scale) {
    return Eigen::Translation3d(translation) * Eigen::Scaling(scale);
}

TriangleMesh scaled(const TriangleMesh& mesh, const Vector3d& factors) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::Scaling(factors)));
}

Eigen::Affine3d turned(Random& random) {
    const Vector3d axis = random.direction();
    return Eigen::Affine3d(Eigen::AngleAxisd(random.between(0, 6), axis));
}

TriangleMesh sphere(Random& random) {
    return shapes::bumpy_sphere(random.integer(1, 8));
}

/// A mesh without defects, closed or open, in a random position.
TriangleMesh plain(Random& random) {
    TriangleMesh mesh;
    const int n = random.integer(3, 24), m = random.integer(3, 12);
    switch (random.below(6)) {
        case 0:
            mesh = shapes::torus(n, m, 1, 0.3);
            break;
        case 1:
            mesh = shapes::box(m - 2, {1, 0.5, random.between(0.1, 1)});
            break;
        case 2:
            mesh = shapes::tube(n, m - 2, 2);
            break;
        case 3:
            mesh = shapes::square(m - 2);
            break;
        case 4:
            mesh = shapes::annulus(n, m - 2, 0.3, 1);
            break;
        default:
            mesh = sphere(random);
    }
    return random.chance(0.5) ? shapes::transformed(mesh, turned(random)) : mesh;
}

TriangleMesh noisy(Random& random) {
    TriangleMesh mesh = plain(random);
    const double size = random.log_between(1e-4, 1);
    for (Vector3d& position : mesh.positions) position += size * random.point();
    return mesh;
}

/// Calls change(triangle) for random triangles of a mesh, at least one.
template <class Change>
void change_some(TriangleMesh& mesh, Random& random, const Change& change) {
    const auto size = static_cast<int>(mesh.triangles.size());
    const int count = random.integer(1, random.chance(0.5) ? 3 : size);
    for (int i = 0; i < count; ++i) change(mesh.triangles[random.below(size)]);
}

TriangleMesh zero_areas(Random& random) {
    TriangleMesh mesh = plain(random);
    auto& at = mesh.positions;
    change_some(mesh, random, [&](const Triangle& t) {
        at[t[0]] = random.chance(0.5) ? at[t[1]] : Vector3d(0.5 * (at[t[1]] + at[t[2]]));
    });
    return mesh;
}

TriangleMesh needles(Random& random) {
    TriangleMesh mesh = plain(random);
    auto& at = mesh.positions;
    change_some(mesh, random, [&](const Triangle& t) {
        const double where = random.chance(0.5) ? random.unit() : random.log_between(1e-16, 1);
        const Vector3d foot = at[t[1]] + where * (at[t[2]] - at[t[1]]);
        at[t[0]] = foot + random.log_between(1e-17, 1e-1) * (at[t[0]] - foot);
    });
    return mesh;
}

TriangleMesh repeated_indices(Random& random) {
    TriangleMesh mesh = plain(random);
    change_some(mesh, random, [&](Triangle& t) {
        t[1] = t[0];
        if (random.chance(0.3)) t[2] = t[0];
    });
    return mesh;
}

TriangleMesh duplicates(Random& random) {
    TriangleMesh mesh = plain(random);
    std::vector<Triangle> copies;
    change_some(mesh, random, [&](const Triangle& t) {
        copies.push_back(random.chance(0.5) ? t : Triangle{t[0], t[2], t[1]});
        if (random.chance(0.2)) copies.push_back({t[1], t[2], t[0]});
    });
    mesh.triangles.insert(mesh.triangles.end(), copies.begin(), copies.end());
    return mesh;
}

TriangleMesh flips(Random& random) {
    TriangleMesh mesh = plain(random);
    change_some(mesh, random, [](Triangle& t) { std::swap(t[0], t[1]); });
    return mesh;
}

std::int32_t added_vertex(TriangleMesh& mesh, const Vector3d& position) {
    mesh.positions.push_back(position);
    return static_cast<std::int32_t>(mesh.positions.size()) - 1;
}

/// Fins stand on edges.
TriangleMesh non_manifold_edges(Random& random) {
    TriangleMesh mesh = plain(random);
    std::vector<Triangle> fins;
    change_some(mesh, random, [&](const Triangle& t) {
        const Vector3d tip = mesh.positions[t[0]] + random.offset(1e-8, 1);
        fins.push_back({t[0], t[1], added_vertex(mesh, tip)});
    });
    mesh.triangles.insert(mesh.triangles.end(), fins.begin(), fins.end());
    return mesh;
}

/// Spheres of several sizes have one vertex in common.
TriangleMesh non_manifold_vertices(Random& random) {
    TriangleMesh mesh;
    const int count = random.integer(2, 6);
    for (int i = 0; i < count; ++i) {
        TriangleMesh part = shapes::geodesic_sphere(random.integer(1, 4));
        const double size = random.chance(0.5) ? 1 : random.log_between(1e-3, 1);
        const Eigen::Affine3d place =
            turned(random) * Eigen::Scaling(size) * Eigen::Translation3d(-part.positions[0]);
        mesh = shapes::merged(mesh, shapes::transformed(part, place));
    }
    return mesh;
}

/// Random pairs of vertices become one, so that triangles cross the mesh.
TriangleMesh glued(Random& random) {
    TriangleMesh mesh = plain(random);
    const auto vertex_count = static_cast<int>(mesh.positions.size());
    change_some(mesh, random, [&](Triangle& t) {
        const int corner = random.below(3);
        t[corner] = random.below(vertex_count);
    });
    return mesh;
}

TriangleMesh unreferenced(Random& random) {
    TriangleMesh mesh = plain(random);
    const int count = random.integer(1, 5);
    std::vector<Vector3d> far;
    for (int i = 0; i < count; ++i) {
        const double distance = random.pick({1e3, 1e30, 1e308, kInfinity, kNaN});
        far.emplace_back(distance * random.point());
    }
    mesh.positions.insert(mesh.positions.begin(), far.begin(), far.end());
    for (Triangle& t : mesh.triangles) {
        for (std::int32_t& vertex : t) vertex += count;
    }
    mesh.positions.push_back(far[0]);
    return mesh;
}

TriangleMesh soup(Random& random) {
    TriangleMesh mesh = shapes::soup(plain(random));
    const double cracks = random.pick({0.0, 1e-15, 1e-6, 1e-2});
    for (Vector3d& position : mesh.positions) position += cracks * random.point();
    return mesh;
}

/// Random points, and triangles between any of them.
TriangleMesh tangle(Random& random) {
    TriangleMesh mesh;
    const int vertex_count = random.integer(3, 40);
    for (int i = 0; i < vertex_count; ++i) mesh.positions.push_back(random.point());
    const int count = random.integer(1, 100);
    for (int i = 0; i < count; ++i) {
        const int a = random.below(vertex_count), b = random.below(vertex_count);
        mesh.triangles.push_back({a, b, random.below(vertex_count)});
    }
    return mesh;
}

TriangleMesh moebius(Random& random) {
    const int n = random.integer(3, 40);
    return shapes::moebius_band(n, random.integer(1, 8));
}

TriangleMesh one_triangle(Random& random) {
    TriangleMesh mesh;
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(random.point());
    if (random.chance(0.5)) {
        const Vector3d edge = mesh.positions[2] - mesh.positions[0];
        mesh.positions[2] = mesh.positions[0] + random.log_between(1e-16, 1) * edge;
    }
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TriangleMesh components(Random& random) {
    return shapes::separate_triangles(random.integer(2, 3000));
}

TriangleMesh spheres_of_all_sizes(Random& random) {
    TriangleMesh mesh;
    const int count = random.integer(2, 12);
    for (int i = 0; i < count; ++i) {
        const TriangleMesh part = shapes::bumpy_sphere(random.integer(1, 4));
        const Vector3d centre = random.point();
        const double radius = random.log_between(1e-12, 1);
        mesh = shapes::merged(mesh, shapes::transformed(part, placed(centre, radius)));
    }
    return mesh;
}

TriangleMesh tiny(Random& random) {
    const double size = random.pick({1e-30, 1e-59, 1e-200});
    return scaled(plain(random), Vector3d::Constant(size));
}

TriangleMesh huge(Random& random) {
    const double size = random.pick({1e30, 1e59, 1e150});
    return scaled(plain(random), Vector3d::Constant(size));
}

TriangleMesh far(Random& random) {
    const double distance = random.pick({1e4, 1e7, 1e10});
    const Vector3d where = distance * random.point();
    return shapes::transformed(plain(random), placed(where, 1));
}

TriangleMesh denormals(Random& random) {
    Vector3d factors(1, 1, 1);
    factors[random.below(3)] = 1e-310;
    if (random.chance(0.3)) factors[random.below(3)] = 1e-310;
    return scaled(plain(random), factors);
}

TriangleMesh not_finite(Random& random) {
    TriangleMesh mesh = plain(random);
    const auto vertex_count = static_cast<int>(mesh.positions.size());
    const int vertex = random.below(vertex_count), axis = random.below(3);
    mesh.positions[vertex][axis] = random.pick({kNaN, kInfinity, -kInfinity});
    return mesh;
}

TriangleMesh one_point(Random& random) {
    TriangleMesh mesh = plain(random);
    const Vector3d point = random.point();
    for (Vector3d& position : mesh.positions) position = point;
    return mesh;
}

TriangleMesh one_line(Random& random) {
    TriangleMesh mesh = plain(random);
    const Vector3d axis = random.chance(0.5) ? Vector3d::UnitY() : random.direction();
    for (Vector3d& position : mesh.positions) position = position[0] * axis;
    return mesh;
}

/// A box in planes of the grid at a random depth, inside the box [0, 1]³ that sets the grid.
TriangleMesh on_grid_planes(Random& random) {
    const int depth = random.integer(1, 6);
    // The cube has 1.1 times the side of the mesh and the same centre.
    const auto plane = [&](int i) { return 0.5 + 1.1 * std::ldexp(i, -depth); };
    const int most = std::max(1, static_cast<int>(std::ldexp(1, depth - 1) / 1.1));
    Vector3d low, size;
    for (int axis = 0; axis < 3; ++axis) {
        const int first = random.integer(-most, most - 1);
        low[axis] = plane(first);
        size[axis] = plane(random.integer(first + 1, most)) - low[axis];
    }
    const TriangleMesh inner = shapes::box(random.integer(1, 4), size);
    return shapes::merged(shapes::transformed(inner, placed(low, 1)), shapes::box(1, {1, 1, 1}));
}

TriangleMesh sheets(Random& random) {
    const int count = random.integer(2, 40), n = random.integer(1, 5);
    return shapes::stack(shapes::square(n), count, random.log_between(1e-12, 0.1));
}

/// Pages that share a spine.
TriangleMesh book(Random& random) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}};
    const int count = random.integer(3, 200);
    const double opening = random.log_between(1e-9, 6);
    for (int i = 0; i < count; ++i) {
        const double angle = opening * i / count;
        const Vector3d out(std::cos(angle), std::sin(angle), 0);
        const std::int32_t low = added_vertex(mesh, out);
        const std::int32_t high = added_vertex(mesh, out + Vector3d::UnitZ());
        mesh.triangles.push_back({0, low, high});
        mesh.triangles.push_back({0, high, 1});
    }
    return mesh;
}

/// Triangles around one vertex; a cone, a disc, or several turns of a spiral.
TriangleMesh fan(Random& random) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, random.pick({0.0, 1e-3, 1.0, 10.0})}};
    const int count = random.integer(3, 2000);
    const double angle = random.pick({0.5, 1.0, 3.0}) * 2 * std::acos(-1.0) / count;
    for (int i = 0; i <= count; ++i) {
        const double ragged = 1 - (random.chance(0.1) ? random.unit() : 0);
        mesh.positions.emplace_back(ragged * std::cos(i * angle), ragged * std::sin(i * angle), 0);
        if (i > 0) mesh.triangles.push_back({0, i, i + 1});
    }
    return mesh;
}

TriangleMesh sphere_at_corner(Random& random) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    const TriangleMesh small = shapes::bumpy_sphere(random.integer(1, 6));
    const Vector3d place = random.chance(0.5) ? Vector3d::Zero() : random.point();
    const double radius = random.log_between(1e-12, 1e-1);
    return shapes::merged(mesh, shapes::transformed(small, placed(place, radius)));
}

TriangleMesh stretched(Random& random) {
    Vector3d factors(1, 1, 1);
    const int axis = random.below(3);
    factors[axis] = random.log_between(1e-6, 1e6);
    if (random.chance(0.3)) factors[(axis + 1) % 3] = random.log_between(1e-6, 1e6);
    return scaled(plain(random), factors);
}

TriangleMesh strip(Random& random) {
    const int n = random.integer(2, 20);
    TriangleMesh mesh = scaled(shapes::square(n), {1, random.log_between(1e-9, 1e-2), 1});
    const double wave = random.pick({0.0, 1e-3, 0.3});
    for (Vector3d& position : mesh.positions) position[2] = wave * std::sin(9 * position[0]);
    return mesh;
}

TriangleMesh spike(Random& random) {
    TriangleMesh mesh = plain(random);
    const auto vertex_count = static_cast<int>(mesh.positions.size());
    const int count = random.integer(1, 3);
    for (int i = 0; i < count; ++i) {
        const int vertex = random.below(vertex_count);
        mesh.positions[vertex] += random.offset(1, 1e6);
    }
    return mesh;
}

/// Two layers with opposite orientation in one place, which share vertices or do not.
TriangleMesh double_cover(Random& random) {
    TriangleMesh mesh = plain(random), back = mesh;
    for (Triangle& t : back.triangles) std::swap(t[0], t[1]);
    if (random.chance(0.5)) return shapes::merged(mesh, back);
    mesh.triangles.insert(mesh.triangles.end(), back.triangles.begin(), back.triangles.end());
    return mesh;
}

/// The faces of random cubes of a lattice: many edges and vertices are not manifold.
TriangleMesh voxels(Random& random) {
    const int n = random.integer(1, 4);
    const double filled = random.between(0.1, 0.9);
    std::set<std::array<int, 3>> solid = {{0, 0, 0}};
    for (int i = 0; i < n * n * n; ++i) {
        if (random.chance(filled)) solid.insert({i % n, i / n % n, i / n / n});
    }
    return shapes::voxels(0, n, [&](const Eigen::Vector3i& at) {
        return solid.count({at[0], at[1], at[2]}) > 0;
    });
}

/// Two spheres joined by a tube that may be thinner than a cell; not welded.
TriangleMesh dumbbell(Random& random) {
    const TriangleMesh ball = shapes::bumpy_sphere(random.integer(2, 6));
    const double radius = random.log_between(1e-6, 0.3);
    const int n = random.integer(3, 10);
    const TriangleMesh tube = shapes::tube(n, random.integer(1, 20), 6);
    const TriangleMesh handle = scaled(tube, {radius, radius, 1});
    return shapes::merged(handle, shapes::merged(shapes::transformed(ball, placed({0, 0, -3}, 1)),
                                                 shapes::transformed(ball, placed({0, 0, 3}, 1))));
}

/// An open sheet, flat or bent, with uneven vertices and perhaps noise. Its outline may be ragged.
TriangleMesh open_sheet(Random& random) {
    const int side = random.integer(4, 30);
    TriangleMesh mesh = shapes::square(side);
    const double bend = random.pick({0.0, random.between(0, 1)});
    const double uneven = random.pick({0.0, 0.3}) / side;
    const double height = random.pick({0.0, 0.02, 0.1, 0.4}) / side;
    for (Vector3d& p : mesh.positions) {
        p += Vector3d(uneven * random.between(-1, 1), uneven * random.between(-1, 1),
                      bend * p.x() * p.x() + height * random.between(-1, 1));
    }
    if (random.chance(0.3)) {
        auto& triangles = mesh.triangles;
        const auto is_cut = [&](const Triangle& /*triangle*/) { return random.chance(0.1); };
        triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_cut),
                        triangles.end());
    }
    return shapes::transformed(mesh, turned(random));
}

/// A closed surface or a sheet cut along a line, whose sides are almost at the same place.
TriangleMesh cracked(Random& random) {
    TriangleMesh mesh = random.chance(0.5) ? open_sheet(random) : noisy(random);
    const double shift = random.log_between(1e-18, 1e-9);
    const double height = mesh.positions.front().z();
    std::vector<std::int32_t> copies(mesh.positions.size(), -1);
    for (Triangle& t : mesh.triangles) {
        const auto [a, b, c] = t;
        const double sum = mesh.positions[a].z() + mesh.positions[b].z() + mesh.positions[c].z();
        if (!(sum > 3 * height)) continue;
        for (std::int32_t& vertex : t) {
            if (copies[vertex] < 0) {
                copies[vertex] = static_cast<std::int32_t>(mesh.positions.size());
                const Vector3d p = mesh.positions[vertex];
                mesh.positions.push_back(p + shift * random.point());
            }
            vertex = copies[vertex];
        }
    }
    return mesh;
}

/// A part of a few faces.
TriangleMesh coarse(Random& random) {
    const Vector3d sizes(1, random.between(0.1, 1), random.between(0.1, 1));
    TriangleMesh mesh = shapes::box(random.integer(1, 5), sizes);
    if (random.chance(0.3)) mesh.triangles.resize(mesh.triangles.size() * 5 / 6);
    return shapes::transformed(mesh, turned(random));
}

}  // namespace

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"sphere", sphere},
        {"plain", plain},
        {"noisy", noisy},
        {"zero_areas", zero_areas},
        {"needles", needles},
        {"repeated_indices", repeated_indices},
        {"duplicates", duplicates},
        {"flips", flips},
        {"non_manifold_edges", non_manifold_edges},
        {"non_manifold_vertices", non_manifold_vertices},
        {"glued", glued},
        {"unreferenced", unreferenced},
        {"soup", soup},
        {"tangle", tangle},
        {"moebius", moebius},
        {"one_triangle", one_triangle},
        {"components", components},
        {"spheres_of_all_sizes", spheres_of_all_sizes},
        {"tiny", tiny},
        {"huge", huge},
        {"far", far},
        {"denormals", denormals},
        {"not_finite", not_finite},
        {"one_point", one_point},
        {"one_line", one_line},
        {"on_grid_planes", on_grid_planes},
        {"sheets", sheets},
        {"book", book},
        {"fan", fan},
        {"sphere_at_corner", sphere_at_corner},
        {"stretched", stretched},
        {"strip", strip},
        {"spike", spike},
        {"double_cover", double_cover},
        {"voxels", voxels},
        {"dumbbell", dumbbell},
        {"open_sheet", open_sheet},
        {"cracked", cracked},
        {"coarse", coarse},
    };
    return all;
}

}  // namespace tracked_mcf::zoo
