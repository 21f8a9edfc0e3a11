// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "filter_tracked_mcf/core/noise/candidate.h"

namespace tracked_mcf {

/// Per vertex: Stein's estimate of the squared error of a candidate's height there, up to a
/// constant that is the same for all candidates.
using Risks = std::vector<float>;

/// Returns the indices of at most `most` candidates, `first` and others, such that the least of
/// their risks, averaged over windows of a sample, is the least possible one after each choice.
std::vector<std::size_t> best_few(const Sample& sample, const std::vector<Risks>& risks,
                                  std::size_t first, std::size_t most);

/// Returns a perturbation of a surface by signs, as large as its noise.
Perturbation perturbation_of(const NoisySurface& surface, const StepSettings& settings,
                             double noise);

/// Returns whether the noise that a candidate has taken is larger in some places than in others, so
/// that no standard deviation suits all of them.
bool is_uneven(const NoisySurface& surface, const Perturbation& perturbation,
               const Positions& smoothed);

/// Returns positions between those of several candidates: near each vertex, those of the first one
/// unless another one's risk, averaged over a window around it, is less by more than its standard
/// error. `results` are those of the candidates, with their responses to the perturbation.
Positions chosen_locally(const NoisySurface& surface, const Perturbation& perturbation,
                         const Results& results);

}  // namespace tracked_mcf
