#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/raw_vector.h"

namespace tracked_mcf {

/// Two elements of one level, in different cells that touch, between which the surface is
/// connected inside the support of every function that both cells have: first < second.
struct Link {
    std::int32_t first, second;
};

/// Sorts links by first, then second, and keeps one of each.
void sort_and_remove_copies(RawVector<Link>& links);

}  // namespace tracked_mcf
