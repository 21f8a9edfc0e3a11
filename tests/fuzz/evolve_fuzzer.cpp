// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a mesh, a selection and parameters of bytes, and smooths the mesh.

#include <fuzzer/FuzzedDataProvider.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "tests/zoo/properties.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf {
namespace {

using Bytes = FuzzedDataProvider;

constexpr int kMostVertices = 64, kMostTriangles = 128;
/// Under sanitizers, a flow takes about a tenth of a second with these.
constexpr double kMostFragments = 1000;

/// Any double, or one of few, so that points, lines and planes coincide.
double coordinate(Bytes& bytes) {
    if (bytes.ConsumeIntegralInRange(0, 15) == 0) return bytes.ConsumeFloatingPoint<double>();
    return bytes.ConsumeIntegralInRange(-8, 8) / 8.0;
}

FlowParameters parameters_of(Bytes& bytes) {
    FlowParameters p;
    p.depth = bytes.ConsumeIntegralInRange(-1, kMaximumDepth + 1);
    p.iterations = bytes.ConsumeIntegralInRange(0, 5);
    p.order = bytes.ConsumeIntegralInRange(0, kMaximumOrder + 1);
    p.absolute = bytes.ConsumeBool();
    if (bytes.ConsumeBool()) p.detail_size = bytes.ConsumeFloatingPoint<double>();
    if (bytes.ConsumeBool()) p.step_size = bytes.ConsumeFloatingPoint<double>();
    p.flow = bytes.PickValueInArray({FlowKind::MeanCurvature, FlowKind::Conformalized});
    p.boundary = bytes.PickValueInArray(
        {BoundaryCondition::Locked, BoundaryCondition::LockedCells, BoundaryCondition::Free});
    p.preserve = bytes.PickValueInArray({Preserve::None, Preserve::Area, Preserve::Volume});
    p.quality =
        bytes.PickValueInArray({Quality::None, Quality::Displacement, Quality::MeanCurvature});
    p.cubature =
        bytes.PickValueInArray({Cubature::OnePoint, Cubature::ThreePoints, Cubature::Degree6});
    p.separate_sheets = bytes.ConsumeBool();
    p.solver = bytes.PickValueInArray({Solver::Converged, Solver::OneWCycle});
    p.cycles = bytes.ConsumeIntegralInRange(0, 3);
    if (bytes.ConsumeBool()) p.tolerance = bytes.ConsumeFloatingPoint<double>();
    if (bytes.ConsumeBool()) p.stabilization = bytes.ConsumeFloatingPoint<double>();
    if (bytes.ConsumeBool()) p.boundary_penalty = bytes.ConsumeFloatingPoint<double>();
    p.constrain_pinches = bytes.ConsumeBool();
    p.update_boundary_multipliers = bytes.ConsumeBool();
    return p;
}

zoo::Case case_of(Bytes& bytes) {
    zoo::Case made;
    made.kind = "bytes";
    made.parameters = parameters_of(bytes);
    const bool is_selection = bytes.ConsumeBool();
    const int vertex_count = bytes.ConsumeIntegralInRange(0, kMostVertices);
    for (int i = 0; i < vertex_count; ++i) {
        const double x = coordinate(bytes), y = coordinate(bytes), z = coordinate(bytes);
        made.mesh.positions.emplace_back(x, y, z);
    }
    while (bytes.remaining_bytes() > 0 && made.mesh.triangles.size() < kMostTriangles) {
        Triangle triangle{};
        // An index may be the first one out of range.
        for (std::int32_t& vertex : triangle)
            vertex = bytes.ConsumeIntegralInRange(-1, vertex_count);
        made.mesh.triangles.push_back(triangle);
        if (is_selection) made.selection.push_back(bytes.ConsumeBool() ? 1 : 0);
    }
    return made;
}

/// Requires that evolve() refuses a mesh.
void require_refusal(zoo::Case& invalid) {
    try {
        evolve(invalid.mesh, invalid.selection, invalid.parameters);
    } catch (const Error&) {
        return;
    }
    std::cerr << "failed: an invalid mesh was accepted\n";
    std::abort();
}

void fuzz(zoo::Case fuzzed) {
    try {
        validate(fuzzed.mesh);
    } catch (const InvalidMesh&) {
        require_refusal(fuzzed);
        return;
    }
    zoo::limit_work(fuzzed, kMostFragments);
    zoo::Random random(1, 1);
    for (const zoo::Failure& failure : zoo::check(fuzzed, false, random).failures) {
        // Sanitizers take time, and tests/zoo watches over the box and the area.
        using zoo::Property;
        if (failure.property == Property::Time || failure.property == Property::Box ||
            failure.property == Property::Area) {
            continue;
        }
        std::cerr << "failed: " << zoo::kPropertyNames[static_cast<std::size_t>(failure.property)]
                  << ": " << failure.what << "; " << zoo::options_of(fuzzed) << '\n';
        std::abort();
    }
}

}  // namespace
}  // namespace tracked_mcf

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracked_mcf::Bytes bytes(data, size);
    tracked_mcf::fuzz(tracked_mcf::case_of(bytes));
    return 0;
}
