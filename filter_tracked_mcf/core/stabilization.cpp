#include "filter_tracked_mcf/core/stabilization.h"

#include <Eigen/Eigenvalues>
#include <array>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// What the mass matrix contributes to the weight, beside the stiffness's δ'.
constexpr double kMassShare = 0.1;

using CornerMatrix = Eigen::Matrix<float, 8, 8>;

/// ∫ f(s) g(s) ds over [0, 1] for the two linear functions f of an edge, or their derivatives, and
/// g.
struct EdgeIntegrals {
    double value_value[2][2] = {{1.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 3}};
    double slope_slope[2][2] = {{1, -1}, {-1, 1}};
    double slope_value[2][2] = {{-0.5, -0.5}, {0.5, 0.5}};
};

/// ∫_cell ∂_a B_I ∂_b B_J dV, made symmetric in a and b.
CornerMatrix gradient_product(int a, int b) {
    static const EdgeIntegrals edge;
    CornerMatrix result;
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            const auto integral = [&](int slope_of_row, int slope_of_column) {
                double product = 1;
                for (int axis = 0; axis < 3; ++axis) {
                    const int i = corner_bit(row, axis), j = corner_bit(column, axis);
                    if (axis == slope_of_row && axis == slope_of_column) {
                        product *= edge.slope_slope[i][j];
                    } else if (axis == slope_of_row) {
                        product *= edge.slope_value[i][j];
                    } else if (axis == slope_of_column) {
                        product *= edge.slope_value[j][i];
                    } else {
                        product *= edge.value_value[i][j];
                    }
                }
                return product;
            };
            result(row, column) =
                static_cast<float>(a == b ? integral(a, a) : integral(a, b) + integral(b, a));
        }
    }
    return result;
}

/// Axes of a tensor's entries, in their order.
constexpr std::array<std::array<int, 2>, 6> kEntries = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// ∫ n nᵀ over the element's surface: the same whichever way faces are oriented.
Eigen::Matrix3d normal_product(const TrackedElements& elements, std::int64_t element) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    std::int64_t sample = elements.sample_begin[element];
    for (std::int64_t i = elements.fragment_begin[element];
         i < elements.fragment_begin[element + 1]; ++i) {
        const Fragment& fragment = elements.fragments[i];
        double weight = 0;
        for (std::int32_t k = 0; k < fragment.sample_count; ++k) {
            weight += elements.samples.weight(sample++);
        }
        const Eigen::Vector3d normal(fragment.normal[0], fragment.normal[1], fragment.normal[2]);
        sum += weight * normal * normal.transpose();
    }
    return sum;
}

/// What the normals agree on: their common direction v as v vᵀ, weighted by how far it stands out.
Eigen::Matrix3d normal_tensor(const Eigen::Matrix3d& normal_product) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(normal_product);
    const Eigen::Vector3d direction = eigen.eigenvectors().col(2);
    const double gap = eigen.eigenvalues()[2] - eigen.eigenvalues()[1];
    return gap * direction * direction.transpose();
}

}  // namespace

Stabilization::Stabilization(const TrackedElements& elements) {
    resize(normal_tensors_, elements.finest().element_count());
    parallel_for_blocks(
        elements.finest().element_count(), [&](std::int64_t begin, std::int64_t end) {
            Pacer pacer;
            for (std::int64_t element = begin; element < end; ++element) {
                const Eigen::Matrix3d tensor = normal_tensor(normal_product(elements, element));
                for (std::size_t entry = 0; entry < kEntries.size(); ++entry) {
                    const auto [row, column] = kEntries[entry];
                    normal_tensors_[element][entry] = static_cast<float>(tensor(row, column));
                }
                pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
            }
        });
}

void Stabilization::add(double weight, double step_size,
                        std::vector<ElementMatrix>& matrices) const {
    if (weight == 0) return;
    const auto factor = static_cast<float>(weight * (step_size + kMassShare));
    std::array<CornerMatrix, 6> products;
    for (std::size_t entry = 0; entry < kEntries.size(); ++entry) {
        products[entry] = gradient_product(kEntries[entry][0], kEntries[entry][1]);
    }
    parallel_for_blocks(
        static_cast<std::int64_t>(matrices.size()), [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t element = begin; element < end; ++element) {
                CornerMatrix sum = CornerMatrix::Zero();
                for (std::size_t entry = 0; entry < kEntries.size(); ++entry) {
                    sum += normal_tensors_[element][entry] * products[entry];
                }
                Eigen::Map<CornerMatrix>(&matrices[element].entry[0][0]) += factor * sum;
            }
        });
}

}  // namespace tracked_mcf
