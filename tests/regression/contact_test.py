"""Walls that push, and contact between bodies, in whole runs."""
import math
import unittest

from program import History, ProgramTest, mpm_par, summary

CONFINED = 50e9 * 0.7 / (1.3 * 0.4)
GRAVITY, ANGLE, MASS = 9.81, math.radians(30), 250
RAMP, END = 0.1, 0.8
PUSHED = ["loading.grip=contact", "numerics.update_order=musl_displacement"]


class Contact(ProgramTest):
    def line_error(self, history, strains):
        """Mean error of the stress against that of one uniform block."""
        found = [k for k in range(1, len(history)) if strains[0] <= history["strain"][k] <= strains[1]]
        self.assertGreater(len(found), 10)
        exact = [-CONFINED * math.log(1 - e) / (1 - e)
                 for e in (0.5 * (history["strain"][k] + history["strain"][k - 1]) for k in found)]
        return sum(history["stress"][k] / e - 1 for k, e in zip(found, exact)) / len(found)

    def test_a_wall_that_pushes_is_as_soft_as_its_contact_and_books_all_energy(self):
        """A location over kappa at each end of the 40 of the block, less the half one between the
        wall and the particle that it pushes."""
        for kappa, softer in ((0.25, (8 - 1) / 40), (1, (2 - 1) / 40)):
            history = History(self.results("confined_block", *PUSHED, "loading.strain=1 %",
                                           f"numerics.contact_stiffness={kappa}",
                                           label=f"kappa_{kappa}"))
            error = self.line_error(history, (0.004, 0.01))
            self.assertAlmostEqual(error, 1 / (1 + softer) - 1, delta=0.015)
            self.assertLess(max(abs(e) for e in history["energy_error"][-50:]), 0.01)
            self.assertLess(max(history["momentum_error"]), 1e-12)
            self.assertGreater(history["contact_energy"][-1], 0)

    def test_a_block_pressed_on_another_carries_the_exact_stress(self):
        history = History(self.results("two_blocks", ranks=2))
        self.assertAlmostEqual(self.line_error(history, (0.004, 0.01)), 0, delta=0.02)
        self.assertLess(max(abs(e) for e in history["energy_error"][-50:]), 0.02)
        self.assertLess(max(history["momentum_error"]), 1e-12)

    def test_blocks_of_cells_lie_on_each_other_as_deep_as_the_contact_is_soft(self):
        """Of the 40 locations of the block a quarter of one times the strain, as the pressure is 4 C
        times the depth, and half of the onset, 0.005 of a location."""
        history = History(self.results("two_blocks", "numerics.formulation=total_lagrangian",
                                       ranks=2, label="cells"))
        strains = [e for e in history["strain"] if 0.004 <= e <= 0.01]
        softer = sum((0.25 + 0.0025 / e) / 40 for e in strains) / len(strains)
        self.assertAlmostEqual(self.line_error(history, (0.004, 0.01)), 1 / (1 + softer) - 1,
                               delta=0.003)
        self.assertLess(max(abs(e) for e in history["energy_error"][-50:]), 0.001)
        self.assertLess(max(history["momentum_error"]), 1e-12)

    def test_a_plate_of_one_cell_squeezed_from_both_sides_stays_and_carries_the_stress(self):
        """Two faces, each as deep as 4 C (T + T^3 / 0.03^2) takes, and half of the onset."""
        history = History(self.results("squeezed_plate", ranks=2))
        for before, after, stress in zip(history["strain"], history["strain"][1:],
                                         history["stress"][1:]):
            strain = 0.5 * (before + after)
            if strain < 0.02:
                continue
            depth = 0.0
            for _ in range(50):
                depth = stress / (4 * CONFINED) / (1 + (depth / 0.03) ** 2)
            solid = strain - 2 * (depth + 0.0025) / 40
            exact = -CONFINED * math.log(1 - solid) / (1 - solid)
            self.assertAlmostEqual(stress / exact, 1, delta=0.01)
        self.assertLess(max(abs(e) for e in history["energy_error"][10:]), 1e-4)
        self.assertLess(max(history["momentum_error"]), 1e-11)
        # The plate's cells lie on both blocks, two locations apart and so one wall to them, with a part of
        # what they are by now.
        for strain, area, deepest in zip(history["strain"], history["overlapped_area"],
                                         history["deepest_overlap"]):
            if strain > 0.02:
                self.assertAlmostEqual(deepest * (1 - strain) / (area / (25e-6 * 0.5e-3)), 1, delta=0.02)
        # Two faces of 0.5 mm, overlapped by less than 6 % of a location of 25 um.
        self.assertLess(max(history["overlapped_area"]), 0.06 * 25e-6 * 0.5e-3 * 2)

    def test_bodies_that_touch_at_the_start_part_with_the_energy_they_had(self):
        """Flush boxes of one material and of two, each at 1 % of the softer one's wave speed."""
        speed = 0.01 * math.sqrt(CONFINED / 5 / 1500)
        for ratio in 1, 5.2, 30:
            for scaled in (0, 0.8):
                file = self.folder / f"flush_{ratio}_{scaled}.yaml"
                file.write_text(f"""
materials:
  - {{name: left, law: isotropic, density: 1500 kg/m^3, youngs_modulus: 10 GPa, poisson_ratio: 0.3}}
  - {{name: right, law: isotropic, density: {1500 * ratio} kg/m^3, youngs_modulus: {10 * ratio} GPa, poisson_ratio: 0.3}}
specimen:
  size: [3 mm, 0.4 mm]
  shapes:
    - {{box: {{lower: [0 mm, 0 mm], upper: [1.5 mm, 0.4 mm]}}, material: left, velocity: [{speed} m/s, 0 m/s]}}
    - {{box: {{lower: [1.5 mm, 0 mm], upper: [3 mm, 0.4 mm]}}, material: right, velocity: [-{speed} m/s, 0 m/s]}}
grid: {{cells: [30, 4], margin: 1 mm}}
contact: [{{between: [left, right]}}]
numerics: {{formulation: total_lagrangian, mass_scaling: {scaled}}}
free_motion: {{end_time: 2 us}}
output: {{snapshots: 0, history_lines: 100}}
""")
                run = mpm_par(file, "--output", self.folder / file.stem)
                self.assertEqual(run.returncode, 0, run.stderr + run.stdout)
                history = History(self.folder / file.stem)
                self.assertGreater(max(history["contact_energy"]), 0)
                self.assertLess(max(map(abs, history["energy_error"])), 0.05, file.stem)

    def slide(self, friction, bound, *settings, where="contact[0]"):
        history = History(self.results("incline", *settings, f"{where}.friction={friction}",
                                       ranks=2, label=f"friction_{friction}_{len(settings)}"))
        pull = max(0.0, GRAVITY * (math.sin(ANGLE) - friction * math.cos(ANGLE)))
        # The smooth start is worth half its time, and 0.15 a t^2 of way.
        speed = pull * (END - RAMP / 2)
        way = pull * ((END - RAMP) ** 2 / 2 + RAMP / 2 * (END - RAMP) + 0.15 * RAMP ** 2)
        weight = MASS * GRAVITY * math.cos(ANGLE)
        scale = MASS * GRAVITY * math.sin(ANGLE) * 1.5
        self.assertAlmostEqual(history["kinetic_energy"][-1], 0.5 * MASS * speed ** 2,
                               delta=bound * scale)
        self.assertAlmostEqual(history["friction_work"][-1], friction * weight * way,
                               delta=bound * scale)
        self.assertLess(max(history["momentum_error"]), 1e-12)

    def test_a_block_slides_down_an_incline_or_stays(self):
        for friction in (0, 0.3, 1):
            self.slide(friction, 0.01)

    def test_a_block_of_cells_slides_down_an_incline_or_stays(self):
        for friction in (0, 0.3, 1):
            self.slide(friction, 0.01, "numerics={formulation: total_lagrangian}")

    def test_a_block_of_cells_slides_down_a_rigid_incline_or_stays(self):
        """With 0.3 it begins to hop after 0.3 s: what is elastic does not slide steadily on what is
        rigid with a constant coefficient (Adams 1995, J. Appl. Mech. 62:867)."""
        for friction in (0, 0.1, 1):
            self.slide(friction, 0.01, "numerics={formulation: total_lagrangian}",
                       "materials[1]={name: slope, law: rigid}")

    def test_a_block_of_cells_slides_along_a_wall_or_stays(self):
        """As on a rigid body, with more friction it hops. Where it sticks it does not creep."""
        for friction in (0.01, 0.1, 1):
            self.slide(friction, 0.01, "numerics={formulation: total_lagrangian}",
                       "specimen.shapes=[{box: {lower: [0.5 m, 0 m], upper: [1.5 m, 0.25 m]}, "
                       "material: block}]", "free_motion.sides=[rigid, rigid, free, free]",
                       "free_motion.moving_sides=[{side: bottom, grip: contact, table: [[0 s, 0 m/s], [1 s, 0 m/s]]}]",
                       where="free_motion.moving_sides[0]")

    def test_a_disc_rolls_down_an_incline_or_slides(self):
        """A cylinder on its plane (tan 30 / 3 < friction) has 2/3 of the pull; 20 locations of radius and 40."""
        for friction, cells, bound in ((0.5, "[64, 28]", 0.06), (0.5, "[128, 56]", 0.03), (0.1, "[64, 28]", 0.02)):
            history = History(self.results("rolling_disc", f"contact[0].friction={friction}", f"grid.cells={cells}",
                                           ranks=2, label=f"friction_{friction}_{cells[1:3]}"))
            rolls = friction >= math.tan(ANGLE) / 3
            pull = GRAVITY * (2 / 3 * math.sin(ANGLE) if rolls else math.sin(ANGLE) - friction * math.cos(ANGLE))
            moved = 0.72 - RAMP
            way = pull * (moved ** 2 / 2 + RAMP / 2 * moved + 0.15 * RAMP ** 2)
            weight = 1000 * math.pi * 0.625 ** 2 * GRAVITY * math.sin(ANGLE)
            # What friction takes is booked against the work from outside, gravity's.
            done = history["external_work"][-1] + history["friction_work"][-1]
            self.assertAlmostEqual(done / (weight * way), 1, delta=bound)
            if rolls:
                self.assertLess(history["friction_work"][-1], 0.01 * done)

    def test_bars_of_one_kind_exchange_their_velocities(self):
        """To where they are after 87 us: within 2.5 % on 30 cells a bar, cells that bend within 1 %."""
        for numerics, bound in (("{scheme: apic}", 0.025), ("{formulation: total_lagrangian}", 0.01)):
            folder = self.results("colliding_bars", f"numerics={numerics}", ranks=2, label=f"bars_{bound}")
            self.assertLess(summary(folder)["exact_solution"]["displacement_relative_error"], bound)

    def test_a_rigid_plate_presses_a_block_as_one_of_its_kind_would(self):
        """As deep as in the block on another: the contact takes its stiffness from the block."""
        for scene_name, depth in (("rigid_plate", 1), ("rigid_plate_space", 0.1e-3)):
            history = History(self.results(scene_name, ranks=2, label=scene_name))
            self.expect_stress_of_block(history, depth)

    def expect_stress_of_block(self, history, depth):
        size = 0.5e-3
        travel = [20 * t**2 / 8e-6 for t in history["time"]]
        errors = []
        for before, after, less, more in zip(travel, travel[1:], history["external_work"],
                                             history["external_work"][1:]):
            strain = 0.5 * (before + after) / size
            if not 0.004 <= strain <= 0.012:
                continue
            # The contact as in the block on another: a quarter of a location of 20 times the strain.
            solid = strain - (0.25 * strain + 0.0025) / 20
            stress = (more - less) / (after - before) / (size * depth)
            errors.append(stress / (-CONFINED * math.log(1 - solid) / (1 - solid)) - 1)
        self.assertGreater(len(errors), 10)
        self.assertAlmostEqual(sum(errors) / len(errors), 0, delta=0.005)  # it rings by 1 %
        self.assertLess(max(abs(e) for e in history["energy_error"][10:]), 1e-3)
        self.assertLess(max(history["momentum_error"]), 1e-12)

    def punch(self, label, *settings, ranks=1):
        folder = self.results("punch", *settings, ranks=ranks, label=f"{label}_{ranks}")
        history = History(folder)
        self.assertEqual(summary(folder)["repartitions"] > 100, label.startswith("moves") and ranks > 1)
        self.assertLess(max(abs(e) for e in history["energy_error"][60:]), 0.01)
        self.assertLess(max(history["momentum_error"][60:]), 1e-12)
        return history

    def test_a_punch_of_cells_presses_alike_on_any_ranks(self):
        """Away from the line of symmetry: there sides of cells lie on one line but for roundings, and
        what they overlap by decides on the length of the step."""
        for label, all_ranks, *settings in (
                ("rubs", (2, 3, 4, 6), "contact=[{between: [wood, punch], friction: 0.2}]"),
                ("slides", (4,), "numerics.surface=fitted"),
                ("sticks_inside", (4,), "specimen.shapes[1].disc.centre[1]=0.6 mm"),
                ("moves", (2, 3, 4, 6), "contact=[{between: [wood, punch], friction: 0.2}]",
                 "numerics.repartition_interval=20"),
                ("moves_fitted", (3,), "numerics.surface=fitted", "numerics.repartition_interval=20")):
            settings = ["numerics={formulation: total_lagrangian}", "grid.cells=[30, 30]",
                        "specimen.shapes[1].disc.centre[0]=0.487 mm", *settings]
            alone = self.punch(label, *settings)
            for ranks in all_ranks:
                together = self.punch(label, *settings, ranks=ranks)
                for name in ("external_work", "elastic_energy", "contact_energy"):
                    for one, other in zip(alone[name], together[name]):
                        self.assertAlmostEqual(one, other, delta=1e-9 * alone["external_work"][-1])

    def test_a_punch_of_cells_is_pressed_with_the_force_of_one_to_which_nodes_stick(self):
        """Where nodes stick to it, it is felt as the grid is wide: that force comes to the other one,
        8 and 4 % below, in the last tenth of the way."""
        forces = {}
        for cells in (40, 80):
            for label, *settings in (("grid",), ("cells", "numerics={formulation: total_lagrangian, "
                                                         "surface: fitted}")):
                work = self.punch(f"{label}_{cells}", *settings, f"grid.cells=[{cells}, {cells}]",
                                  ranks=2)["external_work"]
                forces[label, cells] = work[-1] - work[-11]
        self.assertAlmostEqual(forces["cells", 80] / forces["cells", 40], 1, delta=0.01)
        for cells, bound in ((40, 0.12), (80, 0.04)):
            self.assertAlmostEqual(forces["grid", cells] / forces["cells", 80], 1, delta=bound)


if __name__ == "__main__":
    unittest.main()
