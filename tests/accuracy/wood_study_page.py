"""Writes docs/wood_study.md from the files in docs/wood_study.

    wood_study_page.py RESULTS [RESULTS ...]
                                  first takes tables and pictures out of folders of results of
                                  mpm_study inputs/studies/wood_*.yaml, which mpm_report has drawn;
                                  a later folder takes the place of an earlier one, study by study
    wood_study_page.py --again RESULTS
                                  first compares with what was taken: the same studies, or some of
                                  them, made again on another machine, or by a newer program
    wood_study_page.py            writes the page anew
    wood_study_page.py --check    only says whether the page is the one that would be written
"""
import collections
import csv
import functools
import io
import itertools
import json
import math
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import typing
from pathlib import Path

import numpy

import runs  # noqa: F401  (which makes the project's modules known)
import curve_landmarks
import load_paths
from words import filled_in, finished
from written_page import table, write_or_check

from mpm_par.report import facts, structure, studies, study_facts, theory
from mpm_par.study import read_study, study_folders

PAGE = runs.PROJECT / "docs" / "wood_study.md"
FOLDER = runs.PROJECT / "docs" / "wood_study"
TEXT = Path(__file__).with_name("wood_study_page.md")
KEPT = ("study.csv", "study.json")
MPM_CURVE = runs.PROJECT / "build" / "mpm_curve"
AGAIN, NEWER = FOLDER / "again.json", FOLDER / "newer.json"  # by the same program, and by a newer one
FORMULATIONS = runs.PROJECT / "docs" / "formulations" / "ladders.csv"
IN_FORMULATIONS = "loblolly, tangential", "poplar, tangential", "poplar, radial", "loblolly, radial"
RISING_LINES = ("4", "8"), ("8", "16")  # times the plateau's last stress, beside the 2 and 4 of runs
PROPERTIES = "modulus", "buckling_stress", "buckling_strain", "densification_stress", "densification_strain"
SAMPLED_STRAINS = 0.05, 0.10, 0.20, 0.26, 0.30, 0.35, 0.40, 0.50
AGREEING = 0.2  # of the paper's figure
YIELDING = 0.10, 0.20, 0.30, 0.40  # strains
CRUSHED = 0.10  # from this strain on no wave of the start is left
EARLY = 0.05  # strain
DENSE_STRESS = 1e9  # Pa, about twice the cell wall's usual yield stress
PLASTIC_WORK, AXIAL_STRESS = "plastic_work", "axial_stress"
POPLAR = 0.05, 0.15, 0.30, 0.45
OTHER_WALLS = "100 MPa", "2500 MPa", "elastic"
TABLE_1 = {  # wood and direction: study and run
    "loblolly, radial": ("wood_yield", "500 MPa, radial"),
    **{f"loblolly, radial, {walls}": ("wood_yield", f"{walls}, radial") for walls in OTHER_WALLS},
    "loblolly, tangential": ("wood_yield", "500 MPa, tangential"),
    **{f"loblolly, tangential, {walls}": ("wood_yield", f"{walls}, tangential") for walls in OTHER_WALLS},
    "poplar, radial": ("wood_poplar", "radial"), "poplar, tangential": ("wood_poplar", "tangential"),
    "ponderosa, tangential": ("wood_ponderosa", "tangential")}
# Sizes of cells: about the paper's, and finer ones. A study names a run by its wood or as TABLE_1 does.
LADDERS = "wood_error_bars", "wood_yield_error_bars"
FINER_LADDERS = "wood_fine_cells", "wood_yield_fine_cells", "wood_fine_densification", "wood_fine_ponderosa"
# Of drawn pieces by the paper's method.
PIECES = "wood_paper_method_specimens", "wood_paper_method_pictures"
FRAMES = {  # strips: name of the picture, run, colour, strains
    "wood_yield": (("radial", "500 MPa, radial", PLASTIC_WORK, (0.048, 0.168, 0.288, 0.457, 0.595)),
                   ("tangential", "500 MPa, tangential", PLASTIC_WORK, (0.146, 0.297, 0.446, 0.595))),
    "wood_poplar": tuple((way, way, colour, POPLAR) for colour in (PLASTIC_WORK, AXIAL_STRESS)
                         for way in ("radial", "tangential")),
    "wood_ponderosa": (("tangential", "tangential", PLASTIC_WORK, (0, 0.05, 0.186, 0.30, 0.45)),),
    "wood_load_paths": tuple((way, way, AXIAL_STRESS, (0.01,)) for way in ("radial", "tangential")),
    "own_wood": tuple((way, f"as it is, {way}, spacing 5.35 um", PLASTIC_WORK, POPLAR)
                      for way in ("radial", "tangential"))}


def onset_of_densification(run, line):
    with tempfile.TemporaryDirectory() as place:
        found = Path(place) / "curve.json"
        subprocess.run([MPM_CURVE, run.folder / "history.csv", "--densification-line", *line, "--json", found],
                       check=True, stdout=subprocess.DEVNULL)
        return json.loads(found.read_text())["compression"]["densification"]


def in_words(point):
    return f"{point['stress'] / 1e6:.4g} at {100 * point['strain']:.3g}" if point else "-"


def rising_line_rows(study, runs_of_it):
    """(titles, rows): what the onset of densification owes to the line that is drawn through the rise,
    beside known ones."""
    rows = []
    for entry, run in runs_of_it:
        known = {name: entry.get(f"known_densification_{name}") for name in ("stress", "strain")}
        if all(known.values()):
            onsets = [run.properties.get("densification"),
                      *(onset_of_densification(run, line) for line in RISING_LINES), known]
            rows.append([study_facts.name_of(study, entry), *map(in_words, onsets)])
    lines = [f"{a} and {b} times" for a, b in (("2", "4"), *RISING_LINES)]
    return ["run, MPa at % strain", *lines, "known"], rows


def landmark_rows(study, runs_of_it):
    """(titles, rows): where curves pass, the overshoot before a plateau, the second hump that yielding
    latewood leaves on one, and how much of the work done so far is plastic, or kinetic energy."""
    rows = []
    for entry, run in runs_of_it:
        plastic, done = (run.history.at(name, YIELDING) for name in ("plastic_work", "external_work"))
        crushed = run.history["strain"] >= CRUSHED
        moving = run.history["kinetic_energy"][crushed] / run.history["external_work"][crushed]
        first = run.history["stress"][run.history.strain_of("stress") <= EARLY]
        stresses = run.history.at("stress", SAMPLED_STRAINS)
        dense, hump = curve_landmarks.strain_at(run.history, DENSE_STRESS), curve_landmarks.hump(run.history)
        sampled = ["-" if numpy.isnan(stress) else study_facts.four_digits(stress / 1e6) for stress in stresses]
        rows.append([study_facts.name_of(study, entry), study_facts.four_digits(first.max() / 1e6), *sampled,
                     "-" if dense is None else f"{100 * dense:.3g}",
                     *(("-", "-") if hump is None else (f"{100 * hump[0]:.2g}", f"{100 * hump[1]:.0f}")),
                     *("-" if numpy.isnan(share) else f"{share:.0f}" for share in 100 * plastic / done),
                     f"{100 * moving.max():.2g}" if crushed.any() else "-"])
    return ["run", f"highest up to {100 * EARLY:.0f} % (MPa)",
            *(f"at {100 * strain:.0f} % (MPa)" for strain in SAMPLED_STRAINS),
            f"{DENSE_STRESS / 1e9:.0f} GPa at (%)", "hump: slope lost (%)", "hump at (%)",
            *(f"plastic at {100 * strain:.0f} % (%)" for strain in YIELDING),
            f"kinetic energy from {100 * CRUSHED:.0f} % on, at most (%)"], rows


def border_rows(study, runs_of_it):
    """(titles, rows): where the border of two layers across x stands, of the present width, and how much of
    the plastic work in the left one is done in its third beside the border."""
    rows = []
    for entry, run in runs_of_it:
        layers = theory.layers(run, "x")
        if len(layers) != 2 or not run.snapshots or not {"id", "plastic_work"} <= set(run.snapshots[0].units):
            continue
        width = run.summary["size"][0]
        border = max(float(layer["x"][0]) for layer in layers) * width
        places, works = zip(*map(by_id, run.snapshots))
        near, third = abs(places[0] - border) < 0.01 * width, (places[0] > border * 2 / 3) & (places[0] < border)
        left, lists = places[0] < border, ([], [])
        for snapshot, x, work in zip(run.snapshots, places, works):
            now = width * (1 - snapshot.strain) if run.axis == 0 else width
            at = f"at {100 * snapshot.strain:.3g} %"
            lists[0].append(f"{100 * numpy.median(x[near]) / now:.3g} {at}")
            if work[left].sum() > 0:
                lists[1].append(f"{100 * work[third].sum() / work[left].sum():.3g} {at}")
        name = study_facts.name_of(study, entry)
        rows += [[name, what, ", ".join(found)] for what, found in zip(("border", "work near it"), lists)]
    return ["run", "what", "percent, at strain"], rows


def by_id(snapshot):
    """x and plastic work of all particles, in the same order at all times."""
    return load_paths.in_order(snapshot, "position")[:, 0], load_paths.in_order(snapshot, "plastic_work")


# Of runs, which are not kept.
TABLES = {"foam": theory.honeycomb_rows, "layers": theory.layer_rows, "windows": studies.window_rows,
          "reading": studies.reading_rows, "rising_lines": rising_line_rows, "landmarks": landmark_rows,
          "border": border_rows, "load_paths": load_paths.load_path_rows}


def take(results):
    """Tables and pictures of finished studies."""
    for folder in study_folders(results):
        study = read_study(folder)
        runs_of_it = studies.opened(study, folder)
        found = {name: rows_of(study, runs_of_it) for name, rows_of in TABLES.items()}
        strips = {}
        for name, label, colour, strains in FRAMES.get(folder.name, ()):
            run = one_of([run for entry, run in runs_of_it if study_facts.name_of(study, entry) == label],
                         f"{folder}: {label}")
            strips[f"{folder.name}_{name}_{colour}.png"] = frames(run, colour, strains)
        place = FOLDER / folder.name
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        for name in KEPT:
            shutil.copyfile(folder / name, place / name)
        for name, (titles, rows) in found.items():
            if rows:
                with open(place / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
                    csv.writer(file, lineterminator="\n").writerows([titles, *rows])
        for picture in pictures_of(folder.name):
            picture.unlink()
        for picture in (Path(results) / "report").glob(f"{folder.name}_curves*.png"):
            if picture.name in TEXT.read_text():
                shutil.copyfile(picture, FOLDER / picture.name)
        for name, pictures in strips.items():
            strip(pictures, FOLDER / name)


def pictures_of(name):
    """Those kept of this study, not of others whose names begin alike."""
    longer = tuple(f"{folder.name}_" for folder in study_folders(FOLDER) if folder.name.startswith(f"{name}_"))
    return [picture for picture in FOLDER.glob(f"{name}_*.png") if not picture.name.startswith(longer)]


def frames(run, colour, strains):
    """PNG files, in the same colours, of the snapshots at these strains."""
    chosen = structure.choose(run, [("strain", strain) for strain in strains])
    if [round(snapshot.strain, 3) for snapshot in chosen] != list(strains):
        sys.exit(f"{run.folder}: has no snapshots at strains of {strains}")
    colouring = next(one for one in structure.colourings(run, chosen[-1])[0] if one.stem == colour)
    return [frame.files["png"] for frame in structure.draw_frames(run, structure.Stage(run), chosen, colouring)]


def strip(pictures, place):
    """The pictures side by side, as wide as a page at most."""
    from PIL import Image
    images = [Image.open(io.BytesIO(picture)).convert("RGB") for picture in pictures]
    width = min(1600 // len(images), 800)
    images = [image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
              for image in images]
    whole = Image.new("RGB", (width * len(images), max(image.height for image in images)), "white")
    for k, image in enumerate(images):
        whole.paste(image, (k * width, 0))
    whole.quantize(128).save(place, optimize=True)


def kept_study(name):
    return read_study(FOLDER / name)


def ended_by_settings(study):
    """The runs that ended, by what is set in them; how many ranks they had does not count, nor what others set."""
    return {tuple((key, value) for key, value in run["settings"].items() if key != "ranks" and value is not None): run
            for run in study.record["runs"] if run["state"] == study_facts.OK}


def compare(results):
    """Writes what the runs of another folder have where the kept ones have a figure, too, in place of what is
    written of the same studies."""
    found, titles, places = [], set(), set()
    folders = study_folders(results)
    if not folders:
        sys.exit(f"{results}: holds no study. Name the folder that mpm_study has written.")
    for folder in folders:
        study, repeated = kept_study(folder.name), read_study(folder)
        titles.add(study.title)
        places.add(AGAIN if program_of(repeated.record) == program_of(study.record) else NEWER)
        first = ended_by_settings(study)
        for settings, run in ended_by_settings(repeated).items():
            if settings not in first:
                sys.exit(f"{folder}: {study_facts.name_of(repeated, run)} is not among the runs of "
                         f"{FOLDER / folder.name}: another variant (--quick)?")
            figures, bars = {}, {}
            for name in (measure["name"] for measure in study_facts.numbers(study)):
                if (pair := [first[settings][f"value_{name}"], run[f"value_{name}"]]) != [None, None]:
                    figures[name] = pair
                if run.get(f"bar_{name}") is not None:
                    bars[name] = run[f"bar_{name}"]
            found.append({"study": study.title, "run": study_facts.name_of(repeated, run),
                          "program": program_of(repeated.record), "processor": processor_of(repeated.record),
                          "ranks": run["settings"].get("ranks", "1"), "figures": figures, "bars": bars})
    if len(places) > 1:
        sys.exit(f"{results}: some studies are by the program that the page is by and some by another one")
    place = places.pop()
    kept = runs_of(place) if place.exists() else []
    place.write_text(json.dumps([run for run in kept if run["study"] not in titles] + found, indent=1) + "\n")


def runs_of(place):
    return json.loads(place.read_text())


def newer_runs():
    return {(run["study"], run["run"]): run for run in runs_of(NEWER)}


def program_of(record):
    return record["mpm_par"]["git"][:7]


def processor_of(record):
    return record["machine"]["processor"].replace("(R)", "").removesuffix(" Processor")


def listed(names):
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last


def made_again(place):
    """What was made again where, and how far each figure moved over all of these runs: what may stand in braces,
    by names that begin with that of the file."""
    found = runs_of(place)
    named = ", ".join(f"*{title}*" for title in dict.fromkeys(run["study"] for run in found))
    programs, ranks, processors = (listed(dict.fromkeys(run[what] for run in found))
                                   for what in ("program", "ranks", "processor"))
    article = "an" if processors[0] in "AEIO" else "a"
    opening = (f"Of {named} {len(found)} runs were made again by {programs}, on {ranks} rank{'s' * (ranks != '1')} of "
               f"{article} {processors}.")
    moved, alone = {}, collections.Counter()
    for run in found:
        for name, pair in run["figures"].items():
            if None in pair:
                alone[name] += 1
                continue
            way = pair[1] / pair[0] - 1
            moved.setdefault(name, []).append((abs(way), way, f"{run['study']}: {run['run']}"))
    lines = []
    for name, ways in moved.items():
        sizes = [size for size, *_ in ways]
        _, most, where = max(ways)
        lines.append([name.replace("_", " "), str(len(sizes)), f"{round(100 * statistics.median(sizes), 6):.2g} %",
                      f"{sum(size > 0.01 for size in sizes)}", f"{100 * most:+.2g} %", where, str(alone[name])])
    heads = ["figure", "runs", "half moved by less than", "by more than 1 %", "most", "which", "found in one alone"]
    return {f"{place.stem}_opening": opening, f"{place.stem}_runs": str(len(found)),
            place.stem: table(heads, lines)}


def changed_verdicts():
    """Of Table 1's properties, by the newer program, its numerical errors and finer cells where they were made
    again, too."""
    made = newer_runs()
    lines, count = [], 0
    for one, later in zip(table_1(), table_1(newer_study), strict=True):
        name, label = TABLE_1[one.wood]
        if one.measure["name"] not in made.get((kept_study(name).title, label), {}).get("figures", {}):
            continue
        count += 1
        if later.verdict() != one.verdict():
            lines.append([one.wood, study_facts.title(one.measure), one.shown(one.best()[0]),
                          one.shown(later.best()[0]), one.shown(one.known), one.verdict(), later.verdict()])
    heads = ["wood", "property", "on this page", "by the newer program", "paper", "verdict", "by the newer program"]
    return {"newer_properties": str(count), "changed": str(len(lines)),
            "changed_verdicts": table(heads, lines) if lines else ""}


def moduli_of_ladders():
    with open(FORMULATIONS, newline="", encoding="utf-8") as file:
        found = {(row["geometry"], row["method"], row["cells"]): row["modulus"] for row in csv.DictReader(file)}
    methods = [(method, cells) for method in ("updated", "total") for cells in ("75", "150", "300")]
    known = {run["label"]: run["known_modulus"] for run in kept_study("wood_rays").record["runs"]}
    lines = []
    for wood in IN_FORMULATIONS:
        moduli = [found[wood.replace(", ", "_"), *of] for of in methods]
        lines.append([wood, *(f"{float(modulus) / 1e9:.3g}" for modulus in [*moduli, known[wood]])])
    return table(["modulus, GPa", *(f"{method}, {cells} cells" for method, cells in methods), "paper"], lines)


class Property(typing.NamedTuple):
    """One of Table 1, in SI units; None for what is not known."""
    wood: str
    measure: dict
    found: float | None
    error: float | None
    finer: float | None  # what finer cells than the paper's make of it
    finer_error: float | None
    scatter: float | None
    known: float

    def best(self):
        """What the drawing has as far as is known, and the numerical error of it."""
        return (self.found, self.error) if self.finer is None else (self.finer, self.finer_error)

    def verdict(self):
        best, error = self.best()
        if best is None:
            return "not found"
        away = abs(best - self.known)
        if away <= AGREEING * self.known:
            return "agrees"
        return "undecided" if away < max(error or 0, self.scatter or 0) else "differs"

    def shown(self, value):
        return "-" if value is None else study_facts.shown(self.measure, value)

    def shown_error(self, value):
        return "-" if value is None else study_facts.two_digits(self.measure, value)


def ladder_of(ladders, labels, run, measure):
    """(figure with about as many particles as the run has, finest figure, numerical error) of the sizes of cells
    of one of these labels in the study that has them; nothing where one has no such figure."""
    value, bar = (f"{what}_{measure['name']}" for what in ("value", "bar"))
    found = sorted((one for study in ladders for one in study.record["runs"]
                    if one["label"] in labels and value in one), key=lambda one: one["particles"])
    if not found:
        return None
    as_fine = min(found, key=lambda one: abs(math.log(one["particles"] / run["particles"])))
    if None in (as_fine[value], found[-1][value]):
        return None
    return as_fine[value], found[-1][value], found[-1].get(bar)


def carried(value, ladder):
    """What finer cells make of a value that was found otherwise than a ladder's, as at another speed, and the
    numerical error of that: the ladder's change counts, not its figures."""
    if value is None or ladder is None:
        return None, None
    as_fine, finest, error = ladder
    return value * finest / as_fine, error and value * error / as_fine


def newer_study(name):
    """The kept one, with what the newer program has found where it has made runs again."""
    study, made = kept_study(name), newer_runs()
    for run in study.record["runs"]:
        again = made.get((study.title, study_facts.name_of(study, run)), {})
        run |= {f"value_{figure}": later for figure, (_, later) in again.get("figures", {}).items()}
        run |= {f"bar_{figure}": bar for figure, bar in again.get("bars", {}).items()}
    return study


@functools.cache
def table_1(study_of=kept_study):
    """The properties, in the order of TABLE_1."""
    found = []
    ladders, finer_ladders = ([study_of(name) for name in names] for names in (LADDERS, FINER_LADDERS))
    drawn = study_of("wood_specimens")
    for wood, (name, label) in TABLE_1.items():
        study = study_of(name)
        run = one_of([run for run in study.record["runs"] if study_facts.name_of(study, run) == label], wood)
        pieces = [piece for piece in drawn.record["runs"] if wood == f"loblolly, {piece['label'].split(', ')[0]}"]
        for measure in study_facts.numbers(study):
            value, known = (f"{what}_{measure['name']}" for what in ("value", "known"))
            if run.get(known):
                scatter = [piece[value] for piece in pieces]
                ladder, finer = (ladder_of(of, (wood, label), run, measure) for of in (ladders, finer_ladders))
                found.append(Property(
                    wood, measure, run[value], ladder and ladder[2], *carried(run[value], finer),
                    statistics.stdev(scatter) if scatter and None not in scatter else None, run[known]))
    return found


def how_well_known():
    """Table 1's properties beside what is known of their errors."""
    lines = []
    for one in table_1():
        lines.append([one.wood, study_facts.title(one.measure), one.shown(one.found), one.shown_error(one.error),
                      one.shown(one.finer), one.shown_error(one.finer_error), one.shown_error(one.scatter),
                      one.shown(one.known), study_facts.difference(one.best()[0], one.known) or "-", one.verdict()])
    return table(["wood", "property", "found", "numerical error", "on finer cells", "numerical error of that",
                  "from piece to piece", "paper", "difference", "verdict"], lines)


def pieces_beside_paper():
    """Mean and standard deviation of Table 1's properties over drawn pieces by the paper's method, the paper's,
    and how far the mean is from it in percent and in such deviations."""
    studies_of_pieces = [kept_study(name) for name in PIECES]
    paper = {(one.wood, one.measure["name"]): one.known for one in table_1()}
    measures = [measure for measure in study_facts.numbers(studies_of_pieces[0]) if measure["name"] in PROPERTIES]
    lines = []
    for pieces in itertools.chain.from_iterable(map(study_facts.drawn_specimens, studies_of_pieces)):
        label = pieces[0]["label"].rpartition(", ")[0]  # without the seed
        wood = max((wood for wood in TABLE_1 if label.startswith(wood)), key=len)
        cells = []
        for measure in measures:
            known = paper.get((wood, measure["name"]))
            values = [run[f"value_{measure['name']}"] for run in pieces]
            values = [value for value in values if value is not None]
            if known is None or len(values) < 2:
                cells.append("-")
                continue
            mean, deviation = statistics.mean(values), statistics.stdev(values)
            fewer = f", of {len(values)}" if len(values) < len(pieces) else ""
            cells.append(f"{study_facts.shown(measure, mean)} ± "
                         f"{study_facts.two_digits(measure, deviation)}{fewer} / "
                         f"{study_facts.shown(measure, known)} ({study_facts.difference(mean, known)}, "
                         f"{abs(known - mean) / deviation:.1f})")
        lines.append([label, *cells])
    return table(["wood", *map(study_facts.title, measures)], lines)


def last_levels(name):
    """How far the finest runs of a ladder of all woods are from the next ones."""
    study = kept_study(name)
    measures = study_facts.numbers(study)
    lines = []
    for label in dict.fromkeys(run["label"] for run in study.record["runs"]):
        *_, before, finest = sorted((run for run in study.record["runs"] if run["label"] == label),
                                    key=lambda run: run["particles"])
        lines.append([label, *(study_facts.difference(finest[f"value_{m['name']}"], before[f"value_{m['name']}"])
                               or "-" for m in measures)])
    return table(["wood", *(m["name"].replace("_", " ") for m in measures)], lines)


def took():
    heads = ["study", "runs", "variant", "ranks", "run time", "processor", "program"]
    lines = []
    found = [read_study(folder) for folder in study_folders(FOLDER)]
    for study in found:
        count, elapsed, core_seconds = study_facts.cost([study])
        lines.append([study.title, str(count), "quick" if study.record["quick"] else "full",
                      f"{core_seconds / elapsed:g}", facts.clock(elapsed), processor_of(study.record),
                      program_of(study.record)])
    total = study_facts.cost(found)
    lines.append(["all", str(total[0]), "", "", facts.clock(total[1]), "", ""])
    return table(heads, lines)


def values():
    """What may stand in braces in wood_study_page.md."""
    found = {"took": took(), "moduli_of_ladders": moduli_of_ladders(), "how_well_known": how_well_known(),
             "pieces_beside_paper": pieces_beside_paper(),
             **{f"{name}_last_levels": last_levels(name) for name in (*LADDERS, *FINER_LADDERS)}}
    found |= made_again(AGAIN) | made_again(NEWER) | changed_verdicts()
    for folder in study_folders(FOLDER):
        study = read_study(folder)
        for name in TABLES:
            if (folder / f"{name}.csv").exists():
                with open(folder / f"{name}.csv", newline="", encoding="utf-8") as file:
                    titles, *rows = csv.reader(file)
                found[f"{folder.name}_{name}"] = table(titles, rows)
        found[f"{folder.name}_figures"] = table(*study_facts.figures(study))
        known = study_facts.beside_known(study)
        if known[1]:
            found[f"{folder.name}_known"] = table(*known)
        scatter = study_facts.scatter(study)
        if scatter[1]:
            found[f"{folder.name}_scatter"] = table(*scatter)
        shifts = study_facts.shifts(study)
        if shifts[1]:
            found[f"{folder.name}_shifts"] = table(*shifts)
        limits = study_facts.limits(study)
        if limits:
            found[f"{folder.name}_limits"] = "\n".join(f"- {line}" for line in limits)
    return found


class Figures:
    """What a sentence quotes: {STUDY|RUN|FIGURE} is a figure of study.json in the unit of the tables,
    {STUDY.TABLE|RUN|COLUMN} a cell of a kept table, {STUDY.scatter|RUNS|FIGURE} mean and deviation of drawn
    specimens, {STUDY.spread|RUNS|FIGURE} the latter in percent of the former, {verdict|WOOD|FIGURE} the one on
    a property of Table 1, {finer|WOOD|FIGURE} what finer cells make of it. {A beside B} is their difference in
    percent of B, which may be `known`; {A over B} is their ratio, {A less B} their difference. Behind a colon
    stands how many digits to write."""

    QUOTED = re.compile(r"\{([a-z_]+(?:\.[a-z_]+)?\|[^{}]+?)(?::(\d))?\}")
    WORDS = " beside ", " over ", " less "

    def __init__(self):
        self.studies = {folder.name: read_study(folder) for folder in study_folders(FOLDER)}

    def quoted(self, text):
        return self.QUOTED.sub(lambda found: self.words(found[1], found[2]), text)

    def words(self, asked, digits):
        word = next((word for word in self.WORDS if word in asked), None)
        if not word:
            text = self.figure(asked)
            return with_digits(number(text, asked), int(digits)) if digits else text
        first, second = asked.split(word)
        a, b = (number(self.figure(one), asked) for one in (
            first, f"{first}|known" if second == "known" else second))
        if word == " beside ":
            return f"{100 * (a / b - 1):+.{int(abs(a / b - 1) < 0.0095)}f} %"
        return with_digits(a / b if word == " over " else a - b, int(digits or 2))

    def figure(self, asked):
        study, name, figure, *known = asked.split("|")
        if study in ("verdict", "finer"):
            found = one_of([one for one in table_1() if (one.wood, one.measure["name"]) == (name, figure)], asked)
            return found.verdict() if study == "verdict" else found.shown(found.finer)
        study, _, kept = study.partition(".")
        if kept in ("scatter", "spread"):
            mean, deviation = self.scatter(self.studies[study], name, figure, asked)
            return f"{mean} ± {deviation}" if kept == "scatter" else f"{100 * float(deviation) / float(mean):.0f} %"
        if kept:
            return self.cell(FOLDER / study / f"{kept}.csv", name, figure)
        study = self.studies[study]
        run = one_of([run for run in study.record["runs"] if study_facts.name_of(study, run) == name], asked)
        measure = one_of([measure for measure in study.record["measures"] if measure["name"] == figure], asked)
        value = run[f"{'known' if known else 'value'}_{figure}"]
        return "-" if value is None else study_facts.shown(measure, value)

    @staticmethod
    def scatter(study, name, figure, asked):
        titles, rows = study_facts.scatter(study)
        cell = one_of([row for row in rows if row[0] == name], asked)[titles.index(
            study_facts.title(one_of([m for m in study_facts.numbers(study) if m["name"] == figure], asked)))]
        mean, _, rest = cell.partition(" ± ")
        return mean, rest.partition(" ")[0]

    @staticmethod
    def cell(path, name, column):
        with open(path, newline="", encoding="utf-8") as file:
            titles, *rows = csv.reader(file)
        row = one_of([row for row in rows if name in (row[0], f"{row[0]}: {row[1]}")], f"{path}: {name}")
        if column in titles:
            return row[titles.index(column)]
        # A list of what there is `at` which strain.
        return one_of([part.partition(" ")[0] for part in row[-1].split(", ") if part.endswith(f" {column}")],
                      f"{path}: {name}, {column}")


def number(text, asked):
    try:
        return float(text.replace(",", ""))
    except ValueError:
        raise RuntimeError(f"{TEXT.name}: {asked} is {text}, no number") from None


def with_digits(value, digits):
    """As many as asked for, or all before the point."""
    return f"{value:.0f}" if abs(value) >= 10 ** (digits - 1) else f"{value:#.{digits}g}"


def one_of(found, asked):
    if len(found) != 1:
        raise RuntimeError(f"{TEXT.name}: {asked} names {len(found)} things, not one")
    return found[0]


def written():
    text = TEXT.read_text()
    asked = {key: value for key, value in values().items() if "{" + key + "}" in text}
    return finished(TEXT, Figures().quoted(filled_in(TEXT, asked)))


def main():
    words = [word for word in sys.argv[1:] if word not in ("--check", "--again")]
    for results in words:
        (compare if "--again" in sys.argv else take)(results)
    write_or_check(PAGE, written())


if __name__ == "__main__":
    main()
