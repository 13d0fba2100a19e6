// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fluid as a particle feels it: stress scale, Reynolds and Bingham numbers of a Herschel-Bulkley fluid, eq (23).
#pragma once

#include <cmath>

namespace eccentra::closures {

constexpr double kPi = 3.14159265358979323846;

/// Volume of the sphere of this radius.
inline double sphere_volume(double radius) {
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

/// Weight of the Bingham number in eq (23) (Ansley & Smith 1967).
constexpr double kAnsleySmith = 7.0 * kPi / 24.0;

/// A sphere rests where tau0 >= this times (rho_p - rho_f) g d: Beris et al. (1985), Y = 3 tau0/((rho_p - rho_f) g d) =
/// 0.143, computed for creep in a Bingham fluid without slip at the surface.
constexpr double kBerisYield = 0.143 / 3.0;

/// Factor by which power-law fluid of index n resists a creeping sphere more than k (U/d)^n says, C_D = 24 x/Re_PL;
/// Renaud, Mauret & Chhabra (2004), a fit to computed drag, about 0.4 <= n <= 1; 1 at n = 1.
inline double power_law_factor(double n) {
  return std::pow(6.0, 0.5 * (n - 1.0)) * std::pow(3.0 / (n * n + n + 1.0), n + 1.0);
}

/// c of the drag of a creeping sphere C_s = X(n) + Bn/(6 * 0.143) + c sqrt(Bn), C_s = F/(3 pi k (U/d)^n d^2), Bn =
/// (tau0/k)(d/U)^n: fitted to the drag computed for 0.1 <= Bn <= 100, 0.4 <= n <= 1 (docs/creeping-drag.md), which it
/// meets within 6 %.
inline double cross_coefficient(double n) {
  return 1.76 * std::pow(n, 1.63);
}

/// Herschel-Bulkley parameters: tau = yield_stress + consistency * rate^index. SI. The last three weigh the terms of
/// the stress scale around a particle, see HerschelBulkleyStress and CrossStress.
struct Rheology {
  double yield_stress = 0.0;          ///< tau0 [Pa], >= 0
  double consistency = 0.0;           ///< k [Pa s^n], > 0; the viscosity where index is 1
  double index = 1.0;                 ///< n [-], > 0
  double density = 0.0;               ///< rho_f [kg/m3], > 0
  double viscous_weight = 1.0;        ///< x, of the viscous term [-]
  double yield_weight = kAnsleySmith; ///< w, of the yield stress [-]
  double cross_weight = 0.0;          ///< c, of the cross term [-]; 0: none

  /// True if no power and no yield stress is to be evaluated.
  bool newtonian() const { return yield_stress == 0.0 && index == 1.0; }
  /// True if CrossStress applies.
  bool crossed() const { return yield_stress > 0.0 && cross_weight > 0.0; }
};

/// A function of one speed and its derivative.
struct ValueAndSlope {
  double value; ///< of the function
  double slope; ///< derivative with respect to the speed
};

/// Stress that the flow around a particle works against at a shear rate U/d: X = x k rate^n + w tau0 [Pa] with x = 1
/// and w = 7 pi/24 in the paper. Eq (23) is Re_HB = rho U^2 / X, and the viscosity that the particle meets is X / rate.
/// Finite at rest.
struct HerschelBulkleyStress {
  double yield;       ///< w tau0 [Pa]
  double consistency; ///< x k [Pa s^n]
  double index;       ///< n [-]

  /// At the weights of `fluid`.
  explicit HerschelBulkleyStress(const Rheology& fluid)
      : yield(fluid.yield_weight * fluid.yield_stress), consistency(fluid.viscous_weight * fluid.consistency),
        index(fluid.index) {}

  /// X(0) [Pa].
  double at_rest() const { return yield; }
  /// X(speed/length) and dX/d speed; speed > 0.
  ValueAndSlope operator()(double speed, double inverse_length) const {
    const double viscous = consistency * std::pow(speed * inverse_length, index);
    return {yield + viscous, index * viscous / speed};
  }
};

/// The same with a third term: X = x k rate^n + w tau0 + c sqrt(k rate^n tau0), the layer of sheared fluid at a body in
/// mud that hardly yields. Both limits of the sum of two terms remain.
struct CrossStress {
  double yield;      ///< w tau0 [Pa]
  double viscous;    ///< x k [Pa s^n]
  double cross;      ///< c sqrt(k tau0) [Pa s^(n/2)]
  double half_index; ///< n/2 [-]

  /// At the weights of `fluid`.
  explicit CrossStress(const Rheology& fluid)
      : yield(fluid.yield_weight * fluid.yield_stress), viscous(fluid.viscous_weight * fluid.consistency),
        cross(fluid.cross_weight * std::sqrt(fluid.consistency * fluid.yield_stress)), half_index(0.5 * fluid.index) {}

  /// X(0) [Pa].
  double at_rest() const { return yield; }
  /// X(speed/length) and dX/d speed; speed > 0.
  ValueAndSlope operator()(double speed, double inverse_length) const {
    const double root = std::pow(speed * inverse_length, half_index);
    const double first = viscous * root * root, second = cross * root;
    return {yield + first + second, half_index * (2.0 * first + second) / speed};
  }
};

/// The same for tau0 = 0, n = 1: no power to evaluate.
struct NewtonianStress {
  double viscosity; ///< [Pa s]

  /// The viscosity is the consistency of `fluid`.
  explicit NewtonianStress(const Rheology& fluid) : viscosity(fluid.consistency) {}

  /// No yield stress.
  double at_rest() const { return 0.0; }
  /// X(speed/length) and dX/d speed.
  ValueAndSlope operator()(double speed, double inverse_length) const {
    const double slope = viscosity * inverse_length;
    return {slope * speed, slope};
  }
};

/// Calls `with` with the stress scale of this fluid, of the type that costs least.
template <class With> auto with_stress(const Rheology& fluid, With&& with) {
  if (fluid.newtonian())
    return with(NewtonianStress(fluid));
  if (fluid.crossed())
    return with(CrossStress(fluid));
  return with(HerschelBulkleyStress(fluid));
}

/// X at this slip speed > 0 around a particle of this diameter [Pa].
inline double stress_scale(const Rheology& f, double speed, double diameter) {
  if (f.crossed())
    return CrossStress(f)(speed, 1.0 / diameter).value;
  return HerschelBulkleyStress(f)(speed, 1.0 / diameter).value;
}

/// Re_PL = rho U^(2-n) d^n / k.
inline double reynolds_power_law(const Rheology& f, double speed, double diameter) {
  return f.density * std::pow(speed, 2.0 - f.index) * std::pow(diameter, f.index) / f.consistency;
}

/// Bi = (tau0/k) (d/U)^n.
inline double bingham(const Rheology& f, double speed, double diameter) {
  return f.yield_stress / f.consistency * std::pow(diameter / speed, f.index);
}

/// Re_HB of eq (23) = Re_PL / (x + w Bi + c sqrt(Bi)), written without division by zero; 0 at rest.
inline double reynolds_herschel_bulkley(const Rheology& f, double speed, double diameter) {
  if (!(speed > 0.0))
    return 0.0;
  return f.density * speed * speed / stress_scale(f, speed, diameter);
}

/// Viscosity that a particle of this diameter meets at this slip speed: rho U d / Re_HB [Pa s]; speed > 0.
inline double particle_viscosity(const Rheology& f, double speed, double diameter) {
  return stress_scale(f, speed, diameter) * diameter / speed;
}

} // namespace eccentra::closures
