# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of the filter in which every host must do what the program does. Each host takes the table from here.

A run has the parameters that differ from COARSE, in the program's words. DETAIL and STEP stand for a length and a
step size that suit the mesh.
"""

import struct

# Each length is given: a dialog begins with one that the host rounds to a float.
COARSE = "depth=6 iterations=5 detail_size=0"

RUNS = [
    "",
    "detail_size=DETAIL",
    "iterations=2",
    "order=1",
    "order=4",
    "step_size=STEP",
    "depth=5",
    "boundary=free",
    "flow=conformalized",
    "method=paper",
    "method=paper boundary=free",
    "strength=true",
    "quality=displacement",
    "quality=mean-curvature",
    "preserve=volume",
    "preserve=volume order=1 boundary=free",
    # Hosts must refuse these where the program does, as it does on meshes with a boundary.
    "preserve=area",
    "preserve=area boundary=free flow=conformalized",
    "preserve=volume boundary=free flow=conformalized",
]

# The values of each choice, in the order of the hosts' indices.
CHOICES = {
    "boundary": ["locked", "free"],
    "flow": ["mean-curvature", "conformalized"],
    "method": ["converged", "paper"],
    "preserve": ["none", "area", "volume"],
    "quality": ["none", "displacement", "mean-curvature"],
}


def as_float(number):
    """Returns a float near the number. Hosts round others, and the program does not."""
    return struct.unpack("f", struct.pack("f", number))[0]


def settings_of(run, detail_size):
    """Returns {name: value} of a run, as texts, for a mesh whose default detail size is that."""
    sizes = {"DETAIL": as_float(2 * detail_size), "STEP": as_float(detail_size**2 / 40)}
    pairs = (word.split("=") for word in f"{COARSE} {run}".split())
    return {name: repr(sizes[value]) if value in sizes else value for name, value in pairs}


def program_options(settings):
    """Returns the program's arguments. The strength is the PLY file's property `quality`."""
    for name, value in settings.items():
        yield "--" + name.replace("_", "-")
        if value != "true":
            yield value
        elif name == "strength":
            yield "quality"


def by_index(settings):
    """Returns the settings as filter scripts have them: the value of a choice is its index."""
    return {name: str(CHOICES[name].index(value)) if name in CHOICES else value
            for name, value in settings.items()}
