#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a program, and prints its times and peak memory as the driver does: whole_job.py PROGRAM ARGUMENT...

whole_job.py pymeshlab FILTER INPUT OUTPUT reads a mesh, applies a filter of the PyMeshLab that runs this script,
and writes the mesh, in a process of its own.
"""

import resource
import subprocess
import sys
import time

PYMESHLAB = ("import sys, pymeshlab; meshes = pymeshlab.MeshSet(); meshes.load_new_mesh(sys.argv[2]); "
             "meshes.apply_filter(sys.argv[1]); meshes.save_current_mesh(sys.argv[3])")


def main(words):
    command = [sys.executable, "-c", PYMESHLAB, *words[1:]] if words[0] == "pymeshlab" else words
    begin = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    seconds = time.perf_counter() - begin
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    print("quantity,step,value")
    print(f"whole_job_seconds,0,{seconds:.4g}")
    print(f"whole_job_cpu_seconds,0,{usage.ru_utime + usage.ru_stime:.4g}")
    print(f"peak_memory_bytes,0,{1024 * usage.ru_maxrss}")


if __name__ == "__main__":
    main(sys.argv[1:])
