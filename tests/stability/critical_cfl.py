"""Measures the largest CFL that each shape function, scheme and update order bears.

    critical_cfl.py MPM_PAR [--write]

Three scenes, each by bisection to 2 %, within what numerics.cfl may be:

    bar     rings, its free end at the worst place past a node: the gain of the energy stays below 1 %
    drift   an unstressed block drifts through eight cells with a whisper of a wave in it: its
            largest elastic energy in the last tenth stays below ten times that of the first tenth
    crush   a honeycomb is crushed to 60 %: the gain of the energy stays below 2 %

--write puts them into critical_cfl.json, from which page.py makes its table. 0 is: no CFL down to
0.05 is borne.
"""
import argparse
import json
import subprocess
import tempfile
from pathlib import Path

from atlas import HERE, TABLE, keys_of
from figures import Scene, energies, history

FILE = HERE / "critical_cfl.json"
LOWEST, HIGHEST = 0.05, 2.0  # the range that is looked at; a scene takes none above 2


def quiet_gain(bound):
    return lambda lines: energies(lines)["gain"] < bound


def whisper_stays(lines):
    tenth = len(lines["time"]) // 10
    first, last = (lines["elastic_energy"][part].max()
                   for part in (slice(None, tenth), slice(-tenth, None)))
    return last < 10 * first


SCENES = {"bar": ("bar.yaml", quiet_gain(0.01)), "drift": ("seeded_drift.yaml", whisper_stays),
          "crush": ("honeycomb.yaml", quiet_gain(0.02))}


def run(mpm_par, scene, method, cfl, folder):
    """Whether the run ended."""
    settings = [f"numerics.{key}={value}" for key, value in
                zip(("shape_function", "scheme", "update_order"), keys_of(method))]
    settings += ["output.snapshots=0"] + ([] if cfl is None else [f"numerics.cfl={cfl:.6g}"])
    command = [str(mpm_par), str(HERE / "scenes" / scene), "--output", str(folder)]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        raise RuntimeError(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.returncode == 0


def largest(bears):
    """Between LOWEST and HIGHEST; where what is borne is not one piece, the end of its first one to
    within a factor of 1.4."""
    low, high = LOWEST, LOWEST
    if not bears(low):
        return 0.0
    while high < HIGHEST:
        high = min(1.4 * low, HIGHEST)
        if not bears(high):
            break
        low = high
    while low < HIGHEST and high / low > 1.02:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if bears(middle) else (low, middle)
    return low


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--write", action="store_true")
    given = arguments.parse_args()
    table = json.loads(TABLE.read_text())
    measured = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for method in table["methods"]["all"] + table["methods"]["orders"]:
            run(given.mpm_par, "bar.yaml", method, None, folder)
            found = {"default": Scene(folder).cfl}
            for key, (scene, sound) in SCENES.items():
                found[key] = round(largest(lambda cfl: run(given.mpm_par, scene, method, cfl, folder)
                                           and sound(history(folder))), 3)
            print(f"{method:<20}", found, flush=True)
            measured[method] = found
    if given.write:
        FILE.write_text("{\n" + ",\n".join(f'  "{method}": {json.dumps(found)}'
                                           for method, found in measured.items()) + "\n}\n")


if __name__ == "__main__":
    main()
