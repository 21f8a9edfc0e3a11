#pragma once

// What the sources that serve every release need of MeshLab's interface, as MeshLab 2020.09 has it.

#include <common/interfaces.h>

namespace tracked_mcf {

inline void update_box_and_normals(MeshModel& layer) {
    layer.UpdateBoxAndNormals();
}

/// Whether a parameter's value is the index of a choice.
inline bool holds_choice(const Value& value) {
    return value.isEnum();
}

inline int choice_of(const Value& value) {
    return value.getEnum();
}

}  // namespace tracked_mcf
