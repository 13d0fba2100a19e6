// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Watches who looks for a fix property/global. Models and fixes ask Modify for them by name, and a definition of ours
// comes first (as in styles/entry/preload_hook.cpp).
#include "styles/bodies/unread_properties.h"

#include "styles/entry/private_access.h"

#include <mpi.h>

#include "comm.h"
#include "error.h"
#include "fix_property_global.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"

#include <dlfcn.h>

#include <algorithm>
#include <set>
#include <string>

namespace {

struct PropertyName {
  using type = char* LAMMPS_NS::FixPropertyGlobal::*;
};

struct PropertyCount {
  using type = int LAMMPS_NS::FixPropertyGlobal::*;
};

std::set<std::string>& names_looked_for() {
  static std::set<std::string> names;
  return names;
}

} // namespace

namespace eccentra::styles {
template struct PrivateMember<PropertyName, &LAMMPS_NS::FixPropertyGlobal::variablename>;
template struct PrivateMember<PropertyCount, &LAMMPS_NS::FixPropertyGlobal::nvalues>;
} // namespace eccentra::styles

namespace LAMMPS_NS {

Fix* Modify::find_fix_property(const char* name, const char* style, const char* values, int length, int other_length,
                               const char* caller, bool needed) {
  static const auto stock =
      reinterpret_cast<Fix* (*)(Modify*, const char*, const char*, const char*, int, int, const char*, bool)>(
          dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6Modify17find_fix_propertyEPKcS2_S2_iiS2_b"));
  names_looked_for().insert(name);
  return stock(this, name, style, values, length, other_length, caller, needed);
}

Fix* Modify::find_fix_property(const char* name, const char* style, const char* values, int length, int other_length,
                               const char* caller) {
  return find_fix_property(name, style, values, length, other_length, caller, true);
}

} // namespace LAMMPS_NS

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

/// Coefficients that are all 0 would not do anything either if they were read.
bool asks_for_nothing(FixPropertyGlobal& property) {
  const int count = property.*Published<PropertyCount>::pointer;
  const double* values = property.get_values();
  return values && std::all_of(values, values + count, [](double value) { return value == 0; });
}

} // namespace

void name_unread_properties(LAMMPS* lmp) {
  static std::set<std::string> named;
  // Where our definition does not come first nothing is known.
  if (names_looked_for().empty())
    return;
  for (int f = 0; f < lmp->modify->nfix; ++f) {
    auto* property = dynamic_cast<FixPropertyGlobal*>(lmp->modify->fix[f]);
    if (!property)
      continue;
    const std::string name = property->*Published<PropertyName>::pointer;
    if (names_looked_for().count(name) || asks_for_nothing(*property) || !named.insert(name).second)
      continue;
    if (lmp->comm->me == 0)
      lmp->error->warning(FLERR, ("fix " + std::string(property->id) + " property/global: '" + name +
                                  "' is read by no model of this script; expected a model in pair_style " +
                                  (lmp->force->pair_style ? lmp->force->pair_style : "") +
                                  ", in a wall or in a fix that uses it, or the line left out")
                                     .c_str());
  }
}

} // namespace eccentra::styles
