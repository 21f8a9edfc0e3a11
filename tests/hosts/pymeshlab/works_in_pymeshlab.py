#!/usr/bin/env python3
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

# What a script writes, and what the tool is given.
RUNS = [
    ({}, []),
    ({**COARSE, "step_size": 3e-5}, [*COARSE_OPTIONS, "--step-size", "3e-5"]),
    ({**COARSE, "step_size": 0.001, "absolute": True},
     [*COARSE_OPTIONS, "--step-size", "0.001", "--absolute"]),
    ({**COARSE, "flow": "Conformalized"}, [*COARSE_OPTIONS, "--flow", "conformalized"]),
    ({**COARSE, "boundary": "Locked cells (paper)"}, [*COARSE_OPTIONS, "--boundary", "locked-cells"]),
    ({**COARSE, "boundary": 2, "rescale": "Keep area", "selected": False},
     [*COARSE_OPTIONS, "--boundary", "free", "--rescale", "area"]),
    ({**COARSE, "separate_sheets": False}, [*COARSE_OPTIONS, "--separate-sheets", "off"]),
    ({**COARSE, "solver": "One W-cycle (paper)"}, [*COARSE_OPTIONS, "--solver", "w-cycle"]),
]

# What must be refused, and a word of the message.
WRONG = [
    ({"depth": -1}, "depth is -1"),
    ({"depth": 13}, "depth is 13"),
    ({"depth": 3.0}, "cast"),
    ({"iterations": 0}, "iterations is 0"),
    ({"step_size": 0.0}, "step_size is 0"),
    ({"step_size": -1e-5}, "step_size is -"),
    ({"step_size": math.nan}, "step_size is nan"),
    ({"step_size": math.inf}, "step_size is inf"),
    ({"step_size": math.nan, "absolute": True}, "step_size is nan"),
    ({"flow": "Sideways"}, "Possible values are 'Mean curvature'; 'Conformalized'"),
    ({"flow": 2}, "not valid"),
    ({"boundary": 3}, "not valid"),
    ({"rescale": -1}, "not valid"),
    ({"solver": "Magic"}, "Possible values"),
    ({"selected": True}, "No face is selected"),
    ({"rescale": "Keep volume", "boundary": "Free"}, "open"),
    ({"detph": 6}, "detph not found"),
]


def load(mesh):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    return meshes


def vertices(meshes):
    return meshes.current_mesh().vertex_matrix()


def compare(tool, mesh, work):
    """The largest difference to the tool, over all RUNS."""
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
    types = {"depth": int, "steps": int, "unknowns": int, "final_residual": float,
             "area_before": float, "area_after": float}
    if {name: type(value) for name, value in outputs.items()} != types:
        sys.exit(f"unexpected outputs: {outputs}")
    if outputs["steps"] != parameters.get("iterations", 10) or outputs["unknowns"] < 100:
        sys.exit(f"wrong outputs: {outputs}")


def must_refuse(plugin, mesh, parameters, word):
    """In a process of its own: a filter that fails leaves PyMeshLab with a dangling log."""
    pymeshlab.load_plugin(plugin)
    meshes = load(mesh)
    before = vertices(meshes)
    try:
        meshes.apply_filter(FILTER, **parameters)
        sys.exit(f"{parameters} was accepted")
    except Exception as error:  # PyMeshLab has three kinds without a common base
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
    """Where faces are selected, a script that says nothing smooths these alone."""
    meshes = load(mesh)
    meshes.set_selection_all()
    meshes.apply_selection_erosion()
    before = vertices(meshes)
    meshes.apply_filter(FILTER, **COARSE)
    moved = (vertices(meshes) != before).any(axis=1)
    if not 0 < moved.sum() < len(moved):
        sys.exit(f"{moved.sum()} of {len(moved)} vertices moved")


def check_readme(plugin, tool, readme, mesh, work):
    """The README's script must do what the tool does by default."""
    text = pathlib.Path(readme).read_text(encoding="utf-8")
    script = text.split("```python\n")[1].split("```")[0]
    for name in ("libfilter_tracked_mcf.so", "smooth.ply"):
        (work / name).unlink(missing_ok=True)
    (work / "libfilter_tracked_mcf.so").symlink_to(pathlib.Path(plugin).resolve())
    load(mesh).save_current_mesh(str(work / "scan.ply"))
    subprocess.run([sys.executable, "-c", script], cwd=work, check=True)
    subprocess.run([tool, work / "scan.ply", work / "tool.ply", "--quiet"], check=True)
    if (vertices(load(work / "smooth.ply")) != vertices(load(work / "tool.ply"))).any():
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
    check_selection(meshes[0])
    refuse_all(plugin, meshes[0])


if __name__ == "__main__":
    main(*sys.argv[1:])
