// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that the wall tests share: a box of glass-like spheres, material coefficients, one sphere to place.
#pragma once

#include "support/liggghts_session.h"

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace eccentra::test {

/// Two materials of equal coefficients, granular atoms, a box of +-0.1 m; pair style is stock's.
inline std::string wall_scene(double timestep, const std::string& e = "0.9",
                              const std::string& rolling_friction = "0.1", const std::string& boundary = "f f f") {
  return R"(
    atom_style granular
    atom_modify map array
    boundary )" +
         boundary + R"(
    newton off
    processors * 1 1
    communicate single vel yes
    units si
    region box block -0.1 0.1 -0.1 0.1 -0.1 0.1 units box
    create_box 2 box
    neighbor 0.002 bin
    neigh_modify delay 0
    fix m1 all property/global youngsModulus peratomtype 5e6 5e6
    fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
    fix m3 all property/global coefficientRestitution peratomtypepair 2 )" +
         e + " " + e + " " + e + " " + e + R"(
    fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
    fix m5 all property/global coefficientRollingFriction peratomtypepair 2 )" +
         rolling_friction + " " + rolling_friction + " " + rolling_friction + " " + rolling_friction + R"(
    pair_style gran model hertz tangential history
    pair_coeff * *
    timestep )" +
         std::to_string(timestep * 1e6) + "e-6\n";
}

/// What a rank that owns the atom knows, on all ranks: x, v, omega.
inline std::array<double, 9> state_of(LiggghtsSession& session, int tag) {
  std::array<double, 9> state{};
  const int i = session.local(tag);
  if (i >= 0)
    for (int k = 0; k < 3; ++k) {
      state[k] = session.atom().x[i][k];
      state[3 + k] = session.atom().v[i][k];
      state[6 + k] = session.atom().omega[i][k];
    }
  MPI_Allreduce(MPI_IN_PLACE, state.data(), 9, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return state;
}

} // namespace eccentra::test
