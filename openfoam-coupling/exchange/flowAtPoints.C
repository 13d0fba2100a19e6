// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How each quantity of the flow is read at a point.
#include "exchange/flowAtPoints.H"

#include "exchange/particleExchange.H"

#include "fvcGrad.H"

#include <algorithm>

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// Value at a point: that of its cell, with the gradient there.
template <class Value, class Gradient>
Value linear(const Value& value, const Gradient& gradient, const vector& fromCentre) {
  return value + (fromCentre & gradient);
}

void put(const vector& v, double* values) {
  for (int k = 0; k < 3; ++k)
    values[k] = v[k];
}

/// One quantity: the derivatives of the velocity that it needs, and its values at a place.
struct PointQuantity {
  link::Quantity quantity;
  bool needsGradU;
  void (*read)(const flowAtPoints& flow, const flowAtPoints::Place& place, double* values);
};

/// In the order of the table of quantities.
constexpr PointQuantity kPointQuantities[] = {
    {link::kVelocity, false,
     [](const flowAtPoints&, const flowAtPoints::Place& place, double* values) { put(place.velocity, values); }},
    {link::kFraction, false,
     [](const flowAtPoints& flow, const flowAtPoints::Place& place, double* values) {
       *values = std::clamp(place.fraction, flow.fractionFloor(), 1.0);
     }},
    {link::kVorticity, true,
     [](const flowAtPoints& flow, const flowAtPoints::Place& place, double* values) {
       put(2.0 * (*skew(flow.gradU(place))), values);
     }},
    {link::kVelocityGradient, true,
     [](const flowAtPoints& flow, const flowAtPoints::Place& place, double* values) {
       const tensor gradient(flow.gradU(place)); // d u_c/d x_r: the other way round
       for (int r = 0; r < 3; ++r)
         for (int c = 0; c < 3; ++c)
           values[3 * r + c] = gradient(c, r);
     }},
    {link::kTurbulence, false,
     [](const flowAtPoints& flow, const flowAtPoints::Place& place, double* values) {
       values[0] = flow.turbulence(0)[place.cell];
       values[1] = flow.turbulence(1)[place.cell];
     }},
};

bool needsGradU(unsigned asked) {
  return std::any_of(std::begin(kPointQuantities), std::end(kPointQuantities),
                     [asked](const PointQuantity& row) { return row.needsGradU && (asked & row.quantity); });
}

} // namespace

unsigned flowAtPoints::offered() {
  unsigned all = 0;
  for (const PointQuantity& row : kPointQuantities)
    all |= row.quantity;
  return all;
}

flowAtPoints::flowAtPoints(const fvMesh& mesh, const FlowFields& flow, unsigned asked, double fractionFloor,
                           double minFraction, flowReading* reading, const touchedCells* touched)
    : mesh_(mesh), asked_(asked & offered()), fractionFloor_(fractionFloor), minFraction_(minFraction),
      fraction_(asked & (link::kVelocity | link::kFraction) ? flow.fraction : nullptr), turbulence_(flow.turbulence) {
  if (needsGradU(asked))
    gradU_ = fvc::grad(*flow.velocity);
  if (asked & link::kVelocity) {
    flux_ = fraction_ ? *fraction_ * *flow.velocity : tmp<volVectorField>(*flow.velocity);
    gradFlux_ = fvc::grad(flux_());
  }
  if (fraction_)
    gradFraction_ = fvc::grad(*fraction_);
  if (reading && (flux_.valid() || fraction_))
    readable_ = &reading->readable(flux_.valid() ? &flux_() : nullptr, gradFlux_.valid() ? &gradFlux_() : nullptr,
                                   fraction_, gradFraction_.valid() ? &gradFraction_() : nullptr, *touched);
}

flowAtPoints::Place flowAtPoints::placeOf(const ParticlePoint& centre, const PointShares* shares) const {
  const label cell = centre.at.cell;
  const point x(centre.at.position[0], centre.at.position[1], centre.at.position[2]);
  const vector fromCentre(centre.outside ? vector(Zero) : x - mesh_.cellCentres()[cell]);
  Bundled<kNarrow> read{};
  if (shares && readable_)
    vertexSharing::read(*shares, *readable_, read);
  Place place{cell, Zero, 1};
  if (fraction_)
    place.fraction =
        shares ? read.at[flowReading::kScalar] : linear((*fraction_)[cell], gradFraction_()[cell], fromCentre);
  if (flux_.valid()) {
    place.velocity =
        shares ? vector(read.at[0], read.at[1], read.at[2]) : linear(flux_()[cell], gradFlux_()[cell], fromCentre);
    if (fraction_)
      place.velocity /= std::max(place.fraction, minFraction_);
  }
  return place;
}

void flowAtPoints::read(const ParticlePoint& centre, const PointShares* shares, double* values) const {
  const Place place(placeOf(centre, shares));
  for (const PointQuantity& row : kPointQuantities)
    if (asked_ & row.quantity) {
      row.read(*this, place, values);
      values += link::columns_of(row.quantity);
    }
}

} // namespace eccentra::exchange
