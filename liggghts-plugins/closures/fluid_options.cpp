// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of `fix fluid/force` and builds its effects.
#include "closures/fluid_options.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "closures/body_forces.h"
#include "closures/drag_table.h"
#include "closures/lift_effects.h"
#include "closures/oriented_torques.h"
#include "closures/rotational_drag.h"

#include <set>
#include <tuple>

namespace eccentra::closures {

using base::OptionReader;
using base::refuse;

namespace {

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

/// What is said of the stress scale X around a particle, once the drag law and the rheology are known.
void weigh_stress(FluidOptions& options, const std::set<std::string>& said) {
  Rheology& fluid = options.rheology;
  const DragLaw* law = find_drag_law(options.drag);
  for (const char* word : {"power_law_factor", "yield_weight", "yield_form"})
    if (!law && said.count(word))
      refuse("keyword '{}' weighs the stress scale of a drag law, but there is none; add drag NAME", word);
  if (options.power_law_factor) {
    if (options.drag == "qkqy")
      refuse("keyword 'power_law_factor': 'renaud' is not for drag qkqy, whose coefficients depend on N already; "
             "expected none, or another drag law");
    fluid.viscous_weight = power_law_factor(fluid.index);
  }
  if (law)
    fluid.yield_weight = options.beris_yield ? beris_yield_weight(*law, fluid) : law->own_yield_weight;
  if (law && options.cross_yield)
    fluid.cross_weight = cross_yield_weight(*law, fluid);
}

void check_orientation(const FluidOptions& options) {
  const DragLaw* law = find_drag_law(options.drag);
  if (options.oriented && !law && !options.drag_torque)
    refuse(
        "keyword 'oriented': 'on' has no force to give a shape to, for there is neither drag nor drag_torque; add drag "
        "NAME, or drag_torque dennis");
  if (options.oriented && law && !law->make_oriented)
    refuse(
        "keyword 'oriented': 'on' is not for drag {}, which was measured on packed beds and knows no single particle; "
        "expected oriented off, or another drag law",
        options.drag);
  for (const auto& [word, value, on] : {std::tuple{"strain_torque", "jeffery", options.strain_torque},
                                        std::tuple{"pitching_torque", "dabade", options.pitching_torque}}) {
    if (on && !options.oriented)
      refuse("keyword '{}': '{}' is a torque on the real shape, but 'oriented' is off; add oriented on", word, value);
    if (on && !options.drag_torque)
      refuse("keyword '{}': '{}' drives a spin that nothing resists; add drag_torque dennis", word, value);
  }
}

void check_dispersion(const FluidOptions& options, const std::set<std::string>& said) {
  if (options.turbulent_dispersion && options.drag == "none")
    refuse("keyword 'turbulent_dispersion': 'eddy_interaction' moves particles through their drag, but there is none; "
           "add drag NAME");
  if (said.count("dispersion_seed") && !options.turbulent_dispersion)
    refuse(
        "keyword 'dispersion_seed' is for a random walk, but 'turbulent_dispersion' is none; add turbulent_dispersion "
        "eddy_interaction");
}

template <template <class> class Torque> std::unique_ptr<Effect> make_torque(const Rheology& fluid) {
  return with_stress(
      fluid, [&](auto stress) -> std::unique_ptr<Effect> { return std::make_unique<Torque<decltype(stress)>>(fluid); });
}

} // namespace

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
      options.drag = reader.value(drag_law_names() + "|none");
      if (options.drag != "none" && !find_drag_law(options.drag))
        refuse("keyword 'drag': '{}' is unknown; expected {}|none", options.drag, drag_law_names());
    } else if (keyword == "void_reynolds") {
      options.void_reynolds = reader.on_off();
    } else if (keyword == "power_law_factor") {
      options.power_law_factor = reader.choice({"renaud", "none"}) != "none";
    } else if (keyword == "yield_weight") {
      options.beris_yield = reader.choice({"beris", "own"}) == "beris";
    } else if (keyword == "yield_form") {
      options.cross_yield = reader.choice({"additive", "cross"}) == "cross";
    } else if (keyword == "shear_lift") {
      options.shear_lift = reader.choice({"saffman_mei", "none"}) != "none";
    } else if (keyword == "rotational_lift") {
      options.rotational_lift = reader.choice({"oesterle_bui_dinh", "none"}) != "none";
    } else if (keyword == "drag_torque") {
      options.drag_torque = reader.choice({"dennis", "none"}) != "none";
    } else if (keyword == "oriented") {
      options.oriented = reader.on_off();
    } else if (keyword == "strain_torque") {
      options.strain_torque = reader.choice({"jeffery", "none"}) != "none";
    } else if (keyword == "pitching_torque") {
      options.pitching_torque = reader.choice({"dabade", "none"}) != "none";
    } else if (keyword == "buoyancy") {
      options.buoyancy = reader.on_off();
    } else if (keyword == "pressure_gradient") {
      options.pressure_gradient = reader.on_off();
    } else if (keyword == "viscous_stress") {
      options.viscous_stress = reader.on_off();
    } else if (keyword == "turbulent_dispersion") {
      options.turbulent_dispersion = reader.choice({"eddy_interaction", "none"}) != "none";
    } else if (keyword == "dispersion_seed") {
      options.dispersion_seed = reader.count(1, "a seed of the random walk");
    } else if (keyword == "screen") {
      options.screen.tolerance = reader.between(0, 1, "the tolerance, a share of weight or drag");
    } else if (keyword == "screen_steps") {
      options.screen.steps = reader.count(1, "steps");
    } else if (keyword == "screen_recheck") {
      options.screen.recheck = reader.count(0, "steps");
    } else if (keyword == "sphericity") {
      read_sphericity(reader, options, atom_types);
    } else {
      reader.unknown(
          "rheology, density, drag, void_reynolds, power_law_factor, yield_weight, yield_form, shear_lift, "
          "rotational_lift, drag_torque, oriented, strain_torque, pitching_torque, pressure_gradient, "
          "viscous_stress, buoyancy, turbulent_dispersion, dispersion_seed, sphericity, screen, screen_steps, "
          "screen_recheck");
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
    weigh_stress(options, said);
    check_orientation(options);
    check_dispersion(options, said);
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
  // Of the real shape only where the script wants it.
  if (options.oriented) {
    options.strain_torque = options.strain_torque || (!said.count("strain_torque") && options.drag_torque);
    options.pitching_torque = options.pitching_torque || (!said.count("pitching_torque") && options.drag_torque);
  }
  check_orientation(options);
  check_dispersion(options, said);
  weigh_stress(options, said);
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
  if (const DragLaw* law = find_drag_law(options.drag))
    effects.push_back(
        options.oriented
            ? (options.void_reynolds ? law->make_oriented_void_reynolds : law->make_oriented)(law->name, fluid)
            : (options.void_reynolds ? law->make_void_reynolds : law->make)(law->name, fluid));
  if (options.pitching_torque)
    effects.push_back(std::make_unique<PitchingTorque>(fluid));
  if (options.strain_torque)
    effects.push_back(make_torque<StrainTorque>(fluid));
  if (options.drag_torque)
    effects.push_back(options.oriented ? make_torque<OrientedRotationalDrag>(fluid)
                                       : make_torque<RotationalDrag>(fluid));
  return effects;
}

} // namespace eccentra::closures
