"""How ranks would share specimens that need no run: balance, shared nodes and messages."""
import re
import subprocess

from measuring import environment, figure
from scenes import UPDATED, WOOD

RANKS = (8, 64, 512)
COLUMNS = {"imbalance": "1", "shared nodes": "1", "messages": "1", "bytes": "B"}
LINE = re.compile(r"^ *(\d+)  (\S+) +(.+?) +(\d\S*) +(\d+) +(\d+) +(\d+)$", re.MULTILINE)


def rows_of(specimen, text):
    """The printed table as figures study/SPECIMEN/RANKS/MAP/STATE/COLUMN."""
    return [figure(f"study/{specimen}/{ranks}/{kind}/{state}/{column}", [float(value)], unit,
                   "count")
            for ranks, kind, state, *values in LINE.findall(text)
            for (column, unit), value in zip(COLUMNS.items(), values)]


def measure_studies(build, _repeat, quick):
    ranks = RANKS[:1] if quick else RANKS
    commands = {"ponderosa tangential": [build.mpm_par, "--check", "--ranks",
                                         ",".join(map(str, ranks)),
                                         WOOD / "ponderosa_tangential.yaml", "--set", UPDATED],
                "tubes in space": [build.program("partition_study"), *(["32"] * quick)]}
    rows = []
    for specimen, command in commands.items():
        text = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True,
                              env=environment()).stdout
        rows += rows_of(specimen, text)
    return rows


def study_table(rows):
    found = {}
    for row in rows:
        if row["name"].startswith("study/"):
            _, *key, column = row["name"].split("/")
            found.setdefault(tuple(key), {})[column] = row["value"]
    if not found:
        return ""
    lines = ["| specimen | ranks | map | | " + " | ".join(COLUMNS) + " |",
             "|---|---|---|---|" + "---|" * len(COLUMNS)]
    for key, values in found.items():
        cells = [f"{values['imbalance']:.3f}",
                 *(str(int(values[column])) for column in list(COLUMNS)[1:])]
        lines.append("| " + " | ".join([*key, *cells]) + " |")
    return "\n".join(lines)
