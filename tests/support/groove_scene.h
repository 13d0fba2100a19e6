// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A small grain (type 2, the first atom) on the groove between two large spheres (Vyas et al. 2025).
#pragma once

#include <string>
#include <vector>

namespace eccentra::test {

/// Box, materials and contacts; `contacts`: keywords behind `tangential history`. The larger spheres: one at each place
/// of `held`.
inline std::string groove_scene(const std::string& contacts, const std::string& grain,
                                const std::vector<std::string>& held) {
  std::string script = "atom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
                       "communicate single vel yes\nunits si\n"
                       "region box block -0.03 0.03 -0.02 0.02 -0.02 0.02 units box\ncreate_box 2 box\n"
                       "neighbor 0.001 bin\nneigh_modify delay 0\n"
                       "fix m1 all property/global youngsModulus peratomtype 5e8 5e8\n"
                       "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
                       "fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5\n"
                       "fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5\n"
                       "fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0 0 0 0\n"
                       "pair_style gran/cluster model hertz tangential history " +
                       contacts + "\npair_coeff * *\ntimestep 5e-7\ncreate_atoms 2 single " + grain + " units box\n";
  for (const std::string& place : held)
    script += "create_atoms 1 single " + place + " units box\n";
  return script + "set type 1 diameter 0.01 density 2500\nset type 2 diameter 0.0005 density 2500\n"
                  "group large type 1\ngroup fine type 2\n";
}

/// The large spheres are held, the grain moves.
inline constexpr const char* groove_motion =
    "fix frz large freeze\nfix g fine gravity 9.81 vector 0 0 -1\nfix integr fine nve/cluster\n";

} // namespace eccentra::test
