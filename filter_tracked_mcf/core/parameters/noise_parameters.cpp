// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/remove_noise.h"

#include "filter_tracked_mcf/core/parameters/parameter_rows.h"

namespace tracked_mcf {

template <>
const std::vector<ParameterOf<NoiseParameters>>& parameter_table() {
    using namespace parameter_rows;
    using Type = Parameter::Type;
    using P = NoiseParameters;
    static const std::vector<ParameterOf<P>> table = {
        named(access<&P::crease_angle>(Type::Real,
                                       {0, 179, " degrees, such as 25, where 0 keeps none"}),
              "crease_angle", "Keep creases above (degrees)",
              "In degrees: where the smoothed surface turns by more, a crease is kept. 0 keeps "
              "none."),
        named(access<&P::noise>(Type::Length,
                                {0, kFinite, ", in units of the mesh, where 0 measures it"}),
              "noise", "Noise (0: measure it)",
              "Standard deviation of the noise along the normals. 0 measures it."),
        named(access<&P::noise_size>(
                  Type::Length,
                  {0, kFinite, ", in units of the mesh, where 0 is what the mesh itself shows"}),
              "noise_size", "Size of the noise (0: auto)",
              "Width of lumps, half a ripple. Stairs' height: smooths them; below half of it: "
              "keeps. 0: by the mesh."),
        named(access<&P::detail_size>(
                  Type::Length,
                  {0, kFinite, ", in units of the mesh, where 0 takes what the noise needs"}),
              "detail_size", "Detail size (0: auto)",
              "Bumps of this size become half as high, smaller ones nearly vanish. 0 takes what "
              "the noise needs."),
        named(access<&P::largest_movement>(
                  Type::Length, {0, kFinite, ", in units of the mesh, where 0 is no bound"}),
              "largest_movement", "Largest move (0: any)",
              "A bound that no vertex exceeds. 0 is no bound."),
        named(toggle<&P::along_normals>(), "along_normals", "Along normals only",
              "For rasters and textures: no vertex slides along the surface."),
        named(toggle<&P::lumps>(), "lumps", "Lumps, too",
              "Removes lumps and waves a few edges wide, too. They may be detail."),
        named(choice<&P::boundary>({{"Locked", "locked"}, {"Free", "free"}, {"Smooth", "smooth"}}),
              "boundary", "Boundary",
              "Locked keeps the rim, with its noise. Free moves it along its normals. Smooth evens "
              "its outline."),
        displacement<&P::quality>(),
        threads<&P::threads>(),
    };
    return table;
}

template <>
const std::vector<Input>& input_table<NoiseParameters>() {
    using namespace parameter_rows;
    static const std::vector<Input> table = {
        selected("Vertices of other faces stay."),
        strength("A number from 0 to 1 at each vertex: 0 keeps the vertex, 1 smooths it as "
                 "elsewhere.")};
    return table;
}

void validate(const NoiseParameters& parameters) {
    check_ranges(parameters);
}

}  // namespace tracked_mcf
