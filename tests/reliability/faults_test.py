"""A few of each fault; campaign.py does the same many times."""
import os
import pathlib
import shutil
import signal
import subprocess
import unittest

try:
    from faults import Faults
    from trials import Program
except ImportError as missing:
    print(f"skipped: no {missing.name}")
    raise SystemExit(0) from None

RANKS = 1, 2, 3


def may_mount():
    if os.geteuid() != 0:
        return False
    place = pathlib.Path(os.environ["MPM_SCRATCH"]) / "mounted"
    place.mkdir(parents=True, exist_ok=True)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=100k", "tmpfs", place], capture_output=True)
    if mounted.returncode == 0:
        subprocess.run(["umount", place], check=True)
    return mounted.returncode == 0


class SomeFaults(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = pathlib.Path(os.environ["MPM_SCRATCH"])
        for line in pathlib.Path("/proc/mounts").read_text().splitlines():
            if line.split()[1].startswith(str(scratch)):  # of a test that was killed
                subprocess.run(["umount", line.split()[1]], check=True)
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        cls.faults = Faults(Program(os.environ["MPM_PAR"], os.environ["MPM_MPIEXEC"],
                                    os.environ["MPM_NUMPROC_FLAG"], os.environ["MPM_FAILING_WRITES"]),
                            scratch, seed=7)

    def test_kills(self):
        for ranks in RANKS:
            for during_output in False, True:
                self.faults.kill_one_rank(ranks, during_output)
                self.faults.kill_all(ranks, during_output)

    def test_signals(self):
        for ranks, what in zip(RANKS, (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1)):
            self.faults.signalled(ranks, what)

    def test_signals_at_the_end(self):
        for what in signal.SIGTERM, signal.SIGINT, signal.SIGUSR1:
            self.faults.signalled_at_end(1, what)

    def test_time_limit(self):
        self.faults.out_of_time(2)

    def test_failing_writes(self):
        self.assertIn(4, [self.faults.failing_writes(ranks).status for ranks in (*RANKS, *RANKS)])

    def test_files_of_limited_size(self):
        outcomes = [self.faults.files_of_limited_size(ranks) for ranks in (*RANKS, *RANKS)]
        self.assertIn(4, [outcome.status for outcome in outcomes])

    def test_full_disk(self):
        if not may_mount():
            self.skipTest("no right to mount a small file system")
        self.assertIn(4, [self.faults.full_disk(ranks).status for ranks in (*RANKS, *RANKS)])

    def test_damaged_checkpoints(self):
        for ranks in (*RANKS, *RANKS):
            self.faults.damaged_checkpoint(ranks)

    def test_folder_that_cannot_be_written(self):
        if not may_mount():
            self.skipTest("no right to mount a file system without writing")
        place = self.faults.scratch / "read_only"
        place.mkdir()
        subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", place], check=True)
        try:
            for ranks in RANKS:
                status, _, errors = self.faults.program.run(ranks, place / "run")
                self.assertEqual(status, 4, errors)
                message = self.faults.message_of(errors, place)
                self.assertIn("--output", message)
        finally:
            subprocess.run(["umount", place], check=True)


if __name__ == "__main__":
    unittest.main()
