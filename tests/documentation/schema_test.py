"""docs/scene.schema.json refuses what it can of what mpm_par refuses, and never what mpm_par takes."""
import copy
import json
import unittest

import jsonschema
import pages
import yaml
from program import ProgramTest, mpm_par, set_options

FOLDERS = (pages.PROJECT / "inputs", *sorted((pages.PROJECT / "tests").glob("*/scenes")))
SCENES = [path for folder in FOLDERS for path in sorted(folder.rglob("*.yaml"))
          if not path.name.endswith(".anatomy.yaml") and path.parent.name != "studies"]

BLOCK = """
material: {law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes:
    - box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}
grid: {cells: [8, 8]}
numerics: {formulation: updated_lagrangian}
loading: {piston: right, speed: 10 m/s}
"""

# Changes of the block, each wrong at the key named, which mpm_par says as well.
BROKEN = (
    {"material.youngs_modulas": "1 GPa", "grid.cells": [8], "loading.speed": "-10 m/s",
     "output.fields": ["stres"], "steps": 0.5, "numerics.domain": 0.1, "loads": [{"kind": "gravity"}]},
    {"material.yield_stress": "1 MPa",  # of another law
     "grid.spacing": "0.1 mm",  # beside cells
     "numerics.refinement_order": 4,  # of another scheme
     "specimen.pixel_size": "1 um",  # without a micrograph
     "loading.strain": 2, "output.checkpoints.steps": 5},
    {"material.poisson_ratio": 0.7, "material.youngs_modulus": -1, "grid.particles_per_cell": 9,
     "numerics.mass_scaling": 0.5,  # of the other formulation
     "loading.lateral": ["rigid"], "output.compress": 2},
    {"material.density": "1000", "material.law": "von_misses", "loading.load_cell.cells": "many",
     "free_motion.end_time": 3},
    {"material.density": "0 kg/m^3", "numerics.scheme": 1,
     "specimen.shapes": [{"box": {"lower": ["0 m", "0 m"], "upper": ["1 mm", "1 mm"]},
                          "disc": {"centre": ["0 m", "0 m"], "radius": "1 mm"}}]},
)
# What mpm_par takes, written in another way than the page shows it.
TAKEN = (
    {"material.poisson_ratio": "+3e-1", "material.youngs_modulus": "1e3MPa",
     "material.density": "1 g/cm^3", "title": 5, "grid.margin": "-0 mm", "numerics": None,
     "grid.particles_per_cell": 2.0, "loading.strain": "6e1%", "loading.load_cell": None,
     "loading.lateral": "free", "loading.ramp_time": ".5us", "output.snapshots": "3"},
    {"numerics.f_bar": "yes", "numerics.cfl": "0.4", "output.snapshots.strains": ["0 %", 0.2],
     "output.compress": True, "definitions": {"a": 2, "b": "a*t"},
     "specimen.initial_velocity": ["X*1e-3", "1 m/s"],
     "specimen.windows": [{"name": 1, "x": ["0 %", 0.5]}]},
)


def changed(changes):
    scene = yaml.safe_load(BLOCK)
    for path, value in changes.items():
        *maps, key = path.split(".")
        target = scene
        for step in maps:
            if not isinstance(target.get(step), dict):
                target[step] = {}
            target = target[step]
        target[key] = copy.deepcopy(value)
    return scene


def keys_at_fault(error, scene):
    """Dotted keys, without places in lists, that an error of jsonschema concerns."""
    steps = list(error.absolute_path)
    if error.validator is None:  # a key that may not be there: some versions name its map alone
        there = scene
        for step in steps:
            there = there[step]
        if there is not error.instance:
            steps.append(next(key for key in there if there[key] is error.instance))
    path = [step for step in steps if isinstance(step, str)]
    inner = {key for below in error.context or () for key in keys_at_fault(below, scene)}
    if error.validator == "additionalProperties":
        known = error.schema["properties"]
        return {".".join([*path, key]) for key in error.instance if key not in known}
    if error.validator == "required":
        return {".".join([*path, key]) for key in error.validator_value
                if key not in error.instance}
    return {".".join(path), *inner}


class Schema(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((pages.DOCS / "scene.schema.json").read_text())
        jsonschema.Draft7Validator.check_schema(cls.schema)
        cls.validator = jsonschema.Draft7Validator(cls.schema)

    def errors(self, scene):
        return [f"{error.json_path}: {error.message[:200]}"
                for error in self.validator.iter_errors(scene)]

    def answer(self, scene):
        """Of mpm_par --check."""
        file = self.folder / "scene.yaml"
        file.write_text(yaml.safe_dump(scene, sort_keys=False))
        return mpm_par(file, "--check")

    def test_takes_every_scene_that_is_shipped_or_tested(self):
        self.assertGreater(len(SCENES), 60)
        for path in SCENES:
            with self.subTest(path.relative_to(pages.PROJECT).as_posix()):
                self.assertEqual(self.errors(yaml.safe_load(path.read_text())), [])

    def test_takes_the_effective_scene_of_a_run(self):
        for path, steps in (("wood/loblolly_radial", 1), ("tutorial/punch", 1),
                            ("tutorial/tubes", 1), ("benchmarks/vortex", 1)):
            with self.subTest(path):
                folder = self.folder / path
                run = mpm_par(pages.PROJECT / "inputs" / f"{path}.yaml", "--output", folder,
                              *set_options([f"steps={steps}", "output.snapshots=0"]))
                self.assertEqual(run.returncode, 0, run.stderr)
                self.assertEqual(self.errors(yaml.safe_load((folder / "scene.yaml").read_text())),
                                 [])

    def test_refuses_with_mpm_par_at_the_same_key(self):
        for changes in BROKEN:
            scene = changed(changes)
            run = self.answer(scene)
            self.assertEqual(run.returncode, 2, run.stdout)
            wrong = {key for error in self.validator.iter_errors(scene)
                     for key in keys_at_fault(error, scene)}
            for path in changes:
                with self.subTest(path):
                    self.assertIn(path.split(".")[-1], run.stderr)
                    self.assertTrue(any(found == path or found.startswith(path + ".")
                                        for found in wrong), f"{path} is not among {wrong}")

    def test_takes_with_mpm_par_what_is_written_in_another_way(self):
        for changes in TAKEN:
            scene = changed(changes)
            run = self.answer(scene)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(self.errors(scene), [])

    def test_describes_every_key_of_the_reference_page(self):
        reference = (pages.DOCS / "input_reference.md").read_text()
        maps = [self.schema, *self.schema["definitions"].values()]
        described = sum(len(one["properties"]) for one in maps)
        rows = {line.split("`")[1] for line in reference.splitlines() if line.startswith("| `")}
        named = {key for one in maps for key in one["properties"]}
        self.assertGreater(described, 100)
        self.assertLessEqual(named, rows)
        for one in maps:
            for key, value in one["properties"].items():
                texts = [value, *value.get("anyOf", [])]
                self.assertTrue(any("description" in text for text in texts), key)


if __name__ == "__main__":
    unittest.main()
