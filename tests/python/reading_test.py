"""The package on real runs, against what h5py, csv and json give for the same files."""
import csv
import json
import pathlib
import unittest

import needed

needed.modules("numpy", "h5py", "yaml")

import h5py  # noqa: E402
import numpy  # noqa: E402

import mpm_par  # noqa: E402
from program import ProgramTest, set_options  # noqa: E402

FORMULATIONS = {"updated_lagrangian": "18 %", "total_lagrangian": "9 %"}
TUBES = pathlib.Path(__file__).parents[2] / "inputs" / "tutorial" / "tubes.yaml"
STILL = "numerics.repartition_interval=1000000"  # borders between ranks, and with them the order of cells


class Reading(ProgramTest):
    def crushed(self, formulation, *settings, fields="[stress, plastic_work, id, velocity]"):
        return self.results(
            "honeycomb", f"numerics.formulation={formulation}", "grid.cells=[26, 22]",
            f"loading.strain={FORMULATIONS[formulation]}", "output.snapshots=4",
            f"output.fields={fields}", *settings, ranks=2, label=formulation)

    def test_history_and_summary_are_those_of_the_files(self):
        folder = self.crushed("updated_lagrangian")
        run = mpm_par.open_run(folder)
        with open(folder / "history.csv", newline="") as file:
            titles, *lines = csv.reader(file)
        self.assertEqual([f"{name} [{unit}]" for name, unit in run.history.units.items()], titles)
        for k, name in enumerate(run.history.values):
            self.assertEqual([float(line[k]) for line in lines], list(run.history[name]))
        self.assertEqual(run.summary, json.loads((folder / "summary.json").read_text()))
        self.assertEqual(run.quantity("material.yield_stress"), 500e6)
        self.assertEqual((run.axis, run.is_in_space, run.thickness), (0, False, 1))
        self.assertEqual((run.title, run.name), ("Crushed honeycomb", "honeycomb"))

    def test_snapshots_of_both_formulations(self):
        for formulation in FORMULATIONS:
            with self.subTest(formulation):
                folder = self.crushed(formulation)
                run = mpm_par.open_run(folder)
                self.assertEqual(run.is_total_lagrangian, formulation == "total_lagrangian")
                self.assertEqual(len(run.snapshots), 4)
                for snapshot in run.snapshots:
                    self.check_snapshot(snapshot, run)
                self.assertGreater(run.history["plastic_work"][-1], 0)

    def check_snapshot(self, snapshot, run):
        """Read, in blocks and at once, as it is in the file; sums as the history has them."""
        with h5py.File(snapshot.path) as file:
            raw = {name: values[:] for name, values in file["particles"].items()}
            units = {name: values.attrs["unit"] for name, values in file["particles"].items()}
            self.assertEqual(snapshot.time, file.attrs["time"])
        for name in snapshot.units:
            numpy.testing.assert_array_equal(snapshot[name], raw[name])
            self.assertEqual(snapshot.unit(name).encode(), units[name])
            blocks = [block for block, in snapshot.blocks(name, rows=100)]
            numpy.testing.assert_array_equal(numpy.concatenate(blocks), raw[name])
            self.assertLessEqual(max(map(len, blocks)), 100)
        self.assertEqual(snapshot.count, run.summary["particles"])
        self.assertEqual(set(snapshot.units), set(raw) - {"connectivity"})
        numpy.testing.assert_array_equal(snapshot.bounds()[1], raw["position"].max(axis=0))
        self.assertAlmostEqual(snapshot.total("plastic_work"), raw["plastic_work"].sum())
        line = numpy.abs(run.history["time"] - snapshot.time).argmin()
        if abs(run.history["time"][line] / max(snapshot.time, 1e-30) - 1) < 1e-9:
            work = run.history["plastic_work"][line]
            self.assertAlmostEqual(snapshot.total("plastic_work"), work, delta=1e-9 * work)
        # The volume of all particles is the relative density of the specimen.
        self.assertAlmostEqual(snapshot.particle_volume * snapshot.count
                               / (run.summary["relative_density"]
                                  * numpy.prod(run.summary["size"]) * run.thickness), 1, delta=1e-9)

    def test_the_last_snapshot_has_the_plastic_work_of_the_last_line(self):
        """In the plane and in space, with both formulations: sums made without the package."""
        folders = [self.crushed(formulation) for formulation in FORMULATIONS]
        folders.append(self.results("honeycomb", "loading.strain=18 %", label="without_fields",
                                    *["output.snapshots=2"]))
        folders.append(self.in_space())
        for folder in folders:
            with self.subTest(folder.name):
                run = mpm_par.open_run(folder)
                last = run.snapshots[-1]
                self.assertAlmostEqual(last.time / run.history["time"][-1], 1, delta=1e-9)
                with h5py.File(sorted((folder / "snapshots").glob("*.h5"))[-1]) as file:
                    work = float(file["particles/plastic_work"][:].sum())
                with open(folder / "history.csv", newline="") as file:
                    lines = list(csv.DictReader(file))
                self.assertGreater(work, 0)
                self.assertAlmostEqual(work / float(lines[-1]["plastic_work [J]"]), 1, delta=1e-9)
                self.assertAlmostEqual(run.history.at("plastic_work", last.strain) / work, 1,
                                       delta=1e-9)
                self.assertAlmostEqual(last.total("plastic_work") / work, 1, delta=1e-12)

    def in_space(self):
        from program import mpm_par as start
        folder = self.folder / "tubes"
        run = start(TUBES, "--output", folder, "--overwrite",
                    *set_options(["loading.strain=10 %", "output.snapshots=3"]), ranks=2)
        self.assertEqual(run.returncode, 0, run.stderr)
        opened = mpm_par.open_run(folder)
        self.assertEqual((opened.axis, opened.is_in_space, opened.thickness), (1, True, 1))
        return folder

    def test_windows_keep_their_cells(self):
        """With the id of both formulations, and by the order of cells without it, on 2 ranks."""
        halves = [mpm_par.Window("left", (0, 0), (0.5e-3, 1e-3)),
                  mpm_par.Window("right", (0.5e-3, 0), (1.1e-3, 1e-3))]
        found = {}
        for fields in "[plastic_work, id]", "[plastic_work]":
            for formulation in FORMULATIONS:
                run = mpm_par.open_run(self.crushed(formulation, STILL, fields=fields))
                if formulation == "updated_lagrangian" and "id" not in fields:
                    with self.assertRaisesRegex(mpm_par.ResultsError, "has no field id"):
                        mpm_par.work_in_windows(run, halves)
                    continue
                inside, everywhere, volumes = mpm_par.work_in_windows(run, halves)
                found[formulation, fields] = inside
                numpy.testing.assert_allclose(inside.sum(axis=1), everywhere, rtol=1e-12)
                numpy.testing.assert_allclose(
                    everywhere, [s["plastic_work"].sum() for s in run.snapshots], rtol=1e-12)
                of_all = run.summary["particles"] * run.snapshots[0].particle_volume
                self.assertAlmostEqual(volumes.sum() / of_all, 1)
                self.assertTrue((inside[-1] > 0).all())
                if "id" in fields:
                    self.check_by_id(run, inside)
        numpy.testing.assert_allclose(found["total_lagrangian", "[plastic_work, id]"],
                                      found["total_lagrangian", "[plastic_work]"], rtol=1e-9)

    def check_by_id(self, run, inside):
        first, last = run.snapshots[0], run.snapshots[-1]
        left = set(first["id"][first["position"][:, 0] < 0.5e-3])
        work = sum(w for w, number in zip(last["plastic_work"], last["id"]) if number in left)
        self.assertAlmostEqual(work / inside[-1, 0], 1, delta=1e-9)

    def test_a_name_is_a_text_whatever_it_looks_like(self):
        from program import mpm_par as start, scene
        for name in "007", "0.50", "2026-11-03", "on":
            with self.subTest(name):
                file = self.folder / f"{name}.yaml"
                file.write_text(scene("confined_block").read_text().replace("title: ", "# "))
                folder = self.folder / "results" / name
                run = start(file, "--output", folder, *set_options(
                    ["steps=20", "output.snapshots=2", "specimen.windows=[{name: '1', x: [0 %, 50 %]}]"]))
                self.assertEqual(run.returncode, 0, run.stderr)
                opened = mpm_par.open_run(folder)
                self.assertEqual((opened.name, opened.title), (name, name))
                self.assertGreater(len(opened.snapshots), 0)
                self.assertEqual([w["name"] for w in opened.scene["specimen"]["windows"]],
                                 list(opened.summary["windows"]))

    def test_cells_in_another_order_are_noticed(self):
        """As after a restart on another number of ranks, where no id tells cells apart."""
        folder = self.crushed("total_lagrangian", STILL, fields="[plastic_work]")
        with h5py.File(folder / "snapshots" / "000003.h5", "r+") as file:
            work = file["particles/plastic_work"]
            work[:] = work[:][::-1]
        with self.assertRaisesRegex(mpm_par.ResultsError, "in another order"):
            mpm_par.work_in_windows(mpm_par.open_run(folder),
                                    [mpm_par.Window("all", (0, 0), (1, 1))])

    def test_cells_that_went_to_other_ranks_are_found_by_their_id(self):
        """Borders that move change the order, and windows of the scene ask for the id."""
        moved = ("numerics.repartition_interval=20", "loading.strain=6 %")
        folder = self.crushed("total_lagrangian", *moved, fields="[plastic_work]")
        halves = [mpm_par.Window("left", (0, 0), (0.5e-3, 1e-3)),
                  mpm_par.Window("right", (0.5e-3, 0), (1.1e-3, 1e-3))]
        run = mpm_par.open_run(folder)
        self.assertGreater(run.summary["repartitions"], 0)
        with self.assertRaisesRegex(mpm_par.ResultsError, "has no field id"):
            mpm_par.work_in_windows(run, halves)
        run = mpm_par.open_run(self.crushed(
            "total_lagrangian", "specimen.windows=[{name: left, x: [0 %, 50 %]}]", *moved,
            fields="[plastic_work]"))
        self.assertGreater(run.summary["repartitions"], 0)
        self.assertEqual(run.scene["output"]["fields"], ["plastic_work", "id"])
        self.check_by_id(run, mpm_par.work_in_windows(run, halves)[0])

    def test_a_window_without_particles_is_told(self):
        run = mpm_par.open_run(self.crushed("total_lagrangian"))
        with self.assertRaisesRegex(mpm_par.ResultsError, "window beyond: holds no particle. The "
                                                          "specimen reaches from"):
            mpm_par.work_in_windows(run, [mpm_par.Window("beyond", (2, 0), (3, 1))])


if __name__ == "__main__":
    unittest.main()
