"""Columns over time: history.csv and every file like it."""
import csv
import dataclasses
import pathlib

import numpy

from mpm_par.problems import ResultsError


@dataclasses.dataclass(frozen=True)
class History:
    """`values`: arrays of shape (lines,), float64, by column; `units`: their units, by column ("1"
    of a plain number). SI units; strain and stress are positive in compression."""
    values: dict
    units: dict
    place: str = "history.csv"

    def __getitem__(self, name):
        """A column, shape (lines,). Raises ResultsError where there is none of that name."""
        if name not in self.values:
            raise ResultsError(f"{self.place}: has no column {name}. There are: "
                               f"{', '.join(self.values)}.")
        return self.values[name]

    def __contains__(self, name):
        return name in self.values

    def __len__(self):
        return len(next(iter(self.values.values())))

    def strain_of(self, name):
        """Strains [1] of a column's values, shape (lines,). A stress is the mean since the last
        line and counts at the middle of it."""
        own = self["strain"]
        if name.startswith("stress"):
            return numpy.append(own[0], 0.5 * (own[1:] + own[:-1]))
        return own

    def at(self, name, strain):
        """A column at strains [1], of any shape, by straight lines between those of the history;
        NaN beyond them."""
        begin, end = self["strain"][[0, -1]]
        strain = numpy.asarray(strain, dtype=float)
        found = numpy.interp(strain, self.strain_of(name), self[name])
        return numpy.where((strain >= begin) & (strain <= end), found, numpy.nan)


def _numbers(row, width, place):
    try:
        if len(row) != width:
            raise ValueError(f"{len(row)} values under {width} titles")
        return [float(cell) for cell in row]
    except ValueError as error:
        raise ResultsError(f"{place}: is no line of a history ({error}). "
                           "Run again, or cut the file before this line.") from None


def read_history(path):
    """The History in a CSV file whose titles read `stress [Pa]`, such as history.csv.

    Raises ResultsError where there is no such file, where it is no such table, or where it has no
    line of values yet. A last line that was cut off by the end of the run is left out."""
    path = pathlib.Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}. Name the folder of results of a run, or "
                           "wait until its first line is written.") from None
    except UnicodeDecodeError:
        raise ResultsError(f"{path}: is no text. Name the history.csv of a run.") from None
    lines = text[:text.rfind("\n") + 1].splitlines()  # whole ones
    rows = list(csv.reader(lines))
    if not rows or not all(rows[0]):
        raise ResultsError(f"{path}: has no titles. Name the history.csv of a run.")
    names = [title.partition(" [")[0].strip() for title in rows[0]]
    units = [title.partition("[")[2].partition("]")[0] or "1" for title in rows[0]]
    values = [_numbers(row, len(names), f"{path}:{k}") for k, row in enumerate(rows[1:], 2)]
    if not values:
        raise ResultsError(f"{path}: has no line of values yet. Wait until the run has "
                           "written one, or run again.")
    table = numpy.array(values)
    return History(dict(zip(names, table.T)), dict(zip(names, units)), str(path))
