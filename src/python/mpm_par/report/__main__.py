"""Leaves a report of a run, or of studies, in its folder: report.html, one page with all pictures
in it, and the pictures as files in report/."""
import importlib.util
import re
import sys
import time

from mpm_par import matplotlib_files, quantities
from mpm_par.problems import Options, ResultsError, say

DONE, BAD_INPUT, FILE_FAILURE = 0, 2, 4
PACKAGES = {"numpy": "python3-numpy", "h5py": "python3-h5py", "matplotlib": "python3-matplotlib",
            "PIL": "python3-pil", "yaml": "python3-yaml"}


class UsageError(Exception):
    """One sentence: option, what is wrong, remedy."""


def arguments_of(words):
    parser = Options(prog="mpm_report", description=__doc__, epilog="See docs/reports.md.")
    parser.add_argument("folder", help="folder of results of a run, such as results/my_wood, or of "
                                       "mpm_study")
    parser.add_argument("--at", nargs="+", default=[], metavar="VALUE",
                        help="strains (5%%) or times (12us) at which the structure is shown; the "
                             "nearest snapshots are taken (six evenly)")
    parser.add_argument("--window", action="append", default=[], metavar="NAME=X0:X1,Y0:Y1",
                        help="a part of the specimen at its start, such as "
                             "earlywood=0:0.4mm,0:0.5mm, whose share of the plastic work is shown; "
                             "may be repeated (those of the scene)")
    parser.add_argument("--error-bar", metavar="DIR",
                        help="folder of mpm_study --error-bar: its bars are drawn")
    parser.add_argument("--work-limit", type=float, metavar="MJ/M3",
                        help="where the colours of plastic work end (98 of 100 pixels)")
    parser.add_argument("--stress-limit", type=float, metavar="MPA",
                        help="where the colours of stress end (98 of 100 pixels)")
    parser.add_argument("--section", metavar="LENGTH",
                        help="in space: where the section is, such as 0.2mm (half way)")
    parser.add_argument("--film-size", type=float, default=3.0, metavar="MB",
                        help="the film's file is no larger (3); 0: no film")
    parser.add_argument("--remark", default="", metavar="TEXT",
                        help="on how the run ended, for the page")
    return parser.parse_args(words)


def quantity(option, text, *dimensions):
    """(dimension, value in SI units)."""
    try:
        dimension, value = quantities.to_si(text)
        if dimension not in dimensions:
            raise ValueError(f"is a {dimension}, not a {' or a '.join(dimensions)}")
    except ValueError as error:
        raise UsageError(f"{option} {text}: {error}. See mpm_report --help.") from None
    return dimension, value


def moments(given):
    return [quantity("--at", text, "number", "time") for text in given.at]


def _range(option, text):
    """`0:0.4mm` as two lengths, m; a zero needs no unit."""
    ends = text.split(":")
    if len(ends) != 2:
        raise UsageError(f"{option}: {text} is no range. Write e.g. 0:0.4mm.")
    low, high = (0.0 if re.fullmatch(r"[-+]?0*\.?0*", end) and end else
                 quantity(option, end, "length")[1] for end in ends)
    if not low < high:
        raise UsageError(f"{option}: {text} does not rise. Write e.g. 0:0.4mm.")
    return low, high


def windows(given):
    from mpm_par.windows import Window

    found = []
    for text in given.window:
        name, equals, ranges = text.partition("=")
        parts = ranges.split(",")
        if not name or not equals or not 1 <= len(parts) <= 3:
            raise UsageError(f"--window {text}: is no window. Write e.g. "
                             "--window earlywood=0:0.4mm,0:0.5mm.")
        ends = [_range(f"--window {name}", part) for part in parts]
        found.append(Window(name, tuple(low for low, _ in ends), tuple(high for _, high in ends)))
    return found


def bars_of(given, run):
    """Bars of the error-bar study, which has to be of this very scene."""
    from mpm_par.study import read_error_bar

    if not given.error_bar:
        return None
    bars, found = read_error_bar(given.error_bar), run.properties
    compared = [("modulus", found.get("modulus"), bars["modulus"].value, 0.02)]
    for key in "buckling", "densification":
        bar = bars.get(f"{key}_stress")
        # Walls may give way in another order on other ranks.
        if found.get(key) and bar and bar.value:
            compared.append((f"stress of {key}", found[key]["stress"], bar.value, 0.1))
    for name, own, theirs, tolerance in compared:
        if not own or not theirs or abs(own / theirs - 1) > tolerance:
            shown = ["none" if not value else f"{value / 1e6:.4g} MPa" for value in (theirs, own)]
            raise ResultsError(f"{given.error_bar}: is of another scene (its {name} is {shown[0]}, "
                               f"this run's {shown[1]}). Run mpm_study --error-bar on this scene.")
    return bars


def section(given):
    return quantity("--section", given.section, "length")[1] if given.section else None


def check_limits(given):
    for option, value in (("--work-limit", given.work_limit),
                          ("--stress-limit", given.stress_limit)):
        if value is not None and not value > 0:
            raise UsageError(f"{option} {value:g}: is not above 0. Write a number above 0.")
    if given.film_size != 0 and not given.film_size >= 0.1:
        raise UsageError(f"--film-size {given.film_size:g}: is below 0.1. Write a size in MB from "
                         "0.1 on, or 0 for no film.")


def missing_packages():
    """Names of Debian's packages of what this Python does not have."""
    return [package for module, package in PACKAGES.items()
            if importlib.util.find_spec(module) is None]


def make(given):
    from mpm_par.run import open_run

    check_limits(given)
    asked = moments(given), windows(given)
    place = section(given)
    run = open_run(given.folder)
    bars = bars_of(given, run)
    from mpm_par.report.contents import Request, contents, write  # Matplotlib is slow to load
    html, drawings = contents(run, Request(
        *asked, bars, given.work_limit, given.stress_limit, place, int(1e6 * given.film_size),
        given.remark))
    return write(run.folder, html, drawings)


def make_of_studies(given):
    from mpm_par.report.contents import write
    from mpm_par.report.studies import contents

    of_run = arguments_of([given.folder])
    if vars(given) != vars(of_run):
        raise UsageError(f"{given.folder} holds studies: options of the report of a run do not "
                         "apply. Leave them away, or name the folder of one run.")
    return write(given.folder, *contents(given.folder))


def main(words):
    given = arguments_of(words)
    missing = missing_packages()
    if missing:
        say(f"no report: install {' '.join(missing)} for {sys.executable}.")
        return FILE_FAILURE
    begin = time.monotonic()
    try:
        matplotlib_files.keep_out_of_home()
        from mpm_par.study import study_folders
        path = (make_of_studies if study_folders(given.folder) else make)(given)
        print(f"report in {path} ({time.monotonic() - begin:.1f} s)")
    except (ResultsError, UsageError) as error:
        say(f"mpm_report: {error}")
        return BAD_INPUT
    except ImportError as error:
        say(f"no report: {sys.executable} cannot load a package ({error}). Install it anew.")
        return FILE_FAILURE
    except OSError as error:
        say(f"mpm_report: {error.filename or given.folder}: {error.strerror}. Make room, or let "
            "this user write there.")
        return FILE_FAILURE
    return DONE


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
