// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of stock styles. A test compares its rows with the registries of the LIGGGHTS that runs.
#include "styles/bodies/stock_styles.h"

namespace eccentra::styles {
namespace {

using Kind = StockKind;
constexpr StockVerdict acts = StockVerdict::acts, made_right = StockVerdict::made_right,
                       refused = StockVerdict::refused;
constexpr StockReach group = StockReach::group;

// Reasons and remedies that several rows share.
constexpr const char* centre_force = "adds to the force at the centre of mass";
constexpr const char* centre = "reads the centres of mass alone";
constexpr const char* centre_mass = "reads centre, velocity and mass of a body, which are the body's own";
constexpr const char* values = "passes on the values that the script names, as they are";
constexpr const char* geometry = "is geometry, which bodies do not enter";
constexpr const char* per_atom = "keeps values of its own per body";
constexpr const char* for_all = "keeps values of the whole scene";
constexpr const char* internal = "is made and removed by LIGGGHTS itself";
constexpr const char* molecules = "concerns bonds and molecules, which bodies do not have";
constexpr const char* programme = "steers the script or the output and touches no body";
constexpr const char* setting = "sets how LIGGGHTS works and reads nothing of a body";

constexpr const char* wrong_rotation = "turns bodies as spheres, or not at all";
constexpr const char* integrator = "use fix nve/cluster, which moves plain spheres, too";
constexpr const char* smoothed = "is for points of smoothed particle hydrodynamics";
constexpr const char* no_smoothed = "run smoothed particles in a script of their own";
constexpr const char* other_points = "is for particles of another atom style";
constexpr const char* granular = "use atom_style granular, of which clusters are made";
constexpr const char* sphere_wall = "lets bounding spheres touch the wall";
constexpr const char* our_wall = "use fix wall/gran/cluster, which takes the same words and serves plain spheres, too";
constexpr const char* multisphere = "carries clusters in another way, as spheres that are glued together";
constexpr const char* one_way = "choose one of the two ways to carry clusters in one script";
constexpr const char* cfd = "sends a body to the flow solver as its bounding sphere";
constexpr const char* our_fluid = "use fix fluid/force and fix fluid/couple";
constexpr const char* sphere_heat = "conducts heat where bounding spheres overlap, even through a gap between bodies";
constexpr const char* no_heat = "remove it, or run plain spheres in a script of their own";
constexpr const char* sphere_contacts = "takes overlaps of bounding spheres for contacts";
constexpr const char* contact_count = "use compute contact/cluster/atom, the contacts of each body";
constexpr const char* contact_list = "use compute contact/cluster/local, the contacts one by one";
constexpr const char* sphere_spin = "computes the energy of rotation with the inertia of the bounding sphere";
constexpr const char* our_spin = "use the output f_ID[2] of fix nve/cluster, the energy of rotation";
constexpr const char* sphere_volume = "takes the volume of the bounding sphere for that of the body";
constexpr const char* sphere_pairs = "computes forces between bounding spheres";
constexpr const char* our_pairs = "write pair_style gran/cluster model hertz tangential history rolling_friction off, "
                                  "which serves plain spheres, too";
constexpr const char* no_such_value =
    "belongs to particles of another atom style; a body's shape is that of its template";
constexpr const char* our_template = "declare a fix particletemplate/cluster with the shape that is meant";
constexpr const char* lost_orientation = "has no room for orientation and shape of a body";
constexpr const char* use_restart = "use write_restart and read_restart";
constexpr const char* minimiser = "moves centres downhill and turns no body";
constexpr const char* use_run = "use run with fix nve/cluster and fix viscous";

const std::vector<StockStyle> table = {
    // fixes
    {Kind::fix, "MINIMIZE", acts, internal},
    {Kind::fix, "READ_RESTART", acts, internal},
    {Kind::fix, "RESPA", acts, internal},
    {Kind::fix, "STORE", acts, internal},
    {Kind::fix, "adapt", refused, "changes radius or mass alone, which belong to a body's shape",
     "declare one particletemplate/cluster per size"},
    {Kind::fix, "addforce", acts, centre_force},
    {Kind::fix, "ave/atom", acts, values},
    {Kind::fix, "ave/correlate", acts, values},
    {Kind::fix, "ave/euler", made_right, "would fill its cells with bounding spheres; a body counts with its volume"},
    {Kind::fix, "ave/euler/stress", made_right,
     "would fill its cells with bounding spheres; a body counts with its volume"},
    {Kind::fix, "ave/histo", acts, values},
    {Kind::fix, "ave/spatial", acts, centre_mass},
    {Kind::fix, "ave/time", acts, values},
    {Kind::fix, "aveforce", acts, "averages the forces at the centres of mass"},
    {Kind::fix, "box/relax", refused, "belongs to minimize, which turns no body", use_run},
    {Kind::fix, "buoyancy", refused, "displaces the volume of the bounding sphere",
     "use fix fluid/force, whose buoyancy takes the volume of the shape", group},
    {Kind::fix, "check/timestep/gran", refused, "takes its limit from the bounding sphere, which is far too large",
     "use fix timestep/limit"},
    {Kind::fix, "check/timestep/sph", refused, smoothed, no_smoothed},
    {Kind::fix, "concave", refused, multisphere, one_way},
    {Kind::fix, "contacthistory", acts, internal},
    {Kind::fix, "contacthistory/mesh", acts, internal},
    {Kind::fix, "contactproperty/atom", refused, sphere_contacts, contact_count},
    {Kind::fix, "contactproperty/atom/wall", refused, sphere_contacts, contact_count},
    {Kind::fix, "continuum/weighted", refused, "spreads stresses of contacts between bounding spheres",
     "use compute pressure or compute stress/atom"},
    {Kind::fix, "couple/cfd", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/convection", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/convectiveImpl", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/dragforce", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/force", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/force/implicit", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/radiation", refused, cfd, our_fluid},
    {Kind::fix, "couple/cfd/speciesConvection", refused, cfd, our_fluid},
    {Kind::fix, "couple/lb/onetoone", refused, cfd, our_fluid},
    {Kind::fix, "custom_property/global", acts, for_all},
    {Kind::fix, "deform", acts, "moves the centres of mass with the box"},
    {Kind::fix, "deform/check", acts, values},
    {Kind::fix, "diam/max", acts, "reads bounding radii to size lists, as is meant"},
    {Kind::fix, "drag", acts, centre_force},
    {Kind::fix, "dt/reset", acts, centre_mass},
    {Kind::fix, "efield", acts, centre_force},
    {Kind::fix, "enforce2d", refused, "makes the scene flat, but bodies are solids",
     "use a thin box with periodic sides"},
    {Kind::fix, "external", acts, "hands the forces to another program"},
    {Kind::fix, "fiber/spring/simple", refused, "ties bounding spheres with springs",
     "use one body per fibre: shape file of particletemplate/cluster", group},
    {Kind::fix, "freeze", acts, "sets force and torque to zero"},
    {Kind::fix, "gravity", acts, centre_mass},
    {Kind::fix, "heat/gran", refused, sphere_heat, no_heat},
    {Kind::fix, "heat/gran/conduction", refused, sphere_heat, no_heat},
    {Kind::fix, "insert/pack", made_right,
     "would test bounding spheres for overlap; bodies are tested by their spheres"},
    {Kind::fix, "insert/rate/region", made_right,
     "would test bounding spheres for overlap; bodies are tested by their spheres"},
    {Kind::fix, "insert/stream", made_right,
     "would test bounding spheres for overlap; bodies are tested by their spheres, and turn from their release on"},
    {Kind::fix, "lineforce", acts, centre_force},
    {Kind::fix, "massflow/mesh", acts, "counts a body and its mass when its centre crosses the mesh"},
    {Kind::fix, "massflow/mesh/sieve", refused, "lets bounding spheres through its openings",
     "use a mesh with openings and fix wall/gran/cluster"},
    {Kind::fix, "mesh/surface", acts, geometry},
    {Kind::fix, "mesh/surface/planar", acts, geometry},
    {Kind::fix, "momentum", acts, centre_mass},
    {Kind::fix, "move", refused, "moves and spins a body but leaves its orientation as it is",
     "use fix nve/cluster with velocity, or move a mesh with fix move/mesh", group},
    {Kind::fix, "move/mesh", acts, geometry},
    {Kind::fix, "move/mesh/file", acts, geometry},
    {Kind::fix, "move/mesh/gran", acts, geometry},
    {Kind::fix, "multicontact/halfspace", refused, sphere_contacts, contact_count},
    {Kind::fix, "multisphere", refused, multisphere, one_way},
    {Kind::fix, "multisphere/break", refused, multisphere, one_way},
    {Kind::fix, "multisphere/nointegration", refused, multisphere, one_way},
    {Kind::fix, "neighlist/mesh", acts, internal},
    {Kind::fix, "nve", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/asphere", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/asphere/noforce", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/limit", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/line", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/noforce", refused, wrong_rotation, integrator, group},
    {Kind::fix, "nve/sph", refused, smoothed, no_smoothed},
    {Kind::fix, "nve/sph/stationary", refused, smoothed, no_smoothed},
    {Kind::fix, "nve/sphere", refused, wrong_rotation, integrator, group},
    {Kind::fix, "particledistribution/discrete", acts, "mixes templates"},
    {Kind::fix, "particledistribution/discrete/massbased", acts, "mixes templates by the mass of the shapes"},
    {Kind::fix, "particledistribution/discrete/numberbased", acts, "mixes templates by number"},
    {Kind::fix, "particletemplate/multiplespheres", acts, "makes plain spheres"},
    {Kind::fix, "particletemplate/multisphere", refused, multisphere, one_way},
    {Kind::fix, "particletemplate/sphere", acts, "makes plain spheres"},
    {Kind::fix, "planeforce", acts, centre_force},
    {Kind::fix, "print", acts, programme},
    {Kind::fix, "property/atom", acts, per_atom},
    {Kind::fix, "property/atom/regiontracer/time", acts, per_atom},
    {Kind::fix, "property/atom/timetracer", acts, per_atom},
    {Kind::fix, "property/atom/tracer", acts, per_atom},
    {Kind::fix, "property/atom/tracer/stream", acts, per_atom},
    {Kind::fix, "property/atomtype", acts, for_all},
    {Kind::fix, "property/atomtypepair", acts, for_all},
    {Kind::fix, "property/global", acts, for_all},
    {Kind::fix, "region/variable", acts, geometry},
    {Kind::fix, "rigid", refused, "glues bodies together as points and spheres",
     "declare the whole as one shape: shape file of particletemplate/cluster", group},
    {Kind::fix, "setforce", acts, "sets the force at the centre of mass"},
    {Kind::fix, "sph/density/continuity", refused, smoothed, no_smoothed},
    {Kind::fix, "sph/density/corr", refused, smoothed, no_smoothed},
    {Kind::fix, "sph/density/summation", refused, smoothed, no_smoothed},
    {Kind::fix, "sph/pressure", refused, smoothed, no_smoothed},
    {Kind::fix, "spring", acts, centre_force},
    {Kind::fix, "spring/rg", acts, centre_force},
    {Kind::fix, "spring/self", acts, centre_force},
    {Kind::fix, "store/force", acts, values},
    {Kind::fix, "store/state", acts, values},
    {Kind::fix, "transportequation/scalar", acts, "reads the mass of a body, which is its own"},
    {Kind::fix, "viscous", acts, centre_force},
    {Kind::fix, "wall/gran", refused, sphere_wall, our_wall, group},
    {Kind::fix, "wall/region", refused, sphere_wall, our_wall, group},
    {Kind::fix, "wall/region/sph", refused, smoothed, no_smoothed},
    {Kind::fix, "wall/sph", refused, smoothed, no_smoothed},

    // computes
    {Kind::compute, "atom/molecule", acts, molecules},
    {Kind::compute, "bond/local", acts, molecules},
    {Kind::compute, "centro/atom", acts, centre},
    {Kind::compute, "cluster/atom", acts, centre},
    {Kind::compute, "cna/atom", acts, centre},
    {Kind::compute, "com", acts, centre_mass},
    {Kind::compute, "com/molecule", acts, molecules},
    {Kind::compute, "contact/atom", refused, sphere_contacts, contact_count},
    {Kind::compute, "contact/atom/gran", refused, sphere_contacts, contact_count},
    {Kind::compute, "coord/atom", acts, centre},
    {Kind::compute, "displace/atom", acts, centre},
    {Kind::compute, "erotate", refused, sphere_spin, our_spin},
    {Kind::compute, "erotate/asphere", refused, other_points, our_spin},
    {Kind::compute, "erotate/multisphere", refused, multisphere, our_spin},
    {Kind::compute, "erotate/sphere", refused, sphere_spin, our_spin, group},
    {Kind::compute, "erotate/sphere/atom", refused, sphere_spin, our_spin, group},
    {Kind::compute, "group/group", refused, sphere_pairs, "use the forces of dump custom"},
    {Kind::compute, "gyration", acts, centre_mass},
    {Kind::compute, "gyration/molecule", acts, molecules},
    {Kind::compute, "inertia/molecule", acts, molecules},
    {Kind::compute, "ke", acts, centre_mass},
    {Kind::compute, "ke/atom", acts, centre_mass},
    {Kind::compute, "ke/multisphere", refused, multisphere, "use compute ke and f_ID[2] of fix nve/cluster"},
    {Kind::compute, "msd", acts, centre},
    {Kind::compute, "msd/molecule", acts, molecules},
    {Kind::compute, "multisphere", refused, multisphere, one_way},
    {Kind::compute, "multisphere/single", refused, multisphere, one_way},
    {Kind::compute, "nparticles/tracer/region", acts, centre_mass},
    {Kind::compute, "pair/gran/local", refused, sphere_contacts, contact_list},
    {Kind::compute, "pe", acts, "sums energies of pairs, which contacts do not have"},
    {Kind::compute, "pe/atom", acts, "sums energies of pairs, which contacts do not have"},
    {Kind::compute, "pressure", acts, "sums force times distance of centres over pairs of bodies"},
    {Kind::compute, "property/atom", acts,
     "passes on the values that the script names; radius and diameter are those of the bounding sphere"},
    {Kind::compute, "property/local", acts, "lists pairs of the neighbour list, which are near and need not touch"},
    {Kind::compute, "property/molecule", acts, molecules},
    {Kind::compute, "rdf", acts, centre},
    {Kind::compute, "reduce", acts, values},
    {Kind::compute, "reduce/region", acts, values},
    {Kind::compute, "reduce/sph", acts, values},
    {Kind::compute, "rigid", refused, multisphere, one_way},
    {Kind::compute, "slice", acts, values},
    {Kind::compute, "stress/atom", acts, "sums force times distance of centres over pairs of bodies"},
    {Kind::compute, "temp", acts, centre_mass},
    {Kind::compute, "wall/gran/local", refused, sphere_contacts, contact_list},

    // pair styles
    {Kind::pair_style, "bubble", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "gran", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "gran_bubble", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "hybrid", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "hybrid/overlay", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "line/lj", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "soft", refused, sphere_pairs, our_pairs},
    {Kind::pair_style, "sph/artVisc/tensCorr", refused, smoothed, no_smoothed},

    // dumps
    {Kind::dump, "atom/vtk", acts, "writes a point per body; its radius is that of the bounding sphere"},
    {Kind::dump, "custom", acts,
     "writes the values that the script names; radius and diameter are those of the bounding sphere"},
    {Kind::dump, "custom/vtk", acts,
     "writes the values that the script names; radius and diameter are those of the bounding sphere"},
    {Kind::dump, "custom/vtm", acts,
     "writes the values that the script names; radius and diameter are those of the bounding sphere"},
    {Kind::dump, "decomposition/vtk", acts, geometry},
    {Kind::dump, "euler/vtk", acts, "writes the cells of fix ave/euler"},
    {Kind::dump, "image", refused, "draws a body as a ball", "use dump cluster/vtk"},
    {Kind::dump, "local", acts, values},
    {Kind::dump, "local/gran/vtk", refused, sphere_contacts, contact_list},
    {Kind::dump, "mesh/gran/VTK", acts, geometry},
    {Kind::dump, "mesh/stl", acts, geometry},
    {Kind::dump, "mesh/vtk", acts, geometry},
    {Kind::dump, "mesh/vtm", acts, geometry},
    {Kind::dump, "movie", refused, "draws a body as a ball", "use dump cluster/vtk"},
    {Kind::dump, "stl", acts, geometry},
    {Kind::dump, "xyz", acts, centre},

    // regions
    {Kind::region, "block", acts, "holds a body if it holds its centre"},
    {Kind::region, "cone", acts, "holds a body if it holds its centre"},
    {Kind::region, "cylinder", acts, "holds a body if it holds its centre"},
    {Kind::region, "intersect", acts, "holds a body if it holds its centre"},
    {Kind::region, "mesh/tet", acts, "holds a body if it holds its centre"},
    {Kind::region, "plane", acts, "holds a body if it holds its centre"},
    {Kind::region, "prism", acts, "holds a body if it holds its centre"},
    {Kind::region, "sphere", acts, "holds a body if it holds its centre"},
    {Kind::region, "union", acts, "holds a body if it holds its centre"},
    {Kind::region, "wedge", acts, "holds a body if it holds its centre"},

    // commands
    {Kind::command, "angle_coeff", acts, molecules},
    {Kind::command, "angle_style", acts, molecules},
    {Kind::command, "atom_modify", acts, setting},
    {Kind::command, "atom_style", acts, "chooses what an atom has; see the atom styles"},
    {Kind::command, "bond_coeff", acts, molecules},
    {Kind::command, "bond_style", acts, molecules},
    {Kind::command, "boundary", acts, setting},
    {Kind::command, "box", acts, setting},
    {Kind::command, "change_box", acts, "moves the centres of mass with the box"},
    {Kind::command, "clear", made_right, "would forget the styles of Eccentra with its own registries"},
    {Kind::command, "communicate", acts, setting},
    {Kind::command, "compute", acts, "makes a compute; see the computes"},
    {Kind::command, "compute_modify", acts, setting},
    {Kind::command, "create_atoms", acts, "makes plain spheres"},
    {Kind::command, "create_box", acts, geometry},
    {Kind::command, "delete_atoms", made_right,
     "numbers the atoms anew with `compress yes`; contacts follow, and the order of the ids is kept"},
    {Kind::command, "delete_bonds", acts, molecules},
    {Kind::command, "dielectric", acts, setting},
    {Kind::command, "dihedral_coeff", acts, molecules},
    {Kind::command, "dihedral_style", acts, molecules},
    {Kind::command, "dimension", acts, "sets the number of dimensions; a run with clusters needs 3"},
    {Kind::command, "displace_atoms", made_right,
     "moves centres; with `rotate` the orientations and the contacts of bodies turn as well"},
    {Kind::command, "dump", acts, "makes a dump; see the dumps"},
    {Kind::command, "dump_modify", acts, setting},
    {Kind::command, "echo", acts, programme},
    {Kind::command, "fix", acts, "makes a fix; see the fixes"},
    {Kind::command, "fix_modify", acts, setting},
    {Kind::command, "force_dt_reset", acts, setting},
    {Kind::command, "group", acts, centre},
    {Kind::command, "hard_particles", acts, setting},
    {Kind::command, "if", acts, programme},
    {Kind::command, "improper_coeff", acts, molecules},
    {Kind::command, "improper_style", acts, molecules},
    {Kind::command, "include", acts, programme},
    {Kind::command, "info", acts, programme},
    {Kind::command, "jump", acts, programme},
    {Kind::command, "kspace_modify", acts, setting},
    {Kind::command, "kspace_style", acts, setting},
    {Kind::command, "label", acts, programme},
    {Kind::command, "lattice", acts, setting},
    {Kind::command, "log", acts, programme},
    {Kind::command, "mass", acts, "sets masses of types, which granular atoms do not read"},
    {Kind::command, "min_modify", acts, setting},
    {Kind::command, "min_style", acts, "chooses a minimiser; see minimize"},
    {Kind::command, "minimize", refused, minimiser, use_run},
    {Kind::command, "modify_timing", acts, programme},
    {Kind::command, "neigh_modify", acts, setting},
    {Kind::command, "neighbor", acts, setting},
    {Kind::command, "newton", acts, setting},
    {Kind::command, "next", acts, programme},
    {Kind::command, "package", acts, setting},
    {Kind::command, "pair_coeff", acts, setting},
    {Kind::command, "pair_modify", acts, setting},
    {Kind::command, "pair_style", acts, "chooses the contacts; see the pair styles"},
    {Kind::command, "pair_write", refused, "tabulates the force between two points", "place two bodies and use run"},
    {Kind::command, "partition", acts, programme},
    {Kind::command, "print", acts, programme},
    {Kind::command, "processors", acts, setting},
    {Kind::command, "quit", acts, programme},
    {Kind::command, "read_data", acts, "adds plain spheres"},
    {Kind::command, "read_dump", refused, lost_orientation, use_restart},
    {Kind::command, "read_restart", made_right,
     "checks nothing; a damaged or shortened file is refused, and so is a run that leaves its bodies unused"},
    {Kind::command, "region", acts, "makes a region; see the regions"},
    {Kind::command, "replicate", refused, "gives the copies of a body the contacts of the original",
     "insert the bodies in the larger box"},
    {Kind::command, "reset_timestep", acts, setting},
    {Kind::command, "restart", acts, "writes all of a body"},
    {Kind::command, "rotate", refused, "does nothing in LIGGGHTS 3.8.0",
     "use displace_atoms rotate, which turns bodies as well"},
    {Kind::command, "run", acts, "checks the bodies first: radius, mass, contacts and one integrator for each"},
    {Kind::command, "run_style", acts, "chooses how time advances; see the run styles"},
    {Kind::command, "run_time", acts, "checks the bodies first: radius, mass, contacts and one integrator for each"},
    {Kind::command, "set", made_right, "gives bodies values of spheres; see the words of set"},
    {Kind::command, "shell", acts, programme},
    {Kind::command, "soft_particles", acts, setting},
    {Kind::command, "special_bonds", acts, molecules},
    {Kind::command, "suffix", acts, setting},
    {Kind::command, "thermo", acts, programme},
    {Kind::command, "thermo_log", acts, programme},
    {Kind::command, "thermo_modify", acts, programme},
    {Kind::command, "thermo_style", acts, "chooses what is printed; see the thermo columns"},
    {Kind::command, "timestep", acts, setting},
    {Kind::command, "uncompute", acts, programme},
    {Kind::command, "undump", acts, programme},
    {Kind::command, "unfix", acts, programme},
    {Kind::command, "units", acts, setting},
    {Kind::command, "variable", acts,
     "reads what its formula names; group functions take bodies as points of their mass"},
    {Kind::command, "velocity", acts, "sets the velocity of the centre of mass"},
    {Kind::command, "write_data", refused, lost_orientation,
     "use write_restart, or dump cluster/vtk for other programs"},
    {Kind::command, "write_dump", acts, "makes a dump and writes it once; see the dumps"},
    {Kind::command, "write_restart", acts, "writes all of a body"},
    {Kind::command, "write_restart_on_signal", acts, "writes all of a body"},

    // arguments of set
    {Kind::set, "add", acts, programme},
    {Kind::set, "angle", refused, molecules, "remove it"},
    {Kind::set, "angmom", refused, no_such_value, "use omegax, omegay and omegaz, which the angular momentum follows"},
    {Kind::set, "aspect_ratio", refused, no_such_value, our_template},
    {Kind::set, "blockiness", refused, no_such_value, our_template},
    {Kind::set, "bond", refused, molecules, "remove it"},
    {Kind::set, "charge", refused, no_such_value, "remove it"},
    {Kind::set, "density", made_right,
     "would multiply the density by the volume of the bounding sphere; the mass of a "
     "body is density times the volume of its shape"},
    {Kind::set, "diameter", refused, "cuts the bounding radius and leaves the shape as it is",
     "declare one fix particletemplate/cluster per size"},
    {Kind::set, "dihedral", refused, molecules, "remove it"},
    {Kind::set, "dipole", refused, no_such_value, "remove it"},
    {Kind::set, "dipole/random", refused, no_such_value, "remove it"},
    {Kind::set, "image", acts, setting},
    {Kind::set, "improper", refused, molecules, "remove it"},
    {Kind::set, "inertiax", refused, no_such_value, our_template},
    {Kind::set, "inertiay", refused, no_such_value, our_template},
    {Kind::set, "inertiaz", refused, no_such_value, our_template},
    {Kind::set, "length", refused, no_such_value, our_template},
    {Kind::set, "mass", made_right, "would leave the density behind; the density of a body follows from its shape"},
    {Kind::set, "meso_cv", refused, smoothed, "remove it"},
    {Kind::set, "meso_e", refused, smoothed, "remove it"},
    {Kind::set, "meso_rho", refused, smoothed, "remove it"},
    {Kind::set, "mol", acts, molecules},
    {Kind::set, "omegax", made_right, "sets the spin; the angular momentum of a body follows at the next run"},
    {Kind::set, "omegay", made_right, "sets the spin; the angular momentum of a body follows at the next run"},
    {Kind::set, "omegaz", made_right, "sets the spin; the angular momentum of a body follows at the next run"},
    {Kind::set, "property/atom", acts, per_atom},
    {Kind::set, "quat", refused, no_such_value,
     "use displace_atoms rotate about the body's centre, or the word orientation when it is inserted"},
    {Kind::set, "quat/random", refused, no_such_value, "use the word orientation random when bodies are inserted"},
    {Kind::set, "quat_direct", refused, no_such_value,
     "use displace_atoms rotate about the body's centre, or the word orientation when it is inserted"},
    {Kind::set, "roundness", refused, no_such_value, our_template},
    {Kind::set, "shape", refused, no_such_value, our_template},
    {Kind::set, "smd/contact/radius", refused, smoothed, "remove it"},
    {Kind::set, "smd/mass/density", refused, smoothed, "remove it"},
    {Kind::set, "sphkernel", refused, smoothed, "remove it"},
    {Kind::set, "theta", refused, no_such_value, "use displace_atoms rotate about the body's centre"},
    {Kind::set, "type", acts, "chooses the material"},
    {Kind::set, "type/fraction", acts, "chooses the material"},
    {Kind::set, "until", acts, programme},
    {Kind::set, "volume", refused, no_such_value, our_template},
    {Kind::set, "vx", acts, centre},
    {Kind::set, "vy", acts, centre},
    {Kind::set, "vz", acts, centre},
    {Kind::set, "x", acts, centre},
    {Kind::set, "y", acts, centre},
    {Kind::set, "z", acts, centre},

    // thermo columns that read particles
    {Kind::thermo, "atoms", acts, "counts bodies and plain spheres"},
    {Kind::thermo, "density", acts, "divides the mass of all bodies by the volume of the box"},
    {Kind::thermo, "erotate", refused, sphere_spin, our_spin},
    {Kind::thermo, "fmax", acts, "reads the forces at the centres of mass"},
    {Kind::thermo, "fnorm", acts, "reads the forces at the centres of mass"},
    {Kind::thermo, "ke", acts, "sums the energy of translation"},

    // atom styles
    {Kind::atom_style, "atomic", refused, other_points, granular},
    {Kind::atom_style, "charge", refused, other_points, granular},
    {Kind::atom_style, "ellipsoid", refused, other_points, granular},
    {Kind::atom_style, "full", refused, other_points, granular},
    {Kind::atom_style, "granular", acts, "has radius, mass, density, spin and torque, which bodies need"},
    {Kind::atom_style, "hybrid", acts, "serves where granular is one of its parts; a run checks it"},
    {Kind::atom_style, "line", refused, other_points, granular},
    {Kind::atom_style, "molecular", refused, other_points, granular},
    {Kind::atom_style, "sph", refused, smoothed, granular},
    {Kind::atom_style, "sph/var", refused, smoothed, granular},
    {Kind::atom_style, "sphere", acts, "has radius, mass, density, spin and torque, which bodies need"},
    {Kind::atom_style, "tri", refused, other_points, granular},

    // run and minimiser styles
    {Kind::run_style, "respa", refused, "has steps within steps, in which bodies do not move", "use run_style verlet"},
    {Kind::run_style, "verlet", acts, "calls fix nve/cluster twice a step"},
    {Kind::min_style, "cg", refused, minimiser, use_run},
};

} // namespace

const std::vector<StockStyle>& stock_styles() {
  return table;
}

const StockStyle* find_stock_style(StockKind kind, const std::string& name) {
  for (const StockStyle& style : table)
    if (style.kind == kind && name == style.name)
      return &style;
  return nullptr;
}

const char* kind_name(StockKind kind) {
  switch (kind) {
  case StockKind::fix:
    return "fix";
  case StockKind::compute:
    return "compute";
  case StockKind::pair_style:
    return "pair_style";
  case StockKind::dump:
    return "dump";
  case StockKind::region:
    return "region";
  case StockKind::command:
    return "command";
  case StockKind::set:
    return "set";
  case StockKind::thermo:
    return "thermo_style";
  case StockKind::atom_style:
    return "atom_style";
  case StockKind::run_style:
    return "run_style";
  case StockKind::min_style:
    return "min_style";
  }
  return "";
}

std::string refusal(const StockStyle& style, const std::string& who) {
  return who + ": '" + style.name + "' is not offered with clusters, because it " + style.reason + "; " + style.remedy +
         (style.reach == StockReach::group ? ", or give it a group without clusters" : "");
}

} // namespace eccentra::styles
