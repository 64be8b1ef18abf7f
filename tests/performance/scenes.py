"""Figures of the whole program on shipped scenes."""
import json
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from measuring import PROJECT, avx2_build, figure, instructions, run

sys.path.append(str(PROJECT / "tests" / "support"))
import scene_run  # noqa: E402

BENCHMARKS = PROJECT / "inputs" / "benchmarks"
WOOD = PROJECT / "inputs" / "wood"
UPDATED = "numerics.formulation=updated_lagrangian"  # wood is shipped with the other one
SHAPES = ("linear", "gimp", "quadratic")


def command(build, scene, folder, settings=()):
    return scene_run.command(build.mpm_par, scene, folder, settings, "--overwrite")


def one_run(build, scene, settings=(), ranks=1, oversubscribed=False, core=None):
    """The run's summary, with seconds, peak_bytes and bytes of its results added."""
    with tempfile.TemporaryDirectory() as folder:
        seconds, peak = run(command(build, scene, folder, settings), ranks, oversubscribed,
                            core)
        summary = json.loads((Path(folder) / "summary.json").read_text())
        snapshots = [file.stat().st_size for file in Path(folder).glob("snapshots/*.h5")]
    return {**summary, "seconds": seconds, "peak_bytes": peak, "snapshot_bytes": sum(snapshots)}


def runs(build, repeat, *arguments, **more):
    return [one_run(build, *arguments, **more) for _ in range(repeat)]


def each(results, key):
    return [result[key] for result in results]


def in_turn(build, repeat, scene, settings=(), numbers=(1, 2)):
    """Runs on these numbers of ranks, one after the other, so that what else the machine does meets
    all of them. Number of ranks -> summaries."""
    rounds = [[one_run(build, scene, settings, ranks) for ranks in numbers] for _ in range(repeat)]
    return dict(zip(numbers, zip(*rounds)))


def speed_up(results):
    return [one["loop_seconds"] / two["loop_seconds"] for one, two in zip(results[1], results[2])]


def two_at_once(build, scene):
    """Seconds of the slower one of two runs on one rank each, which share nothing but the machine:
    half of it is the least that two ranks can take."""
    cores = range(os.cpu_count())[-2:]
    with ThreadPoolExecutor(2) as pool:
        return max(pool.map(lambda core: one_run(build, scene, core=core)["loop_seconds"], cores))


def measure_blocks(build, repeat, quick):
    """Plastic and elastic blocks on one rank, and the plastic ones on two: strong scaling."""
    rows = []
    elastic = ["material={law: isotropic, youngs_modulus: 10.6 GPa, poisson_ratio: 0.33, "
               "density: 1500 kg/m^3}"]
    for shape in SHAPES[1:2] if quick else SHAPES:
        scene = BENCHMARKS / f"block_{shape}.yaml"
        results = in_turn(build, repeat, scene, numbers=(1,) if quick else (1, 2))
        unit = "ns/particle/step"
        rows.append(figure(f"block {shape}", each(results[1], "ns_per_particle_step"), unit))
        if quick:
            continue
        rows.append(figure(f"block {shape}, elastic",
                           each(runs(build, repeat, scene, elastic), "ns_per_particle_step"), unit))
        rows.append(figure(f"block {shape}, 2 ranks", each(results[2], "ns_per_particle_step"),
                           "ns/particle/step x ranks"))
        rows.append(figure(f"block {shape}, speed-up on 2 ranks", speed_up(results), "1", "ratio"))
    return rows


def measure_wood(build, repeat, quick):
    """Full runs of the updated Lagrangian step, from first to last, on two ranks: with its default,
    and with the functions that bear the longest step, these on one rank in turn, so that what else
    the machine does meets both."""
    rows = []
    steps = ["steps=500"] if quick else []
    stored = "specimen.sampling=threshold"  # the particles of the stored figures
    for scene in ("loblolly_radial",) if quick else ("loblolly_radial", "ponderosa_tangential"):
        for shape, numbers in (("gimp", (2,)), ("quadratic", (1, 2))):
            settings = [UPDATED, f"numerics.shape_function={shape}", stored, *steps]
            results = in_turn(build, repeat, WOOD / f"{scene}.yaml", settings, numbers)
            name = f"{scene}, {shape}{', first 500 steps' * quick}"
            for ranks, summaries in results.items():
                label = f"{name}, {ranks} rank{'s'[:ranks > 1]}"
                rows += [figure(f"{label}: loop", each(summaries, "loop_seconds"), "s"),
                         figure(f"{label}: whole program", each(summaries, "seconds"), "s"),
                         figure(f"{label}: per step", each(summaries, "ns_per_particle_step"),
                                "ns/particle/step x ranks")]
            if len(numbers) == 2:
                rows.append(figure(f"{name}: speed-up on 2 ranks", speed_up(results), "1", "ratio"))
            last = results[2][-1]
            rows += [figure(f"{name}: steps", [last["steps"]], "1", "count"),
                     figure(f"{name}: largest energy error",
                            [100 * last["largest_energy_error"]], "%", "count")]
    return rows


COUNTERS = {"migrated": "particles", "messages_per_step": "1", "bytes_per_step": "B",
            "imbalance": "1", "mean_imbalance": "1", "repartitions": "1"}


def measure_ranks(build, repeat, quick):
    """A block that fills half of its domain: time on one and two ranks; on more ranks than there
    are cores counts only, as times would mean nothing there."""
    scene = BENCHMARKS / "one_sided.yaml"
    rounds = [(in_turn(build, 1, scene), two_at_once(build, scene)) for _ in range(repeat)]
    alone, pair = ([results[ranks][0] for results, _ in rounds] for ranks in (1, 2))
    rows = [figure("one-sided block, 1 rank", each(alone, "ns_per_particle_step"),
                   "ns/particle/step"),
            figure("one-sided block, 2 ranks", each(pair, "ns_per_particle_step"),
                   "ns/particle/step x ranks"),
            figure("one-sided block, speed-up on 2 ranks", speed_up({1: alone, 2: pair}), "1",
                   "ratio"),
            figure("one-sided block, speed-up of two runs that share nothing",
                   [2 * one["loop_seconds"] / both for one, (_, both) in zip(alone, rounds)], "1",
                   "ratio"),
            figure("one-sided block, efficiency against two runs that share nothing",
                   [both / 2 / two["loop_seconds"] for two, (_, both) in zip(pair, rounds)], "1",
                   "ratio"),
            figure("one-sided block, 2 ranks: waiting", each(pair, "waiting_seconds"), "s", "count")]
    for ranks in (2,) if quick else (1, 2, 3, 4):
        result = one_run(build, scene, ranks=ranks, oversubscribed=True)
        rows.append(figure(f"one-sided block, {ranks} rank{'s'[:ranks > 1]}: largest rank",
                           [result["largest_rank_bytes"]], "B", "count"))
        rows += [figure(f"one-sided block, {ranks} rank{'s'[:ranks > 1]}: {counter}",
                        [result[counter]], unit, "count") for counter, unit in COUNTERS.items()]
    return rows


def measure_instructions(build, _repeat, quick):
    """Instructions do not depend on who else uses the machine: the difference of two runs of a
    small block, per particle and step."""
    if quick:
        return []  # needs a second build
    build = avx2_build(build)
    steps = (10, 30)
    rows = []
    for shape in SHAPES:
        counts = []
        for number in steps:
            with tempfile.TemporaryDirectory() as folder:
                counts.append(instructions(command(build, BENCHMARKS / f"block_{shape}.yaml", folder,
                                                   ["grid.cells=[40, 40]", f"steps={number}"])))
        if None in counts:
            return []
        per_step = (counts[1] - counts[0]) / (40 * 40 * 4 * (steps[1] - steps[0]))
        rows.append(figure(f"block {shape}, AVX2: instructions", [per_step],
                           "instructions/particle/step", "instructions"))
    return rows
