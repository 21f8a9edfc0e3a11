// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/vertex_octree.h"

#include <algorithm>
#include <array>
#include <utility>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Added to diagonals, relative to them: much more than rounding, much less than what the longest
/// waves need. It keeps matrices positive where mass is lost beside stiffness.
constexpr float kRegularisation = 1e-5F;

/// Returns the links between elements by sides of triangles, where their cells touch.
RawVector<Link> links_of(const Stars& stars, const std::vector<std::int32_t>& element_of,
                         const std::vector<MortonCode>& cells) {
    auto links = parallel_collect<Link, RawVector<Link>>(
        stars.count(), [&](std::int64_t begin, std::int64_t end, std::vector<Link>& out) {
            for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                const std::int32_t here = element_of[vertex];
                for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
                     ++i) {
                    const std::int32_t there = element_of[stars.neighbours[i]];
                    if (there <= here) continue;
                    const Cell offset = cell_at(cells[there]) - cell_at(cells[here]);
                    if (offset.cwiseAbs().maxCoeff() <= 1) out.push_back({here, there});
                }
            }
        });
    sort_and_remove_copies(links, static_cast<std::int32_t>(cells.size()));
    return links;
}

}  // namespace

VertexOctree::VertexOctree(const Stars& stars, const std::vector<Eigen::Vector3d>& positions,
                           const Grid& grid, const std::vector<std::uint8_t>& has_functions)
    : cell_size_(grid.cell_size), local_(positions.size()) {
    std::vector<MortonCode> cells(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        if (!has_functions.empty() && has_functions[vertex] == 0) return;
        const Eigen::Vector3d place = grid.to_grid(positions[vertex]);
        const Cell cell = place.array().floor().cast<std::int32_t>();
        cells[vertex] = morton_code(cell);
        local_[vertex] = (place - cell.cast<double>()).cast<float>();
    });
    find_elements(stars, cells, grid.depth, has_functions);
    // The last group has no functions.
    vertices_ = Groups(element_of_, finest().element_count() + 1);
}

void VertexOctree::find_elements(const Stars& stars, const std::vector<MortonCode>& cells,
                                 int depth, const std::vector<std::uint8_t>& has_functions) {
    const auto is_left_out = [&](std::int32_t vertex) {
        return !has_functions.empty() && has_functions[vertex] == 0;
    };
    DisjointSets sets(stars.count());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        if (is_left_out(vertex)) return;
        for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i) {
            const std::int32_t neighbour = stars.neighbours[i];
            if (neighbour > vertex && cells[neighbour] == cells[vertex]) {
                sets.unite(vertex, neighbour);
            }
        }
    });
    // Elements are numbered in the order of their cells, then of their first vertices.
    std::vector<KeyValue> first;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (!is_left_out(vertex) && sets.find(vertex) == vertex) {
            first.push_back({cells[vertex], static_cast<std::uint64_t>(vertex)});
        }
    }
    sort_by_key(first);
    element_of_.resize(cells.size(), static_cast<std::int32_t>(first.size()));
    std::vector<MortonCode> cells_of_elements(first.size());
    for (std::size_t element = 0; element < first.size(); ++element) {
        element_of_[first[element].value] = static_cast<std::int32_t>(element);
        cells_of_elements[element] = first[element].key;
    }
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const std::int32_t representative = sets.find(vertex);
        if (representative != vertex) element_of_[vertex] = element_of_[representative];
    });
    RawVector<Link> links = links_of(stars, element_of_, cells_of_elements);
    levels_ = build_levels(std::move(cells_of_elements), std::move(links), depth);
}

VertexOctree::Values VertexOctree::values_at(std::int32_t vertex) const {
    return bspline_values(local_[vertex]);
}

VertexOctree::Values VertexOctree::values_at(std::int32_t vertex, std::int32_t element) const {
    const std::vector<MortonCode>& cells = finest().cells;
    const Cell offset = cell_at(cells[element_of_[vertex]]) - cell_at(cells[element]);
    return bspline_values<float>(local_[vertex] + offset.cast<float>());
}

void VertexOctree::assemble(const MeshSystem& system, const TriangleElements& elements,
                            MatrixBlocks& matrices) const {
    const Stars& stars = system.stars();
    matrices.resize(finest().element_count());
    const auto assemble_element = [&](std::int32_t element) {
        Eigen::Matrix<float, 8, 8> sum = Eigen::Matrix<float, 8, 8>::Zero();
        const auto add = [&](float weight, const Values& values) {
            sum += weight * values * values.transpose();
        };
        for (const std::int32_t vertex : vertices_.members(element)) {
            if (!system.is_held(vertex)) add(system.mass(vertex), values_at(vertex));
            for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
                std::array<Values, 3> values;
                int inside = 0;
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const std::int32_t other = stars.triangles[triangle][k];
                    const bool is_inside = element_of_[other] == element;
                    if (is_inside && inside == 0 && k != corner) return;  // counted there
                    inside += is_inside ? 1 : 0;
                    if (system.is_held(other)) {
                        values[k].setZero();
                    } else {
                        values[k] = is_inside ? values_at(other) : values_at(other, element);
                    }
                }
                const float share = system.step_size() * static_cast<float>(inside) / 3;
                for (int k = 0; k < 3; ++k) {
                    add(share * elements[triangle].weights[k],
                        values[(k + 1) % 3] - values[(k + 2) % 3]);
                }
            });
        }
        for (int row = 0; row < 8; ++row) {
            for (int column = row; column < 8; ++column) {
                matrices[element](row, column) =
                    (row == column ? 1 + kRegularisation : 1) * sum(row, column);
            }
        }
    };
    parallel_for_chunks(finest().element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) assemble_element(i);
    });
}

void VertexOctree::restrict(const Field& r, Field& coarse) {
    sums_.resize(4, 8 * finest().element_count());
    const auto sum_element = [&](std::int32_t element) {
        Eigen::Matrix<float, 4, 8> sum = Eigen::Matrix<float, 4, 8>::Zero();
        for (const std::int32_t vertex : vertices_.members(element))
            sum += r.col(vertex) * values_at(vertex).transpose();
        sums_.middleCols<8>(8 * std::int64_t{element}) = sum;
    };
    parallel_for_chunks(finest().element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) sum_element(i);
    });
    sum_at_unknowns(finest(), sums_, coarse);
}

double VertexOctree::add_prolongated(const MeshSystem& system, const PartBlocks::Block& block,
                                     const Field& coarse, const Field& r, Field& x) const {
    Eigen::Vector4f product = Eigen::Vector4f::Zero();
    for (std::int32_t vertex = block.begin; vertex < block.end; ++vertex) {
        if (system.is_held(vertex)) continue;
        const auto& unknowns = finest().unknowns[element_of_[vertex]];
        const Values values = values_at(vertex);
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (int corner = 0; corner < 8; ++corner) {
            sum += values[corner] * coarse.col(unknowns[corner]);
        }
        x.col(vertex) += sum;
        product += sum.cwiseProduct(r.col(vertex));
    }
    return double{product.sum()};
}

}  // namespace tracked_mcf
