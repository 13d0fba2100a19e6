// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Puts a compiled combination of contact models into LIGGGHTS's factories, for pairs and for walls.
// Included by one small file per combination: each takes long to compile.
#pragma once

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "contact_models.h"
#include "error.h"
#include "fix_wall_gran_base.h"
#include "force.h"
#include "granular_pair_style.h"
#include "granular_wall.h"
#include "memory.h"
#include "modify.h"
#include "pair_gran_base.h"
#include "update.h"

namespace eccentra::styles {

/// A static object of this type announces Hertz contacts with tangential history and the rolling model `Rolling`.
template <int Rolling> struct RegisterHertzHistory {
  using Style =
      LIGGGHTS::ContactModels::GranStyle<LIGGGHTS::ContactModels::HERTZ, LIGGGHTS::ContactModels::TANGENTIAL_HISTORY,
                                         LIGGGHTS::ContactModels::COHESION_OFF, Rolling,
                                         LIGGGHTS::ContactModels::SURFACE_DEFAULT>;
  using Model = LIGGGHTS::ContactModels::ContactModel<Style>;

  explicit RegisterHertzHistory(const char* name) {
    LIGGGHTS::ContactModels::Factory::instance().addRollingModel(name, Rolling);
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, &create_pair);
    LIGGGHTS::Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &create_wall);
  }

  static LIGGGHTS::PairStyles::IGranularPairStyle* create_pair(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::PairGran* parent,
                                                               int64_t hash) {
    return new LIGGGHTS::PairStyles::Granular<Model>(lmp, parent, hash);
  }
  static LIGGGHTS::Walls::IGranularWall* create_wall(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixWallGran* parent,
                                                     int64_t hash) {
    return new LIGGGHTS::Walls::Granular<Model>(lmp, parent, hash);
  }
};

} // namespace eccentra::styles
