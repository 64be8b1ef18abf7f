"""Runs of mpm_par with what they cost: each made once and kept, so that a ladder goes on where it was
interrupted."""
import csv
import functools
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
RESULTS = PROJECT / "docs" / "accuracy"
sys.path += [str(PROJECT / "src" / "study"), str(PROJECT / "src" / "python"),
             str(PROJECT / "tests" / "convergence"), str(PROJECT / "tests" / "support")]
import scene_run  # noqa: E402
import store  # noqa: E402
from yaml_tree import read_value, read_yaml  # noqa: E402

UPDATED = "numerics.formulation=updated_lagrangian"
ROUNDS, SHORT = 3, 1.0  # runs of less than SHORT seconds are timed ROUNDS times


def method_settings(method):
    """For --set, of "SHAPE SCHEME [KEY=VALUE ...]", the keys those of numerics or particles_per_cell.
    Methods are those of the updated Lagrangian step, which not every shipped scene names."""
    shape, scheme, *others = method.split()
    words = [UPDATED, f"numerics.shape_function={shape}", f"numerics.scheme={scheme}"]
    return words + [("grid." if word.startswith("particles_per_cell") else "numerics.") + word
                    for word in others]


def _timed(command, log):
    """Exit status and seconds of the processor of one program."""
    with open(log, "w") as file:
        started = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT)
        _, status, used = os.wait4(started.pid, 0)
        started.returncode = os.waitstatus_to_exitcode(status)
    return started.returncode, used.ru_utime + used.ru_stime


@functools.cache
def start_up(mpm_par, scene):
    """Processor seconds that a run spends before its first step; the least of three."""
    with tempfile.TemporaryDirectory() as place:
        return min(_timed([str(mpm_par), "--check", "--quiet", str(scene)], Path(place) / "log.txt")[1]
                   for _ in range(3))


def place_of(scene, settings, folder):
    """Where the results of this run are kept: the name stands for the scene, the pictures that it or a
    setting names, and the settings."""
    trees = [read_yaml(scene), *(read_value(setting.partition("=")[2], "--set") for setting in settings)]
    text = "\n".join([store.scene_print(scene, trees), *settings])
    name = hashlib.sha256(text.encode()).hexdigest()[:16]
    return Path(folder) / f"{Path(scene).stem}_{name}"


@functools.cache
def identity(mpm_par):
    return hashlib.sha256(Path(mpm_par).read_bytes()).hexdigest()


def kept_cost(mpm_par, scene, settings, folder):
    """The costs of a run that this very program made; None if there is none."""
    file = place_of(scene, settings, folder) / "cost.json"
    found = json.loads(file.read_text()) if file.exists() else {}
    return found.get("cost") if found.get("program") == identity(mpm_par) else None


def run(mpm_par, scene, settings, folder):
    """Folder of results of one run, in `folder`, and its row of costs.

    seconds: of the steps alone, the least of wall time and of processor time (less that of starting
    the program), of all rounds: nearest to the wall time of one rank on a machine that nothing else
    uses.
    """
    place = place_of(scene, settings, folder)
    cost = kept_cost(mpm_par, scene, settings, folder)
    if cost is not None:
        return place, cost
    command = scene_run.command(mpm_par, scene, place, settings, "--overwrite")
    place.mkdir(parents=True, exist_ok=True)
    best = None
    for _ in range(ROUNDS):
        start = time.monotonic()
        status, processor = _timed(command, place / "log.txt")
        elapsed = time.monotonic() - start
        if status:
            break
        summary = json.loads((place / "summary.json").read_text())
        steps_alone = summary["loop_seconds"] - summary["output_seconds"]
        seconds = min(steps_alone, max(1e-3, processor - start_up(mpm_par, scene)))
        best = min(seconds, best or seconds)
        if elapsed > SHORT:
            break
    lines = (place / "log.txt").read_text().strip().splitlines() or [""]
    cost = {"status": "ok" if status == 0 else f"exit status {status}: {lines[-1][:160]}"}
    if status == 0:
        cost |= {"seconds": float(f"{best:.4g}"), "elapsed_seconds": float(f"{elapsed:.4g}"),
                 "particles": summary["particles"], "steps": summary["steps"],
                 "particle_steps": summary["particles"] * summary["steps"],
                 "energy_error": float(f"{summary['energy_error']:.4g}")}
    (place / "cost.json").write_text(json.dumps({"program": identity(mpm_par), "cost": cost}))
    return place, cost


def write_rows(name, rows, folder=RESULTS):
    """As NAME in `folder`; the columns are those of the first row and what others have beside."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    folder.mkdir(exist_ok=True)
    with open(folder / name, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def write_curves(name, strains, curves, folder=RESULTS):
    """As NAME in `folder`: strains, and for each key of `curves` a column of stresses in Pa."""
    with open(folder / name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["strain", *curves])
        for k, strain in enumerate(strains):
            writer.writerow([f"{strain:.4g}", *(f"{stress[k]:.5g}" for stress in curves.values())])


class CurveTable:
    """Rows of runs and their curves over `strains`; figures(folder, strains) finds both."""

    def __init__(self, strains, figures):
        self.strains, self.figures = strains, figures
        self.rows, self.curves = [], {}

    def add(self, head, run):
        """A row: `head`, what run() returned, and the figures of a run that ended. Shows it."""
        self.folder, cost = run
        row = head | cost
        if cost["status"] == "ok":
            found, curve = self.figures(self.folder, self.strains)
            row |= found
            name = " ".join(str(head[key]) for key in ("geometry", "method", "cells") if key in head)
            self.curves[name] = curve
        self.rows.append(row)
        print(" ".join(f"{key}={value}" for key, value in row.items()), flush=True)

    def write(self, name, folder=RESULTS):
        write_rows(f"{name}.csv", self.rows, folder)
        write_curves(f"{name}_curves.csv", self.strains, self.curves, folder)
        write_machine(self.folder, folder)

    def write_beside(self, name, folder=RESULTS):
        """Into the files that `write` made: runs that are there give way to the same ones of now. The
        machine stays the one of those."""
        head = ("geometry", "method", "cells")
        measured = {tuple(str(row.get(key)) for key in head) for row in self.rows}
        with open(folder / f"{name}.csv", newline="") as file:
            kept = [row for row in csv.DictReader(file)
                    if tuple(row.get(key) for key in head) not in measured]
        lines = read_rows(f"{name}_curves.csv", folder)
        curves = {key: [line[key] for line in lines] for key in lines[0] if key != "strain"}
        write_rows(f"{name}.csv", kept + self.rows, folder)
        write_curves(f"{name}_curves.csv", self.strains, curves | self.curves, folder)


def write_machine(run, folder=RESULTS):
    """As machine.json in `folder`: the machine that the seconds belong to and the version that ran, from one run's summary."""
    from machine import machine
    version = json.loads((run / "summary.json").read_text())["provenance"]
    found = machine() | {key: version[key] for key in ("mpm_par", "git", "compiler", "build")}
    (folder / "machine.json").write_text(json.dumps(found, indent=2) + "\n")


def number(text):
    try:
        return float(text)
    except ValueError:
        return None if text == "" else text


def read_rows(name, folder=RESULTS):
    """Rows of NAME in `folder`: numbers as numbers, what is missing as None."""
    with open(folder / name, newline="") as file:
        return [{key: number(value) for key, value in row.items()} for row in csv.DictReader(file)]
