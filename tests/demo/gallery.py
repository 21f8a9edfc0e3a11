#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the commands of the gallery, filter_tracked_mcf/pictures/README.md, and checks what they do:
gallery.py TOOL CGAL_MESHES WORK_DIR [--pictures]

With --pictures, draws the pictures of the page anew, with Debian's python3-vtk9, xvfb and imagemagick.
"""

import argparse
import pathlib
import re
import shlex
import subprocess
import sys

import numpy

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "tests" / "hosts"))
import float_ply  # noqa: E402

PICTURES = TOP / "filter_tracked_mcf" / "pictures"
COLOURS = numpy.array([[40, 80, 200], [235, 232, 225], [200, 50, 40]])  # negative, 0, positive
SELECTED = [215, 60, 50]
PLASTER = [237, 227, 212]
RED, BLUE = ([PLASTER, *darker] for darker in ([[230, 120, 40], [120, 10, 30]], [[70, 130, 210], [25, 65, 150]]))


def read_off(path):
    return [numpy.array(rows) for rows in float_ply.read_off(path)]


def diagonal_of(vertices):
    return numpy.linalg.norm(numpy.ptp(vertices, axis=0))


def normals_of(vertices, faces):
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normals = numpy.zeros_like(vertices)
    for i in range(3):
        numpy.add.at(normals, faces[:, i], numpy.cross(b - a, c - a))
    return normals / numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]


def read_ply(path):
    """Returns the properties of the vertices by name."""
    vertices = float_ply.read_ply(path)["vertex"]
    return {name: numpy.array(vertices.column(name)) for name in vertices.properties}


def write_ply(path, vertices, faces, **properties):
    """Writes the properties of the vertices after their positions: bytes as uchar, others as float."""
    columns = {axis: vertices[:, i].astype("<f8") for i, axis in enumerate("xyz")}
    columns.update(properties)
    kinds = {name: "uchar" if column.dtype == "u1" else "double" if name in "xyz" else "float"
             for name, column in columns.items()}
    types = {"uchar": "u1", "double": "<f8", "float": "<f4"}
    rows = numpy.zeros(len(vertices), [(name, types[kind]) for name, kind in kinds.items()])
    for name, column in columns.items():
        rows[name] = column
    triangles = numpy.zeros(len(faces), [("count", "u1"), ("corners", "<i4", 3)])
    triangles["count"], triangles["corners"] = 3, faces
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
              *(f"property {kind} {name}" for name, kind in kinds.items()),
              f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    path.write_bytes("\n".join(header).encode() + rows.tobytes() + triangles.tobytes())


def with_noise(vertices, faces, edges, local=False):
    """Moves the vertices by normal noise, whose deviation is this many mean edge lengths: those of the
    mesh, or if it is `local`, those of the vertex's faces."""
    sides = numpy.linalg.norm(vertices[faces] - vertices[faces[:, [1, 2, 0]]], axis=2)
    lengths = numpy.full(len(vertices), sides.mean())
    if local:
        sums, counts = numpy.zeros(len(vertices)), numpy.zeros(len(vertices))
        numpy.add.at(sums, faces, sides.mean(axis=1)[:, None])
        numpy.add.at(counts, faces, 1)
        lengths = sums / numpy.maximum(counts, 1)
    noise = numpy.random.default_rng(1).normal(size=vertices.shape)
    return vertices + edges * lengths[:, None] * noise


def with_bumps(vertices, faces):
    """Raises and lowers the surface by 0.6 % of the diagonal, in waves of 5 % of it."""
    diagonal = diagonal_of(vertices)
    heights = 0.006 * diagonal * numpy.sin(2 * numpy.pi / (0.05 * diagonal) * vertices).prod(axis=1)
    return vertices + heights[:, None] * normals_of(vertices, faces)


def frame(side=80):
    """Returns a crumpled film in a frame that is bent three times up and down."""
    ticks = numpy.linspace(-1, 1, side)
    x, y = (axis.ravel() for axis in numpy.meshgrid(ticks, ticks))
    stretch = numpy.maximum(abs(x), abs(y)) / numpy.maximum(numpy.hypot(x, y), 1e-9)
    x, y = x * stretch, y * stretch
    radius, angle = numpy.hypot(x, y), numpy.arctan2(y, x)
    inside = radius < 1 - 1e-9
    z = 0.45 * radius * numpy.cos(3 * angle)
    z += inside * numpy.random.default_rng(1).normal(scale=0.03, size=x.size)
    corner = numpy.arange(side * side).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:],
                                            corner[1:, :-1]))
    return (numpy.stack([x, y, z], axis=1),
            numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)]))


def in_charts(vertices, faces, count=14):
    """Cuts a mesh as texture charts do: each chart has vertices and a colour of its own. Also returns the properties of
    the vertices."""
    seeds = numpy.random.default_rng(3).choice(len(vertices), count, replace=False)
    centroids = vertices[faces].mean(axis=1)
    chart = numpy.linalg.norm(centroids[:, None] - vertices[seeds], axis=2).argmin(axis=1)
    keys, corners = numpy.unique(chart[:, None] * len(vertices) + faces, return_inverse=True)
    chart = keys // len(vertices)
    colours = 185 + 60 * numpy.cos(2 * numpy.pi * (0.618 * chart + numpy.array([[0], [1 / 3], [2 / 3]])))
    properties = dict(zip(["red", "green", "blue", "chart"], [*colours.astype("u1"), chart.astype("u1")]))
    return vertices[keys % len(vertices)], corners.reshape(-1, 3), properties


def with_patch(vertices, faces):
    """Flattens a disc on the belly of the bear, as a closed hole is, and returns strengths that fade
    around it, and whether vertices are in it or near it."""
    middle = vertices[numpy.argmax(vertices[:, 2] - 3 * abs(vertices[:, :2] - [0, 0]).sum(axis=1))]
    distance = numpy.linalg.norm(vertices - middle, axis=1)
    radius = 0.12 * numpy.ptp(vertices, axis=0).max()
    rim = vertices[(distance > 0.9 * radius) & (distance < 1.1 * radius)]
    centre = rim.mean(axis=0)
    normal = numpy.linalg.svd(rim - centre)[2][2]
    inside = distance < radius
    patched = vertices.copy()
    patched[inside] -= ((vertices[inside] - centre) @ normal)[:, None] * normal
    return patched, numpy.clip(2 - distance / radius, 0, 1), (distance < 1.15 * radius).astype("u1")


def make_inputs(meshes, work):
    part, part_faces = read_off(meshes / "fandisk.off")
    write_ply(work / "noisy_part.ply", with_noise(part, part_faces, 0.2), part_faces)
    lion, lion_faces = read_off(meshes / "lion-head.off")
    write_ply(work / "lion.ply", lion, lion_faces)
    write_ply(work / "noisy_lion.ply", with_noise(lion, lion_faces, 0.15, local=True), lion_faces)
    write_ply(work / "frame.ply", *frame())
    bear, bear_faces = read_off(meshes / "bear.off")
    write_ply(work / "bear.ply", bear, bear_faces)
    write_ply(work / "half_bear.ply", with_bumps(bear, bear_faces), bear_faces, left=(bear[:, 0] < 0).astype("u1"))
    bunny, bunny_faces = read_off(meshes / "bunny00.off")
    low, high = bunny[:, 0].min(), bunny[:, 0].max()
    write_ply(work / "faded_bunny.ply", with_bumps(bunny, bunny_faces), bunny_faces,
              fading=numpy.clip((bunny[:, 0] - low) / (high - low), 0, 1))
    patched, around, hole = with_patch(bear, bear_faces)
    write_ply(work / "patched_bear.ply", patched, bear_faces, around=around, hole=hole)
    lion, lion_faces, properties = in_charts(lion, lion_faces)
    write_ply(work / "charts.ply", lion, lion_faces, **properties)


def commands_of(page):
    """Returns the arguments of the page's commands, in their order."""
    blocks = re.findall(r"^```sh\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    return [shlex.split(line)[1:] for line in lines if line.startswith("tracked_mcf ")]


def positions(path):
    properties = read_ply(path)
    return numpy.stack([properties[axis] for axis in "xyz"], axis=1)


def noise_left(clean, noisy, smoothed):
    """Returns the noise along the normals that is left, as a share of the noise before."""
    vertices, faces = read_off(clean)
    normals = normals_of(vertices, faces)
    before, after = (((positions(path) - vertices) * normals).sum(axis=1).std() for path in (noisy, smoothed))
    return after / before


def smooth_charts_alone(tool, meshes, work):
    """Smooths each chart of charts.ply as a mesh of its own, by the same detail size."""
    charts, faces, properties = in_charts(*read_off(meshes / "lion-head.off"))
    size, moved = 0.06 * diagonal_of(charts), charts.copy()
    for i in numpy.unique(properties["chart"]):
        inside = properties["chart"] == i
        index = numpy.cumsum(inside) - 1
        write_ply(work / "chart.ply", charts[inside], index[faces[inside[faces[:, 0]]]])
        subprocess.run([tool, "chart.ply", "chart.ply", "--boundary", "free", "--detail-size", str(size), "--quiet"],
                       cwd=work, check=True)
        moved[inside] = positions(work / "chart.ply")
    write_ply(work / "charts_alone.ply", moved, faces, **properties)


def moved_share(before, after):
    """Returns how far each vertex has moved, as a share of the diagonal."""
    return numpy.linalg.norm(positions(after) - positions(before), axis=1) / diagonal_of(positions(before))


def widest_gap(before, after):
    """Returns the largest extent of the vertices that were at one place, as a share of the diagonal."""
    old, new = positions(before), positions(after)
    _, place = numpy.unique(old, axis=0, return_inverse=True)
    low, high = numpy.full((2, place.max() + 1, 3), [[[numpy.inf]], [[-numpy.inf]]])
    assert len(low) < 0.95 * len(old), "there are no seams"
    numpy.minimum.at(low, place.ravel(), new)
    numpy.maximum.at(high, place.ravel(), new)
    return numpy.linalg.norm(high - low, axis=1).max() / diagonal_of(old)


def expect(page, text):
    """The page breaks lines anywhere."""
    assert text in " ".join(page.split()), f"the page does not say: {text}"


def check_results(meshes, work, page):
    """Checks what the page says of the results."""
    assert noise_left(meshes / "fandisk.off", work / "noisy_part.ply", work / "part.ply") < 0.5
    assert noise_left(meshes / "lion-head.off", work / "noisy_lion.ply", work / "clean_lion.ply") < 0.6
    moved = moved_share(work / "half_bear.ply", work / "half.ply")
    stays = read_ply(work / "half_bear.ply")["left"] == 0
    assert (moved[stays] == 0).all()
    expect(page, f"The others moved by up to {100 * moved.max():.1f} % of the diagonal")
    moved = moved_share(work / "faded_bunny.ply", work / "faded.ply")
    strength = read_ply(work / "faded_bunny.ply")["fading"]
    assert (moved[strength == 0] == 0).all()
    much, little = (100 * numpy.sqrt((moved[part]**2).mean()) for part in (strength > 2 / 3, strength < 1 / 3))
    expect(page, f"above 2/3, vertices moved by {much:.2f} % of the diagonal (RMS); where it is below 1/3, by "
           f"{little:.2f} %")
    assert widest_gap(work / "charts.ply", work / "charts.ply") == 0
    assert widest_gap(work / "charts.ply", work / "smooth_charts.ply") == 0
    gap = widest_gap(work / "charts.ply", work / "charts_alone.ply")
    expect(page, f"gaps of up to {100 * gap:.1f} % of the diagonal")
    bear, flat, fair = (positions(work / f"{name}.ply") for name in ("bear", "patched_bear", "fair_bear"))
    inside = read_ply(work / "patched_bear.ply")["hole"] != 0
    assert (fair[~inside] == bear[~inside]).all()
    before, after = (numpy.linalg.norm(shape - bear, axis=1).max() for shape in (flat, fair))
    assert after < 0.5 * before, (before, after)
    film, rim = positions(work / "film.ply"), positions(work / "frame.ply")
    on_rim = numpy.hypot(rim[:, 0], rim[:, 1]) > 1 - 1e-9
    assert (film[on_rim] == rim[on_rim]).all()
    x, y = film[:, 0], film[:, 1]
    # The minimal surface is near the harmonic function with this rim.
    assert abs(film[:, 2] - 0.45 * (x**3 - 3 * x * y**2)).max() < 0.1
    sphere = positions(work / "sphere.ply")
    radii = numpy.linalg.norm(sphere - sphere.mean(axis=0), axis=1)
    assert radii.std() < 0.1 * radii.mean()
    assert len(list(work.glob("sphere_*.ply"))) == 25
    assert read_ply(work / "curved.ply")["quality"].std() > 0


def draw(output, *meshes, options=()):
    subprocess.run([TOP / "tests" / "demo" / "render.py", "--output", output, "--height", "600",
                    *options, "--", *meshes], check=True)


def mix(scale, at):
    """Returns the colours of numbers from 0 to 1."""
    stops = numpy.linspace(0, 1, len(scale))
    return numpy.stack([numpy.interp(at, stops, channel) for channel in numpy.transpose(scale)]).round().astype("u1")


def paint(path, vertices, faces, scale, at):
    red, green, blue = mix(scale, at)
    write_ply(path, vertices, faces, red=red, green=green, blue=blue)
    return path


def write_strip(path, width, label, scale=None, ends=()):
    """Draws the strip below a surface: a label, and a bar of colours with what its two ends mean."""
    bar, length = path.with_suffix(".ppm"), 200
    strip = ["convert", "-size", f"{width}x64", "xc:white", "-font", "DejaVu-Sans", "-pointsize", "17",
             "-fill", "#333333", "-gravity", "north", "-annotate", "+0+6", label.replace("%", "%%")]
    if scale is not None:
        rows = numpy.tile(mix(scale, numpy.linspace(0, 1, length)).T, (14, 1, 1))
        bar.write_bytes(f"P6 {length} 14 255\n".encode() + rows.tobytes())
        strip += [bar, "-geometry", "+0+38", "-composite",
                  "-gravity", "northeast", "-annotate", f"+{(width + length) // 2 + 8}+35", ends[0],
                  "-gravity", "northwest", "-annotate", f"+{(width + length) // 2 + 8}+35", ends[1]]
    subprocess.run([*strip, path], check=True)


def draw_with_strips(output, work, panels, options=()):
    """Draws meshes side by side; a panel is a mesh and the arguments of its strip."""
    surfaces = work / "surfaces.png"
    draw(surfaces, *(mesh for mesh, *_ in panels), options=options)
    width = int(subprocess.check_output(["identify", "-format", "%w", surfaces]))
    strips = [work / f"strip_{i}.png" for i in range(len(panels))]
    for path, (_, *strip) in zip(strips, panels):
        write_strip(path, width // len(panels), *strip)
    subprocess.run(["convert", surfaces, "(", *strips, "+append", ")", "-append", "-strip", f"PNG24:{output}"],
                   check=True)


def draw_moved(output, work, faces, before, after, *panel, options=()):
    """Draws the panel, the surface after, and how far it has moved."""
    moved = moved_share(before, after)
    painted = paint(work / "moved.ply", positions(after), faces, RED, moved / moved.max())
    draw_with_strips(output, work, [panel, (after, "smoothed"), (
        painted, "how far it moved, in % of the diagonal", RED, ("0", f"{100 * moved.max():.1f}"))], options)


def draw_selection(meshes, work):
    _, faces = read_off(meshes / "bear.off")
    before = work / "half_bear.ply"
    selected = paint(work / "selected.ply", positions(before), faces, [PLASTER, SELECTED], read_ply(before)["left"])
    draw_moved(PICTURES / "selection.png", work, faces, before, work / "half.ply", selected, "selected faces are red",
               options=["--colours"])


def draw_strength(meshes, work):
    _, faces = read_off(meshes / "bunny00.off")
    before = work / "faded_bunny.ply"
    strength = paint(work / "strength.ply", positions(before), faces, BLUE, read_ply(before)["fading"])
    draw_moved(PICTURES / "strength.png", work, faces, before, work / "faded.ply", strength, "the strength", BLUE,
               ("0", "1"), options=["--colours", "--height", "480"])


def draw_seams(work):
    draw_with_strips(PICTURES / "seams.png", work, [
        (work / "charts.ply", "charts"), (work / "charts_alone.ply", "each chart smoothed alone"),
        (work / "smooth_charts.ply", "the charts in one file, smoothed")], options=["--colours"])


def draw_curvature(meshes, work):
    _, faces = read_off(meshes / "bear.off")
    quality = read_ply(work / "curved.ply")["quality"]
    most = numpy.percentile(abs(quality), 97)
    painted = paint(work / "coloured.ply", positions(work / "curved.ply"), faces, COLOURS,
                    (numpy.clip(quality / most, -1, 1) + 1) / 2)
    draw_with_strips(PICTURES / "curvature.png", work, [(work / "bear.ply", "as it is"), (
        painted, "mean curvature of the smoothed bear, 1 / unit", COLOURS, (f"-{most:.0f}", f"{most:.0f}"))],
        options=["--colours", "--height", "720"])


def draw_all(meshes, work):
    side = ["--view", "-0.6", "-0.15", "-1"]
    draw(PICTURES / "creases.png", work / "noisy_part.ply", work / "part.ply",
         options=["--flat", "--view", "1", "-0.8", "-1.2"])
    draw(PICTURES / "noise.png", work / "noisy_lion.ply", work / "clean_lion.ply", options=side)
    draw_selection(meshes, work)
    draw_strength(meshes, work)
    draw(PICTURES / "film.png", work / "frame.ply", work / "film.ply",
         options=["--view", "0.2", "1", "-0.6", "--up", "0", "0", "1"])
    draw_seams(work)
    draw(PICTURES / "hole.png", *(work / f"{name}.ply" for name in ("bear", "patched_bear", "blended", "fair_bear")),
         options=["--zoom", "2", "--center", "0", "-0.2", "--view", "0.5", "0", "-1", "--labels", "a belly",
                  "a flat patch", "blended by the flow", "faired"])
    draw(PICTURES / "ladder.png", work / "lion.ply", *(work / f"lion_{size}.ply" for size in (4, 8, 16)),
         options=[*side, "--labels", "as it is", "4 %", "8 %", "16 %"])
    draw_curvature(meshes, work)
    frames = []
    for i, mesh in enumerate([work / "bear.ply", *sorted(work.glob("sphere_*.ply"))]):
        picture = work / f"frame_{i:02d}.png"
        draw(picture, work / "bear.ply", mesh, options=["--zoom", "0.85", "--height", "400"])
        frames.append(picture)
    subprocess.run(["convert", "-delay", "12", *frames, "-gravity", "east", "-crop", "50%x100%+0+0",
                    "+repage", "-resize", "320x", "-set", "delay", "12", "-colors", "32", "+dither",
                    "-loop", "0", "-layers", "optimize", PICTURES / "sphere.gif"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tool", type=pathlib.Path)
    parser.add_argument("meshes", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--pictures", action="store_true")
    arguments = parser.parse_args()
    work = arguments.work
    work.mkdir(parents=True, exist_ok=True)
    for old in work.glob("*"):
        old.unlink()
    make_inputs(arguments.meshes, work)
    page = (PICTURES / "README.md").read_text(encoding="utf-8")
    commands = commands_of(page)
    assert len(commands) >= 7, "the page has lost commands"
    for command in commands:
        print("tracked_mcf", *command, flush=True)
        run = subprocess.run([arguments.tool.resolve(), *command, "--quiet"], cwd=work, check=True,
                             stderr=subprocess.PIPE, text=True)
        # Large detail is much of the area.
        warnings = [line for line in run.stderr.splitlines() if "The flow has removed" not in line]
        assert not warnings, warnings
    smooth_charts_alone(arguments.tool.resolve(), arguments.meshes, work)
    check_results(arguments.meshes, work, page)
    if arguments.pictures:
        draw_all(arguments.meshes, work)
    for picture in re.findall(r"!\[[^]]*\]\(([^)]+)\)", page):
        assert (PICTURES / picture).exists(), f"{picture} is missing; run with --pictures"


if __name__ == "__main__":
    sys.exit(main())
