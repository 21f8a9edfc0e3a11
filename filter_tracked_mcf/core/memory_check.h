#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/memory_estimate.h"

namespace tracked_mcf {

/// Refuses what will not fit into memory, before the work on it begins.
class MemoryCheck {
public:
    /// `cube` is the grid's, at any depth. `available` is how many bytes the flow may take, what
    /// its Domain holds already among them; 0 is unknown, then nothing is refused.
    MemoryCheck(const SurfaceSize& size, const Grid& cube, const FlowParameters& parameters,
                std::int64_t available)
        : size_(size), cube_(cube), parameters_(parameters), available_(available) {}

    /// Throws NotEnoughMemory if a flow at this depth is expected not to fit. The message names the
    /// largest depth that is.
    void before_flow(int depth) const;

    /// The same if it is the clipping that is expected not to fit.
    void before_clipping(int depth) const;

    /// Bytes that a flow at this depth is expected to take.
    double flow_bytes(int depth) const;

private:
    bool fits(double bytes) const;
    [[noreturn]] void refuse(int depth) const;

    SurfaceSize size_;
    Grid cube_;
    FlowParameters parameters_;
    std::int64_t available_;
};

/// The check for a domain that has been made, on this machine as it is now.
MemoryCheck check_of(const Domain& domain, const Grid& cube, const FlowParameters& parameters);

}  // namespace tracked_mcf
