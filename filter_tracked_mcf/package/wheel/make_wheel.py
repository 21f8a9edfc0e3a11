#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs a Python module with the plugin as a wheel, and prints the wheel's path:
make_wheel.py MODULE_FOLDER VERSION PYMESHLAB_RELEASE PROCESSOR DESTINATION LICENCE...

pip installs the wheel only where the C library is at least as new as the plugin needs, and installs the
PyMeshLab of that release from PyPI too. The same files make the same wheel, byte by byte.
"""

import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import zipfile

NAME = "pymeshlab_tracked_mcf"


def platform(plugin, processor):
    """Returns the name of the oldest Linux on which the plugin runs, such as manylinux_2_35_x86_64."""
    script = pathlib.Path(__file__).parent.parent / "needed_versions.sh"
    needs = subprocess.run([script, plugin], check=True, capture_output=True, text=True).stdout
    major, minor = re.search(r"^GLIBC_(\d+)\.(\d+)", needs, re.MULTILINE).groups()
    return f"manylinux_{major}_{minor}_{processor}"


def record_line(path, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{path},sha256={digest},{len(data)}\n"


def main(module, version, release, processor, destination, *licences):
    module, destination = pathlib.Path(module), pathlib.Path(destination)
    info = f"{NAME}-{version}.dist-info"
    tag = f"py3-none-{platform(module / 'libfilter_tracked_mcf.so', processor)}"
    files = {f"{module.name}/{name}": (module / name).read_bytes()
             for name in ("__init__.py", "filter.txt", "libfilter_tracked_mcf.so")}
    licences = [pathlib.Path(licence) for licence in licences]
    files.update((f"{info}/licenses/{licence.name}", licence.read_bytes()) for licence in licences)
    files[f"{info}/METADATA"] = (
        f"Metadata-Version: 2.4\nName: {NAME.replace('_', '-')}\nVersion: {version}\n"
        f"Summary: Mean-curvature flow of triangle meshes in PyMeshLab {release}\n"
        "License-Expression: GPL-3.0-or-later\n" +
        "".join(f"License-File: {licence.name}\n" for licence in licences) +
        f"Requires-Dist: pymeshlab=={release}.*\n").encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\nTag: {tag}\n").encode()
    record = "".join(record_line(path, data) for path, data in files.items())
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()

    for old in destination.glob(f"{NAME}-*.whl"):
        old.unlink()
    wheel = destination / f"{NAME}-{version}-{tag}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path)  # of 1980: the time of the build is not kept
            entry.external_attr = 0o100644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    print(wheel)


if __name__ == "__main__":
    main(*sys.argv[1:])
