"""Faults at random moments of a run of mpm_par, and whether the run, taken up again, ends as if nothing had
happened: history, snapshots, XDMF and what the summary says, byte by byte.

A run is lost if a file that was complete is not whole, if it cannot go on or be begun again, if it ends in
other bits, or if it hangs."""
import dataclasses
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

import h5py

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "regression"))
from program import seconds, set_options  # noqa: E402
from same_results import difference, results_of  # noqa: E402

INPUTS = pathlib.Path(__file__).parents[2] / "inputs"
SCENE = INPUTS / "benchmarks" / "crushed_ring.yaml"
EVERY = 300  # steps between checkpoints
SETTINGS = ["numerics.formulation=total_lagrangian", "grid.cells=[28, 28]", "loading.speed=20 m/s",
            "loading.strain=30 %", "output.history_lines=120",
            "output.snapshots={strains: [0 %, 3 %, 6 %, 9 %, 12 %, 15 %, 18 %, 21 %, 24 %, 27 %, 29 %]}"]
CHECKPOINTS = f"output.checkpoints={{steps: {EVERY}, keep: 3}}"
PATIENCE = seconds(180)  # until a run counts as hanging


class Lost(Exception):
    """What a trial was lost by."""


@dataclasses.dataclass
class Outcome:
    fault: str
    ranks: int
    status: int
    lost_share: float  # of the run: done before the fault, to be done again
    whole_files: int   # complete when the fault came
    message: str = ""


class Program:
    """mpm_par on some ranks, in a folder, under a launcher."""

    def __init__(self, mpm_par, mpiexec, flag, failing_writes=None):
        """`failing_writes`: a library to be preloaded."""
        self.mpm_par, self.launcher = pathlib.Path(mpm_par), [mpiexec, flag]
        self.failing_writes = failing_writes

    def command(self, ranks, folder, *words, before=()):
        return [*(self.launcher + [str(ranks)] if ranks > 1 else []), *before, str(self.mpm_par), str(SCENE),
                "--output", str(folder), *set_options([*SETTINGS, CHECKPOINTS]), *words]

    def start(self, ranks, folder, *words, before=(), **more):
        return subprocess.Popen(self.command(ranks, folder, *words, before=before), stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, start_new_session=True, **more)

    def ranks_of(self, started):
        """Process ids of mpm_par among the offspring of what was started."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                pid = int(entry.name)
                if os.readlink(entry / "exe") == str(self.mpm_par) and self._descends(pid, started.pid):
                    found.append(pid)
            except OSError:
                pass  # ended meanwhile
        return found

    @staticmethod
    def _descends(pid, ancestor):
        while pid > 1:
            if pid == ancestor:
                return True
            status = pathlib.Path(f"/proc/{pid}/stat").read_text()
            pid = int(status.rpartition(")")[2].split()[1])
        return False

    def end_of(self, started):
        """(output, errors); a run that hangs is lost, and so is one that leaves ranks behind."""
        ranks = self.ranks_of(started)
        try:
            output, errors = started.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(started.pid, signal.SIGKILL)
            for pid in ranks:
                kill(pid, signal.SIGKILL)
            started.communicate()
            raise Lost(f"hangs for {PATIENCE} s") from None
        return output, errors

    def run(self, ranks, folder, *words, **more):
        started = self.start(ranks, folder, *words, **more)
        output, errors = self.end_of(started)
        return started.returncode, output, errors


def kill(pid, what):
    try:
        os.kill(pid, what)
    except ProcessLookupError:
        pass


def time_of_history(folder):
    """Of its last whole line, in seconds; 0 without one."""
    try:
        lines = (folder / "history.csv").read_text().split("\n")[:-1]
    except FileNotFoundError:
        return 0
    if len(lines) < 2:
        return 0
    return float(lines[-1].split(",")[lines[0].split(",").index("time [s]")])


def time_of_checkpoint(file):
    with h5py.File(file) as state:
        return float(state["state/formulation/time"][0])


def checkpoints_of(folder):
    return sorted((folder / "checkpoints").glob("*.h5"))


class Trials:
    """Runs of one scene; `scratch` is for them alone."""

    def __init__(self, program, scratch, seed):
        self.program, self.scratch, self.random = program, pathlib.Path(scratch), random.Random(seed)
        self.expected, self.seconds = {}, {}

    def uninterrupted(self, ranks):
        if ranks not in self.expected:
            folder = self.scratch / f"uninterrupted_{ranks}"
            begin = time.monotonic()
            status, output, errors = self.program.run(ranks, folder, "--overwrite")
            if status != 0:
                raise RuntimeError(f"the run without faults ends with {status}: {output}{errors}")
            self.seconds[ranks] = time.monotonic() - begin
            self.expected[ranks] = results_of(folder)
        return self.expected[ranks]

    def empty_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.scratch)) / "run"

    def moment(self, ranks):
        """Any moment of the run, its start and end included."""
        self.uninterrupted(ranks)
        return self.random.uniform(0, 1.05 * self.seconds[ranks])

    @staticmethod
    def wait_for(started, happens):
        """Until it happens or the program has ended."""
        end = time.monotonic() + PATIENCE
        while started.poll() is None and time.monotonic() < end and not happens():
            time.sleep(0.001)

    # ---- what a fault leaves behind, and what becomes of it

    def whole_files(self, folder):
        """How many files are complete; all whose name says so have to be."""
        count = 0
        for path in [*folder.glob("snapshots/*.h5"), *checkpoints_of(folder)]:
            with h5py.File(path) as file:
                if "complete" not in file.attrs:
                    raise Lost(f"{path.name} is not whole")
            count += 1
        for path in folder.glob("*.xdmf"):
            xml.etree.ElementTree.parse(path)
            count += 1
        return count

    def expect_same(self, ranks, folder):
        wrong = difference(self.uninterrupted(ranks), results_of(folder))
        if wrong:
            raise Lost(f"{wrong} is not that of a run without faults")

    def take_up(self, ranks, folder):
        """Goes on, or begins again where there is nothing to go on from."""
        found = checkpoints_of(folder)
        words = ["--restart"] if found else ["--overwrite"]
        status, output, errors = self.program.run(ranks, folder, *words)
        if status != 0:
            raise Lost(f"{words[0]} ends with {status}: {errors.strip()}")
        if found and (f"goes on from {found[-1]}" not in output):
            raise Lost(f"passes over {found[-1].name}: {output}{errors}")

    def judge(self, fault, ranks, folder, status, message="", to=None):
        """`to`: a folder in which the run goes on, where its own has no room."""
        files, done = self.whole_files(folder), time_of_history(folder)
        found = checkpoints_of(folder)
        kept = time_of_checkpoint(found[-1]) if found else 0.0
        if to is not None:
            shutil.copytree(folder, to)
            folder = to
        if status != 0:
            self.take_up(ranks, folder)
        self.expect_same(ranks, folder)
        lost = max(0.0, done - kept) / time_of_history(folder) if status != 0 else 0.0
        shutil.rmtree(folder.parent)
        return Outcome(fault, ranks, status, lost, files, message)

    @staticmethod
    def message_of(errors, folder):
        """The line that says what failed; libraries say things before it, the launcher behind it."""
        found = [line for line in errors.splitlines() if line.startswith(str(folder))]
        if not found or "Process received signal" in errors:
            raise Lost(f"no message that begins with a file: {errors}")
        return found[0].replace(str(folder), "FOLDER")
