"""study.csv, study.json and the table of the terminal."""
import csv
import io
import json
import os

import numpy

import evaluation
from measure_keys import LEARNT
from mpm_par.problems import folded
from mpm_par.quantities import percent

COLUMNS = ("wall_seconds", "wall_spread", "core_seconds", "cpu_seconds", "elapsed_seconds",
           "particle_steps", "particles", "steps", "peak_memory_mib", "energy_error", "rounds",
           "exit_status", "status")
UNITS = {"wall_seconds": "s", "core_seconds": "s", "cpu_seconds": "s", "elapsed_seconds": "s",
         "peak_memory_mib": "MiB"}


def _number(value):
    """For JSON: a curve and what is not finite are left out."""
    if value is None or isinstance(value, numpy.ndarray):
        return None
    if isinstance(value, float) and not numpy.isfinite(value):
        return None
    return value


def _settings(study, row):
    return {key: row.combination.value(key) for key in [*(k for k in study.varied if k != "ranks"),
                                                        "ranks"]}


def _point(study, row, measure):
    """Columns of a measure: those that its study can fill."""
    name = measure.name
    found = {f"value_{name}": _number(row.values.get(name))}
    if measure.against is not None:
        found[f"error_{name}"] = _number(row.errors.get(name))
    if measure.against in LEARNT:
        bar = row.bars.get(name)
        found[f"bar_{name}"] = _number(bar.uncertainty if bar else None)
    if any(name in entry.values for entry in study.known):
        found[f"known_{name}"] = row.known.get(name)
    return found


def csv_text(study, rows):
    """A row a run. Units stand in the titles, as in history.csv."""
    text = io.StringIO()
    names = [name for measure in study.measures for name in _point(study, rows[0], measure)]
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*_settings(study, rows[0]),
                    *(f"{n} [{'1' if n.startswith('error_') else 'SI'}]" for n in names),
                    *(f"{c.removesuffix('_mib')} [{UNITS.get(c, '1')}]" for c in COLUMNS[:-2]),
                    *COLUMNS[-2:]])
    for row in rows:
        figures = {name: value for measure in study.measures
                   for name, value in _point(study, row, measure).items()}
        cells = [*_settings(study, row).values(), *figures.values(),
                 *(getattr(row, column) for column in COLUMNS)]
        table.writerow([f"{c:.9g}" if isinstance(c, float) else "" if c is None else c
                        for c in cells])
    return text.getvalue()


def _reference(reference):
    if reference is None:
        return None
    return {"value": _number(reference.value), "words": reference.words,
            "order": reference.order, "orders": reference.orders, "warnings": reference.warnings}


def _folder(row, output):
    """Of the results, relative to the study's; None of a run that failed."""
    return os.path.relpath(row.folder, output) if row.folder else None


def json_text(study, rows, outcomes, provenance, output):
    """All of the study: rows, references, fronts, targets, provenance and machine."""
    measures = [{
        "name": outcome.measure.name, "kind": outcome.measure.kind,
        "path": outcome.measure.path, "column": outcome.measure.column,
        "against": outcome.measure.against,
        "references": [{"series": dict(series), **(_reference(reference) or {"value": None})}
                       for series, reference in outcome.references.items()],
        "slopes": [{"series": dict(series), "cost": cost, "slope": slope}
                   for (series, cost), slope in outcome.slopes.items()],
        "pareto": {cost: [rows.index(row) for row in front]
                   for cost, front in outcome.fronts.items()},
        "targets": outcome.targets, "warnings": outcome.warnings} for outcome in outcomes]
    runs = [{"settings": _settings(study, row), "label": row.label, "level": row.level,
             "state": row.state, "folder": _folder(row, output),
             **{column: _number(getattr(row, column)) for column in COLUMNS},
             **{name: value for measure in study.measures
                for name, value in _point(study, row, measure).items()},
             "remarks": row.remarks} for row in rows]
    return json.dumps({"title": study.title, "quick": study.quick, "along": study.along,
                       "varied": study.varied, "known_source": study.known_source,
                       "known_run_time": study.known_run_time, "runs": runs,
                       "measures": measures, **provenance}, indent=1, allow_nan=False) + "\n"


def _line(cells, widths):
    """Left the first cell, right the others; what is too long ends in two dots."""
    parts = []
    for k, (cell, width) in enumerate(zip(cells, widths)):
        cell = cell if len(cell) <= width else cell[:width - 2] + ".."
        parts.append(cell.ljust(width) if k == 0 else cell.rjust(width))
    return " ".join(parts).rstrip()


def _shown(value, unit=""):
    return "-" if value is None else f"{value:.3g}{unit}"


def indented(text):
    return folded(text, "  ", "    ")


def _reasons(study, rows, name):
    """Why rows are bad or have no value; the same reason of several levels is said once."""
    whose = {}
    for row in rows:
        why = row.status if row.state != evaluation.OK else row.remarks.get(name, "")
        if why and why != evaluation.IS_REFERENCE:
            whose.setdefault((row.label, why), []).append(row)
    return [indented(f"{evaluation.describe(study, same[0])}"
                     + (f" and {len(same) - 1} more" if len(same) > 1 else "") + f": {why}")
            for (_, why), same in whose.items()]


def terminal_text(study, rows, outcomes):
    """For each measure its runs, references, warnings and targets, in 80 columns."""
    lines = []
    widths = (34, 10, 9, 9, 14)
    for outcome in outcomes:
        name = outcome.measure.name
        shown = name.replace("_", " ")
        bare = outcome.measure.against is None
        lines += ["", f"{study.title}: {shown}" if bare else f"{study.title}: error of {shown}",
                  _line(("settings", "value", "known" if bare else "error", "wall s", "status"),
                        widths)]
        on_front = {id(row) for row in outcome.fronts["wall_seconds"]}
        for row in rows:
            error = row.errors.get(name)
            value = row.values.get(name)
            mark = "*" if id(row) in on_front else ""
            status = row.state if row.state != evaluation.OK else \
                "reference" if row.remarks.get(name) == evaluation.IS_REFERENCE else \
                "no value" if value is None else row.state
            lines.append(_line((evaluation.describe(study, row),
                                _shown(value) if not isinstance(value, numpy.ndarray) else "curve",
                                _shown(row.known.get(name)) if bare else
                                (percent(error) if error is not None else "-") + mark,
                                _shown(row.wall_seconds), status), widths))
        lines += _reasons(study, rows, name)
        if bare:
            continue
        lines.append("* on the Pareto front of error and wall seconds")
        words = dict.fromkeys(
            (", ".join(str(v) for _, v in series if v), reference.words, reference.order)
            for series, reference in outcome.references.items() if reference)
        if len({entry[1:] for entry in words}) == 1:
            words = {("", *next(iter(words))[1:]): None}
        for series, text, order in words:
            known = f"; observed order {order:.2f}" if order and "order" not in text else ""
            lines.append(indented(f"against {text}{known}" + (f" ({series})" if series else "")))
        lines += [indented(f"warning: {warning}") for warning in outcome.warnings]
        lines += [indented(f"cheapest for {line}") for line in outcome.targets]
    return "\n".join(lines) + "\n"
