// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// How hosts present a filter.
struct FilterNames {
    const char* name;    ///< in menus and scripts
    const char* python;  ///< in PyMeshLab, where filters that move vertices begin with apply_coord
    const char* help;    ///< in the HTML that MeshLab shows
};

/// The names of the filter with these parameters.
template <class Parameters>
inline constexpr FilterNames kNames = {};

template <>
inline constexpr FilterNames kNames<FlowParameters> = {
    "Mean Curvature Flow", "apply_coord_mean_curvature_flow",
    "Smooths the surface by <b>mean-curvature flow</b>, which removes detail below a chosen size. "
    "To keep creases, take <i>Remove Noise</i>. Only positions and, if asked for, vertex "
    "qualities change.<br>See Ming Chuang and Michael Kazhdan: <b>Fast Mean-Curvature Flow via "
    "Finite-Elements Tracking</b>, 2011, <a "
    "href=\"https://doi.org/10.1111/j.1467-8659.2011.01899.x\">"
    "doi:10.1111/j.1467-8659.2011.01899.x</a>."};

template <>
inline constexpr FilterNames kNames<NoiseParameters> = {
    "Remove Noise", "apply_coord_remove_noise",
    "Removes <b>noise</b> from scans and parts, and keeps creases and larger detail. It measures "
    "the noise, so the defaults suit most meshes; a mesh without noise stays as it is. Only "
    "positions and, if asked for, vertex qualities change."};

template <>
inline constexpr FilterNames kNames<FairParameters> = {
    "Fair Selected Faces", "apply_coord_fair_selected_faces",
    "Makes the <b>selected faces continue the surface</b> around them, such as those that fill a "
    "hole. Only their inner vertices move. After <i>Close Holes</i>, the new faces are selected; "
    "refine them, because long triangles without inner vertices cannot bend. Where the "
    "surroundings are rough, <i>Remove Noise</i> first."};

/// Says what is wrong where a layer has no quality for the parameter `strength`.
inline constexpr const char* kNoQuality =
    "The layer has no vertex quality to take the strength from; compute one, from 0 to 1, or "
    "switch it off.";

}  // namespace tracked_mcf
