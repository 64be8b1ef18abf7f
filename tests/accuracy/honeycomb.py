"""The crushed honeycomb at several resolutions, to 60 % strain: what early contact costs.

    honeycomb.py MPM_PAR [--quick] [--work DIR] [--write]

--write puts what is kept in DIR into docs/accuracy; --quick runs the three coarsest levels with one
method and writes nothing.
"""
import argparse
from pathlib import Path

import numpy

import runs
from loblolly import figures

SCENE = runs.PROJECT / "inputs" / "benchmarks" / "crushed_honeycomb.yaml"
LEVELS = [[26, 27], [37, 38], [52, 54], [74, 77], [104, 108], [147, 153], [208, 216]]
METHODS = ["linear flip", "gimp flip", "quadratic flip", "cubic flip"]
LARGEST = {"gimp flip": 208, "quadratic flip": 208}  # others to 147 cells
STRAINS = numpy.linspace(0, 0.6, 151)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--quick", action="store_true")
    arguments.add_argument("--work", type=Path, default=runs.PROJECT / "results" / "accuracy")
    arguments.add_argument("--write", action="store_true")
    given = arguments.parse_args()
    plan = [(method, cells) for cells in LEVELS for method in METHODS
            if cells[0] <= LARGEST.get(method, 147)]
    if given.quick:
        plan = [("gimp flip", cells) for cells in LEVELS[:3]]
    table = runs.CurveTable(STRAINS, figures)
    for method, cells in plan:
        settings = ["output.snapshots=0", f"grid.cells={cells}", *runs.method_settings(method)]
        table.add({"method": method, "cells": cells[0]},
                  runs.run(given.mpm_par, SCENE, settings, given.work))
    if given.write and not given.quick:
        table.write("honeycomb")


if __name__ == "__main__":
    main()
