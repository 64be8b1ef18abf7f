"""Scalars of a run, from the files that it leaves: a module a family. A measure is a function of the
folder of results, the level and options of table.json. The first line of its docstring says on
docs/verification.md what it is."""
import csv
import importlib
import math
from pathlib import Path

import numpy


class History:
    """Columns of history.csv by their names; units are left away."""

    def __init__(self, folder):
        with open(Path(folder) / "history.csv", newline="") as file:
            header, *lines = csv.reader(file)
        self.names = [cell.split(" [")[0] for cell in header]
        self.values = numpy.array(lines, dtype=float)

    def __getitem__(self, name):
        return self.values[:, self.names.index(name)]


def named(measure):
    """The function that "family.name" means."""
    family, name = measure.split(".")
    return getattr(importlib.import_module(f"measures.{family}"), name)


def number(formula, **values):
    """Of a formula in Python's words, such as 2/sqrt(3)*n."""
    return eval(formula, {"__builtins__": {}, "round": round} | vars(math) | values)


def error(case, level, folder):
    """The measure of a run over its exact value - 1; where that is 0, the measure itself."""
    value = named(case["measure"])(folder, level, **case.get("options", {}))
    exact = number(case["exact"], n=level)
    return float(value / exact - 1 if exact else value)
