#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does on a Dask cluster what tracked_mcf_folder.sh does on one machine:
tracked_mcf_folder.py SCHEDULER INPUT OUTPUT [smooth|remove-noise|fair] [OPTION]...

SCHEDULER is the address of Dask's scheduler. The workers need the program tracked_mcf in the PATH, and both folders under the
paths that they have here. Each thread of a worker runs one program, which may have an equal share of the worker's memory.
"""
import pathlib
import subprocess
import sys
import distributed


def smooth(mesh, target, *options):
    """Returns the program's messages. Raises RuntimeError with them if it fails."""
    worker = distributed.get_worker()
    memory = (worker.memory_manager.memory_limit or 0) // worker.state.nthreads or "unlimited"
    command, options = (options[:1], options[1:]) if {"smooth", "remove-noise", "fair"} & {*options[:1]} else ((), options)
    target.parent.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["prlimit", f"--data={memory}", "tracked_mcf", *command, mesh, target, "--quiet", "--threads", "1",
                           "--report", f"{target}.json", *options], stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{done.stderr.rstrip()} (failed, exit code {done.returncode})")
    return done.stderr.rstrip()


def main(scheduler, source, target, *options):
    source, target = pathlib.Path(source).resolve(), pathlib.Path(target).resolve()
    if not source.is_dir():
        return f"tracked_mcf_folder.py: {source} is no folder."
    if source == target:
        return "tracked_mcf_folder.py: INPUT and OUTPUT are the same folder."
    target.mkdir(parents=True, exist_ok=True)
    with distributed.Client(scheduler) as client:
        names = [mesh.relative_to(source) for mesh in source.rglob("*") if target not in mesh.parents
                 and mesh.suffix.lower() in (".ply", ".obj", ".off", ".stl")]
        if not names:
            return f"tracked_mcf_folder.py: there is no mesh in {source}: no .ply, .obj, .off or .stl."
        jobs = {client.submit(smooth, source / name, target / name, *options, pure=False): name for name in names
                if not (target / name).exists()}
        for job in distributed.as_completed(jobs):
            if message := job.exception() or job.result():
                print(f"{jobs[job]}: {message}", file=sys.stderr)
        failed = sum(job.status == "error" for job in jobs)
        print(f"{len(jobs) - failed} done, {len(names) - len(jobs)} there already, {failed} failed")
        return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) > 3 else __doc__)
