"""Jobscripts for PBS, with a stand-in for qsub that keeps what it is asked for: what they do with
a run that ends early, goes on, fails or is cancelled."""
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

from slow_ring import RING, ROOT, expect_same_as_in_one_go
from same_results import files_of

SCRATCH = pathlib.Path(os.environ["MPM_SCRATCH"])
# -v: the variables that it names, as they are.
QSUB = f"""#!{sys.executable}
import json, os, sys
*_, names, script = sys.argv
asked = {{"words": sys.argv[1:], "script": script,
         "environment": {{name: os.environ[name] for name in names.split(",")
                         if name in os.environ}}}}
with open("asked.json", "x") as file:
    json.dump(asked, file)
"""
PETSC_LOG = "PETSc Performance Summary"


class PbsTest(unittest.TestCase):
    def setUp(self):
        self.folder = SCRATCH / self.id().split(".")[-1]
        shutil.rmtree(self.folder, ignore_errors=True)
        (self.folder / "bin").mkdir(parents=True)
        self.program("bin/qsub", QSUB)
        (self.folder / "nodes").write_text(2 * f"{socket.gethostname()}\n")
        self.scene = self.folder / "ring.yaml"
        self.scene.write_text(RING)

    def program(self, name, text):
        path = self.folder / name
        path.write_text(text)
        path.chmod(0o755)
        return path

    def start(self, script, number, **variables):
        """As PBS would."""
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
                       "PBS_O_WORKDIR": str(self.folder), "PBS_JOBID": f"{number}.server",
                       "PBS_NODEFILE": str(self.folder / "nodes"), "SCENE": "ring.yaml",
                       "MPM_JOBSCRIPTS": str(ROOT / "jobscripts"), "TIME_LIMIT": "0.6 s",
                       **variables}
        return subprocess.Popen(["bash", ROOT / "jobscripts" / script], cwd="/", text=True,
                                env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def run_it(self, *arguments, status, **variables):
        job = self.start(*arguments, **variables)
        said, _ = job.communicate(timeout=120)
        self.assertEqual(job.returncode, status, said)
        return said

    def asked(self):
        """What qsub was asked for since the last time; None if it was not."""
        file = self.folder / "asked.json"
        if not file.exists():
            return None
        asked = json.loads(file.read_text())
        file.unlink()
        return asked

    def goes_on(self, script):
        arguments = {"ARGUMENTS": "--set 'title=The ring, crushed' -log_view --overwrite"}
        said = self.run_it(script, 12, status=0, **arguments)
        self.assertIn(PETSC_LOG, said)
        asked = self.asked()
        self.assertTrue(asked, said)
        self.assertEqual(asked["script"], str(ROOT / "jobscripts" / script))
        results = self.folder / "results" / "ring-12"
        [checkpoint] = (results / "checkpoints").glob("*.h5")
        (results / "checkpoints" / "my_copy.h5").touch()
        # An end that may change, so that the second job reaches it.
        self.scene.write_text(RING + f"steps: {int(checkpoint.stem) + 200}\n")
        said = self.run_it(script, 13, status=0, **{**asked["environment"], "TIME_LIMIT": "1 h"})
        self.assertIn(f"goes on from results/ring-12/checkpoints/{checkpoint.name}", said)
        self.assertIn(PETSC_LOG, said)
        self.assertIsNone(self.asked())
        self.assertEqual(list(results.glob("begun_by_job_*")), [])
        expect_same_as_in_one_go(self, self.scene, results, 2, of=files_of)
        self.assertIn("The ring, crushed", (results / "scene.yaml").read_text())

    def test_out_of_time_a_job_submits_itself_and_goes_on(self):
        self.goes_on("one_node.pbs")

    def test_on_many_nodes_too(self):
        self.goes_on("many_nodes.pbs")

    def test_it_submits_the_script_and_the_launcher_that_it_was_submitted_with(self):
        copy = self.folder / "my_cluster.pbs"
        shutil.copyfile(ROOT / "jobscripts" / "one_node.pbs", copy)
        self.run_it(copy, 12, status=0, MPM_LAUNCH="env")
        asked = self.asked()
        self.assertEqual(asked["script"], str(copy))
        self.assertEqual(asked["environment"]["MPM_LAUNCH"], "env")
        self.run_it("one_node.pbs", 13, status=0, JOBSCRIPT=str(copy))
        asked = self.asked()
        self.assertEqual([asked["script"], asked["environment"]["JOBSCRIPT"]], 2 * [str(copy)])

    def test_it_goes_on_from_its_own_checkpoint_whichever_it_began_with(self):
        self.run_it("one_node.pbs", 12, status=0)
        begun = self.asked()["environment"]
        results = self.folder / "results" / "ring-12"
        [checkpoint] = (results / "checkpoints").glob("*.h5")
        begun["ARGUMENTS"] = f"--restart {checkpoint.relative_to(self.folder)} --quiet"
        self.scene.write_text(RING + f"steps: {int(checkpoint.stem) + 200}\n")
        self.run_it("one_node.pbs", 13, status=0, **{**begun, "TIME_LIMIT": "1 h"})
        self.assertTrue((results / "summary.json").exists())

    def test_without_progress_it_does_not(self):
        stuck = self.program("stuck", "#!/bin/sh\nexit 75\n")
        said = self.run_it("one_node.pbs", 1, status=75, MPM_PAR=str(stuck), MPM_LAUNCH="env")
        self.assertIn("nothing was won", said)
        self.assertIsNone(self.asked())

    def test_other_ends_are_those_of_the_job(self):
        self.scene.write_text(RING.replace("youngs_modulus", "youngs_modulas"))
        said = self.run_it("one_node.pbs", 1, status=2)
        self.assertIn("did you mean 'youngs_modulus'?", said)
        self.assertIn("which scene?", self.run_it("one_node.pbs", 1, status=1, SCENE=""))
        self.assertIn("MPM_PAR", self.run_it("one_node.pbs", 1, status=1, MPM_PAR="no/program"))
        self.assertIsNone(self.asked())

    def test_cancelled_it_does_not_submit_itself(self):
        job = self.start("one_node.pbs", 7, TIME_LIMIT="1 h", MPM_LAUNCH="env")
        history = self.folder / "results" / "ring-7" / "history.csv"
        while not history.exists() and job.poll() is None:
            time.sleep(0.05)
        job.send_signal(signal.SIGTERM)
        said, _ = job.communicate(timeout=60)
        self.assertEqual(job.returncode, 75, said)
        self.assertIsNone(self.asked())


if __name__ == "__main__":
    unittest.main()
