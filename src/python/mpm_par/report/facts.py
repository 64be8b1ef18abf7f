"""What a report says in words and tables: texts only, nothing is drawn here."""
import numpy

from mpm_par import pictures

FORMULATIONS = {"total_lagrangian": "total Lagrangian", "updated_lagrangian": "updated Lagrangian"}
NAIRN = ("J. A. Nairn (2006): Numerical simulations of transverse compression and densification in "
         "wood. Wood and Fiber Science 38(4):576-591.")


def ending(run, remark):
    """(kind, sentences) on how the run ended: kind is `good`, or `short` if it did not reach its
    end."""
    piston = run.axis is not None
    reached = (f"{100 * run.history['strain'][-1]:.3g} % strain" if piston
               else _time(run.history["time"][-1]))
    goal = run.quantity("loading.strain" if piston else "free_motion.end_time")
    asked = "" if goal is None else f" of {100 * goal:.3g} %" if piston else f" of {_time(goal)}"
    if run.summary is None:
        words = (f"This run did not reach its end: there is no summary.json. It was interrupted, "
                 f"failed, or is still going. What is shown ends at {reached}{asked}.")
        if remark:
            words = (f"This run did not reach its end: {remark.strip()} What is shown ends at "
                     f"{reached}{asked}.")
        elif run.last_sound_state:
            words = ("This run failed: its last sound state is in the folder failure, and there is "
                     f"no summary.json. What is shown ends at {reached}{asked}.")
        if run.checkpoints:
            words += " The folder checkpoints holds a state to go on from with --restart."
        return "short", words
    done = (run.history["strain"] if piston else run.history["time"])[-1]
    if goal and done < 0.995 * goal:
        return "short", (f"This run stopped early: its scene limits the steps, and it ends at "
                         f"{reached}{asked}.")
    return "good", f"The run reached its end, {reached}."


def _time(seconds):
    factor, unit = pictures.prefixed(seconds, "s")
    return f"{seconds / factor:.4g} {unit}"


def clock(seconds):
    """A duration for people; `-` of none."""
    if seconds is None:
        return "-"
    if seconds < 120:
        return f"{seconds:.3g} s"
    return f"{seconds / 60:.3g} min" if seconds < 7200 else f"{seconds / 3600:.3g} h"


def _count(number):
    return f"{number:,.0f}"


def _bytes(number):
    factor, unit = pictures.prefixed(number, "B")
    return f"{number / factor:.3g} {unit}"


def _with_error(value, error, factor):
    words = f"{value * factor:.4g}"
    if not error:
        return words
    error *= factor
    return f"{words} ± {error:.2g}" if error < 100 else f"{words} ± {error:.0f}"


def properties(run, bars):
    """Rows (property, stress or modulus, strain) of the curve's table; the note below it."""
    found = run.properties

    def error(name, own):
        return getattr(bars.get(name), "error", None) if bars else own

    rows = []
    if found.get("modulus"):
        rows.append(("modulus", _with_error(found["modulus"], error(
            "modulus", found.get("modulus_error")), 1e-6) + " MPa", ""))
    if found.get("toe"):
        toe = found["toe"]
        rows.append(("modulus beyond the toe", f"{toe['modulus'] / 1e6:.4g} MPa",
                     f"from {100 * toe['strain']:.3g} %"))
    for key, name in (("buckling", "onset of buckling"),
                      ("densification", "onset of densification"),
                      ("energy_efficiency", "best energy efficiency")):
        point = found.get(key)
        rows.append((name, "-", "-") if not point else (
            name,
            _with_error(point["stress"], error(f"{key}_stress", point["stress_error"]), 1e-6)
            + " MPa",
            _with_error(point["strain"], error(f"{key}_strain", point["strain_error"]), 100)
            + " %"))
    if bars and bars.get("plateau_stress") and bars["plateau_stress"].value is not None:
        plateau = bars["plateau_stress"]
        rows.append(("plateau stress", _with_error(plateau.value, plateau.error, 1e-6) + " MPa",
                     "mean of the study"))
    note = ("± is the numerical error that mpm_study --error-bar estimates." if bars else
            "± is two standard deviations of reading the curve: of its noise, and of where its first "
            "line is drawn; the numerical error is another matter: mpm_study --error-bar, then "
            "mpm_report --error-bar.")
    return rows, f"{note} {found.get('remark', '')}".strip()


def run_facts(run):
    """Rows (what, value) on the run."""
    summary, rows = run.summary, []
    numerics = run.scene.get("numerics", {})
    rows.append(("formulation", FORMULATIONS.get(numerics.get("formulation"), "-")))
    if summary is None:
        rows += [("particles", _count(run.history["particles"][-1])),
                 ("reached", _time(run.history["time"][-1]))]
        return rows
    rows += [("method", ", ".join(summary["plan"]["method"])),
             ("particles", _count(summary["particles"])),
             ("cells of the grid", " × ".join(str(n) for n in summary["cells"])),
             ("relative density", f"{100 * summary['relative_density']:.3g} %"),
             ("steps", f"{_count(summary['steps'])}, the first of {_time(summary['time_step'])}"),
             ("time that passed in the specimen", _time(summary["end_time"])),
             ("run time", f"{clock(summary['wall_seconds'])}, output "
                          f"{clock(summary['output_seconds'])} of it"),
             ("per particle and step", f"{summary['ns_per_particle_step']:.3g} ns"),
             ("memory of the fullest rank", _bytes(summary["largest_rank_bytes"])),
             ("energy error", f"{100 * summary['energy_error']:.2g} %, at most "
                              f"{100 * summary['largest_energy_error']:.2g} %")]
    return rows


def versions(run):
    """Rows (what, version)."""
    return list(((run.summary or {}).get("provenance") or {}).items())


def cooperation(run):
    """Rows (what, value) on how the ranks shared the work; none if the run has no summary."""
    summary = run.summary
    if summary is None:
        return []
    if summary["ranks"] == 1:
        return [("ranks", "1")]
    return [("ranks", f"{summary['ranks']}, {summary['decomposition']}"),
            ("particles of the fullest rank over the mean",
             f"{summary['imbalance']:.3f} at the end, {summary['mean_imbalance']:.3f} on average"),
            ("the same of counted work", f"{summary['mean_work_imbalance']:.3f} on average"),
            ("waiting for messages, of the rank that waits most",
             clock(summary["waiting_seconds"])),
            ("messages a step, of the rank that sends most",
             f"{summary['messages_per_step']:.3g}, {_bytes(summary['bytes_per_step'])}"),
            ("borders moved", _count(summary["repartitions"])),
            ("particles that changed their rank", _count(summary["migrated"]))]


def warnings(run):
    """Sentences: those of the summary, and of going back."""
    summary = run.summary or {}
    return [*summary.get("warnings", []), *(summary.get("recovery") or {}).get("reports", [])]


def window_rows(names, inside, everywhere, volumes):
    """Rows (name, volume of cell wall, plastic work density, share) at the last snapshot."""
    with numpy.errstate(invalid="ignore", divide="ignore"):
        shares = inside[-1] / everywhere[-1]
    return [(name, f"{volume * 1e9:.4g} mm³", f"{work / volume / 1e6:.4g} MJ/m³",
             f"{100 * share:.3g} %" if numpy.isfinite(share) else "-")
            for name, volume, work, share in zip(names, volumes, inside[-1], shares)]


def citation(run):
    """Sentences to cite by."""
    made = dict(versions(run))
    version = made.get("mpm_par")
    said = (f"mpm_par {version} ({made['git']}), " if version else "mpm_par, ") + \
        "a distributed material point method code for wood and cellular solids."
    specimen = run.scene.get("specimen", {})
    if "micrograph" not in specimen and (run.is_total_lagrangian or run.axis is None):
        return [said]
    return [said, NAIRN + " The founding paper of the approach: micrographs of wood as material "
            "points, crushed to densification."]
