// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The spelling of MeshLab 2022.02 and later, and of PyMeshLab, of what the shared sources need.

#include <common/ml_document/mesh_document.h>
#include <common/plugins/interfaces/filter_plugin.h>

#include <type_traits>

class RichAbsPerc;
class RichPercentage;

namespace tracked_mcf {

template <class Type, class = void>
struct IsDefined : std::false_type {};
template <class Type>
struct IsDefined<Type, std::void_t<decltype(sizeof(Type))>> : std::true_type {};

/// The parameter type of a length: RichAbsPerc in 2022.02, renamed afterwards.
using RichLength =
    std::conditional_t<IsDefined<RichPercentage>::value, RichPercentage, RichAbsPerc>;

inline void update_box_and_normals(MeshModel& layer) {
    layer.updateBoxAndNormals();
}

/// Removes the log's lines of a preview.
inline void take_back_log(MeshDocument& document) {
    document.Log.backToBookmark();
}

/// Returns whether a parameter's value is the index of a choice.
inline bool holds_choice(const Value& value) {
    return value.isInt();
}

inline int choice_of(const Value& value) {
    return value.getInt();
}

}  // namespace tracked_mcf
