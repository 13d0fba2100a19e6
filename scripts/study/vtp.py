# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the points of files of dump cluster/vtk (.vtp) and of clusterShape --vtk (.vtk)."""
import re

TYPES = {"Float32": "<f4", "Int32": "<i4"}
RAW = b'<AppendedData encoding="raw">'


def arrays_of(path):
    """{name: numpy array} of the points of a .vtp file, `Points` among them: raw data behind an underscore, each array behind its size."""
    import numpy
    data = path.read_bytes()
    head, behind = data.split(RAW, 1)
    begin = len(head) + len(RAW) + behind.index(b"_") + 1
    of_points = b"".join(re.findall(rb"<(?:PointData|Points)\b.*?</(?:PointData|Points)>", head, re.S))
    found = {}
    for kind, name, rest in re.findall(rb'<DataArray type="(\w+)" Name="([^"]*)"([^>]*)', of_points):
        width = re.search(rb'NumberOfComponents="(\d+)"', rest)
        at = begin + int(re.search(rb'offset="(\d+)"', rest)[1])
        size = int.from_bytes(data[at:at + 4], "little")
        values = numpy.frombuffer(data[at + 4:at + 4 + size], TYPES[kind.decode()])
        found[name.decode()] = values.reshape(-1, int(width[1])) if width else values
    return found


def surface_points(path):
    """Points of a binary legacy file."""
    import numpy
    data = path.read_bytes()
    match = re.search(rb"^POINTS (\d+) double\n", data, re.M)
    return numpy.frombuffer(data, ">f8", 3 * int(match[1]), match.end()).reshape(-1, 3).astype(float)
