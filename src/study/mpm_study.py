#!/usr/bin/env python3
"""Error against run time: runs a scene with many settings and says what each costs and is worth."""
import os
import pathlib
import shlex
import signal
import sys

import error_bar
import problems
import program
import study_run
from mpm_par.problems import Options, say


def part_of(text, parser):
    """(K, N) of "K/N"; None of None."""
    if text is None:
        return None
    numbers = text.split("/")
    if len(numbers) == 2 and all(number.isdecimal() for number in numbers):
        part, parts = map(int, numbers)
        if 1 <= part <= parts:
            return part, parts
    return parser.error(f"--part is {text} (not K/N with K from 1 to N). Write e.g. 2/8.")


def arguments_of(words):
    parser = Options(
        prog="mpm_study", description=__doc__,
        epilog="A study that was interrupted goes on where it stopped. See docs/studies.md.")
    parser.add_argument("files", metavar="study.yaml", nargs="+",
                        help="studies, one after the other, or a scene with --error-bar")
    parser.add_argument("-o", "--output", metavar="DIR", required=True,
                        help="folder of results; of several studies each has one in it, by its "
                             "file's name")
    parser.add_argument("--ranks", type=int, default=1, metavar="N",
                        help="MPI ranks of runs that do not vary them (1)")
    parser.add_argument("--part", metavar="K/N",
                        help="run only the K-th of N shares of the study's runs, write no tables")
    parser.add_argument("--quick", action="store_true", help="the study's quick variant")
    bar = parser.add_argument_group("error bar of one run")
    bar.add_argument("--error-bar", action="store_true",
                     help="run a scene at coarser levels too and estimate its numerical error")
    bar.add_argument("--levels", type=float, nargs="+", default=[1.5, 2.25], metavar="F",
                     help="coarser levels: cells so many times as large (1.5 2.25)")
    bar.add_argument("--finer", type=float, nargs="+", default=[], metavar="F",
                     help="finer levels: cells so many times as small (none)")
    bar.add_argument("--plateau", nargs=2, default=["5 %", "15 %"], metavar=("FROM", "TO"),
                     help="strains between which the plateau stress is the mean ('5 %%' '15 %%')")
    bar.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                     help="change a key of the scene; may be repeated")
    given = parser.parse_args(words)
    if given.ranks < 1:
        parser.error("--ranks is below 1. Write a number of ranks.")
    given.part = part_of(given.part, parser)
    if given.error_bar and given.part:
        parser.error("--part belongs to a study, --error-bar to a scene. Leave one away.")
    if given.error_bar and given.quick:
        parser.error("--quick belongs to a study, --error-bar to a scene. Leave one away.")
    if given.error_bar and len(given.files) > 1:
        parser.error("--error-bar belongs to one scene, and several files are named. Name one.")
    given.file = given.files[0]  # of --error-bar
    stems = [pathlib.Path(path).stem for path in given.files]
    if len(set(stems)) < len(stems):
        parser.error("two studies have the same name, and so one folder. Rename one.")
    if given.set and not given.error_bar:
        parser.error("--set belongs to --error-bar. Write the key set of the study file.")
    return given


def found_program():
    """mpm_par and the launcher of its ranks, as the build or the environment names them."""
    launcher = shlex.split(os.environ.get("MPM_MPIEXEC", "mpiexec"))
    return program.Program(os.environ.get("MPM_PAR", "mpm_par"),
                           [*launcher, os.environ.get("MPM_NUMPROC_FLAG", "-n")])


def interrupted(*_):
    raise KeyboardInterrupt


def main(words):
    given = arguments_of(words)
    signal.signal(signal.SIGTERM, interrupted)
    try:
        output = pathlib.Path(given.output)
        if given.error_bar:
            error_bar.run(given, found_program(), output)
        else:
            study_run.run_studies(given, found_program(), output)
    except problems.InputError as error:
        say(error)
        return problems.BAD_INPUT
    except problems.NoResult as error:
        say(error)
        return problems.NUMERICAL_FAILURE
    except BrokenPipeError:  # whoever read what is printed, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        say(f"{error.filename or given.output}: {error.strerror}. Choose another --output, or "
            "make room.")
        return problems.FILE_FAILURE
    except KeyboardInterrupt:
        say(f"\nInterrupted. The same command goes on from what {given.output} holds.")
        return problems.INTERRUPTED
    return problems.DONE


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
