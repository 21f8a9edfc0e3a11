# SPDX-License-Identifier: GPL-3.0-or-later
"""Common code of the scripts that reproduce the paper's figures: flows, distances and pictures."""

import atexit
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from experiment import CLAIM, CONVERGED, PAPER, RENDER, Experiment  # noqa: E402

# MeshLab aborts where a vertex rounds to a place outside its grid. At another scale, it rounds otherwise.
SCALES = [10000, 9973, 10007]
METHODS = ["tracked", "rebuilt", "rebuilt-split", "cotangent"]


class Reproduction(Experiment):
    """One figure. Its files are figure_N*.png and figure_N*.csv in the output folder."""

    def __init__(self, name, description, add_options=lambda parser: None):
        super().__init__(name, description, add_options)
        self.say(description.strip().split("\n\n", 1)[1] + "\n")
        self._display = None
        self.surfaces = self.options.build / "surfaces"

    def flow(self, scan, step_size, steps, method="tracked", configuration=CONVERGED, depth=0,
             boundary="free"):
        """Flows a scan and writes its surface after each number of steps. Returns the driver's rows,
        each with the surface's path as `surface`."""
        words = f"{configuration},{boundary}"
        folder = self.surfaces / "_".join([pathlib.Path(scan).stem, method, f"{step_size:g}",
                                           str(depth), re.sub(r"\W", "_", words)])
        rows = self.run("stages", scan, "--depth", depth, "--step-size", step_size, "--steps",
                        *steps, "--configurations", words, "--method", method, "--folder", folder,
                        mesh=pathlib.Path(scan).stem)
        return [{**row, "surface": folder / f"0_{row['steps']}.ply"} for row in rows]

    def claim(self, words, holds):
        """Says whether a claim of the paper holds."""
        self.say(f"{CLAIM[not holds]}{words} ({self.name})")

    def distance(self, surface, reference, samples=200000):
        """Returns the distances between two surfaces as MeshLab's filter "Hausdorff Distance" measures
        them, from both to the other: the greater RMS, and the greater maximum, in diagonals of the
        reference's bounding box. The filter takes long where many triangles are in one place; fewer
        `samples` help."""
        with tempfile.TemporaryDirectory() as folder:
            script, log = pathlib.Path(folder, "distance.mlx"), pathlib.Path(folder, "log.txt")
            call = ["meshlabserver", "-i", str(reference), "-i", str(surface), "-s", str(script), "-l", str(log)]
            for scale in SCALES:
                script.write_text(distance_script(samples, scale), encoding="utf-8")
                done = subprocess.run(call, check=False, env=self.on_display(), stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)
                if done.returncode == 0:
                    return read_distance(log.read_text(encoding="utf-8", errors="replace"))
        sys.exit(f"MeshLab cannot measure the distance of {surface} to {reference}")

    def on_display(self):
        """Returns the environment with a virtual display. Two xvfb-run at a time may choose the same
        one; Xvfb itself does not."""
        if not self._display:
            server = subprocess.Popen(["Xvfb", "-displayfd", "1", "-screen", "0", "1280x1024x24"],
                                      stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            atexit.register(server.kill)
            self._display = f":{server.stdout.readline().strip()}"
        return {**os.environ, "DISPLAY": self._display, "TRACKED_MCF_ON_VIRTUAL_DISPLAY": "1"}

    def draw(self, suffix, surfaces, labels, *words):
        """Draws surfaces side by side with render.py, which also takes `words`."""
        picture = self.output / f"{self.name}{suffix}.png"
        subprocess.run([sys.executable, str(RENDER), *map(str, surfaces),
                        "--labels", *map(str, labels), "--output", str(picture),
                        *map(str, words)], check=True, env=self.on_display())
        self.say(f"\n![{self.name}{suffix}]({picture.name})")


def distance_script(samples, scale):
    """Enlarges both meshes, because the filter prints six decimals. Samples all vertices and `samples`
    points of each, and looks for the nearest point of the other."""
    enlarge = ('<filter name="Transform: Scale, Normalize">'
               + "".join(f'<Param type="RichFloat" name="axis{axis}" value="{scale}"/>' for axis in "XYZ")
               + '<Param type="RichBool" name="uniformFlag" value="true"/>'
               '<Param type="RichEnum" name="scaleCenter" value="0" enum_cardinality="3" '
               'enum_val0="origin" enum_val1="barycenter" enum_val2="custom point"/>'
               '<Param type="RichPoint3f" name="customCenter" x="0" y="0" z="0"/>'
               '<Param type="RichBool" name="unitFlag" value="false"/>'
               '<Param type="RichBool" name="Freeze" value="true"/>'
               '<Param type="RichBool" name="allLayers" value="true"/></filter>')
    flags = {"SaveSample": "false", "SampleVert": "true", "SampleEdge": "false",
             "SampleFauxEdge": "false", "SampleFace": "true"}
    measure = "".join(
        f'<filter name="Hausdorff Distance">'
        f'<Param type="RichMesh" name="SampledMesh" value="{sampled}"/>'
        f'<Param type="RichMesh" name="TargetMesh" value="{1 - sampled}"/>'
        + "".join(f'<Param type="RichBool" name="{name}" value="{value}"/>'
                  for name, value in flags.items())
        + f'<Param type="RichInt" name="SampleNum" value="{samples}"/>'
        '<Param type="RichAbsPerc" name="MaxDist" value="1e9" min="0" max="1e9"/></filter>'
        for sampled in (1, 0))
    return f"<!DOCTYPE FilterScript><FilterScript>{enlarge}{measure}</FilterScript>"


def read_distance(log):
    """The log repeats the first of the two results. The second one has the reference's diagonal."""
    found = re.findall(r"max (\S+)\s+mean : \S+\s+RMS : (\S+)\nValues w.r.t. BBox Diag \((\S+)\)",
                       log)
    if len(found) < 2:
        sys.exit(f"MeshLab measured no distances:\n{log}")
    diagonal = float(found[-1][2])
    return {"rms": max(float(rms) for _, rms, _ in found) / diagonal,
            "max": max(float(worst) for worst, _, _ in found) / diagonal}


def main_scan(figure):
    """Returns the path of the scan of figures 5 to 7, in place of the paper's Bimba, and a depth with
    about as many unknowns as the scan has vertices."""
    [path] = figure.scans(["nefertiti_50k.ply"], ["mannequin-devil.off"])
    return path, 7 if path.stem == "nefertiti_50k" else 6
