#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks which part of the project includes which: check_includes.py [TOP]

TOP is the top of a checkout, by default the current folder. Prints each include that breaks a rule, and exits
with 1 if there is one.
"""

import pathlib
import re
import sys

SOURCES = "filter_tracked_mcf"
CORE = f"{SOURCES}/core"

# The rooms of the core: a file includes only its own room and those before it. "." is the folder core itself,
# whose headers the hosts include. solver/paper ranks as solver. The three jobs (fair, noise, flow) do not know each
# other; only the entry points, core/*.cpp, rank above them.
ROOMS = [".", "parameters", "platform", "parallel", "mesh", "fair", "noise", "flow/cells", "flow/plan", "flow/octree",
         "flow/elements", "flow/system", "flow/solver", "flow/stepping", "entry point"]
JOBS = ["fair", "noise", "flow"]

# What the core may include of others: the standard library, Eigen, intrinsics, POSIX, Windows.
KNOWN_TO_CORE = re.compile(r"^([a-z_]+|Eigen/[A-Z]\w+|(intrin|sched|unistd|windows|psapi)\.h|sys/\w+\.h)$")

# The plugin includes the one of its MeshLab release, by the include path that CMake chooses.
MESHLAB_API = "meshlab_api.h"

# Outside the core, each folder includes itself and these.
PARTS = {"hosts/meshlab": ["hosts/bridge", "presentation"], "hosts/python": ["presentation"],
         "hosts/cli": ["presentation"]}


def room_of(path):
    inside = pathlib.PurePosixPath(path).relative_to(CORE)
    room = str(inside.parent).removesuffix("/paper")
    return "entry point" if room == "." and inside.suffix == ".cpp" else room


def part_of(path):
    """The folder below filter_tracked_mcf; in hosts/ also the host's own."""
    folders = path.split("/")
    return "/".join(folders[1:3]) if folders[1] == "hosts" else folders[1]


def rule_broken_in_core(includer, included):
    here, there = room_of(includer), room_of(included)
    if here not in ROOMS or there not in ROOMS:
        return "this room has no rank in check_includes"
    paper = f"{CORE}/flow/solver/paper/"
    if (included.startswith(paper) and not includer.startswith(paper)
            and includer != f"{CORE}/flow/stepping/paper_flow.h"):
        return "only flow/stepping/paper_flow.h includes solver/paper"
    jobs = [room.split("/")[0] for room in (here, there)]
    if jobs[0] != jobs[1] and set(jobs) <= set(JOBS):
        return f"{jobs[0]} does not include {jobs[1]}"
    return f"{here} ranks below {there}" if ROOMS.index(there) > ROOMS.index(here) else None


def broken_rule(includer, included, is_quoted):
    """Returns the rule that an include breaks, or None. `includer` is a path from the top."""
    in_core, to_core = (path.startswith(CORE + "/") for path in (includer, included))
    if not included.startswith(SOURCES + "/"):
        if is_quoted and included != MESHLAB_API:
            return "paths of our files begin at the top of the checkout"
        known = not in_core or KNOWN_TO_CORE.match(included)
        return None if known else "the core knows the standard library and Eigen alone"
    if in_core:
        return (rule_broken_in_core(includer, included) if to_core
                else "the core includes nothing of the project but the core")
    if to_core:
        return None if room_of(included) == "." else "only the core includes the core's rooms"
    here, there = part_of(includer), part_of(included)
    return None if there in (here, *PARTS.get(here, [])) else f"{here} does not include {there}"


def main():
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    if not (top / CORE).is_dir():
        print(f"check_includes: no {CORE} in {top}", file=sys.stderr)
        return 2
    broken = False
    for path in sorted((top / SOURCES).rglob("*")):
        if path.suffix not in (".h", ".cpp", ".inc"):
            continue
        includer = path.relative_to(top).as_posix()
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            include = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if include and (rule := broken_rule(includer, include[2], include[1] == '"')):
                broken = True
                print(f"{includer}:{number}: includes {include[2]}: {rule}", file=sys.stderr)
    return broken


if __name__ == "__main__":
    sys.exit(main())
