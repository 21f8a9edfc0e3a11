#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of the filters in which every host must do what the program does. Each host takes the table from here.
`runs.py COMMAND IN OUT.ply` writes the mesh of a filter's runs, and prints the program's options for the first one.

A run has the parameters that differ from those of COMMON, in the program's words. `6edges` stands for six mean edges,
`2squares` for two squared ones. add_switches() adds a run of each switch.
Each run has another result than the first one of its filter, the defaults, or is refused. The number of threads alone
has no effect.
"""

import math
import pathlib
import random
import re
import sys

import float_ply

# By the program's command: the filter's name in MeshLab.
FILTERS = {"smooth": "Mean Curvature Flow", "remove-noise": "Remove Noise", "fair": "Fair Selected Faces"}

# The detail size is given: a dialog begins with one that the host rounds to a float. Dialogs affect only selected
# faces by default.
COMMON = {"smooth": "depth=6 iterations=5 detail_size=0 selected=false", "remove-noise": "selected=false",
          "fair": "selected=true"}

RUNS = {
    "smooth": [
        "",
        "detail_size=6edges",
        "iterations=2",
        "order=1",
        "order=4",
        "detail_size=20edges depth=5",
        "step_size=.2squares",
        "boundary=free",
        "flow=conformalized",
        "method=paper",
        "method=paper boundary=free",
        "selected=true",
        "quality=displacement",
        "quality=mean-curvature",
        "preserve=volume",
        "preserve=volume order=1 boundary=free",
        # Hosts must refuse it where the program does, as it does on meshes with a boundary.
        "preserve=volume boundary=free flow=conformalized",
        "tolerance=1e-5",
        "threads=1",
    ],
    "remove-noise": [
        "",
        "crease_angle=40",
        "noise=.3edges",
        "noise_size=3edges",
        "detail_size=6edges",
        "largest_movement=.1edges",
        "boundary=locked",
        "boundary=smooth",
        "selected=true",
        "quality=displacement",
        # Hosts may differ by the rounding of what is computed before the limit, which must not be much less.
        "largest_movement=.3edges boundary=smooth selected=true quality=displacement",
        "threads=1",
    ],
    "fair": [
        "",
        "continuity=position",
        "continuity=curvature",
        "quality=displacement",
        "continuity=position quality=displacement",
        "continuity=curvature quality=displacement",
        "threads=1",
        "continuity=curvature threads=1",
    ],
}

# The tables of parameters. tests/presentation compares them with those of the filters.
PAGE = pathlib.Path(__file__).resolve().parents[2] / "filter_tracked_mcf/presentation/README.md"


def add_switches():
    """Adds a run for each switch that is off by default. tests/python checks that each other parameter has one."""
    for section in PAGE.read_text(encoding="utf-8").split("\n## "):
        for command, name in FILTERS.items():
            if not section.startswith(name + "\n"):
                continue
            defaults = dict(re.findall(r"^\|[^|]*\|[^|]*\| `(\w+)` \| ([^|]*) \|", section, re.MULTILINE))
            assert defaults, f"{PAGE} has no parameters of {name}"
            RUNS[command] += [f"{parameter}=true" for parameter, default in defaults.items() if default == "off"]


add_switches()

# Hosts of MeshLab do not offer these.
OF_THE_PROGRAM = {"tolerance", "threads"}

# The values of each choice, in the order of the hosts' indices.
CHOICES = {
    "boundary": ["locked", "free", "smooth"],
    "continuity": ["position", "tangent", "curvature"],
    "flow": ["mean-curvature", "conformalized"],
    "method": ["converged", "paper"],
    "preserve": ["none", "area", "volume"],
    "quality": ["none", "displacement", "mean-curvature"],
}

# Of the mesh of each filter: the standard deviation of the noise, in mean edges, and the share of the faces that are
# selected.
NOISE = {"smooth": 0, "remove-noise": 0.2, "fair": 0.2}
SELECTED = {"smooth": 0.4, "remove-noise": 0.4, "fair": 0.02}


def mean_edge(vertices, faces):
    lengths = [math.dist(vertices[a], vertices[b]) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    return float_ply.as_float(sum(lengths) / len(lengths))


def averaged(vertices, faces):
    """Returns the vertices, each at the mean of its faces' corners."""
    sums = {vertex: (0, 0, 0, 0) for vertex in vertices}
    for face in faces:
        corners = [vertices[corner] for corner in face]
        total = (*map(sum, zip(*corners)), len(face))
        for corner in corners:
            sums[corner] = tuple(a + b for a, b in zip(sums[corner], total))
    return [tuple(x / sums[vertex][3] for x in sums[vertex][:3]) if sums[vertex][3] else vertex for vertex in vertices]


def noisy(vertices, deviation):
    """Returns the vertices with noise. Vertices at the same place stay together."""
    source, places = random.Random(1), {}
    for vertex in vertices:
        if vertex not in places:
            places[vertex] = tuple(x + source.gauss(0, deviation) for x in vertex)
    return [places[vertex] for vertex in vertices]


def with_rough_patch(vertices, faces, selected, deviation):
    """Returns a smooth surface with noise at the inner vertices of the selected faces."""
    for _ in range(20):
        vertices = averaged(vertices, faces)
    outside = {vertices[corner] for face, flag in zip(faces, selected) if not flag for corner in face}
    return [old if old in outside else new for old, new in zip(vertices, noisy(vertices, deviation))]


def write_mesh(path, command, vertices, faces):
    """Writes a PLY file of a filter's runs. All hosts read the same bits from it.

    The mesh is open: the first vertex has lost its faces. The faces around one in the middle of the list are selected,
    by MeshLab's flags. The quality of the vertices, which is the strength, is from 0 to 1. Returns the mean edge."""
    faces = [face for face in faces if vertices[0] not in [vertices[corner] for corner in face]]
    middle = vertices[faces[len(faces) // 4][0]]
    distances = [max(math.dist(vertices[corner], middle) for corner in face) for face in faces]
    radius = sorted(distances)[int(SELECTED[command] * len(faces))]
    selected = [distance <= radius for distance in distances]
    edge = mean_edge(vertices, faces)
    if command == "fair":
        vertices = with_rough_patch(vertices, faces, selected, NOISE[command] * edge)
    else:
        vertices = noisy(vertices, NOISE[command] * edge)
    float_ply.write_ply(path, vertices, faces, [i % 5 / 4 for i in range(len(vertices))], selected)
    return edge


def settings_of(command, run, edge):
    """Returns {name: value} of a run, as texts, for a mesh with this mean edge."""
    def value_of(text):
        for unit, size in ("edges", edge), ("squares", edge * edge):
            if text.endswith(unit):
                return repr(float_ply.as_float(float(text[:-len(unit)]) * size))
        return text

    pairs = (word.split("=") for word in f"{COMMON[command]} {run}".split())
    return {name: value_of(value) for name, value in pairs}


def same_as_default(run):
    """Returns whether a run has the result of the defaults."""
    return run in ("", "threads=1")


def program_options(settings):
    """Returns the program's arguments."""
    properties = {"selected": "flags", "strength": "quality"}
    for name, value in settings.items():
        if value == "false":
            continue
        yield "--" + name.replace("_", "-")
        if value != "true" or name in properties:
            yield properties.get(name, value)


def by_index(command, settings):
    """Returns the settings as filter scripts have them: the value of a choice is its index."""
    return {name: str(CHOICES[name].index(value)) if name in CHOICES else value
            for name, value in settings.items() if (command, name) != ("fair", "selected")}


if __name__ == "__main__":
    mean = write_mesh(sys.argv[3], sys.argv[1], *float_ply.read_mesh(sys.argv[2]))
    print(*program_options(settings_of(sys.argv[1], "", mean)))
