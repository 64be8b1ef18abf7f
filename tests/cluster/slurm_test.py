"""Jobscripts with a real Slurm: a job that is warned writes a checkpoint, goes back into the queue
and goes on with the same bits; one that cannot go on does not."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import private_slurm
from slow_ring import RING, ROOT, expect_same_as_in_one_go

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
SECONDS = 540  # CTest ends the test later, and then nobody would take the daemons down.
SCENE = RING + "numerics: {formulation: total_lagrangian}\n"
# In the log: the plan, progress, and what mpirun says of every status but 0.
OF_NO_USE = r" *\d+ %|  |-----|Primary job|a non-zero|mpirun detected|the job to be|\Z"
STUDY = """scene: scene.yaml
set: {steps: 40}
vary: {loading.speed: [10 m/s, 20 m/s, 30 m/s]}
error: {name: end, of: steps, against: finest}
"""


def log(words):
    print(f"{time.strftime('%H:%M:%S')}  {words}", file=sys.stderr, flush=True)


class SlurmTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        signal.signal(signal.SIGALRM, cls.too_late)
        signal.alarm(SECONDS)
        cls.slurm = cls.enterClassContext(private_slurm.PrivateSlurm())

    @staticmethod
    def too_late(*_):
        raise AssertionError(f"the test has taken more than {SECONDS} s")

    def setUp(self):
        self.folder = SCRATCH / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.scene = self.folder / "scene.yaml"
        self.scene.write_text(SCENE)
        self.environment = {"MPM_PAR": os.environ["MPM_PAR"], "MPM_LAUNCH": "mpirun",
                            "MPM_JOBSCRIPTS": str(ROOT / "jobscripts"),
                            "SCRATCH": str(self.folder)}

    def tearDown(self):
        for file in sorted(self.folder.glob("*.out")):
            log(f"{file.name}:\n" + "".join(
                f"    {line}\n" for line in file.read_text().splitlines()
                if not re.match(OF_NO_USE, line)))

    def submit(self, script, *words, options=()):
        return self.slurm.submit(*options, ROOT / "jobscripts" / script, *words,
                                 folder=self.folder, environment=self.environment)

    def results(self, job):
        return self.folder / f"scene-{job}"

    def checkpoints(self, job):
        return sorted((self.results(job) / "checkpoints").glob("*.h5"))

    def wait_for_lines(self, job, lines=12):
        history = self.results(job) / "history.csv"
        self.slurm.wait(lambda: history.exists() and history.read_bytes().count(b"\n") > lines,
                        40, "no history")

    def end_soon(self, job):
        """The run, which would take minutes, ends some steps after its checkpoint: an end is what
        may change in a scene."""
        steps = int(self.checkpoints(job)[-1].stem) + 300
        self.scene.write_text(SCENE + f"steps: {steps}\n")
        return steps

    def expect_same_as_in_one_go(self, job, ranks):
        expect_same_as_in_one_go(self, self.scene, self.results(job), ranks)
        log(f"results of job {job} are those of a run in one go, to the last digit")

    def expect_end(self, job, state, status, restarts):
        [found] = self.slurm.wait_for_end(job, 120)
        log(f"job {job}: {found['JobState']}, exit status {found['ExitCode']}, "
            f"queued again {found['Restarts']} times")
        self.assertEqual((found["JobState"], found["ExitCode"], found["Restarts"]),
                         (state, status, str(restarts)))

    def warned_by_slurm(self, launch, script, ranks, *options):
        """By --signal, at its next look at the limits of time, every half minute."""
        self.environment["MPM_LAUNCH"] = launch
        job = self.submit(script, self.scene.name,
                          options=("--time=1", "--signal=B:USR1@20", *options))
        log(f"job {job}: {script} {' '.join(options)} --time=1 --signal=B:USR1@20, with {launch}")
        self.slurm.wait(lambda: self.checkpoints(job), 100, "no checkpoint")
        log(f"job {job}: checkpoint {self.checkpoints(job)[-1].name}")
        self.end_soon(job)
        self.expect_end(job, "COMPLETED", "0:0", 1)
        self.expect_same_as_in_one_go(job, ranks)

    def test_warned_by_slurm_goes_on(self):
        self.warned_by_slurm("srun --mpi=pmix", "many_nodes.slurm", 2, "--nodes=1",
                             "--ntasks-per-node=2")

    def test_warned_twice_goes_on_twice(self):
        job = self.submit("one_node.slurm", self.scene.name, "--overwrite", options=("--ntasks=2",))
        lines = 0
        for attempt in range(2):
            before = self.checkpoints(job)
            self.wait_for_lines(job, lines + 12)
            self.slurm.ask("scancel", "--batch", "--signal=USR1", job)
            self.slurm.wait(lambda: self.checkpoints(job)[-1:] != before[-1:], 30, "no checkpoint")
            log(f"job {job}: warned, checkpoint {self.checkpoints(job)[-1].name}")
            self.slurm.wait(lambda: self.slurm.job(job)[0]["Restarts"] == str(attempt + 1), 60,
                            "not queued again")
            lines = (self.results(job) / "history.csv").read_bytes().count(b"\n")
        self.end_soon(job)
        self.expect_end(job, "COMPLETED", "0:0", 2)
        self.expect_same_as_in_one_go(job, 2)

    def test_without_progress_it_is_not_queued_again(self):
        stuck = self.folder / "stuck"
        stuck.write_text("#!/bin/bash\ntrap 'exit 75' USR1\nwhile :; do sleep 0.1; done\n")
        stuck.chmod(0o755)
        self.environment.update(MPM_PAR=str(stuck), MPM_LAUNCH="env")
        job = self.submit("one_node.slurm", self.scene.name, options=("--ntasks=1",))
        output = self.folder / f"mpm_par-{job}.out"
        self.slurm.wait(lambda: output.exists() and "results in" in output.read_text(), 20,
                        "no start")
        time.sleep(1)
        self.slurm.ask("scancel", "--batch", "--signal=USR1", job)
        self.expect_end(job, "FAILED", "75:0", 0)
        self.assertIn("nothing was won", output.read_text())

    def test_other_ends_are_those_of_the_job(self):
        self.scene.write_text(SCENE.replace("youngs_modulus", "youngs_modulas"))
        job = self.submit("one_node.slurm", self.scene.name, options=("--ntasks=2",))
        self.expect_end(job, "FAILED", "2:0", 0)
        self.scene.write_text(SCENE)
        job = self.submit("one_node.slurm", self.scene.name, options=("--ntasks=2",))
        self.wait_for_lines(job)
        self.slurm.ask("scancel", job)
        [found] = self.slurm.wait_for_end(job, 60)
        self.assertEqual((found["JobState"], found["Restarts"]), ("CANCELLED", "0"))

    def test_array_over_the_runs_of_a_study(self):
        (self.folder / "study.yaml").write_text(STUDY)
        job = self.submit("study_array.slurm", "study.yaml", options=("--array=1-2", "--ntasks=1"))
        found = self.slurm.wait_for_end(job, 60)
        self.assertEqual([task["JobState"] for task in found], ["COMPLETED"] * 2, self.slurm.logs())
        study = pathlib.Path(os.environ["MPM_PAR"]).with_name("mpm_study")
        words = [study, "study.yaml", "--output", self.folder / "study"]
        last = subprocess.run(words, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(last.returncode, 0, last.stderr)
        self.assertIn("3 runs were done before", last.stdout)
        self.assertTrue((self.folder / "study" / "study.csv").exists())
        log(f"job {job}: two tasks, three runs, tables by mpm_study from what they left")


if __name__ == "__main__":
    reason = private_slurm.why_not()
    if reason:
        print(f"skipped: {reason}")
        sys.exit(0)
    unittest.main()
