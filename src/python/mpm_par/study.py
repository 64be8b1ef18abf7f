"""What mpm_study leaves behind: studies, and error bars of one scene."""
import csv
import dataclasses
import json
import pathlib

import numpy

from mpm_par.problems import ResultsError


@dataclasses.dataclass(frozen=True)
class Study:
    """`columns`: one array a column of study.csv, a value a run, float64 with NaN where there is
    none, or texts; `units` by column ("SI": that of the figure); `record`: study.json as a dict."""
    columns: dict
    units: dict
    record: dict

    @property
    def title(self):
        return self.record["title"]


@dataclasses.dataclass(frozen=True)
class Bar:
    """A figure of the curve, SI units: the truth is expected in value +- error. `value` and `error`
    are None where there is none, `remark` says why; `basis` is how the error was estimated."""
    value: float
    error: float
    basis: str
    remark: str


def _record(folder, name, made_by):
    folder = pathlib.Path(folder)
    path = folder / name
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError:
        raise ResultsError(f"{folder}: holds no {name}. Name the folder that {made_by} has "
                           "written, and let it end first.") from None
    except ValueError as error:
        raise ResultsError(f"{path}: is broken ({error}). Start {made_by} again: it goes on from "
                           "what is done.") from None


def _column(texts):
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts)


def study_folders(folder):
    """Of the studies that mpm_study has written into a folder: itself, or one for each of several
    studies in it, by name; empty if there is none."""
    folder = pathlib.Path(folder)
    if (folder / "study.json").exists():
        return [folder]
    return sorted(path.parent for path in folder.glob("*/study.json"))


def read_study(folder):
    """The Study in a folder that mpm_study has written. Raises ResultsError if it is missing or
    half-written."""
    record = _record(folder, "study.json", "mpm_study")
    path = pathlib.Path(folder) / "study.csv"
    try:
        with open(path, newline="", encoding="utf-8") as file:
            titles, *rows = csv.reader(file)
    except (OSError, ValueError):
        raise ResultsError(f"{path}: is missing or empty. Start mpm_study again: it goes on from "
                           "what is done.") from None
    names = [title.partition(" [")[0] for title in titles]
    units = [title.partition(" [")[2].rstrip("]") or "1" for title in titles]
    columns = {name: _column([row[k] for row in rows]) for k, name in enumerate(names)}
    return Study(columns, dict(zip(names, units)), record)


def read_error_bar(folder):
    """Bars by figure (modulus, buckling_stress, ...) in a folder that mpm_study --error-bar has
    written. Raises ResultsError if it is missing or half-written."""
    figures = _record(folder, "error_bar.json", "mpm_study --error-bar")["figures"]
    return {name: Bar(figure["value"], figure["error"], figure["basis"], figure["remark"])
            for name, figure in figures.items()}
