// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drag laws as reduced coefficients G(Re) = C_D Re, finite at Re = 0. Force: (pi/8) d^2 X G(Re), see Resistance.
#pragma once

#include "closures/implicit_step.h"
#include "closures/rheology.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace eccentra::closures {

/// What a drag law may know of a particle's shape.
struct ShapeFactors {
  double sphericity = 1.0; ///< phi, eq (5)
};

/// What a drag law may know of a particle's surroundings.
struct DragPlace {
  double fraction = 1.0;  ///< fluid fraction alpha, in (0, 1]
  double crosswise = 1.0; ///< phi_perp: pi d^2/4 over the area that the particle shows to the flow
};

/// Exponent of the fraction in eq (20)+(21), Model A: the drag of one particle is multiplied by alpha^-1.65.
constexpr double kVoidageExponent = -1.65;

inline double voidage_factor(double fraction) {
  return fraction < 1.0 ? std::pow(fraction, kVoidageExponent) : 1.0;
}

/// A single-particle law among others, eq (20)+(21): alpha^-1.65 C_D(Re). With VoidReynolds, as Wen & Yu (1966)
/// measured, C_D(alpha Re): hindered settling then follows Richardson & Zaki.
template <class Single, bool VoidReynolds = false> struct Suspended {
  static constexpr bool kOriented = Single::kOriented;
  static constexpr double kLowestRe = Single::kLowestRe, kHighestRe = Single::kHighestRe;
  Single law;
  explicit Suspended(const ShapeFactors& shape) : law(shape) {}

  /// The law at the place of one particle: coefficients times the power of the fraction.
  struct Placed {
    static constexpr bool kAffine = Single::kAffine;
    Single law;
    double scale;
    double re_scale;
    double viscous() const { return scale * law.viscous(); }
    double plateau() const { return (VoidReynolds ? scale * re_scale : scale) * law.plateau(); }
    ValueAndSlope operator()(double re) const {
      const ValueAndSlope g = law(VoidReynolds ? re_scale * re : re);
      return {scale * g.value, (VoidReynolds ? scale * re_scale : scale) * g.slope};
    }
  };
  Placed in(const DragPlace& place) const {
    const double factor = voidage_factor(place.fraction);
    return {law.in(place), VoidReynolds ? factor / place.fraction : factor, place.fraction};
  }
};

/// Chien (1994), eq (22): C_D = 30/Re + 67.289 exp(-5.03 phi), any orientation; range 0.2 <= phi <= 1, 0.001 < Re <
/// 1e4. Below: 30/Re (1.25 times Stokes, the law's documented bias). Above: the plateau, 0.43999 for a sphere.
struct Chien {
  static constexpr bool kOriented = false;
  static constexpr double kLowestRe = 1e-3, kHighestRe = 1e4;
  static constexpr double kViscous = 30.0, kPlateau = 67.289, kPlateauDecay = 5.03;
  static constexpr bool kAffine = true;
  double newton;

  explicit Chien(const ShapeFactors& shape) : newton(kPlateau * std::exp(-kPlateauDecay * shape.sphericity)) {}
  Chien in(const DragPlace&) const { return *this; }
  double viscous() const { return kViscous; }
  double plateau() const { return newton; }
  ValueAndSlope operator()(double re) const { return {kViscous + newton * re, newton}; }
};

/// Schiller & Naumann (1933): C_D = 24/Re (1 + 0.15 Re^0.687) up to Re = 1000, then 0.44 (a jump of 0.4 %). Spheres.
/// Below: Stokes. Above 2e5 the drag crisis is not in it.
struct SchillerNaumann {
  static constexpr bool kOriented = false;
  static constexpr bool kAffine = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 2e5;
  static constexpr double kStokes = 24.0, kFactor = 0.15, kExponent = 0.687, kNewtonRe = 1000.0, kNewton = 0.44;

  explicit SchillerNaumann(const ShapeFactors&) {}
  SchillerNaumann in(const DragPlace&) const { return *this; }
  ValueAndSlope operator()(double re) const {
    if (re > kNewtonRe)
      return {kNewton * re, kNewton};
    if (!(re > 0.0))
      return {kStokes, 0.0};
    const double growth = kStokes * kFactor * std::pow(re, kExponent);
    return {kStokes + growth, kExponent * growth / re};
  }
};

/// Haider & Levenspiel (1989): C_D = 24/Re (1 + A Re^B) + C/(1 + D/Re), coefficients by sphericity, orientation
/// averaged; range 0.026 <= phi <= 1, Re < 2.5e4 (spheres 2.6e5). Below: Stokes for every shape. Above: the plateau C.
struct HaiderLevenspiel {
  static constexpr bool kOriented = false;
  static constexpr bool kAffine = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 2.5e4;
  static constexpr double kStokes = 24.0;
  double a, b, c, d;

  explicit HaiderLevenspiel(const ShapeFactors& shape) {
    const double phi = shape.sphericity;
    a = std::exp(2.3288 + phi * (-6.4581 + phi * 2.4486));
    b = 0.0964 + 0.5565 * phi;
    c = std::exp(4.905 + phi * (-13.8944 + phi * (18.4222 + phi * -10.2599)));
    d = std::exp(1.4681 + phi * (12.2584 + phi * (-20.7322 + phi * 15.8855)));
  }
  HaiderLevenspiel in(const DragPlace&) const { return *this; }
  ValueAndSlope operator()(double re) const {
    if (!(re > 0.0))
      return {kStokes, 0.0};
    const double growth = kStokes * a * std::pow(re, b);
    const double form = c * re * re / (re + d);
    return {kStokes + growth + form, b * growth / re + c * re * (re + 2.0 * d) / ((re + d) * (re + d))};
  }
};

/// Ganser (1993) for isometric particles: C_D = K2 [24/R (1 + 0.1118 R^0.6567) + 0.4305/(1 + 3305/R)], R = K1 K2 Re,
/// K1 = 1/(1/3 + 2/3 phi^-0.5), K2 = 10^(1.8148 (-log10 phi)^0.5743); range R < 1e5. Below: Stokes times 1/K1.
struct Ganser {
  static constexpr bool kOriented = false;
  static constexpr bool kAffine = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 1e5;
  static constexpr double kStokes = 24.0, kFactor = 0.1118, kExponent = 0.6567, kForm = 0.4305, kTransition = 3305.0;
  double k1, k2;

  explicit Ganser(const ShapeFactors& shape)
      : k1(1.0 / (1.0 / 3.0 + 2.0 / 3.0 / std::sqrt(shape.sphericity))),
        k2(std::pow(10.0, 1.8148 * std::pow(std::max(0.0, -std::log10(shape.sphericity)), 0.5743))) {}
  Ganser in(const DragPlace&) const { return *this; }
  ValueAndSlope operator()(double re) const {
    const double r = k1 * k2 * re;
    if (!(r > 0.0))
      return {kStokes / k1, 0.0};
    const double growth = kStokes * kFactor * std::pow(r, kExponent);
    const double form = kForm * r * r / (r + kTransition);
    const double sum = r + kTransition;
    // G = C_D Re = (C_D/K2) r / K1.
    return {(kStokes + growth + form) / k1,
            k2 * (kExponent * growth / r + kForm * r * (r + 2.0 * kTransition) / (sum * sum))};
  }
};

/// Hoelzer & Sommerfeld (2008), their form without the lengthwise sphericity: C_D = 8/(Re sqrt(phi_perp)) +
/// 16/(Re sqrt(phi)) + 3/(sqrt(Re) phi^0.75) + 0.42 10^(0.4 (-log10 phi)^0.2)/phi_perp; all shapes and orientations,
/// Re < 1e5. Below: Stokes' part by shape; a sphere is 24/Re. phi_perp is taken from the shape as it lies in the flow.
struct HoelzerSommerfeld {
  static constexpr bool kOriented = true;
  static constexpr bool kAffine = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 1e5;
  static constexpr double kForm = 8.0, kFriction = 16.0, kMiddle = 3.0, kNewton = 0.42;
  double friction, middle, newton;
  double viscous = 0.0, plateau = 0.0;

  explicit HoelzerSommerfeld(const ShapeFactors& shape)
      : friction(kFriction / std::sqrt(shape.sphericity)), middle(kMiddle / std::pow(shape.sphericity, 0.75)),
        newton(kNewton * std::pow(10.0, 0.4 * std::pow(std::max(0.0, -std::log10(shape.sphericity)), 0.2))) {}
  HoelzerSommerfeld in(const DragPlace& place) const {
    HoelzerSommerfeld law = *this;
    law.viscous = friction + kForm / std::sqrt(place.crosswise);
    law.plateau = newton / place.crosswise;
    return law;
  }
  ValueAndSlope operator()(double re) const {
    if (!(re > 0.0))
      return {viscous, 0.0};
    const double root = middle * std::sqrt(re);
    return {viscous + root + plateau * re, 0.5 * root / re + plateau};
  }
};

/// Ergun (1952) per particle, Model A: beta = 150 (1-a)^2 mu/(a (phi d)^2) + 1.75 (1-a) rho U/(phi d), packed beds.
/// In reduced form (4/3) [150 (1-a)/(a phi^2) + 1.75 Re/phi].
struct Ergun {
  static constexpr double kViscous = 150.0, kInertial = 1.75, kPerParticle = 4.0 / 3.0;
};

/// Gidaspow (1994): Wen & Yu above alpha = 0.8, Ergun at and below it (a jump, as published). Spheres; phi enters
/// Ergun.
struct Gidaspow {
  static constexpr bool kOriented = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 2e5;
  static constexpr double kSwitch = 0.8;
  Suspended<SchillerNaumann, true> dilute;
  double sphericity;

  explicit Gidaspow(const ShapeFactors& shape) : dilute(shape), sphericity(shape.sphericity) {}
  /// At one place: Ergun's two terms in a dense bed, else Wen & Yu.
  struct Placed {
    static constexpr bool kAffine = false;
    bool dense;
    Suspended<SchillerNaumann, true>::Placed dilute;
    double viscous, inertial;
    ValueAndSlope operator()(double re) const {
      return dense ? ValueAndSlope{viscous + inertial * re, inertial} : dilute(re);
    }
  };
  Placed in(const DragPlace& place) const {
    const double a = place.fraction;
    const bool dense = a <= kSwitch;
    return {dense, dense ? Suspended<SchillerNaumann, true>::Placed{dilute.law, 0.0, 0.0} : dilute.in(place),
            Ergun::kPerParticle * Ergun::kViscous * (1.0 - a) / (a * sphericity * sphericity),
            Ergun::kPerParticle * Ergun::kInertial / sphericity};
  }
};

/// Di Felice (1994), Model A: F = (pi/8) rho d^2 (a U)^2 C_D(a Re) a^-chi, C_D = (0.63 + 4.8/sqrt(Re))^2,
/// chi = 3.7 - 0.65 exp(-(1.5 - log10(a Re))^2/2); any fraction, spheres. At rest C_D Re = 23.04, chi = 3.7.
struct DiFelice {
  static constexpr bool kOriented = false;
  static constexpr double kLowestRe = 0.0, kHighestRe = 1e5;
  static constexpr double kPlateauRoot = 0.63, kViscousRoot = 4.8;
  static constexpr double kChi = 3.7, kChiDip = 0.65, kChiCentre = 1.5;

  explicit DiFelice(const ShapeFactors&) {}
  /// At one place: the exponent of the fraction depends on Re.
  struct Placed {
    static constexpr bool kAffine = false;
    double fraction;
    double log_fraction;
    ValueAndSlope operator()(double re) const {
      // Re C_D(a Re) = (0.63 sqrt(Re) + 4.8/sqrt(a))^2
      const double viscous = kViscousRoot / std::sqrt(fraction);
      if (!(re > 0.0))
        return {viscous * viscous * std::exp((2.0 - kChi) * log_fraction), 0.0};
      const double root_re = std::sqrt(re);
      const double sum = kPlateauRoot * root_re + viscous;
      const double decades = kChiCentre - std::log10(fraction * re);
      const double dip = kChiDip * std::exp(-0.5 * decades * decades);
      const double factor = std::exp((2.0 - kChi + dip) * log_fraction);
      const double value = factor * sum * sum;
      const double dip_slope = dip * decades / (re * std::log(10.0));
      return {value, factor * sum * kPlateauRoot / root_re + value * log_fraction * dip_slope};
    }
  };
  Placed in(const DragPlace& place) const { return {place.fraction, std::log(place.fraction)}; }
};

/// Qi, Kuang, Qiu & Yu (2020), packed beds of spheres in power-law and Herschel-Bulkley fluid, as MFiX writes it (model
/// A): F = (pi/8) rho d^2 (a U)^2 C_D a^-b, C_D = (2.654/(n^-1.9 + 3.213) + 4.8/(n^0.08 sqrt(Re)))^2, Re = rho (a
/// U)^2/(k (a U/d)^n + tau0) at the superficial velocity a U, b = 2.65 n (a+1)^n - (5.3 - 3.5 a^n) a^2 exp(-L^2/2) +
/// [2.65 (a+1)^(2-n) - 2.65 n (a+1)^n]/(1 + exp(-2 L)), L = log10(Re) - 1.5. At n = 1 a single sphere is Di Felice's,
/// whose range is stated here, for the source's is not in MFiX. At rest C_D Re = 23.04 n^-0.16 and b = 2.65 n (a+1)^n.
struct Qkqy {
  static constexpr bool kOriented = false;
  static constexpr bool kSuperficial = true;
  static constexpr double kLowestRe = 0.0, kHighestRe = 1e5;
  static constexpr double kOwnYieldWeight = 1.0;
  static constexpr double kPlateau = 2.654, kPlateauPower = -1.9, kPlateauShift = 3.213;
  static constexpr double kViscousRoot = 4.8, kViscousPower = -0.08;
  static constexpr double kCrowding = 2.65, kDip = 5.3, kDipSlope = 3.5, kDipCentre = 1.5;
  double index, plateau, viscous;

  Qkqy(const ShapeFactors&, const Rheology& fluid)
      : index(fluid.index), plateau(kPlateau / (std::pow(index, kPlateauPower) + kPlateauShift)),
        viscous(kViscousRoot * std::pow(index, kViscousPower)) {}
  /// At one place: the crowding factors of its fraction.
  struct Placed {
    static constexpr bool kAffine = false;
    double plateau, viscous, log_fraction, creeping, dip, rise;
    ValueAndSlope operator()(double re) const {
      if (!(re > 0.0))
        return {viscous * viscous * std::exp(-creeping * log_fraction), 0.0};
      const double root_re = std::sqrt(re);
      const double sum = plateau * root_re + viscous;
      const double decades = std::log10(re) - kDipCentre;
      const double hollow = dip * std::exp(-0.5 * decades * decades);
      const double step = 1.0 / (1.0 + std::exp(-2.0 * decades));
      const double factor = std::exp(-(creeping - hollow + rise * step) * log_fraction);
      const double value = factor * sum * sum;
      const double per_decade = hollow * decades + 2.0 * rise * step * (1.0 - step);
      return {value, factor * sum * plateau / root_re - value * log_fraction * per_decade / (re * std::log(10.0))};
    }
  };
  Placed in(const DragPlace& place) const {
    const double a = place.fraction;
    const double creeping = kCrowding * index * std::pow(a + 1.0, index);
    return {plateau,
            viscous,
            std::log(a),
            creeping,
            (kDip - kDipSlope * std::pow(a, index)) * a * a,
            kCrowding * std::pow(a + 1.0, 2.0 - index) - creeping};
  }
};

/// Whether a law's Reynolds number is that of the superficial slip alpha U.
template <class Law, class = void> inline constexpr bool kSuperficial = false;
template <class Law> inline constexpr bool kSuperficial<Law, std::enable_if_t<Law::kSuperficial>> = true;

/// A law of this shape, in this fluid if the law depends on it.
template <class Law> Law make_law(const ShapeFactors& shape, [[maybe_unused]] const Rheology& fluid) {
  if constexpr (std::is_constructible_v<Law, const ShapeFactors&, const Rheology&>)
    return Law(shape, fluid);
  else
    return Law(shape);
}

/// The drag of a particle of diameter d as a function of its slip speed; `law` is in its place.
template <class Law, class Stress, class Placed>
Resistance<Stress, Placed> drag_resistance(const Stress& stress, const Placed& law, double d, double density,
                                           [[maybe_unused]] double fraction) {
  // X at the speed a U is X at the inverse length a/d.
  const double slowing = kSuperficial<Law> ? fraction : 1.0;
  return {stress, law, kPi / 8.0 * d * d, slowing / d, density * slowing * slowing};
}

} // namespace eccentra::closures
