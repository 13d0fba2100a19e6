// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The eddies that a particle meets in a turbulent flow: a random walk of the velocity that the closures see.
#pragma once

#include "closures/effect.h"

#include <cstdint>

namespace eccentra::closures {

/// Scales of the energetic eddies by the two quantities of a RAS model.
struct EddyScales {
  double speed;    ///< root mean square of one component of the fluctuation [m/s]: sqrt(2 k/3)
  double lifetime; ///< mean life of an eddy, the integral time of the fluid's path [s]
  double length;   ///< the distance over which a particle leaves it [m]
};

/// Lifetime over k/epsilon. A tracer then spreads with the diffusivity nut/0.9 of a scalar in k-epsilon models:
/// (2 k/3) T = (0.09/0.9) k^2/epsilon.
constexpr double kEddyLifetime = 0.15;
/// Length over k^1.5/epsilon: C_mu^0.75, the dissipation length of k-epsilon models (Shuen, Chen and Faeth 1983).
constexpr double kEddyLength = 0.16432;

/// `energy` k [m2/s2] and `dissipation` epsilon [m2/s3]; all 0 where one of them is not positive.
EddyScales eddy_scales(double energy, double dissipation);

/// The eddy of one particle, as it is stored, sent and restarted.
struct Eddy {
  double direction[3]; ///< fluctuation over EddyScales::speed: three standard normal numbers
  double left;         ///< what is left of its life, in mean lives
};
/// Doubles of an Eddy.
constexpr int kEddyColumns = 4;

/// Eddy interaction after Gosman and Ioannides (1983): a particle sees the fluctuation of one eddy until it dies or the
/// particle has left it, then that of another. Lives are exponentially distributed, and an eddy ages by its time and by
/// the way of the particle through it: the correlation seen is exp(-t (1/lifetime + slip/length)), whatever the step.
class EddyInteraction {
 public:
  /// The same seed gives the same walk on any number of ranks and through restarts.
  explicit EddyInteraction(int seed) : seed_(seed) {}
  /// Quantities of the fluid that it reads.
  static constexpr unsigned kNeeds = link::kVelocity | link::kTurbulence;

  /// Ages the eddies of all particles of the group by `interval` [s] and replaces those that have ended. `tag`: the
  /// number of each particle; `step`: of the time step, which must not come twice with interval > 0.
  void age(const HalfStep& half_step, double interval, const int* tag, std::int64_t step, Eddy* eddies) const;
  /// Velocity that the particles of the group see: the sampled one and the fluctuation. `seen` has a row per particle.
  static void see(const HalfStep& half_step, const Eddy* eddies, double (*seen)[3]);

 private:
  void meet(int tag, std::int64_t step, Eddy& eddy) const;
  int seed_;
};

} // namespace eccentra::closures
