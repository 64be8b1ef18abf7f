"""Rows of the table, and for each measure references, errors, Pareto front and cheapest runs."""
import dataclasses
import math
import statistics

import convergence
import measure_keys
import pareto
import resolution
import results
from mpm_par.quantities import percent

COSTS = ("wall_seconds", "core_seconds", "particle_steps")
OK, UNSTABLE, FAILED = "ok", "unstable", "failed"
IS_REFERENCE = "is the reference"


@dataclasses.dataclass
class Row:
    """One combination of settings. Costs are medians over the rounds, or None if it failed."""
    combination: object
    label: str  # settings but the ranks' and the level's in words
    level: str  # value along which the study refines, short
    state: str  # ok, unstable or failed
    status: str  # for the table: ok, or what went wrong
    exit_status: int
    wall_seconds: float = None
    wall_spread: float = None  # half the range of the rounds over the median
    core_seconds: float = None
    cpu_seconds: float = None
    elapsed_seconds: float = None
    particle_steps: float = None
    particles: int = None
    steps: int = None
    peak_memory_mib: float = None
    energy_error: float = None
    rounds: int = 0
    folder: object = None  # with the results of the first round
    values: dict = dataclasses.field(default_factory=dict)  # by measure: number, array or None
    errors: dict = dataclasses.field(default_factory=dict)  # by measure: fraction or None
    bars: dict = dataclasses.field(default_factory=dict)  # by measure: convergence.Estimate
    known: dict = dataclasses.field(default_factory=dict)  # by measure: what others found, SI
    remarks: dict = dataclasses.field(default_factory=dict)  # by measure: why there is none


@dataclasses.dataclass
class Reference:
    """What the errors of a series are taken against."""
    value: object
    words: str
    order: float = None
    orders: list = None
    warnings: list = dataclasses.field(default_factory=list)
    row: Row = None  # the run that is the reference itself, and has no error


@dataclasses.dataclass
class Outcome:
    """All that one measure says."""
    measure: object
    references: dict  # series: Reference
    fronts: dict  # cost: rows on the Pareto front, cheapest first
    slopes: dict  # (series, cost): exponent of error over cost, or None
    targets: list  # lines of text
    warnings: list


def label_of(study, combination):
    """Words for a series: values of what varies but the level; `gimp, cfl 0.5`."""
    words = [combination.label] if combination.label else []
    for key in study.varied:
        value = combination.value(key)
        if key in study.level_keys or value is None or key in combination.labelled:
            continue
        plain = key.split(".")[-1]
        text = resolution.short(key, value)
        words.append(combination.name_of(key) or (
            f"{text} rank{'s' * (value != '1')}" if key == "ranks" else
            text if text.replace("_", "").isalpha() else f"{plain} {text}"))
    return ", ".join(words)


def row_of(study, combination, rounds):
    """The row of one combination from its rounds, a list of store.Done."""
    level = combination.value(study.along) if study.along else None
    row = Row(combination, label_of(study, combination),
              resolution.short(study.along, level) if level else "", OK, OK,
              rounds[0].ended.exit_status, rounds=len(rounds))
    row.peak_memory_mib = max(done.ended.peak_memory_bytes for done in rounds) / 2 ** 20
    row.elapsed_seconds = statistics.median(done.ended.elapsed_seconds for done in rounds)
    row.cpu_seconds = statistics.median(done.ended.cpu_seconds for done in rounds)
    failed = next((done for done in rounds if done.ended.exit_status or done.ended.stopped), None)
    if failed:
        row.state, row.exit_status = FAILED, failed.ended.exit_status
        row.status = failed.ended.message if failed.ended.stopped else \
            f"exit status {failed.ended.exit_status}: {failed.ended.message}"
        return row
    summaries = [done.summary for done in rounds]
    # The steps alone: neither reading and setting up nor files.
    seconds = [summary["loop_seconds"] - summary["output_seconds"] for summary in summaries]
    row.wall_seconds = statistics.median(seconds)
    row.wall_spread = (max(seconds) - min(seconds)) / 2 / row.wall_seconds
    row.core_seconds = row.wall_seconds * combination.ranks
    row.particles, row.steps = summaries[0]["particles"], summaries[0]["steps"]
    row.particle_steps = row.particles * row.steps
    row.energy_error = summaries[0]["energy_error"]
    judge_energy(row, summaries[0], study.unstable_above)
    row.folder = rounds[0].folder
    row.known = study.known_of(combination)
    for measure in study.measures:
        try:
            row.values[measure.name] = results.value(measure, rounds[0])
        except results.Missing as missing:
            row.values[measure.name] = None
            row.remarks[measure.name] = str(missing)
    return row


def judge_energy(row, summary, bound):
    """A run of compression whose energies do not add up is unstable. Without a piston the balance
    is over a work that may be next to none, and judges nothing."""
    if "compression" not in summary:
        return
    worst = max(abs(summary["energy_error"]), abs(summary.get("largest_energy_error") or 0))
    if not worst <= bound:  # so written, it holds for a NaN too
        row.state, row.status = UNSTABLE, f"unstable: energy error {percent(worst)}"


def series_of(study, row):
    """What rows of one ladder share, by the names of values that have some."""
    return tuple((key, row.combination.name_of(key) or row.combination.value(key)) for key in study.varied
                 if key not in study.level_keys)


def _size(study, row):
    return resolution.size(study.along, row.combination.value(study.along))


def ladder(study, measure, rows):
    """Good rows with a value, coarse to fine."""
    good = [row for row in rows if row.state == OK and row.values.get(measure.name) is not None]
    return sorted(good, reverse=True, key=lambda row: _size(study, row))


def _sizes(study, steps):
    """Of levels from coarse to fine; None where two are of the same size, which tell no order."""
    sizes = [_size(study, row) for row in steps]
    return sizes if len(set(sizes)) == len(sizes) else None


def _learnt(study, measure, rows):
    """The reference that a ladder gives, or None if it holds no good run."""
    steps = ladder(study, measure, rows)
    if not steps:
        return None
    finest = Reference(steps[-1].values[measure.name], f"the finest run, {steps[-1].level}",
                       row=steps[-1])
    finer = [row.level for row in rows if _size(study, row) < _size(study, steps[-1])]
    if finer:
        finest.warnings.append(f"finer levels gave no good value: {', '.join(finer)}")
    if len(steps) < 2:
        finest.warnings.append("one level only: nothing to compare it with")
        return finest
    sizes = _sizes(study, steps)
    if sizes is None:
        finest.warnings.append("two levels are of the same size: no order")
        return finest
    found = convergence.limit(sizes, [row.values[measure.name] for row in steps])
    finest.order, finest.orders = found.order, found.orders
    if measure.against == "finest":
        finest.warnings += found.warnings
        return finest
    if found.value is None:
        finest.warnings += [*found.warnings, "no extrapolation: errors are against the finest run"]
        return finest
    return Reference(found.value, f"Richardson extrapolation, observed order {found.order:.2f}",
                     found.order, found.orders, finest.warnings + found.warnings)


def references(study, measure, rows):
    """Series to Reference: exact figures are the same for all, ladders give each series its own
    unless the measure names one for all."""
    series = dict.fromkeys(series_of(study, row) for row in rows)
    if measure.against == "exact":
        return {one: Reference(None, "the figure is itself an error") for one in series}
    if not isinstance(measure.against, str):
        return {one: Reference(measure.against, measure.against_text) for one in series}
    if measure.reference is not None:
        chosen = [row for row in rows if all(row.combination.value(key) == value
                                             for key, value in measure.reference)]
        common = _learnt(study, measure, chosen)
        if common and chosen[0].label:
            common.words += f" of {chosen[0].label}"
        return {one: common for one in series}
    return {one: _learnt(study, measure, [row for row in rows if series_of(study, row) == one])
            for one in series}


def _set_errors(study, measure, rows, found):
    for row in rows:
        reference, value = found[series_of(study, row)], row.values.get(measure.name)
        row.errors[measure.name] = None
        if value is None or reference is None:
            continue
        if reference.row is row:
            row.remarks[measure.name] = IS_REFERENCE
        elif measure.against == "exact":
            row.errors[measure.name] = abs(value)
        else:
            row.errors[measure.name] = results.relative_error(value, reference.value)
            if row.errors[measure.name] is None:
                row.remarks[measure.name] = "no error relative to a reference of 0"


def _set_bars(study, measure, rows):
    """The estimated error of the finest run of every ladder of numbers: docs/studies.md."""
    for series in dict.fromkeys(series_of(study, row) for row in rows):
        own = ladder(study, measure, [row for row in rows if series_of(study, row) == series])
        sizes = _sizes(study, own)
        if len(own) < 2 or sizes is None or measure.kind == "curve":
            continue
        own[-1].bars[measure.name] = convergence.estimate(
            sizes, [row.values[measure.name] for row in own])


def _set_known_orders(study, measure, points, found):
    """Against what is known the order is that of the errors of the two finest levels."""
    for series, reference in found.items():
        own = ladder(study, measure, [row for row in points if series_of(study, row) == series])
        errors = [row.errors[measure.name] for row in own]
        if len(own) < 2 or _sizes(study, own) is None or None in errors or min(errors[-2:]) <= 0:
            continue
        pairs = zip(zip(own, errors), zip(own[1:], errors[1:]))
        reference.orders = [math.log(fine / coarse) / math.log(_size(study, b) / _size(study, a))
                            if fine > 0 and coarse > 0 else None
                            for (a, coarse), (b, fine) in pairs]
        reference.order = reference.orders[-1]


def _warnings(found):
    lines = []
    for series, reference in found.items():
        name = ", ".join(str(value) for _, value in series if value) or "the ladder"
        if reference is None:
            lines.append(f"{name}: no run gave a reference")
        else:
            lines += [f"{name}: {warning}" for warning in reference.warnings]
    shared = {id(reference) for reference in found.values()}
    if len(shared) == 1 and len(found) > 1:  # one reference for all: say it once
        return list(dict.fromkeys(line.split(": ", 1)[1] for line in lines))
    values = [reference.value for reference in found.values()
              if reference and reference.value is not None]
    apart = max((results.relative_error(one, other) or 0 for one in values for other in values),
                default=0)
    if apart > 0.001:
        lines.append(f"each series is judged by its own limit, and these differ by up to "
                     f"{percent(apart)}: name a reference to judge all by one")
    return lines


def _settled_error(study, measure, row, points):
    """The largest error of this level and of the finer ones of its series: an error that changes
    its sign passes through 0, and a level where it happens to do so has reached nothing."""
    if not study.along:
        return row.errors[measure.name]
    size = _size(study, row)
    return max(other.errors[measure.name] for other in points
               if series_of(study, other) == series_of(study, row)
               and _size(study, other) <= size)


def _target_line(study, target, measure, points):
    if not points:
        return f"{percent(target)}: not reached: no run has an error"
    settled = {id(row): _settled_error(study, measure, row, points) for row in points}
    good = [row for row in points if settled[id(row)] <= target]
    row = min(good or points, key=lambda row: row.wall_seconds if good else settled[id(row)])
    found = (f"{describe(study, row)}, error {percent(settled[id(row)])}, "
             f"{row.wall_seconds:.3g} s, {row.core_seconds:.3g} core-seconds")
    if good:
        return f"{percent(target)}: {found}"
    passing = [other for other in points if other.errors[measure.name] <= target]
    more = f"; {describe(study, passing[0])} has less by chance: finer levels have more" \
        if passing else ""
    return f"{percent(target)}: not reached: the best is {found}{more}"


def describe(study, row):
    """All that sets a row apart: `gimp, cells 48x42`."""
    level = f"{study.along.split('.')[-1]} {row.level}" if row.level else ""
    return ", ".join(word for word in (row.label, level) if word) or "the scene as it is"


def outcome_of(study, measure, rows):
    """References, errors and bars (set in the rows), front, slopes and targets of one measure."""
    if measure.against is None:
        for row in rows:
            row.errors[measure.name] = None
        return Outcome(measure, {}, {cost: [] for cost in COSTS}, {}, [], [])
    found = references(study, measure, rows)
    _set_errors(study, measure, rows, found)
    if measure.against in measure_keys.LEARNT:
        _set_bars(study, measure, rows)
    points = [row for row in rows if row.state == OK and row.errors[measure.name] is not None
              and not row.combination.only_reference]
    if measure.against not in measure_keys.LEARNT and study.along:
        _set_known_orders(study, measure, points, found)
    fronts = {cost: pareto.front(points, lambda row: getattr(row, cost),
                                 lambda row: row.errors[measure.name]) for cost in COSTS}
    slopes = {}
    for series in found:
        own = [row for row in points if series_of(study, row) == series]
        for cost in COSTS:
            slopes[series, cost] = pareto.slope([getattr(row, cost) for row in own],
                                                [row.errors[measure.name] for row in own])
    targets = [_target_line(study, target, measure, points) for target in study.targets]
    return Outcome(measure, found, fronts, slopes, targets, _warnings(found))
