// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One row per drag law.
#include "closures/drag_table.h"

#include "closures/drag_effect.h"
#include "closures/oriented_drag.h"

namespace eccentra::closures {

namespace {

template <class Law> std::unique_ptr<Effect> make_drag(const char* name, const Rheology& fluid) {
  return with_stress(fluid, [&](auto stress) -> std::unique_ptr<Effect> {
    return std::make_unique<DragEffect<decltype(stress), Law>>(name, fluid);
  });
}
template <class Law> std::unique_ptr<Effect> make_oriented(const char* name, const Rheology& fluid) {
  return with_stress(fluid, [&](auto stress) -> std::unique_ptr<Effect> {
    return std::make_unique<OrientedDrag<decltype(stress), Law>>(name, fluid);
  });
}

template <class Law>
ValueAndSlope reduced(const ShapeFactors& shape, const DragPlace& place, const Rheology& fluid, double re) {
  return make_law<Law>(shape, fluid).in(place)(re);
}

template <class Law>
double force(const ShapeFactors& shape, const DragPlace& place, const Rheology& fluid, double d, double speed) {
  const auto law = make_law<Law>(shape, fluid).in(place);
  return with_stress(fluid, [&](auto stress) {
    return drag_resistance<Law>(stress, law, d, fluid.density, place.fraction)(speed).value;
  });
}

/// A law that defines its own use of the fraction.
template <class Law> constexpr DragLaw row(const char* name, double yield_weight = kAnsleySmith) {
  return {name,          &make_drag<Law>, &make_drag<Law>, &make_oriented<Law>, &make_oriented<Law>,
          &reduced<Law>, &force<Law>,     yield_weight};
}
/// A law of packed beds, in which K of a single particle has no place.
template <class Law> constexpr DragLaw bed(const char* name) {
  DragLaw made = row<Law>(name);
  made.make_oriented = made.make_oriented_void_reynolds = nullptr;
  return made;
}
/// A single-particle law: alpha^-1.65 C_D(Re), or C_D(alpha Re).
template <class Single> constexpr DragLaw suspended(const char* name) {
  DragLaw made = row<Suspended<Single>>(name);
  made.make_void_reynolds = &make_drag<Suspended<Single, true>>;
  made.make_oriented_void_reynolds = &make_oriented<Suspended<Single, true>>;
  return made;
}

constexpr DragLaw kDragLaws[] = {
    suspended<Chien>("chien"),
    suspended<SchillerNaumann>("schiller_naumann"),
    suspended<HaiderLevenspiel>("haider_levenspiel"),
    suspended<Ganser>("ganser"),
    suspended<HoelzerSommerfeld>("holzer_sommerfeld"),
    row<Suspended<SchillerNaumann, true>>("wen_yu"),
    bed<Gidaspow>("gidaspow"),
    row<DiFelice>("di_felice"),
    row<Qkqy>("qkqy", Qkqy::kOwnYieldWeight),
};

} // namespace

const DragLaw* find_drag_law(const std::string& name) {
  for (const DragLaw& law : kDragLaws)
    if (name == law.name)
      return &law;
  return nullptr;
}

std::string drag_law_names() {
  std::string names;
  for (const DragLaw& law : kDragLaws)
    names += (names.empty() ? "" : "|") + std::string(law.name);
  return names;
}

double beris_yield_weight(const DragLaw& law, const Rheology& fluid) {
  constexpr double weight_over_force = 4.0 / 3.0; // V (rho_p - rho_f) g over (pi/8) d^2 (rho_p - rho_f) g d
  return weight_over_force / (kBerisYield * law.reduced(ShapeFactors{}, DragPlace{}, fluid, 0.0).value);
}

double cross_yield_weight(const DragLaw& law, const Rheology& fluid) {
  constexpr double stokes = 24.0;
  return cross_coefficient(fluid.index) * stokes / law.reduced(ShapeFactors{}, DragPlace{}, fluid, 0.0).value;
}

} // namespace eccentra::closures
