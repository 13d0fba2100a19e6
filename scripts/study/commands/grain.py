# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes one of ten grains as an STL file: pebble, stone, rubble, wedge, sand, cutting, flake, blade, needle, column."""
import argparse
import pathlib
import sys

from .. import grain_shapes
from ..programs import Failure, write_output
from ..units import LENGTH, positive


def main():
    """Writes the file, or lists the grains."""
    words = argparse.ArgumentParser(prog="eccentra grain", description=__doc__, allow_abbrev=False,
                                    epilog="In a script: shape hull NAME.stl rounding 0.1, or shape stl NAME.stl spheres 40. "
                                    "In eccentra new: --shape \"grain NAME\".")
    words.add_argument("name", nargs="?", help="of the grain; without it all are listed")
    words.add_argument("--diameter", default="4mm", help="of the sphere of equal volume (default: %(default)s)")
    words.add_argument("-o", "--output", type=pathlib.Path, help="file (default: NAME.stl)")
    options = words.parse_args()
    if options.name is None:
        sys.stdout.write("".join(f"  {name:10} {grain.what}\n" for name, grain in grain_shapes.GRAINS.items()))
        return 0
    if options.name not in grain_shapes.GRAINS:
        raise Failure(f"'{options.name}' is not a grain; expected one of {', '.join(grain_shapes.GRAINS)}")
    file = options.output or pathlib.Path(f"{options.name}.stl")
    write_output({file: grain_shapes.stl_of(options.name, positive("diameter", options.diameter, LENGTH)[0])})
    return 0
