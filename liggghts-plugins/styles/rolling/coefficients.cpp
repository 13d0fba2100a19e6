// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads coefficients per pair of atom types from fix property/global.
#include "styles/rolling/coefficients.h"

#include "error.h"
#include "fix_property_global.h"
#include "lammps.h"
#include "modify.h"

#include <cmath>
#include <string>

namespace eccentra::styles {
namespace {

MatrixProperty* create(PropertyRegistry& registry, const char* name, const char* caller) {
  LAMMPS_NS::LAMMPS& lmp = *registry.getLAMMPS();
  const int types = registry.max_type();
  if (!lmp.modify->find_fix_property(name, "property/global", "peratomtypepair", types, types, caller, false)) {
    const std::string n = std::to_string(types);
    const std::string text = std::string(caller) + " needs the property " + name +
                             ": add 'fix ID all property/global " + name + " peratomtypepair " + n + " ...' with " + n +
                             " x " + n + " values";
    lmp.error->all(FLERR, text.c_str());
  }
  const auto* fix = registry.getGlobalProperty(name, "property/global", "peratomtypepair", types, types, caller);
  auto* matrix = new MatrixProperty(types + 1, types + 1);
  for (int i = 1; i <= types; ++i) {
    for (int j = 1; j <= types; ++j) {
      const double value = const_cast<LAMMPS_NS::FixPropertyGlobal*>(fix)->compute_array(i - 1, j - 1);
      if (!(value >= 0.0) || !std::isfinite(value)) {
        const std::string text = std::string(caller) + ": " + name + " is " + std::to_string(value) + " for types " +
                                 std::to_string(i) + " and " + std::to_string(j) + ": give a finite number >= 0";
        lmp.error->all(FLERR, text.c_str());
      }
      matrix->data[i][j] = value;
    }
  }
  return matrix;
}

} // namespace

MatrixProperty* create_rolling_coefficient(PropertyRegistry& registry, const char* caller, bool) {
  return create(registry, "coefficientRollingFriction", caller);
}

MatrixProperty* create_shape_coefficient(PropertyRegistry& registry, const char* caller, bool) {
  return create(registry, "shapeRollingFriction", caller);
}

} // namespace eccentra::styles
