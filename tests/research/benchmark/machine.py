# SPDX-License-Identifier: GPL-3.0-or-later
"""Describes the machine for the results page, without its name."""

import os
import pathlib
import subprocess


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown"


def instructions():
    """Returns the widest instructions that the programs use."""
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    return next((name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2"))
                 if f" {flag} " in text), "baseline")


def caches():
    """Returns the caches, for example 'L1 48K, L2 1024K, L3 32768K'."""
    found = []
    for folder in sorted(pathlib.Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        kind, level, size = ((folder / name).read_text(encoding="utf-8").strip()
                             for name in ("type", "level", "size"))
        if kind != "Instruction":
            found.append(f"L{level} {size}")
    return ", ".join(found) or "unknown"


def compiler(build):
    """Returns the first line of the compiler's --version, and the build type."""
    entries = dict(line.split("=", 1) for line in
                   (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines()
                   if "=" in line and not line.startswith(("#", "/")))
    program = entries.get("CMAKE_CXX_COMPILER:FILEPATH") or entries["CMAKE_CXX_COMPILER:STRING"]
    version = subprocess.run([program, "--version"], stdout=subprocess.PIPE, text=True, check=True)
    flags = entries.get("CMAKE_CXX_FLAGS:STRING", "").strip()
    kind = entries.get("CMAKE_BUILD_TYPE:STRING", "")
    return ", ".join(part for part in (version.stdout.splitlines()[0], kind, flags) if part)


def table(build):
    """Returns rows of property and value."""
    return [["processor", processor()], ["cores", str(os.cpu_count())],
            ["widest instructions", instructions()], ["caches", caches()],
            ["compiler", compiler(build)]]
