"""Figures out of what mpm_par leaves behind: summary.json and history.csv. SI units."""
import numpy

from mpm_par.history import read_history
from mpm_par.problems import ResultsError

CURVE_POINTS = 600  # evenly over a range of strain


class Missing(Exception):
    """The figure is not there; the text says why."""


def figure(summary, path):
    """The number at a dotted path of the summary."""
    found = summary
    for word in path.split("."):
        if found is None:
            break
        if not isinstance(found, dict) or word not in found:
            raise Missing(f"summary.json has no {path}")
        found = found[word]
    if found is None:
        remark = (summary.get("compression") or {}).get("remark") or "not reached or not distinct"
        raise Missing(f"no {path}: {remark}")
    if isinstance(found, bool) or not isinstance(found, (int, float)):
        raise Missing(f"{path} is no number")
    if not numpy.isfinite(found):
        raise Missing(f"{path} is not finite")
    return float(found)


def curve(path, column, begin, end):
    """`column` at CURVE_POINTS strains from begin to end, straight lines between the history's."""
    try:
        history = read_history(path)
        last = history["strain"][-1]
        if last < end * (1 - 1e-6):
            raise Missing(f"the run ends at {100 * last:.3g} % strain, before {100 * end:.3g} %")
        found = history.at(column, numpy.minimum(numpy.linspace(begin, end, CURVE_POINTS), last))
    except ResultsError as error:
        raise Missing(str(error)) from None
    if not numpy.isfinite(found).all():
        raise Missing(f"{column} is not finite")
    return found


def mean(path, column, begin, end):
    """The mean of a column over a range of strain."""
    return float(curve(path, column, begin, end).mean())


def value(measure, done):
    """The figure, or the curve, of a measure out of a run."""
    if measure.kind == "of":
        return figure(done.summary, measure.path)
    read = curve if measure.kind == "curve" else mean
    return read(done.folder / "history.csv", measure.column, *measure.strain)


def relative_error(found, reference):
    """|found - reference| / |reference|, of curves in the 2-norm; None of a reference of 0."""
    whole = numpy.linalg.norm(numpy.atleast_1d(reference))
    if whole == 0:
        return None
    return float(numpy.linalg.norm(numpy.atleast_1d(found - reference)) / whole)
