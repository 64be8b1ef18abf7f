"""The key `known` of a study file: what others found for its runs, and how long theirs took."""
import dataclasses

from checked_keys import known, quantity
from mpm_par.quantities import to_si

KEYS = ("source", "runs", "run_time")


@dataclasses.dataclass(frozen=True)
class Known:
    """Of all runs with these settings."""
    where: tuple  # pairs of a key that varies, or label, and its value as text
    values: dict  # by name of the measure, SI units


def _value(node, name):
    try:
        if node.is_list or node.is_map:
            raise ValueError("is no single value")
        return to_si(node.value)[1]
    except ValueError as error:
        raise node.wrong(f"{name} is {node.text} ({error})", "Write e.g. 2740 MPa.") from None


def _entry(node, varied, combinations, names):
    keys = known(node, ("where", *names), "an entry of known.runs")
    where = ()
    if "where" in keys:
        settings = known(keys["where"], ("label", *varied), "where")
        where = tuple((key, value.text) for key, value in settings.items())
        if not any(all(run.has(key, text) for key, text in where) for run in combinations):
            raise keys["where"].wrong("where fits no run", "Write its values as in vary or runs.")
    return Known(where, {name: _value(keys[name], name) for name in keys if name != "where"})


def _run_time(node):
    """[least, most], s."""
    if not node.is_list or len(node.value) != 2:
        raise node.wrong("known.run_time is no list of two", "Write e.g. [4 h, 100 h].")
    least, most = (quantity(item, "known.run_time", "time", "[4 h, 100 h]") for item in node.value)
    if least > most:
        raise node.wrong("known.run_time falls", "Write the shorter one first.")
    return [least, most]


def read_known(node, varied, combinations, measures):
    """(entries, source, run time or None)."""
    keys = known(node, KEYS, "known")
    if "source" not in keys or not {"runs", "run_time"} & set(keys):
        raise node.wrong(f"known has no {'runs and no run_time' if 'source' in keys else 'source'}",
                         "Give it source: (a text) and runs: (a list), or run_time: [4 h, 100 h].")
    runs = keys["runs"].value if "runs" in keys else []
    if not isinstance(runs, list):
        raise keys["runs"].wrong("known.runs is no list",
                                 "Write e.g. - {where: {loading.piston: top}, modulus: 3252 MPa}.")
    names = [measure.name for measure in measures if measure.kind != "curve"]
    return [_entry(entry, varied, combinations, names) for entry in runs], \
        keys["source"].text, _run_time(keys["run_time"]) if "run_time" in keys else None
