"""What a run's folder of results says about its soundness: a figure for each thing that must hold.

    gain, loss         largest surplus and deficit of the energy balance over the energy that passed
                       through so far (docs/theory.md), from where 1 % of the whole has passed
    ratio_low, _high   smallest and largest volume ratio J of any particle in any snapshot
    momentum           largest momentum_error; of free bodies over the sum of the momenta's sizes
    through            deepest a particle lies behind a wall or the piston, cells
    gap                from the piston or the edge opposite to the nearest particle, cells
    pieces             how many more pieces than at the start: cells with particles that touch
    turned             share of the angular momentum lost or won
    growth             of noise: largest elastic energy in the last tenth over that in the first
    stiffness          of a clamped beam from its first swing, over the exact one
"""
import csv
import re

import h5py
import numpy
import yaml

UNITS = {"m": 1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}
SIDES = ("left", "right", "bottom", "top", "back", "front")
SOLID = ("rigid", "symmetric")  # sides that nothing goes through


def length(text):
    value, unit = text.split()
    return float(value) * UNITS[unit]


def specimen_size(specimen):
    """Width, height and, in space, depth of what is crushed, m."""
    if "size" in specimen:
        return [length(side) for side in specimen["size"]]
    if "crop" in specimen:
        return [pixels * length(size)
                for pixels, size in zip(specimen["crop"][2:], specimen["pixel_size"])]
    return [length(side) for side in specimen["image_size"]]


class Scene:
    """What the figures need of scene.yaml."""

    def __init__(self, folder):
        scene = yaml.safe_load((folder / "scene.yaml").read_text())
        self.cfl = scene["numerics"]["cfl"]
        self.material = scene.get("material")
        specimen = scene["specimen"]
        self.loading = scene.get("loading")
        self.free_motion = scene.get("free_motion")
        self.size = numpy.array(specimen_size(specimen))
        grid = scene["grid"]
        self.cells = numpy.array(grid["cells"]) if "cells" in grid else numpy.round(
            self.size / [length(side) for side in numpy.atleast_1d(grid["spacing"])])

    def solid_sides(self):
        """Of each side whether nothing may pass it; the piston's is not among them."""
        if self.free_motion:
            return [kind in SOLID for kind in self.free_motion["sides"]]
        across = iter(self.loading["lateral"])
        axis = SIDES.index(self.loading["piston"]) // 2
        return [side // 2 == axis or next(across) in SOLID for side in range(2 * len(self.cells))]


def history(folder):
    with open(folder / "history.csv", newline="") as file:
        header, *lines = csv.reader(file)
    values = numpy.array(lines, float)
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(header)}


def snapshots(folder):
    """Positions, velocities, volume ratios and strain, in order."""
    for name in sorted((folder / "snapshots").glob("*.h5")):
        with h5py.File(name) as file:
            particles = file["particles"]
            yield (particles["position"][:], particles["velocity"][:],
                   particles["volume_ratio"][:], file.attrs["strain"])


def energies(lines):
    """gain and loss."""
    work, start = lines["external_work"], lines["kinetic_energy"][0]
    surplus = lines["energy_error"] * numpy.maximum(abs(work), start)
    passed = start + numpy.concatenate([[0], numpy.cumsum(abs(numpy.diff(work)))])
    late = passed > 0.01 * passed[-1]
    share = surplus[late] / passed[late]
    return {"gain": max(0.0, share.max()), "loss": max(0.0, -share.min())}


def pieces(position, spacing):
    """Of cells that hold particles; cells that share a corner belong together."""
    left = {tuple(cell) for cell in numpy.floor(position / spacing).astype(int)}
    around = [tuple(numpy.array(k) - 1) for k in numpy.ndindex(*[3] * len(spacing))]
    count = 0
    while left:
        count += 1
        edge = [left.pop()]
        while edge:
            cell = edge.pop()
            near = {tuple(c + k for c, k in zip(cell, step)) for step in around} & left
            left -= near
            edge.extend(near)
    return count


def faces(scene, size, strain):
    """Lower and upper face of every axis, with the piston where it is; and the piston's side."""
    lower, upper = numpy.zeros(len(size)), size.copy()
    if not scene.loading:
        return lower, upper, None
    piston = SIDES.index(scene.loading["piston"])
    if piston % 2:
        upper[piston // 2] *= 1 - strain
    else:
        lower[piston // 2] = strain * size[piston // 2]
    return lower, upper, piston


def places(scene, all_snapshots):
    """through, gap and pieces."""
    dimensions = len(scene.cells)
    first = all_snapshots[0][0][:, :dimensions]
    spacing = scene.size / scene.cells
    solid = scene.solid_sides()
    start = pieces(first, spacing)
    found = {"through": 0.0, "gap": 0.0, "pieces": 0}
    for position, _, _, strain in all_snapshots:
        position = position[:, :dimensions]
        found["pieces"] = max(found["pieces"], pieces(position, spacing) - start)
        lower, upper, piston = faces(scene, scene.size, strain)
        inside = numpy.column_stack([position.min(0) - lower, upper - position.max(0)])
        inside = (inside / spacing[:, None]).ravel()
        found["through"] = max(found["through"], *(-inside[solid]), 0.0)
        if piston is not None:
            axis = piston // 2
            found["gap"] = max(found["gap"], *inside[2 * axis:2 * axis + 2])
    return found


def angular_momentum(position, velocity):
    arm, speed = position - position.mean(0), velocity - velocity.mean(0)
    return numpy.sum(arm[:, 0] * speed[:, 1] - arm[:, 1] * speed[:, 0])


def exact_quarter_period(scene):
    """Of a cantilever in plane strain, s: Euler's first mode with rotary inertia and shear of
    Timoshenko's beam as a Rayleigh quotient, omega^2 = omega_E^2 / (1 + 4.648 (r/L)^2
    (1 + E'/(k G))), k = 5/6; 4.648 = L^2 int phi'^2 / int phi^2 of the mode."""
    value = {}
    for key in ("youngs_modulus", "poisson_ratio", "density"):
        number, *unit = str(scene.material[key]).split()
        value[key] = float(number) * {"GPa": 1e9, "MPa": 1e6}.get(*unit[:1] or [""], 1)
    modulus, nu = value["youngs_modulus"], value["poisson_ratio"]
    span, thick = scene.size[:2]
    plane = modulus / (1 - nu**2)
    slender = 4.648 * thick**2 / 12 / span**2 * (1 + plane / (5 / 6 * modulus / (2 * (1 + nu))))
    omega = 1.8751041**2 / span**2 * numpy.sqrt(plane * thick**2 / 12 / value["density"]
                                                / (1 + slender))
    return numpy.pi / 2 / omega


def first_rest(lines):
    """When the kinetic energy has its first valley, s; by a parabola through it."""
    time, energy = lines["time"], lines["kinetic_energy"]
    low = next((k for k in range(1, len(energy) - 1)
                if energy[k] < 0.5 * energy[0] and energy[k - 1] >= energy[k] <= energy[k + 1]),
               len(energy) - 2)
    a, b, c = energy[low - 1:low + 2]
    return time[low] + 0.5 * (time[low + 1] - time[low]) * (a - c) / ((a - 2 * b + c) or 1)


def growth(lines):
    tenth = len(lines["time"]) // 10
    first, last = (lines["elastic_energy"][part].max()
                   for part in (slice(None, tenth + 1), slice(-tenth - 1, None)))
    return last / first


def drift_of_momentum(scene, lines, all_snapshots):
    """Over the impulses that went through, or over the sizes of the particles' momenta where no
    wall could give one."""
    if scene.loading or any(scene.solid_sides()):
        return lines["momentum_error"].max()
    first, last = all_snapshots[0][1], all_snapshots[-1][1]
    return (numpy.linalg.norm(last.sum(0) - first.sum(0))
            / numpy.linalg.norm(first, axis=1).sum())


def figures_of(folder, wanted):
    """The figures of a run that ended; those that only some scenes have if they are `wanted`."""
    scene, lines, seen = Scene(folder), history(folder), list(snapshots(folder))
    found = energies(lines) | places(scene, seen)
    found["momentum"] = drift_of_momentum(scene, lines, seen)
    found["ratio_low"] = min(ratio.min() for _, _, ratio, _ in seen)
    found["ratio_high"] = max(ratio.max() for _, _, ratio, _ in seen)
    if "turned" in wanted:
        first, last = (angular_momentum(*snapshot[:2]) for snapshot in (seen[0], seen[-1]))
        found["turned"] = abs(last / first - 1)
    if "growth" in wanted:
        found["growth"] = growth(lines)
    if "stiffness" in wanted:
        found["stiffness"] = (exact_quarter_period(scene) / first_rest(lines)) ** 2
    return {name: float(f"{value:.3g}") for name, value in found.items()}


def failed_at(folder, message):
    """Where a run ended that failed: the strain of its last line, or its step."""
    lines = history(folder)
    if "strain" in lines:
        return f"{100 * lines['strain'][-1]:.1f} % strain" if len(lines["strain"]) else "the start"
    found = re.search(r"step (\d+)", message)
    return f"step {found[1]}" if found else ""
