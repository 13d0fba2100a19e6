// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of `fix fluid/force` and builds its effects.
#include "closures/fluid_options.h"

#include "closures/body_forces.h"
#include "closures/drag_effect.h"
#include "closures/drag_laws.h"
#include "closures/lift_effects.h"
#include "closures/rotational_drag.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace eccentra::closures {

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

[[noreturn]] void fail(const std::string& text) {
  throw std::invalid_argument(text);
}

std::string shortest(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Reads arguments one after the other, with the keyword at hand for messages.
class ArgumentReader {
 public:
  explicit ArgumentReader(const std::vector<std::string>& arguments) : arguments_(arguments) {}
  bool more() const { return next_ < arguments_.size(); }
  const std::string& keyword() { return keyword_ = arguments_[next_++]; }
  const std::string& word(const char* expected) {
    if (!more())
      fail("keyword '" + keyword_ + "' is the last word: " + expected + " must follow");
    return arguments_[next_++];
  }
  double number(const char* name) {
    const std::string what = "keyword '" + keyword_ + "' (" + name + ")";
    return read_number(word(name), what);
  }
  int count(const char* name, int least) {
    const double value = number(name);
    if (value != std::floor(value) || value < least || value > std::numeric_limits<int>::max())
      fail("keyword '" + keyword_ + "' has " + shortest(value) + ": a whole number of at least " +
           std::to_string(least) + " is needed");
    return static_cast<int>(value);
  }
  bool on_off() {
    const std::string& value = word("on or off");
    if (value == "on")
      return true;
    if (value != "off" && value != "none")
      fail("keyword '" + keyword_ + "' has '" + value + "': write on or off");
    return false;
  }
  /// The name of the only closure of its kind, or none.
  bool choice(const std::string& name) {
    const std::string expected = name + " or none";
    const std::string& value = word(expected.c_str());
    if (value != name && value != "none")
      fail("keyword '" + keyword_ + "' has '" + value + "': write " + expected);
    return value == name;
  }
  bool at_number() const {
    if (!more())
      return false;
    char* end = nullptr;
    std::strtod(arguments_[next_].c_str(), &end);
    return end != arguments_[next_].c_str() && *end == '\0';
  }

 private:
  const std::vector<std::string>& arguments_;
  std::size_t next_ = 0;
  std::string keyword_;
};

double positive(double value, const std::string& what) {
  if (!(value > 0.0))
    fail(what + " is " + shortest(value) + ": it must be greater than 0");
  return value;
}

void read_rheology(ArgumentReader& reader, Rheology& fluid) {
  const std::string model = reader.word("herschel_bulkley TAU0 K N, power_law K N or newtonian MU");
  fluid.yield_stress = 0.0;
  fluid.index = 1.0;
  if (model == "herschel_bulkley") {
    fluid.yield_stress = reader.number("TAU0 K N");
    if (fluid.yield_stress < 0.0)
      fail("the yield stress TAU0 of 'rheology' is " + shortest(fluid.yield_stress) + " Pa: it must be 0 or more");
  } else if (model != "power_law" && model != "newtonian") {
    fail("'rheology' has '" + model + "': write herschel_bulkley TAU0 K N, power_law K N or newtonian MU");
  }
  if (model == "newtonian") {
    fluid.consistency = positive(reader.number("MU"), "the viscosity MU [Pa s] of 'rheology'");
    return;
  }
  fluid.consistency = positive(reader.number("K N"), "the consistency K [Pa s^n] of 'rheology'");
  fluid.index = positive(reader.number("N"), "the flow index N of 'rheology'");
}

void read_sphericity(ArgumentReader& reader, FluidOptions& options, int atom_types) {
  options.sphericity.clear();
  while (options.sphericity.empty() || reader.at_number()) {
    const double phi = reader.number("PHI, 0 < PHI <= 1");
    if (!(phi > 0.0 && phi <= 1.0))
      fail("'sphericity' has " + shortest(phi) + ": it must be greater than 0 and at most 1");
    options.sphericity.push_back(phi);
  }
  const std::size_t count = options.sphericity.size();
  if (count != 1 && count != std::size_t(atom_types))
    fail("'sphericity' has " + std::to_string(count) + " values: give one, or one for each of the " +
         std::to_string(atom_types) + " atom types");
}

const DragEntry* find_drag(const std::string& name) {
  for (const DragEntry& entry : kDragLaws)
    if (name == entry.name)
      return &entry;
  return nullptr;
}

} // namespace

double read_number(const std::string& word, const std::string& what) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (end == word.c_str() || *end != '\0' || !std::isfinite(value))
    fail(what + " has '" + word + "': a finite number is needed");
  return value;
}

std::string drag_law_names() {
  std::string names;
  for (const DragEntry& entry : kDragLaws)
    names += std::string(entry.name) + "|";
  return names + "none";
}

FluidOptions read_fluid_options(const std::vector<std::string>& arguments, int atom_types) {
  FluidOptions options;
  ArgumentReader reader(arguments);
  std::set<std::string> said;
  while (reader.more()) {
    const std::string keyword = reader.keyword();
    said.insert(keyword);
    if (keyword == "rheology") {
      read_rheology(reader, options.rheology);
    } else if (keyword == "density") {
      options.rheology.density = positive(reader.number("RHO"), "the fluid's 'density' [kg/m3]");
    } else if (keyword == "drag") {
      options.drag = reader.word(drag_law_names().c_str());
      if (options.drag != "none" && !find_drag(options.drag))
        fail("'drag' has '" + options.drag + "': write " + drag_law_names());
    } else if (keyword == "void_reynolds") {
      options.void_reynolds = reader.on_off();
    } else if (keyword == "shear_lift") {
      options.shear_lift = reader.choice("saffman_mei");
    } else if (keyword == "rotational_lift") {
      options.rotational_lift = reader.choice("oesterle_bui_dinh");
    } else if (keyword == "drag_torque") {
      options.drag_torque = reader.choice("dennis");
    } else if (keyword == "buoyancy") {
      options.buoyancy = reader.on_off();
    } else if (keyword == "pressure_gradient") {
      options.pressure_gradient = reader.on_off();
    } else if (keyword == "viscous_stress") {
      options.viscous_stress = reader.on_off();
    } else if (keyword == "screen") {
      options.screen.tolerance = positive(reader.number("TOLERANCE"), "the tolerance of 'screen'");
      if (options.screen.tolerance >= 1.0)
        fail("the tolerance of 'screen' is " + shortest(options.screen.tolerance) +
             ": it is a share of weight or drag, so it must be less than 1");
    } else if (keyword == "screen_steps") {
      options.screen.steps = reader.count("STEPS", 1);
    } else if (keyword == "screen_recheck") {
      options.screen.recheck = reader.count("STEPS", 0);
    } else if (keyword == "sphericity") {
      read_sphericity(reader, options, atom_types);
    } else {
      fail("unknown word '" + keyword +
           "': known are rheology, density, drag, void_reynolds, shear_lift, rotational_lift, drag_torque, "
           "pressure_gradient, viscous_stress, buoyancy, sphericity, screen, screen_steps, screen_recheck");
    }
  }
  if (options.rheology.consistency == 0.0)
    fail("the word 'rheology' is missing: add rheology herschel_bulkley TAU0 K N");
  if (options.rheology.density == 0.0)
    fail("the word 'density' is missing: add density RHO, the fluid's density in kg/m3");
  if (options.screen.tolerance == 0.0) {
    for (const char* word : {"screen_steps", "screen_recheck"})
      if (said.count(word))
        fail("'" + std::string(word) + "' says how to screen, but the word 'screen' is missing: add screen TOLERANCE");
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
