"""How cost and memory grow: with the particles, with empty cells, and up to eight million particles.
"""
import math

from measuring import PROJECT, figure
from scenes import BENCHMARKS, one_run, runs

PARTICLES = (1e3, 1e4, 1e5, 1e6, 8e6)
EMPTY = (0, 1, 3, 7, 15)  # empty cells per full one
MARGIN_UNIT = "mm"


def slope(points):
    """Of the logarithms: 1 where the cost is proportional."""
    x = [math.log(point[0]) for point in points]
    y = [math.log(point[1]) for point in points]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) /
            sum((a - mean_x) ** 2 for a in x))


def step_seconds(result):
    return (result["loop_seconds"] - result["output_seconds"]) / result["steps"]


def measure_growth(build, repeat, quick):
    scene = BENCHMARKS / "block_gimp.yaml"
    rows, points = [], []
    for wanted in PARTICLES[:3] if quick else PARTICLES:
        edge = round(math.sqrt(wanted / 4))
        # About 4e6 updates of a particle a run, some tenths of a second, but more steps than what
        # the first one does for the rest would show in.
        steps = max(20, min(2000, round(4e6 / wanted)))
        results = runs(build, repeat, scene, [f"grid.cells=[{edge}, {edge}]", f"steps={steps}"])
        rows.append(figure(f"step of {4 * edge * edge} particles",
                           [1e3 * step_seconds(result) for result in results], "ms",
                           particles=4 * edge * edge))
        rows.append(figure(f"start of {4 * edge * edge} particles",
                           [result["seconds"] - result["loop_seconds"] for result in results], "s"))
        points.append((rows[-2]["particles"], rows[-2]["value"]))
    rows.append(figure("slope of time over particles (1: proportional)", [slope(points)], "1",
                       "ratio"))

    points = []
    for empty in EMPTY[:2] if quick else EMPTY:
        # A block of 1 mm with the same margin on every side: (1 + 2 m)^2 = 1 + empty.
        margin = (math.sqrt(1 + empty) - 1) / 2
        results = runs(build, repeat, scene, [f"grid.margin={margin:.6f} {MARGIN_UNIT}"])
        rows.append(figure(f"step with {empty} empty cells per full one",
                           [1e3 * step_seconds(result) for result in results], "ms", empty=empty))
        points.append((1 + empty, rows[-1]["value"]))
    rows.append(figure("slope of time over grid size (0: empty cells are free)", [slope(points)],
                       "1", "ratio"))
    return rows


def measure_memory(build, _repeat, _quick):
    """Bytes per particle at a million particles. A solid block, and a honeycomb of the density of
    softwood, which has more nodes to a particle; with and without snapshots."""
    rows = []
    honeycomb = BENCHMARKS / "eight_million.yaml"
    for name, scene, cells in (("solid block", BENCHMARKS / "block_gimp.yaml", (500, 500)),
                               ("honeycomb", honeycomb, (785, 785))):
        for snapshots in (0, 1):
            result = one_run(build, scene, [f"grid.cells=[{cells[0]}, {cells[1]}]", "steps=60",
                                            "output.snapshots=" + ("{strains: [0 %]}" if snapshots else "0")])
            count = result["particles"]
            label = f"{name}, {count / 1e6:.2f} million particles"
            if snapshots == 0:
                rows.append(figure(f"{label}: arrays", [result["largest_rank_bytes"] / count],
                                   "B/particle", "memory"))
            rows.append(figure(f"{label}: peak{' with a snapshot' * snapshots}",
                               [result["peak_bytes"] / count], "B/particle", "memory"))
    return rows


def measure_scale(build, _repeat, quick):
    """Eight million particles on two ranks, start and one snapshot included."""
    scene = BENCHMARKS / "eight_million.yaml"
    settings = ["grid.cells=[700, 700]"] if quick else []
    result = one_run(build, scene, settings, ranks=2)
    count = result["particles"]
    name = f"{count / 1e6:.2f} million particles, 2 ranks"
    return [figure(f"{name}: per step", [result["ns_per_particle_step"]],
                   "ns/particle/step x ranks"),
            figure(f"{name}: start", [result["seconds"] - result["loop_seconds"]], "s"),
            figure(f"{name}: output of one snapshot", [result["output_seconds"]], "s",
                   bytes=result["snapshot_bytes"]),
            figure(f"{name}: loop of {result['steps']} steps",
                   [result["loop_seconds"]], "s"),
            figure(f"{name}: peak of the larger rank", [result["peak_bytes"] / count * 2],
                   "B/particle of the rank", "memory")]


def draw(rows, path):
    """Time per step over particles and over grid size; needs Matplotlib."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    particles = [(row["particles"], row["value"]) for row in rows if "particles" in row]
    empty = [(1 + row["empty"], row["value"]) for row in rows if "empty" in row]
    figure_, axes = pyplot.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    for axis, points, label, ideal in (
            (axes[0], particles, "particles", 1),
            (axes[1], empty, "grid size / full cells, 160,000 particles", 0)):
        x, y = zip(*points)
        axis.loglog(x, y, "o-", color="#2e86c1", label=f"measured, slope {slope(points):.3f}")
        axis.loglog(x, [y[-1] * (value / x[-1]) ** ideal for value in x], ":", color="0.5",
                    label=f"slope {ideal}")
        axis.set_xlabel(label)
        axis.set_ylabel("ms per step")
        axis.legend(frameon=False)
    axes[1].set_ylim(min(y) / 3, max(y) * 3)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure_.savefig(path, dpi=110)
    print(f"wrote {path.relative_to(PROJECT) if path.is_relative_to(PROJECT) else path}")
