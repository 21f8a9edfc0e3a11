#include "filter_tracked_mcf/core/setup_phases.h"

#include <array>
#include <cstddef>

#include "filter_tracked_mcf/core/progress_meter.h"

namespace tracked_mcf {

namespace {

struct Entry {
    double begin;  ///< share of the set-up's time that is over, on large scans
    const char* name;
};

constexpr std::array<Entry, 8> kEntries = {{{0, "Checking the mesh"},
                                            {0.01, "Measuring the surface"},
                                            {0.04, "Finding the edges"},
                                            {0.12, "Choosing the grid"},
                                            {0.31, "Clipping triangles to cells"},
                                            {0.33, "Building the octree"},
                                            {0.52, "Sampling the surface"},
                                            {0.77, "Preparing the solver"}}};

}  // namespace

void enter_setup_phase(SetupPhase phase) {
    const Entry& entry = kEntries[static_cast<std::size_t>(phase)];
    enter_phase(entry.begin, entry.name);
}

}  // namespace tracked_mcf
