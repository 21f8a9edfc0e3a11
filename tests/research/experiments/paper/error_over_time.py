#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error over processor time: ours, the cotangent flow by four solvers, and the paper's W-cycle.

A sphere of radius 0.5 without noise flows one step and ten steps of two sizes. Drawn is the error of the
vertices' radius against the exact semi-implicit one, RMS, over the processor seconds of set-up and steps
together, with one thread. The paper's method makes a single W-cycle, at several depths. All others flow the mesh
itself, to several tolerances: ours; conjugate gradients with the incomplete Cholesky factors of
tests/research/benchmark or with hypre's algebraic multigrid; Gravo MG's geometric multigrid on the mesh's own levels;
and CGAL's smooth_shape, which keeps the first stiffness and so makes only a single step. The seconds of Gravo
MG include its levels and its solves, but not the assembly, which NumPy does for it (gravo_mg.py); those of the
others include the assembly. Further to the left and further down is better.
"""

import statistics
import subprocess
import sys

from reproduction import HERE, Reproduction

sys.path.insert(0, str(HERE.parents[1] / "benchmark"))

from measurements import Case, Measurements  # noqa: E402

W_CYCLE, OURS = "paper's W-cycle", "ours"
IC, AMG, CGAL = "cotangent, IC(0)-CG", "cotangent, AMG-CG", "cotangent, CGAL"
GRAVO, GRAVO_SCRIPT = "cotangent, Gravo MG", str(HERE / "gravo_mg.py")
PEERS = [IC, AMG, GRAVO, CGAL]
STYLES = {W_CYCLE: "s:", OURS: "o-", IC: "v-", AMG: "D-", GRAVO: "P-", CGAL: "*"}
TOLERANCES = ["1e-2", "1e-4", "1e-6"]
DEFAULT, TIGHT = "1e-3", "1e-6"
OUR_TOLERANCES = ["1e-2", DEFAULT, "1e-4", TIGHT]
STEPS = [1, 10]
STEP_SIZES = [5e-4, 5e-3]
ERRORS = ["rms_radius_error", "worst_radius_error"]


def built_peers(driver):
    """Returns the subcommands of the peers that the driver was built with."""
    text = subprocess.run([driver, "--help"], check=True, stdout=subprocess.PIPE, text=True).stdout
    return [name for name in ("baseline", "multigrid", "cgal") if f"  {name} " in text]


def has_gravo_mg(python):
    return python.exists() and subprocess.run([python, "-c", "import gravomg"], check=False,
                                              stderr=subprocess.DEVNULL).returncode == 0


def cases_of(mesh, depths, step_sizes, peers):
    """Returns the arguments of the driver, or of Python for Gravo MG, by (peer, setting, step size,
    steps)."""
    cases = {}
    for step_size in step_sizes:
        for steps in STEPS:
            words = ("--step-size", step_size, "--steps", steps)
            for depth in depths:
                cases[W_CYCLE, f"depth {depth}", step_size, steps] = (
                    "flow", mesh, *words, "--depth", depth, "--solver", "paper")
            for tolerance in OUR_TOLERANCES:
                cases[OURS, tolerance, step_size, steps] = (
                    "flow", mesh, *words, "--solver", f"converged,tolerance={tolerance}")
            for peer, command in ((IC, "baseline"), (AMG, "multigrid"), (GRAVO, GRAVO_SCRIPT)):
                for tolerance in TOLERANCES if command in peers else []:
                    cases[peer, tolerance, step_size, steps] = (
                        command, mesh, *words, "--tolerance", tolerance)
        if "cgal" in peers:
            cases[CGAL, "", step_size, 1] = ("cgal", mesh, "--step-size", step_size)
    return cases


def measure(driver, python, cases, repetitions):
    """Returns a row for each case: medians over the repetitions. `python` runs Gravo MG."""
    measurements = Measurements(driver)
    measurements.run([Case(str(key), words=words, program=python if key[0] == GRAVO else "",
                           environment=(("OMP_NUM_THREADS", "1"),)) for key, words in cases.items()],
                     repetitions)
    if measurements.failures:
        sys.exit("These runs failed:\n" + "\n".join(measurements.failures))
    rows = {}
    for key in cases:
        def median(quantity):
            return statistics.median(
                sum(measurements.values(quantity, peer=str(key), repetition=i))
                for i in range(repetitions))
        seconds = [median(f"{part}_cpu_seconds") for part in ("setup", "step")]
        rows[key] = {**dict(zip(("peer", "setting", "step_size", "steps"), key)),
                     "setup_cpu_seconds": seconds[0], "steps_cpu_seconds": seconds[1],
                     "seconds": sum(seconds), **{error: median(error) for error in ERRORS}}
    return rows


def of_panel(rows, step_size, steps):
    return [row for row in rows.values() if (row["step_size"], row["steps"]) == (step_size, steps)]


def title(step_size, steps):
    return f"{steps} step{'s' if steps > 1 else ''} of {step_size:g}"


def plot(figure, rows, step_sizes):
    panels, axes = figure.figure(rows=len(step_sizes), columns=len(STEPS))
    for line, step_size in zip(axes, step_sizes):
        for ax, steps in zip(line, STEPS):
            for peer, style in STYLES.items():
                points = [row for row in of_panel(rows, step_size, steps) if row["peer"] == peer]
                ax.loglog([row["seconds"] for row in points], [row[ERRORS[0]] for row in points],
                          style, label=peer if points else None, markersize=5)
                for row in points:
                    ax.annotate(row["setting"].replace("depth ", ""),
                                (row["seconds"], row[ERRORS[0]]), fontsize=6, xytext=(3, 3),
                                textcoords="offset points")
            ax.set_title(title(step_size, steps), fontsize=9)
            ax.set_xlabel("processor seconds, set-up included")
            ax.set_ylabel("error of the radius, RMS")
    axes[0][0].legend(fontsize=7)
    figure.save(panels)


def say_beside(figure, panel, peer, error):
    """Says how fast ours reaches a peer's error."""
    theirs = min((row for row in panel if row["peer"] == peer), key=lambda row: row[error])
    name = f"{title(theirs['step_size'], theirs['steps'])}, {error.replace('_', ' ')}"
    all_ours = [row for row in panel if row["peer"] == OURS]
    ours = min((row for row in all_ours if row[error] <= theirs[error]), key=lambda row: row["seconds"], default=None)
    if not ours:
        least = min(row[error] for row in all_ours)
        figure.say(f"- {name}: ours does not reach the {theirs[error]:.2g} of {peer}; its least is "
                   f"{least:.2g}.")
        return
    ratio = theirs["seconds"] / ours["seconds"]
    figure.say(f"- {name}: {peer} takes {theirs['seconds']:.2g} s to {theirs[error]:.2g}, ours to "
               f"{ours['setting']} {ours['seconds']:.2g} s to {ours[error]:.2g}: ours "
               f"{f'is {ratio:.2g} times as fast' if ratio > 1 else f'takes {1 / ratio:.2g} times as long'}.")


def compare(figure, rows, step_sizes, depth, timed):
    """Checks the claims. `timed` says whether the runs are long enough to compare their times."""
    figure.say("Ours beside each peer at the peer's least error\n")
    for step_size in step_sizes:
        for steps in STEPS:
            panel = of_panel(rows, step_size, steps)
            for peer in dict.fromkeys(row["peer"] for row in panel if row["peer"] in PEERS):
                for error in ERRORS:
                    say_beside(figure, panel, peer, error)
    figure.say()
    for step_size in step_sizes:
        cycle, ours = (rows[peer, setting, step_size, STEPS[-1]]
                       for peer, setting in ((W_CYCLE, f"depth {depth}"), (OURS, DEFAULT)))
        figure.check(f"{title(step_size, STEPS[-1])}: RMS, one W-cycle at depth {depth} over ours",
                     cycle[ERRORS[0]] / ours[ERRORS[0]], at_least=3)
        theirs, reference = ((peer, TOLERANCES[-1], step_size, STEPS[-1]) for peer in (GRAVO, IC))
        if theirs in rows:
            figure.check(f"{title(step_size, STEPS[-1])}: RMS to {TOLERANCES[-1]}, Gravo MG over IC(0)-CG",
                         rows[theirs][ERRORS[0]] / rows[reference][ERRORS[0]], at_most=1.05)
        multigrid = (AMG, TOLERANCES[-1], step_size, STEPS[-1])
        if timed and multigrid in rows:
            figure.check(f"{title(step_size, STEPS[-1])}: seconds, AMG-CG to {TOLERANCES[-1]} over "
                         "ours", rows[multigrid]["seconds"] / ours["seconds"], at_least=1)
        if timed and (CGAL, "", step_size, 1) in rows:
            ours, tight = (rows[OURS, tolerance, step_size, 1] for tolerance in (DEFAULT, TIGHT))
            theirs = rows[CGAL, "", step_size, 1]
            name = title(step_size, 1)
            figure.check(f"{name}: seconds, CGAL over ours to {TIGHT}",
                         theirs["seconds"] / tight["seconds"], at_least=2)
            figure.check(f"{name}: worst error, ours to {TIGHT} over CGAL",
                         tight[ERRORS[1]] / theirs[ERRORS[1]], at_most=1)
            figure.say(f"- {name}: with our default tolerance, CGAL takes "
                       f"{theirs['seconds'] / ours['seconds']:.2g} times as long, and our worst error is "
                       f"{ours[ERRORS[1]] / theirs[ERRORS[1]]:.2g} times CGAL's.")


def main():
    figure = Reproduction("error_over_time", __doc__)
    quick = figure.options.quick
    frequency, depths, depth = (32, [4, 5], 5) if quick else (128, [5, 6, 7], 7)
    step_sizes = STEP_SIZES[:1] if quick else STEP_SIZES
    driver = figure.options.build / "tests" / "research" / "benchmark" / "tracked_mcf_benchmark"
    peers = built_peers(driver)
    if len(peers) < 3:
        figure.say("CGAL and hypre are left out: built without TRACKED_MCF_BENCHMARK.\n")
    python = figure.options.build / "gravomg" / "bin" / "python"
    if has_gravo_mg(python):
        peers.append(GRAVO_SCRIPT)
    else:
        figure.say("Gravo MG is left out. `external/gravomg.sh build/gravomg` installs it.\n")
    rows = measure(driver, python, cases_of(f"sphere:{frequency}", depths, step_sizes, peers),
                   1 if quick else 3)
    figure.record(rows.values())
    figure.say(f"Sphere of {10 * frequency**2 + 2} vertices\n")
    figure.table(["δ", "steps", "peer", "setting", "set-up", "steps", "seconds", "RMS", "worst"],
                 [[row["step_size"], row["steps"], row["peer"], row["setting"],
                   row["setup_cpu_seconds"], row["steps_cpu_seconds"], row["seconds"],
                   *(row[error] for error in ERRORS)] for row in rows.values()])
    compare(figure, rows, step_sizes, depth, not quick)
    plot(figure, rows, step_sizes)
    figure.finish()


if __name__ == "__main__":
    main()
