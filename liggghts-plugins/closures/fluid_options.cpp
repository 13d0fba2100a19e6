// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of `fix fluid/force` and builds its effects.
#include "closures/fluid_options.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "closures/body_forces.h"
#include "closures/drag_effect.h"
#include "closures/drag_laws.h"
#include "closures/lift_effects.h"
#include "closures/rotational_drag.h"

#include <set>

namespace eccentra::closures {

using base::OptionReader;
using base::refuse;

namespace {

using DragMaker = std::unique_ptr<Effect> (*)(const char*, const Rheology&);

template <class Law> std::unique_ptr<Effect> make_drag(const char* name, const Rheology& fluid) {
  if (fluid.newtonian())
    return std::make_unique<DragEffect<NewtonianStress, Law>>(name, fluid);
  return std::make_unique<DragEffect<HerschelBulkleyStress, Law>>(name, fluid);
}

struct DragEntry {
  const char* name;
  DragMaker make;
  DragMaker make_void_reynolds; ///< with alpha Re in place of Re
};

/// Every drag law that a script can name. wen_yu, gidaspow and di_felice define their own use of the fraction.
constexpr DragEntry kDragLaws[] = {
    {"chien", &make_drag<Suspended<Chien>>, &make_drag<Suspended<Chien, true>>},
    {"schiller_naumann", &make_drag<Suspended<SchillerNaumann>>, &make_drag<Suspended<SchillerNaumann, true>>},
    {"haider_levenspiel", &make_drag<Suspended<HaiderLevenspiel>>, &make_drag<Suspended<HaiderLevenspiel, true>>},
    {"ganser", &make_drag<Suspended<Ganser>>, &make_drag<Suspended<Ganser, true>>},
    {"holzer_sommerfeld", &make_drag<Suspended<HoelzerSommerfeld>>, &make_drag<Suspended<HoelzerSommerfeld, true>>},
    {"wen_yu", &make_drag<Suspended<SchillerNaumann, true>>, &make_drag<Suspended<SchillerNaumann, true>>},
    {"gidaspow", &make_drag<Gidaspow>, &make_drag<Gidaspow>},
    {"di_felice", &make_drag<DiFelice>, &make_drag<DiFelice>},
};

/// The drag that a screen weighs where the script names none: the paper's.
constexpr const char* kScreenedDrag = "chien";

void read_rheology(OptionReader& reader, Rheology& fluid) {
  const std::string model = reader.choice({"herschel_bulkley", "power_law", "newtonian"});
  fluid.yield_stress = model == "herschel_bulkley" ? reader.at_least(0, "the yield stress TAU0 [Pa]") : 0.;
  fluid.index = 1.0;
  if (model == "newtonian") {
    fluid.consistency = reader.positive("the viscosity MU [Pa s]");
    return;
  }
  fluid.consistency = reader.positive("the consistency K [Pa s^n]");
  fluid.index = reader.positive("the flow index N");
}

void read_sphericity(OptionReader& reader, FluidOptions& options, int atom_types) {
  options.sphericity.clear();
  while (options.sphericity.empty() || reader.at_number()) {
    const double phi = reader.positive("the sphericity PHI");
    if (phi > 1.0)
      refuse("keyword 'sphericity': '{}' is greater than 1; expected a number greater than 0 and at most 1", phi);
    options.sphericity.push_back(phi);
  }
  const std::size_t count = options.sphericity.size();
  if (count != 1 && count != std::size_t(atom_types))
    refuse("keyword 'sphericity' has {} values; expected one, or one for each of the {} atom types", count, atom_types);
}

const DragEntry* find_drag(const std::string& name) {
  for (const DragEntry& entry : kDragLaws)
    if (name == entry.name)
      return &entry;
  return nullptr;
}

} // namespace

std::string drag_law_names() {
  std::string names;
  for (const DragEntry& entry : kDragLaws)
    names += std::string(entry.name) + "|";
  return names + "none";
}

FluidOptions read_fluid_options(const std::vector<std::string>& arguments, int atom_types) {
  FluidOptions options;
  OptionReader reader(arguments);
  std::set<std::string> said;
  while (reader.more()) {
    const std::string keyword = reader.keyword();
    said.insert(keyword);
    if (keyword == "rheology") {
      read_rheology(reader, options.rheology);
    } else if (keyword == "density") {
      options.rheology.density = reader.positive("the fluid's density RHO [kg/m3]");
    } else if (keyword == "drag") {
      options.drag = reader.value(drag_law_names());
      if (options.drag != "none" && !find_drag(options.drag))
        refuse("keyword 'drag': '{}' is unknown; expected {}", options.drag, drag_law_names());
    } else if (keyword == "void_reynolds") {
      options.void_reynolds = reader.on_off();
    } else if (keyword == "shear_lift") {
      options.shear_lift = reader.choice({"saffman_mei", "none"}) != "none";
    } else if (keyword == "rotational_lift") {
      options.rotational_lift = reader.choice({"oesterle_bui_dinh", "none"}) != "none";
    } else if (keyword == "drag_torque") {
      options.drag_torque = reader.choice({"dennis", "none"}) != "none";
    } else if (keyword == "buoyancy") {
      options.buoyancy = reader.on_off();
    } else if (keyword == "pressure_gradient") {
      options.pressure_gradient = reader.on_off();
    } else if (keyword == "viscous_stress") {
      options.viscous_stress = reader.on_off();
    } else if (keyword == "screen") {
      options.screen.tolerance = reader.between(0, 1, "the tolerance, a share of weight or drag");
    } else if (keyword == "screen_steps") {
      options.screen.steps = reader.count(1, "steps");
    } else if (keyword == "screen_recheck") {
      options.screen.recheck = reader.count(0, "steps");
    } else if (keyword == "sphericity") {
      read_sphericity(reader, options, atom_types);
    } else {
      reader.unknown("rheology, density, drag, void_reynolds, shear_lift, rotational_lift, drag_torque, "
                     "pressure_gradient, viscous_stress, buoyancy, sphericity, screen, screen_steps, screen_recheck");
    }
  }
  if (options.rheology.consistency == 0.0)
    refuse("keyword 'rheology' is missing; add rheology herschel_bulkley TAU0 K N");
  if (options.rheology.density == 0.0)
    refuse("keyword 'density' is missing; add density RHO, the fluid's density in kg/m3");
  if (options.screen.tolerance == 0.0) {
    for (const char* word : {"screen_steps", "screen_recheck"})
      if (said.count(word))
        refuse("keyword '{}' says how to screen, but 'screen' is missing; add screen TOLERANCE", word);
    return options;
  }
  // A screen judges every effect that the script has not itself decided on.
  if (!said.count("drag"))
    options.drag = kScreenedDrag;
  const std::pair<const char*, bool*> optional[] = {{"shear_lift", &options.shear_lift},
                                                    {"rotational_lift", &options.rotational_lift},
                                                    {"drag_torque", &options.drag_torque},
                                                    {"pressure_gradient", &options.pressure_gradient},
                                                    {"viscous_stress", &options.viscous_stress}};
  for (const auto& [word, on] : optional)
    if (!said.count(word))
      *on = true;
  return options;
}

EffectList make_effects(const FluidOptions& options) {
  const Rheology& fluid = options.rheology;
  EffectList effects;
  if (options.buoyancy)
    effects.push_back(std::make_unique<BodyForce<BuoyancyField>>(fluid));
  if (options.pressure_gradient)
    effects.push_back(std::make_unique<BodyForce<PressureField>>(fluid));
  if (options.viscous_stress)
    effects.push_back(std::make_unique<BodyForce<StressField>>(fluid));
  if (options.shear_lift)
    effects.push_back(std::make_unique<ShearLift>(fluid));
  if (options.rotational_lift)
    effects.push_back(std::make_unique<RotationalLift>(fluid));
  if (const DragEntry* entry = find_drag(options.drag))
    effects.push_back((options.void_reynolds ? entry->make_void_reynolds : entry->make)(entry->name, fluid));
  if (options.drag_torque && fluid.newtonian())
    effects.push_back(std::make_unique<RotationalDrag<NewtonianStress>>(fluid));
  else if (options.drag_torque)
    effects.push_back(std::make_unique<RotationalDrag<HerschelBulkleyStress>>(fluid));
  return effects;
}

} // namespace eccentra::closures
