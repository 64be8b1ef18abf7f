"""What mpm_par is asked for a study, by one that keeps what it is asked."""
import pathlib
import tempfile
import unittest

from program import Program

ASKED = """#!/bin/sh
if [ "$1" = --version ]; then echo "mpm_par 1"; exit 0; fi
printf '%s\\n' "$@" >"$0.asked"
echo "--set $3: unknown key" >&2
exit {status}
"""


class Checking(unittest.TestCase):
    def check(self, status):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "mpm_par"
            path.write_text(ASKED.format(status=status))
            path.chmod(0o755)
            said = Program(path, ["mpiexec", "-n"]).check("wood.yaml", [("steps", "4")])
            return said, pathlib.Path(f"{path}.asked").read_text().split()

    def test_steps_are_not_measured(self):
        _, asked = self.check(0)
        self.assertEqual(asked, ["wood.yaml", "--set", "steps=4", "--check", "--quiet"])

    def test_only_what_is_refused_is_wrong(self):
        self.assertEqual(self.check(0)[0], [])
        self.assertEqual(len(self.check(2)[0]), 1)


if __name__ == "__main__":
    unittest.main()
