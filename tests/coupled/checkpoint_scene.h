// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A scene in which everything that a checkpoint must keep is at work: contacts with friction, walls, drag, pressure.
#pragma once

#include "coupled/coupled_case.h"

#include <cmath>
#include <string>

namespace eccentra::test {

constexpr int kStepsPerCouplingStep = 40;

/// Bodies that are thrown together over a floor, in a fluid that they stir. `link`: arguments after `link`, with
/// whatever follows; ends at DEM step `steps`. The state then is in the file end.bodies, 17 digits, by tag.
/// `resumable`: the script has that word; else it reads its checkpoint itself.
inline BoxCase stirred_box(const std::string& link, int steps, bool clusters, bool screen = false,
                           bool resumable = false) {
  BoxCase box;
  box.size[0] = box.size[1] = 0.036;
  box.size[2] = 0.054;
  box.cells[2] = 9;
  box.periodic[2] = false;
  box.viscosity = 0.05;
  box.coupling = "voidFraction diffusion;";
  std::string beginning, bodies;
  for (int i = 0; i < 32; ++i) {
    const std::string tag = std::to_string(i + 1);
    const int layer = i / 16;
    beginning += "create_atoms 1 single " + std::to_string(0.0045 + 0.009 * (i % 4)) + ' ' +
                 std::to_string(0.0045 + 0.009 * (i / 4 % 4)) + ' ' + std::to_string(0.0042 + 0.0085 * layer) +
                 " units box\n";
    bodies += "set atom " + tag + " vx " + std::to_string(0.4 * std::sin(7 * i)) + " vy " +
              std::to_string(0.4 * std::cos(5 * i)) + " vz " + std::to_string(-0.3 + 0.1 * std::sin(3 * i)) + '\n';
  }
  const std::string common = "fix m1 all property/global youngsModulus peratomtype 5e6\n"
                             "fix m2 all property/global poissonsRatio peratomtype 0.25\n"
                             "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5\n"
                             "fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\n";
  const std::string pair = clusters ? "pair_style gran/cluster model hertz tangential history\n"
                                    : "pair_style gran model hertz tangential history\n";
  box.script =
      std::string(resumable ? "resumable\n" : "variable resumes index 0\n") +
      "atom_style granular\natom_modify map array\nboundary p p f\nnewton off\ncommunicate single vel yes\nunits si\n"
      "processors 1 1 *\n" +
      (resumable ? "" : "if \"${resumes}\" then \"jump in.dem again\"\n") +
      "region box block 0 0.036 0 0.036 0 0.054 units box\ncreate_box 1 box\n";
  const std::string shape =
      "fix body all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube "
      "8 diameter 6e-3\n";
  if (clusters)
    // Bodies enter by insertion, which gives them their shape.
    box.script += common + pair + "pair_coeff * *\n" + shape +
                  "fix mix all particledistribution/discrete 32452843 1 body 1.0\n"
                  "region spout block 0 0.036 0 0.036 0 0.040 units box\n"
                  "fix pour all insert/pack seed 49979687 distributiontemplate mix insert_every once overlapcheck yes "
                  "all_in yes vel uniform 0.1 -0.2 -0.3 0.3 0.3 0.3 region spout particles_in_region 32\n"
                  "fix move all nve/cluster\ntimestep 5e-5\nrun 1\nunfix pour\nreset_timestep 0\n";
  else
    box.script += beginning + "set group all diameter 6e-3 density 2619\n" + bodies;
  if (!resumable)
    box.script += "jump in.dem onward\nlabel again\nread_restart ${checkpoint}\n" +
                  (clusters ? common + pair + "pair_coeff * *\n" + shape + "fix move all nve/cluster\n" : "") +
                  "label onward\n";
  box.script +=
      std::string("neighbor 0.002 bin\nneigh_modify delay 0\n") +
      (clusters ? "" : common + pair + "pair_coeff * *\nfix move all nve/sphere\n") +
      "timestep 5e-5\n"
      "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0\n"
      "fix roof all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.054\n"
      "fix weight all gravity 9.81 vector 0 0 -1\n"
      "fix mud all fluid/force rheology herschel_bulkley 0 0.05 1 density 1000 drag chien pressure_gradient on" +
      (screen ? " shear_lift saffman_mei rotational_lift oesterle_bui_dinh screen 0.05\n" : "\n") +
      "fix flow all fluid/couple link " + link + "\n" + "thermo 400\nthermo_style custom step atoms ke\n" + "run " +
      std::to_string(steps) + " upto\n" + "dump end all custom 1 end.bodies id x y z vx vy vz omegax omegay omegaz\n" +
      "dump_modify end sort id format \"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\n" + "run 0\n";
  return box;
}

} // namespace eccentra::test
