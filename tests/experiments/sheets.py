#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares separate sheets with glued sheets, which share functions in a cell as in the paper.

Two disjoint spheres, and a sphere above a plane patch, are a quarter of a cell apart: each piece must
flow as it does alone on the same grid, to 1e-6 of the diagonal. A hand at depth 5 has fingers that share
cells: the worst distance to the cotangent flow must be less than half of the glued one. For shapes whose
edges lie in grid planes, without two sheets in a cell, separate and glued must agree to 1e-6. The cost on
scans must be at most 5 % more unknowns and 20 % more time of the set-up.
"""

from experiment import CONVERGED, Experiment, label

TIGHT = f"{CONVERGED},tolerance=1e-10"
GLUED = {CONVERGED: f"{CONVERGED},glued", TIGHT: f"{TIGHT},glued"}
LARGEST_DIFFERENCE = 1e-6
LARGEST_HAND_RATIO = 0.5
LARGEST_UNKNOWN_RATIO = 1.05
LARGEST_TIME_RATIO = 1.2
FLOWS_OF_HAND = {1e-5: [1, 10, 100], 1e-4: [1, 3, 10, 20]}
CHECKED_FLOW_OF_HAND = (1e-4, 10)  # the difference appears after several steps


def add_options(parser):
    parser.add_argument("--depths", nargs="+", type=int, default=[7, 8],
                        help="depths for the cost")


def pair_up(rows, *keys):
    """Returns pairs of rows, separate and glued, by the values of these keys."""
    pairs = {}
    for row in rows:
        pairs.setdefault(tuple(row[key] for key in keys), []).append(row)
    return pairs


def measure_pieces(experiment):
    depths = [4, 5] if experiment.options.quick else [4, 5, 6, 7]
    pairs = pair_up(experiment.run("pieces", "--depths", *depths, "--configurations", TIGHT,
                                   GLUED[TIGHT], experiment="pieces"), "pieces", "depth")
    experiment.say("Disjoint pieces: worst difference between together and alone, in diagonals\n")
    experiment.table(["pieces", "depth", "moved", "separated", "glued", "all reached 1e-10"], [
        [*key, separated["moved"], separated["difference"], glued["difference"],
         "yes" if separated["reached_tolerance"] else "no"]
        for key, (separated, glued) in pairs.items()])
    experiment.check("largest difference with separated sheets",
                     max(separated["difference"] for separated, _ in pairs.values()),
                     at_most=LARGEST_DIFFERENCE)
    experiment.check("smallest difference with glued sheets, which proves that the pieces share cells",
                     min(glued["difference"] for _, glued in pairs.values()),
                     at_least=10 * LARGEST_DIFFERENCE)
    experiment.say()
    return pairs


def measure_hand(experiment):
    [hand] = experiment.meshes(["hand_8k.ply"], ["hand.off"])
    rows = []
    for step_size, steps in FLOWS_OF_HAND.items():
        rows += experiment.run("accuracy", hand, "--depths", 5, "--steps", *steps, "--step-size",
                               step_size, "--configurations", CONVERGED, GLUED[CONVERGED],
                               experiment="hand", step_size=step_size)
    pairs = pair_up(rows, "step_size", "steps")
    experiment.say("Hand at depth 5: worst distance to the cotangent flow, in diagonals, where its "
                   "triangles are sound\n")
    experiment.table(["δ", "steps", "separated", "glued", "ratio", "RMS: separated", "glued"], [
        [*key, separated["sound_worst"], glued["sound_worst"],
         separated["sound_worst"] / glued["sound_worst"], separated["sound_rms"],
         glued["sound_rms"]] for key, (separated, glued) in pairs.items()])
    step_size, steps = CHECKED_FLOW_OF_HAND
    separated, glued = pairs[CHECKED_FLOW_OF_HAND]
    experiment.check(f"worst distance after {steps} steps of {step_size:g} relative to glued",
                     separated["sound_worst"] / glued["sound_worst"], at_most=LARGEST_HAND_RATIO)
    experiment.say()
    return pairs


def measure_aligned(experiment):
    depths = [3, 4] if experiment.options.quick else [3, 4, 5, 6]
    rows = experiment.run("aligned", "--depths", *depths, "--configuration", TIGHT,
                          experiment="aligned")
    experiment.say("Edges in grid planes: worst difference between separated and glued, in "
                   "diagonals\n")
    experiment.table(["shape", "depth", "moved", "difference", "unknowns added"], [
        [row["shape"], row["depth"], row["moved"], row["difference"],
         row["separated_unknowns"] - row["glued_unknowns"]] for row in rows])
    experiment.check("largest difference", max(row["difference"] for row in rows),
                     at_most=LARGEST_DIFFERENCE)
    experiment.say()


def measure_cost(experiment):
    options = experiment.options
    rows = []
    for scan in experiment.scans():
        rows += experiment.run("setup", scan, "--depths", *options.depths, "--configurations",
                               CONVERGED, GLUED[CONVERGED], experiment="setup", mesh=label(scan))
    pairs = pair_up(rows, "mesh", "depth")
    ratios = {key: (separated["unknowns"] / glued["unknowns"],
                    separated["seconds"] / glued["seconds"])
              for key, (separated, glued) in pairs.items()}
    experiment.say("Cost: separated, and relative to glued\n")
    experiment.table(["mesh", "depth", "unknowns", "ratio", "set-up, s", "ratio"], [
        [*key, separated["unknowns"], ratios[key][0], separated["seconds"], ratios[key][1]]
        for key, (separated, _) in pairs.items()])
    experiment.check("largest ratio of unknowns", max(ratio for ratio, _ in ratios.values()),
                     at_most=LARGEST_UNKNOWN_RATIO)
    experiment.check("largest ratio of set-up times", max(ratio for _, ratio in ratios.values()),
                     at_most=LARGEST_TIME_RATIO)
    return ratios


def plot(experiment, pieces, hand, ratios):
    figure, axes = experiment.figure(columns=3)
    for i, name in enumerate(["separated", "glued"]):
        for kind, style in zip(dict.fromkeys(key[0] for key in pieces), ["o-", "s--"]):
            chosen = {key[1]: pair[i]["difference"] for key, pair in pieces.items()
                      if key[0] == kind}
            axes[0][0].semilogy(list(chosen), [max(1e-17, value) for value in chosen.values()],
                                style, color=f"C{i}", label=f"{kind}, {name}")
        checked = {steps: pair[i]["sound_worst"] for (step_size, steps), pair in hand.items()
                   if step_size == CHECKED_FLOW_OF_HAND[0]}
        axes[0][1].loglog(list(checked), list(checked.values()), "o-", label=name)
    axes[0][0].axhline(LARGEST_DIFFERENCE, color="black", linewidth=0.8, linestyle=":")
    axes[0][0].set_title("Pieces a quarter of a cell apart:\ntogether against alone, diagonals")
    axes[0][0].set_xlabel("depth")
    axes[0][1].set_title("Hand at depth 5: worst distance\nto the cotangent flow, diagonals")
    axes[0][1].set_xlabel(f"steps of {CHECKED_FLOW_OF_HAND[0]:g}")
    for ax in axes[0][:2]:
        ax.legend(fontsize=7)
    ax = axes[0][2]
    ax.barh([f"{mesh}, {depth}" for mesh, depth in ratios],
            [100 * (time - 1) for _, time in ratios.values()], label="set-up time")
    ax.barh([f"{mesh}, {depth}" for mesh, depth in ratios],
            [100 * (unknowns - 1) for unknowns, _ in ratios.values()], height=0.4,
            label="unknowns")
    ax.set_title("What separating adds, %")
    ax.legend(fontsize=7)
    experiment.save(figure)


def main():
    experiment = Experiment("sheets", __doc__, add_options)
    pieces = measure_pieces(experiment)
    hand = measure_hand(experiment)
    measure_aligned(experiment)
    ratios = measure_cost(experiment)
    plot(experiment, pieces, hand, ratios)
    experiment.finish()


if __name__ == "__main__":
    main()
