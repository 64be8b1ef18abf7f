"""What a curve of stress over strain shows."""
import json
from pathlib import Path

import numpy

from measures.history import History


def modulus(folder, level):
    """slope of the stress over the second half of the strain"""
    history = History(folder)
    strain, stress = history["strain"], history["stress"]
    late = strain > strain[-1] / 2
    return numpy.polyfit(strain[late], stress[late], 1)[0]


def last_stress(folder, level, share=0.2):
    """mean stress at the end of the curve"""
    history = History(folder)
    strain, stress = history["strain"], history["stress"]
    return stress[strain > (1 - share) * strain[-1]].mean()


def mean_stress(folder, level):
    """mean stress over all of the strain"""
    history = History(folder)
    strain, stress = history["strain"], history["stress"]
    return (0.5 * (stress[1:] + stress[:-1]) * numpy.diff(strain)).sum() / (strain[-1] - strain[0])


def over_solid(folder, level, bulk_modulus, yield_stress):
    """last stress over that of a solid that fills everything, at the specimen's relative density"""
    history = History(folder)
    density = json.loads((Path(folder) / "summary.json").read_text())["relative_density"]
    volume_ratio = (1 - history["strain"][-1]) / density
    solid = (2 / 3 * yield_stress - bulk_modulus * numpy.log(volume_ratio)) / volume_ratio
    return history["stress"][-1] / solid
