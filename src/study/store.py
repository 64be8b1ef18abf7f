"""The folder of a study: which runs are done, with what they took. A call that follows goes on.

    DIR/runs/KEY/1, 2, ...   results of mpm_par, a folder a round
    DIR/runs/KEY/1.json      how that run ended: there only when it has
    DIR/runs/KEY/1.log       what it printed

KEY is drawn from the text of the scene and of the files that it names, from the settings, the
number of ranks and the program: what has changed is run anew.
"""
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import shutil

import program
from problems import REPEATABLE


def write_whole(path, content):
    """Text or bytes under their name only when complete."""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    if isinstance(content, bytes):
        part.write_bytes(content)
    else:
        part.write_text(content, encoding="utf-8")
    os.replace(part, path)


def _named_files(tree, folder):
    """Files that values of the tree name, relative to the folder of the scene."""
    if tree.is_list or tree.is_map:
        for node in tree.value.values() if tree.is_map else tree.value:
            yield from _named_files(node, folder)
    elif 0 < len(tree.value) < 1000 and "\n" not in tree.value:
        path = folder / tree.value
        if "*" in path.name and os.path.isdir(path.parent):
            fits = re.compile(".*".join(map(re.escape, path.name.split("*"))), re.DOTALL)
            yield from (slice_ for slice_ in path.parent.iterdir()  # of a stack
                        if fits.fullmatch(slice_.name) and slice_.is_file())
        elif os.path.isfile(path):  # of a text that is too long for a name as well
            yield path


def scene_print(scene, trees):
    """What stands for the text of a scene and of the files that it, or a setting, names."""
    digest = hashlib.sha256(pathlib.Path(scene).read_bytes())
    folder = pathlib.Path(scene).parent
    for path in sorted({path for tree in trees for path in _named_files(tree, folder)}):
        digest.update(path.name.encode() + hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


@dataclasses.dataclass
class Done:
    """A run that ended: `ended` is a program.Ended, summary and history are of its folder."""
    folder: pathlib.Path
    ended: program.Ended

    @property
    def summary(self):
        """summary.json; empty where the run did not get so far."""
        path = self.folder / "summary.json"
        return json.loads(path.read_text()) if path.exists() else {}


class Store:
    """Runs of one scene with one program under a folder."""

    def __init__(self, folder, of_scene, of_program):
        self.folder = pathlib.Path(folder)
        self._of_scene, self._of_program = of_scene, of_program

    def _key(self, assignments, ranks):
        text = json.dumps([self._of_scene, self._of_program, sorted(assignments), ranks])
        return hashlib.sha256(text.encode()).hexdigest()[:12]

    def place(self, assignments, ranks, turn):
        return self.folder / "runs" / self._key(assignments, ranks) / str(turn)

    def find(self, assignments, ranks, turn, time_limit=None):
        """The run that is done, or None. One that a full disk or a signal ended is not, nor one
        that was stopped earlier than it would be now."""
        place = self.place(assignments, ranks, turn)
        record = place.with_name(f"{turn}.json")
        if not record.exists():
            return None
        ended = program.Ended(**json.loads(record.read_text())["ended"])
        done = Done(place, ended)
        if ended.exit_status == 0 and not done.summary:
            return None  # its results were removed
        if ended.stopped:
            return done if time_limit and ended.elapsed_seconds >= time_limit else None
        return done if ended.exit_status in REPEATABLE else None

    def run(self, started, scene, assignments, ranks, turn, time_limit=None):
        """Runs and keeps; `started` is the Program."""
        place = self.place(assignments, ranks, turn)
        shutil.rmtree(place, ignore_errors=True)
        place.parent.mkdir(parents=True, exist_ok=True)
        ended = started.run(scene, assignments, ranks, place, time_limit)
        record = {"settings": dict(assignments), "ranks": ranks,
                  "ended": dataclasses.asdict(ended)}
        write_whole(place.with_name(f"{turn}.json"), json.dumps(record, indent=1) + "\n")
        return Done(place, ended)
