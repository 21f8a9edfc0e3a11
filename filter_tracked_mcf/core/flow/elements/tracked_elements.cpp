// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"

#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/cells/clip.h"
#include "filter_tracked_mcf/core/flow/cells/cubature.h"
#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Per vertex: the smallest index of an element that contains it. Being the smallest, it does not
/// depend on the order in which threads claim the vertex.
using Claims = std::vector<std::atomic<std::int32_t>>;

constexpr std::int32_t kUnclaimed = std::numeric_limits<std::int32_t>::max();

void claim(std::atomic<std::int32_t>& vertex, std::int32_t element) {
    std::int32_t current = vertex.load(std::memory_order_relaxed);
    while (element < current && !vertex.compare_exchange_weak(current, element)) {
    }
}

/// Fills in the fragments, samples and vertices of TrackedElements whose levels are built.
class ElementBuilder {
public:
    ElementBuilder(TrackedElements& elements, const Surface& surface, const GridMesh& mesh,
                   const RawVector<FragmentEntry>& entries, Cubature cubature)
        : elements_(elements),
          surface_(surface),
          mesh_(mesh),
          entries_(entries),
          rule_(cubature_rule(cubature)),
          claims_(mesh.positions.size()) {
        parallel_for_rows(static_cast<std::int64_t>(claims_.size()), [&](std::int32_t vertex) {
            claims_[vertex].store(kUnclaimed, std::memory_order_relaxed);
        });
    }

    void build() {
        allocate();
        parallel_for_chunks(elements_.finest().element_count(),
                            [&](std::int64_t begin, std::int64_t end) {
                                Pacer pacer;
                                for (std::int64_t element = begin; element < end; ++element) {
                                    fill_element(static_cast<std::int32_t>(element), pacer);
                                }
                            });
        locate_vertices();
    }

private:
    void allocate() {
        const std::int32_t element_count = elements_.finest().element_count();
        const auto entry_count = static_cast<std::int64_t>(entries_.size());
        const auto samples_of = [&](std::int64_t element) {
            std::int64_t split_triangles = 0;
            for (std::int64_t i = elements_.fragment_begin[element];
                 i < elements_.fragment_begin[element + 1]; ++i) {
                split_triangles += entries_[i].split_triangles;
            }
            return split_triangles * static_cast<std::int64_t>(rule_.size());
        };
        parallel_prefix_sum(element_count, samples_of, elements_.sample_begin);
        const auto split_triangles = chunk_sums<std::int64_t>(
            entry_count, [&](std::int64_t i) { return entries_[i].split_triangles; });
        elements_.split_triangle_count =
            std::accumulate(split_triangles.begin(), split_triangles.end(), std::int64_t{0});
        elements_.fragment_count = parallel_count(
            entry_count, [&](std::int64_t i) { return entries_[i].split_triangles > 0; });
        elements_.fragments.resize(entries_.size());
        elements_.samples.resize(elements_.sample_begin.back());
        elements_.meets_held_side.assign(elements_.finest().cells.size(), 0);
    }

    void fill_element(std::int32_t element, Pacer& pacer) {
        const Cell cell = cell_at(elements_.finest().cells[element]);
        std::int64_t next_sample = elements_.sample_begin[element];
        for (std::int64_t i = elements_.fragment_begin[element];
             i < elements_.fragment_begin[element + 1]; ++i) {
            claim_vertices(entries_[i], element);
            if (!surface_.held_sides.empty() &&
                (entries_[i].edges & surface_.held_sides[entries_[i].triangle]) != 0)
                elements_.meets_held_side[element] = 1;
            pacer.did(kItemsPerFragment);
            if (entries_[i].split_triangles == 0) {
                elements_.fragments[i] = {};
                continue;
            }
            const auto corners = mesh_.corners(entries_[i].triangle);
            const Polygon polygon = entries_[i].corners == kAllCorners
                                        ? whole_triangle(corners)
                                        : clip_to_cell(corners, cell);
            const std::int64_t first_sample = next_sample;
            for_each_node(polygon, corners, rule_, [&](const WeightedPoint& node) {
                elements_.samples.set(next_sample++, node.point - cell.cast<double>(), node.weight);
            });
            const Eigen::Vector3f normal =
                twice_vector_area(corners[0], corners[1], corners[2]).normalized().cast<float>();
            elements_.fragments[i] = {{normal[0], normal[1], normal[2]},
                                      static_cast<std::int32_t>(next_sample - first_sample)};
        }
    }

    void claim_vertices(const FragmentEntry& entry, std::int32_t element) {
        for (int i = 0; i < 3; ++i) {
            if ((entry.corners >> static_cast<unsigned>(i) & 1U) != 0)
                claim(claims_[surface_.stars.triangles[entry.triangle][i]], element);
        }
    }

    void locate_vertices() {
        const auto count = static_cast<std::int64_t>(surface_.vertices.size());
        elements_.vertices.resize(surface_.vertices.size());
        elements_.vertex_held.resize(surface_.vertices.size());
        parallel_for_rows(count, [&](std::int32_t of_mesh) {
            // Coincident vertices have one location, so that soups stay together.
            const std::int32_t vertex = surface_.vertices[of_mesh];
            const std::int32_t element =
                vertex < 0 ? kUnclaimed : claims_[vertex].load(std::memory_order_relaxed);
            if (element == kUnclaimed) return;
            elements_.vertex_held[of_mesh] = surface_.held[vertex];
            const Cell cell = cell_at(elements_.finest().cells[element]);
            const Eigen::Vector3d position = elements_.grid.to_grid(
                surface_.edge * surface_.positions[vertex] + surface_.box.center());
            elements_.vertices[of_mesh] = {element, position - cell.cast<double>()};
        });
    }

    TrackedElements& elements_;
    const Surface& surface_;
    const GridMesh& mesh_;
    const RawVector<FragmentEntry>& entries_;
    const std::vector<CubatureNode>& rule_;
    Claims claims_;
};

/// Makes the fragments of each cell an element, as in the paper, and builds the levels.
void build_octree(TrackedElements& elements, const RawVector<FragmentEntry>& fragments) {
    const auto count = static_cast<std::int64_t>(fragments.size());
    const auto cell = [](const FragmentEntry& fragment) -> MortonCode { return fragment.cell; };
    elements.fragment_begin = parallel_collect_if<std::int64_t>(count, runs_by(fragments, cell),
                                                                [](std::int64_t i) { return i; });
    std::vector<MortonCode> cells(elements.fragment_begin.size());
    parallel_for_rows(static_cast<std::int64_t>(cells.size()), [&](std::int32_t element) {
        cells[element] = fragments[elements.fragment_begin[element]].cell;
    });
    elements.fragment_begin.push_back(count);
    elements.levels = build_levels(std::move(cells), elements.grid.depth);
}

}  // namespace

TrackedElements build_tracked_elements(const Surface& surface, ClippedSurface clipped,
                                       Cubature cubature) {
    if (clipped.degenerate_count == static_cast<std::int64_t>(surface.stars.triangles.size())) {
        throw InvalidMesh(
            "All faces to be smoothed are degenerate: none has an area, or none that shows beside "
            "the size of the mesh.");
    }
    TrackedElements elements;
    elements.grid = clipped.grid;
    // There are many fragments: they are gone when the elements are built.
    const RawVector<FragmentEntry> fragments = std::move(clipped.fragments);
    enter_setup_phase(kBuildOctree);
    build_octree(elements, fragments);
    enter_setup_phase(kSampleSurface);
    ElementBuilder(elements, surface, clipped.mesh, fragments, cubature).build();
    return elements;
}

Eigen::Vector3d evaluate_vertex(const TrackedElements& elements, const Coefficients& coefficients,
                                const VertexLocation& vertex) {
    const CornerValues values = bspline_values(vertex.local);
    const auto& unknowns = elements.finest().unknowns[vertex.element];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
        sum += values[corner] * coefficients.row(unknowns[corner]).transpose();
    }
    return sum;
}

void add_at_vertices(const TrackedElements& elements, const Coefficients& coefficients,
                     std::vector<Eigen::Vector3d>& vectors) {
    parallel_for_rows(static_cast<std::int64_t>(vectors.size()), [&](std::int32_t vertex) {
        const VertexLocation& location = elements.vertices[vertex];
        if (location.element == VertexLocation::kNoElement) return;
        if (elements.vertex_held[vertex] != 0) return;
        const Eigen::Vector3d added =
            elements.grid.cell_size * evaluate_vertex(elements, coefficients, location);
        if (!added.isZero(0)) vectors[vertex] += added;
    });
}

}  // namespace tracked_mcf
