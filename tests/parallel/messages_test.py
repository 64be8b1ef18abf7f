"""A race check of the messages that are exchanged while a rank goes on computing: no memory of a message
under way is touched, and whenever messages come, the answer has the same bits."""
import os
import re
import subprocess
import unittest
from unittest import mock

from program import ProgramTest, mpm_par, scene, set_options
from same_results import expect_same, files_of

CHECKED = os.environ["MPM_CHECKED_MESSAGES"]
FIELDS = "output.fields=[velocity, stress, plastic_work, id, rank]"
RUNS = [  # ranks, scene, settings
    (2, "honeycomb", ["steps=1500", "output.snapshots={times: [0 s, 2 us]}", FIELDS]),
    (3, "honeycomb", ["steps=1500", "numerics.formulation=updated_lagrangian",
                      "numerics.repartition_interval=100", "output.snapshots={times: [0 s, 2 us]}", FIELDS]),
    (4, "squeezed_plate", ["steps=1500"]),
    (4, "two_blocks", ["steps=600", "numerics.repartition_interval=100"]),
    (3, "periodic_honeycomb", ["steps=400"]),
    (2, "confined_block_space", ["steps=200", "numerics.scheme=apic", "numerics.update_order=musl"]),
    (4, "rigid_plate_space", ["steps=200"]),
    (3, "torn_strip", ["steps=1500"]),
]


def checked(seed, delay):
    return mock.patch.dict("os.environ", {"LD_PRELOAD": CHECKED, "MPM_MESSAGES_COUNT": "yes",
                                          "MPM_MESSAGES_SEED": str(seed),
                                          "MPM_MESSAGES_DELAY": str(delay)})


class Messages(ProgramTest):
    def run_it(self, name, settings, ranks, label):
        folder = self.folder / label
        run = mpm_par(scene(name), "--output", folder, *set_options(settings), ranks=ranks)
        self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
        return run.stderr, folder

    def test_whenever_messages_come_the_answer_is_the_same(self):
        for number, (ranks, name, settings) in enumerate(RUNS):
            with self.subTest(name, ranks=ranks):
                _, plain = self.run_it(name, settings, ranks, f"{number}")
                for seed, delay in ((1, 0), (2, 300)):
                    with checked(seed, delay):
                        said, found = self.run_it(name, settings, ranks, f"{number}_{seed}")
                    counts = re.findall(r"checked messages: (\d+) sent, (\d+) received", said)
                    self.assertEqual(len(counts), ranks, said)
                    for count in counts:
                        self.assertGreater(int(count[0]), 100)
                    expect_same(self, plain, found, of=files_of)


class Checker(unittest.TestCase):
    """It sees what it is there to see."""

    def careless(self, *breach):
        with checked(1, 0):
            return subprocess.run([os.environ["MPM_MPIEXEC"], os.environ["MPM_NUMPROC_FLAG"], "2",
                                   os.environ["MPM_CARELESS_MESSAGES"], *breach],
                                  capture_output=True, text=True, timeout=60)

    def test_nothing_is_said_of_a_careful_program(self):
        run = self.careless()
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn(f"sum {1 << 16}", run.stdout)

    def test_breaches_end_the_program(self):
        for breach, words in (("changes what is sent", "was changed before it had gone"),
                              ("writes where it receives", "was written to"),
                              ("forgets", "ends with messages under way")):
            with self.subTest(breach):
                run = self.careless(breach)
                self.assertNotEqual(run.returncode, 0)
                self.assertIn(words, run.stderr)

    def test_who_reads_too_early_computes_with_nan(self):
        self.assertRegex(self.careless("reads too early").stdout, "sum -?nan")


if __name__ == "__main__":
    unittest.main()
