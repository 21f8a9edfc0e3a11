// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/incomplete_cholesky_flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf::benchmark {

namespace {

double sum(const Doubles& values) {
    return values.value[0] + values.value[1] + values.value[2];
}

/// Returns 0 for a divisor of 0, that is, for a coordinate that is solved.
Floats quotient(const Doubles& numerator, const Doubles& denominator) {
    Floats result;
    for (int i = 0; i < 3; ++i) {
        const double d = denominator.value[i];
        result.value[i] = d > 0 ? static_cast<float>(numerator.value[i] / d) : 0.0F;
    }
    return result;
}

void add(Doubles& sums, const Doubles& more) {
    for (int i = 0; i < 4; ++i) sums.value[i] += more.value[i];
}

template <class Value>
std::int64_t bytes_of(const std::vector<Value>& values) {
    return static_cast<std::int64_t>(values.capacity() * sizeof(Value));
}

std::int64_t bytes_of(const CotangentPattern& pattern) {
    return bytes_of(pattern.number) + bytes_of(pattern.upper_begin) +
           bytes_of(pattern.upper_column) + bytes_of(pattern.lower_begin) +
           bytes_of(pattern.lower_column) + bytes_of(pattern.lower_index) +
           bytes_of(pattern.triangles) + bytes_of(pattern.fill_begin) + bytes_of(pattern.fill);
}

}  // namespace

IncompleteCholeskyFlow::IncompleteCholeskyFlow(const TriangleMesh& mesh,
                                               const IncompleteCholeskyParameters& parameters)
    : parameters_(parameters),
      kernels_(cotangent_kernels()),
      pattern_(cotangent_pattern(mesh, parameters.order, parameters.threads,
                                 parameters.boundary != BoundaryCondition::Free)),
      scale_(static_cast<double>(mesh.positions.size()) / surface_area(mesh)),
      positions_(mesh.positions.size()),
      right_side_(mesh.positions.size()),
      upper_(pattern_.entry_count()),
      lower_(pattern_.lower_column.size()),
      row_sums_(mesh.positions.size()),
      diagonal_(pattern_.unknown_count),
      inverse_diagonal_(pattern_.unknown_count),
      x_(pattern_.unknown_count),
      r_(pattern_.unknown_count),
      z_(pattern_.unknown_count),
      p_(pattern_.unknown_count),
      q_(pattern_.unknown_count) {
    for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        for (int i = 0; i < 3; ++i) {
            positions_[pattern_.number[vertex]].value[i] = mesh.positions[vertex][i];
        }
    }
    for (std::size_t k = 0; k < pattern_.upper_column.size(); ++k) {
        upper_[k].column = pattern_.upper_column[k];
    }
    for (std::size_t k = 0; k < lower_.size(); ++k) lower_[k].column = pattern_.lower_column[k];
}

IncompleteCholeskyReport IncompleteCholeskyFlow::step() {
    IncompleteCholeskyReport report;
    const Stopwatch assembling;
    assemble();
    report.assemble_seconds = assembling.seconds();
    const Stopwatch factorizing;
    factorize();
    report.factorize_seconds = factorizing.seconds();
    const Stopwatch solving;
    Doubles residual;
    start();
    report.iterations = iterate(residual, parameters_.tolerance * right_side_norm_);
    report.relative_residual = std::sqrt(sum(residual)) / std::max(right_side_norm_, 1e-300);
    move_vertices();
    report.solve_seconds = solving.seconds();
    return report;
}

std::vector<Eigen::Vector3d> IncompleteCholeskyFlow::positions() const {
    std::vector<Eigen::Vector3d> positions;
    positions.reserve(positions_.size());
    for (const std::int32_t number : pattern_.number) {
        const double* const p = positions_[number].value;
        positions.emplace_back(p[0], p[1], p[2]);
    }
    return positions;
}

std::int64_t IncompleteCholeskyFlow::bytes() const {
    return bytes_of(pattern_) + bytes_of(positions_) + bytes_of(right_side_) + bytes_of(upper_) +
           bytes_of(lower_) + bytes_of(row_sums_) + bytes_of(diagonal_) +
           bytes_of(inverse_diagonal_) + bytes_of(x_) + bytes_of(r_) + bytes_of(z_) + bytes_of(p_) +
           bytes_of(q_);
}

/// Calls body(block, index) for each block.
template <class Body>
void IncompleteCholeskyFlow::for_each_block(const Body& body) {
    parallel_for(static_cast<std::int64_t>(pattern_.block_begin.size()) - 1, [&](std::int64_t i) {
        body(block(static_cast<std::size_t>(i)), static_cast<int>(i));
    });
}

Block IncompleteCholeskyFlow::block(std::size_t index) {
    return {pattern_.block_begin[index],
            pattern_.block_begin[index + 1],
            pattern_.upper_begin.data(),
            pattern_.lower_begin.data(),
            pattern_.lower_index.data(),
            pattern_.fill_begin.data(),
            pattern_.fill.data(),
            upper_.data(),
            lower_.data(),
            row_sums_.data(),
            diagonal_.data(),
            inverse_diagonal_.data(),
            x_.data(),
            r_.data(),
            z_.data(),
            p_.data(),
            q_.data()};
}

void IncompleteCholeskyFlow::assemble() {
    const auto add_triangles = [&](std::size_t part) {
        const std::int64_t begin = pattern_.triangle_begin[part];
        kernels_.assemble({pattern_.triangles.data() + begin,
                           pattern_.triangle_begin[part + 1] - begin, positions_.data(),
                           parameters_.step_size, scale_, upper_.data(), row_sums_.data(),
                           right_side_.data()});
    };
    for_each_block([&](const Block& block, int index) {
        for (std::int32_t i = block.begin; i < block.end; ++i) {
            row_sums_[i] = 0;
            right_side_[i] = {};
        }
        const std::int32_t end = pattern_.upper_begin[block.end];
        for (std::int32_t k = pattern_.upper_begin[block.begin]; k < end; ++k) upper_[k].matrix = 0;
        add_triangles(static_cast<std::size_t>(index));
    });
    for (std::int32_t k = pattern_.first_coupling(); k < pattern_.entry_count(); ++k) {
        upper_[k].matrix = 0;
    }
    add_triangles(pattern_.block_begin.size() - 1);
    for (std::size_t k = 0; k < pattern_.constrained_edge_rows.size(); ++k) {
        row_sums_[pattern_.constrained_edge_rows[k]] -=
            upper_[pattern_.first_constrained_edge() + static_cast<std::int32_t>(k)].matrix;
    }
}

void IncompleteCholeskyFlow::factorize() {
    for_each_block([&](const Block& block, int) {
        for (std::int32_t i = block.begin; i < block.end; ++i) diagonal_[i] = row_sums_[i];
        for (std::int32_t i = block.begin; i < block.end; ++i) {
            for (std::int32_t k = block.upper_begin[i]; k < block.upper_begin[i + 1]; ++k) {
                take_from_diagonal(upper_[k].matrix, i, upper_[k].column);
            }
        }
    });
    for (std::size_t k = 0; k < pattern_.couplings.size(); ++k) {
        const auto [row, column] = pattern_.couplings[k];
        take_from_diagonal(upper_[pattern_.first_coupling() + static_cast<std::int32_t>(k)].matrix,
                           row, column);
    }
    for_each_block([&](const Block& block, int) {
        kernels_.factorize(block, static_cast<float>(parameters_.relaxation));
    });
}

/// The factorised matrix has no positive entries.
void IncompleteCholeskyFlow::take_from_diagonal(float entry, std::int32_t row,
                                                std::int32_t column) {
    if (entry >= 0) return;
    diagonal_[row] -= entry;
    diagonal_[column] -= entry;
}

/// Converts the right-hand side to single precision and computes its norm.
void IncompleteCholeskyFlow::start() {
    std::vector<double> squares(pattern_.block_begin.size() - 1);
    for_each_block([&](const Block& block, int index) {
        double square = 0;
        for (std::int32_t i = block.begin; i < block.end; ++i) {
            for (int c = 0; c < 3; ++c) {
                const double b = right_side_[i].value[c];
                r_[i].value[c] = static_cast<float>(b);
                square += b * b;
            }
        }
        squares[static_cast<std::size_t>(index)] = square;
    });
    right_side_norm_ = 0;
    for (const double square : squares) right_side_norm_ += square;
    right_side_norm_ = std::sqrt(right_side_norm_);
}

/// Iterates conjugate gradients until the residual's norm is at most `goal`. Each iteration makes
/// two passes over the rows: forward() and backward().
int IncompleteCholeskyFlow::iterate(Doubles& relative_residual, double goal) {
    constexpr Floats none = {};
    if (parameters_.warm_start) {
        multiply();
    } else {
        std::fill(x_.begin(), x_.end(), none);
        std::fill(q_.begin(), q_.end(), none);
    }
    std::fill(p_.begin(), p_.end(), none);
    Products products = forward({{1, 1, 1, 0}});
    if (sum(products.residual) > right_side_norm_ * right_side_norm_) {
        // The last step's displacement is a worse start than 0.
        std::fill(x_.begin(), x_.end(), none);
        products = forward({{-1, -1, -1, 0}});
    }
    Floats alpha = none;
    Floats beta = none;
    int iteration = 0;
    while (sum(products.residual) > goal * goal && iteration < parameters_.most_iterations) {
        const Doubles curvature = backward(alpha, beta);
        alpha = quotient(products.energy, curvature);
        const Doubles energy_before = products.energy;
        products = forward(alpha);
        beta = quotient(products.energy, energy_before);
        ++iteration;
    }
    for_each_block([&](const Block& block, int) {
        for (std::int32_t i = block.begin; i < block.end; ++i) {
            for (int c = 0; c < 3; ++c) x_[i].value[c] += alpha.value[c] * p_[i].value[c];
        }
    });
    relative_residual = products.residual;
    return iteration;
}

IncompleteCholeskyFlow::Products IncompleteCholeskyFlow::forward(const Floats& alpha) {
    std::vector<Products> parts(pattern_.block_begin.size() - 1);
    for_each_block([&](const Block& block, int index) {
        Products products;
        kernels_.forward(block, alpha, products.residual, products.energy);
        parts[static_cast<std::size_t>(index)] = products;
    });
    Products total;
    for (const Products& part : parts) {
        add(total.residual, part.residual);
        add(total.energy, part.energy);
    }
    return total;
}

Doubles IncompleteCholeskyFlow::backward(const Floats& alpha, const Floats& beta) {
    std::vector<Doubles> parts(pattern_.block_begin.size() - 1);
    for_each_block([&](const Block& block, int index) {
        Doubles product;
        kernels_.backward(block, alpha, beta, product);
        parts[static_cast<std::size_t>(index)] = product;
    });
    Doubles total = add_couplings(p_);
    for (const Doubles& part : parts) add(total, part);
    return total;
}

void IncompleteCholeskyFlow::multiply() {
    for_each_block([&](const Block& block, int) { kernels_.multiply(block); });
    add_couplings(x_);
}

/// Adds the couplings between blocks to q = A x. Returns their part of x·q.
Doubles IncompleteCholeskyFlow::add_couplings(const std::vector<Floats>& x) {
    Doubles product;
    for (std::size_t k = 0; k < pattern_.couplings.size(); ++k) {
        const auto [row, column] = pattern_.couplings[k];
        const float entry = upper_[pattern_.first_coupling() + static_cast<std::int32_t>(k)].matrix;
        for (int c = 0; c < 3; ++c) {
            const float difference = x[column].value[c] - x[row].value[c];
            q_[row].value[c] += entry * difference;
            q_[column].value[c] -= entry * difference;
            product.value[c] -= static_cast<double>(entry * difference * difference);
        }
    }
    return product;
}

void IncompleteCholeskyFlow::move_vertices() {
    for_each_block([&](const Block& block, int) {
        for (std::int32_t i = block.begin; i < block.end; ++i) {
            for (int c = 0; c < 3; ++c) {
                positions_[i].value[c] += static_cast<double>(x_[i].value[c]);
            }
        }
    });
}

}  // namespace tracked_mcf::benchmark
