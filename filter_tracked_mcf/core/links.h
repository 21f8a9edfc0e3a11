#pragma once

#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// Two elements of one level, in different cells that touch, between which the surface is
/// connected inside the support of every function that both cells have: first < second.
struct Link {
    std::int32_t first, second;
};

/// Sorts links between `element_count` elements by first, then second, and keeps one of each.
void sort_and_remove_copies(std::vector<Link>& links, std::int32_t element_count);

}  // namespace tracked_mcf
