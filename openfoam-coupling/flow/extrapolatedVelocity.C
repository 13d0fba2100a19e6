// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Linear extrapolation in time with a limiter per cell.
#include "flow/extrapolatedVelocity.H"

#include "Time.H"

namespace Foam {

namespace {

/// A change up to this many times as large as the one before it is extrapolated in full.
const scalar fullBelow = 2;

scalar limiter(const vector& change, const vector& before) {
  const scalar square = magSqr(change);
  return square > VSMALL ? min(max(fullBelow * (change & before) / square, scalar(0)), scalar(1)) : scalar(0);
}

} // namespace

tmp<volVectorField> extrapolatedVelocity(const volVectorField& U) {
  // After ++time, U is still the last solved level, and so is its first old one.
  const volVectorField& last = U.oldTime();
  const volVectorField& before = last.oldTime();
  const volVectorField& earliest = before.oldTime();
  const scalar steps = U.time().deltaTValue() / U.time().deltaT0Value();
  tmp<volVectorField> result(new volVectorField(
      IOobject("extrapolatedU", U.time().timeName(), U.db(), IOobject::NO_READ, IOobject::NO_WRITE, false),
      U.internalField(), U.boundaryField()));
  vectorField& values = result.ref().primitiveFieldRef();
  forAll(values, celli) {
    const vector change = last[celli] - before[celli];
    values[celli] += (steps * limiter(change, before[celli] - earliest[celli])) * change;
  }
  result.ref().correctBoundaryConditions();
  return result;
}

} // namespace Foam
