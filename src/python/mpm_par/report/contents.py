"""A report, from a run to its files."""
import dataclasses
import os
import pathlib

import numpy

from mpm_par.problems import ResultsError
from mpm_par.report import charts, facts, film, page, structure
from mpm_par.windows import windows_of_scene, work_in_windows


@dataclasses.dataclass
class Request:
    """What is asked of a report. `at`: (dimension, value) of the structure's moments; `windows`: of
    mpm_par.Window; `bars`: by figure, of read_error_bar; limits in MJ/m3 and MPa; `section` in m;
    `film_bytes`: 0 without a film; `remark`: on how the run ended."""
    at: list = dataclasses.field(default_factory=list)
    windows: list = dataclasses.field(default_factory=list)
    bars: dict = None
    work_limit: float = None
    stress_limit: float = None
    section: float = None
    film_bytes: int = 3_000_000
    remark: str = ""


def _curve(run, asked, made):
    if run.axis is None:
        return page.paragraphs(["No piston loads this specimen, so there is no stress-strain "
                                "curve."])
    made.append(charts.curve(run, asked.bars))
    html = page.figure(made[-1])
    if run.properties:
        rows, note = facts.properties(run, asked.bars)
        html = (f'<div class="gallery">{html}<div>'
                + page.table("Properties of the curve", ("property", "stress", "strain"), rows)
                + page.paragraphs([note], "note") + "</div></div>")
    return html


def _limit(asked, colouring):
    return asked.work_limit if colouring.stem == "plastic_work" else asked.stress_limit


def _structure(run, asked, stage, shown, made):
    """The galleries, and the film."""
    snapshots = structure.choose(run, asked.at)
    html = ""
    colourings, missing = shown
    for colouring in colourings:
        frames = structure.draw_frames(run, stage, snapshots, colouring, _limit(asked, colouring))
        made += frames
        html += (f"<h3>Coloured by {colouring.name}</h3>"
                 + page.paragraphs([colouring.explained + stage.words], "note")
                 + page.gallery(frames))
    return html + page.paragraphs(missing, "note")


def _film(run, asked, shown, made):
    if not asked.film_bytes or len(run.snapshots) < 2 or not shown[0]:
        return ""
    colouring = shown[0][0]
    stage = structure.Stage(run, asked.section, film.PIXELS_ACROSS)
    made.append(film.draw(run, stage, colouring, asked.film_bytes, _limit(asked, colouring)))
    still = next(drawing for drawing in reversed(made[:-1])
                 if drawing.stem.startswith(colouring.stem))
    return page.figure(made[-1], still)


def _windows(run, asked, made):
    windows = asked.windows or windows_of_scene(run)
    if not windows or not run.snapshots:
        return ""
    try:
        inside, everywhere, volumes = work_in_windows(run, windows)
    except ResultsError as error:
        if asked.windows:
            raise
        return page.paragraphs([f"The scene's windows are left out: {error}"], "note")
    names = [window.name for window in windows]
    with numpy.errstate(invalid="ignore", divide="ignore"):
        made.append(charts.windows(run, names, inside / everywhere[:, None]))
    rows = facts.window_rows(names, inside, everywhere, volumes)
    return ('<div class="gallery">' + page.figure(made[-1])
            + page.table("At the last snapshot",
                         ("window", "cell wall at the start", "plastic work", "share"), rows)
            + "</div>" + page.paragraphs(_late_windows(run), "note"))


def _late_windows(run):
    strain = run.snapshots[0].strain
    return [] if strain < 0.005 else [
        f"Windows are those of the first snapshot, at {100 * strain:.3g} % strain: add 0 % to "
        "output.snapshots for those of the specimen as it was."]


def _ranks(run, made):
    rows = facts.cooperation(run)
    if not rows:
        return ""
    html = page.table("How the ranks shared the work", ("", ""), rows)
    drawing = charts.ranks(run)
    if drawing is None:
        return html
    made.append(drawing)
    return f'<div class="gallery">{page.figure(drawing)}{html}</div>'


def _scene(run):
    path = run.folder / "scene.yaml"
    return page.folded("scene.yaml, every default filled in",
                       path.read_text(encoding="utf-8")) if path.exists() else ""


def contents(run, asked):
    """(HTML, Drawings) of a run."""
    made = []
    curve = _curve(run, asked, made)
    pictures = ["The run left no snapshots, so the structure is not shown "
                "(output.snapshots says when to write them)."]
    pictures, films = page.paragraphs(pictures, "note"), ""
    if run.snapshots:
        shown = structure.colourings(run, run.snapshots[-1])
        stage = structure.Stage(run, asked.section)
        pictures = _structure(run, asked, stage, shown, made)
        films = _film(run, asked, shown, made)
    energies = charts.energies(run)
    made += energies
    warnings = facts.warnings(run)
    sections = [
        ("curve", "Stress and strain", curve),
        ("structure", "Structure", pictures),
        ("film", "Film", films),
        ("windows", "Windows", _windows(run, asked, made)),
        ("energy", "Energy", page.gallery(energies)),
        ("ranks", "Ranks", _ranks(run, made)),
        ("warnings", "Warnings", page.listed(warnings) if warnings else
         page.paragraphs(["None."]) if run.summary else ""),
        ("run", "The run", '<div class="gallery">'
         + page.table("Figures of the run", ("", ""), facts.run_facts(run))
         + (page.table("Versions", ("", ""), facts.versions(run)) if run.summary else "")
         + "</div>"),
        ("scene", "Scene", _scene(run)),
        ("citation", "How to cite", page.paragraphs(facts.citation(run)))]
    foot = [f"Made by mpm_report from {run.folder.resolve().name}. The pictures stand as files in "
            "the folder report beside this page."]
    count = len(run.snapshots)
    subtitle = (f"{run.name}: {len(run.history)} lines of history, "
                f"{count} snapshot{'' if count == 1 else 's'}")
    return page.page(run.title, subtitle, facts.ending(run, asked.remark), sections, foot), made


def _write(path, content):
    """Under its name only when complete."""
    part = path.with_name(path.name + ".part")
    part.write_bytes(content)
    os.replace(part, path)


def write(results, html, drawings):
    """report.html and the files of the folder report in a folder of results, in place of those of
    an earlier report; returns the path of the page."""
    results = pathlib.Path(results)
    folder = results / "report"
    folder.mkdir(exist_ok=True)
    names = {f"{drawing.stem}.{ending}": content for drawing in drawings
             for ending, content in drawing.files.items()}
    for path in [*folder.glob("*.png"), *folder.glob("*.svg")]:
        if path.name not in names:
            path.unlink()
    for name, content in names.items():
        _write(folder / name, content)
    _write(results / "report.html", html.encode())
    return results / "report.html"
