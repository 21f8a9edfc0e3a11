// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/research/benchmark/subcommands.h"

#ifdef TRACKED_MCF_WITH_HYPRE

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <cstdint>
#include <numeric>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/cotangent_kernels.h"
#include "tests/research/benchmark/cotangent_pattern.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"

namespace tracked_mcf::benchmark {

namespace {

struct Options {
    std::string mesh;
    double step_size = 5e-4;
    double tolerance = 1e-6;
    int steps = 4;
};

constexpr HYPRE_Int kMostIterations = 1000;

/// hypre needs MPI, even in one process.
class HypreScope {
public:
    HypreScope() {
        MPI_Init(nullptr, nullptr);
        HYPRE_Init();
    }
    ~HypreScope() {
        HYPRE_Finalize();
        MPI_Finalize();
    }
    HypreScope(const HypreScope&) = delete;
    HypreScope& operator=(const HypreScope&) = delete;
};

void check_hypre(const char* what) {
    if (HYPRE_GetError() == 0) return;
    char text[256] = {};
    HYPRE_DescribeError(HYPRE_GetError(), text);
    throw std::runtime_error(std::string("hypre failed in ") + what + ": " + text);
}

/// One of hypre's objects.
template <class Object>
using Owned = std::unique_ptr<Object, HYPRE_Int (*)(Object*)>;

using Matrix = Owned<hypre_IJMatrix_struct>;
using Vector = Owned<hypre_IJVector_struct>;
using Solver = Owned<hypre_Solver_struct>;

/// A matrix by rows.
struct Rows {
    std::vector<HYPRE_BigInt> numbers;  ///< 0, 1, ...
    std::vector<HYPRE_Int> sizes;
    std::vector<HYPRE_BigInt> columns;
    std::vector<double> values;

    HYPRE_Int count() const { return static_cast<HYPRE_Int>(numbers.size()); }
};

Matrix new_matrix(Rows& rows) {
    HYPRE_IJMatrix created = nullptr;
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, rows.count() - 1, 0, rows.count() - 1, &created);
    Matrix matrix(created, HYPRE_IJMatrixDestroy);
    HYPRE_IJMatrixSetObjectType(created, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(created, rows.sizes.data());
    HYPRE_IJMatrixInitialize(created);
    HYPRE_IJMatrixSetValues(created, rows.count(), rows.sizes.data(), rows.numbers.data(),
                            rows.columns.data(), rows.values.data());
    HYPRE_IJMatrixAssemble(created);
    return matrix;
}

Vector new_vector(const Rows& rows, const std::vector<double>& values) {
    HYPRE_IJVector created = nullptr;
    HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, rows.count() - 1, &created);
    Vector vector(created, HYPRE_IJVectorDestroy);
    HYPRE_IJVectorSetObjectType(created, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(created);
    HYPRE_IJVectorSetValues(created, rows.count(), rows.numbers.data(), values.data());
    HYPRE_IJVectorAssemble(created);
    return vector;
}

HYPRE_ParCSRMatrix object_of(const Matrix& matrix) {
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(matrix.get(), &object);
    return static_cast<HYPRE_ParCSRMatrix>(object);
}

HYPRE_ParVector object_of(const Vector& vector) {
    void* object = nullptr;
    HYPRE_IJVectorGetObject(vector.get(), &object);
    return static_cast<HYPRE_ParVector>(object);
}

/// Returns one V-cycle. README.md explains the choices.
Solver multigrid() {
    HYPRE_Solver created = nullptr;
    HYPRE_BoomerAMGCreate(&created);
    HYPRE_BoomerAMGSetTol(created, 0);
    HYPRE_BoomerAMGSetMaxIter(created, 1);
    HYPRE_BoomerAMGSetCoarsenType(created, 8);  // parallel modified independent set
    HYPRE_BoomerAMGSetInterpType(created, 6);   // extended+i
    HYPRE_BoomerAMGSetRelaxType(created, 6);    // symmetric Gauss-Seidel, as CG needs
    return {created, HYPRE_BoomerAMGDestroy};
}

Solver conjugate_gradients(const Options& options, const Solver& preconditioner) {
    HYPRE_Solver created = nullptr;
    HYPRE_ParCSRPCGCreate(MPI_COMM_SELF, &created);
    HYPRE_PCGSetTol(created, options.tolerance);
    HYPRE_PCGSetTwoNorm(created, 1);
    HYPRE_PCGSetMaxIter(created, kMostIterations);
    HYPRE_ParCSRPCGSetPrecond(created, HYPRE_BoomerAMGSolve, HYPRE_BoomerAMGSetup,
                              preconditioner.get());
    return {created, HYPRE_ParCSRPCGDestroy};
}

/// The same flow as IncompleteCholeskyFlow's. hypre solves for the coordinates one after the other.
class MultigridFlow {
public:
    MultigridFlow(const TriangleMesh& mesh, const Options& options)
        : options_(options),
          pattern_(cotangent_pattern(mesh, VertexOrder::ReverseCuthillMcKee, 1, true)),
          scale_(static_cast<double>(mesh.positions.size()) / surface_area(mesh)),
          positions_(mesh.positions.size()),
          displacement_(3, std::vector<double>(pattern_.unknown_count)) {
        for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
            for (int c = 0; c < 3; ++c) {
                positions_[pattern_.number[vertex]].value[c] = mesh.positions[vertex][c];
            }
        }
        rows_.numbers.resize(pattern_.unknown_count);
        std::iota(rows_.numbers.begin(), rows_.numbers.end(), 0);
    }

    void step(int number) {
        const ProcessStopwatch stopwatch;
        assemble();
        const Matrix matrix = new_matrix(rows_);
        print_seconds("assemble", number, stopwatch.seconds());
        const ProcessStopwatch coarsening;
        const Solver preconditioner = multigrid();
        const Solver solver = conjugate_gradients(options_, preconditioner);
        const Vector unused = new_vector(rows_, displacement_[0]);
        HYPRE_ParCSRPCGSetup(solver.get(), object_of(matrix), object_of(unused), object_of(unused));
        check_hypre("the set-up of its multigrid");
        print_seconds("coarsen", number, coarsening.seconds());
        const ProcessStopwatch solving;
        HYPRE_Int iterations = 0;
        for (int c = 0; c < 3; ++c) iterations += solve(solver, matrix, c);
        print_seconds("solve", number, solving.seconds());
        print_seconds("step", number, stopwatch.seconds());
        print_quantity("iterations", number, iterations / 3.0);
    }

    const CotangentPattern& pattern() const { return pattern_; }

    std::vector<Eigen::Vector3d> positions() const {
        std::vector<Eigen::Vector3d> positions;
        positions.reserve(positions_.size());
        for (const std::int32_t number : pattern_.number) {
            positions.emplace_back(positions_[number].value);
        }
        return positions;
    }

private:
    /// Computes the right-hand side and the matrix of the unknowns.
    void assemble() {
        std::vector<UpperEntry> entries(pattern_.entry_count());
        std::vector<float> row_sums(positions_.size());
        right_side_.assign(positions_.size(), {});
        cotangent_kernels().assemble({pattern_.triangles.data(),
                                      static_cast<std::int64_t>(pattern_.triangles.size()),
                                      positions_.data(), options_.step_size, scale_, entries.data(),
                                      row_sums.data(), right_side_.data()});
        for (std::size_t k = 0; k < pattern_.constrained_edge_rows.size(); ++k) {
            row_sums[pattern_.constrained_edge_rows[k]] -=
                entries[pattern_.first_constrained_edge() + static_cast<std::int32_t>(k)].matrix;
        }
        fill_rows(entries, row_sums);
    }

    /// The diagonal entry is the row's sum without its other entries.
    void fill_rows(const std::vector<UpperEntry>& entries, const std::vector<float>& row_sums) {
        std::vector<double> diagonal(row_sums.begin(), row_sums.end());
        std::vector<double> lower(pattern_.lower_column.size());
        for (std::int32_t row = 0; row < pattern_.unknown_count; ++row) {
            for (std::int32_t k = pattern_.upper_begin[row]; k < pattern_.upper_begin[row + 1];
                 ++k) {
                const double entry = entries[k].matrix;
                diagonal[row] -= entry;
                diagonal[pattern_.upper_column[k]] -= entry;
                lower[pattern_.lower_index[k]] = entry;
            }
        }
        rows_.sizes.clear();
        rows_.columns.clear();
        rows_.values.clear();
        const auto add = [&](std::int32_t column, double value) {
            rows_.columns.push_back(column);
            rows_.values.push_back(value);
        };
        for (std::int32_t row = 0; row < pattern_.unknown_count; ++row) {
            const std::size_t begin = rows_.columns.size();
            add(row, diagonal[row] > 0 ? diagonal[row] : 1);  // 0 without area
            for (std::int32_t k = pattern_.lower_begin[row]; k < pattern_.lower_begin[row + 1]; ++k)
                add(pattern_.lower_column[k], lower[k]);
            for (std::int32_t k = pattern_.upper_begin[row]; k < pattern_.upper_begin[row + 1]; ++k)
                add(pattern_.upper_column[k], entries[k].matrix);
            rows_.sizes.push_back(static_cast<HYPRE_Int>(rows_.columns.size() - begin));
        }
    }

    /// Starts from the last step's displacement. Returns the number of iterations.
    HYPRE_Int solve(const Solver& solver, const Matrix& matrix, int coordinate) {
        std::vector<double> right_side(pattern_.unknown_count);
        for (std::size_t i = 0; i < right_side.size(); ++i) {
            right_side[i] = right_side_[i].value[coordinate];
        }
        std::vector<double>& displacement = displacement_[coordinate];
        const Vector b = new_vector(rows_, right_side);
        const Vector x = new_vector(rows_, displacement);
        HYPRE_ParCSRPCGSolve(solver.get(), object_of(matrix), object_of(b), object_of(x));
        check_hypre("conjugate gradients");
        HYPRE_IJVectorGetValues(x.get(), rows_.count(), rows_.numbers.data(), displacement.data());
        for (std::size_t i = 0; i < displacement.size(); ++i) {
            positions_[i].value[coordinate] += displacement[i];
        }
        HYPRE_Int iterations = 0;
        HYPRE_PCGGetNumIterations(solver.get(), &iterations);
        return iterations;
    }

    Options options_;
    CotangentPattern pattern_;
    double scale_;  ///< factor of the system that makes its numbers close to 1
    std::vector<Doubles> positions_, right_side_;
    std::vector<std::vector<double>> displacement_;  ///< for each coordinate
    Rows rows_;
};

void run(const Options& options) {
    const TriangleMesh mesh = named_mesh(options.mesh);
    const HypreScope hypre;
    print_header();
    print_quantity("mesh_memory_bytes", 0, peak_memory_bytes());
    const ProcessStopwatch stopwatch;
    MultigridFlow flow(mesh, options);
    print_seconds("setup", 0, stopwatch.seconds());
    print_quantity("vertices", 0, flow.pattern().vertex_count);
    print_quantity("unknowns", 0, flow.pattern().unknown_count);
    for (int number = 1; number <= options.steps; ++number) flow.step(number);
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, flow.positions(), options.step_size, options.steps);
}

}  // namespace

void add_multigrid(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "multigrid",
        "Measures the cotangent flow by conjugate gradients with hypre's algebraic multigrid.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--step-size", options->step_size);
    command->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
    command->add_option("--tolerance", options->tolerance);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark

#else

namespace tracked_mcf::benchmark {

void add_multigrid(CLI::App& /*app*/) {}

}  // namespace tracked_mcf::benchmark

#endif
