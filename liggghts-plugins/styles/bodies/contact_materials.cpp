// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Names of properties of contact models, and who makes them of the script's fixes property/global.
#include "styles/bodies/contact_materials.h"

#include <mpi.h>

#include "force.h"
#include "global_properties.h"
#include "lammps.h"
#include "property_registry.h"

#include <map>
#include <string>

namespace eccentra::styles {

namespace {

const std::map<std::string, MatrixPropertyCreator>& creators() {
  static const std::map<std::string, MatrixPropertyCreator> known = {
      {"Yeff", &MODEL_PARAMS::createYeff},       {"Geff", &MODEL_PARAMS::createGeff},
      {"betaeff", &MODEL_PARAMS::createBetaEff}, {"coeffFrict", &MODEL_PARAMS::createCoeffFrict},
      {"k_n", &MODEL_PARAMS::createKn},          {"k_t", &MODEL_PARAMS::createKt},
      {"gamma_n", &MODEL_PARAMS::createGamman},  {"gamma_t", &MODEL_PARAMS::createGammat},
  };
  return known;
}

double** matrix(LAMMPS_NS::LAMMPS* lmp, const char* name, const char* caller) {
  PropertyRegistry& registry = lmp->force->registry;
  registry.registerProperty(name, creators().at(name), caller);
  double** values = nullptr;
  registry.connect(name, values, caller);
  return values;
}

} // namespace

void ContactMaterials::connect(LAMMPS_NS::LAMMPS* lmp, const contact::ContactModel& model, bool friction,
                               const char* caller) {
  matrices_.clear();
  for (const char* name : model.properties)
    matrices_.push_back(matrix(lmp, name, caller));
  friction_ = friction ? matrix(lmp, "coeffFrict", caller) : nullptr;
}

} // namespace eccentra::styles
