"""The key `error` of a study file: which figures are read, and what their error is against."""
import dataclasses

import resolution
from checked_keys import known
from mpm_par.quantities import to_si

KEYS = ("name", "of", "curve", "mean", "against", "reference")
PART_KEYS = ("strain", "column")
LEARNT = ("finest", "richardson")  # references that the runs themselves give


@dataclasses.dataclass(frozen=True)
class Measure:
    """One figure of a run, or a curve, and what it is compared with."""
    name: str
    kind: str  # of, curve or mean
    path: str = ""  # in summary.json, for `of`
    column: str = "stress"  # of history.csv, for `curve` and `mean`
    strain: tuple = (0.0, 1.0)  # from, to
    against: object = "finest"  # a number in SI units, exact, finest, richardson; None: no error
    against_text: str = ""  # as it was written
    reference: tuple = None  # pairs of key and value that choose the series, or None: each its own
    reference_run: object = None  # a Combination that is run for the reference alone


def _part(node, kind):
    """Strain range and column of `curve` and `mean`."""
    keys = known(node, PART_KEYS, kind)
    if "strain" not in keys:
        raise node.wrong(f"{kind} has no strain", "Write its range: {strain: [0 %, 40 %]}.")
    ends = keys["strain"]
    try:
        if not ends.is_list or len(ends.value) != 2:
            raise ValueError("is no list of two")
        (kinds, values) = zip(*(to_si(end.text) for end in ends.value))
        if set(kinds) != {"number"}:
            raise ValueError("holds no fractions")
        if not 0 <= values[0] < values[1] < 1:
            raise ValueError("does not rise within 0 and 100 %")
    except ValueError as error:
        raise ends.wrong(f"{kind}.strain is {ends.text} ({error})",
                         "Write e.g. [0 %, 40 %].") from None
    return {"strain": values, "column": keys["column"].text if "column" in keys else "stress"}


def _against(node, kind):
    if node.text in LEARNT:
        return node.text
    if node.text == "exact":
        if kind != "of":
            raise node.wrong(f"against is exact, and {kind} is no error by itself",
                             "Name a figure of summary.json that is one with of.")
        return "exact"
    if kind == "curve":
        raise node.wrong(f"against is {node.text}, and the error is of a curve",
                         "Write finest or richardson.")
    try:
        value = to_si(node.text)[1]
        if value == 0:
            raise ValueError("is 0, of which no error is a fraction")
        return value
    except (ValueError, TypeError) as error:
        raise node.wrong(f"against is {node.text} ({error})",
                         "Write a number with its unit, exact, finest or richardson.") from None


def _reference(keys, against, along, of_level, varied, combinations):
    """The settings that choose the series of the reference, and a run for it alone if needed."""
    node = keys["reference"]
    if against not in LEARNT:
        given = f"against: {keys['against'].text}" if against is not None else "no against"
        raise node.wrong(f"reference does not go with {given}", "Leave it away.")
    chosen = {key: value.text
              for key, value in known(node, tuple(varied), "reference").items()}
    level = {key: chosen.pop(key) for key in of_level if key in chosen}
    matching = [run for run in combinations
                if all(run.value(key) == value for key, value in chosen.items())]
    series = {tuple((key, run.value(key)) for key in varied if key not in of_level)
              for run in matching}
    if len(series) != 1:
        raise node.wrong(f"reference fits {len(series)} series of runs",
                         f"Name the values of {', '.join(k for k in varied if k not in of_level)} "
                         "of one that is there.")
    if not level:
        return tuple(chosen.items()), None
    if len(level) < len(of_level):
        raise node.wrong(f"reference names a level by {', '.join(level)} alone",
                         f"Name all of {', '.join(of_level)}.")
    try:
        resolution.size(along, level[along])
    except ValueError as error:
        raise node.value[along].wrong(f"reference.{along} is {level[along]} ({error})",
                                      "Write it as in vary.") from None
    run = matching[0]
    settings = tuple((key, level.get(key, value)) for key, value in run.settings)
    return tuple(chosen.items()), dataclasses.replace(run, settings=settings, only_reference=True)


def _measure(node, along, of_level, varied, combinations):
    keys = known(node, KEYS, "error")
    kinds = [kind for kind in ("of", "curve", "mean") if kind in keys]
    if len(kinds) != 1:
        raise node.wrong(f"error names {' and '.join(kinds) or 'no figure'}",
                         "Give one of of (a path in summary.json), curve and mean.")
    kind = kinds[0]
    against = _against(keys["against"], kind) if "against" in keys else None
    if against in LEARNT and not along:
        raise keys["against"].wrong(f"against is {against}, and no key that refines varies",
                                    f"Vary one of {', '.join(resolution.SIZES)}.")
    more = {"path": keys["of"].text} if kind == "of" else _part(keys[kind], kind)
    reference, run = None, None
    if "reference" in keys:
        reference, run = _reference(keys, against, along, of_level, varied, combinations)
    name = keys["name"].text if "name" in keys else more.get("path", kind).split(".")[-1]
    if not name.replace("_", "").isalnum():
        raise keys["name"].wrong(f"name is '{name}'", "Use letters, digits and _: it names files.")
    return Measure(name=name, kind=kind, against=against,
                   against_text=keys["against"].text if against is not None else "",
                   reference=reference, reference_run=run,
                   **more)


def read_measures(node, along, of_level, varied, combinations):
    """A map is one measure, a list several with different names."""
    measures = []
    for item in node.value if node.is_list else [node]:
        measure = _measure(item, along, of_level, varied, combinations)
        if measure.name in [other.name for other in measures]:
            raise item.wrong(f"two errors are named {measure.name}", "Give one another name.")
        measures.append(measure)
    if not measures:
        raise node.wrong("error is empty", "Name a figure: {of: compression.modulus, ...}.")
    return measures
