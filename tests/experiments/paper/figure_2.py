#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 2: a scan through 200 short steps.

The paper shows a horse after up to 200 steps of 1e-5 and concludes that the tracked flow is stable. Here a
scan flows by the paper's solver (one W-cycle) and by the converged solver. Targets for both solvers: all
steps are made; all positions are finite; the area rises in no step; the surface stays in its initial bounding
box; the flow has removed most of the detail's area. A step that leaves the box by more than a margin is made
again with more care (core/flow/confinement.h), so a surface that flies away shows as fewer steps.
"""

from reproduction import CONVERGED, PAPER, Reproduction

SOLVERS = {PAPER: "paper's solver", CONVERGED: "converged solver"}
LARGEST_DISTANCE_OUTSIDE = 0.01  # in diagonals
LARGEST_RISE = 1e-6


class Stability:
    """A flow in many steps, with pictures of some; figure_3.py has another one."""

    def __init__(self, name, description, step_size, pictures, largest_area, view=()):
        self.figure = Reproduction(name, description, self._add_options)
        self.step_size = step_size
        self.largest_area = largest_area
        self.view = view
        self.pictures = [steps for steps in pictures if steps <= 20 or not self.is_quick]
        self.last = self.pictures[-1]

    @staticmethod
    def _add_options(parser):
        parser.add_argument("--depth", type=int, default=0, help="of the octree; 0: automatic")

    @property
    def is_quick(self):
        return self.figure.options.quick

    def run(self, scan):
        figure = self.figure
        depth = 5 if self.is_quick else figure.options.depth
        rows = {solver: figure.flow(scan, self.step_size, range(1, self.last + 1),
                                    configuration=solver, depth=depth) for solver in SOLVERS}
        self._tell(scan, rows)
        stable = [self._check(solver, rows[solver]) for solver in SOLVERS]
        figure.claim(f"the flow is stable over {self.last} steps of {self.step_size:g}",
                     all(stable))
        if not self.is_quick:
            self._plot(rows)
            self._draw(scan, rows)
        figure.finish()

    def _tell(self, scan, rows):
        ends = {solver: rows[solver][-1] for solver in SOLVERS}
        self.figure.table(
            ["solver", "steps", "area", "volume", "outside", "collapsed", "processor s per step"],
            [[SOLVERS[solver], row["steps"], row["area"], row["volume"], row["outside"],
              row["collapsed"],
              (row["assemble_seconds"] + row["solve_seconds"]) / max(1, row["steps_made"])]
             for solver in SOLVERS for row in rows[solver] if row["steps"] in self.pictures])
        self.figure.say(
            f"{scan.stem} under steps of {self.step_size:g}, on an octree of depth "
            f"{ends[PAPER]['depth']}. "
            + " ".join(f"The {name} makes {end['steps_made']} steps and leaves "
                       f"{100 * end['area']:.3g} % of the area and {100 * end['volume']:.3g} % of the "
                       f"volume; {100 * end['collapsed']:.3g} % of the samples have collapsed."
                       for name, end in ((SOLVERS[solver], ends[solver]) for solver in SOLVERS))
            + "\n")

    def _check(self, solver, rows):
        """Returns whether the flow is stable."""
        name, end = SOLVERS[solver], rows[-1]
        areas = [1.0] + [row["area"] for row in rows]
        check = self.figure.check
        stable = [
            check(f"{name}: steps made", end["steps_made"], at_least=self.last),
            check(f"{name}: finite after every step", min(row["finite"] for row in rows), at_least=1),
            check(f"{name}: greatest rise of the area in a step",
                  max(after - before for before, after in zip(areas, areas[1:])),
                  at_most=LARGEST_RISE),
            check(f"{name}: distance outside the initial box, in its diagonals",
                  max(row["outside"] for row in rows), at_most=LARGEST_DISTANCE_OUTSIDE)]
        if not self.is_quick:
            check(f"{name}: area at the end", end["area"], at_most=self.largest_area)
        return all(stable)

    def _plot(self, rows):
        plot, axes = self.figure.figure(1, 2, (4.5, 3))
        for ax, what in zip(axes[0], ("area", "volume")):
            for solver, style in zip(SOLVERS, ("-", "--")):
                ax.plot([0] + [row["steps"] for row in rows[solver]],
                        [1] + [row[what] for row in rows[solver]], style,
                        label=SOLVERS[solver])
            ax.set_xlabel(f"steps of {self.step_size:g}")
            ax.set_ylabel(f"{what}, relative to the start")
            ax.set_ylim(bottom=0)
            ax.legend(fontsize=7)
        self.figure.save(plot)

    def _draw(self, scan, rows):
        for solver in SOLVERS:
            surface = {row["steps"]: row["surface"] for row in rows[solver]}
            self.figure.draw(f"_{solver}", [scan] + [surface[n] for n in self.pictures[1:]],
                             self.pictures, "--height", 310, *self.view)


def main():
    stability = Stability("figure_2", __doc__, 1e-5, [0, 5, 25, 50, 100, 200], 0.7,
                          ["--view", 0, 0, 1])
    [scan] = stability.figure.scans(["armadillo_50k.ply"], ["armadillo.off"])
    stability.run(scan)


if __name__ == "__main__":
    main()
