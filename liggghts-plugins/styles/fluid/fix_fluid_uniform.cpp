// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements fix fluid/uniform.
#include "styles/fluid/fix_fluid_uniform.h"

#include "base/option_reader.h"
#include "base/refusal.h"
#include "closures/fluid_options.h"
#include "styles/entry/style_registry.h"
#include "styles/fluid/fix_fluid_force.h"

#include <mpi.h>

#include "atom.h"
#include "error.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {
const RegisterFix<FixFluidUniform> kRecord("fluid/uniform", "a prescribed flow for fix fluid/force, no solver needed");
}

const FixFluidUniform::Word FixFluidUniform::kWords[] = {{"velocity", kVelocityAt, 3},
                                                         {"velocity_gradient", kGradientAt, 9},
                                                         {"pressure_gradient", kPressureAt, 3},
                                                         {"stress_divergence", kStressAt, 3},
                                                         {"origin", kOriginAt, 3},
                                                         {"fraction", kFractionAt, 1}};

FixFluidUniform::FixFluidUniform(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg), values_(kPlaces) {
  values_[kFractionAt].number = 1.0;
  try {
    read(std::vector<std::string>(arg + 3, arg + narg));
  } catch (const std::invalid_argument& problem) {
    error->all(FLERR, ("fix fluid/uniform '" + std::string(id) + "': " + problem.what()).c_str());
  }
}

void FixFluidUniform::read(const std::vector<std::string>& arguments) {
  bool has_velocity = false;
  base::OptionReader reader(arguments);
  while (reader.more()) {
    const std::string& keyword = reader.keyword();
    const Word* word =
        std::find_if(std::begin(kWords), std::end(kWords), [&](const Word& known) { return keyword == known.keyword; });
    if (word == std::end(kWords)) {
      std::string names;
      for (const Word& known : kWords)
        names += std::string(names.empty() ? "" : ", ") + known.keyword;
      reader.unknown(names);
    }
    has_velocity |= word->first == kVelocityAt;
    for (int k = 0; k < word->count; ++k) {
      Value& value = values_[word->first + k];
      const std::string expected = fmt::format("{} numbers or variables (v_name)", word->count);
      if (reader.more() && reader.peek().rfind("v_", 0) == 0) {
        value.variable = reader.value(expected).substr(2);
        variables_ = true;
      } else {
        value.number = reader.number(expected);
      }
    }
  }
  if (!has_velocity)
    base::refuse("keyword 'velocity' is missing; add velocity UX UY UZ");
  const Value& fraction = values_[kFractionAt];
  if (fraction.variable.empty() && !(fraction.number > 0.0 && fraction.number <= 1.0))
    base::refuse("keyword 'fraction': '{}' is no volume fraction of a fluid; expected a number greater than 0 and at "
                 "most 1",
                 fraction.number);
}

int FixFluidUniform::setmask() {
  return FixConst::PRE_FORCE;
}

void FixFluidUniform::init() {
  forces_ = FixFluidForce::find(lmp);
  if (!forces_)
    error->all(FLERR, ("fix fluid/uniform '" + std::string(id) +
                       "' prescribes a flow that nothing feels: add fix fluid/force before the run")
                          .c_str());
  forces_->announce_source(id);
  for (Value& value : values_) {
    if (value.variable.empty())
      continue;
    value.index = input->variable->find(const_cast<char*>(value.variable.c_str()));
    if (value.index < 0)
      error->all(FLERR, ("fix fluid/uniform '" + std::string(id) + "': there is no variable '" + value.variable +
                         "': define it before the run")
                            .c_str());
    value.per_atom = input->variable->atomstyle(value.index);
    if (!value.per_atom && !input->variable->equalstyle(value.index))
      error->all(FLERR, ("fix fluid/uniform '" + std::string(id) + "': variable '" + value.variable +
                         "' is neither of equal style nor of atom style")
                            .c_str());
  }
}

void FixFluidUniform::setup_pre_force(int) {
  fill();
}

void FixFluidUniform::pre_force(int) {
  fill();
}

void FixFluidUniform::evaluate() {
  modify->clearstep_compute();
  for (Value& value : values_) {
    if (value.variable.empty())
      continue;
    if (value.per_atom) {
      value.of_atom.resize(std::max(atom->nmax, 1));
      input->variable->compute_atom(value.index, igroup, value.of_atom.data(), 1, 0);
    } else {
      value.number = input->variable->compute_equal(value.index);
    }
  }
  modify->addstep_compute(update->ntimestep + 1);
}

void FixFluidUniform::fill() {
  if (variables_)
    evaluate();
  const link::FluidSamples flow = forces_->samples();
  double** x = atom->x;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit))
      continue;
    if (flow.velocity)
      for (int r = 0; r < 3; ++r) {
        double u = values_[kVelocityAt + r].at(i);
        for (int c = 0; c < 3; ++c)
          u += values_[kGradientAt + 3 * r + c].at(i) * (x[i][c] - values_[kOriginAt + c].at(i));
        flow.velocity[i][r] = u;
      }
    if (flow.fraction)
      flow.fraction[i] = values_[kFractionAt].at(i);
    for (int k = 0; k < 3; ++k) {
      const auto gradient = [&](int r, int c) { return values_[kGradientAt + 3 * r + c].at(i); };
      if (flow.pressure_gradient)
        flow.pressure_gradient[i][k] = values_[kPressureAt + k].at(i);
      if (flow.stress_divergence)
        flow.stress_divergence[i][k] = values_[kStressAt + k].at(i);
      if (flow.vorticity)
        flow.vorticity[i][k] = gradient((k + 2) % 3, (k + 1) % 3) - gradient((k + 1) % 3, (k + 2) % 3);
    }
  }
}

} // namespace eccentra::styles
