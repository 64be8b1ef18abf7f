"""What a study says in words and tables: texts only, nothing is drawn and no run is opened here.

A study is a mpm_par.study.Study. Its runs are dicts of study.json, where figures are in SI units.
"""
import numpy

from mpm_par.report.facts import clock

OK = "ok"


def shown(measure, value):
    """A figure as a text without its unit."""
    return four_digits(value * _unit(measure)[1])


def four_digits(number):
    """Or all before the point."""
    return f"{number:.4g}" if abs(number) < 1e4 else f"{number:,.0f}"


def two_digits(measure, spread):
    """An error or a deviation as a text without its unit."""
    return four_digits(float(f"{spread * _unit(measure)[1]:.2g}"))


def _unit(measure):
    """(unit, factor from SI) of a measure of study.json."""
    ending = (measure["path"] or measure["column"]).split(".")[-1]
    if ending.startswith(("stress", "modulus")) or ending.endswith("slope"):
        return "MPa", 1e-6
    return ("%", 100) if ending == "strain" else ("", 1)


def title(measure):
    """Such as `buckling stress (MPa)`."""
    unit = _unit(measure)[0]
    return measure["name"].replace("_", " ") + (f" ({unit})" if unit else "")


def numbers(study):
    """Measures that are a number a run."""
    return [measure for measure in study.record["measures"] if measure["kind"] != "curve"]


def name_of(study, run):
    """What sets a run apart: `500 MPa, piston top, cells 75x49`."""
    words = [run["label"]] if run["label"] else []
    if run["level"]:
        words.append(f"{study.record['along'].split('.')[-1]} {run['level']}")
    return ", ".join(words) or study.title


def difference(value, known):
    """In percent of what is known, with its sign; empty where either is missing."""
    if value is None or not known:
        return ""
    return f"{100 * (value / known - 1):+.0f} %"


def _figure(measure, run):
    value, bar = run[f"value_{measure['name']}"], run.get(f"bar_{measure['name']}")
    if value is None:
        return "-"
    words = shown(measure, value)
    return words if bar is None else f"{words} ± {two_digits(measure, bar)}"


def figures(study):
    """(titles, rows) of all runs; ± is the estimated error of the finest run of a ladder. Last how
    many times faster a run was than those of others, where beside_known does not say so."""
    measures = numbers(study)
    titles = ["run", *map(title, measures), "energy error", "wall time"]
    took = run_time_alone(study)
    if took:
        titles.append(_faster_than(took))
    rows = []
    for run in study.record["runs"]:
        ended = run["state"] == OK
        rows.append([name_of(study, run), *(_figure(measure, run) for measure in measures),
                     f"{100 * run['energy_error']:.2g} %" if run["energy_error"] is not None
                     else "-", clock(run["wall_seconds"]) if ended else run["status"],
                     *([_times_faster(took, run)] if took else [])])
    return titles, rows


def _faster_than(took):
    return f"times faster than {clock(took[0])} to {clock(took[1])}"


def _times_faster(than, run):
    """[least, most], s, over the seconds of a run, two digits each."""
    if run["state"] != OK:
        return "-"
    return " to ".join(f"{float(format(known / run['wall_seconds'], '.2g')):,.0f}" for known in than)


def known_figures(study):
    """Measures that a figure of others stands beside."""
    return [measure for measure in numbers(study)
            if any(run.get(f"known_{measure['name']}") for run in study.record["runs"])]


def run_time_alone(study):
    """[least, most], s, that runs of others took, where nothing else is known of them; else None."""
    return None if known_figures(study) else study.record.get("known_run_time")


def beside_known(study):
    """(titles, rows): found, known and the difference; no rows where nothing is known. Last how
    many times faster the run was, where it is said how long those took."""
    measures = known_figures(study)
    titles = ["run", *map(title, measures)]
    took = study.record.get("known_run_time")
    if took:
        titles.append(_faster_than(took))
    rows = []
    for run in study.record["runs"]:
        cells = []
        for measure in measures:
            value, known = (run.get(f"{what}_{measure['name']}") for what in ("value", "known"))
            found = _figure(measure, run)
            if not known:
                cells.append("-" if value is None else f"{found} / -")
                continue
            apart = difference(value, known)
            cells.append(f"{found} / {shown(measure, known)}" + (f" ({apart})" if apart else ""))
        if took:
            cells.append(_times_faster(took, run))
        if any(run.get(f"known_{measure['name']}") for measure in measures):
            rows.append([name_of(study, run), *cells])
    return titles, rows


def is_finest(study, run):
    """Whether no run with the same settings but the level has more particles."""
    return all(other["particles"] <= run["particles"] for other in study.record["runs"]
               if other["state"] == OK and other["label"] == run["label"])


def shifts(study):
    """(titles, rows): what figures owe to the threshold: their change with
    specimen.threshold_shift, of the finest runs with otherwise the same settings."""
    key = "specimen.threshold_shift"
    apart = {"output.snapshots", key}
    measures = numbers(study)
    runs = [run for run in study.record["runs"]
            if run["state"] == OK and run["settings"].get(key) and is_finest(study, run)]

    def rest(run):
        return {name: value for name, value in run["settings"].items() if name not in apart}

    rows = []
    for run in runs:
        base = next((one for one in runs if float(one["settings"][key]) == 0
                     and rest(one) == rest(run)), None)
        if base in (None, run):
            continue
        rows.append([name_of(study, run),
                     *(difference(run[f"value_{m['name']}"], base[f"value_{m['name']}"]) or "-"
                       for m in measures)])
    return ["run, against the same as it is", *(m["name"].replace("_", " ") for m in measures)], \
        rows


def drawn_specimens(study):
    """Lists of two and more runs that differ by nothing but the specimen drawn (specimen.seed)."""
    key = "specimen.seed"
    groups = {}
    for run in study.record["runs"]:
        if run["state"] == OK and run["settings"].get(key):
            rest = tuple((name, value) for name, value in run["settings"].items() if name != key)
            groups.setdefault(rest, []).append(run)
    return [runs for runs in groups.values() if len(runs) > 1]


def scatter(study):
    """(titles, rows): mean, standard deviation and range of each figure over drawn specimens of one
    kind."""
    measures = numbers(study)
    rows = []
    for runs in drawn_specimens(study):
        words = [name_of(study, run).split(", ") for run in runs]
        shared = [word for word in words[0] if all(word in others for others in words)]
        rows.append([", ".join(shared) or "all", str(len(runs)),
                     *(_spread(measure, runs) for measure in measures)])
    return ["runs", "specimens", *map(title, measures)], rows


def _spread(measure, runs):
    values = [run[f"value_{measure['name']}"] for run in runs]
    values = [value for value in values if value is not None]
    if not values:
        return "-"
    words = shown(measure, numpy.mean(values))
    if len(values) > 1:
        words += (f" ± {two_digits(measure, numpy.std(values, ddof=1))} "
                  f"({shown(measure, min(values))} to {shown(measure, max(values))})")
    return words if len(values) == len(runs) else f"{words}, of {len(values)}"


def limits(study):
    """Sentences: what each figure tends to along the key that refines, where it does."""
    found = []
    for measure in numbers(study):
        for reference in measure["references"]:
            if measure["against"] != "richardson" or reference["value"] is None:
                continue
            series = ", ".join(str(value) for value in reference["series"].values() if value)
            order = "" if not reference.get("order") else f", order {reference['order']:.2g}"
            carried = reference["words"].startswith("Richardson")
            how = f"carried to zero{order}" if carried else "no extrapolation: the last run"
            found.append(f"{title(measure)}{' of ' + series if series else ''}: "
                         f"{shown(measure, reference['value'])} ({how}).")
    return found


def opening(study):
    """The comment that the study file begins with."""
    lines = []
    for line in study.record["study_text"].splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").strip())
    return " ".join(lines)


def cost(studies):
    """(runs, wall seconds of the whole programs, core seconds) of all studies, with runs as often as
    they were made."""
    runs = [run for study in studies for run in study.record["runs"]]
    elapsed = [(run["elapsed_seconds"] or 0.0) * run.get("rounds", 1) for run in runs]
    ranks = [float(run["settings"].get("ranks") or 1) for run in runs]
    return len(runs), sum(elapsed), float(numpy.dot(elapsed, ranks))
