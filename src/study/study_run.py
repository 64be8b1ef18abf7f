"""A study from its file to its tables and plots."""
import itertools
import time

import machine
import store
import study_file
from mpm_par.problems import WIDTH
from problems import DONE, NoResult
from yaml_tree import read_yaml


def check_keys(study, program):
    """A key that no scene knows is a mistake in the study file; a value that this scene does not
    bear is a row of the table. Keys of a run that mpm_par accepts as a whole are known; of the
    others each is tried by itself."""
    unknown = {key: nodes[0] for key, nodes in study.nodes.items() if key != "ranks"}
    for combination in study.combinations:
        own = [key for key, _ in study.assignments(combination) if key in unknown]
        if own and not program.check(study.scene, study.assignments(combination)):
            unknown = {key: node for key, node in unknown.items() if key not in own}
    for key, node in unknown.items():
        for said in program.check(study.scene, [(key, node.text)]):
            if said.startswith(f"--set {key}=") and ": unknown key" in said:
                raise node.wrong(f"{key} is no key of the scene", said.split(": ", 1)[1])


def _name(study, combination):
    """Values of what varies, for the line that tells of the run."""
    words = [combination.label] if combination.label else []
    words += [combination.name_of(key) or value for key, value in combination.settings
              if key not in combination.labelled]
    if "ranks" in study.varied:
        words.append(combination.name_of("ranks") or f"{combination.ranks} ranks")
    return ", ".join(words) or "the scene as it is"


def _is_bad(done):
    return done.ended.exit_status != DONE or done.ended.stopped


def run_all(study, program, kept, say=print, part=(1, 1)):
    """All rounds in turn: every run once, then every run again. Returns a list of rounds for each
    combination. What failed, and what is only for the reference, is not repeated. Of part (K, N)
    only every N-th combination is run."""
    rounds = [[] for _ in study.combinations]
    before = 0
    for turn in range(1, study.repeat + 1):
        for k, combination in enumerate(study.combinations):
            if k % part[1] != part[0] - 1:
                continue
            if turn > 1 and (_is_bad(rounds[k][0]) or combination.only_reference):
                continue
            assignments = study.assignments(combination)
            done = kept.find(assignments, combination.ranks, turn, study.time_limit)
            if done:
                before += 1
            else:
                done = kept.run(program, study.scene, assignments, combination.ranks, turn,
                                study.time_limit)
                end = f"failed: {done.ended.message}" if _is_bad(done) else \
                    f"{done.ended.elapsed_seconds:.1f} s"
                line = (f"round {turn}/{study.repeat} run {k + 1}/{len(rounds)}: "
                        f"{_name(study, combination)}: {end}")
                say(line if len(line) <= WIDTH else line[:WIDTH - 2] + "..")
            rounds[k].append(done)
    if before:
        say(f"{before} runs were done before")
    return rounds


def provenance(study, program):
    """What it takes to do the study again."""
    return {"study": study.path.name, "scene": study.scene.name,
            "study_text": study.path.read_text(encoding="utf-8"),
            "scene_text": study.scene.read_text(encoding="utf-8"),
            "written": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "mpm_par": program.version, "mpm_par_sha256": program.identity,
            "machine": machine.machine()}


def run_studies(given, program, output):
    """All studies that the command names, each in a folder of its own if there are several. What
    is wrong in one is said before any runs; one without a figure does not keep the next ones."""
    studies = [study_file.read_study(path, given.quick, given.ranks) for path in given.files]
    for study in studies:
        check_keys(study, program)
    if len(studies) == 1:
        run(studies[0], given.part, program, output)
        return
    without = []
    for k, study in enumerate(studies, 1):
        print(f"study {k}/{len(studies)}: {study.title}", flush=True)
        try:
            run(study, given.part, program, output / study.path.stem)
        except NoResult as none:
            print(none, flush=True)
            without.append(study.path.name)
    if without:
        raise NoResult(f"no run gave a figure: {', '.join(without)}.")


def run(study, part, program, output):
    """Runs what is not done, then writes study.csv, study.json and the plots into `output`."""
    output.mkdir(parents=True, exist_ok=True)
    trees = [read_yaml(study.scene), *itertools.chain(*study.nodes.values())]
    kept = store.Store(output, store.scene_print(study.scene, trees), program.identity)
    rounds = run_all(study, program, kept, lambda line: print(line, flush=True),
                     part or (1, 1))
    if part:
        done = sum(bool(of_run) for of_run in rounds)
        print(f"part {part[0]} of {part[1]}: {done} of {len(rounds)} runs done. Without "
              "--part the same\ncommand writes the tables when all parts have ended.")
        return

    import evaluation  # after the runs: NumPy and Matplotlib are large (see program.py)
    import plot
    import tables
    rows = [evaluation.row_of(study, *pair) for pair in zip(study.combinations, rounds)]
    outcomes = [evaluation.outcome_of(study, measure, rows) for measure in study.measures]
    store.write_whole(output / "study.csv", tables.csv_text(study, rows))
    store.write_whole(output / "study.json",
                      tables.json_text(study, rows, outcomes, provenance(study, program), output))
    paths = [path for outcome in outcomes if outcome.measure.against is not None
             for path in plot.draw(study, rows, outcome, output)]
    print(tables.terminal_text(study, rows, outcomes), end="")
    print("".join(f"  {path}\n" for path in paths), end="", flush=True)
    if not any(value is not None for row in rows for value in row.values.values()):
        raise NoResult(f"{study.path}: no run gave a figure. The reasons are in "
                       f"{output / 'study.csv'}.")
