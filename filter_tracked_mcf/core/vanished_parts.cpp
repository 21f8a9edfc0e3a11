#include "filter_tracked_mcf/core/vanished_parts.h"

#include <utility>

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

namespace {

/// Of every finest element, the element of the coarsest level that contains it: there, each
/// connected part of the surface has one.
std::vector<std::int32_t> parts(const TrackedElements& elements) {
    const Level& coarsest = elements.levels.front();
    std::vector<std::int32_t> part_of(coarsest.cells.size());
    for (std::size_t element = 0; element < part_of.size(); ++element) {
        part_of[element] = static_cast<std::int32_t>(element);
    }
    for (std::size_t level = 1; level < elements.levels.size(); ++level) {
        std::vector<std::int32_t> finer;
        finer.reserve(elements.levels[level].parents.size());
        for_each_item(elements.levels[level].parents,
                      [&](std::int32_t parent) { finer.push_back(part_of[parent]); });
        part_of = std::move(finer);
    }
    return part_of;
}

}  // namespace

VanishedParts::VanishedParts(const TrackedElements& elements)
    : elements_(elements),
      part_of_(parts(elements)),
      initial_areas_(elements.levels.front().cells.size(), 0) {
    Pacer pacer;
    for (std::size_t element = 0; element < part_of_.size(); ++element) {
        for (std::int64_t i = elements.sample_begin[element];
             i < elements.sample_begin[element + 1]; ++i) {
            initial_areas_[part_of_[element]] += elements.samples.weight(i);
        }
        pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
    }
}

void VanishedParts::freeze(const ElementSystems& systems, double share,
                           std::vector<std::uint8_t>& frozen) const {
    std::vector<double> areas(initial_areas_.size(), 0);
    const auto count = static_cast<std::int64_t>(part_of_.size());
    serial_for(count,
               [&](std::int64_t element) { areas[part_of_[element]] += systems.areas[element]; });
    serial_for(count, [&](std::int64_t element) {
        const std::int32_t part = part_of_[element];
        // What is not a number must not pass for a part that stays.
        if (!(areas[part] <= share * initial_areas_[part])) return;
        for (const std::int32_t unknown : elements_.finest().unknowns[element]) frozen[unknown] = 1;
    });
}

}  // namespace tracked_mcf
