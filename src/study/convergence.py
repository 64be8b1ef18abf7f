"""Observed order, extrapolation and error estimates on a ladder of grids.

The ladder's values are f(h) = f0 + C h^p with an unknown limit f0 and order p (Richardson 1911;
Roache 1994, J. Fluids Eng. 116:405). Three levels give all three unknowns, also where the ratio of
their sizes is not constant. A value is a number or an array (a curve): differences are then
measured in the 2-norm, and two of them point the same way if their cosine is at least 0.5.
"""
import dataclasses

import numpy

LOWEST, HIGHEST = 0.5, 3.0  # orders that count as those of a method in its asymptotic range
AGREEMENT = 0.5  # by how much orders of successive triples may differ there


def observed_order(sizes, values):
    """p of three levels from coarse to fine, or None where no order above 0 explains them.

    (f3 - f2)/(f2 - f1) = (h3^p - h2^p)/(h2^p - h1^p), which rises with p.
    """
    h3, h2, h1 = sizes
    first, second = (numpy.atleast_1d(values[k + 1] - values[k]).astype(float) for k in (0, 1))
    coarse, fine = numpy.linalg.norm(first), numpy.linalg.norm(second)
    if fine == 0 or coarse == 0 or numpy.dot(first, second) < 0.5 * coarse * fine:
        return None

    def ratio(p):
        return (h3 ** p - h2 ** p) / (h2 ** p - h1 ** p)

    low, high = 1e-3, 20.0
    if not ratio(low) < coarse / fine < ratio(high):
        return None
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(middle) < coarse / fine else (low, middle)
    return 0.5 * (low + high)


def extrapolated(h2, h1, f2, f1, order):
    """The limit f0 by Richardson: f1 + (f1 - f2)/((h2/h1)^p - 1)."""
    return f1 + (f1 - f2) / ((h2 / h1) ** order - 1)


@dataclasses.dataclass
class Limit:
    """What a ladder says of h = 0."""
    value: object  # None where the finest triple has no order that can be trusted
    order: float  # of the finest triple, or None
    orders: list  # of all successive triples, coarse to fine
    warnings: list  # why the ladder is not in its asymptotic range; empty if it is


def limit(sizes, values):
    """Extrapolates a ladder from coarse to fine; `sizes` fall, at least two levels."""
    orders = [observed_order(sizes[k:k + 3], values[k:k + 3]) for k in range(len(sizes) - 2)]
    if not orders:
        return Limit(None, None, [], [f"{len(sizes)} levels, and an order takes three"])
    warnings = []
    order = orders[-1]
    if order is None:
        warnings.append("the last three levels do not approach one value steadily")
        return Limit(None, None, orders, warnings)
    if None in orders:
        warnings.append("the differences of successive levels do not fall monotonically")
    known = [p for p in orders if p is not None]
    if max(known) - min(known) > AGREEMENT:
        warnings.append("the orders of successive triples disagree: "
                        + ", ".join("-" if p is None else f"{p:.2f}" for p in orders))
    if not LOWEST <= order <= HIGHEST:
        warnings.append(f"the observed order {order:.2f} lies outside {LOWEST:g} to {HIGHEST:g}")
    if len(orders) == 1:
        warnings.append("three levels only: nothing shows that the order holds")
    if order < LOWEST:
        return Limit(None, order, orders, warnings)
    return Limit(extrapolated(*sizes[-2:], *values[-2:], order), order, orders, warnings)


# Safety factors of the grid convergence index: 1.25 where levels agree on an order (Roache 1994),
# 3 where the ladder is not monotone (Eca & Hoekstra 2014, J. Comput. Phys. 262:104). Three levels
# give an order and do not confirm it: 2 lies between, and holds what it should (docs/studies.md).
FACTOR, UNCONFIRMED_FACTOR, CAUTIOUS_FACTOR = 1.25, 2.0, 3.0
PROVEN_ORDER = 1.0  # of walls and of contact, which act on whole nodes (docs/theory.md)
FORMAL_ORDER = 2.0  # of displacements inside a body
# h3/h1 - 1 of the levels of mpm_study --error-bar. Differences that show no order are chance, which does
# not shrink the more the wider apart levels lie.
NEAR = 1.25
SCATTER_FROM = 5  # levels, which leave two beside the constant and two orders


@dataclasses.dataclass
class Estimate:
    """The numerical error of the finest level of a ladder."""
    uncertainty: float  # half width of the bar
    order: float  # observed, or None
    limit: float  # extrapolated with what the bar trusts of the order, or None
    basis: str  # gci, first order or spread
    remark: str


def scatter(sizes, values):
    """Standard deviation of levels about f0 + C1 h + C2 h^2, by least squares (after Eca & Hoekstra 2014);
    0 for too few levels."""
    if len(sizes) < SCATTER_FROM:
        return 0.0
    h = numpy.array(sizes) / sizes[0]
    terms = numpy.stack([h ** 0, h, h ** 2], axis=1)
    left = values - terms @ numpy.linalg.lstsq(terms, numpy.array(values), rcond=None)[0]
    return float(numpy.sqrt(left @ left / (len(sizes) - 3)))


def estimate(sizes, values):
    """The error bar of the last of at least two levels from coarse to fine: see docs/studies.md.

    gci: |f2 - f1|/(r^p - 1) with the observed order p, from 0.5 to 1, times 2; up to p = 2 and
    times 1.25 where four levels or more agree on it, less what they differ by, as an order that
    changes may change further. first order: a p above 1 that three levels
    show may be that of two errors that cancel: 2 times their range, carried to h = 0 in first
    order. spread: 3 times that range where they show no order. Where levels do not agree, no less than
    twice their scatter.
    """
    last_sizes, last = sizes[-3:], values[-3:]
    span, apart = float(numpy.ptp(last)), last_sizes[0] / last_sizes[-1] - 1
    least = 2 * scatter(sizes, values)
    order = observed_order(last_sizes, last) if len(last) == 3 else None
    if order is None or order < LOWEST:
        why = "two levels give no order" if len(last) < 3 else \
            "the levels do not approach one value steadily" if order is None else \
            f"order {order:.2f} is below {LOWEST:g}"
        return Estimate(max(CAUTIOUS_FACTOR * span / min(apart, NEAR), least), order, None, "spread", why)
    ladder = limit(sizes, values)
    confirmed = not ladder.warnings
    used = min(order, PROVEN_ORDER)
    if confirmed:
        used = max(used, min(order, FORMAL_ORDER) - float(numpy.ptp(ladder.orders)))
    value = float(extrapolated(*sizes[-2:], *values[-2:], used))
    if confirmed:
        return Estimate(FACTOR * abs(value - values[-1]), order, value, "gci", "")
    if order > PROVEN_ORDER:
        return Estimate(max(UNCONFIRMED_FACTOR * span / apart, least), order, value, "first order", "")
    return Estimate(max(UNCONFIRMED_FACTOR * abs(value - values[-1]), least), order, value, "gci", "")
