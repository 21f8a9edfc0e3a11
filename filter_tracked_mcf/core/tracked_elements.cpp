#include "filter_tracked_mcf/core/tracked_elements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/cubature.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/fan.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/held_samples.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/setup_phases.h"
#include "filter_tracked_mcf/core/sheet_links.h"
#include "filter_tracked_mcf/core/sheets.h"

namespace tracked_mcf {

namespace {

constexpr std::int32_t kUnclaimed = std::numeric_limits<std::int32_t>::max();

/// Of every vertex, the first element that has it; settled by the smallest element, so that the
/// order in which threads come does not matter.
using Claims = std::vector<std::atomic<std::int32_t>>;

void claim(std::atomic<std::int32_t>& vertex, std::int32_t element) {
    std::int32_t current = vertex.load(std::memory_order_relaxed);
    while (element < current && !vertex.compare_exchange_weak(current, element)) {
    }
}

Eigen::Vector3f unit_normal(const std::array<Eigen::Vector3d, 3>& corners) {
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized().cast<float>();
}

/// Fills in what TrackedElements holds about the fragments, element by element.
class ElementBuilder {
public:
    ElementBuilder(TrackedElements& elements, const Domain& domain, const GridMesh& mesh,
                   const RawVector<FragmentEntry>& entries, const std::vector<CubatureNode>& rule)
        : elements_(elements),
          domain_(domain),
          mesh_(mesh),
          entries_(entries),
          rule_(rule),
          claims_(mesh.positions.size()) {
        parallel_for_rows(static_cast<std::int64_t>(claims_.size()), [&](std::int32_t vertex) {
            claims_[vertex].store(kUnclaimed, std::memory_order_relaxed);
        });
    }

    void build() {
        lay_out();
        parallel_for_blocks(elements_.finest().element_count(),
                            [&](std::int64_t begin, std::int64_t end) {
                                Pacer pacer;
                                for (std::int64_t element = begin; element < end; ++element) {
                                    fill_element(static_cast<std::int32_t>(element), pacer);
                                }
                            });
        place_vertices();
    }

private:
    /// Every element's range of samples, known from the sizes of the fans alone.
    void lay_out() {
        const auto element_count = static_cast<std::int64_t>(elements_.finest().cells.size());
        const auto entry_count = static_cast<std::int64_t>(entries_.size());
        const auto split_triangles = [&](std::int64_t element) {
            std::int64_t count = 0;
            for (std::int64_t i = elements_.fragment_begin[element];
                 i < elements_.fragment_begin[element + 1]; ++i) {
                count += static_cast<std::int64_t>(entries_[i].split_triangles);
            }
            return count;
        };
        const auto samples_per_triangle = static_cast<std::int64_t>(rule_.size());
        parallel_add_up(
            element_count,
            [&](std::int64_t element) { return samples_per_triangle * split_triangles(element); },
            elements_.sample_begin);
        const std::int64_t samples = elements_.sample_begin.back();
        elements_.split_triangle_count = samples / samples_per_triangle;
        elements_.fragment_count = parallel_count(
            entry_count, [&](std::int64_t i) { return entries_[i].split_triangles > 0; });
        resize(elements_.fragments, entry_count);
        elements_.samples.resize(samples);
        elements_.held.assign(elements_.finest().cells.size(), 0);
    }

    void fill_element(std::int32_t element, Pacer& pacer) {
        const Cell cell = cell_at(elements_.finest().cells[element]);
        std::int64_t next_sample = elements_.sample_begin[element];
        for (std::int64_t i = elements_.fragment_begin[element];
             i < elements_.fragment_begin[element + 1]; ++i) {
            const std::int32_t triangle = entries_[i].triangle;
            note_vertices_and_holds(entries_[i], element);
            pacer.did(kItemsPerFragment);
            if (entries_[i].split_triangles == 0) {
                elements_.fragments[i] = {};
                continue;
            }
            const auto corners = mesh_.corners(triangle);
            const Polygon polygon = clip_to_cell(corners, cell);
            const std::int64_t first_sample = next_sample;
            for_each_node(polygon, corners, rule_, [&](const WeightedPoint& node) {
                elements_.samples.set(next_sample++, node.point - cell.cast<double>(), node.weight);
            });
            const Eigen::Vector3f normal = unit_normal(corners);
            elements_.fragments[i] = {{normal[0], normal[1], normal[2]},
                                      static_cast<std::int32_t>(next_sample - first_sample)};
        }
    }

    void note_vertices_and_holds(const FragmentEntry& entry, std::int32_t element) {
        for (int i = 0; i < 3; ++i) {
            if (((entry.corners >> i) & 1) == 0) continue;
            claim(claims_[domain_.topology().triangles[entry.triangle][i]], element);
        }
        if ((entry.edges & domain_.held_edges()[entry.triangle]) != 0) elements_.held[element] = 1;
    }

    void place_vertices() {
        const auto count = static_cast<std::int64_t>(mesh_.positions.size());
        resize(elements_.vertices, count);
        parallel_for_rows(count, [&](std::int32_t vertex) {
            // Coincident vertices take their first one's place, so that soups stay together.
            const std::int32_t first = domain_.topology().welded[vertex];
            const std::int32_t element = claims_[first].load(std::memory_order_relaxed);
            if (element == kUnclaimed) return;
            const Cell cell = cell_at(elements_.finest().cells[element]);
            const Eigen::Vector3d position =
                elements_.grid.to_grid(mesh_.original.positions[first]);
            elements_.vertices[vertex] = {element, position - cell.cast<double>()};
        });
    }

    TrackedElements& elements_;
    const Domain& domain_;
    const GridMesh& mesh_;
    const RawVector<FragmentEntry>& entries_;
    const std::vector<CubatureNode>& rule_;
    Claims claims_;
};

/// Decides which fragments make up which element, sorts them accordingly, and builds the levels.
void build_octree(TrackedElements& elements, const GridMesh& mesh, const MeshTopology& topology,
                  RawVector<FragmentEntry>& entries, bool by_sheet) {
    const int depth = elements.grid.depth;
    FinestElements finest =
        by_sheet ? separate_sheets(topology, entries) : one_element_per_cell(entries);
    if (by_sheet) {
        RawVector<Link> links = find_links(mesh, topology, entries, finest);
        elements.levels = build_levels(std::move(finest.cells), std::move(links), depth);
    } else {
        elements.levels = build_levels(std::move(finest.cells), depth);
    }
    elements.fragment_begin = std::move(finest.fragment_begin);
}

void count_vertices(TrackedElements& elements, const std::vector<std::uint8_t>& referenced) {
    const auto count = static_cast<std::int64_t>(referenced.size());
    elements.referenced_vertex_count =
        parallel_count(count, [&](std::int64_t vertex) { return referenced[vertex] != 0; });
    elements.held_vertex_count = parallel_count(count, [&](std::int64_t vertex) {
        return referenced[vertex] != 0 && elements.vertex_held[vertex] != 0;
    });
}

}  // namespace

TrackedElements build_tracked_elements(const Domain& domain, const Grid& grid, Cubature cubature,
                                       bool separate_sheets) {
    enter_setup_phase(SetupPhase::ClipTriangles);
    return build_tracked_elements(domain, clip_to_grid(domain.surface(), grid), cubature,
                                  separate_sheets);
}

TrackedElements build_tracked_elements(const Domain& domain, ClippedSurface surface,
                                       Cubature cubature, bool separate_sheets) {
    const std::size_t triangle_count = domain.surface().triangles.size();
    if (surface.degenerate_count == static_cast<std::int64_t>(triangle_count)) {
        throw InvalidMesh(
            "All faces are degenerate that are to be smoothed: none has an area, or none that "
            "shows "
            "beside the size of the mesh.");
    }
    TrackedElements elements;
    elements.grid = surface.grid;
    elements.degenerate_triangle_count = surface.degenerate_count;
    elements.vertex_held = domain.held_vertices();
    count_vertices(elements, referenced_vertices(domain.surface()));

    enter_setup_phase(SetupPhase::BuildOctree);
    build_octree(elements, surface.mesh, domain.topology(), surface.fragments, separate_sheets);
    enter_setup_phase(SetupPhase::SampleSurface);
    ElementBuilder(elements, domain, surface.mesh, surface.fragments, cubature_rule(cubature))
        .build();
    elements.held_samples =
        sample_held_edges(elements, surface.mesh, surface.fragments, domain.held_edges());
    return elements;
}

TrackedElements build_tracked_elements(const TriangleMesh& mesh, const Grid& grid,
                                       Cubature cubature, bool separate_sheets) {
    return build_tracked_elements(Domain(mesh, BoundaryCondition::Locked), grid, cubature,
                                  separate_sheets);
}

Coefficients identity_coefficients(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    Coefficients coefficients(finest.unknown_count(), 3);
    serial_for(finest.element_count(), [&](std::int64_t element) {
        const Cell cell = cell_at(finest.cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            for (int axis = 0; axis < 3; ++axis) {
                coefficients(finest.unknowns[element][corner], axis) =
                    cell[axis] + corner_bit(corner, axis);
            }
        }
    });
    return coefficients;
}

Eigen::Vector3d evaluate_vertex(const TrackedElements& elements, const Coefficients& coefficients,
                                const VertexPlace& vertex) {
    const CornerValues values = bspline_values(vertex.local);
    const auto& unknowns = elements.finest().unknowns[vertex.element];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int corner = 0; corner < 8; ++corner) {
        sum += values[corner] * coefficients.row(unknowns[corner]).transpose();
    }
    return sum;
}

}  // namespace tracked_mcf
