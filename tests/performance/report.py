"""docs/performance.md from the stored table, the plan, what parts cost (left_out.py), and the
hand-written bounds and changes."""
import re

from measuring import PROJECT
from plan import plan
from studies import study_table
from table import about_text, catalogue, markdown

PAGE = PROJECT / "docs" / "performance.md"
LEFT_OUT = PROJECT / "docs" / "performance" / "left_out.md"
BOUNDS = PROJECT / "docs" / "performance" / "bounds.md"
CHANGES = PROJECT / "docs" / "performance" / "changes.md"
PICTURE = PROJECT / "docs" / "images" / "cost_growth.png"


def section(title, text, remark=""):
    return f"## {title}\n\n" + (f"{remark}\n\n" if remark else "") + text + "\n" if text else ""


def as_section(page_text):
    """A page of the folder performance, a level deeper and seen from the folder above."""
    return re.sub(r"^#", "##", page_text, flags=re.MULTILINE).replace("](../", "](")


def page(table, release):
    rows = table["figures"]
    whole = [row for row in rows if row["name"].count("/") < 5]
    planned = "\n".join(["| | from | result |", "|---|---|---|"] +
                        [f"| {what} | {formula} | {result} |"
                         for what, formula, result in plan(table)])
    parts = [
        "# Performance\n",
        "Written by `tests/performance/benchmark.py` from the table of release "
        f"{release} (`tests/performance/stored/{release}.json`),\n"
        "[performance/left_out.md](performance/left_out.md), "
        "[performance/bounds.md](performance/bounds.md) and "
        "[performance/changes.md](performance/changes.md). Measure again:\n\n"
        "```sh\ncmake -S . -B build -DMPM_BUILD_BENCHMARKS=ON && cmake --build build -j2\n"
        "python3 tests/performance/benchmark.py\n```\n",
        about_text(table) + "\n",
        "A figure is the median of its samples, `+-` half their range. Runs are pinned to cores of "
        "their own.\n",
        section("The program, and what is not a pass", markdown(whole),
                "Woods run with `numerics.formulation: updated_lagrangian` and `specimen.sampling: "
                "threshold`; what the other formulation costs at the same error: "
                "[formulations](formulations.md)."),
        section("Passes by themselves", catalogue(rows, "kernel"),
                "Nanoseconds per particle: 160,000 particles in the plane (Hencky), 512,000 in space "
                "(rate form), sorted, one core. `plastic`: every particle flows."),
        section("Whole steps", catalogue(rows, "step"),
                "Nanoseconds per particle and step of the same blocks through `Stepper`, one rank."),
        section("Growth", "![time per step](images/cost_growth.png)" if PICTURE.exists() else ""),
        section("Ranks without running on them", study_table(rows),
                "What `--check --ranks` says of ponderosa pine, and `partition_study` of a block of "
                "wood-like tubes in space (128 cells an edge), at the start and squeezed evenly to "
                "half, with the borders as they were and moved. Imbalance: particles of the fullest "
                "rank over the mean. The rest is of the rank that has most; bytes per exchange of "
                "mass, momentum and force."),
        section("1e8 particles", planned if plan(table) else "",
                "Computed from the figures of eight million particles on 2 ranks; messages between "
                "more ranks are not in it."),
        *(as_section(part.read_text()) for part in (LEFT_OUT, BOUNDS, CHANGES))]
    return "\n".join(part for part in parts if part)


def write_page(table, release):
    PAGE.write_text(page(table, release))
    print(f"wrote {PAGE.relative_to(PROJECT)}")
