# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds the filters of the plugin to PyMeshLab through arrays, where the plugin does not fit:

    import pymeshlab, tracked_mcf.pymeshlab
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh("scan.ply")
    meshes.apply_coord_remove_noise()
    meshes.apply_coord_mean_curvature_flow(detail_size=pymeshlab.PercentageValue(1))

help(pymeshlab.MeshSet.apply_coord_remove_noise) explains the parameters. The results have the plugin's
bits, but coordinates that are -0 become 0. A method of the plugin that is there already stays.
"""

import numpy
import pymeshlab

from . import Error, InvalidParameter, _core, default_detail_size, remove_noise, smooth

__all__ = ["apply_coord_mean_curvature_flow", "apply_coord_remove_noise"]


def _as_typed(value):
    """Returns the decimal number that a user typed: PyMeshLab passes floats."""
    return float(str(numpy.float32(value)))


def _option(parameter, value, layer):
    """Returns the value that the package's function takes for one of PyMeshLab's."""
    if parameter["type"] == "float":
        return _as_typed(value)
    if parameter["type"] == "float | str":
        if isinstance(value, pymeshlab.PercentageValue):  # with PyMeshLab's arithmetic, of floats
            diagonal = numpy.float32(layer.bounding_box().diagonal())
            return _as_typed(diagonal * (numpy.float32(value.value()) / numpy.float32(100)))
        if isinstance(value, pymeshlab.PureValue):
            return _as_typed(value.value())
        raise InvalidParameter(f"{parameter['name']} is {value!r}; give a PercentageValue or a PureValue.")
    if parameter["choices"]:
        names = dict(parameter["choices"])
        labels = list(names)
        if value in labels:
            return names[value]
        if type(value) is int and 0 <= value < len(labels):
            return names[labels[value]]
        raise InvalidParameter(f"{parameter['name']} is {value!r}; give one of {', '.join(map(repr, labels))}.")
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


def _results(report):
    """Returns the values of the report that both filters have under the plugin's keys."""
    volume_change = report["volume_change"]
    return {**{key: report[key] for key in ("detail_size", "largest_displacement", "rms_displacement",
                                            "area_before", "area_after", "warnings")},
            "volume_change": float("nan") if volume_change is None else volume_change}


def _noise_results(report):
    return {key: report[key] for key in ("noise", "crease_share", "steps")}


def _flow_results(report):
    def error_estimate(step):
        if step["error_estimate"] is not None:
            return step["error_estimate"]
        return step["residual_after"] / step["residual_before"] if step["residual_before"] else 0.0

    return {**{key: report[key] for key in ("step_size", "depth", "cell_size", "unknowns")},
            "steps": len(report["steps"]),
            "stopped_early": int(report["stop"] != "none"),
            "converged": int(report["converged"]),
            "error_estimate": error_estimate(report["steps"][-1]) if report["steps"] else 0.0}


def _method(function, further_results, initial_detail_size):
    """Makes a method of MeshSet from a function of the package, and returns the method. initial_detail_size
    returns what the filter's dialog begins with."""
    described = _core.filters[function.__name__]
    name = described["method"]
    known = {parameter["name"]: parameter for parameter in described["parameters"] if parameter["label"]}

    def apply(self, parameters):
        layer = self.current_mesh()
        options = {}
        for key, value in parameters.items():
            if key not in known:
                raise InvalidParameter(f"Parameter {key} not found. The parameters are {', '.join(known)}.")
            options[key] = _option(known[key], value, layer)
        vertices, faces, selection = layer.vertex_matrix(), layer.face_matrix(), layer.face_selection_array()
        if "detail_size" not in options:
            only = selection if selection.any() else None
            options["detail_size"] = _as_typed(initial_detail_size(vertices, faces, selected=only))
        selected = selection if options.pop("selected", selection.any()) else None
        strength = None
        if options.pop("strength", False):
            if not layer.has_vertex_scalar():
                raise InvalidParameter(_core.no_quality)
            strength = layer.vertex_scalar_array()
        moved, report = function(vertices, faces, selected=selected, strength=strength, **options)
        try:
            if "quality" in report:  # it travels as a position: x is its size, y its sign, that of -0 too
                quality = report["quality"]
                _write(self, numpy.stack([abs(quality), numpy.copysign(1, quality), 0 * quality], axis=1))
                self.compute_scalar_by_function_per_vertex(q="x * y")
        finally:
            _write(self, moved)
        return {**_results(report), **further_results(report)}

    def method(self, **parameters):
        try:
            return apply(self, parameters)
        except Error as error:
            raise pymeshlab.PyMeshLabException(f"Failed to apply filter: {name}\nDetails: {error}") from error

    method.__name__, method.__qualname__, method.__doc__ = name, name, described["help"]
    if not hasattr(pymeshlab.MeshSet, name):
        setattr(pymeshlab.MeshSet, name, method)
    return method


apply_coord_remove_noise = _method(remove_noise, _noise_results, lambda *_, **__: 0.0)
apply_coord_mean_curvature_flow = _method(smooth, _flow_results, default_detail_size)
