# SPDX-License-Identifier: GPL-3.0-or-later
"""Common code of the experiments: meshes, running the driver, tables, plots and targets.

A script creates an Experiment, runs the driver or the program, prints tables, saves plots and checks
targets. finish() writes NAME.csv (all measurements) and NAME.md (the printed text) to the output folder,
beside the plot NAME.png, and exits with 1 if a target was missed. All seconds are processor time, which
a busy machine hardly changes.
"""

import argparse
import csv
import datetime
import io
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from ply import read_mesh, unpacked, write_ply

TOP = pathlib.Path(__file__).resolve().parents[3]
RENDER = TOP / "tests" / "demo" / "render.py"
CGAL_MESHES = TOP / "build" / "cgal-meshes"
sys.path.insert(0, str(TOP / "tests" / "research" / "benchmark"))

from machine import processor  # noqa: E402

SKIPPED = 77
CLAIM = ("- **holds**: ", "- **does not hold**: ")

# How the line begins that names the command of a page.
MADE_BY = "Made by"

PAPER = "paper"
CONVERGED = "converged"


class Experiment:
    """One script's run. `add_options(parser)` adds the script's own options to `options`."""

    def __init__(self, name, description, add_options=lambda parser: None):
        parser = argparse.ArgumentParser(
            description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("--build", type=pathlib.Path, default=TOP / "build" / "research", metavar="FOLDER",
                            help="where tests/research was built")
        parser.add_argument("--program", type=pathlib.Path, metavar="FILE",
                            help="another tracked_mcf than that of the build folder")
        parser.add_argument("--meshes", type=pathlib.Path, metavar="FOLDER",
                            help="folder of scans (default: build/cgal-meshes)")
        parser.add_argument("--scans", nargs="+", metavar="NAME",
                            help="file names in that folder, instead of the usual ones")
        parser.add_argument("--output", type=pathlib.Path, metavar="FOLDER",
                            help="for tables and plots (default: results in the build folder)")
        parser.add_argument("--quick", action="store_true", help="fewer and smaller cases")
        add_options(parser)
        self.name = name
        self.options = parser.parse_args()
        self.program = self.options.program or self.options.build / "tracked_mcf"
        self._pyplot = pyplot()  # before the measurements, in case it is missing
        self.output = self.options.output or self.options.build / "results"
        self.output.mkdir(parents=True, exist_ok=True)
        self._rows = []
        self._text = io.StringIO()
        self._missed = 0
        self.say(f"# {description.strip().splitlines()[0]}\n\n{self._command()} {origin()}\n")

    def _command(self):
        """Returns a sentence with the command that makes the page. It names no folder of this machine."""
        script = pathlib.Path(sys.argv[0]).resolve().relative_to(TOP)
        words = []
        for name in ("meshes", "pairs", "findings", "parts"):
            given = getattr(self.options, name, None)
            if given:
                words.append(" ".join([f"--{name}", *["FOLDER"] * (len(given) if isinstance(given, list) else 1)]))
        words += [f'--also="{options}"' for options in getattr(self.options, "also", [])]
        words += [f"--{name} {getattr(self.options, name)}" for name in ("seed", "seeds")
                  if getattr(self.options, name, 1) > 1]
        if self.options.quick:
            words.append("--quick")
        python = ["build/pymeshlab/bin/python"] if "pymeshlab" in sys.modules else []
        return f"{MADE_BY} `{' '.join([*python, str(script), *words])}`."

    def meshes(self, shared, cgal):
        """Returns the paths of the meshes named `shared` if the folder has them, else of `cgal`."""
        folder = self.options.meshes or CGAL_MESHES
        names = next((names for names in (shared, cgal)
                      if all((folder / name).exists() for name in names)), None)
        if names is None:
            skip(f"{self.name}: {folder} has not all of {', '.join(cgal)}; "
                 "external/cgal_meshes.sh fetches them")
        return [folder / name for name in names]

    def scans(self, shared, cgal):
        """Returns the paths of the scans to measure, unpacked: those of --scans if given; only the
        smallest with --quick."""
        named = self.options.scans
        paths = [self.unpacked(path) for path in self.meshes(named or shared, named or cgal)]
        return [min(paths, key=lambda path: path.stat().st_size)] if self.options.quick else paths

    def unpacked(self, path):
        """Returns the path of a file, or of its unpacked copy if it is packed by xz."""
        if path.suffix != ".xz":
            return path
        return unpacked(path, self.options.build / "unpacked")

    def smoothed(self, vertices, faces, *words, command="smooth", selected=None):
        """Runs a command of the program tracked_mcf on a mesh with options, which are `words`. `selected` has a number
        for each face. Returns the moved vertices, the report as a dictionary, and the processor seconds, files
        included."""
        with tempfile.TemporaryDirectory() as folder:
            source, target, report = (pathlib.Path(folder) / name for name in ("in.ply", "out.ply", "report.json"))
            write_ply(source, vertices, faces, selected)
            begin = processor_seconds()
            subprocess.run([self.program, command, source, target, "--quiet", "--report", report, *map(str, words)],
                           check=True)
            seconds = processor_seconds() - begin
            return read_mesh(target)[0], json.loads(report.read_text(encoding="utf-8")), seconds

    def run(self, command, *words, **more):
        """Runs the driver. Returns its rows as dictionaries, each with the entries of `more`."""
        driver = self.options.build / "tracked_mcf_experiments"
        if not driver.exists():
            sys.exit(f"{self.name}: {driver} has not been built")
        call = [str(driver), command] + [str(word) for word in words]
        print(f"... {' '.join(call[1:])}", file=sys.stderr, flush=True)
        output = subprocess.run(call, check=True, stdout=subprocess.PIPE, text=True).stdout
        rows = [{**more, **{key: number_or_text(value) for key, value in row.items()}}
                for row in csv.DictReader(io.StringIO(output))]
        self._rows += rows
        return rows

    def record(self, rows):
        """Adds rows, which are dictionaries, to the measurements."""
        self._rows += rows

    def say(self, line=""):
        print(line, flush=True)
        print(line, file=self._text)

    def table(self, headers, rows):
        """Prints a Markdown table, numbers with three digits."""
        cells = [[str(header) for header in headers]]
        cells += [[three_digits(value) for value in row] for row in rows]
        widths = [max(len(row[i]) for row in cells) for i in range(len(headers))]
        cells.insert(1, ["-" * width for width in widths])
        for row in cells:
            self.say("| " + " | ".join(f"{cell:<{width}}"
                                       for cell, width in zip(row, widths)) + " |")
        self.say()

    def check(self, what, measured, at_most=None, at_least=None):
        """Prints a measured value beside its target. Returns whether it meets it."""
        if at_most is not None:
            passed, target = measured <= at_most, f"at most {three_digits(at_most)}"
        else:
            passed, target = measured >= at_least, f"at least {three_digits(at_least)}"
        self._missed += not passed
        self.say(f"- {'ok' if passed else '**missed**'}: {what}: {three_digits(measured)}, "
                 f"must be {target}")
        return passed

    def figure(self, rows=1, columns=1, size=(5, 4)):
        """Returns a matplotlib figure and its axes, rows by columns of them."""
        figure, axes = self._pyplot.subplots(rows, columns, squeeze=False, constrained_layout=True,
                                         figsize=(size[0] * columns, size[1] * rows))
        return figure, axes

    def save(self, figure, suffix=""):
        path = self.output / f"{self.name}{suffix}.png"
        figure.savefig(path, dpi=120)
        self.say(f"\n![plot]({path.name})")

    def finish(self):
        """Writes the files, and README.md, which lists all pages of the folder. Exits with 1 if a target
        was missed."""
        (self.output / f"{self.name}.md").write_text(self._text.getvalue())
        with open(self.output / f"{self.name}.csv", "w", newline="", encoding="utf-8") as file:
            keys = list(dict.fromkeys(key for row in self._rows for key in row))
            writer = csv.DictWriter(file, keys)
            writer.writeheader()
            writer.writerows(self._rows)
        if not self.options.quick:  # quick runs are tests, which run side by side
            write_list_of_pages(self.output)
        print(f"... in {self.output}: {self.name}.md, .csv, .png", file=sys.stderr)
        sys.exit(1 if self._missed else 0)


def skip(reason):
    """Ends the script with the exit code that CTest counts as a skipped test."""
    print(reason, file=sys.stderr)
    sys.exit(SKIPPED)


def processor_seconds():
    """Returns the processor time of this process and of the programs that it has run."""
    programs = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + programs.ru_utime + programs.ru_stime


def origin():
    """Returns a sentence that says which sources are measured, when and on which machine. Their commit is
    the last one that changed the product."""
    commit = "unknown"
    if shutil.which("git"):
        log = ["git", "log", "-1", "--format=%h", "--abbrev=12", "--", "filter_tracked_mcf"]
        commit = subprocess.run(log, cwd=TOP, check=False, stdout=subprocess.PIPE,
                                text=True).stdout.strip() or commit
    return f"Commit {commit}, {datetime.date.today()}, {os.cpu_count()} cores, {processor()}."


def link(folder, name, lines):
    """Returns a line with links to a page and its pictures, and the command that makes it."""
    pictures = [f"[{path.name}]({path.name})" for path in sorted(folder.glob(f"{name[:-3]}*.png"))]
    command = [f"`{line.split('`')[1]}`" for line in lines if line.startswith(MADE_BY)]
    return ", ".join([f"- [{lines[0][2:].rstrip('.')}]({name})", *command, *pictures])


def write_list_of_pages(folder):
    """Writes the folder's README.md: what the pages say of the paper's claims, and links to them."""
    pages = {path.name: path.read_text(encoding="utf-8").splitlines()
             for path in sorted(folder.glob("*.md")) if path.name != "README.md"}
    claims = [line for lines in pages.values() for line in lines if line.startswith(CLAIM)]
    links = [link(folder, name, lines) for name, lines in pages.items()]
    (folder / "README.md").write_text("\n".join(
        ["# Results of the experiments", "",
         "`tests/research/experiments/reproduce_paper.sh` builds and runs all scripts of `paper`; [how to run one](../README.md).",
         "FOLDER has [these meshes](meshes.md); without `--meshes`, those of Debian's libcgal-demo are taken. The commands run in the",
         "project's folder.", "", *links, "", "The paper's claims:", "", *claims, ""]),
        encoding="utf-8")


def pyplot():
    try:
        import matplotlib
    except ImportError:
        skip("matplotlib is missing. On Debian, run external/install_debian.sh research and start "
             "this script with /usr/bin/python3.")
    matplotlib.use("Agg")  # no display
    from matplotlib import pyplot as module
    return module


def number_or_text(value):
    for kind in (int, float):
        try:
            return kind(value)
        except (TypeError, ValueError):
            pass
    return value


def three_digits(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value)


def label(mesh):
    """Returns a mesh's name for tables: a file name without folder and extension."""
    return mesh.stem if isinstance(mesh, pathlib.Path) else "sphere"
