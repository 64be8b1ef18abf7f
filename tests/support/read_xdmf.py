"""What ParaView sees in a series of snapshots, printed as JSON; for pvpython.

    pvpython read_xdmf.py particles.xdmf [--expect expected.json]

Opens the series with both readers that the file dialog offers (Xdmf3ReaderS, XDMFReader). With
--expect the answer of each is compared with that file and the exit status is 1 on a difference.
"""
import argparse
import json
import sys

from paraview import servermanager, simple


def open_series(reader, path):
    if reader == "XDMFReader":
        return simple.XDMFReader(FileNames=[path])
    return simple.Xdmf3ReaderS(FileName=path)


def leaf(dataset):
    """The particles themselves: readers wrap them in composite data sets of different depth."""
    while dataset is not None and dataset.IsA("vtkCompositeDataSet"):
        walk = dataset.NewIterator()
        walk.InitTraversal()
        if walk.IsDoneWithTraversal():
            return None
        dataset = walk.GetCurrentDataObject()
    return dataset


def describe(dataset):
    if dataset is None or dataset.GetNumberOfPoints() == 0:
        return {"points": 0, "cells": 0}
    arrays = {}
    for index in range(dataset.GetPointData().GetNumberOfArrays()):
        array = dataset.GetPointData().GetArray(index)
        arrays[array.GetName()] = {"components": array.GetNumberOfComponents(),
                                   "first_component": list(array.GetRange(0))}
    return {"points": dataset.GetNumberOfPoints(), "cells": dataset.GetNumberOfCells(),
            "bounds": list(dataset.GetBounds()), "arrays": arrays}


def read(reader, path):
    source = open_series(reader, path)
    source.UpdatePipelineInformation()
    times = source.TimestepValues
    times = list(times) if hasattr(times, "__iter__") else [times]
    seen = []
    for time in times:
        source.UpdatePipeline(time)
        seen.append({"time": time, **describe(leaf(servermanager.Fetch(source)))})
    return seen


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("series")
    arguments.add_argument("--expect")
    given = arguments.parse_args()
    answers = {reader: read(reader, given.series) for reader in ("Xdmf3ReaderS", "XDMFReader")}
    print(json.dumps(answers, indent=1))
    if given.expect:
        with open(given.expect) as file:
            expected = json.load(file)
        for reader, seen in answers.items():
            if seen != expected:
                sys.exit(f"{reader} sees something else than {given.expect} says")


main()
