"""The plan of a run: what it says is allocated, passed and sent is what the run has, and what the
scene does not need is not there."""
import pathlib
import unittest
import unittest.mock

from program import ProgramTest, mpm_par, scene, set_options, summary

FLIGHT = """
material: {law: isotropic, youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 1000 kg/m^3}
specimen:
  size: [1 mm, 1 mm]
  shapes: [{box: {lower: [0 mm, 0 mm], upper: [1 mm, 1 mm]}, velocity: [1 m/s, 0 m/s]}]
grid: {cells: [20, 20], margin: MARGIN}
free_motion: {end_time: 1 us}
steps: 20
output: {snapshots: 0}
"""
PLASTIC = ("material={law: von_mises, youngs_modulus: 50 GPa, poisson_ratio: 0.3, "
           "density: 1000 kg/m^3, yield_stress: 1 GPa}")
LOAD = "loads=[{kind: gravity, acceleration: ACCELERATION}]"
LOAD_CELL = "loading.load_cell={cells: 5}"
FIRST_PLACES = "exact_solution={displacement: [0 m, 0 m]}"

# Six typical scenes, and the columns that they need. In the plane a vector has two components.
MOTION = {"id": 8, "position": 16, "velocity": 16, "mass": 8}
ELASTIC = {"initial_volume": 8, "elastic_left_cauchy_green": 24}
YIELDS = ELASTIC | {"elastic_log_strain_zz": 8, "plastic_strain": 8, "plastic_work": 8}
NODES = {"mass": 8, "momentum_force": 32, "updated_velocity": 32, "gradient_velocity": 32,
         "marks": 3}
MAPPED_BACK = {"remapped_momentum": 16}
IN_SPACE = {"id": 8, "position": 24, "velocity": 24, "mass": 8}
ELASTIC_IN_SPACE = {"initial_volume": 8, "elastic_left_cauchy_green": 48}
NODES_IN_SPACE = {"momentum_force_mass": 64, "updated_velocity": 64, "gradient_velocity": 32,
                  "marks": 3}
SCENES = [  # name, scene, settings, columns of a particle and of a node
    ("elastic block, USL", "confined_block", ["numerics.update_order=usl"],
     [MOTION | ELASTIC], NODES),
    ("elastic block, USF, APIC", "confined_block",
     ["numerics.update_order=usf", "numerics.scheme=apic"],
     [MOTION | ELASTIC | {"affine_velocity": 32}], NODES),
    ("plastic honeycomb, MUSL", "honeycomb", [],
     [MOTION | YIELDS | {"grid_velocity": 16}], NODES | MAPPED_BACK),
    ("plastic block with all parts, APIC, MUSL", "confined_block",
     ["numerics.scheme=apic", PLASTIC, LOAD.replace("ACCELERATION", "[1 m/s^2, 0 m/s^2]"),
      LOAD_CELL, FIRST_PLACES],
     [MOTION | columns | {"affine_velocity": 32, "grid_velocity": 16, "initial_position": 16}
      for columns in (YIELDS, ELASTIC)], NODES | MAPPED_BACK | {"load_force": 16}),
    ("elastic block in space, MUSL", "confined_block_space", [],
     [IN_SPACE | ELASTIC_IN_SPACE | {"grid_velocity": 24}],
     NODES_IN_SPACE | {"remapped_momentum": 32}),
    ("elastic block in space, USF, FMPM", "confined_block_space",
     ["numerics.scheme=fmpm", "numerics.update_order=usf",
      LOAD.replace("ACCELERATION", "[1 m/s^2, 0 m/s^2, 0 m/s^2]")],
     [IN_SPACE | ELASTIC_IN_SPACE], NODES_IN_SPACE | {"remapped_momentum": 32, "load_force": 24}),
]
LOBLOLLY = pathlib.Path(__file__).parents[2] / "inputs" / "wood" / "loblolly_radial.yaml"
LANES = 8  # particles side by side at most: their columns are padded to whole blocks


class Plan(ProgramTest):
    def run_of(self, name, *settings, ranks=1, steps=20, label="results"):
        return summary(self.results(name, f"steps={steps}", *settings, ranks=ranks, label=label))

    def planned(self, name, *settings):
        return self.run_of(name, *settings, steps=1)["plan"]

    def test_six_typical_scenes_take_the_bytes_that_their_columns_have(self):
        for number, (words, name, settings, particles, nodes) in enumerate(SCENES):
            with self.subTest(words):
                found = self.run_of(name, *settings, label=str(number))
                plan = found["plan"]
                self.assertEqual([body["bytes"] for body in plan["particles"].values()], particles)
                self.assertEqual(plan["nodes"]["bytes"], nodes)
                self.assertEqual(plan["bytes_per_particle"],
                                 max(sum(columns.values()) for columns in particles))
                self.assertEqual(plan["bytes_per_node"], sum(nodes.values()))
                bodies = [(body["count"], sum(body["bytes"].values()))
                          for body in plan["particles"].values()]
                self.assertEqual(sum(count for count, _ in bodies), found["particles"])
                self.assertEqual(plan["nodes"]["allocated"], plan["nodes"]["largest_rank"])
                self.assertEqual(plan["bytes"], sum(n * b for n, b in bodies) +
                                 plan["nodes"]["allocated"] * plan["bytes_per_node"])
                # What is allocated: no less, and no more than the padding.
                padding = 4 * 8 * ("mass" in nodes) + sum((LANES - 1) * b for _, b in bodies)
                self.assertGreaterEqual(found["largest_rank_bytes"], plan["bytes"])
                self.assertLessEqual(found["largest_rank_bytes"], plan["bytes"] + padding)

    def test_elastic_scene_in_the_plane_has_no_column_that_it_does_not_need(self):
        plan = self.planned("confined_block")
        columns = plan["particles"]["cell_wall"]["bytes"]
        self.assertFalse([name for name in columns if "plastic" in name or "gradient" in name])
        self.assertEqual((columns["position"], columns["velocity"]), (2 * 8, 2 * 8))
        for what in ("plastic strain and work", "deformation gradient", "third component"):
            self.assertIn(what, plan["left_out"])
            self.assertGreater(len(plan["left_out"][what]), 5, "a reason")
        plastic = self.planned("confined_block", PLASTIC)
        self.assertIn("plastic_work", plastic["particles"]["cell_wall"]["bytes"])
        self.assertNotIn("plastic strain and work", plastic["left_out"])

    def test_deformation_gradient_is_there_where_the_law_needs_it(self):
        plan = self.planned("confined_block", "material.strain_measure=hypoelastic")
        self.assertEqual(plan["particles"]["cell_wall"]["bytes"]["deformation_gradient"], 4 * 8)
        self.assertNotIn("deformation gradient", plan["left_out"])

    def test_particles_have_domains_where_the_shape_function_deforms_them(self):
        plan = self.planned("confined_block")
        self.assertNotIn("domain", plan["particles"]["cell_wall"]["bytes"])
        self.assertIn("particle domains", plan["left_out"])
        for name, width in (("confined_block", 4), ("confined_block_space", 9)):
            plan = self.planned(name, "numerics.shape_function=cpdi")
            self.assertEqual(plan["particles"]["cell_wall"]["bytes"]["domain"], width * 8)
            self.assertNotIn("particle domains", plan["left_out"])

    def test_usf_and_usl_hold_no_re_mapped_momentum(self):
        for order, passes in (("usf", ["usf_stress", "usf_velocity"]), ("usl", ["usl"]),
                              ("musl", ["musl_velocity", "musl_stress"]),
                              ("usavg", ["usf_stress", "musl_velocity", "usavg_stress"]),
                              ("musl_displacement", ["musl_velocity", "musl_displacement"])):
            with self.subTest(order):
                plan = self.planned("confined_block", f"numerics.update_order={order}")
                self.assertEqual(plan["passes"], passes)
                maps_back = order not in ("usf", "usl")
                self.assertEqual("remapped_momentum" in plan["nodes"]["bytes"], maps_back)
                self.assertEqual("grid_velocity" in plan["particles"]["cell_wall"]["bytes"],
                                 maps_back)
                self.assertEqual("re-mapped momentum" in plan["left_out"], not maps_back)

    def test_conditions_are_those_that_the_scene_has(self):
        for settings, conditions in (
                ([], ["right: piston", "left: fixed edge", "bottom: rigid", "top: rigid"]),
                (["loading.lateral=free"], ["right: piston", "left: fixed edge"]),
                (["loading.lateral=periodic"], ["right: piston", "left: fixed edge"])):
            plan = self.planned("confined_block", *settings)
            self.assertEqual(plan["conditions"], conditions)
            self.assertEqual("walls beside the travel" in plan["left_out"], len(conditions) == 2)

    def test_messages_and_bytes_of_a_step_are_those_that_are_sent(self):
        for settings in ([], ["numerics.update_order=usl"], ["numerics.update_order=usf"],
                         ["numerics.update_order=usavg"],
                         ["numerics.scheme=fmpm", "numerics.update_order=usf"],
                         [LOAD.replace("ACCELERATION", "[1 m/s^2, 0 m/s^2]")]):
            with self.subTest(settings=settings):
                found = self.run_of("confined_block", *settings, ranks=2)
                plan, steps = found["plan"], found["steps"]
                self.assertEqual((found["migrated"], found["repartitions"]), (0, 0))
                values = plan["values_per_shared_node"]
                # One neighbour: a message a pass, each with a number beside its sums.
                self.assertEqual(plan["messages_per_step"], len(values))
                shared = (plan["bytes_per_step"] / 8 - len(values)) / sum(values)
                # Before the first step the sums are formed once that a step ends with.
                self.assertAlmostEqual(found["messages_per_step"] * steps,
                                       plan["messages_per_step"] * steps + 1)
                self.assertAlmostEqual(found["bytes_per_step"] * steps, plan["bytes_per_step"] *
                                       steps + 8 * (values[-1] * shared + 1))

    def test_one_rank_sends_nothing(self):
        found = self.run_of("confined_block")
        self.assertEqual(found["messages_per_step"], 0)
        self.assertEqual(found["plan"]["messages_per_step"], 0)
        self.assertIn("messages", found["plan"]["left_out"])

    def flight(self, margin):
        file = self.folder / "flight.yaml"
        file.write_text(FLIGHT.replace("MARGIN", margin))
        run = mpm_par(file, "--overwrite", "--output", self.folder / "results")
        self.assertEqual(run.returncode, 0, run.stderr)
        return summary(self.folder / "results")

    def test_empty_nodes_take_what_the_plan_says_and_are_not_updated(self):
        near, wide = self.flight("0.5 mm"), self.flight("2 mm")
        reach = wide["plan"]["nodes"]["updated_below_cell"] + \
            wide["plan"]["nodes"]["updated_above_cell"]
        for found in (near, wide):
            # The box of nodes holds 20 cells, the margins and two cells beyond them.
            cells = 20 + 2 * (10 if found is near else 40) + 2 * 2
            self.assertEqual(found["plan"]["nodes"]["allocated"], (cells + 1) ** 2)
            # What stencils may reach from 20 x 20 cells with particles.
            self.assertGreaterEqual(found["active_nodes"], (20 + 1) ** 2)
            self.assertLessEqual(found["active_nodes"], (20 + reach) ** 2)
        self.assertEqual(wide["active_nodes"], near["active_nodes"])
        self.assertEqual(wide["largest_rank_bytes"] - near["largest_rank_bytes"],
                         (105 ** 2 - 45 ** 2) * wide["plan"]["bytes_per_node"])

    def test_without_snapshots_the_hdf5_library_is_not_started(self):
        # When it starts, the library complains of a word that it does not know in this variable.
        for count, written in ((0, 0), (2, 1)):  # the second one would come at the end
            folder = self.folder / str(count)
            with unittest.mock.patch.dict("os.environ", {"HDF5_DEBUG": "unheard"}):
                run = mpm_par(scene("confined_block"), "--output", folder,
                              *set_options([f"output.snapshots={count}", "steps=2"]))
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual("unheard" in run.stderr, written > 0, run.stderr)
            self.assertEqual(len(list(folder.rglob("*.h5"))), written)
            self.assertEqual((folder / "snapshots").exists(), written > 0)

    def test_a_run_without_snapshots_leaves_no_list_of_earlier_ones(self):
        for count in (2, 0):
            self.results("confined_block", f"output.snapshots={count}", "steps=2")
            self.assertEqual((self.folder / "results" / "confined_block.xdmf").exists(), count > 0)

    def test_the_text_fits_eighty_columns(self):
        scenes = [(scene(name), settings) for _, name, settings, _, _ in SCENES]
        scenes.append((LOBLOLLY, ["grid.cells=[40, 26]", "numerics.mass_scaling=0", "loading.speed=100 m/s"]))
        for file, settings in scenes:
            run = mpm_par("--check", file, *set_options(settings), ranks=2)
            self.assertEqual(run.returncode, 0, run.stderr)
            if file == LOBLOLLY:
                self.assertIn("  warning", run.stdout)
            for line in run.stdout.splitlines():
                self.assertLessEqual(len(line), 80, line)


if __name__ == "__main__":
    unittest.main()
