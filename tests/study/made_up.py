"""Studies and rows that no program has run."""
import pathlib

from combinations import Combination
from evaluation import FAILED, OK, UNSTABLE, Row, label_of, outcome_of
from measure_keys import Measure
from study_file import Study

ALONG = "grid.cells"
SHAPE = "numerics.shape_function"


def study(measure, series=("gimp",), levels=(10, 20, 40, 80), targets=(0.01, 0.001)):
    """Cells n x n, or n x m, for each level and series."""
    pairs = [level if isinstance(level, tuple) else (level, level) for level in levels]
    runs = [Combination(((SHAPE, shape), (ALONG, f"[{n}, {m}]")), 1)
            for shape in series for n, m in pairs]
    return Study(pathlib.Path("study.yaml"), "Made up", pathlib.Path("scene.yaml"), {}, runs,
                 [SHAPE, ALONG], {}, ALONG, (ALONG,), 1, 0.05, None, [measure], list(targets))


def row(of_study, combination, value, seconds, state=OK):
    """A row as the runs leave it, before errors are taken."""
    made = Row(combination, label_of(of_study, combination), combination.value(ALONG), state,
               state if state == OK else "what went wrong", 0 if state != FAILED else 3)
    name = of_study.measures[0].name
    made.values[name] = value
    if state == FAILED:
        made.values = {}
        return made
    made.wall_seconds = made.core_seconds = made.elapsed_seconds = seconds
    made.wall_spread, made.energy_error = 0.0, 0.2 if state == UNSTABLE else 0.001
    made.particles, made.steps, made.particle_steps = 100, 10, 1e6 * seconds
    made.peak_memory_mib, made.rounds = 50.0, 1
    return made


def cells_of(combination):
    return int(combination.value(ALONG).strip("[]").split(",")[0])


def evaluated(against, values, series=("gimp",), seconds=None, states=None, targets=(0.01, 0.001),
              levels=None, **more):
    """(study, rows, outcome). values: series to list of values from coarse to fine."""
    measure = Measure("modulus", "of", path="modulus", against=against, against_text=str(against),
                      **more)
    levels = levels or [10 * 2 ** k for k in range(len(values[series[0]]))]
    made = study(measure, series, levels, targets)
    flat = [value for one in series for value in values[one]]
    rows = [row(made, run, value, (seconds or (lambda r: 1e-5 * cells_of(r) ** 3))(run),
                (states or {}).get(k, OK))
            for k, (run, value) in enumerate(zip(made.combinations, flat))]
    return made, rows, outcome_of(made, measure, rows)
