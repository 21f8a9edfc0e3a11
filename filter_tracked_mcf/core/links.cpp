#include "filter_tracked_mcf/core/links.h"

#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

void sort_and_remove_copies(std::vector<Link>& links, std::int32_t element_count) {
    const auto count = static_cast<std::uint64_t>(element_count);
    std::vector<KeyValue> pairs;
    pairs.reserve(links.size());
    for (const Link& link : links) {
        const auto first = static_cast<std::uint64_t>(link.first);
        pairs.push_back({first * count + static_cast<std::uint64_t>(link.second), first});
    }
    sort_by_key(pairs);
    links.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i > 0 && pairs[i].key == pairs[i - 1].key) continue;
        links.push_back({static_cast<std::int32_t>(pairs[i].value),
                         static_cast<std::int32_t>(pairs[i].key - pairs[i].value * count)});
    }
}

}  // namespace tracked_mcf
