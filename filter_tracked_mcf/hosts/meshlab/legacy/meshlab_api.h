// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// MeshLab 2020.09's spelling of what the shared sources need.

#include <common/interfaces.h>

namespace tracked_mcf {

/// The parameter type of a length.
using RichLength = RichAbsPerc;

inline void update_box_and_normals(MeshModel& layer) {
    layer.UpdateBoxAndNormals();
}

/// Removes the log's lines of a preview.
inline void take_back_log(MeshDocument& document) {
    document.Log.BackToBookmark();
}

/// Returns whether a parameter's value is the index of a choice.
inline bool holds_choice(const Value& value) {
    return value.isEnum();
}

inline int choice_of(const Value& value) {
    return value.getEnum();
}

}  // namespace tracked_mcf
