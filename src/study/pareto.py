"""Which points of error over cost are worth their cost."""
import math


def front(points, cost, error):
    """Those that no other point beats in one of cost and error without losing in the other;
    cheapest first. Of equal ones the first stays."""
    kept = []
    for point in sorted(points, key=lambda point: (cost(point), error(point))):
        if not kept or error(point) < error(kept[-1]):
            kept.append(point)
    return kept


def slope(costs, errors):
    """Exponent of error over cost: the straight line through the logarithms, least squares.
    None for fewer than two different points above 0."""
    pairs = [(math.log(c), math.log(e)) for c, e in zip(costs, errors) if c > 0 and e > 0]
    if len(pairs) < 2:
        return None
    x, y = (sum(column) / len(pairs) for column in zip(*pairs))
    spread = sum((a - x) ** 2 for a, _ in pairs)
    if spread == 0:
        return None
    return sum((a - x) * (b - y) for a, b in pairs) / spread
