// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The lines with which scripts of granular scenes begin.
#pragma once

#include <string>

namespace eccentra::test {

/// Settings and a simulation box; `block`: its six bounds [m].
inline std::string granular_box(const std::string& block = "-0.05 0.05 -0.05 0.05 -0.05 0.05",
                                const std::string& boundary = "f f f") {
  return "atom_style granular\natom_modify map array\nboundary " + boundary +
         "\nnewton off\ncommunicate single vel yes\nunits si\nregion box block " + block +
         " units box\ncreate_box 1 box\n";
}

/// The only material of a scene.
struct Material {
  double youngs = 5e6; ///< [Pa]
  double restitution = 0.9;
  double friction = 0.5;
  double poisson = 0.3;
};

/// Its properties, and neighbour lists with this skin [m].
inline std::string granular_material(const Material& material = {}, const std::string& skin = "0.001") {
  return "neighbor " + skin + " bin\nneigh_modify delay 0\nfix m1 all property/global youngsModulus peratomtype " +
         std::to_string(material.youngs) + "\nfix m2 all property/global poissonsRatio peratomtype " +
         std::to_string(material.poisson) + "\nfix m3 all property/global coefficientRestitution peratomtypepair 1 " +
         std::to_string(material.restitution) + "\nfix m4 all property/global coefficientFriction peratomtypepair 1 " +
         std::to_string(material.friction) + "\n";
}

/// Contacts of plain spheres by stock LIGGGHTS; `words`: further keywords.
inline std::string sphere_contacts(const std::string& words = "") {
  return "pair_style gran model hertz tangential history " + words + "\npair_coeff * *\n";
}

/// Contacts of clusters; `words`: further keywords.
inline std::string cluster_contacts(const std::string& words = "") {
  return "pair_style gran/cluster model hertz tangential history " + words + "\npair_coeff * *\n";
}

} // namespace eccentra::test
