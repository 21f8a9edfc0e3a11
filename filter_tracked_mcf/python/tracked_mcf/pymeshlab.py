# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds the filter Mean Curvature Flow to PyMeshLab through arrays, where its plugin does not fit:

    import pymeshlab, tracked_mcf.pymeshlab
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh("scan.ply")
    meshes.apply_coord_mean_curvature_flow(detail_size=pymeshlab.PercentageValue(1))

help(pymeshlab.MeshSet.apply_coord_mean_curvature_flow) explains the parameters. The results have the
plugin's bits, but coordinates that are -0 become 0. A method of the plugin that is there already stays.
"""

import numpy
import pymeshlab

from . import Error, _core, default_detail_size, smooth

__all__ = ["apply_coord_mean_curvature_flow"]

_FILTER = "apply_coord_mean_curvature_flow"


def _as_typed(value):
    """Returns the decimal number that a user typed: PyMeshLab passes floats."""
    return float(str(numpy.float32(value)))


def _refuse(reason):
    raise pymeshlab.PyMeshLabException(f"Failed to apply filter: {_FILTER}\nDetails: {reason}")


def _option(parameter, value, layer):
    """Returns the value that smooth() takes for one of PyMeshLab's."""
    if parameter["type"] == "float":
        return _as_typed(value)
    if parameter["type"] == "float | str":
        if isinstance(value, pymeshlab.PercentageValue):  # with PyMeshLab's arithmetic, of floats
            diagonal = numpy.float32(layer.bounding_box().diagonal())
            return _as_typed(diagonal * (numpy.float32(value.value()) / numpy.float32(100)))
        if isinstance(value, pymeshlab.PureValue):
            return _as_typed(value.value())
        _refuse(f"{parameter['name']} is {value!r}; give a PercentageValue or a PureValue.")
    if parameter["choices"]:
        names = dict(parameter["choices"])
        labels = list(names)
        if value in labels:
            return names[value]
        if type(value) is int and 0 <= value < len(labels):
            return names[labels[value]]
        _refuse(f"{parameter['name']} is {value!r}; give one of {', '.join(map(repr, labels))}.")
    return value


def _write(meshes, positions):
    """Moves the vertices of the current layer. Only a filter from layer to layer can, in PyMeshLab."""
    layer = meshes.current_mesh_id()
    meshes.add_mesh(pymeshlab.Mesh(vertex_matrix=positions))
    source = meshes.current_mesh_id()
    try:
        meshes.set_current_mesh(layer)
        # It adds the difference of the layers. Both steps round, but no longer when it is repeated.
        for _ in range(3):
            if meshes.mesh(layer).vertex_matrix().tobytes() != positions.tobytes():
                meshes.compute_coord_linear_morphing(targetmesh=source, percentmorph=100)
    finally:
        meshes.set_current_mesh(source)
        meshes.delete_current_mesh()
        meshes.set_current_mesh(layer)


def _result(report):
    """Returns the values of the report under the keys of the plugin."""
    def error_estimate(step):
        if step["error_estimate"] is not None:
            return step["error_estimate"]
        return step["residual_after"] / step["residual_before"] if step["residual_before"] else 0.0

    volume_change = report["volume_change"]
    return {**{key: report[key] for key in (
                "detail_size", "step_size", "depth", "cell_size", "unknowns", "largest_displacement",
                "rms_displacement", "area_before", "area_after", "warnings")},
            "steps": len(report["steps"]),
            "stopped_early": int(report["stop"] != "none"),
            "converged": int(report["converged"]),
            "error_estimate": error_estimate(report["steps"][-1]) if report["steps"] else 0.0,
            "volume_change": float("nan") if volume_change is None else volume_change}


def apply_coord_mean_curvature_flow(self, **parameters):
    known = {parameter["name"]: parameter for parameter in _core.filters["smooth"]["parameters"] if parameter["label"]}
    layer = self.current_mesh()
    options = {}
    for name, value in parameters.items():
        if name not in known:
            _refuse(f"Parameter {name} not found. The parameters are {', '.join(known)}.")
        options[name] = _option(known[name], value, layer)
    vertices, faces, selection = layer.vertex_matrix(), layer.face_matrix(), layer.face_selection_array()
    try:
        if "detail_size" not in options:
            only = selection if selection.any() else None
            options["detail_size"] = _as_typed(default_detail_size(vertices, faces, selected=only))
        selected = selection if options.pop("selected", selection.any()) else None
        strength = None
        if options.pop("strength", False):
            if not layer.has_vertex_scalar():
                _refuse(_core.no_quality)
            strength = layer.vertex_scalar_array()
        moved, report = smooth(vertices, faces, selected=selected, strength=strength, **options)
    except Error as error:
        _refuse(error)
    try:
        if "quality" in report:  # it travels as a position: x is its size, y its sign, that of -0 too
            quality = report["quality"]
            _write(self, numpy.stack([abs(quality), numpy.copysign(1, quality), 0 * quality], axis=1))
            self.compute_scalar_by_function_per_vertex(q="x * y")
    finally:
        _write(self, moved)
    return _result(report)


apply_coord_mean_curvature_flow.__doc__ = _core.filters["smooth"]["help"]
if not hasattr(pymeshlab.MeshSet, _FILTER):
    setattr(pymeshlab.MeshSet, _FILTER, apply_coord_mean_curvature_flow)
