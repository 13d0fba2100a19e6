// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The models that LIGGGHTS has, and a material that any of them can read.
#pragma once

#include "styles/bodies/bodies_scene.h"
#include "styles/models/stock_contact.h"

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::test {

/// What models read of pairs of types, beside restitution and sliding friction.
inline const std::vector<std::pair<const char*, const char*>>& values_per_pair() {
  static const std::vector<std::pair<const char*, const char*>> all = {{"coefficientRollingFriction", "0.1"},
                                                                       {"shapeRollingFriction", "0.05"},
                                                                       {"coefficientRollingViscousDamping", "0.3"},
                                                                       {"coeffRollingStiffness", "0.2"},
                                                                       {"coeffFrictionStiffness", "0.3"},
                                                                       {"FluidViscosity", "1e-3"},
                                                                       {"FrictionViscosity", "1e-3"},
                                                                       {"kn", "1e5"},
                                                                       {"kt", "5e4"},
                                                                       {"gamman", "500"},
                                                                       {"gammat", "200"},
                                                                       {"gamman_abs", "0.05"},
                                                                       {"gammat_abs", "0.02"},
                                                                       {"cohesionEnergyDensity", "2e3"},
                                                                       {"coefficientMaxElasticStiffness", "2"},
                                                                       {"coefficientAdhesionStiffness", "0.2"},
                                                                       {"coefficientPlasticityDepth", "0.1"},
                                                                       {"UnloadingStiffness", "2"},
                                                                       {"LoadingStiffness", "1e4"},
                                                                       {"pullOffForce", "-1e-4"},
                                                                       {"surfaceEnergy", "0.1"}};
  return all;
}

/// What models read of types, and of the whole scene. `other`: values in place of those below.
inline void give_other_materials(LiggghtsSession& session, int types = 1,
                                 const std::map<std::string, std::string>& other = {}) {
  const char* scalars[][2] = {
      {"characteristicVelocity", "0.5"},     {"rollingStiffness", "2"},  {"surfaceLiquidContentInitial", "0.1"},
      {"surfaceTension", "0.072"},           {"fluidViscosity", "1e-3"}, {"minSeparationDistanceRatio", "0.01"},
      {"maxSeparationDistanceRatio", "1.1"}, {"overlapExponent", "1.5"}, {"adhesionExponent", "1.5"}};
  const char* per_type[][2] = {{"contactAngle", "0.3"}, {"coefficientYieldRatio", "0.3"}};
  for (const auto& [name, value] : scalars) {
    const auto found = other.find(name);
    session.command(std::string("fix s_") + name + " all property/global " + name + " scalar " +
                    (found == other.end() ? value : found->second));
  }
  for (const auto& [name, value] : per_type) {
    std::string line = std::string("fix t_") + name + " all property/global " + name + " peratomtype";
    for (int n = 0; n < types; ++n)
      line += std::string(" ") + value;
    session.command(line);
  }
}

/// What any of the models reads, in a scene of one type; `other`: values in place of those above.
inline void give_materials(LiggghtsSession& session, const std::map<std::string, std::string>& other = {}) {
  give_other_materials(session, 1, other);
  for (const auto& [name, value] : values_per_pair()) {
    const auto found = other.find(name);
    session.command(std::string("fix p_") + name + " all property/global " + name + " peratomtypepair 1 " +
                    (found == other.end() ? value : found->second));
  }
}

/// Names of the models of a kind (model, tangential, rolling_friction, cohesion).
inline std::vector<std::string> known(const std::string& kind) {
  std::istringstream in(styles::StockContact::known(kind));
  std::vector<std::string> names;
  for (std::string name; std::getline(in >> std::ws, name, ',');)
    names.push_back(name);
  return names;
}

} // namespace eccentra::test
