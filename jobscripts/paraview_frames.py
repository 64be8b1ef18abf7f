#!/usr/bin/pvbatch
"""Draws frames of a crushed specimen, one PNG each and all of them in a row.

    xvfb-run -a pvbatch --force-offscreen-rendering jobscripts/paraview_frames.py \\
        results/loblolly_radial/loblolly_radial.xdmf --strain 5% 17% 29% 46% 60%

Every particle is a square (a cube in 3D) of its first edge length, so that cell walls show no gaps.
Frames are the snapshots nearest to the strains (or times, --time) asked for; without either, five
evenly spaced ones. xvfb-run (package xvfb) is only needed where there is no display.
"""
import argparse
import math
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

BLACK = [0.0, 0.0, 0.0]


def strain_of(text):
    return float(text[:-1]) / 100 if text.endswith("%") else float(text)


def read_arguments():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("series", type=Path, help="the .xdmf file of a run")
    chosen = arguments.add_mutually_exclusive_group()
    chosen.add_argument("--strain", nargs="+", type=strain_of, help="such as 5%% 0.17")
    chosen.add_argument("--time", nargs="+", type=float, help="in seconds")
    arguments.add_argument("--field", default="plastic_work")
    arguments.add_argument("--component", default="Magnitude",
                           help="of a vector or tensor: 0, 1, ... or Magnitude")
    arguments.add_argument("--range", nargs=2, type=float, metavar=("FROM", "TO"),
                           help="of the colours (default: all frames, their largest 2 %% clipped)")
    arguments.add_argument("--log", action="store_true", help="logarithmic colours")
    arguments.add_argument("--edge", type=float, help="of a particle in m (default: measured)")
    arguments.add_argument("--cut", type=float, metavar="SHARE",
                           help="in space: only what lies behind this share of the depth, from 0 (back) to 1")
    arguments.add_argument("--width", type=int, default=900, help="of a frame in pixels")
    arguments.add_argument("-o", "--output", type=Path, help="directory (default: frames beside it)")
    return arguments.parse_args()


def read_series(path):
    """Times and strains of the snapshots, as the XDMF file lists them."""
    times, strains = [], []
    for grid in ElementTree.parse(path).getroot().iter("Grid"):
        time = grid.find("Time")
        if time is None:
            continue
        times.append(float(time.get("Value")))
        strain = grid.find("Information[@Name='strain']")
        strains.append(float(strain.get("Value")) if strain is not None else 0.0)
    return times, strains


def unit_of(path, field):
    """As the XDMF file states it; nothing for a plain number."""
    note = ElementTree.parse(path).getroot().find(
        f".//Attribute[@Name='{field}']/Information[@Name='unit']")
    unit = note.get("Value") if note is not None else "1"
    return "" if unit == "1" else f" [{unit}]"


def choose(times, strains, given):
    """Numbers of the snapshots to draw, each once, in the order of time."""
    if given.strain:
        wanted, there = given.strain, strains
    elif given.time:
        wanted, there = given.time, times
    else:
        return sorted({round(i * (len(times) - 1) / 4) for i in range(5)})
    return sorted({min(range(len(there)), key=lambda i: abs(there[i] - value)) for value in wanted})


def particles_at(source, time, given):
    """Positions and values of one snapshot, copied: the reader reuses its memory for the next."""
    source.UpdatePipeline(time)
    data = servermanager.Fetch(source)
    while data is not None and data.IsA("vtkCompositeDataSet"):
        walk = data.NewIterator()
        walk.InitTraversal()
        data = None if walk.IsDoneWithTraversal() else walk.GetCurrentDataObject()
    if data is None or data.GetNumberOfPoints() == 0:
        return numpy.empty((0, 3)), numpy.empty(0)
    return vtk_to_numpy(data.GetPoints().GetData()).copy(), values_of(data, given).copy()


def values_of(data, given):
    array = data.GetPointData().GetArray(given.field)
    if array is None:
        names = [data.GetPointData().GetArrayName(i)
                 for i in range(data.GetPointData().GetNumberOfArrays())]
        sys.exit(f"paraview_frames.py: no field '{given.field}' (there are: {', '.join(names)})")
    values = vtk_to_numpy(array)
    if values.ndim == 1:
        return values
    return (numpy.linalg.norm(values, axis=1) if given.component == "Magnitude"
            else values[:, int(given.component)])


def edge_length(positions):
    """The usual distance of a particle to its nearest neighbour, from a sample of particles."""
    sample = positions[:: max(1, len(positions) // 200)]
    nearest = []
    for point in sample:
        distance = numpy.sum((positions - point) ** 2, axis=1)
        others = distance[distance > 0]
        if len(others):
            nearest.append(math.sqrt(others.min()))
    return float(numpy.median(nearest)) if nearest else 1.0


def colour_range(values, given):
    if given.range:
        return given.range
    low, high = float(values.min()), float(numpy.percentile(values, 98))
    if given.log:
        positive = values[values > 0]
        if not len(positive):
            sys.exit(f"paraview_frames.py: --log needs values above zero in '{given.field}'")
        high = float(numpy.percentile(positive, 98))
        low = max(float(numpy.percentile(positive, 2)), 1e-4 * high)
    return low, high if high > low else low + 1.0


def behind(source, depth):
    """What of it lies at z up to `depth`."""
    clip = simple.Clip(Input=source, ClipType="Plane", Invert=1)
    clip.ClipType.Origin, clip.ClipType.Normal = [0.0, 0.0, depth], [0.0, 0.0, 1.0]
    return clip


def show_particles(source, edge, flat):
    glyphs = simple.Glyph(Input=source, GlyphType="Box")
    glyphs.OrientationArray = ["POINTS", "No orientation array"]
    glyphs.ScaleArray = ["POINTS", "No scale array"]
    glyphs.GlyphMode = "All Points"
    glyphs.ScaleFactor = edge
    if flat:
        glyphs.GlyphType.ZLength = 1e-3  # seen along z, the sides of a cube only cost time
    return glyphs


def colour(display, view, given, low, high):
    simple.ColorBy(display, ("POINTS", given.field, given.component))
    table = simple.GetColorTransferFunction(given.field)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.RescaleTransferFunction(low, high)
    if given.log:
        table.MapControlPointsToLogSpace()
        table.UseLogScale = 1
    bar = simple.GetScalarBar(table, view)
    bar.Title = given.field.replace("_", " ") + unit_of(given.series, given.field)
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = BLACK
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"
    bar.ScalarBarLength = 0.5
    display.SetScalarBarVisibility(view, True)


def make_view(bounds, edge, given):
    """Looks along z at everything the specimen ever fills, with room for label and colour bar."""
    width, height = bounds[1] - bounds[0] + edge, bounds[3] - bounds[2] + edge
    head, foot, side = 0.07, 0.20, 0.04  # shares of the frame's width
    pixels_high = int(given.width * (head + foot + (1 - 2 * side) * height / width))
    view = simple.CreateView("RenderView")
    view.ViewSize = [given.width, pixels_high]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    scale = width / (1 - 2 * side)  # metres across the frame
    centre = [(bounds[0] + bounds[1]) / 2,
              (bounds[2] + bounds[3]) / 2 + (head - foot) / 2 * scale,
              (bounds[4] + bounds[5]) / 2]
    view.CameraFocalPoint = centre
    view.CameraPosition = [centre[0], centre[1], centre[2] + 10 * max(width, height)]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    view.CameraParallelScale = 0.5 * scale * pixels_high / given.width
    return view


def read_pixels(file):
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)


def write_row(files, output):
    pixels = numpy.concatenate([read_pixels(file) for file in files], axis=1)
    height, width, channels = pixels.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, channels), deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFileName(str(output))
    writer.Write()


def main():
    given = read_arguments()
    if not given.series.is_file():
        sys.exit(f"paraview_frames.py: {given.series}: there is no such file")
    times, strains = read_series(given.series)
    if not times:
        sys.exit(f"paraview_frames.py: {given.series}: no snapshots")
    chosen = choose(times, strains, given)
    output = given.output or given.series.parent / "frames"
    output.mkdir(parents=True, exist_ok=True)

    source = simple.Xdmf3ReaderS(FileName=str(given.series))
    snapshots = [particles_at(source, times[number], given) for number in [0, *chosen]]
    filled = [(positions, values) for positions, values in snapshots if len(values)]
    if not filled:
        sys.exit(f"paraview_frames.py: {given.series}: no particles in the frames chosen")
    low, high = colour_range(numpy.concatenate([values for _, values in filled]), given)
    edge = given.edge or edge_length(filled[0][0])
    everything = numpy.concatenate([positions for positions, _ in filled])
    bounds = numpy.column_stack([everything.min(axis=0), everything.max(axis=0)]).ravel().tolist()
    flat = bounds[4] == bounds[5]

    view = make_view(bounds, edge, given)
    shown = source if given.cut is None else behind(source, bounds[4] + given.cut * (bounds[5] - bounds[4]))
    display = simple.Show(show_particles(shown, edge, flat), view)
    display.SetRepresentationType("Surface")
    if flat:
        display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0  # colours as in the bar
    colour(display, view, given, low, high)
    label = simple.Text()
    words = simple.Show(label, view)
    words.Color = BLACK
    words.WindowLocation = "Upper Center"
    words.FontSize = max(10, given.width // 40)

    files = []
    for number in chosen:
        view.ViewTime = times[number]
        label.Text = (f"{100 * strains[number]:.1f} % strain" if any(strains)
                      else f"{times[number]:.3g} s")
        file = output / f"{given.series.stem}_{given.field}_{number:06d}.png"
        simple.Render(view)
        simple.SaveScreenshot(str(file), view, ImageResolution=view.ViewSize)
        files.append(file)
        print(file)
    row = output / f"{given.series.stem}_{given.field}_row.png"
    write_row(files, row)
    print(row)


main()
