"""Measures the largest CFL that each shape function, scheme and update order bears.

    critical_cfl.py MPM_PAR [--method NAME ...] [--write]

Scenes, each by bisection to 3 %, within what numerics.cfl may be:

    bar       rings, its free end at the worst place past a node: the energy gains less than 5 %
    corner    a free block creeps diagonally through cells with a whisper of noise in it: the
              largest elastic energy of the last tenth stays below ten times that of the first
    corner_nu the same at Poisson's ratio 0.49
    drift     a block without an end drifts through 32 cells: the same
    crush     a honeycomb is crushed to 60 % at 50 m/s: the energy gains less than 2 %

--write puts them into critical_cfl.json, from which page.py makes its table; those of other methods
stay. 0 is: no CFL down to 0.05 is borne.
"""
import argparse
import json
import tempfile
from pathlib import Path

from atlas import HERE, TABLE, numerics_of
from figures import Scene, energies, growth, history
import scene_run

FILE = HERE / "critical_cfl.json"
LOWEST, HIGHEST = 0.05, 3.0  # the range that is looked at; a scene takes none above 3


def quiet_gain(bound):
    return lambda lines: energies(lines)["gain"] < bound


def whisper_stays(lines):
    return growth(lines) < 10


SCENES = {  # file, settings, what must hold
    "bar": ("bar.yaml", [], quiet_gain(0.05)),
    "corner": ("corner.yaml", [], whisper_stays),
    "corner_nu": ("corner.yaml", ["material.poisson_ratio=0.49"], whisper_stays),
    "drift": ("dense_drift.yaml", [], whisper_stays),
    "crush": ("honeycomb.yaml", ["loading.speed=50 m/s"], quiet_gain(0.02))}


def run(mpm_par, scene, settings, method, cfl, folder):
    """Whether the run ended."""
    settings = settings + [f"numerics.{key}={value}" for key, value in numerics_of(method).items()]
    settings += ["output.snapshots=0"] + ([] if cfl is None else [f"numerics.cfl={cfl:.6g}"])
    return scene_run.ended_or_stopped(mpm_par, HERE / "scenes" / scene, folder, settings,
                                      "--overwrite").returncode == 0


def largest(bears, start):
    """Between LOWEST and HIGHEST, from `start` on in strides of a third; where what is borne is not
    one piece, the end of the piece that is met first."""
    low = high = start
    if bears(start):
        while low == high:
            if low == HIGHEST:
                return low
            high = min(4 / 3 * low, HIGHEST)
            low = high if bears(high) else low
    else:
        while low == high:
            if low < LOWEST:
                return 0.0
            low = 3 / 4 * high
            high = high if bears(low) else low
    while high / low > 1.03:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if bears(middle) else (low, middle)
    return low


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("mpm_par", type=Path)
    arguments.add_argument("--method", nargs="+", help="as in table.json; all unless given")
    arguments.add_argument("--write", action="store_true")
    given = arguments.parse_args()
    table = json.loads(TABLE.read_text())
    methods = table["methods"]["all"] + table["methods"]["orders"]
    measured = json.loads(FILE.read_text())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for method in given.method or methods:
            run(given.mpm_par, "bar.yaml", [], method, None, folder)
            found = {"default": float(f"{Scene(folder).cfl:.3g}")}
            for key, (scene, settings, sound) in SCENES.items():
                def bears(cfl):
                    return (run(given.mpm_par, scene, settings, method, cfl, folder)
                            and sound(history(folder)))
                found[key] = float(f"{largest(bears, found['default']):.2g}")
            print(f"{method:<20}", found, flush=True)
            measured[method] = found
    if given.write:
        FILE.write_text("{\n" + ",\n".join(f'  "{method}": {json.dumps(found)}'
                                           for method in methods if (found := measured.get(method)))
                        + "\n}\n")


if __name__ == "__main__":
    main()
