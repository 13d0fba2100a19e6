// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the line of pair_style gran/cluster: stock's keywords for contact models, and ours.
#include "base/option_reader.h"
#include "base/refusal.h"
#include "contact/stock_contact_keywords.h"
#include "styles/pairs/pair_gran_cluster.h"

#include <algorithm>

namespace eccentra::styles {

namespace {

/// A name of one of stock's kinds of models.
std::string model_name(base::OptionReader& reader, const std::string& kind) {
  const std::string name = StockContact::read_name(reader, kind);
  if (name == "eccentric")
    base::refuse("{}: 'eccentric' is not offered for clusters, which have their shape; expected another one of {}",
                 kind, StockContact::known(kind));
  return name;
}

/// Rows of contact_models() know springs, dashpots and sliding friction.
bool fits_in_blocks(const ClusterContactKeywords& words) {
  const StockModelNames& names = words.names;
  return contact::find_contact_model(names.normal) && (names.tangential == "off" || names.tangential == "history") &&
         names.rolling == "off" && names.cohesion == "off" && words.options.empty();
}

} // namespace

ClusterContactKeywords read_contact_keywords(const std::vector<std::string>& arguments) {
  ClusterContactKeywords words;
  words.names.normal.clear();
  bool tangential_update = false, friction_bound = false, radius = false, damping = false;
  std::vector<std::string> switched_off; // switches of models; some are on where nothing is written
  base::OptionReader reader(arguments);
  while (reader.more()) {
    const std::string keyword = reader.keyword();
    if (keyword == "model") {
      words.names.normal = model_name(reader, keyword);
    } else if (keyword == "tangential") {
      words.names.tangential = model_name(reader, keyword);
    } else if (keyword == "rolling_friction") {
      words.names.rolling = model_name(reader, keyword);
    } else if (keyword == "cohesion") {
      words.names.cohesion = model_name(reader, keyword);
    } else if (keyword == "surface") {
      reader.choice({"default"});
    } else if (keyword == "contacts") {
      words.sharing =
          reader.choice({"shared", "parallel"}) == "shared" ? ContactSharing::shared : ContactSharing::parallel;
    } else if (keyword == "damping") {
      damping = true;
      words.damping =
          reader.choice({"stock", "paper"}) == "stock" ? contact::DampingLaw::stock : contact::DampingLaw::paper;
    } else if (keyword == "tangential_damping") {
      words.tangential_damping = reader.on_off();
    } else if (keyword == "friction_bound") {
      friction_bound = true;
      words.friction = reader.choice({"elastic", "stock"}) == "elastic" ? contact::FrictionBound::elastic
                                                                        : contact::FrictionBound::stock;
    } else if (keyword == "tangential_update") {
      tangential_update = true;
      words.synchronised = reader.choice({"synchronised", "stock"}) == "synchronised";
    } else if (keyword == "rolling_radius") {
      radius = true;
      words.rolling_radius =
          reader.choice({"sub_sphere", "body"}) == "body" ? RollingRadius::body : RollingRadius::sub_sphere;
    } else if (contact::stock_contact_keywords().count(keyword)) {
      contact::refuse_stock_keyword(keyword, reader.value("on or off"));
    } else {
      const std::string value = reader.value("a value");
      const bool nothing = contact::is_switch_of_a_model(keyword) && !base::switch_value(value).value_or(true);
      std::vector<std::string>& where = nothing ? switched_off : words.options;
      where.push_back(keyword);
      where.push_back(value);
    }
  }
  if (words.names.normal.empty() || words.names.normal == "off")
    base::refuse("no contact model is given; expected model hertz tangential history rolling_friction off, or another "
                 "of LIGGGHTS's models");
  words.in_blocks = fits_in_blocks(words);
  words.tangential = words.names.tangential != "off";
  if (!words.tangential)
    words.tangential_damping = false;
  if (words.in_blocks && damping && words.damping == contact::DampingLaw::paper) {
    if (friction_bound)
      base::refuse(
          "friction_bound: damping paper has a bound of its own, the elastic one for the spring alone; expected "
          "damping stock, or no friction_bound");
    words.friction = contact::FrictionBound::paper;
    friction_bound = true;
  }
  // `contacts parallel` is what stock does.
  const bool as_stock = words.sharing == ContactSharing::parallel;
  if (!friction_bound)
    words.friction = as_stock ? contact::FrictionBound::stock : contact::FrictionBound::elastic;
  if (!tangential_update)
    words.synchronised = !as_stock;
  if (!words.in_blocks) {
    words.options.insert(words.options.end(), switched_off.begin(), switched_off.end());
    if (damping && words.damping == contact::DampingLaw::paper)
      base::refuse("damping: 'paper' is not offered for the models of LIGGGHTS; expected it with model hertz, "
                   "tangential history or off, no rolling friction and no cohesion");
    if (!words.tangential_damping && words.tangential) {
      words.options.push_back("tangential_damping");
      words.options.push_back("off");
    }
  }
  if (radius && words.names.rolling == "off")
    base::refuse("rolling_radius: there is no rolling friction; expected rolling_friction with a model, or no "
                 "rolling_radius");
  return words;
}

} // namespace eccentra::styles
