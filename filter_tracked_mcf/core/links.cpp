#include "filter_tracked_mcf/core/links.h"

#include <algorithm>

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

void sort_and_remove_copies(std::vector<Link>& links, std::int32_t element_count) {
    // A counting sort by first; few links have the same one, so these are soon sorted by second.
    std::vector<std::int64_t> end(static_cast<std::size_t>(element_count) + 1, 0);
    for_each_item(links, [&](const Link& link) { ++end[link.first + 1]; });
    for (std::int32_t element = 0; element < element_count; ++element) {
        end[element + 1] += end[element];
    }
    std::vector<std::int32_t> seconds;
    resize(seconds, static_cast<std::int64_t>(links.size()));
    for_each_item(links, [&](const Link& link) { seconds[end[link.first]++] = link.second; });
    links.clear();
    auto range_begin = seconds.begin();
    Pacer pacer;
    for (std::int32_t first = 0; first < element_count; ++first) {
        const auto range_end = seconds.begin() + end[first];
        std::sort(range_begin, range_end);
        const auto unique_end = std::unique(range_begin, range_end);
        for (auto second = range_begin; second != unique_end; ++second) {
            links.push_back({first, *second});
        }
        pacer.did(range_end - range_begin + 1);
        range_begin = range_end;
    }
}

}  // namespace tracked_mcf
