#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the plugin in PyMeshLab as a script does, and compares with the command-line tool:
works_in_pymeshlab.py PLUGIN TOOL PAGE WORK_DIR MESH...

PLUGIN is the plugin's file, or else the name of the Python module that loads it. PAGE is the page with
the Python script for that. Ends with 77, which tells CTest that the test was skipped, where there is no
PyMeshLab.
"""

import importlib
import json
import math
import multiprocessing
import pathlib
import signal
import subprocess
import sys

try:
    import numpy
    import pymeshlab
except ImportError:
    print(f"skipped: {sys.executable} cannot import pymeshlab; external/pymeshlab.sh installs it")
    sys.exit(77)

FILTER = "apply_coord_mean_curvature_flow"
COARSE = {"depth": 6, "iterations": 5}
COARSE_OPTIONS = ["--depth", "6", "--iterations", "5"]

# A script's arguments, and the tool's. compare() adds a detail size that is not here.
RUNS = [
    ({}, []),
    ({**COARSE, "detail_size": pymeshlab.PercentageValue(1.5)}, COARSE_OPTIONS),
    ({**COARSE, "detail_size": pymeshlab.PureValue(0.125)},
     [*COARSE_OPTIONS, "--detail-size", "0.125"]),
    ({**COARSE, "local_detail_size": True}, [*COARSE_OPTIONS, "--local-detail-size"]),
    ({**COARSE, "order": 2}, [*COARSE_OPTIONS, "--order", "2"]),
    ({**COARSE, "order": 4, "preserve": 2},
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
    ({**COARSE, "method": "Shared cells"}, [*COARSE_OPTIONS, "--method", "shared-cells"]),
    ({**COARSE, "method": "Paper"}, [*COARSE_OPTIONS, "--method", "paper"]),
    ({**COARSE, "order": 2}, [*COARSE_OPTIONS, "--order", "2"]),
]

# Invalid arguments, and a word of the expected message.
WRONG = [
    ({"depth": -1}, "depth is -1"),
    ({"depth": 13}, "depth is 13"),
    ({"depth": 3.0}, "cast"),
    ({"iterations": 0}, "iterations is 0"),
    ({"detail_size": pymeshlab.PureValue(-1)}, "detail_size is -"),
    ({"detail_size": pymeshlab.PercentageValue(math.nan)}, "detail_size is nan"),
    ({"order": 0}, "order is 0; give 1 to 4"),
    ({"order": 5}, "order is 5; give 1 to 4"),
    ({"order": "Best"}, "cast"),
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
    ({"method": "Magic"}, "Possible values"),
    ({"selected": True}, "No face is selected"),
    ({"strength": True}, "no vertex quality"),
    ({"preserve": "Volume", "flow": "Conformalized", "boundary": "Free"}, "open"),
    ({"preserve": "Area"}, "Preserving the area"),
    ({"detph": 6}, "detph not found"),
]


def load(mesh):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    return meshes


# These take the set: a mesh of PyMeshLab dangles once its set is gone.
def vertices(meshes):
    return meshes.current_mesh().vertex_matrix()


def qualities(meshes):
    return meshes.current_mesh().vertex_scalar_array()


def load_plugin(plugin):
    """Returns a function that applies the filter."""
    if plugin.endswith(".so"):
        pymeshlab.load_plugin(plugin)
        return lambda meshes, **parameters: meshes.apply_filter(FILTER, **parameters)
    importlib.import_module(plugin)
    return getattr(pymeshlab.MeshSet, FILTER)


def passed_on(length):
    """Returns the length that the filter gets: PyMeshLab rounds to a float, and the filter takes the
    float's shortest decimal notation."""
    return str(numpy.float32(length))


def compare(apply, tool, mesh, work):
    """All RUNS must give the tool's bits. Returns the largest difference of a coordinate."""
    largest = 0
    for parameters, options in RUNS:
        meshes = load(mesh)
        before = vertices(meshes)
        outputs = apply(meshes, **parameters)
        check_outputs(outputs, parameters)
        if "step_size" not in parameters and "--detail-size" not in options:
            options = [*options, "--detail-size", passed_on(outputs["detail_size"])]
        subprocess.run([tool, mesh, work / "tool.ply", "--quiet", *options], check=True)
        expected = vertices(load(work / "tool.ply"))
        difference = abs(vertices(meshes) - expected).max() / abs(before).max()
        moved = (expected != before).any(axis=1).mean()
        print(f"{mesh.stem} {parameters}: difference {difference:.1e} of the largest coordinate, "
              f"{moved:.1%} of the vertices moved; {outputs}")
        if vertices(meshes).tobytes() != expected.tobytes():
            sys.exit("the positions differ from the tool's")
        if moved < 0.9:
            sys.exit("too few vertices have moved")
        largest = max(largest, difference)
    return largest


def warnings_of(outputs):
    """Returns the warnings as a list. Without the wheel, they are the codes of a text."""
    warnings = outputs["warnings"]
    if isinstance(warnings, numpy.ndarray):
        return bytes(warnings.astype("uint8")).decode().splitlines()
    return warnings


def check_outputs(outputs, parameters):
    types = {**dict.fromkeys(("depth", "steps", "unknowns", "stopped_early", "converged"), int),
             **dict.fromkeys(("detail_size", "step_size", "cell_size", "error_estimate",
                              "largest_displacement", "rms_displacement", "area_before",
                              "area_after", "volume_change"), float),
             "warnings": list}
    outputs = {**outputs, "warnings": warnings_of(outputs)}
    if {name: type(value) for name, value in outputs.items()} != types:
        sys.exit(f"unexpected outputs: {outputs}")
    if outputs["steps"] != parameters.get("iterations", 3) or outputs["unknowns"] < 100:
        sys.exit(f"wrong outputs: {outputs}")


def check_warnings(apply, mesh):
    """A run without trouble returns no warning; cells too wide for the detail size return one."""
    quiet = warnings_of(apply(load(mesh), detail_size=pymeshlab.PercentageValue(10), iterations=20))
    coarse = warnings_of(apply(load(mesh), depth=2, detail_size=pymeshlab.PercentageValue(1)))
    if quiet or len(coarse) != 1 or not coarse[0].startswith("The cells of depth 2 "):
        sys.exit(f"wrong warnings: {quiet} and {coarse}")


def check_turned_face(apply, work):
    """A mesh that is not oriented consistently has no change of volume, but the key is there."""
    (work / "turned.off").write_text(
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
        encoding="ascii")
    volume_change = apply(load(work / "turned.off"), depth=4)["volume_change"]
    if not math.isnan(volume_change):
        sys.exit(f"the volume changed by {volume_change}")


def must_refuse(plugin, mesh, case):
    """Runs in a separate process: a filter that fails leaves PyMeshLab with a dangling log. The process
    is told the case's number, because PyMeshLab's values cannot be passed."""
    parameters, word = WRONG[case]
    apply = load_plugin(plugin)
    meshes = load(mesh)
    before = vertices(meshes)
    try:
        apply(meshes, **parameters)
        sys.exit(f"{parameters} was accepted")
    except Exception as error:  # PyMeshLab has three exception types without a common base
        if word not in str(error):
            sys.exit(f"{parameters}: '{word}' is not in: {error}")
        if "dialog" in str(error) or "comma" in str(error):
            sys.exit(f"{parameters}: PyMeshLab has no dialog: {error}")
        print(f"refused {parameters}: {error}")
    if vertices(meshes).tobytes() != before.tobytes():
        sys.exit(f"{parameters}: the mesh was changed")


def run_apart(function, *arguments):
    """Returns the exit code of a process that calls the function. One that hangs is killed."""
    process = multiprocessing.get_context("spawn").Process(target=function, args=arguments)
    process.start()
    process.join(120)
    process.kill()
    process.join()
    return process.exitcode


def refuse_all(plugin, mesh):
    for case in range(len(WRONG)):
        if run_apart(must_refuse, plugin, mesh, case) != 0:
            sys.exit(f"not refused as it should: {WRONG[case]}")


def must_interrupt(plugin, mesh):
    """The handler of a signal runs during the flow. What it raises ends the flow, as Ctrl-C does."""
    apply = load_plugin(plugin)
    meshes = load(mesh)
    meshes.set_selection_all()
    parts = ("vertex_matrix", "vertex_normal_matrix", "face_normal_matrix", "vertex_scalar_array",
             "face_selection_array")
    bits = [getattr(meshes.current_mesh(), part)().tobytes() for part in parts]
    signals = []

    def handle(number, frame):
        signals.append(number)
        if len(signals) == 3:  # the others do not end the flow
            signal.default_int_handler(number, frame)

    signal.signal(signal.SIGALRM, handle)
    signal.setitimer(signal.ITIMER_REAL, 0.5, 0.5)
    try:
        apply(meshes, detail_size=pymeshlab.PureValue(1e-6), depth=7, iterations=1000000,
              quality="Displacement")
        sys.exit("the flow was not interrupted")
    except KeyboardInterrupt as error:
        if error.__context__:
            sys.exit(f"{error.__context__!r} came before KeyboardInterrupt")
    signal.setitimer(signal.ITIMER_REAL, 0)
    if [getattr(meshes.current_mesh(), part)().tobytes() for part in parts] != bits or len(signals) != 3:
        sys.exit(f"after {len(signals)} signals, the layer is not what it was")
    apply(meshes, **COARSE)
    if vertices(meshes).tobytes() == bits[0]:
        sys.exit("the filter does nothing after an interrupt")
    load(mesh)


def check_detail_size(apply, tool, mesh, work):
    """The default and a percentage must be the tool's, but for PyMeshLab's rounding."""
    quick = {"depth": 4, "iterations": 1}
    for parameters, option in (({}, []), ({"detail_size": pymeshlab.PercentageValue(1.5)},
                                          ["--detail-size", "1.5%"])):
        outputs = apply(load(mesh), **quick, **parameters)
        subprocess.run([tool, mesh, work / "tool.ply", "--quiet", "--depth", "4", "--iterations", "1",
                        *option, "--report", work / "tool.json"], check=True)
        expected = json.loads((work / "tool.json").read_text(encoding="utf-8"))["detail_size"]
        if not abs(outputs["detail_size"] / expected - 1) <= 1e-6:
            sys.exit(f"the detail size is {outputs['detail_size']} rather than {expected}")


def check_selection(apply, mesh):
    """By default, a script smooths the selected faces alone if there are any."""
    meshes = load(mesh)
    meshes.set_selection_all()
    meshes.apply_selection_erosion()
    before = vertices(meshes)
    apply(meshes, **COARSE)
    moved = (vertices(meshes) != before).any(axis=1)
    if not 0 < moved.sum() < len(moved):
        sys.exit(f"{moved.sum()} of {len(moved)} vertices moved")


def check_quality(apply, tool, mesh, work):
    """The vertices' quality must be that of the tool, bit for bit."""
    size = 0.125
    for name, option in (("Displacement", "displacement"), ("Mean curvature", "mean-curvature")):
        meshes = load(mesh)
        apply(meshes, **COARSE, quality=name, detail_size=pymeshlab.PureValue(size))
        subprocess.run([tool, mesh, work / "tool.ply", "--quiet", *COARSE_OPTIONS, "--quality", option,
                        "--detail-size", str(size)], check=True)
        expected = qualities(load(work / "tool.ply"))
        if qualities(meshes).tobytes() != expected.tobytes() or not expected.any():
            sys.exit(f"the quality '{name}' differs by {abs(qualities(meshes) - expected).max()}")


def smoothed(mesh):
    meshes = load(mesh)
    meshes.apply_filter(FILTER, **COARSE)
    return vertices(meshes).tobytes()


def check_fork(mesh):
    """A forked process must give the same bits as its parent, which has used several threads."""
    expected = smoothed(mesh)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        if pool.apply_async(smoothed, (mesh,)).get(timeout=120) != expected:
            sys.exit("the positions differ in a forked process")


def check_script(plugin, tool, page, mesh, work):
    """The result of the page's script must be that of the tool with the script's detail size."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    [script] = [block for block in blocks if "pymeshlab" in block]
    for name in ("libfilter_tracked_mcf.so", "smooth.ply"):
        (work / name).unlink(missing_ok=True)
    if plugin.endswith(".so"):
        (work / "libfilter_tracked_mcf.so").symlink_to(pathlib.Path(plugin).resolve())
    scan = load(mesh)
    scan.save_current_mesh(str(work / "scan.ply"))
    subprocess.run([sys.executable, "-c", script], cwd=work, check=True)
    detail_size = passed_on(scan.current_mesh().bounding_box().diagonal() * 0.005)
    subprocess.run([tool, work / "scan.ply", work / "tool.ply", "--quiet", "--detail-size",
                    detail_size], check=True)
    if vertices(load(work / "smooth.ply")).tobytes() != vertices(load(work / "tool.ply")).tobytes():
        sys.exit(f"the script of {page} does not do what the tool does")


def main(plugin, tool, page, work, *meshes):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    check_script(plugin, tool, page, meshes[0], work)
    apply = load_plugin(plugin)
    for mesh in map(pathlib.Path, meshes):
        differences = work.with_name(f"{work.name}.{mesh.stem}") / "differences.txt"
        differences.parent.mkdir(exist_ok=True)
        largest = compare(apply, tool, mesh, work)
        differences.write_text(f"largest difference {largest:.3g} of the largest coordinate\n",
                               encoding="ascii")
    check_detail_size(apply, tool, meshes[0], work)
    check_quality(apply, tool, meshes[0], work)
    check_selection(apply, meshes[0])
    check_fork(meshes[0])
    check_warnings(apply, meshes[0])
    check_turned_face(apply, work)
    refuse_all(plugin, meshes[0])
    if run_apart(must_interrupt, plugin, meshes[0]) != 0:
        sys.exit("not interrupted as it should")


if __name__ == "__main__":
    main(*sys.argv[1:])
