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

const RegisterFix<FixFluidUniform> registered("fluid/uniform",
                                              "a prescribed flow for fix fluid/force, no solver needed");

/// A keyword, the place of its values among all, their number, and what each is without the keyword.
struct Word {
  const char* keyword;
  int first;
  int count;
  double otherwise;
};

/// The vorticity is the curl of velocity_gradient, which is a keyword of its own; every other quantity is one, too.
constexpr bool has_keyword(link::Quantity quantity) {
  return quantity != link::kVorticity && quantity != link::kVelocityGradient;
}

/// Those of the quantities follow those of velocity_gradient and origin.
constexpr int kGradientAt = 0, kOriginAt = 9, kQuantitiesAt = 12;

/// Place of a quantity's values.
constexpr int values_at(link::Quantity quantity) {
  int at = kQuantitiesAt;
  for (const link::FlowQuantity& before : link::kFlowQuantities)
    at += before.bit < quantity && has_keyword(before.bit) ? before.columns : 0;
  return at;
}

std::vector<Word> keywords() {
  std::vector<Word> words;
  for (const link::FlowQuantity& quantity : link::kFlowQuantities)
    if (has_keyword(quantity.bit))
      words.push_back({quantity.name, values_at(quantity.bit), quantity.columns, quantity.at_rest});
  words.push_back({"velocity_gradient", kGradientAt, 9, 0.0});
  words.push_back({"origin", kOriginAt, 3, 0.0});
  return words;
}

} // namespace

FixFluidUniform::FixFluidUniform(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  try {
    read(std::vector<std::string>(arg + 3, arg + narg));
  } catch (const std::invalid_argument& problem) {
    error->all(FLERR, ("fix fluid/uniform '" + std::string(id) + "': " + problem.what()).c_str());
  }
}

void FixFluidUniform::read(const std::vector<std::string>& arguments) {
  const std::vector<Word> words = keywords();
  for (const Word& word : words) {
    values_.resize(std::max<std::size_t>(values_.size(), word.first + word.count));
    for (int k = 0; k < word.count; ++k)
      values_[word.first + k].number = word.otherwise;
  }
  bool has_velocity = false;
  base::OptionReader reader(arguments);
  while (reader.more()) {
    const std::string& keyword = reader.keyword();
    const auto word =
        std::find_if(words.begin(), words.end(), [&](const Word& known) { return keyword == known.keyword; });
    if (word == words.end()) {
      std::string names;
      for (const Word& known : words)
        names += std::string(names.empty() ? "" : ", ") + known.keyword;
      reader.unknown(names);
    }
    has_velocity |= word->first == values_at(link::kVelocity);
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
  const Value& fraction = values_[values_at(link::kFraction)];
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
  const auto gradient = [this](int i, int r, int c) { return values_[kGradientAt + 3 * r + c].at(i); };
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit))
      continue;
    const Value* value = &values_[kQuantitiesAt];
    for (const link::FlowQuantity& quantity : link::kFlowQuantities) {
      if (!has_keyword(quantity.bit))
        continue;
      if (double* all = flow[quantity.bit])
        for (int k = 0; k < quantity.columns; ++k)
          all[quantity.columns * std::size_t(i) + k] = value[k].at(i);
      value += quantity.columns;
    }
    for (int r = 0; r < 3; ++r) {
      if (flow.velocity())
        for (int c = 0; c < 3; ++c)
          flow.velocity()[i][r] += gradient(i, r, c) * (atom->x[i][c] - values_[kOriginAt + c].at(i));
      if (flow.velocity_gradient())
        for (int c = 0; c < 3; ++c)
          flow.velocity_gradient()[i][3 * r + c] = gradient(i, r, c);
      if (flow.vorticity())
        flow.vorticity()[i][r] = gradient(i, (r + 2) % 3, (r + 1) % 3) - gradient(i, (r + 1) % 3, (r + 2) % 3);
    }
  }
}

} // namespace eccentra::styles
