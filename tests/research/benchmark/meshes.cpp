// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/meshes.h"

#include <algorithm>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::benchmark {

namespace {

using Eigen::Vector3d;

/// Splits a name at its colons.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words;
    std::istringstream stream(name);
    for (std::string word; std::getline(stream, word, ':');) words.push_back(word);
    return words;
}

/// Returns the same mesh at each call.
TriangleMesh noisy_sphere(int frequency, double amplitude) {
    TriangleMesh mesh = shapes::geodesic_sphere(frequency);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-1, 1);
    const double height = amplitude * mean_edge_length(mesh);
    for (Vector3d& position : mesh.positions) {
        position *= kSphereRadius * (1 + height * noise(random));
    }
    return mesh;
}

TriangleMesh in_unit_cube(TriangleMesh mesh) {
    const double side = longest_side(mesh);
    for (Vector3d& position : mesh.positions) position /= side;
    return mesh;
}

TriangleMesh scan(const std::string& path, int splits) {
    TriangleMesh mesh = MeshFile(path).triangle_mesh();
    for (int i = 0; i < splits; ++i) mesh = shapes::split_in_four(mesh);
    return in_unit_cube(std::move(mesh));
}

}  // namespace

TriangleMesh named_mesh(const std::string& name) {
    const std::vector<std::string> words = words_of(name);
    if (is_sphere(name)) {
        return noisy_sphere(std::stoi(words.at(1)), words.size() > 2 ? std::stod(words[2]) : 0);
    }
    return scan(words[0], words.size() > 1 ? std::stoi(words[1]) : 0);
}

bool is_sphere(const std::string& name) {
    return name.rfind("sphere:", 0) == 0;
}

}  // namespace tracked_mcf::benchmark
