// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The loops that dense beds close from coupling step to coupling step, kept below one.
#include "flow/feedbackShares.H"

#include "PstreamReduceOps.H"

#include <algorithm>
#include <cmath>

namespace eccentra {

using namespace Foam;

namespace {

/// Beyond it an exponential is 0 in any case.
constexpr scalar kLargestExponent = 50;

} // namespace

scalar fractionShare(const feedbackLoad& load) {
  return std::min(1.0, 1.5 / (1.0 + 2.5 * load.displaced * load.follows));
}

scalar forceShare(const feedbackLoad& load) {
  const scalar s = load.follows, mass = load.displaced * load.lightness;
  return std::min(1.0, 1.7 / (1.0 + load.displaced * s + 2.0 * mass + 3.0 * mass * s * (1.0 - s)));
}

feedbackLoads::feedbackLoads(const scalarField& solid, const scalarField* drag, scalar density, scalar fluidDensity,
                             scalar elapsed)
    : solid_(solid), drag_(drag), density_(density), lightness_(fluidDensity / density), elapsed_(elapsed) {}

feedbackLoad feedbackLoads::of(label cell) const {
  const scalar solid = solid_[cell];
  feedbackLoad load;
  load.lightness = lightness_;
  if (solid < SMALL)
    return load;
  load.displaced = solid / (1.0 - solid);
  if (drag_)
    load.follows = -std::expm1(-std::min((*drag_)[cell] * elapsed_ / (solid * density_), kLargestExponent));
  return load;
}

scalar feedbackLoads::fraction() const {
  scalar least = 1;
  forAll(solid_, cell) least = std::min(least, fractionShare(of(cell)));
  reduce(least, minOp<scalar>());
  return least;
}

scalarField feedbackLoads::force() const {
  scalarField shares(solid_.size());
  forAll(shares, cell) shares[cell] = forceShare(of(cell));
  return shares;
}

} // namespace eccentra
