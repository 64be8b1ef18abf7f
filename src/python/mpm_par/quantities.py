"""Numbers with their unit, as in scene files."""
import math
import re

UNITS = {  # unit: (dimension, factor to SI)
    "": ("number", 1.0), "%": ("number", 0.01), "1": ("number", 1.0),
    "Pa": ("pressure", 1.0), "kPa": ("pressure", 1e3), "MPa": ("pressure", 1e6),
    "GPa": ("pressure", 1e9),
    "m": ("length", 1.0), "cm": ("length", 1e-2), "mm": ("length", 1e-3), "um": ("length", 1e-6),
    "nm": ("length", 1e-9),
    "s": ("time", 1.0), "ms": ("time", 1e-3), "us": ("time", 1e-6), "ns": ("time", 1e-9),
    "min": ("time", 60.0), "h": ("time", 3600.0),
    "m/s": ("velocity", 1.0), "km/s": ("velocity", 1e3), "mm/s": ("velocity", 1e-3),
    "J": ("energy", 1.0), "mJ": ("energy", 1e-3), "uJ": ("energy", 1e-6),
    "kg": ("mass", 1.0), "kg/m^3": ("density", 1.0), "g/cm^3": ("density", 1e3),
}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def to_si(text):
    """(dimension, value in SI units) of a text such as `10 m/s`; a ValueError says why not."""
    match = re.fullmatch(rf"\s*({NUMBER})\s*(\S*)\s*", text)
    if not match:
        raise ValueError("is no number with a unit")
    if match[2] not in UNITS:
        raise ValueError(f"has an unknown unit '{match[2]}' (known: "
                         f"{', '.join(unit for unit in UNITS if unit)})")
    dimension, factor = UNITS[match[2]]
    value = float(match[1]) * factor
    if not math.isfinite(value):
        raise ValueError("is not finite")
    return dimension, value


def percent(fraction):
    """A fraction for people, three digits: 0.0123 as `1.23 %`."""
    return f"{100 * fraction:.3g} %"
