// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/local_choice.h"

#include <algorithm>
#include <cmath>

namespace tracked_mcf {

namespace {

// Constants were chosen on fandisk, cube, hand_8k, nefertiti_50k and armadillo_50k.

/// A window is the solution of a smoothing step of this size: it averages over about so many
/// vertices. The accuracy is that of a mean.
constexpr double kWindowOfChoice = 40, kVerticesOfWindow = 580, kReductionOfMeans = 2e-2,
                 kReductionOfSquares = 8e-2;
/// Weights change over so much less.
constexpr double kTransition = 5, kReductionOfWeights = 8e-2;
/// Four fields are averaged at a time.
constexpr std::size_t kFields = 4;

/// Noise is uneven if the logarithm of its deviation within windows varies by more than this: at
/// most 0.21 on meshes with the same noise everywhere, at least 0.37 where it varies threefold.
constexpr double kUneven = 0.28;

/// The perturbation of heights relative to the noise.
constexpr double kLocalPerturbation = 0.05;

/// Averages four fields over windows of a surface.
class Windows {
public:
    explicit Windows(const NoisySurface& surface) : elements_(surface) {}

    void average(double size, double reduction, Vectors& fields) {
        const Vectors before = fields;
        elements_.smooth_evenly(size, before, reduction, fields);
    }

private:
    LinearElements elements_;
};

/// Returns how far a vertex has moved along a normal.
double height_of(const NoisySurface& surface, const Vectors& normals, const Positions& positions,
                 std::int32_t vertex) {
    return (positions[vertex] - surface.positions[vertex])
        .dot(normals[vertex].head<3>().cast<double>());
}

/// Returns the risks of candidates, in units of the noise's square. A response is that in the
/// metric of the plain surface. What vertices keep because the metric follows the noise has the
/// mean that the sample has shown.
std::vector<Risks> risks_of(const NoisySurface& surface, const Perturbation& perturbation,
                            const Results& results) {
    const std::int32_t count = surface.stars.count();
    std::vector<Risks> risks(results.positions.size());
    for (std::size_t i = 0; i < risks.size(); ++i) {
        risks[i].resize(surface.positions.size());
        parallel_for_rows(count, [&](std::int32_t vertex) {
            const double moved =
                height_of(surface, perturbation.normals, results.positions[i], vertex) /
                double{perturbation.heights[vertex]};
            const double divergence =
                double{results.responses[i][vertex] / perturbation.heights[vertex]} +
                results.made[i].divergence_of_metric;
            risks[i][vertex] = static_cast<float>(moved * moved + 2 * divergence);
        });
    }
    return risks;
}

/// Returns per vertex the index of the candidate with the least upper bound of its risk.
std::vector<std::uint8_t> best_of(const NoisySurface& surface, const std::vector<Risks>& risks,
                                  Windows& windows) {
    const std::size_t count = surface.positions.size();
    std::vector<std::uint8_t> best(count, 0);
    Risks least(count, 0);
    for (std::size_t first = 1; first < risks.size(); first += 2) {
        const std::size_t end = std::min(first + 2, risks.size());
        Vectors fields(count, Eigen::Vector4f::Zero());  // differences and their squares
        parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
            for (std::size_t i = first; i < end; ++i) {
                const float difference = risks[i][vertex] - risks[0][vertex];
                const auto field = static_cast<Eigen::Index>(2 * (i - first));
                fields[vertex][field] = difference;
                fields[vertex][field + 1] = difference * difference;
            }
        });
        windows.average(kWindowOfChoice, kReductionOfMeans, fields);
        parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
            for (std::size_t i = first; i < end; ++i) {
                const auto field = static_cast<Eigen::Index>(2 * (i - first));
                const float square = std::max(0.0F, fields[vertex][field + 1]);
                const float bound = fields[vertex][field] +
                                    std::sqrt(square / static_cast<float>(kVerticesOfWindow));
                if (!(bound < least[vertex])) continue;
                least[vertex] = bound;
                best[vertex] = static_cast<std::uint8_t>(i);
            }
        });
    }
    return best;
}

}  // namespace

std::vector<std::size_t> best_few(const Sample& sample, const std::vector<Risks>& risks,
                                  std::size_t first, std::size_t most) {
    const std::int32_t count = sample.surface.stars.count();
    const auto counts = [&](std::int32_t vertex) { return sample.counts[vertex] != 0; };
    Windows windows(sample.surface);
    std::vector<Risks> averages(risks.size(), Risks(risks[first].size()));
    for (std::size_t begin = 0; begin < risks.size(); begin += kFields) {
        const std::size_t end = std::min(begin + kFields, risks.size());
        Vectors fields(sample.counts.size(), Eigen::Vector4f::Zero());
        parallel_for_rows(count, [&](std::int32_t vertex) {
            for (std::size_t i = begin; i < end && counts(vertex); ++i) {
                fields[vertex][static_cast<Eigen::Index>(i - begin)] =
                    risks[i][vertex] - risks[first][vertex];
            }
        });
        windows.average(kWindowOfChoice, kReductionOfMeans, fields);
        parallel_for_rows(count, [&](std::int32_t vertex) {
            for (std::size_t i = begin; i < end; ++i) {
                averages[i][vertex] = fields[vertex][static_cast<Eigen::Index>(i - begin)];
            }
        });
    }
    std::vector<std::size_t> few = {first};
    Risks least = averages[first];
    while (few.size() < most) {
        double lowest = 0;
        std::size_t best = first;
        for (std::size_t i = 0; i < risks.size(); ++i) {
            const double gain = sum_over_rows(count, [&](std::int32_t vertex) {
                const float change = std::min(averages[i][vertex] - least[vertex], 0.0F);
                return counts(vertex) ? double{change} : 0;
            });
            if (!(gain < lowest)) continue;
            lowest = gain;
            best = i;
        }
        if (best == first) break;
        few.push_back(best);
        parallel_for_rows(count, [&](std::int32_t vertex) {
            least[vertex] = std::min(least[vertex], averages[best][vertex]);
        });
    }
    return few;
}

Perturbation perturbation_of(const NoisySurface& surface, const StepSettings& settings,
                             double noise) {
    Perturbation perturbation{random_signs(surface.positions),
                              Smoothing(surface).smooth_normals(surface.positions, settings),
                              kLocalPerturbation};
    for (float& height : perturbation.heights) height *= static_cast<float>(noise);
    return perturbation;
}

bool is_uneven(const NoisySurface& surface, const Perturbation& perturbation,
               const Positions& smoothed) {
    const std::int32_t count = surface.stars.count();
    Vectors squares(smoothed.size());
    parallel_for_rows(count, [&](std::int32_t vertex) {
        const double moved = height_of(surface, perturbation.normals, smoothed, vertex);
        squares[vertex] << static_cast<float>(moved * moved), 0, 0, 0;
    });
    Windows(surface).average(kWindowOfChoice, kReductionOfSquares, squares);
    const auto logarithm = [&](std::int32_t vertex) {
        return std::log(std::max(double{squares[vertex][0]}, 1e-12)) / 2;
    };
    const double mean = sum_over_rows(count, logarithm) / count;
    const double square = sum_over_rows(count, [&](std::int32_t vertex) {
        const double difference = logarithm(vertex) - mean;
        return difference * difference;
    });
    return square > kUneven * kUneven * count;
}

Positions chosen_locally(const NoisySurface& surface, const Perturbation& perturbation,
                         const Results& results) {
    Windows windows(surface);
    const std::vector<std::uint8_t> best =
        best_of(surface, risks_of(surface, perturbation, results), windows);
    Vectors weights(best.size());  // of the candidates after the first one
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        weights[vertex].setZero();
        if (best[vertex] > 0) weights[vertex][best[vertex] - 1] = 1;
    });
    windows.average(kTransition, kReductionOfWeights, weights);
    Positions between = results.positions[0];
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        for (std::size_t i = 1; i < results.positions.size(); ++i) {
            const double weight = double{weights[vertex][static_cast<Eigen::Index>(i) - 1]};
            between[vertex] += std::clamp(weight, 0.0, 1.0) *
                               (results.positions[i][vertex] - results.positions[0][vertex]);
        }
    });
    return between;
}

}  // namespace tracked_mcf
