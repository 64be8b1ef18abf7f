"""A page of studies: curves, figures and what others found, theory, structures, and their cost."""
import pathlib
from html import escape

import numpy

from mpm_par import pictures
from mpm_par.problems import ResultsError
from mpm_par.report import charts, drawing, facts, page, structure, study_facts, theory
from mpm_par.run import open_run
from mpm_par.study import read_study, study_folders
from mpm_par.windows import windows_of_scene, work_in_windows

MOST_CURVES = 10  # in one picture


def opened(study, folder):
    """[(run of study.json, mpm_par.Run)] of those that ended well and whose results are there."""
    found = []
    for entry in study.record["runs"]:
        if entry["state"] != study_facts.OK or not entry["folder"]:
            continue
        try:
            found.append((entry, open_run(folder / entry["folder"])))
        except ResultsError:
            continue  # results of runs may be removed once the tables are written
    return found


def _finish(axes, columns, size):
    """Grid lines, and a legend below."""
    axes.grid(color="#e6e8eb", lw=0.7)
    drawing.legend_below(axes, columns, size)


def _curves(stem, study, runs):
    """All curves in one picture, up to three times the largest stress of densification; those of
    many ladders in a picture each, as nobody tells twenty curves apart."""
    runs = [(entry, run) for entry, run in runs if run.axis is not None]
    ladders = list(dict.fromkeys(entry["label"] for entry, _ in runs)) if study.record["along"] else []
    if len(runs) <= MOST_CURVES or not 2 <= len(ladders) <= len(runs) / 2:
        return [_curves_of(f"{stem}_curves", study, runs, "")] if runs else []
    return [_curves_of(f"{stem}_curves_{k}", study, [one for one in runs if one[0]["label"] == label],
                       f": {label}") for k, label in enumerate(ladders, 1)]


def _curves_of(stem, study, runs, whose):
    dense = [run.properties["densification"]["stress"] for _, run in runs
             if run.properties.get("densification")]
    highest = max(numpy.nanmax(run.history["stress"]) for _, run in runs)
    top = min(1.05 * highest, 3 * max(dense)) if dense else 1.05 * highest

    def draw(axes):
        for k, (entry, run) in enumerate(runs):
            axes.plot(100 * run.history.strain_of("stress"), run.history["stress"] / 1e6, lw=1.2,
                      color=charts.COLOURS[k % len(charts.COLOURS)],
                      ls=("-", "--", ":", "-.")[k // len(charts.COLOURS) % 4],
                      label=study_facts.name_of(study, entry))
        axes.set(xlabel="compressive strain (%)", ylabel="stress (MPa)", xlim=(0, None),
                 ylim=(0, top / 1e6))
        _finish(axes, columns, 7.5)

    columns = 1 + (len(runs) > 4)
    rows = -(-len(runs) // columns)
    return drawing.plot(stem, draw,
                        f"Stress over strain of {len(runs)} runs{whose}.",
                        "Mean of the stress at the piston and at the fixed edge over the first "
                        "cross-section.", height=3.8 + 0.17 * rows)


def _ladders(stem, study):
    """Every figure over what refines, relative to its finest value; None of a study without a
    ladder of three."""
    record = study.record
    if not record["along"]:
        return None
    runs = [run for run in record["runs"] if run["state"] == study_facts.OK]
    series = dict.fromkeys(run["label"] for run in runs)
    levels = list(dict.fromkeys(run["level"] for run in runs))
    measures = [m for m in study_facts.numbers(study) if m["against"] in ("finest", "richardson")]
    if len(levels) < 3 or not measures:
        return None

    def draw(axes):
        for k, measure in enumerate(measures):
            for style, one in zip(("o-", "s--", "^:", "d-.") * 4, series):
                own = [run for run in runs if run["label"] == one
                       and run[f"value_{measure['name']}"] is not None]
                last = own[-1][f"value_{measure['name']}"] if own else 0
                if not last:  # nothing is relative to 0
                    continue
                name = measure["name"].replace("_", " ")
                axes.plot([levels.index(run["level"]) for run in own],
                          [100 * (run[f"value_{measure['name']}"] / last - 1) for run in own],
                          style, ms=4, lw=1.1, color=charts.COLOURS[k % len(charts.COLOURS)],
                          label=name + (f", {one}" if one else ""))
        axes.set_xticks(range(len(levels)), levels)
        axes.axhline(0, color=pictures.INK, lw=0.8)
        axes.set(xlabel=record["along"], ylabel="difference from the last level (%)")
        _finish(axes, 2, 7)

    entries = -(-len(measures) * len(series) // 2)
    return drawing.plot(f"{stem}_levels", draw,
                        f"Figures over {record['along']}, relative to those of the last level.",
                        f"How the figures change with {record['along']}.",
                        height=3.6 + 0.15 * entries)


def window_rows(study, runs):
    """(titles, rows): share of the cell wall and, at each snapshot's strain, of the plastic work that
    each window of the scene has, of runs that left snapshots of it."""
    rows = []
    for entry, run in runs:
        windows = windows_of_scene(run)
        if not windows or not run.snapshots or "plastic_work" not in run.snapshots[0]:
            continue
        try:
            inside, everywhere, volumes = work_in_windows(run, windows)
        except ResultsError:
            continue  # a report of that run says why
        bodies = run.summary["plan"]["particles"]
        wall = run.snapshots[0].particle_volume * sum(
            body["count"] for name, body in bodies.items() if name != "load_cell")
        for k, window in enumerate(windows):
            shares = [f"{100 * work[k] / whole:.3g} at {100 * snapshot.strain:.3g} %"
                      for work, whole, snapshot in zip(inside, everywhere, run.snapshots)
                      if snapshot.strain > 0 and whole > 0]
            rows.append([study_facts.name_of(study, entry), window.name,
                         f"{100 * volumes[k] / wall:.3g}", ", ".join(shares) or "-"])
    return ["run", "window", "share of the cell wall (%)",
            "share of the plastic work (%), at strain"], rows


def reading_rows(study, runs):
    """(titles, rows): what the finest run of each ladder took its picture for, where that was found by
    a density or moved by a shift of the threshold."""
    def read(run, key):
        return run.scene.get("specimen", {}).get(key)

    shifted = any(float(read(run, "threshold_shift") or 0) for _, run in runs)
    rows = []
    for entry, run in runs:
        asked, summary = read(run, "threshold"), run.summary or {}
        if summary.get("relative_density") is None or not study_facts.is_finest(study, entry) or not (
                isinstance(asked, dict) or shifted):
            continue
        gray, growth = summary.get("threshold"), summary.get("wall_growth") or 0.0
        rows.append([study_facts.name_of(study, entry),
                     ", ".join(map(str, asked.values())) if isinstance(asked, dict) else "-",
                     "-" if gray is None else f"{gray:.4g}", f"{1e6 * growth:+.3g}" if growth else "0",
                     f"{summary['bulk_density']:.0f}", f"{summary['relative_density']:.3f}"])
    return ["run", "density asked for", "gray level that parts", "walls made thicker by (um)",
            "density (kg/m3)", "relative density"], rows


def warned(study, runs):
    """Sentences of the runs' warnings, each once, with the runs that have it."""
    whose = {}
    for entry, run in runs:
        for sentence in dict.fromkeys(facts.warnings(run)):
            whose.setdefault(sentence, []).append(study_facts.name_of(study, entry))

    def named(names):
        if len(names) == len(runs):
            return "All runs"
        return "; ".join(names) if len(names) < 4 else f"{len(names)} runs, such as {names[0]}"

    return [f"{named(names)}: {sentence}" for sentence, names in whose.items()]


def _structures(stem, study, runs, made):
    """Frames of the runs that left snapshots, coloured by plastic work and by axial stress, as far as
    a run has them."""
    html = ""
    for number, (entry, run) in enumerate(runs, 1):
        if len(run.snapshots) < 2 or not study_facts.is_finest(study, entry):
            continue
        stage, moments = structure.Stage(run), structure.choose(run, [])
        for colouring in structure.colourings(run, run.snapshots[-1])[0]:
            frames = structure.draw_frames(run, stage, moments, colouring)
            for frame in frames:
                frame.stem = f"{stem}_{number}_{frame.stem}"
            made += frames
            html += (f"<h3>{escape(study_facts.name_of(study, entry))}, coloured by "
                     f"{escape(colouring.name)}</h3>" + page.gallery(frames))
    return html


def _table(caption, titles_and_rows):
    titles, rows = titles_and_rows
    return page.table(caption, titles, rows) if rows else ""


def _warnings(sentences):
    return f"<h3>Warnings</h3>{page.listed(sentences)}" if sentences else ""


def _section(folder, study, made):
    stem = folder.name
    runs = opened(study, folder)
    drawn = _curves(stem, study, runs) + [picture for picture in [_ladders(stem, study)] if picture]
    made += drawn
    source = study.record["known_source"]
    times = f"; run times beside those of {source}" if study_facts.run_time_alone(study) else ""
    return (page.paragraphs([study_facts.opening(study)])
            + page.gallery(drawn)
            + _table("Figures of the runs; ± is the estimated numerical error, or that of the "
                     f"speed, of the last of a ladder{times}", study_facts.figures(study))
            + (page.listed(found) if (found := study_facts.limits(study)) else "")
            + _table("How the picture was read", reading_rows(study, runs))
            + _table("What the threshold is worth", study_facts.shifts(study))
            + _table("Over drawn specimens: mean ± standard deviation (least to most)",
                     study_facts.scatter(study))
            + _table(f"Found here / {source} (difference)", study_facts.beside_known(study))
            + _table("Foam theory: hexagons of the same relative density whose walls bend, with "
                     "free sides (Gibson and Ashby)", theory.honeycomb_rows(study, runs))
            + _table("Two layers: moduli out of those in series and in parallel",
                     theory.layer_rows(study, runs))
            + _table("Plastic work in the windows", window_rows(study, runs))
            + _warnings(warned(study, runs))
            + _structures(stem, study, runs, made))


def contents(folder):
    """(HTML, Drawings) of the studies in a folder."""
    folders = study_folders(folder)
    studies = [read_study(one) for one in folders]
    for one, study in zip(folders, studies):
        if "quick" not in study.record:
            raise ResultsError(f"{one}: was written by an earlier mpm_study. Start it again: it "
                               "goes on from what is done.")
    made, sections = [], []
    for one, study in zip(folders, studies):
        sections.append((one.name, study.title, _section(one, study, made)))
    runs, elapsed, core = study_facts.cost(studies)
    failed = sum(run["state"] != study_facts.OK for s in studies for run in s.record["runs"])
    record = studies[0].record
    rows = [("runs", str(runs)), ("run time, one after the other", facts.clock(elapsed)),
            ("core time", facts.clock(core)),
            *((name.replace("_", " "), str(value)) for name, value in record["machine"].items()),
            *record["mpm_par"].items()]
    sections.append(("cost", "What it took", page.table("Runs, machine and program", ("", ""),
                                                        rows)))
    sections += [(f"file-{one.name}", f"Study file: {study.record['study']}",
                  page.folded(study.record["study"], study.record["study_text"]))
                 for one, study in zip(folders, studies)]
    ending = ("good", f"All {runs} runs ended well.") if not failed else \
        ("short", f"{failed} of {runs} runs did not end well: their rows say why.")
    heading = studies[0].title if len(studies) == 1 else f"{len(studies)} studies"
    return page.page(heading, pathlib.Path(folder).resolve().name, ending, sections,
                     ["Made by mpm_report. The pictures stand as files in the folder report beside "
                      "this page."]), made
