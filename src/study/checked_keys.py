"""Checks that the keys of a study file share."""
from mpm_par.quantities import to_si


def known(node, keys, where):
    """Refuses what is no map, and keys that are not there."""
    if not node.is_map:
        raise node.wrong(f"{where} is no map", f"Give it keys of: {', '.join(keys)}.")
    for key, value in node.value.items():
        if key not in keys:
            raise value.wrong(f"{where} has no key '{key}'", f"Known: {', '.join(keys)}.")
    return node.value


def whole_number(node, name, least):
    try:
        number = int(node.value)
        if number < least:
            raise ValueError
    except (TypeError, ValueError):
        raise node.wrong(f"{name} is {node.text} (no whole number of at least {least})",
                         f"Write e.g. {name}: {max(least, 3)}.") from None
    return number


def quantity(node, name, dimension, example):
    """A number above 0 in SI units."""
    try:
        if node.is_list or node.is_map:
            raise ValueError("is no single value")
        found, value = to_si(node.value)
        if found != dimension:
            raise ValueError(f"is a {found}, not a {dimension}")
        if value <= 0:
            raise ValueError("is not above 0")
    except ValueError as error:
        raise node.wrong(f"{name} is {node.text} ({error})", f"Write e.g. {example}.") from None
    return value
