"""Reads what mpm_par and mpm_study leave behind into NumPy arrays, and draws it.

    import mpm_par
    run = mpm_par.open_run("results/my_wood")
    run.history["stress"]                    # Pa, one value a line
    run.snapshots[-1]["plastic_work"]        # J, one value a particle

Values are in SI units; `units` and `unit()` name them. What is missing, half-written or broken
raises `ResultsError`, one sentence with place and remedy. Examples: docs/python.md.
"""
import importlib

_PLACES = {"ResultsError": "problems", "History": "history", "read_history": "history",
           "Run": "run", "open_run": "run", "Snapshot": "snapshots", "read_snapshot": "snapshots",
           "read_series": "snapshots", "Window": "windows", "work_in_windows": "windows",
           "Bar": "study", "Study": "study", "read_study": "study", "read_error_bar": "study",
           "study_folders": "study"}
__all__ = sorted(_PLACES)


def __getattr__(name):
    """NumPy and h5py are large: whoever measures the memory of other programs loads them late."""
    if name not in _PLACES:
        raise AttributeError(f"module 'mpm_par' has no attribute '{name}'")
    return getattr(importlib.import_module(f"mpm_par.{_PLACES[name]}"), name)
