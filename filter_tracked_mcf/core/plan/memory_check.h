// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/plan/memory_estimate.h"

namespace tracked_mcf {

/// Refuses depths that need more memory than is available, before most of the work on them.
class MemoryCheck {
public:
    /// Takes the flow's grid at any depth, and the bytes that the flow may take, by default those
    /// that are free now, or 0 if they are unknown: then every depth fits. Errs on the safe side by
    /// the domain's own 30 bytes per triangle, which the estimate includes.
    MemoryCheck(const SurfaceSize& size, const Grid& cube, const FlowParameters& parameters,
                std::int64_t available = available_memory_bytes())
        : size_(size), cube_(cube), parameters_(parameters), available_(available) {}

    /// Returns whether a flow at this depth is expected to fit.
    bool fits(int depth) const { return is_free(flow_bytes(depth)); }

    /// Throws NotEnoughMemory if a flow at this depth does not fit. The message names the largest
    /// depth that fits.
    void before_flow(int depth) const;

    /// Throws the same if clipping at this depth does not fit.
    void before_clipping(int depth) const;

    /// Returns the expected bytes of a flow at this depth.
    double flow_bytes(int depth) const;

private:
    bool is_free(double bytes) const;
    [[noreturn]] void refuse(int depth) const;

    SurfaceSize size_;
    Grid cube_;
    FlowParameters parameters_;
    std::int64_t available_;
};

}  // namespace tracked_mcf
