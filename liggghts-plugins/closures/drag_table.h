// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The drag laws that a script can name: their effects, and their coefficients as plain numbers.
#pragma once

#include "closures/drag_laws.h"
#include "closures/effect.h"

#include <memory>
#include <string>

namespace eccentra::closures {

/// A row of the table of drag laws.
struct DragLaw {
  /// The name in scripts and the effect of the law for any rheology.
  const char* name;
  std::unique_ptr<Effect> (*make)(const char* name, const Rheology&);
  std::unique_ptr<Effect> (*make_void_reynolds)(const char* name, const Rheology&); ///< with alpha Re in place of Re
  /// The same on the real shape (OrientedDrag); null for a law of beds that knows no single particle.
  std::unique_ptr<Effect> (*make_oriented)(const char* name, const Rheology&);
  std::unique_ptr<Effect> (*make_oriented_void_reynolds)(const char* name, const Rheology&);
  /// G(Re) = C_D Re of one particle of this shape in its place, and dG/dRe; Re >= 0 as the law defines it.
  ValueAndSlope (*reduced)(const ShapeFactors&, const DragPlace&, const Rheology&, double re);
  /// F(U) [N] of one particle of diameter d [m] at the slip speed U [m/s] > 0, with the weights of the rheology.
  double (*force)(const ShapeFactors&, const DragPlace&, const Rheology&, double d, double speed);
  double own_yield_weight; ///< w of its source: 7 pi/24 (eq 23), 1 for qkqy
};

/// Null if there is none of this name.
const DragLaw* find_drag_law(const std::string& name);

/// "chien|..." for messages, without "none".
std::string drag_law_names();

/// The yield weight with which a sphere under this law rests where Beris et al. (1985) say: 4/(0.143 G(0)).
double beris_yield_weight(const DragLaw& law, const Rheology& fluid);

/// The weight c of the cross term with which the drag of a creeping sphere has the term 3 pi d^2 c24 sqrt(k (U/d)^n
/// tau0) under every law: c = c24 24/G(0), c24 = cross_coefficient(n).
double cross_yield_weight(const DragLaw& law, const Rheology& fluid);

} // namespace eccentra::closures
