#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figure 2: a scan through 200 short steps.

The paper shows a horse after up to 200 steps of 1e-5 and concludes that the tracked flow is stable. Here a
scan flows by the paper's method (one W-cycle) and by the product's (the mesh's own elements). Targets for
both: all steps are made; all positions are finite; the area rises in no step; the surface stays in its initial
bounding box; the flow has removed most of the detail's area. A step that leaves the box by more than a margin
ends the flow, so a surface that flies away shows as fewer steps. So does one that vanishes: a flow ends once
less than a thousandth of the area is left.
"""

from reproduction import CONVERGED, PAPER, Reproduction

METHODS = {PAPER: "paper's method", CONVERGED: "product"}
LARGEST_DISTANCE_OUTSIDE = 0.01  # in diagonals
LARGEST_RISE = 1e-6
VANISHED_AREA = 1e-3  # kVanishedArea of the core


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
        parser.add_argument("--depth", type=int, default=0, help="of the paper's octree; 0: automatic")

    @property
    def is_quick(self):
        return self.figure.options.quick

    def run(self, scan):
        figure = self.figure
        depth = 5 if self.is_quick else figure.options.depth
        rows = {method: figure.flow(scan, self.step_size, range(1, self.last + 1),
                                    configuration=method, depth=depth) for method in METHODS}
        made = {method: [row for row in of if row["steps"] == row["steps_made"]] for method, of in rows.items()}
        self._tell(scan, made)
        for method, name in METHODS.items():
            figure.claim(f"{name}: the flow is stable over {self.last} steps of {self.step_size:g}",
                         self._check(name, made[method]))
        if not self.is_quick:
            self._plot(made)
            self._draw(scan, made)
        figure.finish()

    def _tell(self, scan, rows):
        ends = {method: rows[method][-1] for method in METHODS}
        self.figure.table(
            ["method", "steps", "area", "volume", "outside", "collapsed", "processor s per step"],
            [[METHODS[method], row["steps"], row["area"], row["volume"], row["outside"],
              row["collapsed"] if method == PAPER else "",
              (row["assemble_seconds"] + row["solve_seconds"]) / max(1, row["steps_made"])]
             for method in METHODS for row in rows[method]
             if row["steps"] in self.pictures or row is ends[method]])
        self.figure.say(
            f"{scan.stem} under steps of {self.step_size:g}; the paper's octree has depth "
            f"{ends[PAPER]['depth']}. "
            + " ".join(f"The {name} makes {end['steps_made']} steps and leaves "
                       f"{100 * end['area']:.3g} % of the area and {100 * end['volume']:.3g} % of the "
                       "volume."
                       for name, end in ((METHODS[method], ends[method]) for method in METHODS))
            + "\n")

    def _check(self, name, rows):
        """Returns whether the flow is stable. `rows` are those of the steps made."""
        end = rows[-1]
        areas = [1.0] + [row["area"] for row in rows]
        check = self.figure.check
        stable = [
            check(f"{name}: steps made", end["steps_made"], at_least=self.last)
            if end["area"] > VANISHED_AREA else self._vanished(name, end),
            check(f"{name}: finite after every step", min(row["finite"] for row in rows), at_least=1),
            check(f"{name}: greatest rise of the area in a step",
                  max(after - before for before, after in zip(areas, areas[1:])),
                  at_most=LARGEST_RISE),
            check(f"{name}: distance outside the initial box, in its diagonals",
                  max(row["outside"] for row in rows), at_most=LARGEST_DISTANCE_OUTSIDE)]
        if not self.is_quick:
            check(f"{name}: area at the end", end["area"], at_most=self.largest_area)
        return all(stable)

    def _vanished(self, name, end):
        self.figure.say(f"- {name}: the surface vanishes after {end['steps']} steps: {end['area']:.2g} of the area "
                        "is left")
        return True

    def _plot(self, rows):
        plot, axes = self.figure.figure(1, 2, (4.5, 3))
        for ax, what in zip(axes[0], ("area", "volume")):
            for method, style in zip(METHODS, ("-", "--")):
                ax.plot([0] + [row["steps"] for row in rows[method]],
                        [1] + [row[what] for row in rows[method]], style,
                        label=METHODS[method])
            ax.set_xlabel(f"steps of {self.step_size:g}")
            ax.set_ylabel(f"{what}, relative to the start")
            ax.set_ylim(bottom=0)
            ax.legend(fontsize=7)
        self.figure.save(plot)

    def _draw(self, scan, rows):
        for method in METHODS:
            surface = {row["steps"]: row["surface"] for row in rows[method]}
            drawn = [n for n in self.pictures if n in surface]
            self.figure.draw(f"_{method}", [scan] + [surface[n] for n in drawn], [0, *drawn],
                             "--height", 310, *self.view)


def main():
    stability = Stability("figure_2", __doc__, 1e-5, [0, 5, 25, 50, 100, 200], 0.7,
                          ["--view", 0, 0, 1])
    [scan] = stability.figure.scans(["armadillo_50k.ply"], ["armadillo.off"])
    stability.run(scan)


if __name__ == "__main__":
    main()
