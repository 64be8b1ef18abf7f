"""Draws the figures of docs/accuracy.md out of the files beside them."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot

import analysis
import runs

SHAPE_COLOURS = {"linear": "tab:gray", "gimp": "tab:blue", "quadratic": "tab:orange",
                 "cubic": "tab:green"}
MARKERS = {"flip": "o", "pic": "v", "apic": "s", "fmpm": "^"}


def style(method):
    """Colour and marker of a method; of a variant the next of a list, and dashed."""
    words = method.split()
    if method in analysis.variants():
        at = analysis.variants().index(method)
        look = {"color": pyplot.cm.tab20(at % 20), "marker": "Dp*hX<>"[at % 7], "linestyle": "--"}
    else:
        look = {"color": SHAPE_COLOURS[words[0]], "marker": MARKERS[words[1]]}
    return look | {"markersize": 4, "linewidth": 0.8, "label": ", ".join(words)}


def save(figure, name, top=1):
    """`top`: of the figure, below which the axes stay."""
    figure.tight_layout(rect=(0, 0, 1, top))
    figure.savefig(runs.RESULTS / name, dpi=90)
    pyplot.close(figure)


def benchmarks(methods, name):
    """Error over run time, with the front of all methods."""
    figure, axes = pyplot.subplots(3, 3, figsize=(11, 10))
    for axis, case in zip(axes.flat, analysis.cases()):
        for method in methods:
            rows = [row for row in analysis.case_rows(case["name"]) if row["method"] == method]
            axis.loglog([row["seconds"] for row in rows], [row["error"] for row in rows],
                        **style(method))
        front = analysis.front(case["name"])
        axis.loglog([row["seconds"] for row in front], [analysis.settled(row) for row in front],
                    "k-", linewidth=4, alpha=0.2, label="Pareto front")
        axis.set_title(case["title"], fontsize=9)
        axis.grid(alpha=0.3)
    for axis in axes[-1]:
        axis.set_xlabel("seconds")
    for axis in axes[:, 0]:
        axis.set_ylabel("error")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), fontsize=7, ncol=4, loc="upper center")
    save(figure, name, top=0.9)


def loblolly_curves():
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4), sharey=True)
    for axis, geometry, title in zip(axes, ("picture", "fixed"),
                                     ("picture sampled at every level", "geometry held fixed")):
        rows = analysis.ladder("loblolly", "gimp flip", geometry)
        for k, row in enumerate(rows):
            strain, stress = analysis.curve("loblolly", row)
            axis.plot(100 * strain, stress / 1e6, linewidth=1, label=f"{row['cells']:.0f} cells",
                      color=pyplot.cm.viridis(k / len(rows)))
        axis.set(title=f"gimp, flip: {title}", xlabel="strain [%]", ylim=(0, 600))
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("stress [MPa]")
    save(figure, "loblolly_curves.png")


def loblolly_levels():
    figure, axes = pyplot.subplots(2, 2, figsize=(10, 7))
    shown = (("modulus", 1e9, "modulus [GPa]"), ("plateau_stress", 1e6, "plateau stress [MPa]"),
             ("closing_strain", 0.01, "closing strain [%]"),
             ("densification_strain", 0.01, "onset of densification [%]"))
    for axis, (name, unit, words) in zip(axes.flat, shown):
        for method in analysis.ladder_methods("loblolly"):
            for geometry, line in (("picture", "-"), ("fixed", "--")):
                rows = analysis.ladder("loblolly", method, geometry)
                known = [(1e6 * analysis.spacing("loblolly", row),
                          analysis.value("loblolly", row, name)) for row in rows]
                known = [(h, found / unit) for h, found in known if found is not None]
                axis.plot(*zip(*known), line, **(style(method) | {"label": f"{method}, {geometry}"}))
        axis.set(xlabel="size of a cell [um]", ylabel=words, xlim=(0, None))
        axis.grid(alpha=0.3)
    axes[0, 0].legend(fontsize=7)
    save(figure, "loblolly_levels.png")


def early_contact():
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4))
    for axis, model, geometry in zip(axes, ("honeycomb", "loblolly"), (None, "picture")):
        for method in analysis.ladder_methods(model):
            rows = analysis.ladder(model, method, geometry)
            known = [(1e6 * analysis.spacing(model, row), analysis.closing_strain(model, row))
                     for row in rows]
            known = [(h, 100 * found) for h, found in known if found is not None]
            axis.plot(*zip(*known), "-", **style(method))
        at_zero, _, _ = analysis.first_order(model, analysis.ladder(model, "gimp flip", geometry),
                                             "closing_strain")
        slope = -analysis.gap_left("gimp flip") * analysis.lumens_per_length(model)
        end = analysis.spacing(model, analysis.ladder(model, "gimp flip", geometry)[0])
        axis.plot([0, 1e6 * end], [100 * at_zero, 100 * (at_zero + slope * end)], "k:",
                  label="gimp: slope of the gap that is left")
        axis.set(title=f"{model}: {analysis.CLOSED[model] / 1e6:.0f} MPa reached for good",
                 xlabel="size of a cell [um]", ylabel="strain [%]", xlim=(0, None))
        axis.legend(fontsize=7)
        axis.grid(alpha=0.3)
    save(figure, "early_contact.png")


if __name__ == "__main__":
    benchmarks(analysis.methods(), "benchmarks.png")
    benchmarks(["gimp flip", "quadratic flip", *analysis.variants()], "variants.png")
    loblolly_curves()
    loblolly_levels()
    early_contact()
