"""Says what a folder of results holds: columns, snapshots and fields, with their units."""
import sys

from mpm_par.problems import Options, ResultsError, say
from mpm_par.run import open_run


def describe(run):
    last = run.history["strain"][-1] if "strain" in run.history else 0
    yield f"{run.title} ({run.folder})"
    yield "the run has ended" if run.summary else "no summary.json: the run has not ended well"
    yield f"history: {len(run.history)} lines, to {100 * last:.4g} % strain"
    yield from (f"  {name} [{unit}]" for name, unit in run.history.units.items())
    yield f"snapshots: {len(run.snapshots)}"
    yield from (f"  {k}: {snapshot.count} particles, {100 * snapshot.strain:.4g} % strain, "
                f"{snapshot.time:.4g} s" for k, snapshot in enumerate(run.snapshots))
    if run.snapshots:
        yield "fields: " + ", ".join(f"{name} [{unit}]"
                                     for name, unit in run.snapshots[0].units.items())


def main(words):
    parser = Options(prog="python3 -m mpm_par", description=__doc__)
    parser.add_argument("folder", help="folder of results of a run")
    try:
        print("\n".join(describe(open_run(parser.parse_args(words).folder))))
    except ResultsError as error:
        say(error)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
