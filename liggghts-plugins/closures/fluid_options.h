// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The arguments of `fix fluid/force`, read into values and turned into the list of effects that they ask for.
#pragma once

#include "closures/effect.h"
#include "closures/rheology.h"
#include "closures/screen_options.h"

#include <string>
#include <vector>

namespace eccentra::closures {

/// What a line `fix ID group fluid/force ...` states.
struct FluidOptions {
  Rheology rheology;                      ///< with the weights that the keywords below choose
  std::string drag = "none";              ///< name of the drag law
  bool void_reynolds = false;             ///< alpha Re in place of Re in a single-particle drag law
  bool power_law_factor = false;          ///< x = X(n) in the stress scale
  bool beris_yield = false;               ///< w by which a sphere rests where Beris et al. (1985) say
  bool cross_yield = false;               ///< a cross term of viscous and yield stress
  bool shear_lift = false;                ///< Saffman and Mei
  bool rotational_lift = false;           ///< Oesterle and Bui Dinh
  bool drag_torque = false;               ///< of Dennis et al., on a relative spin
  bool oriented = false;                  ///< drag and drag_torque of the real shape
  bool strain_torque = false;             ///< with oriented
  bool pitching_torque = false;           ///< with oriented
  bool buoyancy = true;                   ///< -rho_f g V
  bool pressure_gradient = false;         ///< -grad p_rgh V
  bool viscous_stress = false;            ///< div tau V
  bool turbulent_dispersion = false;      ///< the velocity seen has the fluctuation of an eddy
  int dispersion_seed = 1;                ///< of that walk
  ScreenOptions screen;                   ///< tolerance 0: none
  std::vector<double> sphericity = {1.0}; ///< of plain spheres: one value, or one per atom type
};

/// Reads the arguments after `fix ID group fluid/force`. Throws std::invalid_argument with one sentence that names the
/// word, its value and the remedy.
FluidOptions read_fluid_options(const std::vector<std::string>& arguments, int atom_types);

/// The effects that are on, in the order in which they act: volume forces, lifts, drag (implicit against all
/// others), torques, the one that resists the spin last.
EffectList make_effects(const FluidOptions& options);

} // namespace eccentra::closures
