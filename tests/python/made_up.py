"""Folders of results that no run has written: small, and broken where a test wants it."""
import json
import pathlib

import h5py
import numpy

HISTORY = """\
time [s],strain [1],stress [Pa],stress_piston [Pa],stress_edge [Pa],kinetic_energy [J],\
elastic_energy [J],plastic_work [J],external_work [J],energy_error [1],particles [1]
0,0,0,0,0,0,0,0,0,0,4
1e-6,0.05,2e6,2e6,2e6,0.1,0.5,0.4,1,0,4
2e-6,0.1,4e6,4e6,4e6,0.1,1,1.9,3,0,4
"""
SCENE = """\
title: Made up
name: made_up
material: {law: von_mises, youngs_modulus: 10 GPa}
specimen: {size: [4 mm, 1 mm], windows: []}
numerics: {formulation: updated_lagrangian, thickness: 2 m}
loading: {piston: right, strain: 0.1}
"""


def write_snapshot(path, strain, work=(0.0, 0.1, 0.2, 0.3), complete=1):
    """Four squares of 1 mm in a row, 2 m thick, squeezed evenly."""
    path.parent.mkdir(parents=True, exist_ok=True)
    position = numpy.zeros((4, 3))
    position[:, 0] = (numpy.arange(4) + 0.5) * 1e-3 * (1 - strain)
    position[:, 1] = 0.5e-3
    with h5py.File(path, "w") as file:
        file.attrs.update({"time": strain * 2e-5, "strain": strain, "step": int(1000 * strain),
                           "particle_volume": 2e-6, "complete": complete})
        for name, unit, values in (("position", "m", position), ("plastic_work", "J",
                                                                 numpy.array(work)),
                                   ("id", "1", numpy.arange(4))):
            file[f"particles/{name}"] = values
            file[f"particles/{name}"].attrs["unit"] = unit


def write_series(folder, count):
    grids = "".join(f'<Grid><Geometry><DataItem>snapshots/{k:06}.h5:/particles/position</DataItem>'
                    "</Geometry></Grid>" for k in range(count))
    (folder / "made_up.xdmf").write_text(f"<Xdmf><Domain><Grid>{grids}</Grid></Domain></Xdmf>")


def write_run(folder, snapshots=2):
    """A whole one."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "history.csv").write_text(HISTORY)
    (folder / "scene.yaml").write_text(SCENE)
    (folder / "summary.json").write_text(json.dumps({"name": "made_up", "size": [4e-3, 1e-3]}))
    for k in range(snapshots):
        write_snapshot(folder / "snapshots" / f"{k:06}.h5", 0.1 * k)
    if snapshots:
        write_series(folder, snapshots)
    return folder
