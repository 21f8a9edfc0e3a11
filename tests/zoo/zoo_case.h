// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/zoo/random.h"

namespace tracked_mcf::zoo {

/// A mesh, its inputs, and the parameters of the flow, or of another filter.
struct Case {
    std::string kind;  ///< of bad_meshes.h
    TriangleMesh mesh;
    Inputs inputs;
    FlowParameters parameters;
    std::optional<NoiseParameters> noise;  ///< if set, remove_noise() is called instead of evolve()
    std::optional<FairParameters> fair;    ///< if set, fair() is called

    bool makes_flow() const { return !noise && !fair; }
};

/// Returns a case of a seed; the same one every time.
Case case_of(std::uint64_t seed, std::int64_t number);

/// Returns the same mesh with random parameters of the removal of noise.
Case noise_case_of(std::uint64_t seed, std::int64_t number);

/// Returns the same mesh with a random patch to be faired; or, in half of the cases, a finer mesh
/// with noise, needles or faces without area around its patch.
Case fair_case_of(std::uint64_t seed, std::int64_t number);

/// Returns about how many fragments (pieces of a triangle in one cell) a flow at this depth has. 0
/// if the mesh has no finite size.
double fragments_at(const TriangleMesh& mesh, const Selection& selection, int depth);

/// Lowers the depth until there are at most about this many fragments, and the number of steps
/// until all solves together meet five times as many.
void limit_work(Case& limited, double most_fragments);

/// Returns the parameters as options of the program tracked_mcf.
std::string options_of(const Case& described);

/// Writes the mesh as an ASCII PLY file; its faces have the property `selected` if the case has a
/// selection. Throws std::runtime_error if it cannot.
void write_ply(const Case& written, const std::string& path);

}  // namespace tracked_mcf::zoo
