#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// Holds the surface along the held edges, and lets everything beside them move.
///
/// To the displacement's system is added, along the held edges' pieces in the cells and in grid
/// units, the pull δ' (n + λ - η u) of supports: n is the conormal, against which the initial
/// surface pulls, and u how far the embedding is from where it was at the start. As the surface
/// moves, its pull turns, and the spring η alone would give way by up to 1 / η of a cell; so each
/// element has a λ, zero at the start, which takes up what the spring has held on average after
/// each step (the method of multipliers). It is constant in an element, and η moderate, because
/// holding every point of a curved rim exactly would lock its cells. The slip that is left is of
/// second order in the cell size.
class HeldCurve {
public:
    /// `elements` must outlive this. `spring` is η.
    HeldCurve(const TrackedElements& elements, double spring);

    /// Adds the supports to the finest level's system for a step of δ' (grid units) from the
    /// embedding with this displacement.
    void add(const Coefficients& displacement, double step_size, ElementSystems& systems) const;

    /// Takes up what the spring holds of the embedding that a step has led to.
    void take_up(const Coefficients& displacement);

private:
    /// The held edges' pieces in one element.
    struct Support {
        std::int32_t element;
        std::size_t begin, end;    ///< in TrackedElements::held_samples
        Eigen::Vector3d taken_up;  ///< λ
    };

    Eigen::Vector3d displacement_at(const HeldSample& sample,
                                    const Coefficients& displacement) const;

    const TrackedElements& elements_;
    double spring_;
    std::vector<Support> supports_;
};

}  // namespace tracked_mcf
