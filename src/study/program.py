"""mpm_par as a process: what it is, what it says of a scene, and runs of it that are measured.

Imports nothing large: Linux counts the memory of a process before exec, which is this one's, into
the child's peak.
"""
import dataclasses
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import time

from problems import InputError


@dataclasses.dataclass
class Ended:
    """How a run ended and what it took."""
    exit_status: int  # negative: the signal that ended it
    message: str  # empty if it ended well
    elapsed_seconds: float  # of the whole program
    cpu_seconds: float  # of all ranks, waiting for messages included
    peak_memory_bytes: int  # resident, of the largest process
    stopped: bool  # past the limit of time


def _message(error_output, exit_status):
    """What mpm_par said of its end: its first line that is no remark of the launcher."""
    lines = [line.strip() for line in error_output.splitlines()]
    said = [line for line in lines if line and not line.startswith(("---", "warning:", "info:"))]
    if said:
        return said[0]
    return f"ended by signal {-exit_status}" if exit_status < 0 else "without a message"


class Program:
    """The executable, and how its ranks are started.

    mpiexec: the command, as a list of words, to which the number of ranks is appended."""

    def __init__(self, path, mpiexec):
        # A name alone would be looked for in PATH.
        self.path = pathlib.Path(shutil.which(path) or path).absolute()
        self.mpiexec = mpiexec
        if not os.access(self.path, os.X_OK):
            raise InputError(f"{self.path}: is no program. Build mpm_par, or name it in MPM_PAR.")
        told = subprocess.run([self.path, "--version"], capture_output=True, text=True)
        if told.returncode != 0:
            raise InputError(f"{self.path}: --version fails ({told.stderr.strip()[:300]}). "
                             "Build mpm_par anew.")
        self.version = dict(line.split(maxsplit=1) for line in told.stdout.splitlines()
                            if len(line.split()) > 1)
        self.identity = hashlib.sha256(self.path.read_bytes()).hexdigest()

    def _words(self, scene, assignments):
        words = [str(self.path), str(scene)]
        for key, value in assignments:
            words += ["--set", f"{key}={value}"]
        return words

    def check(self, scene, assignments):
        """What mpm_par finds wrong with this scene as it reads it and lays it out, a line each; none
        if there is nothing. It makes no step."""
        checked = subprocess.run(self._words(scene, assignments) + ["--check", "--quiet"],
                                 capture_output=True, text=True)
        return checked.stderr.splitlines() if checked.returncode else []

    def run(self, scene, assignments, ranks, folder, time_limit=None):
        """Runs to the end; results in `folder`, what it printed in `folder`.log."""
        words = [*self._words(scene, assignments), "--output", str(folder), "--overwrite"]
        if ranks > 1:
            if not shutil.which(self.mpiexec[0]):
                raise InputError(f"{self.mpiexec[0]}: not found, and ranks is {ranks}. "
                                 "Name the MPI launcher in MPM_MPIEXEC.")
            words = [*self.mpiexec, str(ranks), *words]
        log = pathlib.Path(f"{folder}.log")
        with open(log, "w+", encoding="utf-8", errors="replace") as output, \
                open(f"{folder}.err", "w+", encoding="utf-8", errors="replace") as errors:
            begin = time.monotonic()
            # A session of its own: an interrupt reaches this program, which then ends the run.
            process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=errors, start_new_session=True)
            try:
                status, usage, stopped = _wait(process, begin, time_limit)
            except BaseException:
                _stop(process)
                process.wait()
                raise
            seconds = time.monotonic() - begin
            errors.seek(0)
            said = errors.read()
            output.write(said)
        os.remove(f"{folder}.err")
        code = os.waitstatus_to_exitcode(status)
        process.returncode = code
        message = "" if code == 0 else _message(said, code)
        if stopped:
            message = f"stopped after {time_limit:g} s"
        return Ended(code, message, seconds, usage.ru_utime + usage.ru_stime,
                     1024 * usage.ru_maxrss, stopped)


def _wait(process, begin, time_limit):
    """Until the process ends, which it is told to past its limit of time."""
    stopped = False
    pause = 0.005
    while time_limit:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            return status, usage, stopped
        if not stopped and time.monotonic() - begin > time_limit:
            _stop(process)
            stopped = True
        time.sleep(pause)
        pause = min(0.2, 1.2 * pause)
    _, status, usage = os.wait4(process.pid, 0)
    return status, usage, stopped


def _stop(process):
    try:
        os.killpg(process.pid, signal.SIGTERM)
    except ProcessLookupError:
        pass
