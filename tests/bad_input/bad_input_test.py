"""What is wrong with a scene, an image or a command line is said in a few lines, with the place, before
anything is written: exit status 2, in bounded time and memory."""
import concurrent.futures
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import unittest

from cases import all_cases

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import scene_run  # noqa: E402
from patience import seconds  # noqa: E402

SECONDS = int(seconds(3))  # of processor time: most take a tenth of one, none a whole one on a quiet machine
MEMORY = 1_000_000  # KiB at most
LETTERS = 4000      # of a message
LINES = 22
# A sentence of what to do, or what would be right.
REMEDY = re.compile(r"\. [A-Z][a-z]+ |must be |needs |did you mean|known: |: use ")


def defects(case, ranks=1):
    """What is wrong with how a wrong input is answered, and the answer."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.yaml").write_bytes(case.scene)
        for path, contents in case.files.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(contents)
        before = sorted(folder.rglob("*"))
        with open(folder.parent / (folder.name + ".errors"), "w+b") as errors:
            os.unlink(errors.name)
            launcher = [os.environ["MPM_MPIEXEC"], os.environ["MPM_NUMPROC_FLAG"], str(ranks)]
            run = subprocess.Popen(
                [*launcher * (ranks > 1),
                 *scene_run.command(os.environ["MPM_PAR"], case.file, "results/new", case.settings),
                 *case.arguments],
                cwd=folder, stdout=subprocess.DEVNULL, stderr=errors,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS)))
            _, status, used = os.wait4(run.pid, 0)
            run.returncode = os.waitstatus_to_exitcode(status)
            errors.seek(0)
            raw = errors.read()
        found = []
        raw = re.split(rb"^-{60,}\n", raw, flags=re.M)[0]  # what follows is the launcher's own
        try:
            message = raw.decode()
        except UnicodeDecodeError:
            message = raw.decode(errors="replace")
            found.append("a message that is not UTF-8")
        if run.returncode != 2:
            found.append(f"status {run.returncode}")
        if used.ru_maxrss > MEMORY:
            found.append(f"{used.ru_maxrss} KiB of memory")
        if sorted(folder.rglob("*")) != before:
            found.append("files were written")
        found += [f"no {words!r}" for words in case.says if words not in message]
        if len(message) > LETTERS or message.count("\n") > LINES:
            found.append(f"a message of {len(message)} letters")
        if any(ord(letter) < 32 and letter != "\n" for letter in message):
            found.append("control characters in the message")
        if not REMEDY.search(message):
            found.append("no remedy")
        return found, message


class BadInput(unittest.TestCase):
    def test_every_case(self):
        cases = all_cases()
        self.assertGreater(len(cases), 150)
        self.assertEqual(len(cases), len({case.name for case in cases}))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for case, (found, message) in zip(cases, pool.map(defects, cases)):
                with self.subTest(case.name[:80]):
                    self.assertEqual(found, [], message[:2000])

    def test_is_said_once_on_several_ranks(self):
        for case in all_cases()[::20]:
            with self.subTest(case.name[:80]):
                _, alone = defects(case)
                found, together = defects(case, ranks=2)
                self.assertEqual(found, [], together[:2000])
                self.assertEqual(*(re.sub(r"\S*/(wood\.)", r"\1", said) for said in (together, alone)))

    def test_a_good_scene_passes(self):
        from cases import Case
        found, _ = defects(Case("good", ()))
        self.assertIn("status 0", found)
        self.assertIn("files were written", found)


if __name__ == "__main__":
    unittest.main()
