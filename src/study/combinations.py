"""The runs of a study: every combination of the lists of `vary` with every entry of `runs`."""
import dataclasses
import itertools

from checked_keys import whole_number


@dataclasses.dataclass(frozen=True)
class Combination:
    """The settings of one run."""
    settings: tuple  # pairs of a key of the scene and its value as text: what varies
    ranks: int
    only_reference: bool = False  # run for its result, no point of the study
    label: str = ""  # what its entry of runs is called
    labelled: tuple = ()  # keys whose values the label stands for
    # Pairs of a key and what the study calls its value: the same run under two names is one.
    names: tuple = dataclasses.field(default=(), compare=False)

    def value(self, key):
        of_run = {**dict(self.settings), "ranks": str(self.ranks), "label": self.label}
        return of_run.get(key)

    def name_of(self, key):
        """What the study calls its value, or None."""
        return dict(self.names).get(key)

    def has(self, key, text):
        """Whether this is its value, or what the study calls it."""
        return text in (self.value(key), self.name_of(key))


def settings_of(node, where):
    """A map from keys of the scene to single values."""
    if not node.is_map:
        raise node.wrong(f"{where} is no map", "Write keys of the scene: {grid.cells: [48, 42]}.")
    for key, value in node.value.items():
        if key == "ranks":
            whole_number(value, "ranks", 1)
    return node.value


def _lists(node):
    """By key its values: pairs of the name that the study gives to one, or None, and its node."""
    if not node.is_map or not node.value:
        raise node.wrong("vary is no map", "Write a list for each key: "
                         "{numerics.shape_function: [gimp, quadratic]}.")
    found = {}
    for key, values in node.value.items():
        if not (values.is_list or values.is_map) or not values.value:
            raise values.wrong(f"vary.{key} is no list of values",
                               f"Write {key}: [..., ...], or {key}: {{name: ..., name: ...}}.")
        found[key] = list(values.value.items()) if values.is_map else [(None, value) for value in values.value]
        for _, value in found[key]:
            if key == "ranks":
                whole_number(value, "ranks", 1)
    return found


def level_keys(along, varied, combinations):
    """Keys that make up a level: the one that refines, and those of runs that it determines, such
    as the cells of a load cell that keeps its thickness. Those of the method never do."""
    found = [along] if along else []
    for key in varied if along else []:
        pairs = {(run.value(along), run.value(key)) for run in combinations}
        levels, values = ({pair[k] for pair in pairs} for k in (0, 1))
        if (key not in (along, "ranks") and not key.startswith("numerics.") and len(values) > 1
                and len(pairs) == len(levels)):
            found.append(key)
    return tuple(found)


def _labelled(settings):
    """(label, settings without it) of an entry of `runs`."""
    label = settings["label"].text if "label" in settings else ""
    return label, {key: value for key, value in settings.items() if key != "label"}


def read_combinations(keys, default_ranks):
    """Every combination of the lists of `vary` with every entry of `runs`; the keys that vary; and by
    key the nodes of its values."""
    lists = _lists(keys["vary"]) if "vary" in keys else {}
    entries = [("", {})]  # label and settings
    if "runs" in keys:
        node = keys["runs"]
        if not node.is_list or not node.value:
            raise node.wrong("runs is no list", "Write a list of maps: "
                             "- {numerics.scheme: apic, numerics.cfl: 0.5}.")
        entries = [_labelled(settings_of(entry, "an entry of runs")) for entry in node.value]
    varied = list(dict.fromkeys(itertools.chain(lists, *(entry for _, entry in entries))))
    for _, entry in entries:
        for key in entry:
            if key in lists:
                raise entry[key].wrong(f"{key} is varied too", "Set it in vary or in runs.")
    found, nodes = [], {}
    for label, entry in entries:
        labelled = tuple(entry) if label else ()
        for values in itertools.product(*lists.values()):
            chosen = {**{key: value for key, (_, value) in zip(lists, values)}, **entry}
            names = tuple((key, name) for key, (name, _) in zip(lists, values) if name)
            for key, node in chosen.items():
                if not any(node is known for known in nodes.setdefault(key, [])):
                    nodes[key].append(node)
            ranks = int(chosen["ranks"].value) if "ranks" in chosen else default_ranks
            settings = tuple((key, chosen[key].text) for key in varied
                             if key in chosen and key != "ranks")
            found.append(Combination(settings, ranks, label=label, labelled=labelled, names=names))
    return list(dict.fromkeys(found)), varied, nodes
