"""A study file: what is read, with every wrong key reported by its line."""
import dataclasses
import pathlib

import measure_keys
import resolution
from checked_keys import known, quantity, whole_number
from combinations import level_keys, read_combinations, settings_of
from known_values import read_known
from problems import InputError
from yaml_tree import Node, read_yaml

KEYS = {
    "title": "one line about the study",
    "scene": "the scene file, relative to the study's folder",
    "set": "keys of the scene that all runs share",
    "vary": "keys of the scene, or ranks, each with a list of values",
    "runs": "settings that go together: a list of maps",
    "along": "the key that refines",
    "repeat": "how often every run is timed",
    "unstable_above": "energy error from which on a run counts as unstable",
    "time_limit": "after which a run is stopped",
    "error": "which figures are read, and what their error is against",
    "targets": "errors to reach",
    "known": "what others found for these runs",
    "quick": "what the quick variant does otherwise",
}
IN_QUICK = ("set", "vary", "runs", "along", "repeat", "time_limit", "error", "targets")
MERGED = ("set", "vary")


@dataclasses.dataclass
class Study:
    path: pathlib.Path
    title: str
    scene: pathlib.Path
    shared: dict  # key of the scene: node of its value
    combinations: list
    varied: list  # keys that differ between runs, in the order of the file
    nodes: dict  # key of the scene: the nodes that set it
    along: str  # key that refines, or None
    level_keys: tuple  # along, and what changes with it: all else makes series
    repeat: int
    unstable_above: float
    time_limit: float  # s, or None
    measures: list
    targets: list
    known: list = dataclasses.field(default_factory=list)  # of known_values.Known
    known_source: str = ""  # where they stand
    known_run_time: list = None  # [least, most] of the runs there, s
    quick: bool = False  # the quick variant of the file

    def assignments(self, combination):
        """(key, value) pairs as --set takes them. What a run sets overrides what all share; no
        snapshots are written unless the study asks for them."""
        settings = {key: node.text for key, node in self.shared.items()}
        settings.update(combination.settings)
        if not any(key.startswith("output.snapshots") or
                   key == "output" and node.is_map and "snapshots" in node.value
                   for key, nodes in self.nodes.items() for node in nodes):
            settings["output.snapshots"] = "0"  # behind an `output` that replaces all of it
        return list(settings.items())

    def known_of(self, combination):
        """What others found for this run: values by name of the measure; later entries count."""
        found = {}
        for entry in self.known:
            if all(combination.has(key, value) for key, value in entry.where):
                found.update(entry.values)
        return found


def _along(keys, varied, combinations, nodes):
    if "along" in keys:
        node = keys["along"]
        if node.text not in resolution.SIZES:
            raise node.wrong(f"along is {node.text} (no key that refines)",
                             f"Choose one of {', '.join(resolution.SIZES)}.")
        if node.text not in varied:
            raise node.wrong(f"along is {node.text}, which does not vary",
                             "Give it a list in vary.")
        along = node.text
    else:
        along = next((key for key in resolution.SIZES if key in varied), None)
    for combination in combinations if along else []:
        if combination.name_of(along):
            raise nodes[along][0].wrong(f"{along}, along which the study refines, has names",
                                        "Write its values as a list, or choose another key with along.")
        text = combination.value(along)
        try:
            if text is None:
                raise ValueError("is not set by every entry of runs")
            resolution.size(along, text)
        except ValueError as error:
            raise nodes[along][0].wrong(f"{along}, along which the study refines, "
                                     f"{error if text is None else f'is {text} ({error})'}",
                                     "Set it in vary, or choose another key with along.") from None
    return along


def _quick(keys):
    """The keys of the quick variant: set and vary entry by entry, all else as a whole."""
    if "quick" not in keys:
        raise InputError(f"{keys['scene'].place.split(':')[0]}: has no quick variant. "
                         "Leave --quick away, or give the study a key quick.")
    other = dict(keys)
    for key, node in known(keys["quick"], IN_QUICK, "quick").items():
        if key in MERGED and key in other and node.is_map and other[key].is_map:
            node = Node({**other[key].value, **node.value}, node.place)
        other[key] = node
    return other


def read_study(path, quick=False, ranks=1):
    """The study of a file. `ranks` is for runs that do not vary them."""
    path = pathlib.Path(path)
    root = read_yaml(path)
    keys = known(root, tuple(KEYS), "the study")
    for key in ("scene", "error"):
        if key not in keys:
            raise root.wrong(f"{key} is missing", f"It is {KEYS[key]}.")
    whole = keys
    if quick:
        keys = _quick(keys)
    scene = path.parent / keys["scene"].text
    if not scene.is_file():
        raise keys["scene"].wrong(f"scene is {keys['scene'].text} (there is no file {scene})",
                                  "Write its path from the study's folder.")
    shared = settings_of(keys["set"], "set") if "set" in keys else {}
    if "ranks" in shared:
        ranks = int(shared["ranks"].value)
        shared = {key: node for key, node in shared.items() if key != "ranks"}
    combinations, varied, nodes = read_combinations(keys, ranks)
    along = _along(keys, varied, combinations, nodes)
    of_level = level_keys(along, varied, combinations)
    measures = measure_keys.read_measures(keys["error"], along, of_level, varied, combinations)
    for extra in (measure.reference_run for measure in measures):
        if extra and not any(extra.settings == run.settings and extra.ranks == run.ranks
                             for run in combinations):
            combinations.append(extra)
    study = Study(
        path=path, title=keys["title"].text if "title" in keys else path.stem,
        scene=scene, shared=shared, combinations=combinations, varied=varied,
        nodes={**{key: [node] for key, node in shared.items()}, **nodes}, along=along, level_keys=of_level,
        repeat=whole_number(keys["repeat"], "repeat", 1) if "repeat" in keys else 1,
        unstable_above=quantity(keys["unstable_above"], "unstable_above", "number", "5 %")
        if "unstable_above" in keys else 0.05,
        time_limit=quantity(keys["time_limit"], "time_limit", "time", "10 min")
        if "time_limit" in keys else None,
        measures=measures, targets=[0.01, 0.001], quick=quick)
    if "known" in keys:
        # Which runs there are in full: those that the quick variant leaves out are no mistake.
        all_runs, all_varied, _ = read_combinations(whole, ranks) if quick else (combinations, varied, nodes)
        study.known, study.known_source, study.known_run_time = read_known(
            keys["known"], all_varied, all_runs, measures)
    if "targets" in keys:
        node = keys["targets"]
        if not node.is_list or not node.value:
            raise node.wrong("targets is no list", "Write e.g. targets: [1 %, 0.1 %].")
        study.targets = [quantity(item, "a target", "number", "1 %") for item in node.value]
    return study
