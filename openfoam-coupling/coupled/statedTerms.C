// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what the handshake compares out of the case.
#include "coupled/statedTerms.H"

#include "rheology/yieldStressViscosity.H"

#include "uniformDimensionedFields.H"

namespace eccentra {

using namespace Foam;

link::FlowCurve statedRheology(const viscosityModel& model, scalar rho) {
  if (const auto* ours = dynamic_cast<const viscosityModels::yieldStressViscosity*>(&model)) {
    const rheology::HerschelBulkley& law = ours->kinematic();
    return {law.tau0 * rho, law.k * rho, law.n};
  }
  const dictionary& properties = model.viscosityProperties();
  const word type(properties.get<word>("transportModel"));
  const dictionary& coeffs = properties.optionalSubDict(type + "Coeffs");
  // Dimensions vary with the index: the number alone counts.
  const auto dynamic = [&](const char* keyword) {
    return rho * dimensionedScalar(keyword, coeffs.lookup(keyword)).value();
  };
  const auto index = [&] { return dimensionedScalar("n", dimless, coeffs).value(); };
  if (type == "Newtonian")
    return {0, rho * dimensionedScalar("nu", dimViscosity, properties).value(), 1};
  if (type == "powerLaw")
    return {0, dynamic("k"), index()};
  if (type == "HerschelBulkley")
    return {dynamic("tau0"), dynamic("k"), index()};
  Info << "transportModel " << type << " is no Herschel-Bulkley law: it is not compared with fix fluid/force" << endl;
  return {};
}

void stateGravity(const fvMesh& mesh, link::FluidTerms& terms) {
  const IOobject file("g", mesh.time().constant(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false);
  IOobject found(file);
  terms.has_gravity = found.typeHeaderOk<uniformDimensionedVectorField>(true);
  if (!terms.has_gravity)
    return;
  const vector g(uniformDimensionedVectorField(file).value());
  for (direction k = 0; k < vector::nComponents; ++k)
    terms.gravity[k] = g[k];
}

} // namespace eccentra
