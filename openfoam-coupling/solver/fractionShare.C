// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loop that dense beds in thick fluids close from meeting to meeting, kept below one.
#include "fractionShare.H"

#include "PstreamReduceOps.H"

#include <algorithm>
#include <cmath>

namespace eccentra {

using namespace Foam;

// Particles that the drag makes follow the fluid within one interval move the fluid again in the next one, the other
// way round: u_new = -r (3/2 u - 1/2 u_old) with r = s (1 - alpha)/alpha, s the part of the slip that drag takes away
// in an interval, and the second-order time scheme. In a dense bed in a thick fluid that grows. If the fluid learns
// only the share theta = 1.5/(1 + 2.5 r) of the new fraction, it halves at each meeting; where r < 0.2 it learns all.
scalar shareOfNewFraction(const scalarField& solid, const scalarField* drag, scalar density, scalar elapsed) {
  scalar most = 0;
  forAll(solid, cell) {
    if (solid[cell] < SMALL)
      continue;
    const scalar follows =
        drag ? -std::expm1(-std::min((*drag)[cell] * elapsed / (solid[cell] * density), scalar(50))) : 1.0;
    most = std::max(most, follows * solid[cell] / (1.0 - solid[cell]));
  }
  reduce(most, maxOp<scalar>());
  return std::min(1.0, 1.5 / (1.0 + 2.5 * most));
}

} // namespace eccentra
