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
/// units, the pull δ' (λ - η u) of a support on the surface, u being how far the embedding is from
/// where it was at the start. The spring η alone would give way by 1 / η of a cell, since a surface
/// pulls at its rim with the strength 1 of its conormal. So each element has a λ of its own, which
/// starts as that conormal and takes up what the spring has held after each step (the method of
/// multipliers; one constant λ an element, for more would lock the cells of a curved rim, as a
/// large η does). The slip that is left is of second order in the cell size, and η need not be
/// large. Test functions of LockedCells, by contrast, hold a band of cells.
class HeldCurve {
public:
    /// `elements` must outlive this. The supports' pull starts as what keeps the initial surface
    /// in place.
    explicit HeldCurve(const TrackedElements& elements);

    /// Adds the supports to the finest level's system for a step of δ' (grid units) from the
    /// embedding with this displacement.
    void add(const Coefficients& displacement, double step_size, ElementSystems& systems) const;

    /// Takes up what the spring holds of the embedding that a step has led to.
    void take_up(const Coefficients& displacement);

private:
    /// The held edges' pieces in one element.
    struct Support {
        std::int32_t element;
        std::size_t begin, end;  ///< in TrackedElements::held_samples
        Eigen::Vector3d pull;    ///< λ
    };

    Eigen::Vector3d displacement_at(const HeldSample& sample,
                                    const Coefficients& displacement) const;
    template <class Quantity>
    Eigen::Vector3d mean(const Support& support, const Quantity& quantity) const;

    const TrackedElements& elements_;
    std::vector<Support> supports_;
};

}  // namespace tracked_mcf
