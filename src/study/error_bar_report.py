"""Bars out of the levels of one scene: table, error_bar.json and error_bar.csv."""
import csv
import dataclasses
import io
import json
import math
import time

import convergence
import machine
import results
import store
import tables
from mpm_par.quantities import percent


@dataclasses.dataclass
class Figure:
    """A property of the curve: where it stands in summary.json and how it is shown."""
    name: str
    path: str  # empty for the plateau stress, which is a mean of the history
    factor: float  # from SI to the unit shown
    unit: str


FIGURES = (
    Figure("modulus", "compression.modulus", 1e-6, "MPa"),
    Figure("buckling_stress", "compression.buckling.stress", 1e-6, "MPa"),
    Figure("buckling_strain", "compression.buckling.strain", 100, "%"),
    Figure("plateau_stress", "", 1e-6, "MPa"),
    Figure("densification_stress", "compression.densification.stress", 1e-6, "MPa"),
    Figure("densification_strain", "compression.densification.strain", 100, "%"),
)


@dataclasses.dataclass
class Bar:
    """A figure of the scene as it is, with its numerical error. SI units."""
    figure: Figure
    value: float = None
    error: float = None  # half width: the truth is expected in value +- error
    reading_error: float = 0.0  # two standard deviations of reading the curve
    order: float = None
    limit: float = None  # extrapolated
    basis: str = ""
    remark: str = ""
    levels: list = dataclasses.field(default_factory=list)  # values, coarse to fine; None: none


def size_of(done):
    """Of a level's cells: only ratios count."""
    cells = done.summary["cells"]
    return math.prod(cells) ** (-1 / len(cells))


def _read(figure, done, plateau):
    try:
        if not figure.path:
            return results.mean(done.folder / "history.csv", "stress", *plateau), 0.0
        value = results.figure(done.summary, figure.path)
        return value, abs(results.figure(done.summary, figure.path + "_error"))
    except results.Missing as missing:
        return None, str(missing)


def bar_of(figure, levels, plateau):
    """The bar of a figure. levels: (factor, Done) from coarse to fine.

    The bar of the finest level is convergence.estimate; where the scene is not the finest, what
    parts it from the finest level's limit is added. No bar is smaller than the error of reading."""
    bar = Bar(figure)
    read = [(factor, size_of(done), *_read(figure, done, plateau)) for factor, done in levels]
    bar.levels = [value for _, _, value, _ in read]
    own = next(entry for entry in read if entry[0] == 1)
    if own[2] is None:
        bar.remark = own[3]
        return bar
    bar.value, bar.reading_error = own[2], own[3]
    there = [entry for entry in read if entry[2] is not None]
    if len(there) < 2:
        bar.remark = "no other level has it"
        return bar
    found = convergence.estimate([entry[1] for entry in there], [entry[2] for entry in there])
    bar.order, bar.limit, bar.basis, bar.remark = (found.order, found.limit, found.basis,
                                                   found.remark)
    finest = found.limit if found.limit is not None else there[-1][2]
    away = abs(bar.value - finest) if there[-1][0] != 1 else 0.0
    bar.error = found.uncertainty + away
    if bar.error < bar.reading_error:
        bar.error, bar.remark = bar.reading_error, "as large as the error of reading the curve"
    return bar


def csv_text(bars):
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["figure", "value [SI]", "error [SI]", "relative_error [1]",
                    "reading_error [SI]", "order [1]", "limit [SI]", "basis", "remark"])
    for bar in bars:
        relative = bar.error / abs(bar.value) if bar.error is not None and bar.value else None
        row = [bar.figure.name, bar.value, bar.error, relative, bar.reading_error, bar.order,
               bar.limit, bar.basis, bar.remark]
        table.writerow([f"{c:.9g}" if isinstance(c, float) else "" if c is None else c
                        for c in row])
    return text.getvalue()


def _costs(levels):
    return [{"factor": factor, "cells": done.summary["cells"],
             "particles": done.summary["particles"], "steps": done.summary["steps"],
             "elapsed_seconds": done.ended.elapsed_seconds,
             "peak_memory_mib": done.ended.peak_memory_bytes / 2 ** 20,
             "energy_error": done.summary["energy_error"]} for factor, done in levels]


def json_text(given, program, levels, plateau, bars):
    figures = {bar.figure.name: {key: value for key, value in dataclasses.asdict(bar).items()
                                 if key != "figure"} for bar in bars}
    return json.dumps({
        "scene": given.file, "settings": given.set, "ranks": given.ranks,
        "plateau_strain": plateau, "figures": figures, "levels": _costs(levels),
        "safety_factor_where_levels_agree": convergence.FACTOR,
        "safety_factor_of_three_levels": convergence.UNCONFIRMED_FACTOR,
        "safety_factor_where_not_monotone": convergence.CAUTIOUS_FACTOR,
        "written": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
        "mpm_par": program.version, "machine": machine.machine()}, indent=1) + "\n"


def terminal_text(levels, plateau, bars):
    """Bars and costs in 80 columns."""
    lines = ["", f"{'figure':22}{'value':>10}  {'numerical error':<22}{'order':>6}  basis"]
    for bar in bars:
        shown = bar.figure
        if bar.value is None:
            lines.append(f"{shown.name:22}{'-':>10}")
        else:
            error = "-" if bar.error is None else \
                f"+- {bar.error * shown.factor:.3g} {shown.unit} " \
                f"({percent(bar.error / abs(bar.value)) if bar.value else '-'})"
            order = "-" if bar.order is None else f"{bar.order:.2f}"
            lines.append(f"{shown.name:22}{bar.value * shown.factor:>10.4g}  {error:<22}{order:>6}"
                         f"  {bar.basis}".rstrip())
    for bar in bars:
        if bar.remark:
            lines.append(tables.indented(f"{bar.figure.name}: {bar.remark}"))
    lines += [tables.indented(
        "gci: from the observed order; first order: from the range of the levels, as if it fell in "
        "first order; spread: wider, no order is seen (docs/studies.md). Plateau stress: mean "
        f"from {percent(plateau[0])} to {percent(plateau[1])} strain."), "",
        f"{'level':22}{'cells':>14}{'particles':>12}{'steps':>10}{'seconds':>10}"]
    total = sum(done.ended.elapsed_seconds for _, done in levels)
    own = next(done for factor, done in levels if factor == 1).ended.elapsed_seconds
    for factor, done in levels:
        name = "the scene" if factor == 1 else f"cells x {factor:.3g}"
        cells = "x".join(map(str, done.summary["cells"]))
        lines.append(f"{name:22}{cells:>14}{done.summary['particles']:>12}"
                     f"{done.summary['steps']:>10}{done.ended.elapsed_seconds:>10.1f}")
    lines.append(f"the bars cost {total - own:.1f} s beside the scene's {own:.1f} s")
    return "\n".join(lines) + "\n"


def write(given, program, levels, plateau, output):
    """The files, whole, and the table."""
    bars = [bar_of(figure, levels, plateau) for figure in FIGURES]
    store.write_whole(output / "error_bar.csv", csv_text(bars))
    store.write_whole(output / "error_bar.json", json_text(given, program, levels, plateau, bars))
    print(terminal_text(levels, plateau, bars), end="")
    return bars
