// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What a force law may ask of the fluid, and what it hands back. The union of what is asked for decides what the solver
// computes, samples and sends; nothing else exists.
#pragma once

namespace eccentra::link {

/// Bits of a set of fluid quantities at a particle's centre. World frame, SI.
enum Quantity : unsigned {
  kVelocity = 1u << 0,         ///< fluid velocity u_f [m/s]
  kFraction = 1u << 1,         ///< fluid volume fraction alpha [-]
  kPressureGradient = 1u << 2, ///< grad p_rgh [Pa/m], with the gradient that drives a periodic section
  kStressDivergence = 1u << 3, ///< div tau [N/m3], viscous stress of the fluid
  kVorticity = 1u << 4,        ///< curl u_f [1/s]
};

/// Per-atom samples of the flow; rows are local atoms. An array is null where its quantity is not asked for.
struct FluidSamples {
  double (*velocity)[3] = nullptr;
  double* fraction = nullptr;
  double (*pressure_gradient)[3] = nullptr;
  double (*stress_divergence)[3] = nullptr;
  double (*vorticity)[3] = nullptr;
};

/// What the fluid did to each particle since the last reset, as time integrals over DEM steps; rows are local atoms.
/// Drag and lifts only (S_f of eq 2 and 3): pressure gradient and buoyancy are in alpha grad p already.
struct FluidReaction {
  double (*impulse)[3] = nullptr;     ///< integral of F_D + F_S + F_M dt [N s]; the fluid receives the opposite
  double* drag_coefficient = nullptr; ///< integral of beta dt [kg], drag force = beta (u_f - u_p): its linearisation
  double elapsed = 0.0;               ///< integrated time [s]
};

} // namespace eccentra::link
