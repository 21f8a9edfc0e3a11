#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs the wheel beside the official PyMeshLab into a new virtual environment and uses it there:
wheel_works.py BUILD_DIR SINGLE_PRECISION_PLUGIN TOOL README WORK_DIR MESH...

Checks what the wheel holds and says of itself, that its method does what the tool does, its docstring,
and the messages of its import where PyMeshLab or the plugin do not fit. Runs with a Python that has
PyMeshLab. Ends with 77, which tells CTest that the test was skipped, where there is no PyMeshLab.
"""

import base64
import csv
import ctypes
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import venv
import zipfile

try:
    import pymeshlab
except ImportError:
    print(f"skipped: {sys.executable} cannot import pymeshlab; external/pymeshlab.sh installs it")
    sys.exit(77)

HERE = pathlib.Path(__file__).resolve().parent
MODULE = "pymeshlab_tracked_mcf"
PLUGIN = "libfilter_tracked_mcf.so"
OFFICIAL = pathlib.Path(pymeshlab.__file__).parent

# The plugin may need these of the system. PyMeshLab brings all others.
OF_THE_SYSTEM = re.compile(r"(libc|libm|libstdc\+\+|libgcc_s|ld-linux-[-\w]+)\.so\.\d")

# Imports the module, then uses PyMeshLab, which must work even if the import fails. The Python package
# would replace the plugin; arrays_in_pymeshlab.py tests that.
IMPORT = """
import sys, pymeshlab
sys.modules["tracked_mcf"] = None
{before}
try:
    import pymeshlab_tracked_mcf
except ImportError as error:
    print("ImportError:", error)
meshes = pymeshlab.MeshSet()
meshes.create_sphere()
meshes.apply_coord_laplacian_smoothing()
print("PyMeshLab works", "with" if hasattr(meshes, "apply_coord_mean_curvature_flow") else "without",
      "the filter")
"""

DOCSTRING = r"""
import re, pymeshlab, pymeshlab_tracked_mcf
meshes = pymeshlab.MeshSet()
meshes.create_cube()
values = meshes.filter_parameter_values("apply_coord_mean_curvature_flow")
text = meshes.apply_coord_mean_curvature_flow.__doc__
assert re.findall(r"^    (\w+): ", text, re.MULTILINE) == list(values), text
for name, value in values.items():
    default = re.search(rf"^    {name}: (bool|int|float) = (.*)$", text, re.MULTILINE)
    assert not default or default.groups() == (type(value).__name__, repr(value)), text
"""


def output_of(*command, **options):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, **options).stdout


def needed_versions(*files):
    script = HERE.parents[2] / "filter_tracked_mcf" / "package" / "needed_versions.sh"
    return set(output_of(script, *files).split())


def check_files(wheel, build):
    """Checks the wheel's name, its record and its plugin. Returns the folder with its files."""
    folder = wheel.with_suffix("")
    zipfile.ZipFile(wheel).extractall(folder)
    info = next(folder.glob("*.dist-info"))
    record = list(csv.reader((info / "RECORD").read_text(encoding="utf-8").splitlines()))
    files = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert {row[0] for row in record} == files, record
    for name, digest, size in record:
        data = (folder / name).read_bytes()
        expected = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        if not name.endswith("/RECORD"):
            assert [digest, int(size)] == [f"sha256={expected}", len(data)], name
        assert str(build).encode() not in data, f"{name} names the build folder"
    licence = (info / "licenses" / "LICENSE").read_text(encoding="utf-8")
    assert "GNU GENERAL PUBLIC LICENSE" in licence
    assert (info / "licenses" / "THIRD_PARTY.txt").exists()

    # needed_versions.sh reads the files' lists of versions; this test reads their symbols.
    plugin = folder / MODULE / PLUGIN
    symbols = re.findall(r"\*UND\*.*\bGLIBC_2\.(\d+)", output_of("objdump", "-T", plugin))
    tag = f"py3-none-manylinux_2_{max(map(int, symbols))}_{os.uname().machine}"
    assert wheel.name.endswith(f"-{tag}.whl"), f"{wheel.name} rather than {tag}"
    assert f"\nTag: {tag}\n" in (info / "WHEEL").read_text(encoding="utf-8")
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", output_of("readelf", "-d", plugin)))
    brought = {path.name for path in (OFFICIAL / "lib").iterdir()}
    missing = [name for name in needed - brought if not OF_THE_SYSTEM.fullmatch(name)]
    assert not missing, f"PyMeshLab does not bring {missing}"
    return folder


def print_needs(plugin):
    """Prints the versions of libraries that PyMeshLab and the plugin need."""
    core = ctypes.CDLL(str(OFFICIAL / "lib" / "libQt5Core.so.5"))
    core.qVersion.restype = ctypes.c_char_p
    official = needed_versions(*OFFICIAL.glob("*.so"), *(OFFICIAL / "lib").glob("*.so*"))
    ours = needed_versions(plugin)
    print(f"PyMeshLab {pymeshlab.pmeshlab.__version__} brings Qt {core.qVersion().decode()}.")
    for name, needs in (("All its libraries need", official), ("The plugin needs", ours)):
        print(name, *(need for need in sorted(needs) if re.match(r"(GLIBC|GLIBCXX|CXXABI|Qt)_\d", need)))


def install(wheel, folder):
    """Installs the wheel into a new environment, which sees this Python's PyMeshLab. Returns the
    environment's Python."""
    shutil.rmtree(folder, ignore_errors=True)
    venv.create(folder, with_pip=True)
    site = next(folder.glob("lib/python*/site-packages"))
    packages = [path for path in sys.path if path.endswith("-packages")]
    (site / "official.pth").write_text("\n".join(packages), encoding="utf-8")
    python = folder / "bin" / "python"
    subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", wheel], check=True)
    return python


def check_import(python, expected, before="", path=""):
    environment = {**os.environ, "PYTHONPATH": str(path)}
    text = output_of(python, "-c", IMPORT.format(before=before), env=environment).strip()
    print(text)
    for words in expected:
        assert words in text, f"'{words}' is not in: {text}"


def check_messages(python, installed, single_precision_plugin, work):
    works = "PyMeshLab works without the filter"
    check_import(python, ["PyMeshLab works with the filter"])
    for release in ("2023.12.post3", "2025.70"):
        message = f"This is PyMeshLab {release}, but the plugin is for PyMeshLab 2025.7."
        check_import(python, [message, "pip install", "the package tracked-mcf", works],
                     before=f"pymeshlab.pmeshlab.__version__ = '{release}'")
    for name, plugin, message in (
            ("single", single_precision_plugin, "different floating point precision"),
            ("absent", None, f"{PLUGIN} does not exist")):
        copy = work / name / MODULE
        shutil.copytree(installed, copy)
        (copy / PLUGIN).unlink()
        if plugin:
            shutil.copy(plugin, copy / PLUGIN)
        check_import(python, [message, "double precision", "pip install", "the package tracked-mcf", works],
                     path=copy.parent)
    script = f"import sys; sys.modules['pymeshlab'] = None; import {MODULE}"
    without = subprocess.run([python, "-c", script], capture_output=True, text=True, check=False)
    assert "ImportError: PyMeshLab cannot be imported" in without.stderr, without.stderr


def main(build, single_precision_plugin, tool, readme, work, *meshes):
    build, work = pathlib.Path(build), pathlib.Path(work)
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    subprocess.run(["cmake", "--build", build, "--target", "wheel"], check=True)
    [wheel] = build.glob("pymeshlab_tracked_mcf-*.whl")
    files = check_files(pathlib.Path(shutil.copy(wheel, work)), build)
    print_needs(files / MODULE / PLUGIN)
    python = install(wheel, work / "environment")
    check_messages(python, files / MODULE, single_precision_plugin, work)
    subprocess.run([python, "-c", DOCSTRING], check=True)
    subprocess.run([python, HERE / "works_in_pymeshlab.py", MODULE, tool, readme, work, *meshes],
                   check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
