"""Writes docs/wood_study.md from the files in docs/wood_study.

    wood_study_page.py RESULTS [RESULTS ...]
                                  first takes tables and pictures out of folders of results of
                                  mpm_study inputs/studies/wood_*.yaml, which mpm_report has drawn;
                                  a later folder takes the place of an earlier one, study by study
    wood_study_page.py --again RESULTS
                                  first compares with what was taken: the same studies, or some of
                                  them, made again on another machine, ranks or version
    wood_study_page.py            writes the page anew
    wood_study_page.py --check    only says whether the page is the one that would be written
"""
import csv
import json
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import runs  # noqa: F401  (which makes the project's modules known)
from words import filled_in, finished
from written_page import table, write_or_check

from mpm_par.report import facts, studies, study_facts, theory
from mpm_par.study import read_study, study_folders

PAGE = runs.PROJECT / "docs" / "wood_study.md"
FOLDER = runs.PROJECT / "docs" / "wood_study"
TEXT = Path(__file__).with_name("wood_study_page.md")
KEPT = ("study.csv", "study.json")
MPM_CURVE = runs.PROJECT / "build" / "mpm_curve"
AGAIN = FOLDER / "again.json"
LADDERS = runs.PROJECT / "docs" / "formulations" / "ladders.csv"
IN_LADDERS = "loblolly, tangential", "poplar, tangential", "poplar, radial", "loblolly, radial"
RISING_LINES = ("4", "8"), ("8", "16")  # times the plateau's last stress, beside the 2 and 4 of runs
PLASTIC_WORK, AXIAL_STRESS = "plastic_work", "axial_stress"
FRAMES = {  # strip of four: number of its first snapshot, and of the run, from 1 on
    "wood_yield": ((1, 3, PLASTIC_WORK), (1, 4, PLASTIC_WORK)),
    "wood_poplar": ((0, 1, PLASTIC_WORK), (0, 2, PLASTIC_WORK), (0, 1, AXIAL_STRESS), (0, 2, AXIAL_STRESS)),
    "wood_ponderosa": ((2, 1, PLASTIC_WORK),)}


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


# Of runs, which are not kept.
TABLES = {"foam": theory.honeycomb_rows, "layers": theory.layer_rows, "windows": studies.window_rows,
          "rising_lines": rising_line_rows}


def take(results):
    """Tables and pictures of finished studies."""
    for folder in study_folders(results):
        place = FOLDER / folder.name
        place.mkdir(parents=True, exist_ok=True)
        for name in KEPT:
            shutil.copyfile(folder / name, place / name)
        study = read_study(folder)
        runs_of_it = studies.opened(study, folder)
        for name, rows_of in TABLES.items():
            titles, rows = rows_of(study, runs_of_it)
            if rows:
                with open(place / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
                    csv.writer(file, lineterminator="\n").writerows([titles, *rows])
        for picture in (Path(results) / "report").glob(f"{folder.name}_curves.png"):
            shutil.copyfile(picture, FOLDER / picture.name)
        for first, number, colour in FRAMES.get(folder.name, ()):
            stem = f"{folder.name}_{number}_{colour}"
            strip([Path(results) / "report" / f"{stem}_{first + k:06}.png" for k in range(4)],
                  FOLDER / f"{stem}.png")


def strip(pictures, place):
    """The pictures side by side, as wide as a page."""
    from PIL import Image
    images = [Image.open(picture).convert("RGB") for picture in pictures]
    width = 1600 // len(images)
    images = [image.resize((width, round(image.height * width / image.width)), Image.LANCZOS)
              for image in images]
    whole = Image.new("RGB", (width * len(images), max(image.height for image in images)), "white")
    for k, image in enumerate(images):
        whole.paste(image, (k * width, 0))
    whole.quantize(128).save(place, optimize=True)


def ended_by_settings(study):
    """The runs that ended, by what varies in them; how many ranks they had does not count."""
    return {tuple(pair for pair in run["settings"].items() if pair[0] != "ranks"): run
            for run in study.record["runs"] if run["state"] == study_facts.OK}


def compare(results):
    """Writes what the runs of another folder have where the kept ones have a figure, too."""
    found, ranks = [], set()
    folders = study_folders(results)
    if not folders:
        sys.exit(f"{results}: holds no study. Name the folder that mpm_study has written.")
    for folder in folders:
        study, repeated = read_study(FOLDER / folder.name), read_study(folder)
        first = ended_by_settings(study)
        for settings, run in ended_by_settings(repeated).items():
            if settings not in first:
                sys.exit(f"{folder}: {study_facts.name_of(repeated, run)} is not among the runs of "
                         f"{FOLDER / folder.name}: another variant (--quick)?")
            figures = {}
            for name in [f"value_{measure['name']}" for measure in study_facts.numbers(study)]:
                if None not in (first[settings][name], run[name]):
                    figures[name.removeprefix("value_")] = [first[settings][name], run[name]]
            found.append({"study": study.title, "run": study_facts.name_of(repeated, run), "figures": figures})
            ranks.add(run["settings"].get("ranks", "1"))
    record = {"machine": repeated.record["machine"], "ranks": sorted(ranks), "runs": found}
    AGAIN.write_text(json.dumps(record, indent=1) + "\n")


def processor_of(record):
    return record["machine"]["processor"].replace("(R)", "").removesuffix(" Processor")


def again():
    """What was made again where, and how far each figure moved over all of these runs."""
    record = json.loads(AGAIN.read_text())
    named = ", ".join(f"*{title}*" for title in dict.fromkeys(run["study"] for run in record["runs"]))
    opening = (f"Of {named} {len(record['runs'])} runs were made again, on {' and '.join(record['ranks'])} "
               f"rank{'s' * (record['ranks'] != ['1'])} of an {processor_of(record)}.")
    moved = {}
    for run in record["runs"]:
        for name, (first, repeated) in run["figures"].items():
            way = repeated / first - 1
            moved.setdefault(name, []).append((abs(way), way, f"{run['study']}: {run['run']}"))
    lines = []
    for name, found in moved.items():
        sizes = [size for size, *_ in found]
        _, most, where = max(found)
        lines.append([name.replace("_", " "), str(len(sizes)), f"{100 * statistics.median(sizes):.2g} %",
                      f"{sum(size > 0.01 for size in sizes)}", f"{100 * most:+.2g} %", where])
    heads = ["figure", "runs", "half moved by less than", "by more than 1 %", "most", "which"]
    return {"again_opening": opening, "again_runs": str(len(record["runs"])), "again": table(heads, lines)}


def moduli_of_ladders():
    with open(LADDERS, newline="", encoding="utf-8") as file:
        found = {(row["geometry"], row["method"], row["cells"]): row["modulus"] for row in csv.DictReader(file)}
    methods = [(method, cells) for method in ("updated", "total") for cells in ("75", "150", "300")]
    known = {run["label"]: run["known_modulus"] for run in read_study(FOLDER / "wood_rays").record["runs"]}
    lines = []
    for wood in IN_LADDERS:
        moduli = [found[wood.replace(", ", "_"), *of] for of in methods]
        lines.append([wood, *(f"{float(modulus) / 1e9:.3g}" for modulus in [*moduli, known[wood]])])
    return table(["modulus, GPa", *(f"{method}, {cells} cells" for method, cells in methods), "paper"], lines)


def took():
    heads = ["study", "runs", "variant", "ranks", "run time", "processor", "program"]
    lines = []
    found = [read_study(folder) for folder in study_folders(FOLDER)]
    for study in found:
        count, elapsed, core_seconds = study_facts.cost([study])
        lines.append([study.title, str(count), "quick" if study.record["quick"] else "full",
                      f"{core_seconds / elapsed:g}", facts.clock(elapsed), processor_of(study.record),
                      study.record["mpm_par"]["git"][:7]])
    total = study_facts.cost(found)
    lines.append(["all", str(total[0]), "", "", facts.clock(total[1]), "", ""])
    return table(heads, lines)


def values():
    """What may stand in braces in wood_study_page.md."""
    found = {"took": took(), "moduli_of_ladders": moduli_of_ladders()} | again()
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


def written():
    text = TEXT.read_text()
    asked = {key: value for key, value in values().items() if "{" + key + "}" in text}
    return finished(TEXT, filled_in(TEXT, asked))


def main():
    words = [word for word in sys.argv[1:] if word not in ("--check", "--again")]
    for results in words:
        (compare if "--again" in sys.argv else take)(results)
    write_or_check(PAGE, written())


if __name__ == "__main__":
    main()
