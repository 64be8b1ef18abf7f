"""The faults: each is done to a run, which then goes on; see trials.py."""
import errno
import resource
import signal
import subprocess
import time

import h5py

from trials import EVERY, Lost, Outcome, Trials, checkpoints_of, kill


class Faults(Trials):
    def kill_one_rank(self, ranks, during_output=False):
        return self._killed("kill -9 of one rank" + during_output * ", while it writes", ranks, during_output,
                            lambda pids: [self.random.choice(pids)])

    def kill_all(self, ranks, during_output=False):
        return self._killed("kill -9 of all ranks" + during_output * ", while they write", ranks, during_output,
                            lambda pids: pids)

    def _killed(self, fault, ranks, during_output, choice):
        folder = self.empty_folder()
        moment = self.moment(ranks)
        started = self.program.start(ranks, folder)
        time.sleep(moment * (0.8 if during_output else 1))
        if during_output:
            self.wait_for(started, lambda: any(folder.rglob("*.part")))
        for pid in choice(self.program.ranks_of(started) or [started.pid]):
            kill(pid, signal.SIGKILL)
        self.program.end_of(started)
        return self.judge(fault, ranks, folder, started.returncode)

    def signalled(self, ranks, what):
        """SIGUSR1 goes to the launcher, which hands it on; SIGTERM and SIGINT to the ranks, as a scheduler sends
        them: Open MPI's launcher takes them for itself, and ends the ranks a second later."""
        folder = self.empty_folder()
        moment = self.moment(ranks)
        started = self.program.start(ranks, folder)
        # Before it has begun, a signal ends a program as it ends any.
        self.wait_for(started, lambda: (folder / "history.csv").exists())
        time.sleep(0.8 * moment)
        for pid in [started.pid] if what is signal.SIGUSR1 else self.program.ranks_of(started):
            kill(pid, what)
        _, errors = self.program.end_of(started)
        status = started.returncode
        if ranks > 1 and what is signal.SIGUSR1 and status == -what and (folder / "summary.json").exists():
            status = 0  # its ranks were done, and the launcher had laid down its handlers
        if status not in (0, 75):
            raise Lost(f"ends with {status}: {errors}")
        if status == 75 and f"signal {what.value}" not in errors:
            raise Lost(f"does not name the signal: {errors}")
        return self.judge(what.name, ranks, folder, status)

    def signalled_at_end(self, ranks, what):
        """When its summary is there a run is whole, and nothing is left that a signal could end."""
        folder = self.empty_folder()
        started = self.program.start(ranks, folder)
        self.wait_for(started, lambda: (folder / "summary.json").exists())
        for pid in self.program.ranks_of(started):
            kill(pid, what)
        _, errors = self.program.end_of(started)
        if started.returncode != 0:
            raise Lost(f"ends with {started.returncode}: {errors}")
        return self.judge(f"{what.name} at the end", ranks, folder, started.returncode)

    def out_of_time(self, ranks):
        folder = self.empty_folder()
        limit = f"{1000 * self.moment(ranks):.0f} ms"
        status, _, errors = self.program.run(ranks, folder, "--time-limit", limit)
        if status not in (0, 75) or (status == 75 and "the time limit was reached" not in errors):
            raise Lost(f"ends with {status}: {errors}")
        return self.judge("--time-limit", ranks, folder, status)

    def failing_writes(self, ranks):
        """Each write of any rank into the folder fails with a small probability (failing_writes.cpp)."""
        folder = self.empty_folder()
        settings = {"LD_PRELOAD": self.program.failing_writes, "MPM_FAILING_FOLDER": folder,
                    "MPM_FAILING_SHARE": 10 ** self.random.uniform(-4, -1),
                    "MPM_FAILING_ERRNO": self.random.choice([errno.ENOSPC, errno.EIO]),
                    "MPM_FAILING_SEED": self.random.randrange(10 ** 6)}
        status, _, errors = self.program.run(
            ranks, folder, before=["env", *(f"{name}={value}" for name, value in settings.items())])
        return self.after_failure("failing write", ranks, folder, status, errors)

    def files_of_limited_size(self, ranks):
        """As `ulimit -f` does it, from when the run has begun: the ranks talk by files as well."""
        folder = self.empty_folder()
        limit = int(10 ** self.random.uniform(3, 5.3))
        started = self.program.start(ranks, folder)
        self.wait_for(started, lambda: (folder / "history.csv").exists())
        for pid in self.program.ranks_of(started):
            try:
                resource.prlimit(pid, resource.RLIMIT_FSIZE, (limit, limit))
            except ProcessLookupError:
                pass
        _, errors = self.program.end_of(started)
        return self.after_failure("files of limited size", ranks, folder, started.returncode, errors)

    def after_failure(self, fault, ranks, folder, status, errors, to=None):
        if status not in (0, 4):
            raise Lost(f"ends with {status}: {errors}")
        message = self.message_of(errors, folder) if status == 4 else ""
        return self.judge(fault, ranks, folder, status, message, to)

    def full_disk(self, ranks):
        """A file system of some hundred kilobytes; the run goes on where there is room."""
        place = self.empty_folder().parent
        size = int(10 ** self.random.uniform(4.2, 6))
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", place], check=True)
        try:
            folder = place / "run"
            status, _, errors = self.program.run(ranks, folder)
            return self.after_failure("full disk", ranks, folder, status, errors, to=self.empty_folder())
        finally:
            subprocess.run(["umount", place], check=True)

    def damaged_checkpoint(self, ranks):
        """The newest one is cut off or has a flipped bit: the run goes on from the one before."""
        folder = self.empty_folder()
        steps = self.random.randrange(3 * EVERY + 1, 10 * EVERY)
        self.program.run(ranks, folder, "--set", f"steps={steps}")
        *_, before, newest = checkpoints_of(folder)
        contents = bytearray(newest.read_bytes())
        if self.random.random() < 0.5:
            fault = "checkpoint cut off"
            contents = contents[:self.random.randrange(len(contents))]
        else:
            fault = "bit of a checkpoint flipped"
            # HDF5 leaves room between its parts, in which a bit tells nothing.
            with h5py.File(newest) as file:
                sets = []
                file.visititems(lambda _, item: sets.append(item) if isinstance(item, h5py.Dataset) else None)
                places = [(s.id.get_offset(), s.id.get_storage_size()) for s in sets
                          if s.id.get_offset() is not None]
            offset, size = self.random.choice([place for place in places if place[1] > 0])
            contents[offset + self.random.randrange(size)] ^= 1 << self.random.randrange(8)
        newest.write_bytes(contents)
        status, output, errors = self.program.run(ranks, folder, "--restart")
        if status != 0 or str(newest) not in output + errors or f"goes on from {before}" not in output:
            raise Lost(f"does not pass over {newest.name}, {fault}: {output}{errors}")
        self.expect_same(ranks, folder)
        return Outcome(fault, ranks, 0, 0.0, 0)
