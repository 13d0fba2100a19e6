// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a user types after `fix ID group wall/gran/cluster`, as data.
#pragma once

#include "contact/contact_models.h"
#include "contact/wall_surface.h"
#include "styles/models/stock_contact.h"
#include "styles/rolling/wall_rolling.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::styles {

struct WallArguments {
  StockModelNames names;            ///< `normal` is a row of contact_models() where in_blocks; rolling is `rolling`
  bool in_blocks = true;            ///< else through LIGGGHTS's own classes
  std::vector<std::string> options; ///< keywords and values for those
  contact::FrictionBound friction = contact::FrictionBound::elastic;
  bool synchronised = true; ///< the tangential spring advances by what contact points slide in the middle of a step
  RollingRadius rolling_radius = RollingRadius::sub_sphere;
  bool shared = true; ///< contacts shared (else parallel)
  contact::DampingLaw damping = contact::DampingLaw::stock;
  bool tangential_damping = true;
  bool tangential = false; ///< a tangential spring; without it the wall is free of friction

  contact::DampingChoice damping_choice() const { return {damping, tangential_damping}; }

  std::unique_ptr<WallRolling> rolling;        ///< null: rolling_friction off
  std::string rolling_model;                   ///< as typed
  std::optional<contact::WallSurface> surface; ///< primitive wall
  int type = 0;                                ///< material of a primitive wall
  std::vector<std::string> meshes;             ///< ids of fixes mesh/surface; empty for a primitive wall
};

/// Reads all arguments. Throws std::invalid_argument with one sentence that names the word, its value and the remedy.
WallArguments read_wall_arguments(const std::vector<std::string>& arguments);

} // namespace eccentra::styles
