"""history.csv of a run."""
import csv
from pathlib import Path

import numpy


class History:
    """Columns by their names; units are left away."""

    def __init__(self, folder):
        with open(Path(folder) / "history.csv", newline="") as file:
            header, *lines = csv.reader(file)
        self.names = [cell.split(" [")[0] for cell in header]
        self.values = numpy.array(lines, dtype=float)

    def __getitem__(self, name):
        return self.values[:, self.names.index(name)]
