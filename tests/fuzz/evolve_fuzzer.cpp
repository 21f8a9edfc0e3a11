// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a mesh, a selection and parameters of bytes, and smooths the mesh or removes its noise.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iostream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/zoo/properties.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf {
namespace {

constexpr int kMostVertices = 64, kMostTriangles = 128;
/// Under sanitizers, a flow takes about a tenth of a second with these.
constexpr double kMostFragments = 1000;

/// Takes numbers from the bytes, and zeros after their end.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

    bool empty() const { return next_ == end_; }
    /// Returns an integer in [low, high], which are less than 256 apart.
    int integer(int low, int high) { return low + byte() % (high - low + 1); }
    bool flag() { return integer(0, 1) == 1; }
    /// Returns any double.
    double number() {
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < sizeof(bits); ++i) bits = bits << 8U | byte();
        double result = 0;
        std::memcpy(&result, &bits, sizeof(bits));
        return result;
    }
    template <class Value>
    Value pick(std::initializer_list<Value> values) {
        return values.begin()[integer(0, static_cast<int>(values.size()) - 1)];
    }

private:
    std::uint8_t byte() { return empty() ? std::uint8_t{0} : *next_++; }

    const std::uint8_t *next_, *end_;
};

/// Any double, or one of few, so that points, lines and planes coincide.
double coordinate(Bytes& bytes) {
    if (bytes.integer(0, 15) == 15) return bytes.number();
    return bytes.integer(-8, 8) / 8.0;
}

/// Parameters in their ranges, and just outside.
FlowParameters parameters_of(Bytes& bytes) {
    FlowParameters p;
    p.depth = bytes.integer(-1, kMaximumDepth + 1);
    p.order = bytes.integer(0, kMaximumOrder + 1);
    if (bytes.flag()) p.detail_size = bytes.number();
    if (bytes.flag()) p.step_size = bytes.number();
    p.flow = bytes.pick({FlowKind::MeanCurvature, FlowKind::Conformalized});
    p.boundary = bytes.pick({BoundaryCondition::Locked, BoundaryCondition::Free});
    p.preserve = bytes.pick({Preserve::None, Preserve::Area, Preserve::Volume});
    p.quality = bytes.pick({Quality::None, Quality::Displacement, Quality::MeanCurvature});
    p.cubature = bytes.pick({Cubature::ThreePoints, Cubature::OnePoint, Cubature::Degree6});
    p.method = bytes.pick({Method::Converged, Method::Paper});
    p.cycles = bytes.integer(0, 3);
    if (bytes.flag()) p.tolerance = bytes.number();
    return p;
}

NoiseParameters noise_parameters_of(Bytes& bytes) {
    NoiseParameters p;
    if (bytes.flag()) p.crease_angle = bytes.number();
    if (bytes.flag()) p.noise = bytes.number();
    if (bytes.flag()) p.noise_size = bytes.number();
    if (bytes.flag()) p.detail_size = bytes.number();
    if (bytes.flag()) p.largest_movement = bytes.number();
    p.boundary = bytes.pick({NoiseBoundary::Free, NoiseBoundary::Locked});
    p.quality = bytes.pick({Quality::None, Quality::Displacement});
    return p;
}

FairParameters fair_parameters_of(Bytes& bytes) {
    FairParameters p;
    p.continuity = bytes.pick({Continuity::Position, Continuity::Tangent, Continuity::Curvature});
    p.quality = bytes.pick({Quality::None, Quality::Displacement});
    return p;
}

/// Returns the index of a vertex, or seldom one that is out of range.
int index(Bytes& bytes, int vertex_count) {
    const int taken = bytes.integer(-1, 254);
    return taken < 250 && vertex_count > 0 ? std::abs(taken) % vertex_count : taken;
}

zoo::Case case_of(Bytes& bytes) {
    zoo::Case made;
    made.kind = "bytes";
    made.parameters = parameters_of(bytes);
    if (bytes.flag()) {
        made.noise = noise_parameters_of(bytes);
    } else if (bytes.flag()) {
        made.fair = fair_parameters_of(bytes);
    }
    const bool has_selection = bytes.flag();
    const int vertex_count = bytes.integer(0, kMostVertices);
    for (int i = 0; i < vertex_count; ++i) {
        const double x = coordinate(bytes), y = coordinate(bytes), z = coordinate(bytes);
        made.mesh.positions.emplace_back(x, y, z);
    }
    while (!bytes.empty() && made.mesh.triangles.size() < kMostTriangles) {
        Triangle triangle{};
        for (std::int32_t& vertex : triangle) vertex = index(bytes, vertex_count);
        made.mesh.triangles.push_back(triangle);
        if (has_selection) made.inputs.selection.push_back(bytes.flag() ? 1 : 0);
    }
    return made;
}

/// Requires that a mesh is refused.
void require_refusal(zoo::Case& invalid) {
    try {
        if (invalid.noise) {
            remove_noise(invalid.mesh, invalid.inputs, *invalid.noise);
        } else if (invalid.fair) {
            fair(invalid.mesh, invalid.inputs.selection, *invalid.fair);
        } else {
            evolve(invalid.mesh, invalid.inputs, invalid.parameters);
        }
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

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tracked_mcf::Bytes bytes(data, size);
    tracked_mcf::fuzz(tracked_mcf::case_of(bytes));
    return 0;
}
