"""Hands the kept corpus, the seeds and what a fuzzer or random changes make of them to a target.

    fuzz_test.py scenes|images PROGRAM FOLDER --mutations N      a replay program
    fuzz_test.py scenes|images PROGRAM FOLDER --seconds N        a libFuzzer program

New inputs that a fuzzer finds gather in FOLDER/found; an input on which the program fails is left in FOLDER.
"""
import argparse
import pathlib
import shutil
import subprocess

from seeds import write

CORPUS = pathlib.Path(__file__).with_name("corpus")
SECONDS_OF_ONE, MEGABYTES, LONGEST = 10, 2000, 20_000


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=["scenes", "images"])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mutations", type=int)
    parser.add_argument("--seconds", type=int)
    asked = parser.parse_args()
    found = asked.folder / "found"
    found.mkdir(parents=True, exist_ok=True)
    shutil.rmtree(asked.folder / "seeds", ignore_errors=True)
    write(asked.folder / "seeds")
    places = [asked.folder / "seeds" / asked.kind]
    if (CORPUS / asked.kind).is_dir():
        places.append(CORPUS / asked.kind)
    if asked.seconds is None:
        options = ["--mutations", str(asked.mutations), *places]
    else:
        options = [f"-max_total_time={asked.seconds}", f"-timeout={SECONDS_OF_ONE}",
                   f"-rss_limit_mb={MEGABYTES}", f"-max_len={LONGEST}", "-print_final_stats=1",
                   found, *places]
    return subprocess.run([asked.program, *options], cwd=asked.folder, check=False).returncode


if __name__ == "__main__":
    raise SystemExit(main())
