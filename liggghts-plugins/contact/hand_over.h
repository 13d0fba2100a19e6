// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Weights with which a contact passes from a line to its ends. Pure functions.
#pragma once

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

/// Weights below this count as zero.
constexpr double no_weight = 1e-9;

/// x^(5/2), the energy of a Hertz spring without its stiffness.
inline double spring_energy(double overlap) {
  return overlap * overlap * std::sqrt(overlap);
}

/// Of the potential u_E prod_k (1 - q_k)^power, q_k = u_k / u_E: what the force of the line's spring counts, and what
/// those of the ends lose.
template <int ends, int power = 1> struct HandOver {
  double line = 1;        ///< what the force of the line counts [-]
  double loss[ends] = {}; ///< part of the forces of the ends that is lost [-]
  bool any = false;       ///< an end touches

  /// `overlap` of the line > 0; of the ends, <= 0 where they do not touch.
  HandOver(double overlap, const double (&end_overlap)[ends]) {
    double part[ends], keep[ends];
    for (int k = 0; k < ends; ++k) {
      part[k] = end_overlap[k] > 0 ? std::min(1., spring_energy(end_overlap[k] / overlap)) : 0;
      keep[k] = 1 - part[k];
      any |= part[k] > 0;
    }
    if (!any)
      return;
    for (int k = 0; k < ends; ++k)
      line *= power == 1 ? keep[k] : keep[k] * keep[k];
    for (int k = 0; k < ends; ++k) {
      if (part[k] == 0)
        continue;
      double others = power == 1 ? 1 : 2 * keep[k];
      for (int j = 0; j < ends; ++j)
        others *= j == k ? 1 : power == 1 ? keep[j] : keep[j] * keep[j];
      line += part[k] * others;
      loss[k] = others;
    }
  }
};

} // namespace eccentra::contact
