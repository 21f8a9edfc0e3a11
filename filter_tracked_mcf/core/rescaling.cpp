#include "filter_tracked_mcf/core/rescaling.h"

#include <cmath>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/mesh_topology.h"

namespace tracked_mcf {

namespace {

/// A volume below this share of the cube of the area's root is that of a flat surface. A sphere's
/// is 0.09.
constexpr double kFlat = 1e-9;

/// Longest side of a rescaled surface's bounding box, relative to the initial one.
constexpr double kLargestGrowth = 4;

void check_nothing_is_held(const Domain& domain) {
    if (!domain.holds_anything()) return;
    throw InvalidParameter(
        "rescale would move what is held: an open mesh must have a free boundary, and no part of "
        "the mesh may be left unselected. Set rescale to none, or free the boundary.");
}

void check_closed(const Domain& domain) {
    if (domain.boundary_edge_count() > 0) {
        throw InvalidMesh("The volume cannot be kept, for the surface is open: " +
                          std::to_string(domain.boundary_edge_count()) +
                          " edges have one face only. Close the holes first, or keep the area.");
    }
    if (!is_oriented_consistently(domain.topology())) {
        throw InvalidMesh(
            "The volume cannot be kept, for the faces are not oriented consistently: some "
            "neighbours disagree about which side is inside. Re-orient all faces coherently "
            "first, or keep the area.");
    }
}

void check_not_flat(const TriangleMesh& mesh) {
    if (std::abs(enclosed_volume(mesh)) > kFlat * std::pow(surface_area(mesh), 1.5)) return;
    throw InvalidMesh(
        "The volume cannot be kept, for the surface encloses none; keep the area instead.");
}

}  // namespace

Rescaler::Rescaler(const TriangleMesh& mesh, const Selection& selection,
                   const FlowParameters& parameters)
    : kind_(parameters.rescale),
      flow_(parameters.flow),
      start_(copy_of(mesh.positions)),
      moved_{copy_of(mesh.positions), copy_of(mesh.triangles)},
      initial_side_(longest_side(mesh)),
      area_(surface_area(mesh)) {
    const Domain domain(mesh, selection, parameters.boundary);
    check_nothing_is_held(domain);
    if (kind_ == Rescaling::KeepVolume) {
        check_closed(domain);
        check_not_flat(mesh);
    }
    initial_ = measure();
}

double Rescaler::measure() const {
    return kind_ == Rescaling::KeepVolume ? enclosed_volume(moved_) : surface_area(moved_);
}

bool Rescaler::restore(Flow& flow) {
    moved_.positions = start_;
    flow.move_vertices(moved_);
    const double ratio = initial_ / measure();
    const double area = surface_area(moved_);
    // A ratio below 0 is that of a surface turned inside out, and none is finite where none is
    // left.
    if (area <= kVanishedArea * area_ || !(ratio > 0) || !std::isfinite(ratio)) {
        flow.take_back(Stop::Vanished);
        return false;
    }
    const double factor = kind_ == Rescaling::KeepVolume ? std::cbrt(ratio) : std::sqrt(ratio);
    if (blows_up(factor, flow.report())) {
        flow.take_back(Stop::Pinched);
        return false;
    }
    flow.scale(surface_centroid(moved_), factor);
    area_ = factor * factor * area;
    return true;
}

/// Mean-curvature flow never makes a surface longer. Scaled up, its solid parts stay within some
/// bounds, too, but what has pinched does not shrink on with them and grows without any.
bool Rescaler::blows_up(double factor, const FlowReport& report) const {
    if (flow_ == FlowKind::Conformalized) return false;
    if (factor * longest_side(moved_) <= kLargestGrowth * initial_side_) return false;
    return kind_ == Rescaling::KeepVolume || report.steps.back().collapsed_samples > 0;
}

}  // namespace tracked_mcf
