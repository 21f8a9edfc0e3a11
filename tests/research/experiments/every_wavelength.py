#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The flow at every wavelength that a mesh has: on a plane, a sphere, scans, and two resolutions.

ℓ is the detail size. Lengths are in mean edges. The measure is the share of their height that small waves keep: the
displacement along the normal, projected onto the waves. "Rest" is the RMS of this displacement that is no multiple of the
waves, over that of the waves; "sideways" is the RMS across the normal, over the same. The tables:

- plane waves, on a plane whose axes are turned, far from its rim. The ideal is the exact flow: 1 - hᵐ in each of three steps
  of order m, with h = δk² / (1 + δk²). Rest and sideways are the largest of a row;
- bumps on a sphere: random spherical harmonics of degree n, with waves of 2πR / √(n(n + 1)). The ideal is exact for small
  bumps, the shrinking radius included (kept_on_sphere in flow.py);
- heights on scans: random sums of eigenfunctions of the Laplacian with eigenvalues next to (2π / wave)². The measure is the
  difference of the results with and without these heights. Beside it is the share on a plane. It is no exact ideal here: where
  the surface is curved, waves keep more. "Direct" is the flow by SciPy with direct solves in double precision, with the same
  linear elements. So it shares the effects of curvature and of the elements, but not those of the solver;
- a wave over a plane whose edges are five times as long on one side as on the other: the share that either side keeps.

Needs PyMeshLab, PyVista and SciPy: README.md says how to install them.
"""

import numpy
import shapes
from experiment import Experiment
from flow import kept, kept_on_sphere
from measures import across, along, root_mean_square, topology_of
from scan import Scan
from surface import SEED, Surface
from voxels import rotation

try:
    import cotangents
except ImportError:
    cotangents = None

DETAIL_SIZES = [2.5, 4, 8, 16, 32, 64]
WAVES = [2.5, 3.3, 5, 8, 16, 32, 64, 128, 256]
SIDE = 180  # of the plane, in quads
TURN = rotation(0.7, 0.3)
HARMONICS = 12
SHARED_SCANS, CGAL_SCANS = ["stanford_bunny.ply", "nefertiti_50k.ply"], ["bunny00.off", "nefertiti.off"]


def scaled(surface):
    """Returns the surface with mean edges of 1, without vertices that no face uses."""
    used, faces = numpy.unique(surface.faces, return_inverse=True)
    return Surface(surface.name, surface.vertices[used] / surface.edge, faces.reshape(-1, 3))


def height_of(wave):
    return 0.01 * min(wave, 10)


def split(moved, waves):
    """Returns the multiple of the waves in the heights `moved`, and the RMS of the rest over that of the waves."""
    share = float((moved * waves).sum() / (waves ** 2).sum())
    return share, root_mean_square(moved - share * waves) / root_mean_square(waves)


def over_plane(flow, surface, wave, inside, *words):
    """Flows a wave over a plane. Returns its share, the rest and the sideways movement where `inside` is true."""
    waves = height_of(wave) * numpy.sin(2 * numpy.pi * surface.vertices[:, 0] / wave)
    waved = surface.vertices + waves[:, None] * (0, 0, 1)
    moved = flow(waved @ TURN.T, surface.faces, *words)[0] @ TURN - surface.vertices
    sideways = root_mean_square(numpy.linalg.norm(moved[inside, :2], axis=1)) / root_mean_square(waves[inside])
    return *split(moved[inside, 2], waves[inside]), sideways


def waves_over_a_plane(experiment, flow):
    rows, errors = [], {"at": [], "below": [], "default": []}
    for detail_size in (2.5, 8) if experiment.options.quick else DETAIL_SIZES:
        # √δ is at most 0.15 ℓ. The rim is at least ten times as far away.
        plane = scaled(Surface("plane", *shapes.sheet(max(SIDE, round(12 * detail_size)), max(SIDE, round(5 * detail_size)))))
        x, y = (plane.vertices / plane.vertices.max(axis=0).clip(1e-9)).T[:2]
        inside = (abs(x - 0.5) < 0.25) & (abs(y - 0.5) < 0.125)
        waves = sorted({*(wave for wave in WAVES if wave <= 4 * detail_size), *(n * detail_size for n in (1, 2, 4))})
        for order in (1, 2):
            exact = [kept(wave, detail_size, order) for wave in waves]
            found = [over_plane(flow, plane, wave, inside, "--detail-size", detail_size, "--order", order) for wave in waves]
            key = {"detail size": detail_size, "order": order}
            rows += [{**key, "of": "ideal", **dict(zip(waves, exact))},
                     {**key, "of": "flow", **dict(zip(waves, (share for share, _, _ in found))),
                      "rest": max(rest for _, rest, _ in found), "sideways": max(sideways for _, _, sideways in found)}]
            for wave, (value, _, _), ideal in zip(waves, found, exact):
                if detail_size < 4:
                    errors["default"].append(value - ideal)
                elif wave in (detail_size, 2 * detail_size):
                    errors["at"].append(abs(value / ideal - 1))
                elif wave < detail_size / 2:
                    errors["below"].append(value - ideal)
    columns = sorted({key for row in rows for key in row if not isinstance(key, str)})
    experiment.say("## Plane waves: the share of their height that stays\n")
    experiment.table(["ℓ", "order", "", *(f"{wave:g}" for wave in columns), "rest", "sideways"],
                     [[row["detail size"], row["order"], row["of"],
                       *(f"{row[wave]:.3f}" if wave in row else "" for wave in columns),
                       *(f"{row[name]:.4f}" if name in row else "" for name in ("rest", "sideways"))] for row in rows])
    experiment.record([{"table": "waves", **row} for row in rows])
    experiment.check("ℓ of 4 edges or more, waves of ℓ and 2 ℓ: largest relative error", max(errors["at"]), at_most=0.02)
    experiment.check("the same, waves below ℓ / 2: most that stays above the ideal", max(errors["below"]), at_most=0.05)
    experiment.check("ℓ of 2.5 edges: most that stays above the ideal", max(errors["default"]), at_most=0.07)


def harmonic(degree, directions):
    """Returns a random spherical harmonic: a sum of zonal ones around random axes."""
    random = numpy.random.default_rng(SEED)
    axes = random.normal(size=(HARMONICS, 3))
    cosines = directions @ (axes / numpy.linalg.norm(axes, axis=1)[:, None]).T
    return numpy.polynomial.legendre.legval(cosines, [0] * degree + [1]) @ random.normal(size=HARMONICS)


def bumps_on_a_sphere(experiment, flow):
    ball = scaled(Surface("sphere", *shapes.sphere(5 if experiment.options.quick else 6)))
    radius = float(numpy.linalg.norm(ball.vertices[0]))
    directions = ball.vertices / radius
    rows = []
    for detail_size in (8,) if experiment.options.quick else (8, 16, 32):
        for order, wanted in ((order, n * detail_size) for order in (1, 2) for n in (0.5, 1, 2)):
            degree = round(numpy.hypot(2 * numpy.pi * radius / wanted, 0.5) - 0.5)
            wave = 2 * numpy.pi * radius / numpy.sqrt(degree * (degree + 1))
            scale = height_of(wave) / root_mean_square(harmonic(degree, directions))
            bumpy = directions * (radius + scale * harmonic(degree, directions))[:, None]
            moved, *_ = flow(bumpy, ball.faces, "--detail-size", detail_size, "--order", order)
            radii = numpy.linalg.norm(moved, axis=1)
            ideal, last_radius = kept_on_sphere(degree, radius, detail_size, order)
            share, rest = split(radii - radii.mean(), scale * harmonic(degree, moved / radii[:, None]))
            sideways = root_mean_square(numpy.linalg.norm(across(ball, moved - bumpy), axis=1)) / height_of(wave)
            rows.append([detail_size, order, degree, f"{wave:.1f}", f"{kept(wave, detail_size, order):.4f}", f"{ideal:.4f}",
                         f"{share:.4f}", f"{rest:.4f}", f"{sideways:.3f}", f"{radii.mean() / last_radius - 1:.1e}"])
    headers = ["ℓ", "order", "degree", "wave", "plane", "ideal", "flow", "rest", "sideways", "error of the radius"]
    experiment.say(f"\n## Bumps on a sphere with a radius of {radius:.0f} edges\n")
    experiment.table(headers, rows)
    experiment.record([{"table": "sphere", **dict(zip(headers, row))} for row in rows])
    errors = [abs(float(row[6]) / float(row[5]) - 1) for row in rows if float(row[3]) > 0.75 * row[0]]
    experiment.check("sphere, waves of ℓ and 2 ℓ: largest relative error", max(errors), at_most=0.02)
    experiment.check("sphere, the radius: largest relative error", max(abs(float(row[9])) for row in rows), at_most=1e-4)


def heights_on_scans(experiment, flow):
    if cotangents is None:
        experiment.say("\nThe scans were left out, because this Python has no SciPy.\n")
        return
    rows = []
    for path in experiment.scans(SHARED_SCANS, CGAL_SCANS):
        surface = scaled(Scan(path))
        vertices, faces = surface.vertices, surface.faces
        fixed = numpy.isin(numpy.arange(len(vertices)), topology_of(surface).rim)
        for detail_size in (8,) if experiment.options.quick else (8, 16):
            methods = {"flow": lambda x: flow(x, faces, "--detail-size", detail_size, "--order", 2)[0],
                       "direct": lambda x: cotangents.flow_by_direct_solves(x, faces, fixed, detail_size, 2)}
            without = {name: method(vertices) for name, method in methods.items()}
            for wave in (detail_size / 2, detail_size, 2 * detail_size):
                waves = height_of(wave) * cotangents.random_waves(surface, wave, numpy.random.default_rng(SEED))
                row = [surface.name, detail_size, wave, kept(wave, detail_size, 2)]
                for name, method in methods.items():
                    difference = method(vertices + waves[:, None] * surface.normals) - without[name]
                    sideways = root_mean_square(numpy.linalg.norm(across(surface, difference), axis=1))
                    row += [*split(along(surface, difference), waves), sideways / root_mean_square(waves)]
                rows.append(row)
    headers = ["", "ℓ", "wave", "plane", *(f"{name}{what}" for name in methods for what in ("", ", rest", ", sideways"))]
    experiment.say("\n## Random heights on scans, order 2\n")
    experiment.table(headers, rows)
    experiment.record([{"table": "scans", **dict(zip(["of", *headers[1:]], row))} for row in rows])
    long = [row for row in rows if row[2] >= row[1]]
    experiment.check("scans, waves of ℓ and 2 ℓ: largest relative distance of the share from that of direct solves",
                     max(abs(row[4] / row[7] - 1) for row in long), at_most=0.02)


def two_resolutions(experiment, flow):
    """A plane with columns five wide, then one wide, and waves across them."""
    coarse, fine = 40, 5
    widths = [fine] * coarse + [1] * (coarse * fine)
    x = numpy.concatenate([[0], numpy.cumsum(widths)])
    vertices, faces = shapes.sheet(len(widths), 4 * coarse)
    vertices[:, 0], vertices[:, 1] = x[vertices[:, 0].astype(int)], vertices[:, 1] * fine / 2
    plane = Surface("two resolutions", vertices, faces)
    across_x, middle = vertices[:, 0], coarse * fine
    inside = abs(vertices[:, 1] / vertices[:, 1].max() - 0.5) < 0.25
    sides = {"coarse": inside & (across_x > 0.3 * middle) & (across_x < 0.8 * middle),
             "fine": inside & (across_x > 1.2 * middle) & (across_x < 1.7 * middle)}
    detail_size = 8 * fine
    rows = []
    for waves in (3, 5, 8, 16):
        rows.append([waves, "ideal", *[kept(waves * fine, detail_size, 2)] * 2])
        words = "--detail-size", detail_size, "--order", 2
        rows.append([waves, "flow", *(over_plane(flow, plane, waves * fine, side, *words)[0] for side in sides.values())])
    experiment.say("\n## Two resolutions, 1 : 5, ℓ of 8 coarse edges\n")
    experiment.table(["wave, coarse edges", "", *sides], rows)
    experiment.record([{"table": "two resolutions", "wave": wave, "of": of, "coarse": here, "fine": there}
                       for wave, of, here, there in rows])


def main():
    experiment = Experiment("every_wavelength", __doc__)
    for table in (waves_over_a_plane, bumps_on_a_sphere, heights_on_scans, two_resolutions):
        table(experiment, experiment.smoothed)
    experiment.finish()


if __name__ == "__main__":
    main()
