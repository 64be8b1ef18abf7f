#!/usr/bin/env python3
"""Measures what mpm_par costs and compares with the last release.

    python3 tests/performance/benchmark.py                 everything, about an hour
    python3 tests/performance/benchmark.py --quick         a minute: does it all still run?
    python3 tests/performance/benchmark.py --only wood     one group
    python3 tests/performance/benchmark.py --resume        only what an interrupted run of the same
                                                           program left out
    python3 tests/performance/benchmark.py --store 1.0.0   keep as that release's table, and write
                                                           docs/performance.md

Needs a build with -DMPM_BUILD_BENCHMARKS=ON on a quiet machine. The table goes to
BUILD/performance/table.json and .md. Exit status 1: a figure is more than 10 % worse.
"""
import argparse
import re
import subprocess
import sys
import time
from pathlib import Path

import growth
import kernels
import report
import scenes
import studies
import table as tables
from measuring import PROJECT, Build, RunFailed, load, machine

STORED = Path(__file__).parent / "stored"
GROUPS = {"kernels": kernels.measure_kernels, "steps": kernels.measure_steps,
          "halo": kernels.measure_halo, "blocks": scenes.measure_blocks,
          "ranks": scenes.measure_ranks, "growth": growth.measure_growth,
          "memory": growth.measure_memory, "scale": growth.measure_scale,
          "studies": studies.measure_studies,
          "instructions": scenes.measure_instructions, "wood": scenes.measure_wood}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0],
                                     epilog=__doc__.split("\n\n", 2)[2],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=PROJECT / "build", help="build folder")
    parser.add_argument("--quick", action="store_true", help="fewer cases, 2 samples")
    parser.add_argument("--only", action="append", choices=GROUPS, help="this group (repeatable)")
    parser.add_argument("--resume", action="store_true", help="keep the groups of BUILD/performance/"
                        "table.json if the same program was measured")
    parser.add_argument("--repeat", type=int, default=5, help="samples of a figure (default 5)")
    parser.add_argument("--store", metavar="RELEASE", help="keep as the table of a release")
    parser.add_argument("--unjudged", action="store_true", help="exit status 0 whatever is worse")
    parser.add_argument("--report", action="store_true",
                        help="write docs/performance.md from the last stored table; measure nothing")
    return parser.parse_args()


def last_release():
    """The stored table with the highest version."""
    releases = [path.stem for path in STORED.glob("*.json")]
    return max(releases, key=lambda name: [int(number) for number in re.findall(r"\d+", name)],
               default=None)


def resumed(options, about, path):
    """The table of an earlier run, if it may be gone on with."""
    if options.resume and path.exists():
        earlier = tables.read(path)
        if all(earlier["about"][key] == about[key] for key in ("machine", "build", "quick")):
            return earlier
    return {"about": about, "groups": [], "figures": []}


def measure(options):
    """Writes the table after every group: nothing is lost where a later one fails."""
    build = Build(options.build)
    folder = options.build / "performance"
    before = load()
    if before > 0.3:
        print(f"benchmark.py: the machine is busy (load {before:.2f}): times will be too long",
              file=sys.stderr)
    table = resumed(options, {"machine": machine(), "build": build.about(), "load": [before, before],
                              "date": time.strftime("%Y-%m-%d"), "quick": options.quick},
                    folder / "table.json")
    for name in options.only or GROUPS:
        if name in table["groups"]:
            continue
        start = time.monotonic()
        table["figures"] += GROUPS[name](build, 2 if options.quick else options.repeat,
                                         options.quick)
        table["groups"].append(name)
        table["about"]["load"][1] = load()
        tables.write(table, folder / "table.json")
        print(f"{name}: {time.monotonic() - start:.0f} s", flush=True)
    (folder / "table.md").write_text(tables.about_text(table) + "\n\n" +
                                     tables.markdown(table["figures"]) + "\n")
    print(f"wrote {folder / 'table.json'} and table.md")
    return table


def draw_growth(table, path):
    """Matplotlib is installed for the system's Python, which need not be this one."""
    try:
        growth.draw(table["figures"], path)
    except ImportError:
        subprocess.run(["/usr/bin/python3", "-c",
                        "import growth, sys, table; from pathlib import Path; "
                        "growth.draw(table.read(Path(sys.argv[1]))['figures'], Path(sys.argv[2]))",
                        STORED / f"{last_release()}.json", path],
                       cwd=Path(__file__).parent, check=True)


def main():
    options = arguments()
    if options.report:
        report.write_page(tables.read(STORED / f"{last_release()}.json"), last_release())
        return 0
    if options.store and (options.quick or options.only):
        print("benchmark.py: --store keeps whole tables, without --quick and --only",
              file=sys.stderr)
        return 2
    try:
        table = measure(options)
    except RunFailed as failure:
        print(f"benchmark.py: {failure}", file=sys.stderr)
        return 2
    release = last_release()
    worse = []
    if release:
        comparison = tables.compare(table, tables.read(STORED / f"{release}.json"))
        if options.quick or options.only:
            comparison.missing = []
        print(f"compared with release {release}:\n{comparison.text()}")
        worse = comparison.worse
    if options.store:
        tables.write(table, STORED / f"{options.store}.json")
        draw_growth(table, report.PICTURE)
        report.write_page(table, options.store)
    return 1 if worse and not options.unjudged else 0


if __name__ == "__main__":
    sys.exit(main())
