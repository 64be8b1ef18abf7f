"""What a run of 1e8 particles takes, computed from the measured figures."""
PARTICLES = 1e8
STEPS = 1e5
RANKS = (32, 128, 512)


def value_of(table, words, kind=None):
    """The first figure whose name holds all words."""
    for row in table["figures"]:
        if all(word in row["name"] for word in words) and kind in (None, row["kind"]):
            return row
    return None


def plan(table):
    """Rows (what, formula, value) of the plan; empty where a figure is missing."""
    cost = value_of(table, ["million particles, 2 ranks", "per step"])
    peak = value_of(table, ["million particles, 2 ranks", "peak"])
    start = value_of(table, ["million particles, 2 ranks", "start"])
    output = value_of(table, ["million particles, 2 ranks", "output"])
    if not all((cost, peak, start, output)):
        return []
    measured = float(cost["name"].split(" million")[0]) * 1e6
    rows = [("memory, all ranks", f"{peak['value']:.0f} B x 1e8",
             f"{peak['value'] * PARTICLES / 2**30:.0f} GiB"),
            ("one snapshot", f"{output['bytes'] / measured:.0f} B x 1e8",
             f"{output['bytes'] / measured * PARTICLES / 1e9:.1f} GB")]
    for ranks in RANKS:
        seconds = cost["value"] * 1e-9 * PARTICLES / ranks
        rows.append((f"{ranks} ranks", f"{cost['value']:.1f} ns x 1e8 / {ranks}",
                     f"{seconds:.2f} s a step, {seconds * STEPS / 86400:.1f} days for 1e5 steps, "
                     f"{PARTICLES / ranks / 1e6:.2f} million particles and "
                     f"{peak['value'] * PARTICLES / ranks / 2**30:.1f} GiB a rank"))
    seconds = start["value"] * PARTICLES / measured * 2
    rows.append(("start, each rank rastering its part",
                 f"{start['value']:.1f} s x 1e8 / {measured:.2g} x 2 / ranks",
                 ", ".join(f"{seconds / ranks:.1f} s on {ranks} ranks" for ranks in RANKS)))
    return rows
