// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/vertex_octree.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/mesh_system.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// A surface, the octree of its vertices, and its system.
struct OctreeOfMesh {
    OctreeOfMesh(const TriangleMesh& mesh, int depth,
                 BoundaryCondition boundary = BoundaryCondition::Free, double step = 1)
        : surface(surface_of(mesh, {}, boundary)),
          elements(elements_of(surface)),
          system(surface.stars, surface.held, surface.parts),
          grid(grid_around(surface.positions, depth)),
          octree(surface.stars, surface.positions, grid) {
        system.take(elements, step);
    }
    OctreeOfMesh(const OctreeOfMesh&) = delete;
    OctreeOfMesh& operator=(const OctreeOfMesh&) = delete;

    /// Returns the coefficients function(corner) of all unknowns.
    template <class Function>
    Field coefficients(const Function& function) const {
        const Level& level = octree.finest();
        Field result = Field::Zero(4, level.unknown_count());
        for (std::int32_t i = 0; i < level.element_count(); ++i) {
            for (int corner = 0; corner < 8; ++corner) {
                const Eigen::Vector3d at =
                    corner_of(cell_at(level.cells[i]), corner).cast<double>();
                const Eigen::Vector3d value = function(at);
                result.col(level.unknowns[i][corner]) << value.cast<float>(), 0;
            }
        }
        return result;
    }
    Field prolongated(const Field& coarse) const {
        Field x = Field::Zero(4, surface.stars.count());
        add_prolongated(coarse, x, x);
        return x;
    }
    /// Adds P coarse to x. Returns r · P coarse.
    double add_prolongated(const Field& coarse, const Field& r, Field& x) const {
        double product = 0;
        for (std::int32_t i = 0; i < system.blocks().count(); ++i)
            product += octree.add_prolongated(system, system.blocks()[i], coarse, r, x);
        return product;
    }
    Field random_coefficients() const {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> uniform(-1, 1);
        return coefficients([&](const Eigen::Vector3d& /*at*/) {
            return Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
        });
    }
    /// Returns x · A x.
    double energy(const Field& x) const {
        return x.cast<double>().cwiseProduct(product_of(system, x).cast<double>()).sum();
    }
    /// Returns c · (sum of the elements' matrices) c.
    double assembled_energy(const Field& c) {
        MatrixBlocks matrices;
        octree.assemble(system, elements, matrices);
        const Dense rows = as_dense(c).leftCols<3>();
        return rows.cwiseProduct(assembled(octree.finest(), matrices) * rows).sum();
    }

    Surface surface;
    TriangleElements elements;
    MeshSystem system;
    Grid grid;
    VertexOctree octree;
};

TEST(VertexOctree, FunctionsReproduceThePositionsOfTheVertices) {
    OctreeOfMesh of(shapes::bumpy_sphere(20), 4);
    const Field x = of.prolongated(of.coefficients([](const Eigen::Vector3d& at) { return at; }));
    for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
        const Eigen::Vector3d expected = of.grid.to_grid(of.surface.positions[i]);
        EXPECT_LT((x.col(i).head<3>().cast<double>() - expected).norm(), 4e-6) << "of 16 cells";
    }
}

TEST(VertexOctree, ValuesSumToOne) {
    OctreeOfMesh of(shapes::bumpy_sphere(20), 4);
    const Field x = of.prolongated(Field::Constant(4, of.octree.finest().unknown_count(), 1));
    EXPECT_LT((x.array() - 1).abs().maxCoeff(), 5e-7F);
}

TEST(VertexOctree, AddsToWhatIsThereButNotAtVerticesThatStay) {
    OctreeOfMesh of(bumpy_cap(20), 4, BoundaryCondition::Locked);
    ASSERT_GT(std::count(of.surface.held.begin(), of.surface.held.end(), 1), 10);
    const Field before = Field::Random(4, of.surface.stars.count());
    Field x = before;
    of.add_prolongated(Field::Constant(4, of.octree.finest().unknown_count(), 1), before, x);
    for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
        const float added = of.surface.held[i] != 0 ? 0 : 1;
        const Eigen::Vector4f expected = before.col(i).array() + added;
        EXPECT_LT((x.col(i) - expected).norm(), added * 1e-6F + 1e-30F);
    }
}

TEST(VertexOctree, RestrictsByTheTransposeOfTheProlongation) {
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Locked}) {
        OctreeOfMesh of(bumpy_cap(20), 4, boundary);
        const Field r = random_at_vertices(of.surface, 1), c = of.random_coefficients();
        Field restricted;
        of.octree.restrict(r, restricted);
        ASSERT_EQ(restricted.cols(), of.octree.finest().unknown_count());
        const Field prolongated = of.prolongated(c);
        const Eigen::Vector4d fine = dot(r, prolongated), coarse = dot(restricted, c);
        const double rounding = 1e-6 * norm(r) * norm(prolongated);
        EXPECT_LT((fine - coarse).norm(), rounding);
        Field x = r;
        EXPECT_NEAR(of.add_prolongated(c, r, x), fine.sum(), rounding);
    }
}

TEST(VertexOctree, LeavesPartsOut) {
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    const Eigen::Affine3d beside(Eigen::Translation3d(1e5, 0, 0));
    const OctreeOfMesh one(sphere, 4);
    const Surface both =
        surface_of(shapes::merged(sphere, shapes::transformed(shapes::bumpy_sphere(4), beside)));
    std::vector<std::uint8_t> has_functions(both.positions.size());
    std::vector<Eigen::Vector3d> inside;
    for (std::size_t i = 0; i < has_functions.size(); ++i) {
        if (both.parts[i] != both.parts[both.vertices[0]]) continue;
        has_functions[i] = 1;
        inside.push_back(both.positions[i]);
    }
    const VertexOctree octree(both.stars, both.positions, grid_around(inside, 4), has_functions);
    EXPECT_EQ(octree.finest().cells, one.octree.finest().cells);
    EXPECT_EQ(octree.finest().unknown_count(), one.octree.finest().unknown_count());
    for (std::int32_t i = 0; i < both.stars.count(); ++i)
        EXPECT_EQ(octree.has_functions(i), has_functions[i] != 0);
}

TEST(VertexOctree, CloseSheetsHaveFunctionsOfTheirOwn) {
    const TriangleMesh sheet = shapes::square(16);
    // A tenth of an edge apart, so in the same cells.
    OctreeOfMesh one(sheet, 2), two(shapes::stack(sheet, 2, 0.1 / 16), 2);
    EXPECT_EQ(two.octree.finest().element_count(), 2 * one.octree.finest().element_count());
    EXPECT_EQ(two.octree.finest().unknown_count(), 2 * one.octree.finest().unknown_count());
    EXPECT_EQ(count_cells(two.octree.finest()), count_cells(one.octree.finest()));
    EXPECT_EQ(two.octree.levels().front().element_count(), 2);

    Field on_one = Field::Zero(4, two.surface.stars.count());
    for (std::int32_t i = 0; i < on_one.cols(); ++i) {
        if (two.surface.parts[i] == 0) on_one.col(i).setOnes();
    }
    Field coarse;
    two.octree.restrict(on_one, coarse);
    const Field there_and_back = two.prolongated(coarse);
    for (std::int32_t i = 0; i < on_one.cols(); ++i) {
        EXPECT_EQ(there_and_back(0, i) != 0, two.surface.parts[i] == 0);
    }
}

TEST(VertexOctree, MatricesOfElementsArePositive) {
    // A boundary that stays, noise, and triangles with obtuse corners.
    OctreeOfMesh of(noisy(bumpy_cap(20), 0.03), 4, BoundaryCondition::Locked, 10);
    MatrixBlocks matrices;
    of.octree.assemble(of.system, of.elements, matrices);
    ASSERT_EQ(matrices.size(), of.octree.finest().element_count());
    for (std::size_t element = 0; element < matrices.size(); ++element) {
        Dense matrix(8, 8);
        for (int row = 0; row < 8; ++row) {
            for (int column = 0; column < 8; ++column) {
                matrix(row, column) = matrices[element](row, column);
            }
        }
        const Eigen::SelfAdjointEigenSolver<Dense> solver(matrix, Eigen::EigenvaluesOnly);
        const double largest = solver.eigenvalues().maxCoeff();
        EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-6 * largest) << element;
    }
}

// The functions of an element, continued from its cell, have the affine map's values at vertices
// outside. So each triangle's energy is that on the mesh, and its shares add up to 1. The
// regularisation adds 1e-5 of the diagonal, which is up to 40 times the energy here.
void expect_energy_of_affine_maps(const TriangleMesh& mesh, BoundaryCondition boundary,
                                  double step) {
    OctreeOfMesh of(mesh, 4, boundary, step);
    const Field c = of.coefficients([&](const Eigen::Vector3d& at) {
        const Eigen::Vector3d centred = at.array() - of.grid.cells_per_side() / 2.0;
        return Eigen::Vector3d(centred[0] + 0.3 * centred[1], centred[1], -2 * centred[2]);
    });
    const Field x = of.prolongated(c);
    std::vector<Eigen::Vector3d> positions;
    // The octree lumps all of the mass, the system half of it.
    double energy = 0;
    for (std::int32_t i = 0; i < x.cols(); ++i) {
        positions.emplace_back(x.col(i).head<3>().cast<double>());
        energy += double{of.system.mass(i)} * positions.back().squaredNorm();
    }
    Field stiff;
    of.system.multiply_stiffness(positions, 1, stiff);
    energy += dot(x, stiff).sum();
    EXPECT_NEAR(of.assembled_energy(c) / energy, 1, 6e-4) << step;
}

TEST(VertexOctree, EnergyOfAffineMapsIsThatOnTheMesh) {
    for (const double step : {1e-3, 1.0, 1e3}) {
        expect_energy_of_affine_maps(shapes::bumpy_sphere(20), BoundaryCondition::Free, step);
        expect_energy_of_affine_maps(bumpy_cap(20), BoundaryCondition::Free, step);
        expect_energy_of_affine_maps(bumpy_cap(20), BoundaryCondition::Locked, step);
    }
}

TEST(VertexOctree, EnergyOfSmoothFunctionsIsNearlyThatOnTheMesh) {
    for (const double step : {1e-3, 1.0, 1e3}) {
        OctreeOfMesh of(shapes::geodesic_sphere(40), 4, BoundaryCondition::Free, step);
        const Field c = of.coefficients([](const Eigen::Vector3d& at) {
            const Eigen::Vector3d phase = at * (2 * std::acos(-1.0) / 8);  // waves of 8 cells
            return Eigen::Vector3d(std::sin(phase[0]), std::cos(phase[1]),
                                   std::sin(phase[0] + phase[2]));
        });
        EXPECT_NEAR(of.assembled_energy(c) / of.energy(of.prolongated(c)), 1, 0.03) << step;
    }
}

}  // namespace
}  // namespace tracked_mcf
