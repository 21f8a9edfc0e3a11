// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

/// A phase of a flow's set-up.
struct SetupPhase {
    double begin;  ///< share of the set-up that is done, by the time of large scans
    const char* name;
};

// The phases in order. A flow skips those that its parameters do not need.
inline constexpr SetupPhase kCheckMesh = {0, "Checking the mesh"};
inline constexpr SetupPhase kFindEdges = {0.01, "Finding the edges"};
inline constexpr SetupPhase kMeasureSurface = {0.20, "Measuring the surface"};
inline constexpr SetupPhase kClipTriangles = {0.25, "Clipping triangles to cells"};
inline constexpr SetupPhase kBuildOctree = {0.42, "Building the octree"};
inline constexpr SetupPhase kSampleSurface = {0.60, "Sampling the surface"};
inline constexpr SetupPhase kPrepareSolver = {0.89, "Preparing the solver"};

/// Enters a phase as enter_phase() does. The innermost span is the whole set-up.
inline void enter_setup_phase(const SetupPhase& phase) {
    enter_phase(phase.begin, phase.name);
}

}  // namespace tracked_mcf
