// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of the contacts in a block, summed up for each pair of bodies; pure.
#pragma once

#include "contact/contact_law.h"

#include <algorithm>

namespace eccentra::contact {

/// On A of each pair, torque about its centre of mass [N, N m].
struct PairForces {
  /// One component of all pairs.
  using Row = double[ContactBlock::capacity + contact_width];
  /// [N] and [N m], world frame.
  Row force[3], torque[3];
};

/// Sums up contacts 0..n-1; `pair_of` tells the pair of each. One loop over all contacts: with one over the contacts of
/// each pair the processor would guess each one's end.
template <class Block>
inline void add_contact_forces(const Block& c, const int* pair_of, int n, PairForces& p, int pairs) {
  for (int k = 0; k < 3; ++k) {
    std::fill(p.force[k], p.force[k] + pairs, 0.);
    std::fill(p.torque[k], p.torque[k] + pairs, 0.);
  }
  for (int m = 0; m < n; ++m) {
    const int pair = pair_of[m];
    for (int k = 0; k < 3; ++k) {
      p.force[k][pair] += c.force[k][m];
      p.torque[k][pair] += c.torque[k][m];
    }
  }
}

} // namespace eccentra::contact
