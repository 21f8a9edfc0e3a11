#include "filter_tracked_mcf/core/tracked_elements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <limits>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/cubature.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/fan.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/parallel.h"

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
    ElementBuilder(TrackedElements& elements, const GridMesh& mesh,
                   const std::vector<FragmentEntry>& entries,
                   const std::vector<std::int32_t>& welded,
                   const std::vector<std::uint8_t>& boundary, const std::vector<CubatureNode>& rule)
        : elements_(elements),
          mesh_(mesh),
          entries_(entries),
          welded_(welded),
          boundary_(boundary),
          rule_(rule),
          claims_(mesh.positions.size()) {
        for (auto& vertex : claims_) vertex.store(kUnclaimed, std::memory_order_relaxed);
    }

    void build() {
        lay_out();
        parallel_for_blocks(elements_.finest().element_count(),
                            [&](std::int64_t begin, std::int64_t end) {
                                for (std::int64_t element = begin; element < end; ++element) {
                                    fill_element(static_cast<std::int32_t>(element));
                                }
                            });
        place_vertices();
    }

private:
    /// Every element's range of fragments and samples, known from the sizes of the fans alone.
    void lay_out() {
        const auto samples_per_triangle = static_cast<std::int64_t>(rule_.size());
        std::int64_t samples = 0;
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            if (i == 0 || entries_[i].cell != entries_[i - 1].cell) {
                elements_.fragment_begin.push_back(static_cast<std::int64_t>(i));
                elements_.sample_begin.push_back(samples);
            }
            samples += entries_[i].split_triangles * samples_per_triangle;
            elements_.split_triangle_count += entries_[i].split_triangles;
            elements_.fragment_count += entries_[i].split_triangles > 0 ? 1 : 0;
        }
        elements_.fragment_begin.push_back(static_cast<std::int64_t>(entries_.size()));
        elements_.sample_begin.push_back(samples);
        elements_.fragments.resize(entries_.size());
        elements_.samples.resize(static_cast<std::size_t>(samples));
        elements_.on_boundary.assign(elements_.finest().cells.size(), 0);
    }

    void fill_element(std::int32_t element) {
        const Cell cell = cell_at(elements_.finest().cells[element]);
        Sample* next_sample = elements_.samples.data() + elements_.sample_begin[element];
        for (std::int64_t i = elements_.fragment_begin[element];
             i < elements_.fragment_begin[element + 1]; ++i) {
            const std::int32_t triangle = entries_[i].triangle;
            const auto corners = mesh_.corners(triangle);
            const Polygon polygon = clip_to_cell(corners, cell);
            note_vertices_and_boundary(polygon, triangle, element);
            if (entries_[i].split_triangles == 0) continue;
            Sample* const first_sample = next_sample;
            for_each_node(polygon, corners, rule_, [&](const WeightedPoint& node) {
                const Eigen::Vector3f local = (node.point - cell.cast<double>()).cast<float>();
                *next_sample++ = {{local[0], local[1], local[2]}, static_cast<float>(node.weight)};
            });
            const Eigen::Vector3f normal = unit_normal(corners);
            elements_.fragments[i] = {{normal[0], normal[1], normal[2]},
                                      static_cast<std::int32_t>(next_sample - first_sample)};
        }
    }

    void note_vertices_and_boundary(const Polygon& polygon, std::int32_t triangle,
                                    std::int32_t element) {
        for (int i = 0; i < polygon.size; ++i) {
            const int corner = polygon.corner[i];
            if (corner != Polygon::kNone) {
                claim(claims_[welded_[mesh_.original.triangles[triangle][corner]]], element);
            }
            const int edge = polygon.edge[i];
            if (edge != Polygon::kNone && ((boundary_[triangle] >> edge) & 1) != 0 &&
                polygon.points[i] != polygon.points[(i + 1) % polygon.size]) {
                elements_.on_boundary[element] = 1;
            }
        }
    }

    void place_vertices() {
        elements_.vertices.resize(mesh_.positions.size());
        for (std::size_t vertex = 0; vertex < mesh_.positions.size(); ++vertex) {
            // Coincident vertices take their first one's place, so that soups stay together.
            const std::int32_t first = welded_[vertex];
            const std::int32_t element = claims_[first].load(std::memory_order_relaxed);
            if (element == kUnclaimed) continue;
            const Cell cell = cell_at(elements_.finest().cells[element]);
            const Eigen::Vector3d position =
                elements_.grid.to_grid(mesh_.original.positions[first]);
            elements_.vertices[vertex] = {element, position - cell.cast<double>()};
        }
    }

    TrackedElements& elements_;
    const GridMesh& mesh_;
    const std::vector<FragmentEntry>& entries_;
    const std::vector<std::int32_t>& welded_;
    const std::vector<std::uint8_t>& boundary_;
    const std::vector<CubatureNode>& rule_;
    Claims claims_;
};

std::int64_t count_bits(const std::vector<std::uint8_t>& masks) {
    std::int64_t count = 0;
    for (const std::uint8_t mask : masks)
        count += (mask & 1) + ((mask >> 1) & 1) + ((mask >> 2) & 1);
    return count;
}

}  // namespace

TrackedElements build_tracked_elements(const TriangleMesh& mesh, const Grid& grid,
                                       Cubature cubature) {
    const GridMesh grid_mesh = to_grid(mesh, grid);
    TrackedElements elements;
    elements.grid = grid;
    elements.degenerate_triangle_count = count_degenerate(grid_mesh);
    if (elements.degenerate_triangle_count == static_cast<std::int64_t>(mesh.triangles.size())) {
        throw InvalidMesh(
            "All faces are degenerate: none has an area, so there is no surface to smooth.");
    }
    const std::vector<std::int32_t> welded = weld_coincident_vertices(mesh);
    const std::vector<std::uint8_t> boundary = boundary_edges(mesh, welded);
    const std::vector<bool> referenced = referenced_vertices(mesh);
    elements.referenced_vertex_count = std::count(referenced.begin(), referenced.end(), true);
    elements.boundary_edge_count = count_bits(boundary);

    const std::vector<FragmentEntry> entries = list_fragments(grid_mesh, grid);
    elements.levels = build_levels(occupied_cells(entries), grid.depth);
    ElementBuilder(elements, grid_mesh, entries, welded, boundary, cubature_rule(cubature)).build();
    return elements;
}

Coefficients identity_coefficients(const TrackedElements& elements) {
    const Level& finest = elements.finest();
    Coefficients coefficients(finest.unknown_count(), 3);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        const Cell cell = cell_at(finest.cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            for (int axis = 0; axis < 3; ++axis) {
                coefficients(finest.unknowns[element][corner], axis) =
                    cell[axis] + corner_bit(corner, axis);
            }
        }
    }
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
