#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the plugin in PyMeshLab as a script does, and compares with the command-line tool:
works_in_pymeshlab.py PLUGIN TOOL README WORK_DIR MESH...

Ends with 77, which tells CTest that the test was skipped, where there is no PyMeshLab.
"""

import math
import multiprocessing
import pathlib
import subprocess
import sys

try:
    import pymeshlab
except ImportError:
    print("skipped: this Python has no module pymeshlab (pip install pymeshlab, or PYTHONPATH)")
    sys.exit(77)

FILTER = "apply_coord_mean_curvature_flow"
COARSE = {"depth": 6, "iterations": 5}
COARSE_OPTIONS = ["--depth", "6", "--iterations", "5"]

# A script's arguments, and the tool's.
RUNS = [
    ({}, []),
    ({**COARSE, "detail_size": pymeshlab.PercentageValue(1.5)},
     [*COARSE_OPTIONS, "--detail-size", "1.5%"]),
    ({**COARSE, "detail_size": pymeshlab.PureValue(0.125)},
     [*COARSE_OPTIONS, "--detail-size", "0.125"]),
    ({**COARSE, "local_detail_size": True}, [*COARSE_OPTIONS, "--local-detail-size"]),
    ({**COARSE, "order": "Kept (order 2)"}, [*COARSE_OPTIONS, "--order", "2"]),
    ({**COARSE, "order": 2}, [*COARSE_OPTIONS, "--order", "3"]),
    ({**COARSE, "order": "Kept best (order 4)", "preserve": 2},
     [*COARSE_OPTIONS, "--order", "4", "--preserve", "volume"]),
    ({**COARSE, "step_size": 3e-5}, [*COARSE_OPTIONS, "--step-size", "3e-5"]),
    ({**COARSE, "step_size": 0.001, "absolute": True},
     [*COARSE_OPTIONS, "--step-size", "0.001", "--absolute"]),
    ({**COARSE, "flow": "Conformalized"}, [*COARSE_OPTIONS, "--flow", "conformalized"]),
    ({**COARSE, "boundary": "Locked cells (paper)"}, [*COARSE_OPTIONS, "--boundary", "locked-cells"]),
    ({**COARSE, "boundary": 2, "preserve": "Area", "selected": False},
     [*COARSE_OPTIONS, "--boundary", "free", "--preserve", "area"]),
    ({**COARSE, "boundary": "Free", "preserve": "Volume"},
     [*COARSE_OPTIONS, "--boundary", "free", "--preserve", "volume"]),
    ({**COARSE, "separate_sheets": False}, [*COARSE_OPTIONS, "--separate-sheets", "off"]),
    ({**COARSE, "solver": "One W-cycle (paper)"}, [*COARSE_OPTIONS, "--solver", "w-cycle"]),
]

# Invalid arguments, and a word of the expected message.
WRONG = [
    ({"depth": -1}, "depth is -1"),
    ({"depth": 13}, "depth is 13"),
    ({"depth": 3.0}, "cast"),
    ({"iterations": 0}, "iterations is 0"),
    ({"detail_size": pymeshlab.PureValue(-1)}, "detail_size is -"),
    ({"detail_size": pymeshlab.PercentageValue(math.nan)}, "detail_size is nan"),
    ({"order": 4}, "not valid"),
    ({"order": -1}, "not valid"),
    ({"order": "Best"}, "Possible values"),
    ({"step_size": -1e-5}, "step_size is -"),
    ({"step_size": math.nan}, "step_size is nan"),
    ({"step_size": math.inf}, "step_size is inf"),
    ({"step_size": math.nan, "absolute": True}, "step_size is nan"),
    ({"flow": "Sideways"}, "Possible values are 'Mean curvature'; 'Conformalized'"),
    ({"flow": 2}, "not valid"),
    ({"boundary": 3}, "not valid"),
    ({"preserve": -1}, "not valid"),
    ({"quality": 3}, "not valid"),
    ({"quality": "Mean curvature", "flow": "Conformalized"}, "mean curvature"),
    ({"solver": "Magic"}, "Possible values"),
    ({"selected": True}, "No face is selected"),
    ({"preserve": "Volume", "flow": "Conformalized", "boundary": "Free"}, "open"),
    ({"preserve": "Area"}, "Preserving the area"),
    ({"detph": 6}, "detph not found"),
]


def load(mesh):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    return meshes


def vertices(meshes):
    return meshes.current_mesh().vertex_matrix()


def compare(tool, mesh, work):
    """Returns the largest difference from the tool over all RUNS."""
    largest = 0
    for parameters, options in RUNS:
        meshes = load(mesh)
        before = vertices(meshes)
        outputs = meshes.apply_filter(FILTER, **parameters)
        check_outputs(outputs, parameters)
        subprocess.run([tool, mesh, work / "tool.ply", "--quiet", *options], check=True)
        expected = vertices(load(work / "tool.ply"))
        extent = abs(before).max()
        difference = abs(vertices(meshes) - expected).max() / extent
        movement = abs(before - expected).max() / extent
        print(f"{mesh.stem} {parameters}: difference {difference:.1e}, movement {movement:.1e}, "
              f"of the largest coordinate; {outputs}")
        if not difference <= 1e-6 < 100 * movement:
            sys.exit("the positions differ, or nothing has moved")
        largest = max(largest, difference)
    return largest


def check_outputs(outputs, parameters):
    types = {**dict.fromkeys(("depth", "steps", "unknowns", "stopped_early", "converged"), int),
             **dict.fromkeys(("detail_size", "step_size", "cell_size", "error_estimate",
                              "largest_displacement", "rms_displacement", "area_before",
                              "area_after", "volume_change"), float)}
    if {name: type(value) for name, value in outputs.items()} != types:
        sys.exit(f"unexpected outputs: {outputs}")
    if outputs["steps"] != parameters.get("iterations", 3) or outputs["unknowns"] < 100:
        sys.exit(f"wrong outputs: {outputs}")


def must_refuse(plugin, mesh, parameters, word):
    """Runs in a separate process: a filter that fails leaves PyMeshLab with a dangling log."""
    pymeshlab.load_plugin(plugin)
    meshes = load(mesh)
    before = vertices(meshes)
    try:
        meshes.apply_filter(FILTER, **parameters)
        sys.exit(f"{parameters} was accepted")
    except Exception as error:  # PyMeshLab has three exception types without a common base
        if word not in str(error):
            sys.exit(f"{parameters}: '{word}' is not in: {error}")
        print(f"refused {parameters}: {error}")
    if vertices(meshes).tobytes() != before.tobytes():
        sys.exit(f"{parameters}: the mesh was changed")


def refuse_all(plugin, mesh):
    for case in WRONG:
        process = multiprocessing.get_context("spawn").Process(
            target=must_refuse, args=(plugin, mesh, *case))
        process.start()
        process.join()
        if process.exitcode != 0:
            sys.exit(f"not refused as it should: {case}")


def check_selection(mesh):
    """By default, a script smooths the selected faces alone if there are any."""
    meshes = load(mesh)
    meshes.set_selection_all()
    meshes.apply_selection_erosion()
    before = vertices(meshes)
    meshes.apply_filter(FILTER, **COARSE)
    moved = (vertices(meshes) != before).any(axis=1)
    if not 0 < moved.sum() < len(moved):
        sys.exit(f"{moved.sum()} of {len(moved)} vertices moved")


def check_quality(tool, mesh, work):
    """The vertices' quality must be that of the tool."""
    for name, option in (("Displacement", "displacement"), ("Mean curvature", "mean-curvature")):
        meshes = load(mesh)
        meshes.apply_filter(FILTER, **COARSE, quality=name)
        subprocess.run([tool, mesh, work / "tool.ply", "--quiet", *COARSE_OPTIONS,
                        "--quality", option], check=True)
        expected = load(work / "tool.ply").current_mesh().vertex_scalar_array()
        difference = abs(meshes.current_mesh().vertex_scalar_array() - expected).max()
        if not difference <= 1e-6 * abs(expected).max():
            sys.exit(f"the quality '{name}' differs by {difference}")


def check_readme(plugin, tool, readme, mesh, work):
    """The result of the README's script must be that of the tool with the script's detail size."""
    text = pathlib.Path(readme).read_text(encoding="utf-8")
    script = text.split("```python\n")[1].split("```")[0]
    for name in ("libfilter_tracked_mcf.so", "smooth.ply"):
        (work / name).unlink(missing_ok=True)
    (work / "libfilter_tracked_mcf.so").symlink_to(pathlib.Path(plugin).resolve())
    load(mesh).save_current_mesh(str(work / "scan.ply"))
    subprocess.run([sys.executable, "-c", script], cwd=work, check=True)
    subprocess.run([tool, work / "scan.ply", work / "tool.ply", "--quiet", "--detail-size", "0.5%"],
                   check=True)
    expected = vertices(load(work / "tool.ply"))
    # The two may round the percentage differently.
    if not abs(vertices(load(work / "smooth.ply")) - expected).max() <= 1e-6 * abs(expected).max():
        sys.exit("the README's script does not do what the tool does")


def main(plugin, tool, readme, work, *meshes):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    check_readme(plugin, tool, readme, meshes[0], work)
    pymeshlab.load_plugin(plugin)
    for mesh in map(pathlib.Path, meshes):
        differences = work.with_name(f"{work.name}.{mesh.stem}") / "differences.txt"
        differences.parent.mkdir(exist_ok=True)
        largest = compare(tool, mesh, work)
        differences.write_text(f"largest difference {largest:.3g} of the largest coordinate\n",
                               encoding="ascii")
    check_quality(tool, meshes[0], work)
    check_selection(meshes[0])
    refuse_all(plugin, meshes[0])


if __name__ == "__main__":
    main(*sys.argv[1:])
