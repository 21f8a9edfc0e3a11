// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/curve_constraint.h"

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The penalty η.
constexpr double kPenalty = 10;

Eigen::Vector3d displacement_at(const CurveSample& sample, const TrackedElements& elements,
                                const Coefficients& displacement) {
    return evaluate_vertex(elements, displacement, {sample.element, sample.local.cast<double>()});
}

/// Adds weight * B_I B_J at a point to an element's matrix, and force * B_I to its right-hand side.
void add_at(const CornerValues& values, double weight, const Eigen::Vector3d& force,
            std::int32_t element, ElementSystems& systems) {
    for (int row = 0; row < 8; ++row) {
        for (int column = row; column < 8; ++column) {
            systems.matrices.at(element, row, column) +=
                static_cast<float>(weight * values[row] * values[column]);
        }
        for (int axis = 0; axis < 3; ++axis) {
            systems.right_sides[element].entry[axis][row] +=
                static_cast<float>(force[axis] * values[row]);
        }
    }
}

}  // namespace

CurveConstraint::CurveConstraint(const TrackedElements& elements) : elements_(elements) {
    const std::vector<CurveSample>& samples = elements.curve_samples;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
        while (end < samples.size() && samples[end].element == samples[begin].element) ++end;
        runs_.push_back({samples[begin].element, begin, end});
    }
}

void CurveConstraint::add(const Coefficients& displacement,
                          const std::vector<Eigen::Vector3d>& multipliers,
                          double step_size_in_cells, ElementSystems& systems) const {
    parallel_for_rows(static_cast<std::int64_t>(runs_.size()), [&](std::int32_t i) {
        const Run& run = runs_[i];
        for (std::size_t k = run.begin; k < run.end; ++k) {
            const CurveSample& sample = elements_.curve_samples[k];
            const Eigen::Vector3d force =
                sample.conormal.cast<double>() + multipliers[i] -
                kPenalty * displacement_at(sample, elements_, displacement);
            add_at(bspline_values(sample.local.cast<double>()),
                   sample.weight * step_size_in_cells * kPenalty,
                   sample.weight * step_size_in_cells * force, run.element, systems);
        }
    });
}

std::vector<Eigen::Vector3d> CurveConstraint::updated(std::vector<Eigen::Vector3d> multipliers,
                                                      const Coefficients& displacement) const {
    parallel_for_rows(static_cast<std::int64_t>(runs_.size()), [&](std::int32_t i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double length = 0;
        for (std::size_t k = runs_[i].begin; k < runs_[i].end; ++k) {
            const CurveSample& sample = elements_.curve_samples[k];
            sum += sample.weight * displacement_at(sample, elements_, displacement);
            length += sample.weight;
        }
        multipliers[i] -= kPenalty * sum / length;
    });
    return multipliers;
}

}  // namespace tracked_mcf
