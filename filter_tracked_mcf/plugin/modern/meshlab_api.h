#pragma once

// What the sources that serve every release need of MeshLab's interface, as MeshLab 2022.02 and
// later, and PyMeshLab, have it.

#include <common/ml_document/mesh_document.h>
#include <common/plugins/interfaces/filter_plugin.h>

namespace tracked_mcf {

inline void update_box_and_normals(MeshModel& layer) {
    layer.updateBoxAndNormals();
}

/// Whether a parameter's value is the index of a choice.
inline bool holds_choice(const Value& value) {
    return value.isInt();
}

inline int choice_of(const Value& value) {
    return value.getInt();
}

}  // namespace tracked_mcf
