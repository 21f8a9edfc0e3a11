// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/experiments/meshes.h"

#include "filter_tracked_mcf/tool/mesh_file.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

TriangleMesh named_mesh(const std::string& name) {
    const std::string sphere = "sphere:";
    if (name.rfind(sphere, 0) == 0) {
        return shapes::geodesic_sphere(std::stoi(name.substr(sphere.size())));
    }
    return MeshFile(name).triangle_mesh();
}

}  // namespace tracked_mcf::experiments
