"""Jobs that a scheduler starts once more under their own number, without a scheduler: the scripts for
Slurm and PBS go on with the job's own run, and leave alone what others have left in its folder."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time
import unittest

from slow_ring import RING, ROOT
from same_results import all_of

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
SHORT = RING + "steps: 60\n"
WITH_CHECKPOINTS = RING.replace("snapshots: 0", "snapshots: 0, checkpoints: {steps: 40}")
FOREIGN = "holds the results of a run"
HOST = socket.gethostname()


class Requeued:
    """What holds for each `script`."""

    def setUp(self):
        self.folder = SCRATCH / self.script / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        (self.folder / "nodes").write_text(HOST + "\n")
        self.results = self.folder / "results"

    def start(self, number, *words, scene=SHORT, **variables):
        """Job `number` on RESULTS as either scheduler would start it once more, on one rank, without
        a launcher."""
        (self.folder / "ring.yaml").write_text(scene)
        slurm = {"SLURM_JOB_ID": str(number), "SLURM_RESTART_COUNT": "1", "SLURM_NTASKS": "1",
                 "SLURM_JOB_NODELIST": HOST}
        pbs = {"PBS_JOBID": f"{number}.server", "PBS_O_WORKDIR": str(self.folder),
               "PBS_NODEFILE": str(self.folder / "nodes"), "TIME_LIMIT": "1 h",
               "SCENE": "ring.yaml", "ARGUMENTS": " ".join(words)}
        is_slurm = self.script.endswith(".slurm")
        return subprocess.Popen(
            ["bash", ROOT / "jobscripts" / self.script, *(["ring.yaml", *words] if is_slurm else [])],
            cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            start_new_session=True,
            env={**os.environ, "RESULTS": "results", "MPM_LAUNCH": "env",
                 "MPM_JOBSCRIPTS": str(ROOT / "jobscripts"), **(slurm if is_slurm else pbs),
                 **variables})

    def run_it(self, number, *words, status=0, **more):
        job = self.start(number, *words, **more)
        said, _ = job.communicate(timeout=120)
        self.assertEqual(job.returncode, status, said)
        return said

    def cut_off(self, number, *words, at, **more):
        """As by a node that fails, once there is a file like `at`."""
        job = self.start(number, *words, **more)
        end = time.monotonic() + 60
        while not list(self.folder.glob(at)) and time.monotonic() < end:
            time.sleep(0.02)
        os.killpg(job.pid, signal.SIGKILL)
        said, _ = job.communicate(timeout=60)
        self.assertTrue(list(self.folder.glob(at)), said)

    def marks(self):
        return list(self.results.glob("begun_by_job_*"))

    def left(self):
        """In the folder of results, beside marks of jobs."""
        return {path: content for path, content in all_of(self.results).items()
                if not path.startswith("begun_by_job_")}

    def run_of_another(self):
        self.run_it(1, scene=WITH_CHECKPOINTS + "steps: 60\n")
        self.assertEqual(self.marks(), [])
        return self.left()

    def test_it_leaves_alone_a_folder_in_which_it_has_not_begun(self):
        before = self.run_of_another()
        for _ in range(2):  # refused, it has not begun
            self.assertIn(FOREIGN, self.run_it(12, status=2))
            self.assertEqual((self.left(), self.marks()), (before, []))

    def test_cut_off_before_its_run_began_it_does_so_too(self):
        before = self.run_of_another()
        waiting = self.folder / "waiting"
        waiting.write_text("#!/bin/sh\ntouch started\nsleep 100\n")
        waiting.chmod(0o755)
        self.cut_off(12, at="started", MPM_PAR=str(waiting))
        self.assertEqual(len(self.marks()), 1)
        self.assertIn(FOREIGN, self.run_it(12, status=2))
        self.assertEqual(self.left(), before)

    def test_cut_off_before_a_checkpoint_it_begins_anew(self):
        words = "--set", "title=Ring", "-log_view"  # the last is for PETSc
        self.cut_off(12, *words, at="results/history.csv", scene=RING)
        self.assertIn("PETSc Performance Summary", self.run_it(12, *words))
        self.assertTrue((self.results / "summary.json").exists())
        self.assertEqual(self.marks(), [])

    def test_cut_off_after_one_it_goes_on_whatever_it_began_with(self):
        self.run_it(1)  # no checkpoint
        self.cut_off(12, "--overwrite", at="results/checkpoints/*.h5", scene=WITH_CHECKPOINTS)
        last = max(self.results.glob("checkpoints/*.h5"))
        end = f"steps: {int(last.stem) + 100}\n"
        said = self.run_it(12, "--overwrite", scene=WITH_CHECKPOINTS + end)
        self.assertIn(f"goes on from results/checkpoints/{last.name}", said)

    def test_what_another_job_has_finished_there_meanwhile_is_kept(self):
        self.cut_off(12, at="results/history.csv", scene=RING)
        self.run_it(2, "--overwrite")
        before = self.left()
        self.assertIn(FOREIGN, self.run_it(12, status=2))
        self.assertEqual(self.left(), before)

    def test_a_scene_that_is_refused_leaves_no_folder_of_its_own(self):
        self.run_it(12, status=2, scene=RING.replace("youngs_modulus", "youngs_modulas"))
        self.assertEqual(self.results.exists(), self.script.startswith("many_nodes"))
        self.assertEqual(self.marks(), [])


class OneNodeOfSlurm(Requeued, unittest.TestCase):
    script = "one_node.slurm"


class ManyNodesOfSlurm(Requeued, unittest.TestCase):
    script = "many_nodes.slurm"


class OneNodeOfPbs(Requeued, unittest.TestCase):
    script = "one_node.pbs"


class ManyNodesOfPbs(Requeued, unittest.TestCase):
    script = "many_nodes.pbs"


class Arguments(unittest.TestCase):
    def gone_on_with(self, *words):
        """What becomes of the words of a job that has left a checkpoint."""
        script = """. "$0"; progress() { echo 000000000040; }; go_on_with "$@"
                    printf '%s\\n' "${arguments[@]}" """
        said = subprocess.run(["bash", "-c", script, ROOT / "jobscripts" / "job.bash", *words],
                              check=True, capture_output=True, text=True, timeout=20).stdout
        return said.splitlines()

    def test_how_it_began_is_left_away_and_all_else_kept(self):
        others = ["--set", "title=My wood", "-log_view", "--quiet"]
        for words in ([], ["--overwrite"], ["--restart"], ["--restart", "a/000000000020.h5"],
                      ["--restart=a/000000000020.h5"]):
            with self.subTest(words):
                self.assertEqual(self.gone_on_with(*others[:2], *words, *others[2:]),
                                 [*others, "--restart"])


if __name__ == "__main__":
    unittest.main()
