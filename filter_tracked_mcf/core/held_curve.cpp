#include "filter_tracked_mcf/core/held_curve.h"

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Adds weight * B_I B_J at a point to an element's matrix, and force * B_I to its right side.
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

HeldCurve::HeldCurve(const TrackedElements& elements, double spring)
    : elements_(elements), spring_(spring) {
    const std::vector<HeldSample>& samples = elements.held_samples;
    Pacer pacer;
    for (std::size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
        while (end < samples.size() && samples[end].element == samples[begin].element) ++end;
        supports_.push_back({samples[begin].element, begin, end, Eigen::Vector3d::Zero()});
        pacer.did(static_cast<std::int64_t>(end - begin));
    }
}

void HeldCurve::add(const Coefficients& displacement, double step_size,
                    ElementSystems& systems) const {
    parallel_for_blocks(
        static_cast<std::int64_t>(supports_.size()), [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) {
                const Support& support = supports_[i];
                for (std::size_t k = support.begin; k < support.end; ++k) {
                    const HeldSample& sample = elements_.held_samples[k];
                    const Eigen::Vector3d pull = sample.conormal.cast<double>() + support.taken_up -
                                                 spring_ * displacement_at(sample, displacement);
                    add_at(bspline_values(sample.local.cast<double>()),
                           sample.weight * step_size * spring_, sample.weight * step_size * pull,
                           support.element, systems);
                }
            }
        });
}

void HeldCurve::take_up(const Coefficients& displacement) {
    parallel_for_rows(static_cast<std::int64_t>(supports_.size()), [&](std::int32_t i) {
        Support& support = supports_[i];
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double length = 0;
        for (std::size_t k = support.begin; k < support.end; ++k) {
            const HeldSample& sample = elements_.held_samples[k];
            sum += sample.weight * displacement_at(sample, displacement);
            length += sample.weight;
        }
        support.taken_up -= spring_ * sum / length;
    });
}

Eigen::Vector3d HeldCurve::displacement_at(const HeldSample& sample,
                                           const Coefficients& displacement) const {
    return evaluate_vertex(elements_, displacement, {sample.element, sample.local.cast<double>()});
}

}  // namespace tracked_mcf
