// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keywords of stock's contact models and walls that mean nothing to ours: refused, or taken where they ask for nothing.
#pragma once

#include "base/option_reader.h"
#include "base/refusal.h"

#include <map>
#include <string>

namespace eccentra::contact {

/// What becomes of one keyword of stock's pair gran or wall/gran.
struct StockContactKeyword {
  const char* nothing; ///< as stock writes the value that asks for nothing and is taken; null: none
  const char* remedy;  ///< for any other value
};

/// By the keyword. Those that ours obey are not here.
inline const std::map<std::string, StockContactKeyword>& stock_contact_keywords() {
  static const std::map<std::string, StockContactKeyword> arguments = {
      {"heating_normal_hertz", {"off", "contacts of clusters do not heat"}},
      {"heating_tangential_history", {"off", "contacts of clusters do not heat"}},
      {"heating_tracking", {"off", "contacts of clusters do not heat"}},
      {"computeElasticPotential", {"off", "energies of contacts are not summed"}},
      {"computeDissipatedEnergy", {"off", "energies of contacts are not summed"}},
      {"disableNormalWhenBonded", {"off", "there are no bonds"}},
      {"track_energy", {"no", "energies of contacts are not summed"}},
      {"store_force", {"no", "f_ID[1..3] is the force on the wall"}},
      {"store_force_contact", {"no", "compute contact/cluster/local lists the contacts"}},
      {"store_force_contact_stress", {"no", "compute contact/cluster/local lists the contacts"}},
      {"store_force_contact_every", {nullptr, "compute contact/cluster/local lists the contacts"}},
      {"allow_special_domain_periodic", {nullptr, "a wall reaches through periodic sides by itself"}},
      {"temperature", {nullptr, "walls have no temperature"}},
      {"contact_area", {nullptr, "walls have no temperature"}},
  };
  return arguments;
}

/// Switches of LIGGGHTS's models that go to them where they are on.
inline bool is_switch_of_a_model(const std::string& keyword) {
  for (const char* known : {"limitForce", "absolute_damping", "viscous", "tangential_reduce", "ktToKnUser",
                            "limitLiquidContent", "modifyLbVolume"})
    if (keyword == known)
      return true;
  return false;
}

/// Throws std::invalid_argument unless `value` of a keyword of stock asks for nothing.
inline void refuse_stock_keyword(const std::string& keyword, const std::string& value) {
  const StockContactKeyword& known = stock_contact_keywords().at(keyword);
  if (known.nothing && !base::switch_value(value).value_or(true))
    return;
  base::refuse("keyword '{}': '{}' of stock's contact models is not offered: {}; expected {}{}", keyword, value,
               known.remedy, keyword, known.nothing ? " " + std::string(known.nothing) + ", or nothing" : " left out");
}

} // namespace eccentra::contact
