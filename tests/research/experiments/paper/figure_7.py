#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 7: what the paper's W-cycles leave, over the octree's depth and their number.

Left: the residual of a scan's step of 1e-5, relative to that before the solve. Right: the error of the
sphere's radius, RMS, after a step of 1e-3. Both for the first step and after 50 steps. The paper's
claims, of section 5.2: the residual falls with every cycle and does not rise with the depth; the error of
a sphere on a coarse octree does not fall, since the functions limit it, not the solver. After 50 steps, each number of
cycles and each depth has a surface of its own, so that residuals of different systems are compared.

The last claim does not hold here. A step of the sphere only scales it, and the functions contain the
coordinates, so the exact result of the first step is nearly one of them at every depth. The column "exact" is of
400 cycles in the first step, where 800 change the error by 1 %, and of 100 cycles in each of 50 steps. The exact
error is about the same at every depth after 50 steps. That of the W-cycles is greater, and falls with every cycle.
"""

from reproduction import PAPER, Reproduction, main_scan

CYCLES = [1, 2, 3, 4, 5]
DEPTHS, SPHERE_DEPTHS = [5, 6, 7, 8], [4, 5, 6, 7]
EARLY, LATE = 1, 50
EXACT = {EARLY: 400, LATE: 100}  # cycles by step


def configurations(cycles):
    return [f"{PAPER},free,cycles={n}" for n in cycles]


def measure(figure, depths, sphere_depths, steps):
    scan, _ = main_scan(figure)
    cycles = CYCLES[:3] if figure.options.quick else CYCLES
    rows = figure.run("stages", scan, "--depths", *depths, "--step-size", 1e-5, "--steps", *steps,
                      "--configurations", *configurations(cycles), mesh=scan.stem)
    sphere = [row for step in steps for row in figure.run(
        "sphere", "--frequency", 128, "--depths", *sphere_depths, "--step-size", 1e-3, "--steps", step,
        "--configurations", *configurations([*cycles, EXACT[step]]), mesh="sphere")]
    return {"residual": rows, "rms": sphere}, cycles


def lines(rows, step, quantity, cycles):
    """Returns, by depth, the quantity for each number of cycles."""
    of = {(row["depth"], row["configuration"]): row[quantity] for row in rows
          if row["steps"] == step}
    return {depth: [of[depth, name] for name in configurations(cycles)]
            for depth in sorted({depth for depth, _ in of})}


def exact_errors(rows, step):
    """Returns the RMS error of the exact result by depth."""
    return {row["depth"]: row["rms"] for row in rows
            if row["steps"] == step and row["configuration"] in configurations([EXACT[step]])}


def plot(figure, measured, steps, cycles):
    panels, axes = figure.figure(rows=len(steps), columns=2)
    for row, step in zip(axes, steps):
        for ax, (quantity, rows), title in zip(row, measured.items(), (
                "residual of a scan's step", "error of the sphere's radius, RMS")):
            for depth, values in lines(rows, step, quantity, cycles).items():
                ax.semilogy(cycles, values, "o-", label=f"depth {depth}")
            ax.set_title(f"{title} (step {step})", fontsize=9)
            ax.set_xlabel("W-cycles")
            ax.set_xticks(cycles)
            ax.legend(fontsize=7)
    figure.save(panels)


def claim_residuals(figure, rows, cycles):
    """Compares each number of cycles with the next, and each depth with the next, at every measured step."""
    for step in sorted({row["steps"] for row in rows}):
        residuals = lines(rows, step, "residual", cycles)
        falls = largest(residuals.values())
        figure.claim(f"step {step}: the residual falls with every W-cycle: one more leaves at most {falls:.3g} times as much",
                     falls < 1)
        rises = largest(zip(*residuals.values()))
        figure.claim(f"step {step}: the residual does not rise with the depth: one level more leaves at most {rises:.3g} "
                     "times as much", rises <= 1)
        if step == EARLY:  # later, each number of cycles has a surface of its own
            figure.check(f"step {step}: largest ratio of residuals, one cycle more over one less", falls, at_most=1)


def largest(sequences):
    """Returns the largest ratio of a value to the one before it."""
    return max(after / before for values in map(list, sequences) for before, after in zip(values, values[1:]))


def check_sphere(figure, rows, cycles):
    """Checks the opposite of the paper's claim: a coarse octree does not keep the error up."""
    for step in sorted({row["steps"] for row in rows}):
        errors, exact = lines(rows, step, "rms", cycles), exact_errors(rows, step)
        coarsest, finest = min(exact), max(exact)
        figure.check(f"sphere, step {step}: largest ratio of errors, last cycle over first",
                           max(values[-1] / values[0] for values in errors.values()), at_most=1)
        figure.check(f"sphere, step {step}, depth {coarsest}: exact error over that of the last cycle",
                           exact[coarsest] / errors[coarsest][-1], at_most=0.5)
        if step == EARLY:
            figure.check(
                f"sphere, step {step}, exact: error at depth {coarsest} over {finest}",
                exact[coarsest] / exact[finest], at_most=2)


def check(figure, measured, cycles):
    claim_residuals(figure, measured["residual"], cycles)
    check_sphere(figure, measured["rms"], cycles)
    errors, exact = (lines(measured["rms"], EARLY, "rms", cycles), exact_errors(measured["rms"], EARLY))
    figure.claim("on a coarse octree the functions limit the sphere's error, not the solver",
                 exact[min(exact)] > 0.5 * errors[min(exact)][-1])


def main():
    figure = Reproduction("figure_7", __doc__)
    quick = figure.options.quick
    steps = [EARLY] if quick else [EARLY, LATE]
    measured, cycles = measure(figure, *(([5, 6], [4, 6]) if quick else (DEPTHS, SPHERE_DEPTHS)), steps)
    for quantity, rows in measured.items():
        for step in steps:
            figure.say(f"\n{rows[0]['mesh']}, step {step}: "
                       f"{'residual' if quantity == 'residual' else 'error of the radius'}\n")
            exact = exact_errors(rows, step)  # of the sphere only
            figure.table(["depth", *(f"{n} cycles" for n in cycles), "exact"],
                         [[depth, *values, exact.get(depth, "")] for depth, values
                          in lines(rows, step, quantity, cycles).items()])
    check(figure, measured, cycles)
    plot(figure, measured, steps, cycles)
    figure.finish()


if __name__ == "__main__":
    main()
