#!/usr/bin/env python3
"""What each part that a scene may do without costs: it is forced on, one at a time.

    python3 tests/performance/left_out.py             nine rounds, some six minutes
    python3 tests/performance/left_out.py --write     the same, into docs/performance/left_out.md
    python3 tests/performance/left_out.py --quick     one short round: does it all still run?

A round runs every case once, one after the other on one core, and a part's cost is taken against
its base in the same round: what else the machine does meets both. `benchmark.py --report` then
takes the page into docs/performance.md.
"""
import argparse
import statistics
import sys
from pathlib import Path

from measuring import PROJECT, Build, RunFailed, load, machine
from scenes import BENCHMARKS, one_run

PAGE = PROJECT / "docs" / "performance" / "left_out.md"
SCENE = BENCHMARKS / "block_gimp.yaml"
PARTICLES = 200 * 200 * 4

CONSTANTS = "youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, density: 1500 kg/m^3"
ELASTIC = f"material={{law: isotropic, {CONSTANTS}}}"
NEVER_YIELDS = f"material={{law: von_mises, {CONSTANTS}, yield_stress: 1000 GPa}}"
RATE_FORM = f"material={{law: isotropic, {CONSTANTS}, strain_measure: hypoelastic}}"
BARE = [ELASTIC, "loading.lateral=free"]
# All cases do some 200 steps of the same length, with 50 lines of the history on the way.
SHORT = ["numerics.cfl=0.4", "loading.ramp_time=0 s", "loading.strain=0.1225 %"]
GRAVITY = "{kind: gravity, acceleration: [0 m/s^2, -10 m/s^2]}"
DAMPING = "{kind: damping, rate: 1000 1/s}"
TRACTION = "{kind: traction, side: top, stress: [0 Pa, -1 kPa]}"
EXACT = "exact_solution={displacement: [0 m, 0 m], stress_xx: 0 Pa}"
SNAPSHOTS = "output.snapshots=5"
USL, USF, MUSL = (f"numerics.update_order={order}" for order in ("usl", "usf", "musl"))

LEANEST = "leanest: linear, FLIP, USF, elastic, free sides"
RICHEST = ("richest: GIMP, APIC, MUSL, plastic, rigid sides, load cell, loads, exact solution, "
           "snapshots")
BASE = "base: GIMP, FLIP, USL, elastic, free sides"
WITH_USF = "base with USF"
# Name: settings, and the case that it is compared with.
CASES = {
    LEANEST: ([*BARE, "numerics.shape_function=linear", USF], None),
    RICHEST: ([NEVER_YIELDS, MUSL, "numerics.scheme=apic", "loading.load_cell={cells: 3}",
               f"loads=[{GRAVITY}, {DAMPING}]", EXACT, SNAPSHOTS], None),
    BASE: ([*BARE, USL], None),
    "plastic law that never yields": ([*BARE, NEVER_YIELDS, USL], BASE),
    "deformation gradient (rate form)": ([*BARE, RATE_FORM, USL], BASE),
    "affine velocity, APIC": ([*BARE, USL, "numerics.scheme=apic"], BASE),
    "affine velocity, TPIC": ([*BARE, USL, "numerics.scheme=tpic"], BASE),
    WITH_USF: ([*BARE, USF], BASE),
    "re-mapped momentum, MUSL": ([*BARE, MUSL], BASE),
    "refinements, FMPM of order 4 (against USF)":
        ([*BARE, USF, "numerics.scheme=fmpm"], WITH_USF),
    "rigid walls at both sides": ([ELASTIC, USL], BASE),
    "load cell of 3 cells": ([*BARE, USL, "loading.load_cell={cells: 3}"], BASE),
    "gravity": ([*BARE, USL, f"loads=[{GRAVITY}]"], BASE),
    "damping": ([*BARE, USL, f"loads=[{DAMPING}]"], BASE),
    "traction on a side": ([*BARE, USL, f"loads=[{TRACTION}]"], BASE),
    "exact solution, 50 lines": ([*BARE, USL, EXACT], BASE),
    "5 snapshots of 2 fields": ([*BARE, USL, SNAPSHOTS], BASE),
}


def nanoseconds(result):
    """Of the loop with all that is written on the way, per particle of the block and step."""
    return 1e9 * result["loop_seconds"] / (PARTICLES * result["steps"])


def measure(build, rounds, more):
    """Rounds of summaries by case."""
    return [{name: one_run(build, SCENE, [*SHORT, *settings, *more])
             for name, (settings, _) in CASES.items()} for _ in range(rounds)]


def middle(values):
    """Median, and half of what lies between the quartiles: others use the machine as well."""
    if len(values) < 2:
        return values[0], 0.0
    quartiles = statistics.quantiles(values, n=4, method="inclusive")
    return quartiles[1], (quartiles[2] - quartiles[0]) / 2


def program_itself(build):
    """Peak memory, bytes, with hardly any particle."""
    return one_run(build, SCENE, [*SHORT, *CASES[BASE][0], "grid.cells=[4, 4]"])["peak_bytes"]


def row(name, base, results):
    time, spread = middle([nanoseconds(result[name]) for result in results])
    last = results[-1][name]
    cells = [name, f"{time:.1f}", f"{spread:.1f}"]
    if base is None:
        cells += ["", ""]
    else:
        more, off = middle([nanoseconds(result[name]) - nanoseconds(result[base])
                            for result in results])
        cells += [f"{more:+.1f}", f"{off:.1f}"]
    plan = last["plan"]
    cells += [str(plan["bytes_per_particle"]), str(plan["bytes_per_node"]),
              f"{last['largest_rank_bytes'] / PARTICLES:.0f}",
              f"{last['peak_bytes'] / PARTICLES:.0f}"]
    return "| " + " | ".join(cells) + " |"


def page(build, results, itself, loads):
    about, host = build.about(), machine()
    table = "\n".join(row(name, base, results) for name, (_, base) in CASES.items())
    return f"""# What is left out, and what it would cost

Written by `python3 tests/performance/left_out.py --write`. A block of 160,000 particles in the
plane (`inputs/benchmarks/block_gimp.yaml`), first {results[0][BASE]["steps"]} steps, one rank on
one core; medians of {len(results)} rounds in turn, `+-` half of what lies between the quartiles.
`more` is what the part adds to its base in the same round. Other programs ran on the machine, at
this load: differences below their `+-` say nothing.

- machine: {host["model"]}, {host["cores"]} cores, Linux {host["kernel"]}; load before and after
  {loads[0]:.1f} and {loads[1]:.1f}
- program: mpm_par {about["version"]}, git {about["git"]}; {about["compiler"]}, vectors
  {about["vectors"]}

ns: per particle of the block and step, all that is written on the way included. B: per particle,
per node, arrays of particles and nodes over particles, and peak of the whole process over
particles. Of the peak {itself / PARTICLES:.0f} B are the program with its libraries,
{itself / 2**20:.0f} MiB with 64 particles; the rest beside the arrays is sorting, reading the scene,
and the last sound state, as large as the arrays.

| scene | ns | +- | more | +- | B/particle | B/node | arrays | peak |
|---|---|---|---|---|---|---|---|---|
{table}

What a scene leaves out, and why, is in the plan of `--check` and in `summary.json`
([output files](../output_files.md#plan)).
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0],
                                     epilog=__doc__.split("\n\n", 1)[1],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=PROJECT / "build", help="build folder")
    parser.add_argument("--quick", action="store_true", help="one round of 10 steps")
    parser.add_argument("--write", action="store_true", help="write docs/performance/left_out.md")
    options = parser.parse_args()
    if options.quick and options.write:
        parser.error("--quick figures are not for the page: leave out --write")
    before = load()
    try:
        build = Build(options.build)
        results = measure(build, 1, ["steps=10"]) if options.quick else measure(build, 9, [])
        itself = program_itself(build)
    except RunFailed as failed:
        print(failed, file=sys.stderr)
        return 1
    text = page(build, results, itself, (before, load()))
    if options.write:
        PAGE.write_text(text)
        print(f"wrote {PAGE.relative_to(PROJECT)}")
    else:
        print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
