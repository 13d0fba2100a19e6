# SPDX-FileCopyrightText: Eccentra contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The inputs around what is fuzzed: LIGGGHTS scripts of named lines, and OpenFOAM cases of named files. All of them work as they are."""
import pathlib
import struct

HEAD = """atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block 0 0.1 0 0.1 0 0.1 units box
create_box 1 box
neighbor 0.002 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.1
fix m6 all property/global shapeRollingFriction peratomtypepair 1 0.3
"""

CLUSTERS = {
    "pair": "pair_style gran/cluster model hertz tangential history",
    "pair_coeff": "pair_coeff * *",
    "step": "timestep 1e-6",
    "weight": "fix g all gravity 9.81 vector 0 0 -1",
    "template": "fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 diameter 5e-3",
    "mixture": "fix d all particledistribution/discrete 32452843 1 t 1.0",
    "insert": "fix ins all insert/pack seed 86028121 distributiontemplate d insert_every once overlapcheck yes all_in no "
              "particles_in_region 5 region box",
    "wall": "fix w all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0",
    "force": "fix mud all fluid/force rheology newtonian 1e-3 density 1000 drag chien",
    "flow": "fix flow all fluid/uniform velocity 0 0 0",
    "limit": "fix limit all timestep/limit",
    "balance": "fix share all balance/bodies every 10",
    "move": "fix move all nve/cluster",
    "dump": "dump d all cluster/vtk 5 grains*.vtp",
    "run": "run 5",
}

SPHERES = {
    "rolling": "pair_style gran model hertz tangential history rolling_friction shape",
    "pair_coeff": "pair_coeff * *",
    "step": "timestep 1e-6",
    "some": "create_atoms 1 single 0.05 0.05 0.05 units box\nset group all diameter 0.01 density 2500",
    "move": "fix move all nve/sphere",
    "run": "run 5",
}


GUEST = {**{key: line for key, line in SPHERES.items() if key != "run"},
         "rolling": "pair_style gran model hertz tangential history",
         "weight": "fix g all gravity 9.81 vector 0 0 -1",
         "force": "fix mud all fluid/force rheology newtonian 1e-3 density 1000 drag chien",
         "couple": "fix flow all fluid/couple link socket ./s every 1 wait 10 timeout 1",
         "run": "run 2"}


def script(lines, name, text):
    """The script with the line `name` replaced."""
    return HEAD + "\n".join({**lines, name: text}.values()) + "\n"


def _corners(*order):
    return [((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))[k] for k in order]


FACETS = [_corners(0, 2, 1), _corners(0, 1, 3), _corners(0, 3, 2), _corners(1, 2, 3)]  # of a tetrahedron, seen from outside
GOOD_STL = "solid s\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %d %d %d\n" % corner for corner in facet) +
                                 "endloop\nendfacet\n" for facet in FACETS) + "endsolid s\n"
GOOD_CLUMP = "0 0 0 1\n1 0 0 1\n"


GOOD_TABLE = "time,particles,pressure_gradient\n0,10,300\n1,10,310\n"
REPORTED = {"case/system/annulusMeshDict": "holeRadius 0.0635;\npipeRadius 0.02413;\neccentricity 0.5;\nlength 0.3;\ninclination 80;\n"}


def binary_stl(facets, count=None):
    """count: what the header says, where it does not tell the truth."""
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(float(x) for corner in facet for x in corner), 0) for facet in facets)
    return b"\0" * 80 + struct.pack("<I", len(facets) if count is None else count) + body


def section(source):
    """Files of a small coupled section, from the case that ships with the source."""
    case = pathlib.Path(source) / "cases" / "tomren-section"
    files = {str(path.relative_to(case)): path.read_text() for path in case.rglob("*") if path.is_file() and path.suffix != ".png"}
    files["system/annulusMeshDict"] = ("FoamFile { version 2.0; format ascii; class dictionary; object annulusMeshDict; }\nholeRadius 0.0635; "
        "pipeRadius 0.02413; eccentricity 0.5; length 0.3; inclination 80; cells (3 16 4); ends periodic;\n")
    files["system/controlDict"] = ("FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\nstartTime 0; endTime 1000; "
        "deltaT 5e-3; writeControl timeStep; writeInterval 100000;\n")
    files["constant/couplingProperties"] = ("FoamFile { version 2.0; format ascii; class dictionary; object couplingProperties; }\n"
        'link solver; demScript "in.cuttings";\n')
    files["constant/transportProperties"] = ("FoamFile { version 2.0; format ascii; class dictionary; object transportProperties; }\n"
        "transportModel Newtonian; rho 1000; nu 1e-3;\n")
    files["constant/flowProperties"] = ("FoamFile { version 2.0; format ascii; class dictionary; object flowProperties; }\n"
        "drive { type pressureGradient; gradient 300; }\n")
    files["in.cuttings"] = HEAD.replace("boundary f f f", "boundary f f p").replace("block 0 0.1 0 0.1 0 0.1", "block -0.065 0.065 -0.065 0.065 0 0.3") + (
        "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep 1e-4\nfix weight all gravity 9.81 vector 0 -0.984807753 -0.173648178\n"
        "create_atoms 1 single 0 0.05 0.1 units box\nset group all diameter 6.35e-3 density 2619\nfix move all nve/sphere\n"
        "fix mud all fluid/force rheology newtonian 1 density 1000 drag chien pressure_gradient on\nfix flow all fluid/couple link solver every 50\nrun 100\n")
    return files
