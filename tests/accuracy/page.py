"""Writes docs/accuracy.md from the files in docs/accuracy.

    page.py [--check]    --check: only says whether the page is the one that would be written
"""
import re
from pathlib import Path

import analysis
import page_benchmarks
import page_contact
import page_loblolly
import runs
from words import filled_in, finished, percent, seconds
from written_page import write_or_check

PAGE = runs.PROJECT / "docs" / "accuracy.md"
TEXT = Path(__file__).with_name("page.md")


def values():
    """What stands in braces in page.md."""
    machine = analysis.machine()
    cells, gimp_parts = page_loblolly.parts("gimp flip")
    share, lumens = analysis.earlywood()
    methods = page_loblolly.methods()
    return {
        "machine": f"{machine['cores']} cores of an {machine['processor']} processor, "
                   f"{machine['memory_gib']:.0f} GiB, {machine['compiler']}",
        "version": f"{machine['mpm_par']} ({machine['git']})",
        "fronts": page_benchmarks.table_of_fronts(), "front_list": page_benchmarks.list_of_fronts(),
        "broken": page_benchmarks.broken(),
        "picture_levels": page_loblolly.levels("picture"),
        "fixed_levels": page_loblolly.levels("fixed"), "limits": page_loblolly.limits(),
        "parts": gimp_parts, "parts_cells": f"{cells:.0f}",
        "users_gimp": page_loblolly.users("gimp flip"),
        "users_quadratic": page_loblolly.users("quadratic flip"),
        "variants": page_loblolly.variants(150),
        "paper_errors": page_loblolly.errors_at("gimp flip", 180),
        "plateau_limits": page_loblolly.plateau_limits(),
        "foretold": page_loblolly.foretold("gimp flip", (150, 300), 600),
        "three_users": page_loblolly.three_users(),
        "gaps": page_contact.gaps(), "honeycomb": page_contact.honeycomb(),
        "pairs": page_contact.loblolly_pairs(),
        "cells_early": ", ".join(f"{page_contact.cells_early('loblolly', method, 'fixed'):.2f} "
                                 f"({method.replace(' ', ', ')})" for method in methods),
        "lumens": f"{lumens:.1f}", "share": f"{100 * share:.1f}",
        "exponents": ", ".join(f"{analysis.exponent(page_loblolly.ladder(method, 'picture')):.2f} "
                               f"({method.replace(' ', ', ')})" for method in methods),
        "front_count": page_benchmarks.front_count(),
        "early_quote": page_contact.quote()}


def single(found):
    """Error or run time of one run, for {error case, method, level}."""
    column, case, method, level = found.groups()
    row = next(row for row in analysis.case_rows(case)
               if row["method"] == method and row["level"] == int(level))
    return percent(row[column]) if column == "error" else seconds(row[column])


def written():
    """The page."""
    page = re.sub(r"{(error|seconds) (\w+), ([^,{}]+), (\d+)}", single, filled_in(TEXT, values()))
    return finished(TEXT, page)


def main():
    write_or_check(PAGE, written())


if __name__ == "__main__":
    main()
