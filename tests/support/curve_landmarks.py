"""What is read off curves of stress over strain beside their properties; a mpm_par.History each."""
import numpy


def strain_at(history, stress):
    """The strain at which the curve first reaches a stress [Pa]; None if it never does."""
    reached = history["stress"] >= stress
    return history.strain_of("stress")[numpy.argmax(reached)] if reached.any() else None


def hump(history):
    """(share, strain): the largest share of its slope, over 4 % of strain, that the curve loses
    between 24 and 36 % strain, and where it has lost it; None of a curve that ends before, or that
    does not rise there."""
    places = numpy.arange(0.24, 0.361, 0.01)
    slope = (history.at("stress", places + 0.02) - history.at("stress", places - 0.02)) / 0.04
    if not numpy.isfinite(slope).all() or slope[0] <= 0:
        return None
    lost = 1 - slope / numpy.maximum.accumulate(slope)
    return lost.max(), places[lost.argmax()]
