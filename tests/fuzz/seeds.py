"""What the fuzz targets start from: the shipped scenes, and the broken scenes and images of the tests.

    seeds.py FOLDER      writes FOLDER/scenes and FOLDER/images
"""
import hashlib
import pathlib
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tests" / "bad_input"))

from cases import all_cases, bmp, png, tiff  # noqa: E402

LARGEST = 100_000  # bytes: what is longer changes little with a byte


def seeds():
    """Kind and contents of each."""
    for file in sorted([*PROJECT.glob("inputs/**/*.yaml"), *PROJECT.glob("tests/regression/scenes/*.yaml")]):
        yield "scenes", file.read_bytes()
    for case in all_cases():
        yield "scenes", case.scene
        for contents in case.files.values():
            if isinstance(contents, bytes):
                yield "images", contents
    yield from (("images", image()) for image in (png, bmp, tiff))


def write(folder):
    for kind, contents in {found for found in seeds() if len(found[1]) <= LARGEST}:
        place = pathlib.Path(folder) / kind
        place.mkdir(parents=True, exist_ok=True)
        (place / hashlib.sha1(contents).hexdigest()[:16]).write_bytes(contents)


if __name__ == "__main__":
    write(sys.argv[1])
