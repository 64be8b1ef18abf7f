"""Hands the kept corpus, the seeds and what a fuzzer or random changes make of them to a target.

    fuzz_test.py scenes|images PROGRAM FOLDER --mutations N           a replay program
    fuzz_test.py scenes|images PROGRAM FOLDER --seconds N [--keep]    a libFuzzer program

The kept corpus: inputs that once failed, in corpus/scenes and corpus/images, and those by which a fuzzer reached
code that the seeds do not reach, in corpus/scenes.tar.xz and corpus/images.tar.xz. --keep writes the archive anew.
New inputs that a fuzzer finds gather in FOLDER/found; an input on which the program fails is left in FOLDER.
"""
import argparse
import pathlib
import shutil
import subprocess
import tarfile

from seeds import write

CORPUS = pathlib.Path(__file__).with_name("corpus")
LIMITS = ["-timeout=10", "-rss_limit_mb=2000", "-max_len=20000"]


def whole_path(word):
    return pathlib.Path(word).resolve()


def emptied(folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def unpack(archive, folder):
    emptied(folder)
    if archive.exists():
        with tarfile.open(archive) as files:
            for file in files:
                (folder / pathlib.Path(file.name).name).write_bytes(files.extractfile(file).read())
    return folder


def without_times(file):
    file.mtime = file.uid = file.gid = 0
    file.uname = file.gname = ""
    return file


def keep(program, places, archive):
    """What reaches more than the seeds do: places[0]."""
    folder = places[0].parent / "merged"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(places[0], folder)
    subprocess.run([program, "-merge=1", *LIMITS, folder, *places[1:]], check=True, cwd=places[0].parent)
    known = {path.name for path in places[0].iterdir()}
    with tarfile.open(archive, "w:xz") as files:
        for path in sorted(folder.iterdir()):
            if path.name not in known:
                files.add(path, path.name, filter=without_times)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=["scenes", "images"])
    parser.add_argument("program", type=whole_path)
    parser.add_argument("folder", type=whole_path)
    parser.add_argument("--mutations", type=int)
    parser.add_argument("--seconds", type=int)
    parser.add_argument("--keep", action="store_true")
    asked = parser.parse_args()
    archive, seeds = CORPUS / f"{asked.kind}.tar.xz", asked.folder / "seeds"
    write(emptied(seeds))
    places = [seeds / asked.kind, CORPUS / asked.kind, unpack(archive, asked.folder / "kept")]
    if asked.seconds is None:
        words = ["--mutations", str(asked.mutations), *places]
        return subprocess.run([asked.program, *words], cwd=asked.folder, check=False).returncode
    found = asked.folder / "found"
    found.mkdir(exist_ok=True)
    words = [f"-max_total_time={asked.seconds}", *LIMITS, "-print_final_stats=1", found, *places]
    status = subprocess.run([asked.program, *words], cwd=asked.folder, check=False).returncode
    if asked.keep:
        keep(asked.program, [*places, found], archive)
    return status


if __name__ == "__main__":
    raise SystemExit(main())
