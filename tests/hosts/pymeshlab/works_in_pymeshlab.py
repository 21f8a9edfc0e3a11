#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the filters in PyMeshLab as a script does, and compares with the program for the runs of runs.py:
works_in_pymeshlab.py WAY PROGRAM PAGE WORK_DIR BOWL MESH...

WAY is the plugin's file, or tracked_mcf.pymeshlab, the module of the Python package. PAGE is the page with the
Python script for that. BOWL is a PLY file with noise and coordinates of floats. The runs take MESH. Ends with 77, which tells
CTest that the test was skipped, where there is no PyMeshLab.
"""

import importlib
import math
import multiprocessing
import pathlib
import re
import signal
import subprocess
import sys

try:
    import numpy
    import pymeshlab
except ImportError:
    print(f"skipped: {sys.executable} cannot import pymeshlab; external/pymeshlab.sh installs it")
    sys.exit(77)

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
import float_ply  # noqa: E402
import runs  # noqa: E402

SMOOTH, REMOVE_NOISE = "apply_coord_mean_curvature_flow", "apply_coord_remove_noise"
FAIR = "apply_coord_fair_selected_faces"
METHODS = {"smooth": SMOOTH, "remove-noise": REMOVE_NOISE, "fair": FAIR}

# Invalid arguments of a filter, and words of the message.
WRONG = [
    (SMOOTH, {"depth": 13}, "depth is 13"),
    (SMOOTH, {"depth": 3.0}, "cast|give an integer"),
    (SMOOTH, {"detail_size": pymeshlab.PercentageValue(math.nan)}, "detail_size is nan"),
    (SMOOTH, {"flow": "Sideways"}, "'Mean curvature'[;,] 'Conformalized'"),
    (SMOOTH, {"boundary": 3}, "not valid|give one of"),
    (SMOOTH, {"selected": True}, "No face is selected"),
    (SMOOTH, {"strength": True}, "no vertex quality"),
    (SMOOTH, {"preserve": "Area"}, "Preserving the area"),
    (SMOOTH, {"detph": 6}, "detph not found"),
    (REMOVE_NOISE, {"largest_movement": pymeshlab.PureValue(-1)}, "largest_movement is -1"),
    (FAIR, {}, "No face is selected"),
    (FAIR, {"iterations": 1}, "iterations not found"),
]


def use(way):
    if way.endswith(".so"):
        pymeshlab.load_plugin(way)
    else:
        importlib.import_module(way)


def apply(meshes, name=SMOOTH, /, **parameters):
    """The package makes its filters methods, and PyMeshLab those of a plugin that it has not loaded by itself not."""
    if hasattr(meshes, name):
        return getattr(meshes, name)(**parameters)
    return meshes.apply_filter(name, **parameters)


def load(mesh):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(mesh))
    return meshes


# These take the set: a mesh of PyMeshLab dangles once its set is gone.
def vertices(meshes):
    return meshes.current_mesh().vertex_matrix()


def qualities(meshes):
    """The sign of a zero depends on the compiler, and is left out."""
    return meshes.current_mesh().vertex_scalar_array() + 0.0


def parameters_of(command, settings):
    """Returns the arguments of a script for settings in the program's words."""
    for name, text in runs.by_index(command, settings).items():
        value = {"true": True, "false": False}.get(text)
        if value is None:
            value = float(text) if re.search("[.e]", text) else int(text)
        if name in ("detail_size", "noise", "noise_size", "largest_movement"):
            value = pymeshlab.PureValue(value)
        yield name, float(value) if name in ("crease_angle", "step_size") else value


def same_as_the_program(way, program, path, work, command, settings):
    """Returns the bits of a run's result, which must be the program's, and its numbers."""
    done = subprocess.run([program, command, path, work / "out.ply", "--quiet", "--overwrite", "--double",
                           *runs.program_options(settings)], stderr=subprocess.PIPE, text=True, check=False)
    meshes, parameters = load(path), dict(parameters_of(command, settings))
    if done.returncode != 0:
        said = done.stderr.strip().removeprefix("tracked_mcf: ")
        if run_apart(must_refuse, way, path, (command, settings, said)) != 0:
            sys.exit(f"{settings}: not refused with {done.stderr}")
        return b"", {}
    before = vertices(meshes)
    results = apply(meshes, METHODS[command], **parameters)
    expected = load(work / "out.ply")
    if vertices(meshes).tobytes() != vertices(expected).tobytes():
        sys.exit(f"{command}, {settings}: the positions differ from the program's")
    if qualities(meshes).tobytes() != qualities(expected).tobytes():
        sys.exit(f"{command}, {settings}: the qualities differ from the program's")
    if not (vertices(meshes) != before).any():
        sys.exit(f"{command}, {settings}: nothing has moved")
    print(f"{path}, {command}, {settings}: the program's bits")
    return vertices(meshes).tobytes() + qualities(meshes).tobytes(), results


def compare(way, program, mesh, work):
    for command, table in runs.RUNS.items():
        path, by_run = work / "in.ply", {}
        edge = runs.write_mesh(path, command, *float_ply.read_mesh(mesh))
        for run in table:
            settings = runs.settings_of(command, run, edge)
            if runs.OF_THE_PROGRAM & set(settings):
                continue
            by_run[run], results = same_as_the_program(way, program, path, work, command, settings)
            if (by_run[run] == by_run[""]) != runs.same_as_default(run):
                sys.exit(f"{command}, {settings}: not as different from the defaults as it must be")
            if results and command == "smooth":
                check_results(results, settings)
            if command == "remove-noise" and not {"noise", "crease_share", "smoothing_steps", "volume_change"} <= set(results):
                sys.exit(f"wrong results: {results}")


def check_results(results, settings):
    integers = ("depth", "iterations", "unknowns", "stopped_early", "converged")
    reals = ("detail_size", "step_size", "cell_size", "error_estimate", "largest_displacement",
             "rms_displacement", "area_before", "area_after", "volume_change")
    types = {**dict.fromkeys(integers, int), **dict.fromkeys(reals, float)}
    if {name: type(results.get(name)) for name in types} != types:
        sys.exit(f"unexpected results: {results}")
    if results["iterations"] != int(settings["iterations"]) or results["unknowns"] < 100:
        sys.exit(f"wrong results: {results}")


def check_layer(mesh):
    """A filter changes nothing of a set and its layer but positions, normals and the box. By default it moves the
    vertices of selected faces alone."""
    meshes = pymeshlab.MeshSet()
    meshes.create_cube()
    meshes.load_new_mesh(str(mesh))
    meshes.compute_texcoord_parametrization_triangle_trivial_per_wedge()
    meshes.compute_color_by_function_per_vertex(x="vi", y="255*x", z="3", a="200")
    meshes.compute_color_by_function_per_face(r="fi", g="1", b="2")
    meshes.compute_scalar_by_function_per_vertex(q="1/(1+x*x)")
    meshes.compute_scalar_by_function_per_face(q="fi/3")
    meshes.compute_new_custom_point_attribute_per_vertex(name="own", x_expr="x", y_expr="vi", z_expr="7")
    meshes.compute_matrix_from_translation(axisx=3, freeze=False)
    meshes.compute_selection_by_condition_per_face(condselect="x0 > 0.1")
    meshes.create_cube()
    meshes.set_current_mesh(1)

    def state():
        layer = meshes.current_mesh()
        parts = ("face_matrix", "vertex_normal_matrix", "face_normal_matrix", "vertex_color_matrix",
                 "face_color_matrix", "vertex_scalar_array", "face_scalar_array", "wedge_tex_coord_matrix",
                 "vertex_selection_array", "face_selection_array", "transform_matrix")
        values = {part: getattr(layer, part)().tobytes() for part in parts}
        return {**values, "own": layer.vertex_custom_point_attribute_matrix("own").tobytes(),
                "label": layer.label(), "layers": (len(meshes), meshes.current_mesh_id())}

    for name in (REMOVE_NOISE, SMOOTH, FAIR):  # the flow leaves no noise
        before, positions, layer = state(), vertices(meshes), meshes.current_mesh()
        apply(meshes, name)
        changed = {part for part, value in state().items() if value != before[part]}
        if changed != {"vertex_normal_matrix", "face_normal_matrix"}:
            sys.exit(f"{name} has changed {changed}")
        box = layer.bounding_box()
        if (box.min() != vertices(meshes).min(axis=0)).any() or (box.max() != vertices(meshes).max(axis=0)).any():
            sys.exit(f"{name}: the bounding box is not that of the vertices")
        a, b, c = (vertices(meshes)[layer.face_matrix()[:, corner]] for corner in range(3))
        normals = numpy.cross(b - a, c - a)
        normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
        if not numpy.allclose(layer.face_normal_matrix(), normals, atol=1e-6):
            sys.exit(f"{name}: the normals are not those of the surface")
        moved = (vertices(meshes) != positions).any(axis=1)
        free = numpy.zeros(len(positions), bool)
        free[layer.face_matrix()[layer.face_selection_array()]] = True
        if not moved.any() or (moved & ~free).any():
            sys.exit(f"{name} moved {moved.sum()} of the {free.sum()} vertices of selected faces, and others")


def must_refuse(way, mesh, case):
    """Runs in a separate process: a plugin's filter that fails leaves PyMeshLab with a dangling log. The process
    is told a case's number or a run and its message, because PyMeshLab's values cannot be passed."""
    use(way)
    if isinstance(case, int):
        name, parameters, words = WRONG[case]
    else:
        command, settings, message = case
        name, parameters, words = METHODS[command], dict(parameters_of(command, settings)), re.escape(message)
    meshes = load(mesh)
    before = vertices(meshes)
    try:
        apply(meshes, name, **parameters)
        sys.exit(f"{parameters} was accepted")
    except Exception as error:  # PyMeshLab has three exception types without a common base
        if not re.search(words, str(error)):
            sys.exit(f"{parameters}: '{words}' is not in: {error}")
    if vertices(meshes).tobytes() != before.tobytes() or len(meshes) != 1:
        sys.exit(f"{parameters}: the mesh was changed")


def run_apart(function, *arguments):
    """Returns the exit code of a process that calls the function. One that hangs is killed."""
    process = multiprocessing.get_context("spawn").Process(target=function, args=arguments)
    process.start()
    process.join(120)
    process.kill()
    process.join()
    return process.exitcode


def check_help():
    """The help of each method has its parameters: those that the runs use."""
    for command, name in METHODS.items():
        found = set(re.findall(r"^    (\w+): ", getattr(pymeshlab.MeshSet, name).__doc__, re.MULTILINE))
        used = {parameter for run in runs.RUNS[command]
                for parameter in runs.by_index(command, runs.settings_of(command, run, 1.0))}
        if found != used - runs.OF_THE_PROGRAM:
            sys.exit(f"the help of {name} has {sorted(found)} instead of {sorted(used - runs.OF_THE_PROGRAM)}")


def check_package(mesh):
    """The package has its own help and warnings, and an interrupt ends a flow. A plugin has none of these in PyMeshLab."""
    import tracked_mcf

    check_help()
    quiet = apply(load(mesh), detail_size=pymeshlab.PercentageValue(1.3), iterations=20)["warnings"]
    warned = []
    tracked_mcf._warnings.showwarning = lambda message, *_, **__: warned.append(message)
    [fine] = apply(load(mesh), detail_size=pymeshlab.PercentageValue(0.01))["warnings"]
    if quiet or not fine.startswith("The detail size is ") or [str(text) for text in warned] != [fine]:
        sys.exit(f"wrong warnings: {quiet}, {fine} and {warned}")
    meshes = load(mesh)
    before = vertices(meshes).tobytes()
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    try:
        apply(meshes, detail_size=pymeshlab.PureValue(1e-6), depth=7, iterations=1000000)
        sys.exit("the flow was not interrupted")
    except KeyboardInterrupt:
        pass
    if vertices(meshes).tobytes() != before or len(meshes) != 1:
        sys.exit("the interrupt has changed the layer")


def check_script(way, program, page, mesh, work):
    """The result of the page's script must be that of the program, but for PyMeshLab's rounding of the length."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    [script] = [block for block in blocks if "pymeshlab" in block]
    for name in ("libfilter_tracked_mcf.so", "smooth.ply"):
        (work / name).unlink(missing_ok=True)
    if way.endswith(".so"):
        (work / "libfilter_tracked_mcf.so").symlink_to(pathlib.Path(way).resolve())
    load(mesh).save_current_mesh(str(work / "scan.ply"))
    subprocess.run([sys.executable, "-c", script], cwd=work, check=True)
    subprocess.run([program, work / "scan.ply", work / "out.ply", "--quiet", "--overwrite", "--double", "--detail-size", "2%"],
                   check=True)
    found, expected = vertices(load(work / "smooth.ply")), vertices(load(work / "out.ply"))
    if abs(found - expected).max() > 1e-6 * abs(expected).max():
        sys.exit(f"the script of {page} does not do what the program does")


def main(way, program, page, work, bowl, *meshes):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    check_script(way, program, page, bowl, work)
    use(way)
    for mesh in meshes:
        compare(way, program, mesh, work)
    check_layer(bowl)
    for case, wrong in enumerate(WRONG):
        if run_apart(must_refuse, way, bowl, case) != 0:
            sys.exit(f"not refused as it should: {wrong}")
    if not way.endswith(".so"):
        check_package(bowl)


if __name__ == "__main__":
    main(*sys.argv[1:])
