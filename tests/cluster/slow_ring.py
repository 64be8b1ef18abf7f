"""A run that takes minutes, so that a job is warned in the middle of it, and the same run in one go."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).parents[2]
sys.path.append(str(ROOT / "tests" / "regression"))
from program import mpm_par  # noqa: E402
from same_results import expect_same, results_of  # noqa: E402

RING = (ROOT / "inputs" / "benchmarks" / "crushed_ring.yaml").read_text() \
    .replace("speed: 10 m/s", "speed: 0.1 m/s") \
    .replace("history_lines: 400", "history_lines: 40000")


def expect_same_as_in_one_go(test, scene, results, ranks, of=results_of):
    """Of `results`, what a run of this scene in one go leaves beside it."""
    whole = scene.parent / "whole"
    # Where other programs use the cores, ranks that are bound to them wait for each other at each
    # of some 400,000 steps: ten times as long as the job took.
    run = mpm_par("--quiet", scene.name, "-o", whole, ranks=ranks, folder=scene.parent, timeout=480)
    test.assertEqual(run.returncode, 0, run.stderr)
    expect_same(test, whole, results, of)
