// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a user types after `fix ID group wall/gran/cluster`, as data.
#pragma once

#include "contact/contact_law.h"
#include "contact/wall_surface.h"
#include "styles/rolling/wall_rolling.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::cluster {

struct WallWords {
  bool shared = true; ///< contacts shared (else parallel)
  DampingLaw damping = DampingLaw::stock;
  bool tangential_damping = true;
  std::unique_ptr<WallRolling> rolling; ///< null: rolling_friction off
  std::optional<WallSurface> surface;   ///< primitive wall
  int type = 0;                         ///< material of a primitive wall
  std::vector<std::string> meshes;      ///< ids of fixes mesh/surface; empty for a primitive wall
};

/// Reads all words. Throws std::invalid_argument with one sentence that names the word, its value and the remedy.
WallWords read_wall_words(const std::vector<std::string>& words);

} // namespace eccentra::cluster
