// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of LIGGGHTS's models, made from its own lists.
#include "styles/models/stock_models.h"

#include "base/refusal.h"

#include "force.h"
#include "global_properties.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "settings.h"

#include <functional>
#include <map>
#include <type_traits>

namespace eccentra::styles {

namespace {

using LAMMPS_NS::LAMMPS;

template <class Base, class Model> void over_contacts(Base& base, BegunContact* contacts, int n) {
  auto& model = static_cast<Model&>(base);
  for (BegunContact* at = contacts; at != contacts + n; ++at) {
    if (!at->touches)
      continue;
    if constexpr (std::is_same_v<Base, stock::TangentialModelBase>)
      model.Model::surfacesIntersect(at->data, at->friction_a, at->friction_b);
    else
      model.Model::surfacesIntersect(at->data, at->on_a, at->on_b);
  }
}

template <class Base>
using Creators = std::map<std::string, std::function<StockModel<Base>(LAMMPS*, StockHistory*, StockSurroundings*)>>;

template <class Base, class Model>
StockModel<Base> make(LAMMPS* lmp, StockHistory* history, StockSurroundings* around) {
  return {std::make_unique<Model>(lmp, history, around), &over_contacts<Base, Model>};
}

// LIGGGHTS lists its models by macros in their headers.
const Creators<stock::NormalModelBase>& normal_models() {
  static const Creators<stock::NormalModelBase> all = {
      {"off", make<stock::NormalModelBase, stock::NormalModel<stock::NORMAL_OFF>>},
#define NORMAL_MODEL(identifier, name, constant)                                                                       \
  {#name, make<stock::NormalModelBase, stock::NormalModel<stock::identifier>>},
#include "style_normal_model.h"
#undef NORMAL_MODEL
  };
  return all;
}

const Creators<stock::TangentialModelBase>& tangential_models() {
  static const Creators<stock::TangentialModelBase> all = {
      {"off", make<stock::TangentialModelBase, stock::TangentialModel<stock::TANGENTIAL_OFF>>},
#define TANGENTIAL_MODEL(identifier, name, constant)                                                                   \
  {#name, make<stock::TangentialModelBase, stock::TangentialModel<stock::identifier>>},
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
  };
  return all;
}

const Creators<stock::CohesionModelBase>& cohesion_models() {
  static const Creators<stock::CohesionModelBase> all = {
      {"off", make<stock::CohesionModelBase, stock::CohesionModel<stock::COHESION_OFF>>},
#define COHESION_MODEL(identifier, name, constant)                                                                     \
  {#name, make<stock::CohesionModelBase, stock::CohesionModel<stock::identifier>>},
#include "style_cohesion_model.h"
#undef COHESION_MODEL
  };
  return all;
}

const Creators<stock::RollingModelBase>& rolling_models() {
  static const Creators<stock::RollingModelBase> all = {
      {"off", make<stock::RollingModelBase, stock::RollingModel<stock::ROLLING_OFF>>},
#define ROLLING_MODEL(identifier, name, constant)                                                                      \
  {#name, make<stock::RollingModelBase, stock::RollingModel<stock::identifier>>},
#include "style_rolling_model.h"
#undef ROLLING_MODEL
  };
  return all;
}

template <class Visit> auto with_kind(const std::string& kind, Visit visit) {
  if (kind == "model")
    return visit(normal_models());
  if (kind == "tangential")
    return visit(tangential_models());
  if (kind == "cohesion")
    return visit(cohesion_models());
  return visit(rolling_models());
}

template <class Map>
auto created(const Map& models, const char* kind, const std::string& name, LAMMPS* lmp, StockHistory* history,
             StockSurroundings* around) {
  const auto found = models.find(name);
  if (found == models.end())
    base::refuse(
        "{} '{}' is not one of LIGGGHTS's; expected it with tangential history or off, without rolling friction "
        "and cohesion, or one of {}",
        kind, name, listed(stock_names(kind)));
  return found->second(lmp, history, around);
}

} // namespace

std::set<std::string> stock_names(const std::string& kind) {
  return with_kind(kind, [](const auto& models) {
    std::set<std::string> names;
    for (const auto& entry : models)
      names.insert(entry.first);
    return names;
  });
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

StockModel<stock::NormalModelBase> stock_normal(const std::string& name, LAMMPS* lmp, StockHistory* history,
                                                StockSurroundings* around) {
  return created(normal_models(), "model", name, lmp, history, around);
}

StockModel<stock::CohesionModelBase> stock_cohesion(const std::string& name, LAMMPS* lmp, StockHistory* history,
                                                    StockSurroundings* around) {
  return created(cohesion_models(), "cohesion", name, lmp, history, around);
}

StockModel<stock::TangentialModelBase> stock_tangential(const std::string& name, LAMMPS* lmp, StockHistory* history,
                                                        StockSurroundings* around) {
  return created(tangential_models(), "tangential", name, lmp, history, around);
}

StockModel<stock::RollingModelBase> stock_rolling(const std::string& name, LAMMPS* lmp, StockHistory* history,
                                                  StockSurroundings* around) {
  return created(rolling_models(), "rolling_friction", name, lmp, history, around);
}

} // namespace eccentra::styles
