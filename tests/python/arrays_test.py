#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests the Python package tracked_mcf, and compares it with the program: arrays_test.py TOOL MESH.off README

Ends with 77, which tells CTest that the test was skipped, where the package is not installed.
"""

import _thread
import importlib
import importlib.metadata
import inspect
import json
import multiprocessing
import multiprocessing.pool
import pathlib
import pickle
import subprocess
import sys
import tempfile
import threading
import time
import types
import typing
import unittest
import warnings

try:
    import numpy
    import tracked_mcf
except ImportError as error:
    print(f"skipped: {sys.executable}: {error}; external/python_package.sh installs the package")
    sys.exit(77)

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "hosts"))
import float_ply  # noqa: E402
import runs  # noqa: E402

COARSE = {"depth": 5, "detail_size": 0.2}

Error = tracked_mcf.Error
InvalidMesh, InvalidParameter = tracked_mcf.InvalidMesh, tracked_mcf.InvalidParameter

# Refused keywords, and words of the message, of both functions.
WRONG = [
    ({"detial_size": 1}, TypeError, "() got an unexpected keyword argument 'detial_size'"),
    ({"detail_size": "1"}, InvalidParameter, "such as '1%'"),
    ({"detail_size": "one%"}, InvalidParameter, "such as '1%'"),
    ({"detail_size": "%"}, InvalidParameter, "such as '1%'"),
    ({"detail_size": "-1%"}, InvalidParameter, "detail_size is -1; give 0 or more"),
    ({"detail_size": []}, TypeError, "detail_size is []"),
    ({"selected": [0.0, 1.0]}, InvalidParameter, "the type float64; give an array of bools"),
    ({"selected": [3042]}, InvalidParameter, "selected has an index outside 0 to 3041"),
    ({"selected": numpy.ones(3042, int)}, InvalidParameter, "3042 integers that are 0 or 1; give an array of bools"),
    ({"selected": []}, InvalidMesh, "No face is selected"),
    ({"fixed": [-1]}, InvalidParameter, "fixed has an index outside 0 to 1599"),
    ({"fixed": [True]}, InvalidParameter, "fixed has the shape (1,) and the type bool; give 1600 bools"),
    ({"fixed": range(1600)}, InvalidMesh, "Nothing can move"),
    ({"selected": [True]}, InvalidParameter, "one for each of the 3042 faces"),
    ({"selected": numpy.zeros(3042, bool)}, InvalidMesh, "No face is selected"),
    ({"strength": [1]}, InvalidParameter, "one for each of the 1600 vertices"),
    ({"strength": numpy.full(1600, 2)}, InvalidMesh, "The strength of vertex 0 is 2"),
    ({"strength": numpy.zeros(1600)}, InvalidMesh, "Nothing can move"),
    ({"strength": numpy.ones(1600, bool)}, InvalidParameter, "an array of real numbers"),
    ({"progress": 1}, TypeError, "not callable"),
]
FLOW_WRONG = [
    ({"order": 2.0}, TypeError, "order is 2.0; give an integer"),
    ({"preserve": 1}, InvalidParameter, "preserve is 1"),
    ({"preserve": "area"}, InvalidParameter, "Preserving the area"),
]
NOISE_WRONG = [
    ({"largest_movement": "-1%"}, InvalidParameter, "largest_movement is -1; give 0 or more"),
]


def bumpy_bowl(seed=1, side=40):
    """Returns the vertices and faces of an open surface with noise."""
    ticks = numpy.linspace(-1, 1, side)
    x, y = (axis.ravel() for axis in numpy.meshgrid(ticks, ticks))
    noise = numpy.random.default_rng(seed).normal(scale=0.01, size=x.size)
    corner = numpy.arange(side * side).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:],
                                            corner[1:, :-1]))
    return (numpy.stack([x, y, (x * x + y * y) / 2 + noise], axis=1),
            numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)]))


VERTICES, FACES = bumpy_bowl()
HOLE = (abs(VERTICES[FACES, :2]) < 0.4).all(axis=2).any(axis=1)  # faces


def smooth(vertices=VERTICES, faces=FACES, **parameters):
    return tracked_mcf.smooth(vertices, faces, **{**COARSE, **parameters})


def remove_noise(vertices=VERTICES, faces=FACES, **parameters):
    return tracked_mcf.remove_noise(vertices, faces, **parameters)


def fair(vertices=VERTICES, faces=FACES, **parameters):
    return tracked_mcf.fair(vertices, faces, selected=HOLE, **parameters)


def smoothed_bowl(seed):
    return smooth(*bumpy_bowl(seed))[0].tobytes()


def refuse_bowl(_):
    smooth(order=5)


def said_by(script):
    """Returns what a new process of Python prints that runs the script."""
    return subprocess.run([sys.executable, "-c", script], cwd=HERE, check=True, capture_output=True,
                          text=True, timeout=60).stdout


def read_off(path):
    return [numpy.array(rows) for rows in float_ply.read_off(path)]


def read_vertices(path):
    """Returns the bytes of the positions in a PLY file of the program, and the qualities or None."""
    elements = float_ply.read_ply(path)
    vertices = elements["vertex"]
    quality = numpy.array(vertices.column("quality")) if "quality" in vertices.properties else None
    return numpy.array(float_ply.positions(elements)).tobytes(), quality


def keywords(settings):
    """Returns keyword arguments for settings in the program's words."""
    def value_of(text):
        for type_of in (int, float):
            try:
                return type_of(text)
            except ValueError:
                pass
        return True if text == "true" else text

    return {name: value_of(text) for name, text in settings.items()}


class WithFolder(unittest.TestCase):
    """Tests that run the program."""

    subcommand = []

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, mesh, *options):
        """Returns the bytes of the vertices, the qualities and the report."""
        command = [TOOL, *self.subcommand, mesh, self.folder / "out.ply", "--quiet", "--overwrite"]
        subprocess.run([*command, "--report", self.folder / "out.json", *options], check=True, text=True,
                       stderr=subprocess.PIPE)
        report = json.loads((self.folder / "out.json").read_text(encoding="utf-8"))
        return *read_vertices(self.folder / "out.ply"), report


class Runs(WithFolder):
    """The runs of all hosts have the bits of the program."""

    def mesh_of(self, command):
        """Returns the mesh of a filter's runs: its file, vertices, faces, inputs and mean edge."""
        path = self.folder / "mesh.ply"
        edge = runs.write_mesh(path, command, list(map(tuple, VERTICES.tolist())), list(map(tuple, FACES.tolist())))
        elements = float_ply.read_ply(path)
        given = {"selected": numpy.array(elements["face"].column("flags")) != 0,
                 "strength": numpy.array(elements["vertex"].column("quality"))}
        vertices, faces = (numpy.array(rows) for rows in float_ply.read_mesh(path))
        return path, vertices, faces, given, edge

    def result_of(self, command, mesh, run):
        """Returns the bytes of a run, or of its message."""
        path, vertices, faces, inputs, edge = mesh
        settings = runs.settings_of(command, run, edge)
        given = {name: inputs.get(name, value) for name, value in keywords(settings).items() if value != "false"}
        function = getattr(tracked_mcf, command.replace("-", "_"))
        self.subcommand = [command]
        try:
            expected, quality, reported = self.program(path, "--double", *runs.program_options(settings))
        except subprocess.CalledProcessError as refusal:
            with self.assertRaises(Error) as caught:
                function(vertices, faces, **given)
            self.assertEqual(refusal.stderr, f"tracked_mcf: {caught.exception}\n")
            return refusal.stderr.encode()
        moved, report = function(vertices, faces, **given)
        self.assertEqual(moved.tobytes(), expected)
        if "quality" in settings:
            # The sign of a zero depends on the compiler.
            self.assertEqual((report.pop("quality") + 0.0).tobytes(), (quality + 0.0).tobytes())
        self.compare_reports(report, reported)
        return expected + quality.tobytes()

    def test_each_run_gives_the_bits_of_the_program(self):
        for command, table in runs.RUNS.items():
            mesh = self.mesh_of(command)
            first = self.result_of(command, mesh, "")
            for run in table:
                with self.subTest(command, run=run), warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    self.assertEqual(self.result_of(command, mesh, run) == first, runs.same_as_default(run))

    def test_the_table_has_all_parameters(self):
        for command, table in runs.RUNS.items():
            function = getattr(tracked_mcf, command.replace("-", "_"))
            names = set(inspect.signature(function).parameters) - {"vertices", "faces", "fixed", "progress"}
            tested = {name for run in table for name in runs.settings_of(command, run, 1)}
            self.assertEqual(names, tested)

    def compare_reports(self, report, reported):
        """Times and memory differ from run to run."""
        parts = [report, reported]
        if "steps" in report:
            parts += report["steps"] + reported["steps"]
        for values in parts:
            for name in [name for name in values if name.endswith(("seconds", "_bytes"))]:
                self.assertGreaterEqual(values.pop(name), 0)
        for name in ("program", "input", "output"):
            reported.pop(name)
        for name in {"selected", "strength"} & set(report["parameters"]):
            self.assertEqual(report["parameters"].pop(name), reported["parameters"].pop(name) is not None)
        # The advice of the last warning names options of the host.
        self.assertEqual(len(report.pop("warnings")), len(reported.pop("warnings")))
        self.assertEqual(report, reported)


class Program(WithFolder):
    function = staticmethod(smooth)

    def test_defaults_on_a_real_mesh(self):
        moved, report = getattr(tracked_mcf, self.function.__name__)(*read_off(MESH))
        expected, _, reported = self.program(MESH)
        self.assertEqual(moved.tobytes(), expected)
        self.assertEqual(report["detail_size"], reported["detail_size"])
        if self.function is smooth:  # the report's is that of the step size, so it is rounded
            ratio = tracked_mcf.default_detail_size(*read_off(MESH)) / report["detail_size"]
            self.assertAlmostEqual(ratio, 1, delta=1e-14)

    def test_version(self):
        said = subprocess.run([TOOL, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(said, f"tracked_mcf {tracked_mcf.__version__}\n")
        self.assertEqual(self.function()[1]["version"], tracked_mcf.__version__)
        self.assertEqual(importlib.metadata.version("tracked-mcf"), tracked_mcf.__version__)


class NoiseProgram(Program):
    function = staticmethod(remove_noise)
    subcommand = ["remove-noise"]


class Arrays(unittest.TestCase):
    function, wrong = staticmethod(smooth), WRONG + FLOW_WRONG

    def test_layouts_and_types(self):
        expected = self.function()[0]
        self.assertEqual((expected.dtype, expected.shape), (float, VERTICES.shape))
        self.assertTrue(expected.flags.writeable)
        wide = numpy.zeros((len(VERTICES), 6))
        wide[:, ::2] = VERTICES
        for vertices in (VERTICES.tolist(), numpy.asfortranarray(VERTICES), wide[:, ::2],
                         VERTICES.astype(">f8"), VERTICES[::-1][::-1]):
            self.assertEqual(self.function(vertices)[0].tobytes(), expected.tobytes())
        for faces in (FACES.tolist(), numpy.asfortranarray(FACES), FACES.astype("u2"), FACES.astype("u8"),
                      FACES.astype(">i4")):
            self.assertEqual(self.function(faces=faces)[0].tobytes(), expected.tobytes())

    def test_none_is_the_default_of_each_parameter(self):
        names = list(inspect.signature(getattr(tracked_mcf, self.function.__name__)).parameters)[2:]
        nothing = {name: None for name in names if name not in COARSE}
        self.assertEqual(self.function(**nothing)[0].tobytes(), self.function()[0].tobytes())

    def test_indices_select_faces_and_fix_vertices(self):
        chosen = VERTICES[FACES].mean(axis=1)[:, 0] > 0
        self.assertEqual(self.function(selected=numpy.flatnonzero(chosen))[0].tobytes(),
                         self.function(selected=chosen)[0].tobytes())
        fixed = VERTICES[:, 1] > 0.5
        moved, _ = self.function(fixed=fixed)
        self.assertEqual(self.function(fixed=numpy.flatnonzero(fixed))[0].tobytes(), moved.tobytes())
        stays = (moved == VERTICES).all(axis=1)
        self.assertTrue(stays[fixed].all())
        self.assertLess(stays[~fixed].mean(), 0.3)
        weak = self.function(fixed=fixed, strength=numpy.full(1600, 0.5))[0]
        self.assertEqual(weak[fixed].tobytes(), VERTICES[fixed].tobytes())
        self.assertNotEqual(weak.tobytes(), moved.tobytes())
        self.assertEqual(self.function(fixed=[])[0].tobytes(), self.function()[0].tobytes())

    def test_reports_have_the_documented_keys(self):
        kind = tracked_mcf.NoiseReport if self.function is remove_noise else tracked_mcf.FlowReport
        report = self.function(quality="displacement")[1]
        self.assertEqual(set(report), set(typing.get_type_hints(kind)))
        if self.function is smooth:
            self.assertEqual(set(report["steps"][0]), set(typing.get_type_hints(tracked_mcf._reports.StepReport)))

    def test_single_precision_stays(self):
        single = VERTICES.astype("f4")
        moved = self.function(single)[0]
        self.assertEqual(moved.dtype, numpy.float32)
        self.assertEqual(moved.tobytes(), self.function(single.astype(float))[0].astype("f4").tobytes())

    def test_given_arrays_never_change(self):
        vertices, faces, selected = VERTICES.copy(), FACES.copy(), numpy.ones(len(FACES), bool)
        for array in (vertices, faces, selected):
            array.flags.writeable = False
        moved = self.function(vertices, faces, selected=selected)[0]
        self.assertFalse(numpy.shares_memory(moved, vertices))
        self.assertEqual(vertices.tobytes() + faces.tobytes(), VERTICES.tobytes() + FACES.tobytes())

    def test_results_outlive_each_other(self):
        vertices, report = self.function(quality="displacement")
        quality = report.pop("quality")
        copies = vertices.copy(), quality.copy()
        del report
        self.function(quality="displacement")
        self.assertEqual(vertices.tobytes(), copies[0].tobytes())
        self.assertEqual(quality.tobytes(), copies[1].tobytes())
        self.assertEqual(quality.shape, (len(VERTICES),))

    def test_refused_arrays(self):
        far = FACES.astype("u8")
        far[-1, -1] = 2**63
        for vertices, faces, words in (
                (VERTICES[:, :2], FACES, "vertices has the shape (1600, 2) and the type float64"),
                (VERTICES[0], FACES, "shape (3,)"),
                (VERTICES + 1j, FACES, "type complex128"),
                (VERTICES.astype(str), FACES, "give an array of shape (n, 3) of real numbers"),
                (numpy.where(VERTICES > 0.99, numpy.nan, VERTICES), FACES, "not a finite number"),
                ([], [], "shape (0,)"),
                (None, FACES, "vertices has the shape () and the type object"),
                (VERTICES, FACES[:0], "The mesh has no faces"),
                (VERTICES, FACES[:, [0, 1, 2, 2]], "split larger faces first"),
                (VERTICES, FACES.astype(float), "faces has the shape (3042, 3) and the type float64"),
                (VERTICES, FACES - 1, "vertex -1, which does not exist"),
                (VERTICES, FACES + 1, "vertex 1600, which does not exist: vertices has 1600 rows"),
                (VERTICES, FACES + 2**32, "vertex 4294967296, which does not exist"),
                (VERTICES, far, "vertex 9223372036854775808, which does not exist")):
            with self.subTest(words), self.assertRaises(InvalidMesh) as raised:
                self.function(vertices, faces)
            self.assertIn(words, str(raised.exception))

    def test_refused_parameters(self):
        before = VERTICES.tobytes() + FACES.tobytes()
        for parameters, kind, words in self.wrong:
            with self.subTest(**parameters), self.assertRaises(kind) as raised:
                self.function(**parameters)
            self.assertIs(type(raised.exception), kind)
            self.assertIn(words, str(raised.exception))
        self.assertEqual(VERTICES.tobytes() + FACES.tobytes(), before)


class Ranges(unittest.TestCase):
    def test_what_is_outside_the_ranges_is_refused_and_named(self):
        selected = numpy.arange(len(FACES)) < 1000
        for function in tracked_mcf.smooth, tracked_mcf.remove_noise, tracked_mcf.fair:
            for name, parameter in inspect.signature(function).parameters.items():
                outside = {int: [-1, 10**30, -10**30], float: [-1.0, numpy.nan, numpy.inf, -numpy.inf],
                           str: ["x"]}.get(type(parameter.default), [])
                for value in outside:
                    with self.subTest(function.__name__, **{name: value}), self.assertRaises(InvalidParameter) as raised:
                        function(VERTICES, FACES, **{"selected": selected, name: value})
                    self.assertTrue(str(raised.exception).startswith(f"{name} is "), raised.exception)


class Meshes(unittest.TestCase):
    """Meshes of other packages. Open3D, whose package has 400 MB, is a stand-in with its members."""

    def moved(self, mesh):
        result, report = tracked_mcf.smooth(mesh, **COARSE)
        self.assertIs(type(result), type(mesh))
        return result

    def test_trimesh(self):
        trimesh = self.package("trimesh")
        mesh = trimesh.Trimesh(VERTICES, FACES, process=False)
        normals = mesh.vertex_normals.copy()
        result = self.moved(mesh)
        self.assertEqual(result.vertices.tobytes(), smooth()[0].tobytes())
        self.assertEqual(mesh.vertices.tobytes(), VERTICES.tobytes())
        self.assertGreater(abs(result.vertex_normals - normals).max(), 0.01)
        *_, (step, last) = tracked_mcf.steps(mesh, **COARSE)
        self.assertEqual((step, last.vertices.tobytes()), (3, result.vertices.tobytes()))
        self.assertEqual(tracked_mcf.default_detail_size(mesh), tracked_mcf.default_detail_size(VERTICES, FACES))

    def package(self, name):
        try:
            return importlib.import_module(name)
        except ImportError:
            self.skipTest(f"needs {name}")

    def test_meshio(self):
        meshio = self.package("meshio")
        mesh = meshio.Mesh(VERTICES, {"triangle": FACES, "line": FACES[:, :2]}, point_data={"kept": VERTICES})
        result = self.moved(mesh)
        self.assertEqual(result.points.tobytes(), smooth()[0].tobytes())
        self.assertEqual(mesh.points.tobytes(), VERTICES.tobytes())
        self.assertEqual((list(result.cells_dict), list(result.point_data)), (["triangle", "line"], ["kept"]))
        with self.assertRaisesRegex(InvalidMesh, "The mesh has quad; give triangles only"):
            tracked_mcf.smooth(meshio.Mesh(VERTICES, {"triangle": FACES, "quad": numpy.c_[FACES, FACES[:, :1]]}))

    def test_pyvista_grid(self):
        pyvista = self.package("pyvista")
        mesh = pyvista.UnstructuredGrid({pyvista.CellType.TRIANGLE: FACES, pyvista.CellType.LINE: FACES[:, :2]}, VERTICES)
        self.assertEqual(self.moved(mesh).points.tobytes(), smooth()[0].tobytes())
        self.assertEqual(mesh.points.tobytes(), VERTICES.tobytes())
        for kind, corners, name in ((pyvista.CellType.QUAD, 4, "quad"), (pyvista.CellType.WEDGE, 6, "cells of type 13")):
            mesh = pyvista.UnstructuredGrid({kind: numpy.resize(FACES, (100, corners))}, VERTICES)
            with self.assertRaisesRegex(InvalidMesh, f"The mesh has {name}; give triangles only"):
                tracked_mcf.smooth(mesh)

    def test_pyvista(self):
        pyvista = self.package("pyvista")
        mesh = pyvista.PolyData.from_regular_faces(VERTICES, FACES)
        mesh.point_data["kept"] = numpy.arange(len(VERTICES))
        mesh.compute_normals(inplace=True, split_vertices=False, consistent_normals=False, auto_orient_normals=False)
        result = self.moved(mesh)
        self.assertEqual(result.points.astype(float).tobytes(), smooth(mesh.points)[0].astype(float).tobytes())
        self.assertEqual((sorted(result.point_data), sorted(mesh.point_data)), (["kept"], ["Normals", "kept"]))
        with self.assertRaisesRegex(InvalidMesh, "triangulate"):
            tracked_mcf.smooth(pyvista.Plane())

    def test_open3d(self):
        calls = []
        mesh = types.SimpleNamespace(vertices=Vector(VERTICES), triangles=Vector(FACES), has_vertex_normals=lambda: True,
                     compute_vertex_normals=lambda: calls.append("vertices"))
        self.assertEqual(numpy.asarray(self.moved(mesh).vertices).tobytes(), smooth()[0].tobytes())
        self.assertEqual(calls, ["vertices"])

    def test_anything_else_is_refused(self):
        for mesh, words in ((VERTICES, "faces is missing: give arrays of vertices and faces"),
                            (None, "give arrays of vertices and faces"), ("scan.ply", "is the name of a file")):
            with self.assertRaisesRegex(TypeError, words):
                tracked_mcf.smooth(mesh)


class Vector(list):
    """Stands for Open3D's vectors, which are made from arrays."""


class NoiseArrays(Arrays):
    function, wrong = staticmethod(remove_noise), WRONG + NOISE_WRONG

    def test_no_vertex_exceeds_the_bound(self):
        for vertices in VERTICES, VERTICES.astype("float32"), 100 + VERTICES.astype("float32"):
            for bound in 1e-2, 1e-4:
                moved, report = remove_noise(vertices, largest_movement=bound)
                x, y, z = (moved.astype(float) - vertices.astype(float)).T
                largest = numpy.sqrt(x * x + y * y + z * z).max()
                self.assertGreater(report["bounded_vertices"], 100)
                self.assertTrue(0.8 * bound < largest <= bound, largest)

    def test_the_defaults_remove_noise(self):
        def noise(vertices):
            x, y, z = vertices[(abs(vertices[:, :2]) < 0.8).all(axis=1)].T
            return numpy.std(z - (x * x + y * y) / 2)

        self.assertLess(noise(remove_noise()[0]), 0.5 * noise(VERTICES))


class Curvature(unittest.TestCase):
    def test_of_a_sphere(self):
        trimesh = self.package("trimesh")
        sphere = trimesh.creation.icosphere(5, radius=2)  # with edges of 0.075
        curvature = tracked_mcf.mean_curvature(sphere, detail_size="10%")
        self.assertEqual(curvature.shape, (len(sphere.vertices),))
        self.assertLess(abs(curvature - 0.5).max(), 0.005)
        scale = 1 + numpy.random.default_rng(1).normal(scale=0.003, size=(len(sphere.vertices), 1))
        error = tracked_mcf.mean_curvature(scale * sphere.vertices, sphere.faces, detail_size=0.75) - 0.5
        self.assertLess(numpy.sqrt((error**2).mean()), 0.05)
        half = tracked_mcf.mean_curvature(sphere, selected=sphere.triangles_center[:, 2] > 0)
        self.assertEqual(half[sphere.vertices[:, 2] < -0.1].max(), 0)

    package = Meshes.package
class Fair(unittest.TestCase):
    def test_wrong_selections_are_refused(self):
        for selected, words in ((numpy.ones(len(FACES), bool), "nothing around"),
                                (numpy.zeros(len(FACES), bool), "No face is selected")):
            with self.assertRaisesRegex(InvalidMesh, words):
                tracked_mcf.fair(VERTICES, FACES, selected=selected)
        with self.assertRaisesRegex(InvalidParameter, "give the faces that fill the hole"):
            tracked_mcf.fair(VERTICES, FACES)
        with self.assertRaisesRegex(InvalidParameter, "give one of 'position', 'tangent', 'curvature'"):
            tracked_mcf.fair(VERTICES, FACES, selected=HOLE, continuity="c1")

    def test_without_inner_vertices_nothing_moves(self):
        with self.assertWarnsRegex(tracked_mcf.MeshWarning, "no inner vertices"):
            moved, report = tracked_mcf.fair(VERTICES, FACES, selected=[0])
        self.assertEqual(moved.tobytes(), VERTICES.tobytes())
        self.assertEqual((report["patches"], report["triangles"], report["volume_change"]), (0, 1, 0.0))

    def test_rough_surroundings_are_a_warning(self):
        rough = VERTICES + numpy.random.default_rng(1).normal(scale=0.02, size=VERTICES.shape)
        with self.assertWarnsRegex(tracked_mcf.MeshWarning, "Remove noise first"):
            fair(rough)

    def test_reports_have_the_documented_keys(self):
        self.assertEqual(set(fair(quality="displacement")[1]), set(typing.get_type_hints(tracked_mcf.FairReport)))


class Errors(unittest.TestCase):
    def test_classes(self):
        for kind, builtin in ((InvalidMesh, ValueError), (InvalidParameter, ValueError),
                              (tracked_mcf.NotEnoughMemory, MemoryError), (tracked_mcf.Cancelled, Error)):
            self.assertTrue(issubclass(kind, (Error,)) and issubclass(kind, builtin))
            copy = pickle.loads(pickle.dumps(kind("text")))
            self.assertEqual((type(copy), str(copy)), (kind, "text"))

    @unittest.skipUnless(sys.platform == "linux", "limits memory")
    def test_not_enough_memory(self):
        script = ("import resource, tracked_mcf, arrays_test\n"
                  "limit = 1 << 30\n"
                  "resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))\n"
                  "try: arrays_test.smooth(method='paper', depth=12)\n"
                  "except tracked_mcf.NotEnoughMemory as error: print(error)")
        self.assertIn("Choose a smaller depth", said_by(script))

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            _, report = smooth(detail_size=0.01)
        self.assertEqual([str(warning.message) for warning in caught], report["warnings"])
        self.assertIn(" mean edges; below 2 little changes", report["warnings"][0])
        self.assertIs(caught[0].category, tracked_mcf.MeshWarning)
        self.assertTrue(issubclass(tracked_mcf.MeshWarning, UserWarning))
        self.assertEqual(caught[0].filename, __file__)
        with self.assertWarnsRegex(tracked_mcf.MeshWarning, "all of the surface is held") as raised:
            remove_noise(faces=FACES[:1], boundary="locked")
        self.assertEqual(raised.filename, __file__)
        with warnings.catch_warnings(), self.assertRaises(tracked_mcf.MeshWarning):
            warnings.simplefilter("error")
            smooth(detail_size=0.01)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(smooth()[1]["warnings"], [])


class Progress(unittest.TestCase):
    def test_fractions_and_phases(self):
        for function in smooth, remove_noise:
            calls = []
            function(progress=lambda fraction, phase: calls.append((fraction, phase)))
            fractions = [fraction for fraction, _ in calls]
            self.assertEqual(fractions, sorted(fractions))
            self.assertEqual(fractions[-1], 1)
            self.assertRegex(" ".join(phase for _, phase in calls), "Step 1 of [1-9] ")

    def test_true_draws_a_bar(self):
        script = ("import sys, arrays_test\n"
                  "{}"
                  "arrays_test.smooth(depth=7, progress=True, iterations=20)\n"
                  "list(arrays_test.Steps().steps(progress=True))")
        for without_tqdm in "", "sys.modules['tqdm'] = sys.modules['tqdm.auto'] = None\n":
            done = subprocess.run([sys.executable, "-c", script.format(without_tqdm)], cwd=HERE, check=True,
                                  capture_output=True, text=True)
            self.assertRegex(done.stderr, r"\d%[^\r]*")
            self.assertEqual(done.stdout, "")

    def test_false_cancels(self):
        for function, no in ((smooth, False), (smooth, numpy.False_), (remove_noise, False)):
            calls = []
            with self.assertRaises(tracked_mcf.Cancelled):
                function(progress=lambda *call: (calls.append(call), no)[1])
            self.assertEqual(len(calls), 1)
        smooth(progress=lambda *_: True)

    def test_exceptions_propagate(self):
        class Unknown(Exception):
            pass

        error = Unknown()

        def fail(*_):
            raise error

        with self.assertRaises(Unknown) as raised:
            smooth(progress=fail)
        self.assertIs(raised.exception, error)

    def test_interrupt(self):
        """Without progress: Python itself looks for interrupts when it runs a function."""
        script = ("import _thread, threading, arrays_test\n"
                  "threading.Timer(0.3, _thread.interrupt_main).start()\n"
                  "try: arrays_test.smooth(depth=7, iterations=100000)\n"
                  "except KeyboardInterrupt: print('interrupted')")
        self.assertEqual(said_by(script), "interrupted\n")

    def test_other_threads_run(self):
        flow = threading.Thread(target=lambda: smooth(iterations=300))
        flow.start()
        turns = 0  # one or two if the flow kept the interpreter to itself
        while flow.is_alive():
            time.sleep(0.001)
            turns += 1
        self.assertGreater(turns, 10)


class Steps(unittest.TestCase):
    def steps(self, vertices=VERTICES, **parameters):
        return tracked_mcf.steps(vertices, FACES, **{**COARSE, **parameters})

    def test_are_those_of_shorter_flows(self):
        seen = list(self.steps(step_size=1e-3, iterations=5, every=2))
        self.assertEqual([step for step, _ in seen], [2, 4])
        for step, moved in seen:
            self.assertEqual(moved.tobytes(), smooth(step_size=1e-3, iterations=step)[0].tobytes())
        flow = self.steps(VERTICES.astype("float32"), order=2)
        self.assertIsNone(flow.report)
        *_, (step, last) = flow
        self.assertEqual(len(flow.report["steps"]), 3)
        self.assertEqual((step, last.dtype), (3, numpy.float32))
        self.assertEqual(last.tobytes(), smooth(VERTICES.astype("float32"), order=2)[0].tobytes())

    def test_leaving_the_loop_ends_the_flow(self):
        for step, _ in self.steps(depth=7, iterations=100000):
            if step == 2:
                break
        self.assertEqual(threading.active_count(), 1)

    def test_errors(self):
        for parameters, error in (({"order": 5}, InvalidParameter), ({"every": 0}, InvalidParameter),
                                  ({"oder": 5}, TypeError),
                                  ({"progress": lambda *_: False}, tracked_mcf.Cancelled)):
            with self.assertRaises(error):
                list(self.steps(**parameters))
        with self.assertRaises(InvalidMesh):
            list(tracked_mcf.steps(VERTICES, FACES + 10000))
        self.assertEqual(threading.active_count(), 1)

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            self.assertEqual(len(list(self.steps(detail_size=0.01))), 3)
        self.assertIn(" mean edges; below 2 little changes", str(caught[0].message))
        self.assertIs(caught[0].category, tracked_mcf.MeshWarning)
        self.assertEqual(caught[0].filename, __file__)

    def test_interrupt(self):
        script = ("import _thread, threading, arrays_test\n"
                  "threading.Timer(0.5, _thread.interrupt_main).start()\n"
                  "try:\n"
                  "    for _ in arrays_test.Steps().steps(depth=7, iterations=100000, every=50000): pass\n"
                  "except KeyboardInterrupt: print('interrupted')")
        self.assertEqual(said_by(script), "interrupted\n")


class Processes(unittest.TestCase):
    def setUp(self):
        self.expected = [smoothed_bowl(seed) for seed in range(10)]  # in several threads, before fork

    @unittest.skipUnless("fork" in multiprocessing.get_all_start_methods(), "needs fork")
    def test_forked_processes(self):
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(pool.map_async(smoothed_bowl, range(10)).get(timeout=120), self.expected)
            with self.assertRaises(InvalidParameter):
                pool.map_async(refuse_bowl, [0]).get(timeout=120)

    def test_threads(self):
        with multiprocessing.pool.ThreadPool(2) as pool:
            self.assertEqual(pool.map_async(smoothed_bowl, range(10)).get(timeout=120), self.expected)


class Documents(WithFolder):
    def test_signatures_and_docstring_have_all_parameters(self):
        for function in fair, remove_noise, smooth:
            public = getattr(tracked_mcf, function.__name__)
            keywords = inspect.signature(public).parameters
            names = list(keywords)
            fixed = [] if function is fair else ["fixed"]
            self.assertEqual(names, ["vertices", "faces", *function()[1]["parameters"], *fixed, "progress"])
            lines = inspect.getdoc(public).splitlines()
            self.assertLessEqual(max(map(len, lines)), 76)  # help() indents them by 4
            for name in names[2:]:
                self.assertRegex(inspect.getdoc(public), f"\n    {name}\\b")
        for name, value in (("detail_size", 0.0), ("order", 2), ("preserve", "none"), ("selected", None)):
            self.assertIs(type(keywords[name].default), type(value))
            self.assertEqual(keywords[name].default, value)
        self.assertEqual(keywords["preserve"].annotation, "Literal['none', 'area', 'volume'] | None")
        self.assertEqual([name for name in inspect.signature(tracked_mcf.steps).parameters if name != "every"], names)
        if sys.version_info >= (3, 10):  # with types such as `float | str`
            for function in (tracked_mcf.fair, tracked_mcf.remove_noise, tracked_mcf.smooth, tracked_mcf.steps,
                             tracked_mcf.default_detail_size, tracked_mcf.mean_curvature):
                known = {*inspect.signature(function).parameters, "return"}
                self.assertEqual(set(typing.get_type_hints(function)), known)
        self.assertTrue((pathlib.Path(tracked_mcf.__file__).parent / "py.typed").exists())

    def test_wrong_calls_get_short_errors(self):
        for call in (lambda: tracked_mcf.remove_noise(VERTICES, FACES, 1),
                     lambda: tracked_mcf.smooth(VERTICES, FACES, 1),
                     lambda: tracked_mcf.steps(VERTICES, FACES, oder=2),
                     lambda: tracked_mcf.default_detail_size(VERTICES, FACES, order=2)):
            with self.assertRaises(TypeError) as raised:
                call()
            self.assertLess(len(str(raised.exception)), 100)

    def test_readme(self):
        """The README's script runs, and writes what it says."""
        try:
            import trimesh
        except ImportError:
            self.skipTest("needs trimesh")
        blocks = pathlib.Path(README).read_text(encoding="utf-8").split("```python\n")[1:]
        [script] = [block.split("```")[0] for block in blocks if "trimesh" in block]
        done = subprocess.run([sys.executable, "-W", "error", "-c", script], cwd=self.folder, check=True,
                              capture_output=True, text=True)
        noise, before, after = map(float, done.stdout.split())
        self.assertAlmostEqual(noise, 0.005, delta=0.0005)
        self.assertTrue(0.98 * before < after < before, done.stdout)
        radii = numpy.linalg.norm(trimesh.load_mesh(self.folder / "smooth.ply").vertices, axis=1)
        self.assertLess(radii.std(), 0.002)  # the noise was 0.005


if __name__ == "__main__":
    TOOL, MESH, README = sys.argv[1:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
