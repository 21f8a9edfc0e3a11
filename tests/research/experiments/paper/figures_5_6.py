#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 5 and 6: the tracked flow beside a rebuilt octree and the cotangent flow.

A scan flows 400 steps of 1e-5, four times as many as in the paper, to see whether the initial functions
stay rich enough (Figure 5). The distance to the cotangent flow, by MeshLab's filter
"Hausdorff Distance", is drawn over the steps: RMS solid, maximum dashed (Figure 6, left). The unit sphere
flows a hundred steps of 1e-3, and the errors are those of its radius against the exact semi-implicit one
(Figure 6, right). The paper's claim, of section 5.2: tracked elements are closer than rebuilt ones, and
splitting the triangles before rebuilding helps. It is checked for RMS and maximum, after every measured step,
with one W-cycle a step, as in the paper, and with 10. After ten steps of the scan, 50 cycles instead of 10
change the distance of the tracked flow by 1.5 %.

On the sphere, the claim does not hold with a single W-cycle; with 10, only the maximum of the tracked flow misses it.
A table shows why: with more cycles, the error of
the rebuilt flow rises, since the solver goes all the way to what is wrong with a flattened surface. That of the
tracked flow does not.
"""

from reproduction import METHODS, PAPER, Reproduction, main_scan

STEP_SIZE, SPHERE_STEP_SIZE = 1e-5, 1e-3
CYCLES = [1, 2, 3, 5, 10, 20]
STEPS = [1, 2, 5, 10, 20, 50, 100, 200, 400]
OCTREES = METHODS[:3]
ERRORS = {"rms": "RMS", "max": "maximum"}
COLOURS = dict(zip(METHODS, ["tab:orange", "black", "tab:blue", "tab:red"]))
MANY = f"{PAPER},cycles=10"
SOLVERS = {PAPER: "one W-cycle", MANY: "10 W-cycles"}


def measure_scan(figure, scan, depth, steps):
    """Returns rows by solver and method, each with the distances, and the cotangent flow's rows."""
    reference = figure.flow(scan, STEP_SIZE, steps, "cotangent")
    rows = {}
    for solver in SOLVERS:
        for method in OCTREES:
            rows[solver, method] = figure.flow(scan, STEP_SIZE, steps, method, solver, depth)
            for row, exact in zip(rows[solver, method], reference):
                row.update(figure.distance(row["surface"], exact["surface"]))
    figure.record([{"mesh": row["mesh"], "figure": "6 left", "configuration": solver,
                    "method": method, "steps": row["steps"], "rms": row["rms"], "max": row["max"]}
                   for (solver, method), of_method in rows.items() for row in of_method])
    return rows, reference


def measure_sphere(figure, frequency, depth, steps):
    words = ["--frequency", frequency, "--steps", *steps, "--step-size", SPHERE_STEP_SIZE]
    rows = {}
    for method in METHODS:
        for solver in SOLVERS if method in OCTREES else [MANY]:
            measured = figure.run("sphere", *words, "--depth", depth, "--configurations", solver,
                                  "--method", method, mesh="sphere", figure="6 right")
            rows[solver, method] = [{**row, "max": row["worst_vertex"]} for row in measured]
    return rows


def measure_cycles(figure, frequency, depth):
    """Returns the RMS error of the sphere's radius after ten steps by method and number of cycles."""
    cycles = [CYCLES[0], CYCLES[-1]] if figure.options.quick else CYCLES
    errors = {}
    for method in OCTREES[:2]:
        rows = figure.run("sphere", "--frequency", frequency, "--steps", 10, "--step-size",
                          SPHERE_STEP_SIZE, "--depth", depth, "--configurations",
                          *(f"{PAPER},cycles={n}" for n in cycles), "--method", method,
                          mesh="sphere", figure="cycles")
        errors[method] = dict(zip(cycles, (row["rms"] for row in rows)))
    return errors


def plot(figure, scan_rows, sphere_rows):
    panels, axes = figure.figure(rows=2, columns=2)
    for row, solver in enumerate(SOLVERS):
        for ax, rows, title in zip(axes[row], (scan_rows, sphere_rows),
                                   ("distance to the cotangent flow, diagonals",
                                    "error of the sphere's radius")):
            for (of_solver, method), of_method in rows.items():
                if of_solver != solver and method in OCTREES:
                    continue
                for error, style in (("rms", "-"), ("max", "--")):
                    ax.loglog([r["steps"] for r in of_method], [r[error] for r in of_method], style,
                              color=COLOURS[method], label=method if error == "rms" else None)
            ax.set_title(f"{title} ({SOLVERS[solver]})", fontsize=9)
            ax.set_xlabel("steps")
            ax.legend(fontsize=7)
    figure.save(panels, "_errors")


def draw(figure, scan_rows, reference):
    for steps in (1, 10, 100, 400):
        drawn = [row for rows in (reference, *(scan_rows[PAPER, method] for method in OCTREES))
                 for row in rows if row["steps"] == steps]
        if drawn:
            figure.draw(f"_{steps}_steps", [row["surface"] for row in drawn],
                        [f"{row['method']}, {steps}" for row in drawn], "--height", 420)


def table(figure, title, rows):
    figure.say(f"\n{title}\n")
    last = {case: of_case[-1] for case, of_case in rows.items()}
    figure.table(["solver", "method", "steps", "RMS", "maximum"], [
        [SOLVERS[solver], method, row["steps"], row["rms"], row["max"]]
        for (solver, method), row in last.items()])


def ratios(rows, solver, method, error):
    """Returns, by number of steps, a method's error over that of rebuilding."""
    return {row["steps"]: row[error] / rebuilt[error]
            for row, rebuilt in zip(rows[solver, method], rows[solver, "rebuilt"])}


def claim(figure, scan, scan_rows, sphere_rows):
    """Compares errors after every measured step. The first step is the same for tracked and rebuilt elements."""
    tables = {(what, solver, method, error): ratios(rows, solver, method, error)
              for what, rows in ((scan, scan_rows), ("sphere", sphere_rows)) for solver in SOLVERS
              for method in ("tracked", "rebuilt-split") for error in ERRORS}
    figure.say("Errors over those of rebuilt elements\n")
    steps = [row["steps"] for row in scan_rows[PAPER, "tracked"]]
    figure.table(["mesh", "solver", "method", "error", *(f"{n} steps" for n in steps)],
                 [[what, SOLVERS[solver], method, ERRORS[error], *(of.get(n, "") for n in steps)]
                  for (what, solver, method, error), of in tables.items()])
    for (what, solver, method, error), of in tables.items():
        later = {n: ratio for n, ratio in of.items() if n > 1}
        worst = max(later, key=later.get)
        name = "tracked elements" if method == "tracked" else "rebuilt elements of split triangles"
        figure.claim(f"{what}, {SOLVERS[solver]}: {name} are closer than rebuilt ones after every step but the first, "
                     f"{ERRORS[error]}: at most {later[worst]:.3g} times as far, after {worst}", later[worst] < 1)
    for error, name in ERRORS.items():
        tracked, split = (scan_rows[MANY, method][-1][error] for method in ("tracked", "rebuilt-split"))
        figure.claim(f"{scan}, {SOLVERS[MANY]}: tracked elements are closer than rebuilt ones of split triangles after "
                     f"{steps[-1]} steps, {name}: {tracked:.3g} beside {split:.3g}", tracked < split)


def check_cycles(figure, errors):
    tracked, rebuilt = (errors[method] for method in OCTREES[:2])
    figure.say("\nThe unit sphere: error of the radius after ten steps, over the W-cycles of a step\n")
    figure.table(["method", *tracked], [[method, *of.values()] for method, of in errors.items()])
    most = CYCLES[-1]
    figure.check(f"sphere, {most} W-cycles: RMS, tracked over rebuilt", tracked[most] / rebuilt[most],
                 at_most=1)
    figure.check(f"sphere, rebuilt: RMS with {most} W-cycles over that with one",
                 rebuilt[most] / rebuilt[1], at_least=1)
    figure.check(f"sphere, tracked: RMS with {most} W-cycles over that with one",
                 tracked[most] / tracked[1], at_most=1)


def main():
    figure = Reproduction("figures_5_6", __doc__)
    quick = figure.options.quick
    steps = [10] if quick else STEPS
    scan, depth = main_scan(figure)
    scan_rows, reference = measure_scan(figure, scan, depth, steps)
    sphere_rows = measure_sphere(figure, *((48, 6) if quick else (96, 7)),
                                 [step for step in steps if step <= 100])
    table(figure, f"{scan.stem} at depth {depth}: distance to the cotangent flow, in diagonals",
          scan_rows)
    table(figure, "The unit sphere: error of the radius", sphere_rows)
    claim(figure, scan.stem, scan_rows, sphere_rows)
    check_cycles(figure, measure_cycles(figure, 48, 6))
    plot(figure, scan_rows, sphere_rows)
    if not quick:
        draw(figure, scan_rows, reference)
    figure.finish()


if __name__ == "__main__":
    main()
