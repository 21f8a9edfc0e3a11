#include "filter_tracked_mcf/core/links.h"

#include <algorithm>

#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

void sort_and_remove_copies(RawVector<Link>& links) {
    sort_by(links, [](const Link& link) { return static_cast<std::uint64_t>(link.first); });
    const auto differs = [&](std::int64_t i) {
        return i == 0 || links[i].first != links[i - 1].first;
    };
    // Few links have the same first element, so these are soon sorted by the second.
    links = parallel_collect_runs<Link, RawVector<Link>>(
        static_cast<std::int64_t>(links.size()), differs,
        [&](std::int64_t begin, std::int64_t end, std::vector<Link>& out) {
            for_each_run(begin, end, differs, [&](std::int64_t first, std::int64_t last) {
                const auto of_first = static_cast<std::ptrdiff_t>(out.size());
                out.insert(out.end(), links.begin() + first, links.begin() + last);
                std::sort(out.begin() + of_first, out.end(),
                          [](const Link& a, const Link& b) { return a.second < b.second; });
                const auto same = [](const Link& a, const Link& b) { return a.second == b.second; };
                out.erase(std::unique(out.begin() + of_first, out.end(), same), out.end());
            });
        });
}

}  // namespace tracked_mcf
