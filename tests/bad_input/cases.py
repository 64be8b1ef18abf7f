"""Scenes and images that are wrong, one way each: a name, what is wrong, and where and what the message has
to say. `{}` marks in the text of a scene are none: keys are replaced whole."""
import struct
import zlib

GOOD = """\
title: A block with a hole
material: {law: von_mises, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1 g/cm^3, yield_stress: 10 MPa}
specimen:
  micrograph: wood.png
  pixel_size: 2 um
  threshold: 100
grid: {cells: [10, 10]}
numerics: {formulation: total_lagrangian}
loading: {piston: right, speed: 10 m/s, strain: 2 %}
output: {snapshots: 0, history_lines: 4}
"""
SHAPES = """\
material: {law: isotropic, youngs_modulus: 1 GPa, poisson_ratio: 0.3, density: 1 g/cm^3}
specimen:
  size: [1 mm, 1 mm]
  shapes: [{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}}]
grid: {cells: [10, 10]}
loading: {piston: right, speed: 10 m/s, strain: 2 %}
"""


def png(width=20, height=20, rows=None, depth=8, colour=0, header=None, drop=0):
    """Gray levels by `rows`: by default a wall around a hole."""
    if rows is None:
        rows = [[0 if 5 <= x < 15 and 5 <= y < 15 else 255 for x in range(width)] for y in range(height)]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + bytes(row) for row in rows)
    head = header or struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    file = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")
    return file[:len(file) - drop]


def bmp(width=20, height=20, bits=8, offset=None, compression=0, drop=0, magic=b"BM", colours=256):
    row = (width * bits // 8 + 3) // 4 * 4
    table = b"".join(bytes([k, k, k, 0]) for k in range(256)) if bits == 8 else b""
    pixels = (bytes([255] * 5 + [0] * 10 + [255] * 5) + b"\0" * max(0, row - 20))[:row] * min(abs(height), 1000)
    start = 54 + len(table) if offset is None else offset
    head = magic + struct.pack("<IHHI", 54 + len(table) + len(pixels), 0, 0, start)
    info = struct.pack("<IiiHHIIiiII", 40, width, height, 1, bits, compression, 0, 2835, 2835, colours, 0)
    file = head + info + table + pixels
    return file[:len(file) - drop]


def tiff(width=20, height=20, bits=8, samples=1, strip=8, count=None, order=b"II", magic=42, drop=0,
         photometric=1, compression=1, first=None, pages=1, behind_last=0):
    pixels = bytes(([255] * 5 + [0] * 10 + [255] * 5) * 20)
    entries = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, bits), (259, 3, 1, compression),
               (262, 3, 1, photometric), (273, 4, 1, strip), (277, 3, 1, samples), (278, 4, 1, height),
               (279, 4, 1, len(pixels) if count is None else count)]
    head = order + struct.pack("<HI", magic, 8 + len(pixels) if first is None else first)
    directory = struct.pack("<H", len(entries)) + b"".join(struct.pack("<HHII", *e) for e in entries)
    at = [8 + len(pixels) + page * (len(directory) + 4) for page in range(pages)]
    file = head + pixels + b"".join(directory + struct.pack("<I", place) for place in [*at[1:], behind_last])
    return file[:len(file) - drop]


class Case:
    def __init__(self, name, says, scene=GOOD, replace=(), settings=(), files=None, arguments=(),
                 file="scene.yaml"):
        text = scene
        for old, new in replace:
            assert old in text, f"{name}: {old!r} is not in the scene"
            text = text.replace(old, new, 1)
        self.name, self.says, self.settings = name, says, [*settings]
        self.files = {"wood.png": png(), **(files or {})}
        self.arguments, self.file = [*arguments], file
        self.scene = text if isinstance(text, bytes) else text.encode()


def setting(name, key, value, *says):
    return Case(f"{name}: {key}={value}", says, settings=[f"{key}={value}"])


def shape(name, text, *says):
    return Case(name, says, scene=SHAPES, replace=[("{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}}", text)])


def of_scene(name, text, *says, **more):
    return Case(name, says, scene=text, **more)


def image(name, data, *says, file="wood.png"):
    return Case(name, (file, *says), files={file: data},
                replace=[("wood.png", file)] if file != "wood.png" else ())


def bomb(lines, width):
    text = "a0: &a0 [x, x]\n"
    for k in range(1, lines):
        text += f"a{k}: &a{k} [" + ", ".join([f"*a{k - 1}"] * width) + "]\n"
    return text


def all_cases():
    cases = []
    add = cases.append
    # ---- units
    for key, value in [("material.youngs_modulus", "1"), ("material.youngs_modulus", "1 GPaa"),
                       ("material.youngs_modulus", "1 mm"), ("material.youngs_modulus", "GPa"),
                       ("material.youngs_modulus", "1 GPa GPa"), ("material.youngs_modulus", "1,5 GPa"),
                       ("material.density", "1 kg"), ("material.density", "1500 kg/m3/s"),
                       ("material.yield_stress", "10 N"), ("material.poisson_ratio", "0.3 m"),
                       ("specimen.pixel_size", "2"), ("specimen.pixel_size", "2 kg"),
                       ("specimen.pixel_size", "2 µ"), ("loading.speed", "10"),
                       ("loading.speed", "10 m"), ("loading.strain", "2 m"),
                       ("loading.ramp_time", "1 m"), ("numerics.thickness", "1 s"),
                       ("grid.spacing", "[1, 1]"), ("grid.margin", "3 s")]:
        add(setting("unit", key, value, key))
    # ---- kinds of values
    for key, value in [("grid.cells", "ten"), ("grid.cells", "10.5"), ("grid.cells", "[10, ten]"),
                       ("grid.cells", "[10, 10, 10, 10]"), ("grid.cells", "{x: 10}"), ("grid.cells", "[]"),
                       ("grid.cells", "99999999999999999999"), ("material", "wood"), ("material", "[1, 2]"),
                       ("material.law", "3"), ("material.law", "[von_mises]"), ("specimen", "wood.png"),
                       ("specimen.threshold", "high"), ("specimen.threshold", "[100]"),
                       ("specimen.crop", "[0, 0, 5]"), ("specimen.crop", "5"), ("specimen.flip_vertical", "maybe"),
                       ("loading", "right"), ("loading.piston", "sideways"), ("loading.piston", "[right]"),
                       ("loading.speed", "fast"), ("loading.speed", "[1 m/s, 2 m/s]"), ("output.fields", "stresses"),
                       ("output.fields", "[von_mises, blue]"), ("output.history_lines", "many"),
                       ("output.snapshots", "-3"), ("output.snapshots", "{strains: often}"),
                       ("numerics.formulation", "lagrangian"), ("numerics.shape_function", "cubic-ish"),
                       ("numerics.scheme", "flop"), ("numerics.cfl", "fast"), ("steps", "1e-3"), ("steps", "none"),
                       ("output.checkpoints", "often"), ("output.checkpoints", "{hours: 3}"),
                       ("output.compress", "sometimes"), ("name", "[a]")]:
        add(setting("kind", key, value, key.split(".")[0]))
    # ---- ranges
    for key, value in [("material.youngs_modulus", "-1 GPa"), ("material.youngs_modulus", "0 GPa"),
                       ("material.youngs_modulus", "nan GPa"), ("material.youngs_modulus", "inf GPa"),
                       ("material.poisson_ratio", "0.5"), ("material.poisson_ratio", "-1"),
                       ("material.density", "0 kg/m^3"), ("material.density", "-1 g/cm^3"),
                       ("material.yield_stress", "-1 MPa"), ("specimen.pixel_size", "0 um"),
                       ("specimen.pixel_size", "-2 um"), ("specimen.threshold", "-1"),
                       ("specimen.threshold", "300"), ("specimen.rotate", "45"), ("specimen.remove_specks", "-1"),
                       ("grid.cells", "[1, 10]"), ("grid.cells", "[0, 10]"), ("grid.cells", "[-5, 10]"),
                       ("grid.cells", "[2000000000, 2000000000]"), ("grid.cells", "[3000000000, 10]"),
                       ("grid.particles_per_cell", "0"), ("grid.particles_per_cell", "99"),
                       ("grid.margin", "-1 um"), ("loading.speed", "0 m/s"), ("loading.speed", "-1 m/s"),
                       ("loading.speed", "1e30 m/s"), ("loading.strain", "0 %"), ("loading.strain", "100 %"),
                       ("loading.strain", "-5 %"), ("loading.strain", "nan"), ("loading.ramp_time", "-1 s"),
                       ("numerics.cfl", "0"), ("numerics.cfl", "-0.1"), ("numerics.cfl", "nan"),
                       ("numerics.contact_stiffness", "-1"), ("numerics.ranks", "[-1, 1]"),
                       ("numerics.ranks", "[7, 9]"), ("numerics.repartition_interval", "-1"),
                       ("output.history_lines", "0"), ("output.history_lines", "-3"), ("steps", "0"), ("steps", "-1"),
                       ("output.snapshots", "{strains: [2]}"), ("output.snapshots", "{times: [1 s]}"),
                       ("output.checkpoints", "{keep: 3}"), ("output.checkpoints.steps", "1"),
                       ("output.checkpoints.keep", "0"), ("output.checkpoints.wall_time", "0 s"),
                       ("specimen.crop", "[15, 15, 10, 10]"), ("specimen.crop", "[0, 0, 0, 0]"),
                       ("specimen.crop", "[-1, 0, 5, 5]")]:
        add(setting("range", key, value, key.split(".")[0]))
    # ---- keys
    for key, value in [("materiel", "{}"), ("specimen.pixelsize", "2 um"), ("loading.sped", "1 m/s"),
                       ("grid.cell", "[3, 3]"), ("numerics.gpu", "true"), ("output.snapshot", "3"), ("", "3"),
                       ("grid..cells", "[3, 3]"), ("grid.cells[5]", "3"), ("a" * 5000, "3")]:
        add(setting("key", key, value, "--set"))
    add(Case("setting without a value", ("--set",), settings=["grid.cells"]))
    for removed in ("specimen:\n  micrograph: wood.png\n  pixel_size: 2 um\n  threshold: 100\n",
                    "loading: {piston: right, speed: 10 m/s, strain: 2 %}\n", "  pixel_size: 2 um\n",
                    "  micrograph: wood.png\n", "speed: 10 m/s, ", "density: 1 g/cm^3, "):
        add(Case(f"missing {removed.split(':')[0].strip()}", ("missing",) if removed != "  pixel_size: 2 um\n"
                 and removed != "  micrograph: wood.png\n" else ("scene.yaml",), replace=[(removed, "")]))
    add(Case("twice the same key", ("scene.yaml:4", "given twice"),
             replace=[("  micrograph: wood.png\n", "  pixel_size: 3 um\n  micrograph: wood.png\n")]))
    add(Case("size of a pixel and of the image", ("scene.yaml", "pixel_size"),
             replace=[("  pixel_size: 2 um\n", "  pixel_size: 2 um\n  image_size: [1 mm, 1 mm]\n")]))
    add(Case("loading and free motion", ("scene.yaml", "free_motion"),
             replace=[("output:", "free_motion: {end_time: 1 us}\noutput:")]))
    add(Case("material and materials", ("scene.yaml", "materials"),
             replace=[("specimen:", "materials: [{name: a, law: rigid}]\nspecimen:")]))
    add(Case("picture and shapes", ("scene.yaml", "shapes"),
             replace=[("  threshold: 100\n", "  shapes: [{disc: {centre: [0 m, 0 m], radius: 1 m}}]\n")]))
    for name, text in [("quote", GOOD.replace("A block", '"A block')),
                       ("single quote", GOOD.replace("A block", "'it''s a block")),
                       ("quote with a backslash", GOOD.replace("A block", '"A block\\"'))]:
        add(Case(f"open {name}", ("scene.yaml:1:8", "nothing closes the quote"), scene=text))
    add(Case("a scene of megabytes", ("scene.yaml", "bytes", "1000000"), scene=GOOD + "# wood\n" * 300000))
    add(Case("cells and spacing", ("scene.yaml", "spacing"),
             replace=[("grid: {cells: [10, 10]}", "grid: {cells: [10, 10], spacing: [1 um, 1 um]}")]))
    # ---- YAML
    for name, text in [("nothing", ""), ("blanks", " \n\n"), ("a comment", "# nothing\n"), ("a list", "- a\n- b\n"),
                       ("a word", "wood\n"), ("a number", "3\n"), ("null", "~\n"),
                       ("tabs", GOOD.replace("  micrograph", "\tmicrograph")),
                       ("wrong indent", GOOD.replace("  pixel_size", "   pixel_size")),
                       ("open bracket", GOOD.replace("[10, 10]", "[10, 10")),
                       ("unknown alias", GOOD.replace("10 m/s", "*speed")),
                       ("alias of itself", "a: &a [*a]\n" + GOOD), ("merge of nothing", "<<: *none\n" + GOOD),
                       ("a tag", GOOD.replace("10 m/s", "!!binary abc=")),
                       ("two documents", GOOD + "---\n" + GOOD), ("a directive", "%YAML 9.9\n---\n" + GOOD),
                       ("a stray comma", ", " + GOOD), ("a comma below a comment", "# a scene\n, x\n" + GOOD),
                       ("a map as key", "{a: b}: c\n" + GOOD), ("deep brackets", "a: " + "[" * 20000),
                       ("deep maps", "{a: " * 5000 + "}" * 5000), ("deep indents",
                        "".join(" " * k + "a:\n" for k in range(3000))),
                       ("anchors that multiply", bomb(12, 12) + GOOD), ("anchors that double", bomb(40, 2) + GOOD),
                       ("zeros", "\0" * 100), ("zeros within", GOOD.replace("A block", "A\0block")),
                       ("a lone carriage return", GOOD.replace("\n", "\r", 1) + "nonsense: 1\n"),
                       ("control characters", GOOD.replace("A block", "A \x07\x1b[31mblock")),
                       ("UTF-16 cut in half", ("\ufeff" + GOOD).encode("utf-16-le")[:301]), ("Latin-1", GOOD.replace("A block", "Bl\xf6ck").encode("latin-1")),
                       ("broken UTF-8", GOOD.encode().replace(b"A block", b"A \xc3\x28 block")),
                       ("a picture", png()), ("noise", bytes(range(256)) * 8), ("one huge line", "a: " + "x" * 3_000_000),
                       ("a key of a megabyte", "x" * 1_000_000 + ": 1\n" + GOOD),
                       ("a hundred thousand keys", "".join(f"k{k}: 1\n" for k in range(100_000)))]:
        add(of_scene(f"YAML: {name}", text, "scene.yaml"))
    # ---- shapes
    for name, text in [("disc without radius", "{disc: {centre: [0.5 mm, 0.5 mm]}}"),
                       ("disc of no size", "{disc: {centre: [0.5 mm, 0.5 mm], radius: 0 mm}}"),
                       ("disc in space", "{sphere: {centre: [0 m, 0 m, 0 m], radius: 1 mm}}"),
                       ("unknown shape", "{dics: {centre: [0 m, 0 m], radius: 1 mm}}"),
                       ("two shapes in one", "{disc: {centre: [0 m, 0 m], radius: 1 mm}, box: {lower: [0 m, 0 m], upper: [1 m, 1 m]}}"),
                       ("box upside down", "{box: {lower: [1 mm, 1 mm], upper: [0 mm, 0 mm]}}"),
                       ("polygon of two", "{polygon: {corners: [[0 mm, 0 mm], [1 mm, 1 mm]]}}"),
                       ("unknown material", "{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}, material: iron}"),
                       ("outside", "{disc: {centre: [5 mm, 5 mm], radius: 0.4 mm}}"),
                       ("only void", "{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}, material: void}"),
                       ("too small to hit a particle", "{disc: {centre: [0.5 mm, 0.5 mm], radius: 1 nm}}"),
                       ("nothing", "{}"), ("a word", "disc")]:
        add(shape(f"shape: {name}", text, "scene.yaml"))
    add(Case("shapes without a size", ("scene.yaml", "size"), scene=SHAPES, replace=[("  size: [1 mm, 1 mm]\n", "")]))
    add(Case("no shapes", ("scene.yaml",), scene=SHAPES,
             replace=[("[{disc: {centre: [0.5 mm, 0.5 mm], radius: 0.4 mm}}]", "[]")]))
    add(Case("a size that is too thin", ("scene.yaml",), scene=SHAPES, replace=[("[1 mm, 1 mm]", "[1 mm, 0 mm]")]))
    add(Case("a piston that never meets the body", ("scene.yaml",), scene=SHAPES,
             replace=[("centre: [0.5 mm, 0.5 mm], radius: 0.4 mm", "centre: [0.1 mm, 0.5 mm], radius: 0.05 mm")]))
    # ---- images
    for name, data in [("empty", b""), ("eight bytes", b"\x89PNG\r\n\x1a\n"), ("not an image", b"hello world\n" * 50),
                       ("half a PNG", png(drop=len(png()) // 2)), ("PNG without its end", png(drop=30)),
                       ("PNG of no width", png(header=struct.pack(">IIBBBBB", 0, 20, 8, 0, 0, 0, 0))),
                       ("PNG that lies about its size", png(header=struct.pack(">IIBBBBB", 200, 200, 8, 0, 0, 0, 0))),
                       ("PNG of 4 G pixels", png(header=struct.pack(">IIBBBBB", 65535, 65535, 8, 0, 0, 0, 0))),
                       ("PNG of 2^31", png(header=struct.pack(">IIBBBBB", 2**31 - 1, 2**31 - 1, 8, 0, 0, 0, 0))),
                       ("PNG of unknown depth", png(depth=7)), ("PNG of unknown colour", png(colour=9)),
                       ("a JPEG header", b"\xff\xd8\xff\xe0" + b"\0" * 100)]:
        add(image(f"image: {name}", data))
    for name, data in [("half a bitmap", bmp(drop=300)), ("bitmap of 5 bits", bmp(bits=5)),
                       ("bitmap of no width", bmp(width=0)), ("bitmap of negative width", bmp(width=-20)),
                       ("bitmap of 2^31 rows", bmp(height=2**31 - 1)), ("bitmap that begins behind its end", bmp(offset=10**9)),
                       ("bitmap that begins in its header", bmp(offset=3)), ("compressed bitmap", bmp(compression=77)),
                       ("bitmap by name only", b"XX" + bmp()[2:]), ("header only", bmp()[:54]), ("ten bytes", bmp()[:10]),
                       ("bitmap with 2^32 colours", bmp(colours=2**32 - 1)),
                       ("bitmap of 4 G pixels", bmp(width=65535, height=65535))]:
        add(image(f"image: {name}", data, file="wood.bmp"))
    for name, data in [("half a TIFF", tiff(drop=60)), ("TIFF of no width", tiff(width=0)),
                       ("TIFF of 2^31 rows", tiff(height=2**31 - 1)), ("TIFF of 3 bits", tiff(bits=3)),
                       ("TIFF of 7 samples", tiff(samples=7)), ("TIFF whose strip lies", tiff(strip=10**9)),
                       ("TIFF without directory", tiff(first=10**8)),
                       ("TIFF of another magic", tiff(magic=99)), ("TIFF of unknown compression", tiff(compression=4711)),
                       ("TIFF of 4 G pixels", tiff(width=65535, height=65535)),
                       ("TIFF of 200 M pixels", tiff(width=10000, height=20000)), ("TIFF's first bytes", tiff()[:6])]:
        add(image(f"image: {name}", data, file="wood.tif"))
    for name, data, words in [("TIFF of 3 pages in the plane", tiff(pages=3), "specimen.depth"),
                              ("TIFF whose pages go in a circle", tiff(pages=3, behind_last=408), "specimen.depth"),
                              ("TIFF of 400 M pixels in pages", tiff(width=1000, height=1000, pages=400), "too many")]:
        add(image(f"image: {name}", data, words, file="wood.tif"))
    add(Case("a name of many stars", ("no file has such a name",), replace=[("wood.png", "a*" * 60 + "b")],
             files={"a" * 200 + ".png": png()}))
    for name, files, words in [("no slices", {}, "no file has such a name"),
                               ("slices of two sizes", {"s_1.png": png(), "s_2.png": png(width=21)}, "s_2.png"),
                               ("a broken slice", {"s_1.png": png(), "s_2.png": b"no picture"}, "s_2.png"),
                               ("slices in the plane", {"s_1.png": png(), "s_2.png": png()}, "specimen.depth")]:
        add(Case(name, (words,), replace=[("wood.png", "s_*.png")], files=files))
    add(Case("slices without wall", ("no cell wall",), files={f"s_{k}.png": png(rows=[[10] * 20] * 20) for k in (1, 2)},
             replace=[("wood.png", "s_*.png\n  depth: 10 um"), ("cells: [10, 10]", "cells: [10, 10, 3]")]))
    for name, replacement in [("that is not there", "none.png"), ("that is a folder", "."), ("without a name", '""'),
                              ("of another kind", "scene.yaml"), ("in a folder that is not there", "no/where/wood.png")]:
        add(Case(f"picture {name}", ("scene.yaml",), replace=[("wood.png", replacement)]))
    for name, replacement in [("a name with spaces and UTF-8", "mein Höl z.png")]:
        add(Case(f"picture of {name} that is broken", (replacement,), replace=[("wood.png", replacement)],
                 files={replacement: png(drop=60)}))
    # ---- what does not fit together
    add(Case("no wall at all", ("scene.yaml: no cell wall found", "specimen.threshold"),
             files={"wood.png": png(rows=[[0] * 20] * 20)}))
    add(Case("bands outside all gray", ("scene.yaml: no cell wall found", "specimen.bands"),
             replace=[("material: {law", "materials: [{name: wall, law"), ("10 MPa}", "10 MPa}]"), ("  threshold: 100\n", "  bands: [{material: wall, from: 100, to: 101}]\n")]))
    add(Case("a density above the wall's", ("specimen.threshold.target_density", "1000"),
             settings=["specimen.threshold={target_density: 1200 kg/m^3}"]))
    add(Case("two densities", ("specimen.threshold", "one of the keys"),
             settings=["specimen.threshold={target_density: 400 kg/m^3, target_relative_density: 0.4}"]))
    add(Case("a seed of a picture that is a file", ("specimen.seed", "drawn"), settings=["specimen.seed=3"]))
    for name, text, says in [("empty", "", "no keys"), ("of no YAML", "picture: {width_px: 10", "YAML"),
                             ("of unknown keys", "pictures: {}\n", "picture"), ("a stray comma", ", a", "no keys"),
                             ("of a gigantic size", "picture: {width_px: 100000, height_px: 100000}\n", "width_px"),
                             ("of anchors in themselves", "picture: &a {width_px: *a}\n", "width_px")]:
        add(Case(f"drawing: {name}", ("wood.anatomy.yaml", says), replace=[("wood.png", "wood.anatomy.yaml")],
                 files={"wood.anatomy.yaml": text.encode()}))
    add(Case("piston across", ("loading.piston",), settings=["loading.piston=front"]))
    add(Case("friction below zero", ("contact",), settings=["contact=[{between: [a, b], friction: -1}]"]))
    add(Case("contact of unknown bodies", ("contact",), settings=["contact=[{between: [oak, pine]}]"]))
    add(Case("failure without total Lagrangian", ("failure",),
             settings=["numerics.formulation=updated_lagrangian", "material.failure={stretch: 2}"]))
    add(Case("rigid specimen", ("material.law",), settings=["material={law: rigid}"]))
    add(Case("snapshots beyond the end", ("snapshots",), settings=["output.snapshots={strains: [0 %, 50 %]}"]))
    add(Case("checkpoints by a strain that is not there", ("output.checkpoints.strain", "wall_time"),
             replace=[("loading: {piston: right, speed: 10 m/s, strain: 2 %}", "free_motion: {end_time: 1 us}")],
             settings=["output.checkpoints={strain: 5 %}"]))
    add(Case("walls by bands and by brightness", ("specimen.wall",),
             settings=["specimen.wall=dark", "specimen.bands=[{from: 100, to: 256, material: cell_wall}]"]))
    add(Case("formula of unknown names", ("initial_velocity",),
             settings=["specimen.initial_velocity=[foo(x) m/s, 0 m/s]"]))
    add(Case("formula that does not end", ("initial_velocity",),
             settings=["specimen.initial_velocity=[sin(x, 0 m/s]"]))
    # ---- the command line
    for name, words, says in [("unknown option", ["--chek"], "--chek"), ("two scenes", ["scene.yaml"], "second"),
                              ("output without a folder", ["--output"], "--output"),
                              ("set without words", ["--set"], "--set"), ("ranks without check", ["--ranks", "3"], "--ranks"),
                              ("time without unit", ["--time-limit", "3"], "--time-limit"),
                              ("restart of nothing", ["--restart"], "--restart"),
                              ("restart of a file that is not there", ["--restart", "none.h5"], "none.h5"),
                              ("restart of what is none", ["--restart", "wood.h5"], "wood.h5"),
                              ("restart and overwrite", ["--restart", "--overwrite"], "--overwrite")]:
        add(Case(f"command line: {name}", (says,), arguments=words, files={"wood.h5": png()}))
    add(Case("command line: restart of no checkpoint", ("--restart is none.yaml", ".h5"),
             arguments=["--restart=none.yaml"]))
    add(Case("scene that is not there", ("none.yaml",), file="none.yaml"))
    add(Case("scene that is a folder", ("folder",), file="folder", files={"folder/a": b""}))
    return cases
