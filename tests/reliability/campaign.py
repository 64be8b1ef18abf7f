"""Does faults to runs of mpm_par, many times over, and counts the runs that were lost.

    campaign.py build/mpm_par [--kills 240] [--others 40] [--seed 1] [--write]

    --kills    kill -9 at random moments, on 1 to 4 ranks
    --others   of each other fault
    --failing-writes build/tests/reliability/libfailing_writes.so
    --write    the table into docs/reliability.md

Needs h5py, and the right to mount for full disks: what is missing is left out, and said. Ctrl-C
ends it with what was tried until then. The exit status is 1 if a run was lost."""
import argparse
import collections
import itertools
import os
import pathlib
import platform
import re
import signal
import subprocess
import sys
import tempfile
import time

from faults import Faults
from trials import Lost, Program

PROJECT = pathlib.Path(__file__).parents[2]
PAGE = PROJECT / "docs" / "reliability.md"
BEGIN, END = "<!-- campaign.py writes from here -->\n", "<!-- to here -->\n"


def plan(faults, kills, others):
    """(name of the fault, name of a missing tool or None, trial, ranks) of each."""
    ranks = itertools.cycle((1, 2, 3, 4))
    kinds = [("kill -9 of one rank", lambda n: faults.kill_one_rank(n)),
             ("kill -9 of all ranks", lambda n: faults.kill_all(n)),
             ("kill -9 of one rank, while it writes", lambda n: faults.kill_one_rank(n, during_output=True)),
             ("kill -9 of all ranks, while they write", lambda n: faults.kill_all(n, during_output=True))]
    for k in range(kills):
        name, trial = kinds[k // 4 % 4]
        yield name, None, trial, next(ranks)
    library = None if faults.program.failing_writes else "--failing-writes"
    mount = None if os.geteuid() == 0 else "the right to mount"
    for name, missing, trial in (
            ("SIGTERM", None, lambda n: faults.signalled(n, signal.SIGTERM)),
            ("SIGINT", None, lambda n: faults.signalled(n, signal.SIGINT)),
            ("SIGUSR1", None, lambda n: faults.signalled(n, signal.SIGUSR1)),
            ("SIGTERM behind the end", None, lambda n: faults.signalled_at_end(n, signal.SIGTERM)),
            ("--time-limit", None, faults.out_of_time), ("failing write", library, faults.failing_writes),
            ("files of limited size", None, faults.files_of_limited_size), ("full disk", mount, faults.full_disk),
            ("checkpoint cut off, or a bit flipped", None, faults.damaged_checkpoint)):
        for _ in range(others):
            yield name, missing, trial, next(ranks)


def carry_out(trials):
    """Outcomes and losses by the name of the fault, and what tools are missing."""
    outcomes, lost, missing = collections.defaultdict(list), collections.defaultdict(list), set()
    for number, (name, tool, trial, ranks) in enumerate(trials, 1):
        if tool:
            missing.add(tool)
            continue
        try:
            outcome = trial(ranks)
            outcomes[name].append(outcome)
            print(f"{number:4} {name}, {ranks} ranks: status {outcome.status}, "
                  f"{100 * outcome.lost_share:.1f} % again  {outcome.message[:100]}", flush=True)
        except KeyboardInterrupt:
            break
        except Lost as why:
            lost[name].append(f"{ranks} ranks: {why}")
            print(f"{number:4} {name}: LOST", lost[name][-1], flush=True)
    return outcomes, lost, missing


def table(program, outcomes, lost, missing, seconds):
    """Markdown."""
    lines = ["| fault | tried | before the end | status | runs lost | most work to do again |",
             "|---|---|---|---|---|---|"]
    for fault in sorted({*outcomes, *lost}):
        found, gone = outcomes[fault], len(lost[fault])
        hit = [outcome for outcome in found if outcome.status != 0]
        states = ", ".join(str(s) for s in sorted({outcome.status for outcome in hit}, key=abs))
        most = max((outcome.lost_share for outcome in found), default=0)
        lines.append(f"| {fault} | {len(found) + gone} | {len(hit) + gone} | {states} | {gone} | "
                     f"{100 * most:.1f} % |")
    tried, gone = (sum(map(len, some.values())) for some in (outcomes, lost))
    lines += ["", f"{program}: {tried + gone} trials in {seconds / 60:.0f} minutes on {os.cpu_count()} cores of "
              f"{platform.machine()}; runs lost: **{gone}**."]
    lines += [f"- lost: {fault}, {why}" for fault in lost for why in lost[fault]]
    if missing:
        lines += ["", "Not tried for want of " + ", ".join(sorted(missing)) + "."]
    return "\n".join(lines) + "\n"


def revision(mpm_par):
    """`mpm_par 1.2.3 (438b61606e1d)`"""
    said = subprocess.run([mpm_par, "--version"], capture_output=True, text=True, check=True).stdout
    [commit] = re.findall(r"^git +(\S+)", said, re.M)
    name = " ".join(said.splitlines()[0].split())
    return f"{name} ({commit[:12]}{'-dirty' * commit.endswith('-dirty')})"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("mpm_par", type=pathlib.Path)
    options.add_argument("--kills", type=int, default=240)
    options.add_argument("--others", type=int, default=40)
    options.add_argument("--failing-writes", type=pathlib.Path)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--write", action="store_true")
    asked = options.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        faults = Faults(Program(asked.mpm_par.resolve(), os.environ.get("MPM_MPIEXEC", "mpirun"),
                                os.environ.get("MPM_NUMPROC_FLAG", "-n"),
                                asked.failing_writes and asked.failing_writes.resolve()),
                        scratch, asked.seed)
        begin = time.monotonic()
        trials = list(plan(faults, asked.kills, asked.others))
        faults.random.shuffle(trials)
        outcomes, lost, missing = carry_out(trials)
        text = table(revision(asked.mpm_par), outcomes, lost, missing, time.monotonic() - begin)
    print(text)
    if asked.write:
        before, rest = PAGE.read_text().split(BEGIN)
        PAGE.write_text(before + BEGIN + text + END + rest.split(END)[1])
    return 1 if any(lost.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
