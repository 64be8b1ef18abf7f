"""Closed formulae beside the runs of a study: cells of hexagons, and layers."""
import dataclasses

from mpm_par import foam
from mpm_par.report import study_facts


@dataclasses.dataclass(frozen=True)
class Wall:
    """Of the cell walls of a run, SI units; `yield_stress` is None of an elastic one."""
    modulus: float
    poisson_ratio: float
    yield_stress: float
    plane_strain: bool


def wall_of(run):
    """The Wall of a mpm_par.Run in the plane with one material that has a Young's modulus; else
    None."""
    modulus = run.quantity("material.youngs_modulus")
    if modulus is None or run.is_in_space:
        return None
    return Wall(modulus, run.quantity("material.poisson_ratio") or 0.0,
                run.quantity("material.yield_stress"),
                run.scene["numerics"].get("plane") != "stress")


def honeycomb_rows(study, runs):
    """(titles, rows) of foam theory beside each figure, and below it that of the specimen's windows
    where they are layers in series, each of which bears the whole stress. `runs`: (entry of
    study.json, Run)."""
    rows = []
    for entry, run in runs:
        wall, density = wall_of(run), (run.summary or {}).get("relative_density")
        if wall is None or run.axis is None:
            continue
        name = study_facts.name_of(study, entry)
        buckling = run.properties.get("buckling") or {}
        rows += _honeycomb(name, wall, density, run.properties.get("modulus"), buckling.get("stress"))
        across = "xy"[run.axis]
        for window in layers(run, across):
            rows += _honeycomb(f"{name}: {window['name']}", wall,
                               run.summary["windows"][window["name"]])
    return ["run", "relative density", "t/l", "modulus, theory (MPa)", "simulation",
            "elastic buckling, theory (MPa)", "plastic collapse, theory (MPa)",
            "onset, simulation"], rows


def _honeycomb(name, wall, density, modulus=None, onset=None):
    """One row; none of what is no foam."""
    if not density or density >= 1:
        return []
    theory = foam.honeycomb(density, wall.modulus, wall.yield_stress, wall.plane_strain,
                            wall.poisson_ratio)
    return [[name, f"{density:.3f}", f"{theory.thickness_ratio:.3f}", _mega(theory.modulus),
             _mega(modulus), _mega(theory.elastic_buckling), _mega(theory.plastic_collapse),
             _mega(onset)]]


def layers(run, across):
    """Windows of a run's specimen that each take a part of it along the axis `across`, and all of it
    along the other one of the plane."""
    along = "y" if across == "x" else "x"
    return [window for window in run.scene.get("specimen", {}).get("windows") or []
            if window.get(across, [0, 1]) != [0, 1] and window.get(along, [0, 1]) == [0, 1]]


def _mega(value):
    return "-" if value is None else study_facts.four_digits(value / 1e6)


def layer_rows(study, runs):
    """(titles, rows): moduli of two layers across x, early- and latewood, out of those along x and
    along y of the same specimen, beyond the toe of a curve that has one; of windows that part the
    specimen along x in two, the lighter one of which is the softer layer."""
    rows = []
    for entry, run in runs:
        if run.axis != 0 or not _stiffness(run):
            continue
        windows = layers(run, "x")
        partner = _partner(entry, run, runs)
        if len(windows) != 2 or partner is None:
            continue
        ends = sorted([float(end) for end in window["x"]] for window in windows)
        if max(abs(ends[0][0]), abs(ends[1][0] - ends[0][1]), abs(ends[1][1] - 1)) > 1e-6:
            continue
        lighter = min(windows, key=lambda window: run.summary["windows"][window["name"]])
        share = float(lighter["x"][1]) - float(lighter["x"][0])
        found = foam.layer_moduli(_stiffness(run), _stiffness(partner), share)
        rows.append([study_facts.name_of(study, entry), f"{share:.3f}",
                     _mega(_stiffness(run)), _mega(_stiffness(partner)),
                     *(map(_mega, found) if found else ("no two such layers", "-"))])
    return ["run", "share of the lighter window", "modulus across (MPa)", "along (MPa)",
            "softer layer (MPa)", "stiffer layer (MPa)"], rows


def _stiffness(run):
    """The modulus that the wood has once what is slack in it is shut; None if there is none."""
    toe = run.properties.get("toe")
    return toe["modulus"] if toe else run.properties.get("modulus")


def _partner(entry, run, runs):
    """The run with all the same settings but the piston, which comes along y."""
    def rest(one):
        return {key: value for key, value in one["settings"].items() if key != "loading.piston"}

    return next((other for its, other in runs if other.axis == 1 and rest(its) == rest(entry)
                 and _stiffness(other)), None)
