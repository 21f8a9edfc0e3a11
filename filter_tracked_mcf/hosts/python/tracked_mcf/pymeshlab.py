# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds the filters to PyMeshLab through arrays:

    import pymeshlab, tracked_mcf.pymeshlab
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh("scan.ply")
    meshes.apply_coord_remove_noise()
    meshes.apply_coord_fair_selected_faces(continuity="Curvature (C2)")
    meshes.apply_coord_mean_curvature_flow(detail_size=pymeshlab.PercentageValue(1))

help(pymeshlab.MeshSet.apply_coord_remove_noise) explains the parameters. A coordinate that is -0 becomes 0.
"""

import re

import numpy
import pymeshlab

from . import Error, InvalidParameter, _core, fair, remove_noise, smooth

__all__ = ["apply_coord_fair_selected_faces", "apply_coord_mean_curvature_flow", "apply_coord_remove_noise"]


def _option(parameter, value, layer):
    """Returns the value that the package's function takes for one of PyMeshLab's."""
    if parameter["type"] == "float | str":
        if isinstance(value, pymeshlab.PercentageValue):
            return layer.bounding_box().diagonal() * value.value() / 100
        if isinstance(value, pymeshlab.PureValue):
            return value.value()
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
    """Returns the numbers of a report, as the plugin has them, and the warnings."""
    results = {key: float("nan") if value is None else int(value) if isinstance(value, bool) else value
               for key, value in report.items() if value is None or isinstance(value, (int, float))}
    return {**results, "warnings": report["warnings"]}


def _type(parameter):
    """Returns the parameter's type and default in PyMeshLab. A default that depends on the mesh is left out."""
    if "of_faces" in parameter:
        return "bool, by default True if faces are selected" if parameter["of_faces"] else "bool = False"
    if parameter["type"] == "float | str":
        return "pymeshlab.PercentageValue or pymeshlab.PureValue"
    if parameter["choices"]:
        default_first = sorted(parameter["choices"], key=lambda choice: choice[1] != parameter["default"])
        return "str = " + ", or ".join(repr(label) for label, _ in default_first)
    return f"{parameter['type']} = {parameter['default']!r}"


def _help(described, parameters):
    """Returns the docstring of a filter's method."""
    lines = [re.sub("<[^>]*>", "", described["help"].replace("<br>", "\n")), "", "Parameters:"]
    for parameter in parameters:
        lines += [f"    {parameter['name']}: {_type(parameter)}", f"        {parameter['label']}: {parameter['help']}"]
    lines += ["", "Returns a dictionary of numbers, such as largest_displacement, and the list warnings.", ""]
    return "\n".join(lines)


def _method(function):
    """Makes a method of MeshSet from a function of the package, and returns the method."""
    described = _core.filters[function.__name__]
    name = described["method"]
    known = {parameter["name"]: parameter for parameter in described["parameters"] if parameter["label"]}

    inputs = {parameter["name"]: parameter["of_faces"] for parameter in described["parameters"]
              if "of_faces" in parameter}

    def apply(self, parameters):
        layer = self.current_mesh()
        options = {}
        for key, value in parameters.items():
            if key not in known:
                raise InvalidParameter(f"Parameter {key} not found. The parameters are {', '.join(known)}.")
            options[key] = _option(known[key], value, layer)
        selection = layer.face_selection_array()
        for key, of_faces in inputs.items():
            if not options.get(key, key not in known or (of_faces and selection.any())):
                options[key] = None
            elif not of_faces and not layer.has_vertex_scalar():
                raise InvalidParameter(_core.no_quality)
            else:
                options[key] = selection if of_faces else layer.vertex_scalar_array()
        moved, report = function(layer.vertex_matrix(), layer.face_matrix(), **options)
        try:
            if "quality" in report:  # it travels as a position: x is its size, y its sign, that of -0 too
                quality = report["quality"]
                _write(self, numpy.stack([abs(quality), numpy.copysign(1, quality), 0 * quality], axis=1))
                self.compute_scalar_by_function_per_vertex(q="x * y")
        finally:
            _write(self, moved)
        return _results(report)

    def method(self, **parameters):
        try:
            return apply(self, parameters)
        except Error as error:
            raise pymeshlab.PyMeshLabException(f"Failed to apply filter: {name}\nDetails: {error}") from error

    method.__name__, method.__qualname__, method.__doc__ = name, name, _help(described, known.values())
    setattr(pymeshlab.MeshSet, name, method)
    return method


apply_coord_fair_selected_faces = _method(fair)
apply_coord_remove_noise = _method(remove_noise)
apply_coord_mean_curvature_flow = _method(smooth)
