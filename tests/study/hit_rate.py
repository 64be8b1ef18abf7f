#!/usr/bin/env python3
"""How often the bar of three levels of a study holds what is known better.

    python3 tests/study/hit_rate.py results/block_levels/study.json ...

Levels are taken as mpm_study --error-bar takes them, each about 1.5 times as coarse as the next
(1.35 to 1.67). What is known better is the number that the errors are against, or else the finest
run of the series: then only triples count whose finest level is at least 1.9 times as coarse.
Compares scalar measures of good runs.
"""
import itertools
import json
import pathlib
import sys

SOURCES = pathlib.Path(__file__).resolve().parents[2] / "src"
sys.path[:0] = [str(SOURCES / "study"), str(SOURCES / "python")]

import convergence  # noqa: E402
import resolution  # noqa: E402


def ladders(study, measure):
    """{series: [(size, value)] from coarse to fine} of a study.json."""
    along, name, found = study["along"], f"value_{measure['name']}", {}
    for run in study["runs"]:
        if run.get(name) is None or run["state"] != "ok":
            continue
        series = ", ".join(str(value) for key, value in run["settings"].items()
                           if key not in (along, "ranks"))
        found.setdefault(series, []).append((resolution.size(along, run["settings"][along]),
                                             run[name]))
    return {series: sorted(levels, reverse=True) for series, levels in found.items()}


def triples(levels):
    """Levels whose sizes fall about 1.5 times."""
    for three in itertools.combinations(levels, 3):
        if all(1.35 <= coarse[0] / fine[0] <= 1.67 for coarse, fine in zip(three, three[1:])):
            yield three


def hits(levels, known):
    """[(hit, bar, error, basis)] relative to what is known; known: the exact value, or None."""
    found = []
    for three in triples(levels):
        if known is None and three[-1][0] < 1.9 * levels[-1][0]:
            continue
        truth = levels[-1][1] if known is None else known
        bar = convergence.estimate(*([level[k] for level in three] for k in (0, 1)))
        error = abs(three[-1][1] - truth)
        found.append((error <= bar.uncertainty, bar.uncertainty / abs(truth), error / abs(truth),
                      bar.basis))
    return found


def main(paths):
    counts = []
    print(f"{'series':44}{'hits':>10}{'bar, median':>13}{'error, median':>15}")
    for path in paths:
        study = json.loads(pathlib.Path(path).read_text())
        for measure in study["measures"]:
            known = measure["against"] if isinstance(measure["against"], float) else None
            for series, levels in ladders(study, measure).items():
                found = hits(levels, known)
                if not found:
                    continue
                counts += found
                middle = len(found) // 2
                bar, error = (sorted(entry[k] for entry in found)[middle] for k in (1, 2))
                print(f"{measure['name'] + ' ' + series:44}"
                      f"{sum(entry[0] for entry in found):>6}/{len(found):<3}"
                      f"{100 * bar:>11.2g} %{100 * error:>13.2g} %")
    good = sum(entry[0] for entry in counts)
    print(f"{good} of {len(counts)} bars hold it")
    for basis in sorted({entry[3] for entry in counts}):
        own = [entry for entry in counts if entry[3] == basis]
        print(f"  {basis}: {sum(entry[0] for entry in own)} of {len(own)}")


if __name__ == "__main__":
    main(sys.argv[1:])
