#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the Python package's filters for PyMeshLab with the plugin's:
arrays_in_pymeshlab.py PLUGIN WHEEL_MODULE TOOL WORK_DIR MESH...

PLUGIN is the plugin's file, and WHEEL_MODULE the folder of the Python module that loads it. Runs with a
Python that has PyMeshLab and the package tracked_mcf. Also runs the script of the package's page.
"""

import os
import pathlib
import subprocess
import sys
import warnings

import pymeshlab

import tracked_mcf.pymeshlab
import works_in_pymeshlab

PAGE = pathlib.Path(__file__).resolve().parents[3] / "filter_tracked_mcf" / "python" / "README.md"
FILTER = works_in_pymeshlab.FILTER
COARSE = works_in_pymeshlab.COARSE
smooth = tracked_mcf.pymeshlab.apply_coord_mean_curvature_flow
remove_noise = tracked_mcf.pymeshlab.apply_coord_remove_noise

# Further arguments than works_in_pymeshlab.RUNS.
RUNS = [
    {**COARSE, "detail_size": pymeshlab.PercentageValue(0.3), "order": 2},
    {**COARSE, "quality": "Displacement"},
    {**COARSE, "strength": True, "quality": "Displacement"},
    {**COARSE, "quality": 2, "method": 2},
    {"depth": 2, "detail_size": pymeshlab.PercentageValue(1)},  # with a warning
]

NOISE_RUNS = [
    {},
    {"crease_angle": 12.3, "noise": pymeshlab.PercentageValue(0.3)},
    {"detail_size": pymeshlab.PureValue(0.125), "quality": "Displacement"},
    {"largest_movement": pymeshlab.PureValue(0.01), "boundary": "Locked"},
    {"boundary": 0, "selected": False},
    {"strength": True, "quality": 1},
]
NOISE_WRONG = [
    ({"crease_angle": 180}, "crease_angle is 180"),
    ({"noise": 1}, "noise is 1; give a PercentageValue or a PureValue"),
    ({"largest_movement": pymeshlab.PureValue(-1)}, "largest_movement is -1"),
    ({"boundary": "Locked cells (paper)"}, "give one of 'Locked', 'Free'"),
    ({"selected": True}, "No face is selected"),
    ({"strength": True}, "no vertex quality"),
    ({"iterations": 3}, "iterations not found"),
]

# Words for those that works_in_pymeshlab.WRONG expects of PyMeshLab itself.
OTHER_WORDS = {"cast": "give an integer", "not valid": "give one of", "Possible values": "give one of",
               "Possible values are 'Mean curvature'; 'Conformalized'":
               "give one of 'Mean curvature', 'Conformalized'"}

FALLBACK = f"""
import pymeshlab
pymeshlab.pmeshlab.__version__ = "2024.1"
import pymeshlab_tracked_mcf
meshes = pymeshlab.MeshSet()
meshes.create_sphere()
print(meshes.{FILTER}()["warnings"])
"""


def rich_layer(mesh, select):
    """Returns a set with a layer between two others, which has all that a filter could lose."""
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
    if select:
        meshes.compute_selection_by_condition_per_face(condselect="x0 > 0.1")
    meshes.create_cube()
    meshes.set_current_mesh(1)
    return meshes


def state(meshes):
    """Returns everything that PyMeshLab tells of a set and its current layer, without the positions."""
    layer = meshes.current_mesh()
    parts = ("face_matrix", "vertex_normal_matrix", "face_normal_matrix", "vertex_color_matrix",
             "face_color_matrix", "vertex_scalar_array", "face_scalar_array", "wedge_tex_coord_matrix",
             "vertex_selection_array", "face_selection_array", "transform_matrix")
    values = {part: getattr(layer, part)().tobytes() for part in parts}
    box = layer.bounding_box()
    return {**values, "own": layer.vertex_custom_point_attribute_matrix("own").tobytes(),
            "box": (box.min().tobytes(), box.max().tobytes()), "label": layer.label(),
            "layers": (len(meshes), meshes.current_mesh_id()), "scalar": layer.has_vertex_scalar()}


def results(outputs):
    outputs = {**outputs, "warnings": works_in_pymeshlab.warnings_of(outputs)}
    return {name: (type(value), repr(value)) for name, value in outputs.items()}


def must_be_the_plugins(arrays_filter, mesh, parameters, select):
    plugin, arrays = rich_layer(mesh, select), rich_layer(mesh, select)
    before = state(arrays)
    expected = plugin.apply_filter(arrays_filter.__name__, **parameters)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", tracked_mcf.FlowWarning)
        outputs = arrays_filter(arrays, **parameters)
    given = f"{arrays_filter.__name__}, {parameters}, {'selected' if select else 'all'} faces"
    if results(outputs) != results(expected):
        sys.exit(f"{given}: {outputs} rather than {expected}")
    positions = works_in_pymeshlab.vertices(arrays)
    if positions.tobytes() != works_in_pymeshlab.vertices(plugin).tobytes():
        sys.exit(f"{given}: the positions differ")
    found, wanted = state(arrays), state(plugin)
    differing = [name for name in wanted if found[name] != wanted[name]]
    if differing:
        sys.exit(f"{given}: the layers differ in {differing}")
    changed = {name for name in before if before[name] != found[name]}
    if not changed:
        sys.exit(f"{given}: nothing moved")
    print(f"{given}: the plugin's bits; changed {sorted(changed)}")


def must_refuse(arrays_filter, mesh, wrong):
    meshes = works_in_pymeshlab.load(mesh)
    before = works_in_pymeshlab.vertices(meshes)
    for parameters, word in wrong:
        try:
            arrays_filter(meshes, **parameters)
            sys.exit(f"{parameters} was accepted")
        except (pymeshlab.PyMeshLabException, TypeError) as error:
            if OTHER_WORDS.get(word, word) not in str(error):
                sys.exit(f"{parameters}: '{word}' is not in: {error}")
    if works_in_pymeshlab.vertices(meshes).tobytes() != before.tobytes() or len(meshes) != 1:
        sys.exit("a refused run has changed the mesh")


def must_replace_the_plugin(wheel_module):
    """Where the wheel's plugin does not fit, its module takes the package, and says so."""
    environment = {**os.environ, "PYTHONPATH": str(pathlib.Path(wheel_module).parent)}
    run = subprocess.run([sys.executable, "-c", FALLBACK], env=environment, check=True, text=True,
                         capture_output=True)
    if run.stdout != "[]\n" or "the package tracked_mcf runs the filter" not in run.stderr:
        sys.exit(f"the module does not use the package: {run.stdout}{run.stderr}")


def main(plugin, wheel_module, tool, work, *meshes):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    works_in_pymeshlab.check_script("tracked_mcf.pymeshlab", tool, PAGE, meshes[0], work)
    pymeshlab.load_plugin(plugin)
    runs = [parameters for parameters, _ in works_in_pymeshlab.RUNS] + RUNS
    for arrays_filter, runs, wrong in ((smooth, runs, works_in_pymeshlab.WRONG),
                                       (remove_noise, NOISE_RUNS, NOISE_WRONG)):
        for mesh in meshes:
            for parameters in runs:
                must_be_the_plugins(arrays_filter, mesh, parameters, False)
            for parameters in runs[1::4]:
                must_be_the_plugins(arrays_filter, mesh, parameters, True)
        must_refuse(arrays_filter, meshes[0], wrong)
        if getattr(pymeshlab.MeshSet, arrays_filter.__name__) is not arrays_filter:
            sys.exit(f"the package has not made {arrays_filter.__name__} a method")
    must_replace_the_plugin(wheel_module)


if __name__ == "__main__":
    main(*sys.argv[1:])
