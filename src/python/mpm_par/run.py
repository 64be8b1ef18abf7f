"""The folder of results of a run, whole or not."""
import dataclasses
import functools
import json
import pathlib

import yaml

from mpm_par import quantities
from mpm_par.history import History, read_history
from mpm_par.problems import ResultsError
from mpm_par.snapshots import read_series

AXES = {"left": 0, "right": 0, "bottom": 1, "top": 1, "back": 2, "front": 2}


@dataclasses.dataclass(frozen=True)
class Run:
    """`history`; `summary`: summary.json as a dict, None as long as the run has not ended well;
    `scene`: the effective scene as a dict, quantities as texts such as "10.6 GPa". Snapshots are
    read when asked for."""
    folder: pathlib.Path
    history: History
    summary: dict
    scene: dict

    @property
    def name(self):
        return self.scene.get("name") or self.folder.resolve().name

    @property
    def title(self):
        return self.scene.get("title") or self.name

    @property
    def properties(self):
        """What mpm_curve reads off the curve, SI units: the part `compression` of summary.json.
        Empty without a piston, or if the run has not ended."""
        return (self.summary or {}).get("compression") or {}

    @property
    def axis(self):
        """Along which the piston moves: 0, 1 or 2; None without a piston."""
        loading = self.scene.get("loading")
        return AXES[loading["piston"]] if loading else None

    @property
    def is_in_space(self):
        return bool(self.scene) and "thickness" not in self.scene.get("numerics", {})

    @property
    def is_total_lagrangian(self):
        return self.scene.get("numerics", {}).get("formulation") == "total_lagrangian"

    @property
    def keeps_order(self):
        """Whether particles have the same place in every snapshot: cells that stayed on their
        ranks. A run that went on on another number of ranks is not known by its summary."""
        return self.is_total_lagrangian and not (self.summary or {}).get("repartitions")

    @property
    def thickness(self):
        """Out of the plane, m; 1 in space. Energies of a run in the plane are those of it."""
        return self.quantity("numerics.thickness") or 1.0

    def quantity(self, path):
        """The value at a dotted path of the effective scene in SI units; None if it has none."""
        found = self.scene
        for word in path.split("."):
            found = found.get(word) if isinstance(found, dict) else None
        if found is None or isinstance(found, (int, float)):
            return found
        try:
            return quantities.to_si(found)[1]
        except ValueError as error:
            raise ResultsError(f"{self.folder / 'scene.yaml'}: {path} {error}. "
                               "Run again.") from None

    @functools.cached_property
    def snapshots(self):
        """A list of Snapshot in the order of time; empty if the run wrote none."""
        path = self.folder / f"{self.name}.xdmf"
        return read_series(path) if path.exists() else []

    @functools.cached_property
    def last_sound_state(self):
        """The Snapshot that a failed run leaves behind, or None."""
        path = self.folder / "failure" / f"{self.name}.xdmf"
        return read_series(path)[-1] if path.exists() else None

    @property
    def checkpoints(self):
        """Paths of the states to go on from, the newest last."""
        return sorted((self.folder / "checkpoints").glob("*.h5"))


class _SceneLoader(yaml.SafeLoader):
    """A name is a text, whatever it looks like: 007, 0.50, on or 2026-11-03."""

    def construct_mapping(self, node, deep=False):
        for key, value in node.value:
            if key.value in ("name", "title"):
                value.tag = yaml.resolver.BaseResolver.DEFAULT_SCALAR_TAG
        return super().construct_mapping(node, deep)


def _read_summary(path):
    if not path.exists():
        return None
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ResultsError(f"{path}: is no summary ({error}). Remove it, or run again.") from None


def _read_scene(path):
    if not path.exists():
        return {}
    try:
        scene = yaml.load(path.read_text(encoding="utf-8"), _SceneLoader)
    except (OSError, ValueError, yaml.YAMLError) as error:
        said = " ".join(str(error).split())
        raise ResultsError(f"{path}: is no scene ({said}). Run again.") from None
    if not isinstance(scene, dict):
        raise ResultsError(f"{path}: is no scene. Run again.")
    return scene


def open_run(folder):
    """The Run in a folder of results. Raises ResultsError if there is no such folder, if no run has
    written there, or if a file of it is broken. A run that has not ended, or that ended early, is
    opened as well: its `summary` is None."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise ResultsError(f"{folder}: is no folder. Name the folder of results of a run, such as "
                           "results/my_wood.")
    if not (folder / "history.csv").exists():
        raise ResultsError(f"{folder}: holds no history.csv, so no run has written there. Name the "
                           "folder of results of a run, such as results/my_wood.")
    return Run(folder, read_history(folder / "history.csv"),
               _read_summary(folder / "summary.json"), _read_scene(folder / "scene.yaml"))
