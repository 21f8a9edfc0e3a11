#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How well faired patches continue a surface, beside the membrane and CGAL's fair().

Shapes: a part of a sphere, cylinder or torus is replaced by its membrane, as if a hole had been filled, and faired.
The error is the largest distance from the shape, in per cent of the radius. Cut holes: disks of some rings are cut
out of closed scans at random and filled by the membrane with the original triangles; the error is the RMS distance
of the patch's vertices from the original surface, in mean edges. Real holes: MeshLab's Close Holes and Isotropic
Explicit Remeshing fill and refine those of open scans; the original is unknown, so the error is the mean angle between
normals of faces across the seam, in degrees.

Rough surroundings: the shapes with noise or needles around the hole. The error is the RMS distance from the shape, in
mean edges. Noise moves every vertex by a normal distribution along each axis. Needles slide a sixth of the vertices in
four rings around the hole towards a neighbour. Crossings are pairs of triangles, one at least in the patch, that cross
and have no vertex in common.

Needs tracked_mcf_cgal_fair in the build folder, which TRACKED_MCF_CGAL builds; without it, CGAL is left out.
"""

import pathlib
import shutil
import subprocess
import tempfile

import numpy
from bilateral import area_vectors, unit
from experiment import Experiment
from measures import pair_cosines, topology_of
from ply import read_mesh, write_ply
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree
from shapes import grid_faces
from surface import Surface

CONTINUITIES = ["position", "tangent", "curvature"]
SEED = 1
CLOSED = ["hand_8k.ply", "nefertiti_50k.ply", "armadillo_50k.ply", "skull_50k.ply", "boot_genus12.ply",
          "elephant_5cc.ply"]
HOLES = 102  # in all
RINGS = [4, 8, 12]
OPEN = ["stanford_bunny.ply", "laurana50k.ply", "mannequin_11k.ply", "demosthenes_8k.ply"]


class Runner:
    """Fairs meshes in a temporary folder."""

    def __init__(self, experiment, folder):
        self.experiment, self.folder = experiment, pathlib.Path(folder)
        self.cgal_program = experiment.options.build / "tracked_mcf_cgal_fair"

    def ours(self, vertices, faces, selected, continuity):
        """Returns vertices, and the report with the processor seconds, files included."""
        moved, report, seconds = self.experiment.smoothed(
            vertices, faces, "--selected", "selected", "--continuity", continuity, command="fair", selected=selected)
        return moved, {**report, "processor_seconds": seconds}

    def cgal(self, vertices, faces, selected, continuity):
        """Returns vertices and times, or None."""
        if not self.cgal_program.exists():
            return None
        source, target = self.folder / "in.ply", self.folder / "out.bin"
        write_ply(source, vertices, faces, selected)
        words = subprocess.run([self.cgal_program, source, target, str(CONTINUITIES.index(continuity))], check=True,
                               stdout=subprocess.PIPE, text=True).stdout.split()
        if words[0] != "1":
            return None
        return (numpy.fromfile(target, "<f8").reshape(-1, 3),
                dict(zip(("wall_seconds", "processor_seconds", "peak_bytes"), map(float, words[1:]))))


def sphere(frequency):
    """Returns a geodesic sphere."""
    t = (1 + 5 ** 0.5) / 2
    points = numpy.array([[-1, t, 0], [1, t, 0], [-1, -t, 0], [1, -t, 0], [0, -1, t], [0, 1, t], [0, -1, -t],
                          [0, 1, -t], [t, 0, -1], [t, 0, 1], [-t, 0, -1], [-t, 0, 1]], float)
    icosahedron = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                   (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
                   (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    number, weights, triangles = {}, [], []
    for i in range(frequency + 1):
        for j in range(frequency + 1 - i):
            number[i, j] = len(weights)
            weights.append((i, j, frequency - i - j))
    for i in range(frequency):
        for j in range(frequency - i):
            triangles.append((number[i, j], number[i + 1, j], number[i, j + 1]))
            if j < frequency - i - 1:
                triangles.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    weights, triangles = numpy.array(weights) / frequency, numpy.array(triangles)
    vertices = numpy.vstack([weights @ points[list(face)] for face in icosahedron])
    faces = numpy.vstack([triangles + k * len(weights) for k in range(20)])
    _, first, inverse = numpy.unique(numpy.round(vertices * 1e6).astype(int), axis=0, return_index=True,
                                     return_inverse=True)
    vertices = vertices[first] / numpy.linalg.norm(vertices[first], axis=1)[:, None]
    return vertices, inverse.reshape(-1)[faces]


def tube(n):
    angle = 2 * numpy.pi * numpy.arange(3 * n) / (3 * n)
    z = numpy.linspace(-2, 2, 2 * n + 1)
    vertices = numpy.stack([numpy.repeat(numpy.cos(angle), len(z)), numpy.repeat(numpy.sin(angle), len(z)),
                            numpy.tile(z, len(angle))], 1)
    return vertices, grid_faces(3 * n, 2 * n, 1)


def torus(n):
    u, v = (axis.ravel() for axis in numpy.meshgrid(2 * numpy.pi * numpy.arange(5 * n) / (5 * n),
                                                    2 * numpy.pi * numpy.arange(2 * n) / (2 * n), indexing="ij"))
    radius = 1 + 0.4 * numpy.cos(v)
    return (numpy.stack([radius * numpy.cos(u), radius * numpy.sin(u), 0.4 * numpy.sin(v)], 1),
            grid_faces(5 * n, 2 * n, 2))


def from_sphere(points):
    return numpy.linalg.norm(points, axis=1) - 1


def from_cylinder(points):
    return numpy.hypot(points[:, 0], points[:, 1]) - 1


def from_torus(points):
    return (numpy.hypot(numpy.hypot(points[:, 0], points[:, 1]) - 1, points[:, 2]) - 0.4) / 0.4


SHAPES = {
    **{f"sphere, {degrees}°": (sphere, lambda p, z=numpy.cos(numpy.radians(degrees)): p[:, 2] > z, from_sphere)
       for degrees in (30, 60, 90)},
    "cylinder, side": (tube, lambda p: (p[:, 0] > 0.2) & (abs(p[:, 2]) < 0.7), from_cylinder),
    "cylinder, ring": (tube, lambda p: abs(p[:, 2]) < 0.7, from_cylinder),
    "torus": (torus, lambda p: (p[:, 0] > 0.9) & (abs(p[:, 1]) < 0.4), from_torus)}


def measure_shapes(experiment, runner):
    experiment.say("## Shapes\n\nLargest distance from the shape in per cent of its radius. Each n has half the edge "
                   "length of the one before. Errors tend to those of the equations, which are no sphere's. CGAL "
                   "begins with the same membrane.\n")
    sizes = [8, 16] if experiment.options.quick else [8, 16, 32]
    rows, errors = [], {}
    for name, (make, inside, distance) in SHAPES.items():
        for size in sizes:
            vertices, faces = make(size)
            moving = inside(vertices)
            selected = moving[faces].any(axis=1)
            flat, _ = runner.ours(vertices, faces, selected, "position")
            for continuity in CONTINUITIES:
                results = {"ours": runner.ours(flat, faces, selected, continuity),
                           "CGAL": runner.cgal(flat, faces, selected, continuity)}
                for program, result in results.items():
                    if result is not None:
                        errors[name, continuity, program, size] = 100 * float(abs(distance(result[0][moving])).max())
    for name in SHAPES:
        for continuity in CONTINUITIES:
            for program in "ours", "CGAL":
                found = [errors.get((name, continuity, program, size)) for size in sizes]
                if None in found:
                    continue
                rows.append([name, continuity, program, *found])
                experiment.record([{"table": "shapes", "shape": name, "continuity": continuity, "program": program,
                                    "size": size, "per_cent": error} for size, error in zip(sizes, found)])
    experiment.table(["shape", "continuity", "program", *(f"n = {size}" for size in sizes)], rows)
    last = sizes[-1]
    experiment.check("sphere, 60°, tangent, per cent", errors["sphere, 60°", "tangent", "ours", last], at_most=10)
    experiment.check("sphere, 60°, curvature, per cent", errors["sphere, 60°", "curvature", "ours", last], at_most=1)
    if ("torus", "tangent", "CGAL", last) in errors:
        worst = max(errors[name, continuity, "ours", last] / errors[name, continuity, "CGAL", last]
                    for name in SHAPES for continuity in CONTINUITIES[1:])
        experiment.check("tangent and curvature: largest error over CGAL's", worst, at_most=1.01)


def crossings(vertices, faces, selected):
    """Returns the number of pairs of triangles that cross, have no common vertex, and one of which is selected."""
    corners = vertices[faces]
    middles = corners.mean(axis=1)
    radii = numpy.linalg.norm(corners - middles[:, None], axis=2).max(axis=1)
    chosen = numpy.flatnonzero(selected)
    near = cKDTree(middles).query_ball_point(middles[chosen], radii[chosen] + radii.max())
    first, second = numpy.repeat(chosen, [len(row) for row in near]), numpy.concatenate(near).astype(int)
    apart = (faces[first][:, :, None] != faces[second][:, None, :]).all(axis=(1, 2))
    apart &= ~selected[second] | (first < second)
    first, second = first[apart], second[apart]

    def pierced(a, b):
        """Returns whether a side of a triangle passes through another one."""
        normals = numpy.cross(corners[b, 1] - corners[b, 0], corners[b, 2] - corners[b, 0])
        found = numpy.zeros(len(a), bool)
        for k in range(3):
            start, end = corners[a, k], corners[a, (k + 1) % 3]
            above, below = (((p - corners[b, 0]) * normals).sum(axis=1) for p in (start, end))
            with numpy.errstate(all="ignore"):
                point = start + (end - start) * (above / (above - below))[:, None]
                inside = above * below < 0
                for i in range(3):
                    side = corners[b, (i + 1) % 3] - corners[b, i]
                    inside &= (numpy.cross(side, point - corners[b, i]) * normals).sum(axis=1) > 0
            found |= inside
        return found

    return int((pierced(first, second) | pierced(second, first)).sum())


def surroundings(vertices, faces, selected, random):
    """Yields names and vertices with noise, or with needles around what is selected."""
    edge = mean_edge(vertices, faces)
    yield "smooth", vertices
    for noise in (0.03, 0.1, 0.3):
        yield f"noise of {noise} edges", vertices + noise * edge * random.normal(size=vertices.shape)
    adjacency = neighbours(faces, len(vertices))
    inner = numpy.ones(len(vertices), bool)
    inner[faces[~selected]] = False
    ring = inner
    for _ in range(4):
        ring = ring | (adjacency @ ring)
    around = numpy.flatnonzero(ring & ~inner)
    for share in (0.9, 0.99, 0.9999):
        moved = vertices.copy()
        for vertex in random.choice(around, len(around) // 6, replace=False):
            other = random.choice(adjacency[vertex].indices)
            moved[vertex] += share * (vertices[other] - vertices[vertex])
        yield f"needles, {share} of the way", moved


def measure_surroundings(experiment, runner):
    experiment.say("\n## Rough surroundings\n\nMedian and largest RMS distance from the shapes, in edges; crossings; patches "
                   "that took less continuity, and patches that a warning called rough.\n")
    random = numpy.random.default_rng(SEED)
    rows = []
    for size in [8] if experiment.options.quick else [8, 16, 24]:
        for name, (make, inside, distance) in SHAPES.items():
            vertices, faces = make(size)
            moving = inside(vertices)
            selected = moving[faces].any(axis=1)
            scale = mean_edge(vertices, faces) / (0.4 if name == "torus" else 1)
            for around, rough in surroundings(vertices, faces, selected, random):
                flat, _ = runner.ours(rough, faces, selected, "position")
                row = {"table": "surroundings", "shape": name, "size": size, "around": around}
                for continuity in CONTINUITIES:
                    moved, report = runner.ours(flat, faces, selected, continuity)
                    row[continuity] = float(numpy.sqrt((distance(moved[moving]) ** 2).mean())) / scale
                    row[f"crossings {continuity}"] = crossings(moved, faces, selected)
                    row[f"less {continuity}"] = report["flatter_patches"]
                    row[f"rough {continuity}"] = report["rough_patches"]
                rows.append(row)
    experiment.record(rows)
    table = []
    for around in dict.fromkeys(row["around"] for row in rows):
        for continuity in CONTINUITIES:
            errors, crossed, less, rough = (
                numpy.array([row[key] for row in rows if row["around"] == around])
                for key in (continuity, f"crossings {continuity}", f"less {continuity}", f"rough {continuity}"))
            table.append([around, continuity, len(errors), float(numpy.median(errors)), float(errors.max()),
                          int(crossed.sum()), int(less.sum()), int(rough.sum())])
    experiment.table(["surroundings", "continuity", "patches", "median", "largest", "crossings", "less continuity",
                      "called rough"], table)
    for continuity in CONTINUITIES[1:]:
        worst = max(row[continuity] / max(row["position"], 0.2) for row in rows)
        experiment.check(f"{continuity}: largest ratio to the membrane's error, of at least 0.2 edges", worst, at_most=2)


def neighbours(faces, count):
    """Returns the sparse adjacency of the vertices."""
    i, j = faces.ravel(), faces[:, [1, 2, 0]].ravel()
    return coo_matrix((numpy.ones(2 * len(i), bool), (numpy.r_[i, j], numpy.r_[j, i])), (count, count)).tocsr()


def mean_edge(vertices, faces):
    return numpy.linalg.norm(vertices[faces] - vertices[faces[:, [1, 2, 0]]], axis=2).mean()


def distance_to(points, vertices, faces):
    """Returns the distances of points from a surface: from samples of it, 28 on each triangle."""
    n = 6
    weights = numpy.array([(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)]) / n
    samples = (vertices[faces][:, None] * weights[None, :, :, None]).sum(axis=2).reshape(-1, 3)
    normals = unit(area_vectors(vertices, faces))
    away, nearest = cKDTree(samples).query(points)
    along = abs(((points - samples[nearest]) * normals[nearest // len(weights)]).sum(axis=1))
    return numpy.where(away < mean_edge(vertices, faces) / 4, along, away)


def measure_holes(experiment, runner):
    found = [path for path in map((experiment.options.meshes or pathlib.Path("none")).joinpath, CLOSED)
             if path.exists()]
    if not found:
        return
    random = numpy.random.default_rng(SEED)
    holes = 6 if experiment.options.quick else HOLES
    rows = []
    for number in range(holes):
        path = found[number % len(found)]
        if number < len(found):
            print(f"... {path.stem}", flush=True)
        vertices, faces, _ = read_mesh(path)
        size = RINGS[number // len(found) % len(RINGS)]
        rings = dijkstra(neighbours(faces, len(vertices)), indices=random.integers(len(vertices)), unweighted=True,
                         limit=size + 8)
        near = (rings[faces] <= size + 8).all(axis=1)
        used = numpy.unique(faces[near])
        index = numpy.full(len(vertices), -1)
        index[used] = numpy.arange(len(used))
        part, part_faces, part_rings = vertices[used], index[faces[near]], rings[used]
        edge = mean_edge(part, part_faces)
        moving = part_rings < size
        selected = moving[part_faces].any(axis=1)

        def error(moved):
            return float(numpy.sqrt((distance_to(moved[moving], part, part_faces) ** 2).mean())) / edge

        flat, _ = runner.ours(part, part_faces, selected, "position")
        row = {"table": "holes", "mesh": path.stem, "rings": size, "membrane": error(flat)}
        for continuity in CONTINUITIES[1:]:
            moved, report = runner.ours(flat, part_faces, selected, continuity)
            row[continuity] = error(moved)
            if continuity == "tangent":
                row.update({key: report[key] for key in ("seam_curvature", "patch_curvature", "height",
                                                         "rough_patches")})
            else:
                row["flatter_patches"] = report["flatter_patches"]
            result = runner.cgal(flat, part_faces, selected, continuity)
            row[f"CGAL {continuity}"] = error(result[0]) if result else numpy.nan
        rows.append(row)
    experiment.record(rows)
    report_holes(experiment, rows)


def report_holes(experiment, rows):
    experiment.say(f"\n## {len(rows)} holes cut into closed scans\n\nMedian RMS distance to the original, in edges.\n")
    columns = ["membrane", "tangent", "CGAL tangent", "curvature", "CGAL curvature"]
    table = []
    for mesh in [*dict.fromkeys(row["mesh"] for row in rows), "all"]:
        of_mesh = [row for row in rows if mesh in (row["mesh"], "all")]
        better = numpy.array([row["membrane"] < row["tangent"] for row in of_mesh])
        warned = numpy.array([row["rough_patches"] > 0 for row in of_mesh])
        table.append([mesh, len(of_mesh), *(float(numpy.nanmedian([row[name] for row in of_mesh])) for name in columns),
                      f"{better.sum()}", f"{(better & warned).sum()}", f"{(~better & warned).sum()}"])
    experiment.table(["scan", "holes", *columns, "membrane better", "of these warned", "warned of others"], table)
    less = sum(row["flatter_patches"] for row in rows)
    experiment.say(f"- curvature was asked for, and the patch took less: {less} of {len(rows)}")
    for continuity in CONTINUITIES[1:]:
        worst = max(row[continuity] / max(row["membrane"], 0.1) for row in rows)
        experiment.check(f"{continuity}: largest ratio to the membrane's error, of at least 0.1 edges", worst, at_most=3)


FILL = """<!DOCTYPE FilterScript><FilterScript><filter name="Close Holes">
<Param type="RichInt" name="MaxHoleSize" value="300"/><Param type="RichBool" name="Selected" value="false"/>
<Param type="RichBool" name="NewFaceSelected" value="true"/>
<Param type="RichBool" name="SelfIntersection" value="true"/></filter>
<filter name="Remeshing: Isotropic Explicit Remeshing"><Param type="RichInt" name="Iterations" value="10"/>
<Param type="RichBool" name="Adaptive" value="false"/><Param type="RichBool" name="SelectedOnly" value="true"/>
<Param type="RichAbsPerc" name="TargetLen" value="{edge}" min="0" max="1"/>
<Param type="RichFloat" name="FeatureDeg" value="30"/><Param type="RichBool" name="CheckSurfDist" value="false"/>
<Param type="RichAbsPerc" name="MaxSurfDist" value="{edge}" min="0" max="1"/>
<Param type="RichBool" name="SplitFlag" value="true"/><Param type="RichBool" name="CollapseFlag" value="true"/>
<Param type="RichBool" name="SwapFlag" value="true"/><Param type="RichBool" name="SmoothFlag" value="true"/>
<Param type="RichBool" name="ReprojectFlag" value="true"/></filter></FilterScript>"""


def filled(path, folder):
    """Returns the vertices and faces of an open scan whose holes MeshLab has filled, and which faces are new."""
    vertices, faces, _ = read_mesh(path)
    (folder / "fill.mlx").write_text(FILL.format(edge=mean_edge(vertices, faces)), encoding="utf-8")
    subprocess.run(["xvfb-run", "-a", "meshlabserver", "-i", path, "-s", folder / "fill.mlx", "-o",
                    folder / "filled.ply", "-m", "ff"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return read_mesh(folder / "filled.ply")


def seam_angle(vertices, faces, selected):
    """Returns the mean angle between the normals of a selected face and of its neighbour that is not."""
    pairs = topology_of(Surface("", vertices, faces)).pairs_of_faces
    seam = pairs[selected[pairs[:, 0]] != selected[pairs[:, 1]]]
    cosines = pair_cosines(faces, vertices, seam)
    return float(numpy.degrees(numpy.arccos(numpy.clip(cosines, -1, 1))).mean())


def measure_real_holes(experiment, runner):
    folder = experiment.options.meshes
    if folder is None or shutil.which("meshlabserver") is None or experiment.options.quick:
        return
    experiment.say("\n## Real holes\n\nMean angle of the normals across the seam, in degrees.\n")
    rows = []
    for path in (folder / name for name in OPEN if (folder / name).exists()):
        vertices, faces, selected = filled(path, runner.folder)
        shapes, row = {}, {"table": "real holes", "mesh": path.stem}
        shapes["membrane"], _ = runner.ours(vertices, faces, selected, "position")
        for continuity in CONTINUITIES[1:]:
            shapes[continuity], report = runner.ours(vertices, faces, selected, continuity)
            if continuity == "tangent":
                row.update({"patches": report["patches"], "rough": report["rough_patches"],
                            "height": report["height"]})
            result = runner.cgal(shapes["membrane"], faces, selected, continuity)
            if result:
                shapes[f"CGAL {continuity}"] = result[0]
        row.update({name: seam_angle(shape, faces, selected) for name, shape in shapes.items()})
        rows.append(row)
    experiment.record(rows)
    keys = list(dict.fromkeys(key for row in rows for key in row))[1:]
    experiment.table(keys, [[row.get(key, "") for key in keys] for row in rows])


def measure_large(experiment, runner):
    frequency = 40 if experiment.options.quick else 320
    vertices, faces = sphere(frequency)
    selected = (vertices[:, 2] > 0.6)[faces].any(axis=1)
    experiment.say(f"\n## A large patch\n\n{len(vertices)} vertices.\n")
    flat, _ = runner.ours(vertices, faces, selected, "position")
    rows = []
    moved, report = runner.ours(flat, faces, selected, "tangent")
    outside = numpy.ones(len(vertices), bool)
    outside[faces[selected]] = False
    experiment.check("vertices outside that changed", int((moved != flat)[outside].sum()), at_most=0)
    rows.append(["ours", report["vertices"], report["seconds"], report["processor_seconds"],
                 report["peak_memory_bytes"] / 1e6])
    result = runner.cgal(flat, faces, selected, "tangent")
    if result:
        times = result[1]
        rows.append(["CGAL", report["vertices"], times["wall_seconds"], times["processor_seconds"],
                     times["peak_bytes"] / 1e6])
    experiment.table(["program", "vertices that move", "seconds", "processor seconds", "MB"], rows)
    experiment.record([{"table": "large", "program": row[0], "seconds": row[2], "processor_seconds": row[3],
                        "MB": row[4]} for row in rows])


def main():
    experiment = Experiment("fairing", __doc__)
    with tempfile.TemporaryDirectory() as folder:
        runner = Runner(experiment, folder)
        measure_shapes(experiment, runner)
        measure_surroundings(experiment, runner)
        measure_holes(experiment, runner)
        measure_real_holes(experiment, runner)
        measure_large(experiment, runner)
    experiment.finish()


if __name__ == "__main__":
    main()
