// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of contacts for pairs and a floor, and the scene in which they are tried.
#pragma once

#include "styles/pairs/all_materials.h"

namespace eccentra::test {

/// Models of pairs and walls alike, and keywords of theirs: walls have these after the wall.
struct Models {
  std::string names, keywords;
};

inline const std::vector<Models>& all_models() {
  static const std::vector<Models> models = [] {
    std::vector<Models> all = {{"model hertz tangential history contacts parallel", ""},
                               {"model hooke tangential history contacts parallel", ""},
                               {"model hooke tangential history", "limitForce on"},
                               {"model hertz tangential history rolling_friction shape", "form limited"},
                               {"model hertz tangential history rolling_friction shape", "form directional"},
                               {"model hertz tangential history rolling_friction shape", "form epsd"},
                               {"model hertz tangential history rolling_friction epsd rolling_radius body", ""},
                               {"model hooke tangential history rolling_friction cdt cohesion sjkr", ""}};
    for (const std::string& normal : known("model"))
      if (normal != "off")
        all.push_back({"model " + normal + " tangential history", ""});
    for (const std::string& tangential : known("tangential"))
      if (tangential != "history")
        all.push_back(
            {"model " + std::string(tangential == "tan_luding" ? "luding" : "hooke") + " tangential " + tangential,
             ""});
    for (const std::string& rolling : known("rolling_friction"))
      if (rolling != "off" && rolling != "eccentric" && rolling != "shape")
        all.push_back({"model " + std::string(rolling == "luding" ? "luding" : "hertz") +
                           " tangential history rolling_friction " + rolling,
                       ""});
    for (const std::string& cohesion : known("cohesion"))
      if (cohesion != "off")
        all.push_back({"model hertz tangential history cohesion " + cohesion, ""});
    return all;
  }();
  return models;
}

inline std::string name_of(const Models& models) {
  return models.names + " " + models.keywords;
}

constexpr double kFloor = -0.012;

/// Before a box or a restart file is read; two ranks have the two halves of the bed.
inline constexpr const char* head =
    "processors * 1 1\natom_style granular\natom_modify map array\nboundary f f f\nnewton off\n"
    "communicate single vel yes\nunits si\n";

/// Materials, forces and motion.
inline void open_world(LiggghtsSession& session, const Models& models, double dt) {
  Material material;
  material.restitution = 0.5;
  session.script(granular_material(material));
  // Stock's thornton_ning with adhesion takes roots of negative numbers where several contacts let go fast.
  const bool dry = models.names.find("thornton_ning") != std::string::npos;
  std::map<std::string, std::string> given = {{"surfaceEnergy", dry ? "0" : "0.1"}};
  if (models.names.find("hertz/stiffness") != std::string::npos) // kn is a modulus [Pa], and damping per contact radius
    given = {{"kn", "4e6"}, {"kt", "4e6"}, {"gamman", "3e6"}, {"gammat", "1e6"}};
  give_materials(session, given);
  session.script("pair_style gran/cluster " + models.names + " " + models.keywords +
                 "\npair_coeff * *\nfix gravity all gravity 9.81 vector 0 0 -1\nfix floor all wall/gran/cluster " +
                 models.names + " primitive type 1 zplane " + std::to_string(kFloor) + " " + models.keywords +
                 "\nfix integrate all nve/cluster\ntimestep " + std::to_string(1e6 * dt) + "e-6\n");
}

inline void open_empty(LiggghtsSession& session, const Models& models, double dt) {
  session.script(head);
  session.script("region box block -0.05 0.05 -0.05 0.05 -0.014 0.05 units box\ncreate_box 1 box\n");
  open_world(session, models, dt);
}

} // namespace eccentra::test
