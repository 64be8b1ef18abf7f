"""Comparison of tables, on made-up ones."""
import copy
import unittest

import plan
import table


def made_up():
    return {"about": {"machine": {"model": "A"}, "build": {"compiler": "GNU 12", "flags": "-O3"}},
            "figures": [row("block gimp", 40.0), row("block linear", 30.0),
                        row("solid block: peak", 300.0, "memory"), row("migrated", 7, "count")]}


def row(name, value, kind="time", **more):
    return {"name": name, "value": value, "unit": "ns", "spread": 0.02, "samples": 5, "kind": kind,
            **more}


def changed(**values):
    new = made_up()
    for entry in new["figures"]:
        entry["value"] = values.get(entry["name"].replace(" ", "_").replace(":", ""), entry["value"])
    return new


class Compare(unittest.TestCase):
    def test_equal_tables_have_nothing_worse_and_nothing_better(self):
        result = table.compare(made_up(), made_up())
        self.assertEqual((result.worse, result.better, result.remarks), ([], [], []))
        self.assertIn("no figure is more than 10% worse", result.text())

    def test_a_figure_more_than_a_tenth_worse_is_named_and_the_worst_comes_first(self):
        result = table.compare(changed(block_gimp=44.1, block_linear=60.0), made_up())
        self.assertEqual([name for name, _, _ in result.worse], ["block linear", "block gimp"])
        self.assertIn("worse: block linear: 30 -> 60 (+100%)", result.text())
        self.assertNotIn("no figure", result.text())

    def test_a_tenth_worse_is_still_allowed(self):
        self.assertEqual(table.compare(changed(block_gimp=43.9), made_up()).worse, [])

    def test_improvements_are_named_too(self):
        result = table.compare(changed(block_gimp=20.0), made_up())
        self.assertEqual(result.better, [("block gimp", 40.0, 20.0)])

    def test_counts_are_never_judged(self):
        self.assertEqual(table.compare(changed(migrated=700), made_up()).worse, [])

    def test_times_of_another_machine_are_not_compared_but_memory_is(self):
        new = changed(block_gimp=400.0, solid_block_peak=600.0)
        new["about"]["machine"]["model"] = "B"
        result = table.compare(new, made_up())
        self.assertEqual([name for name, _, _ in result.worse], ["solid block: peak"])
        self.assertIn("times are not compared", result.text())
        self.assertIn("'B'", result.text())

    def test_another_compiler_is_remarked(self):
        new = made_up()
        new["about"]["build"]["compiler"] = "GNU 13"
        self.assertIn("compiler: 'GNU 12' then, 'GNU 13' now", table.compare(new, made_up()).text())

    def test_figures_that_are_gone_or_new_are_named(self):
        new = made_up()
        del new["figures"][0]
        new["figures"].append(row("new one", 1.0))
        result = table.compare(new, made_up())
        self.assertEqual((result.missing, result.added), (["block gimp"], ["new one"]))
        self.assertIn("no longer measured: block gimp", result.text())

    def test_a_stored_zero_is_no_reason_to_fail(self):
        old = changed(block_gimp=0.0)
        self.assertEqual(table.compare(made_up(), old).worse, [])


class Markdown(unittest.TestCase):
    def test_a_catalogue_has_a_row_for_each_pass_and_a_column_for_each_scheme(self):
        text = table.catalogue([row("kernel/2d/usl/gimp/flip/plastic", 40.0),
                                row("kernel/2d/usl/gimp/tpic/plastic", 61.2)], "kernel")
        self.assertEqual(text.splitlines()[-1], "| 2d | usl | gimp | plastic | 40 | - | - | 61.2 |")

    def test_a_single_sample_has_no_spread(self):
        rows = copy.deepcopy(made_up()["figures"][:1])
        rows[0]["samples"] = 1
        self.assertEqual(table.markdown(rows).splitlines()[-1], "| block gimp | 40 | ns | - | 1 |")


class Plan(unittest.TestCase):
    def test_a_hundred_million_particles_take_what_the_figures_say(self):
        name = "8.00 million particles, 2 ranks"
        made = {"figures": [row(f"{name}: per step", 50.0), row(f"{name}: start", 10.0),
                            row(f"{name}: output of one snapshot", 2.0, bytes=8e6 * 44),
                            row(f"{name}: peak of the larger rank", 250.0, "memory")]}
        rows = {what: result for what, _, result in plan.plan(made)}
        self.assertEqual(rows["memory, all ranks"], "23 GiB")
        self.assertEqual(rows["one snapshot"], "4.4 GB")
        self.assertIn("0.16 s a step", rows["32 ranks"])  # 50e-9 x 1e8 / 32
        self.assertIn("0.2 days", rows["32 ranks"])

    def test_without_the_figures_there_is_no_plan(self):
        self.assertEqual(plan.plan(made_up()), [])


if __name__ == "__main__":
    unittest.main()
