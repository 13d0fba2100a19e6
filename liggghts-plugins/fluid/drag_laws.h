// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Drag laws as reduced coefficients G(Re) = C_D Re, finite at Re = 0. Force: (pi/8) d^2 X G(Re), see Resistance.
#pragma once

#include "fluid/rheology.h"

#include <cmath>

namespace eccentra::fluid {

/// What a drag law may know of a particle's shape. Areas are relative to pi d^2/4 of the sphere of equal volume.
struct ShapeFactors {
  double sphericity = 1.0; ///< phi, eq (5)
};

/// Exponent of the fraction in eq (20)+(21), Model A: per-particle drag is multiplied by alpha^-1.65.
constexpr double kVoidageExponent = -1.65;

inline double voidage_factor(double fraction) {
  return fraction < 1.0 ? std::pow(fraction, kVoidageExponent) : 1.0;
}

/// Chien (1994), eq (22): C_D = 30/Re + 67.289 exp(-5.03 phi), any orientation; range 0.2 <= phi <= 1, 0.001 < Re <
/// 1e4. Below: 30/Re (1.25 times Stokes, the law's documented bias). Above: the plateau, 0.43999 for a sphere.
struct Chien {
  double plateau;
  double scale = 1.0;

  explicit Chien(const ShapeFactors& shape) : plateau(67.289 * std::exp(-5.03 * shape.sphericity)) {}
  /// The law in a suspension of this fluid fraction.
  Chien in(double fraction) const {
    Chien law = *this;
    law.scale = voidage_factor(fraction);
    return law;
  }
  ValueAndSlope operator()(double re) const { return {scale * (30.0 + plateau * re), scale * plateau}; }
};

} // namespace eccentra::fluid
