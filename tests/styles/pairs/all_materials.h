// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The models that LIGGGHTS has, and a material that any of them can read.
#pragma once

#include "styles/bodies/bodies_scene.h"
#include "styles/models/stock_contact.h"

#include <sstream>
#include <string>
#include <vector>

namespace eccentra::test {

/// What any of the models reads.
inline void give_materials(LiggghtsSession& session) {
  const char* scalars[][2] = {
      {"characteristicVelocity", "0.5"},     {"rollingStiffness", "2"},  {"surfaceLiquidContentInitial", "0.1"},
      {"surfaceTension", "0.072"},           {"fluidViscosity", "1e-3"}, {"minSeparationDistanceRatio", "0.01"},
      {"maxSeparationDistanceRatio", "1.1"}, {"overlapExponent", "1.5"}, {"adhesionExponent", "1.5"}};
  const char* per_type[][2] = {{"contactAngle", "0.3"}, {"coefficientYieldRatio", "0.3"}};
  const char* per_pair[][2] = {{"coefficientRollingFriction", "0.1"},
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
                               {"cohesionEnergyDensity", "2e3"},
                               {"coefficientMaxElasticStiffness", "2"},
                               {"coefficientAdhesionStiffness", "0.2"},
                               {"coefficientPlasticityDepth", "0.1"},
                               {"UnloadingStiffness", "2"},
                               {"LoadingStiffness", "1e4"},
                               {"pullOffForce", "-1e-4"},
                               {"surfaceEnergy", "0.1"}};
  int number = 0;
  const auto give = [&](const char* name, const char* kind, const char* value) {
    session.command("fix p" + std::to_string(number++) + " all property/global " + name + " " + kind + " " + value);
  };
  for (const auto& [name, value] : scalars)
    give(name, "scalar", value);
  for (const auto& [name, value] : per_type)
    give(name, "peratomtype", value);
  for (const auto& [name, value] : per_pair)
    give(name, "peratomtypepair 1", value);
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
