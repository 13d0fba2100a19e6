// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Turbulent flow through a duct that repeats itself along the flow, on meshes of one row of cells across it.
#pragma once

#include "flow/flow_case.h"

#include <string>

namespace eccentra::test {

/// tau = k rate^n, over the density [m2/s^(2-n)].
struct PowerLaw {
  double k, n;
};

class TurbulentCase {
 public:
  /// Model: kEpsilon, realizableKE or kOmegaSST, with the library's wall functions.
  TurbulentCase(const std::string& name, const std::string& model, const std::string& ddt = "Euler");

  /// Half of a plane channel [m]: wall and plane of symmetry, cells across it.
  void half_channel(double half_gap, int cells);
  /// Wedge of five degrees of a pipe or, with an inner radius above 0, of a concentric annulus [m].
  void wedge(double inner, double outer, int cells);
  /// Annulus of 24.13 and 63.5 mm.
  void annulus(double eccentricity, int radial, int around);
  /// Mean velocity of alpha U [m/s] of a fluid of density 1000 kg/m3. `diameter` [m] sets the first guess of the length
  /// scale.
  void fluid(const PowerLaw& law, double velocity, double diameter);
  /// Fraction of the fluid everywhere; before the first step.
  void fraction(double alpha);

  /// Long steps until the gradient changes by less than 1e-6 in one; returns the gradient over the density [m/s2].
  double gradient();

  FlowCase& flow_case() { return case_; }
  Foam::averagedFlow& flow();

 private:
  void mesh(const std::string& body);
  void numerics(const std::string& ddt);

  FlowCase case_;
  std::string model_;
  std::string along_ = "(1 0 0)";
  double alpha_ = 1;
};

/// Fanning's friction factor G D/(2 U^2).
double friction(double gradient, double diameter, double velocity);

/// Prandtl's law of smooth pipes: 1/sqrt f = 4 log10(Re sqrt f) - 0.4.
double prandtl(double Reynolds);

/// Dodge and Metzner (1959): 1/sqrt f = 4 n^-0.75 log10(Re f^(1-n/2)) - 0.4 n^-1.2.
double dodge_metzner(double Reynolds, double n);

} // namespace eccentra::test
