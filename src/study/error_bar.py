"""The numerical error of one scene: it is run at other levels too, and its figures get a bar.

This is the part that runs; NumPy is loaded after it (see program.py).
"""
import pathlib

import store
from problems import BAD_INPUT, InputError, NoResult
from mpm_par.quantities import to_si
from yaml_tree import read_value, read_yaml

import resolution


def assignments_of(given):
    """(key, value) pairs of --set; no snapshots are written."""
    pairs = []
    for text in given.set:
        key, equals, value = text.partition("=")
        if not equals or not key:
            raise InputError(f"--set {text}: is no assignment. Write --set path.to.key=value.")
        pairs.append((key, value))
    if not any(key.startswith("output.snapshots") for key, _ in pairs):
        pairs.append(("output.snapshots", "0"))
    return pairs


def plateau_range(given):
    """The strains of --plateau as fractions."""
    try:
        (kind, low), (other, high) = map(to_si, given.plateau)
        if {kind, other} != {"number"}:
            raise ValueError("are no strains")
        ends = low, high
        if not 0 <= ends[0] < ends[1] < 1:
            raise ValueError("does not rise within 0 and 100 %")
    except ValueError as error:
        raise InputError(f"--plateau {' '.join(given.plateau)} ({error}). "
                         "Write e.g. --plateau '5 %' '15 %'.") from None
    return ends


def check_factors(given):
    for factor in (*given.levels, *given.finer):
        if not 1.1 <= factor <= 10:
            raise InputError(f"{factor:g} is no factor for a level (not from 1.1 to 10). "
                             "Write e.g. --levels 1.5 2.25 --finer 1.5.")
    if len(set(given.levels)) + len(set(given.finer)) < 2:
        raise InputError("An order takes two levels beside the scene's own. "
                         "Write e.g. --levels 1.5 2.25.")


def _get(tree, path):
    for key in path.split("."):
        if not tree.is_map or key not in tree.value:
            return None
        tree = tree.value[key]
    return tree


def axes_of_pieces(scene, effective, cells):
    """Along how many axes pieces of wall are looked for: of a picture that is drawn out, in a layer."""
    named = getattr(_get(effective, "specimen.micrograph"), "text", None)
    if named is None or len(cells) == 2 or _get(effective, "specimen.remove_specks") is None:
        return len(cells)
    path = pathlib.Path(scene).parent / named
    if path.name.endswith(".anatomy.yaml"):
        return 3 if _get(read_yaml(path), "grain") else 2
    if "*" in path.name:
        return 3 if len(list(path.parent.glob(path.name))) > 1 else 2
    from PIL import Image  # as NumPy, after the runs
    Image.MAX_IMAGE_PIXELS = None  # mpm_par has read it
    with Image.open(path) as picture:
        return 3 if getattr(picture, "n_frames", 1) > 1 else 2


def level_assignments(assignments, own, effective, cells, factor, piece_axes):
    """Settings of a level whose cells are `factor` times as large; what is given in cells or in
    particles is scaled so that the geometry stays.

    own: the scene's tree; effective: that of the scene with every default; cells: of the scene;
    piece_axes: along how many axes pieces of wall are looked for."""
    if factor == 1:
        return assignments
    settings = dict(assignments)
    spacing = settings.get("grid.spacing") or getattr(_get(own, "grid.spacing"), "text", None)
    if spacing:
        settings["grid.spacing"] = resolution.coarsened("grid.spacing", spacing, factor)
    else:
        settings["grid.cells"] = resolution.coarsened("grid.cells", str(cells), factor)
    load_cell = _get(effective, "loading.load_cell.cells")
    if load_cell is not None:
        settings["loading.load_cell.cells"] = str(max(1, round(int(load_cell.text) / factor)))
    specks = _get(effective, "specimen.remove_specks")
    if specks is not None and int(specks.text) > 0:
        settings["specimen.remove_specks"] = str(round(int(specks.text) / factor ** piece_axes))
    return list(settings.items())


def _run_level(given, program, kept, assignments, factor):
    name = "as it is" if factor == 1 else f"cells x {factor:.3g}"
    done = kept.find(assignments, given.ranks, 1)
    before = done is not None
    if not before:
        done = kept.run(program, given.file, assignments, given.ranks, 1)
    said = "done before" if before else f"{done.ended.elapsed_seconds:.1f} s"
    if done.ended.exit_status:
        said += f", failed: {done.ended.message}"
    print(f"{name}: {said}", flush=True)
    return done


def run_levels(given, program, output):
    """[(factor, store.Done)] from coarse to fine of the levels that ended well."""
    own = read_yaml(given.file)
    assignments = assignments_of(given)
    if _get(own, "steps") or any(key == "steps" for key, _ in assignments):
        raise InputError(f"{given.file}: has steps, and every level would end at another time. "
                         "Remove the key.")
    check_factors(given)
    trees = [own, *(read_value(value, "--set") for _, value in assignments)]
    kept = store.Store(output, store.scene_print(given.file, trees), program.identity)
    base = _run_level(given, program, kept, assignments, 1)
    if base.ended.exit_status:
        kind = InputError if base.ended.exit_status == BAD_INPUT else NoResult
        raise kind(base.ended.message)
    if "compression" not in base.summary:
        raise InputError(f"{given.file}: compresses nothing, so there is no modulus. "
                         "Use a study with an error of your own: docs/studies.md.")
    effective = read_yaml(base.folder / "scene.yaml")
    cells = base.summary["cells"]
    axes = axes_of_pieces(given.file, effective, cells)
    found = [(1, base)]
    for factor in sorted({*given.levels, *(1 / f for f in given.finer)}, reverse=True):
        settings = level_assignments(assignments, own, effective, cells, factor, axes)
        done = _run_level(given, program, kept, settings, factor)
        if done.ended.exit_status == 0:
            found.append((factor, done))
    return sorted(found, key=lambda pair: -pair[0])


def run(given, program, output):
    """Runs the levels, prints the bars and writes error_bar.json and error_bar.csv."""
    plateau = plateau_range(given)
    output.mkdir(parents=True, exist_ok=True)
    levels = run_levels(given, program, output)
    import error_bar_report
    error_bar_report.write(given, program, levels, plateau, output)
