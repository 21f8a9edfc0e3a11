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
PICTURES = TOP / "filter_tracked_mcf" / "pictures"
COLOURS = numpy.array([[40, 80, 200], [235, 232, 225], [200, 50, 40]])  # negative, 0, positive


def read_off(path):
    words = path.read_text(encoding="ascii").split()
    count, faces = int(words[1]), int(words[2])
    vertices = numpy.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    rows = numpy.array(words[4 + 3 * count:4 + 3 * count + 4 * faces], int).reshape(-1, 4)
    return vertices, rows[:, 1:]


def read_ply(path):
    """Returns the properties of the vertices of a binary file by name."""
    header, _, data = path.read_bytes().partition(b"end_header\n")
    lines = header.decode().split("element vertex ")[1].split("element face")[0].splitlines()
    types = {"double": "<f8", "float": "<f4", "uchar": "u1"}
    rows = [line.split() for line in lines[1:] if line.startswith("property")]
    rows = numpy.frombuffer(data, [(name, types[kind]) for _, kind, name in rows], int(lines[0]))
    return {name: rows[name] for name in rows.dtype.names}


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
    """Cuts a mesh as texture charts do: each chart has vertices and a colour of its own."""
    seeds = numpy.random.default_rng(3).choice(len(vertices), count, replace=False)
    centroids = vertices[faces].mean(axis=1)
    chart = numpy.linalg.norm(centroids[:, None] - vertices[seeds], axis=2).argmin(axis=1)
    keys, corners = numpy.unique(chart[:, None] * len(vertices) + faces, return_inverse=True)
    colours = 150 + 25 * numpy.stack([numpy.arange(count) * i % 5 for i in (1, 2, 3)], axis=1)
    return (vertices[keys % len(vertices)], corners.reshape(-1, 3),
            colours[keys // len(vertices)].astype("u1").T)


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
    write_ply(work / "half_lion.ply", lion, lion_faces,
              right=(lion[:, 0] > numpy.median(lion[:, 0])).astype("u1"))
    low, high = numpy.percentile(lion[:, 1], [25, 60])
    write_ply(work / "faded_lion.ply", lion, lion_faces,
              below=numpy.clip((high - lion[:, 1]) / (high - low), 0, 1))
    write_ply(work / "frame.ply", *frame())
    bear, bear_faces = read_off(meshes / "bear.off")
    write_ply(work / "bear.ply", bear, bear_faces)
    patched, around, hole = with_patch(bear, bear_faces)
    write_ply(work / "patched_bear.ply", patched, bear_faces, around=around, hole=hole)
    lion, lion_faces, (red, green, blue) = in_charts(lion, lion_faces)
    write_ply(work / "charts.ply", lion, lion_faces, red=red, green=green, blue=blue)


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
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normals = numpy.zeros_like(vertices)
    for i in range(3):
        numpy.add.at(normals, faces[:, i], numpy.cross(b - a, c - a))
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]
    before, after = (((positions(path) - vertices) * normals).sum(axis=1).std() for path in (noisy, smoothed))
    return after / before


def check_results(meshes, work):
    """Checks what the page says of the results."""
    assert noise_left(meshes / "fandisk.off", work / "noisy_part.ply", work / "part.ply") < 0.5
    assert noise_left(meshes / "lion-head.off", work / "noisy_lion.ply", work / "clean_lion.ply") < 0.6
    lion = positions(work / "lion.ply")
    moved = numpy.linalg.norm(positions(work / "half.ply") - lion, axis=1)
    stays = read_ply(work / "half_lion.ply")["right"] == 0
    assert (moved[stays] == 0).all() and moved[~stays].max() > 0
    moved = numpy.linalg.norm(positions(work / "faded.ply") - lion, axis=1)
    strength = read_ply(work / "faded_lion.ply")["below"]
    assert (moved[strength == 0] == 0).all() and moved[strength == 1].max() > 0
    before, after = positions(work / "charts.ply"), positions(work / "smooth_charts.ply")
    assert len(numpy.unique(before, axis=0)) < 0.95 * len(before), "there are seams"
    assert len(numpy.unique(numpy.hstack([before, after]), axis=0)) == len(numpy.unique(before, axis=0))
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


def colour_by_quality(meshes, work):
    _, faces = read_off(meshes / "bear.off")
    quality = read_ply(work / "curved.ply")["quality"]
    at = numpy.clip(quality / numpy.percentile(abs(quality), 97), -1, 1)
    mixed = numpy.stack([numpy.interp(at, [-1, 0, 1], channel) for channel in COLOURS.T])
    red, green, blue = mixed.astype("u1")
    write_ply(work / "coloured.ply", positions(work / "curved.ply"), faces, red=red, green=green, blue=blue)


def draw_all(meshes, work):
    side = ["--view", "-0.6", "-0.15", "-1"]
    draw(PICTURES / "creases.png", work / "noisy_part.ply", work / "part.ply",
         options=["--flat", "--view", "1", "-0.8", "-1.2"])
    draw(PICTURES / "noise.png", work / "noisy_lion.ply", work / "clean_lion.ply", options=side)
    draw(PICTURES / "selection.png", work / "lion.ply", work / "half.ply")
    draw(PICTURES / "strength.png", work / "lion.ply", work / "faded.ply", options=side)
    draw(PICTURES / "film.png", work / "frame.ply", work / "film.ply",
         options=["--view", "0.2", "1", "-0.6", "--up", "0", "0", "1"])
    draw(PICTURES / "seams.png", work / "charts.ply", work / "smooth_charts.ply", options=["--colours"])
    draw(PICTURES / "hole.png", *(work / f"{name}.ply" for name in ("bear", "patched_bear", "blended", "fair_bear")),
         options=["--zoom", "2", "--center", "0", "-0.2", "--view", "0.5", "0", "-1", "--labels", "a belly",
                  "a flat patch", "blended by the flow", "faired"])
    draw(PICTURES / "ladder.png", work / "lion.ply", *(work / f"lion_{size}.ply" for size in (4, 8, 16)),
         options=[*side, "--labels", "as it is", "4 %", "8 %", "16 %"])
    colour_by_quality(meshes, work)
    draw(PICTURES / "curvature.png", work / "bear.ply", work / "coloured.ply", options=["--colours"])
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
        assert not run.stderr, run.stderr
    check_results(arguments.meshes, work)
    if arguments.pictures:
        draw_all(arguments.meshes, work)
    for picture in re.findall(r"!\[[^]]*\]\(([^)]+)\)", page):
        assert (PICTURES / picture).exists(), f"{picture} is missing; run with --pictures"


if __name__ == "__main__":
    sys.exit(main())
