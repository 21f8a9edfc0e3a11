#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the stabilisation's weight κ costs in resolution.

Scans flow 1 and 10 steps of 1e-5 with several κ, on a coarse octree and on a fine one. Drawn is the RMS
distance to the cotangent flow, as a ratio to that of the paper's solver, which has no κ. Where the
ratio rises with κ, κ costs resolution. The converged solver without κ is drawn as a dashed line.
"""

from reproduction import PAPER, Reproduction, geometric_mean, kappa, label

SHARED = ["nefertiti_50k.ply", "armadillo_50k.ply", "hand_8k.ply"]
CGAL = ["armadillo.off", "camel.off", "elephant.off"]
KAPPAS = [0.001, 0.01, 0.03, 0.1, 1]
DEFAULT = 0.01
STEPS = [1, 10]


def measure(figure, depths, kappas):
    """Returns the ratios by depth, number of steps and κ: one for each scan."""
    ratios = {}
    for scan in figure.scans(SHARED, CGAL):
        rows = figure.run("accuracy", scan, "--depths", *depths, "--steps", *STEPS, "--step-size", 1e-5,
                          "--configurations", PAPER, *map(kappa, kappas), mesh=label(scan))
        rms = {(row["depth"], row["steps"], row["configuration"]): row["rms"] for row in rows}
        for depth in depths:
            for steps in STEPS:
                for weight in kappas:
                    ratios.setdefault((depth, steps, weight), []).append(
                        rms[depth, steps, kappa(weight)] / rms[depth, steps, PAPER])
    return ratios


def title(steps):
    return f"{steps} step{'s' if steps > 1 else ''}"


def plot(figure, depths, means):
    panels, axes = figure.figure(columns=len(STEPS))
    for ax, steps in zip(axes[0], STEPS):
        for depth, colour in zip(depths, ("tab:blue", "tab:orange")):
            ax.semilogx(KAPPAS, [means[depth, steps, weight] for weight in KAPPAS], "o-",
                        color=colour, label=f"depth {depth}")
            ax.axhline(means[depth, steps, 0], color=colour, linestyle="--", linewidth=0.8)
        ax.axhline(1, color="black", linewidth=0.8)
        ax.set_title(title(steps), fontsize=9)
        ax.set_xlabel("κ")
        ax.set_ylabel("distance to the cotangent flow over the paper's", fontsize=8)
        ax.legend(fontsize=7)
    figure.save(panels)


def main():
    figure = Reproduction("kappa", __doc__)
    depths = [5, 6] if figure.options.quick else [5, 7]
    kappas = [0, *KAPPAS]
    ratios = measure(figure, depths, kappas)
    means = {case: geometric_mean(values) for case, values in ratios.items()}
    figure.say("RMS distance to the cotangent flow over that of the paper's solver, geometric mean. "
               f"Number of scans: {len(next(iter(ratios.values())))}\n")
    figure.table(["depth", "steps", *(f"κ = {weight:g}" for weight in kappas)],
                 [[depth, steps, *(means[depth, steps, weight] for weight in kappas)]
                  for depth in depths for steps in STEPS])
    of_default = [means[depth, steps, DEFAULT] for depth in depths for steps in STEPS]
    figure.check(f"κ = {DEFAULT}: largest ratio to the paper's solver", max(of_default), at_most=1.1)
    figure.check(f"κ = {DEFAULT}: largest ratio to the converged solver without κ",
                 max(means[depth, steps, DEFAULT] / means[depth, steps, 0]
                     for depth in depths for steps in STEPS), at_most=1.1)
    coarse = depths[0]
    figure.check(f"depth {coarse}, {title(STEPS[-1])}: κ = {KAPPAS[-1]} over the best κ",
                 means[coarse, STEPS[-1], KAPPAS[-1]]
                 / min(means[coarse, STEPS[-1], weight] for weight in kappas), at_least=1.05)
    for depth in depths:
        for steps in STEPS:
            best = min(kappas, key=lambda weight: means[depth, steps, weight])
            figure.say(f"- Depth {depth}, {title(steps)}: the best κ is {best:g}. The default's distance is "
                       f"{means[depth, steps, DEFAULT] / means[depth, steps, best]:.3g} times as great.")
    plot(figure, depths, means)
    figure.finish()


if __name__ == "__main__":
    main()
