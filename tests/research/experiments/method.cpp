// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/experiments/method.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/research/experiments/configuration.h"
#include "tests/support/cotangent_flow.h"
#include "tests/support/elements.h"
#include "tests/support/measures.h"
#include "tests/support/process_time.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::experiments {

namespace {

/// Takes the sizes and the last step of a flow, which took `seconds` of processor time. The parts
/// of a step share it as they share the wall time.
void add_step(const FlowReport& from, double seconds, MethodReport& to) {
    to.depth = from.depth;
    to.unknowns = from.unknowns;
    to.split_triangles = from.split_triangles;
    if (from.steps.empty()) return;
    const StepReport& last = from.steps.back();
    const double assembling =
        seconds * last.assemble_seconds / (last.assemble_seconds + last.solve_seconds);
    to.assemble_seconds += assembling;
    to.solve_seconds += seconds - assembling;
    to.iterations += last.solver_iterations;
    to.collapsed = static_cast<double>(last.collapsed_samples) /
                   static_cast<double>(std::max<std::int64_t>(1, from.samples));
    to.reached_tolerance = last.reached_tolerance;
    to.residual = last.residual_before > 0 ? last.residual_after / last.residual_before : 0;
}

class Tracked : public Method {
public:
    Tracked(const TriangleMesh& mesh, const FlowParameters& parameters) {
        const double start = cpu_seconds();
        flow_ = make_flow(mesh, parameters);
        report_.setup_seconds = cpu_seconds() - start;
    }

    bool step() override {
        const double start = cpu_seconds();
        if (!flow_->step()) return false;
        add_step(flow_->report(), cpu_seconds() - start, report_);
        return true;
    }

    void move(TriangleMesh& mesh) const override { flow_->move_vertices(mesh.positions); }
    MethodReport report() const override { return report_; }

private:
    std::unique_ptr<SurfaceFlow> flow_;
    MethodReport report_;
};

class Rebuilt : public Method {
public:
    Rebuilt(const TriangleMesh& mesh, const FlowParameters& parameters)
        : mesh_(mesh),
          parameters_(parameters),
          grid_(paper_plan_of(mesh, parameters).clipped.grid) {}

    bool step() override {
        const double start = cpu_seconds();
        PaperFlow flow(paper_plan_of(mesh_, parameters_, grid_));
        const double stepping = cpu_seconds();
        report_.setup_seconds += stepping - start;
        if (!flow.step()) return false;
        add_step(flow.report(), cpu_seconds() - stepping, report_);
        flow.move_vertices(mesh_.positions);
        return true;
    }

    /// The vertices of a mesh that was split come first.
    void move(TriangleMesh& mesh) const override {
        std::copy_n(mesh_.positions.begin(), mesh.positions.size(), mesh.positions.begin());
    }
    MethodReport report() const override { return report_; }

private:
    TriangleMesh mesh_;
    FlowParameters parameters_;
    Grid grid_;
    MethodReport report_;
};

/// Replaces the samples of each element by `count` that are drawn with the probabilities of their
/// weights. The others stay, with weight 0.
void draw_samples(int count, TrackedElements& elements) {
    std::mt19937 random(1);
    for (std::size_t element = 0; element + 1 < elements.sample_begin.size(); ++element) {
        const std::int64_t begin = elements.sample_begin[element];
        const auto size = elements.sample_begin[element + 1] - begin;
        std::vector<float> weights(static_cast<std::size_t>(size));
        for (std::int64_t i = 0; i < size; ++i) weights[i] = elements.samples.weight(begin + i);
        const double area = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::vector<int> drawn(weights.size());
        std::discrete_distribution<std::size_t> distribution(weights.begin(), weights.end());
        for (int i = 0; i < count; ++i) ++drawn[distribution(random)];
        for (std::int64_t i = 0; i < size; ++i) {
            elements.samples.set(begin + i, elements.samples.local(begin + i),
                                 area * drawn[static_cast<std::size_t>(i)] / count);
        }
    }
}

class MonteCarlo : public Method {
public:
    MonteCarlo(const TriangleMesh& mesh, const FlowParameters& parameters, int count)
        : cycles_(parameters.cycles),
          elements_(build_tracked_elements(mesh, enclosing_grid(mesh, parameters.depth),
                                           parameters.cubature, BoundaryCondition::Free)),
          multigrid_(elements_, constrained_unknowns(elements_)),
          displacement_(Coefficients::Zero(elements_.finest().unknown_count(), 3)) {
        draw_samples(count, elements_);
        step_size_ = parameters.step_size / std::pow(elements_.grid.cell_size, 2);
    }

    bool step() override {
        assemble_elements(elements_, displacement_, step_size_, false, systems_);
        multigrid_.refresh(systems_.matrices);
        sum_at_unknowns(elements_.finest(), systems_.right_sides, right_side_);
        set_zero(x_, right_side_.cols());
        for (int i = 0; i < cycles_; ++i) multigrid_.cycle(right_side_, x_);
        displacement_ += x_.topRows<3>().transpose().cast<double>();
        return displacement_.allFinite();
    }

    void move(TriangleMesh& mesh) const override {
        add_at_vertices(elements_, displacement_, mesh.positions);
    }

    MethodReport report() const override { return {}; }

private:
    int cycles_;
    TrackedElements elements_;
    Multigrid multigrid_;
    double step_size_ = 0;  ///< in squared sides of a cell
    Coefficients displacement_;
    ElementSystems systems_;
    Field right_side_, x_;
};

class Cotangent : public Method {
public:
    Cotangent(const TriangleMesh& mesh, const FlowParameters& parameters)
        : flow_(mesh, parameters.step_size / std::pow(longest_side(mesh), 2), parameters.boundary) {
        report_.unknowns = static_cast<std::int64_t>(mesh.positions.size());
    }

    bool step() override {
        const double start = cpu_seconds();
        flow_.step();
        report_.solve_seconds += cpu_seconds() - start;
        report_.residual = flow_.relative_residual();
        return true;
    }

    void move(TriangleMesh& mesh) const override { mesh.positions = flow_.mesh().positions; }
    MethodReport report() const override { return report_; }

private:
    CotangentFlow flow_;
    MethodReport report_;
};

}  // namespace

std::unique_ptr<Method> make_method(const std::string& name, const TriangleMesh& mesh,
                                    const FlowParameters& parameters) {
    if (name == "tracked") return std::make_unique<Tracked>(mesh, parameters);
    if (name == "rebuilt") return std::make_unique<Rebuilt>(mesh, parameters);
    if (name == "rebuilt-split") {
        return std::make_unique<Rebuilt>(shapes::split_in_four(mesh), parameters);
    }
    const std::string monte_carlo = "monte-carlo-";
    if (name.rfind(monte_carlo, 0) == 0) {
        const int count = std::stoi(name.substr(monte_carlo.size()));
        return std::make_unique<MonteCarlo>(mesh, parameters, count);
    }
    if (name == "cotangent") return std::make_unique<Cotangent>(mesh, parameters);
    throw std::invalid_argument("there is no method '" + name + "'");
}

}  // namespace tracked_mcf::experiments
