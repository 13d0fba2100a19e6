// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what the handshake compares out of the case.
#include "coupled/statedTerms.H"

#include "flow/flowMeasures.H"

#include "uniformDimensionedFields.H"

namespace eccentra {

using namespace Foam;

link::FlowCurve statedRheology(const viscosityModel& model, scalar rho) {
  const rheology::HerschelBulkley law = kinematicLaw(model);
  if (law.k > 0)
    return {law.tau0 * rho, law.k * rho, law.n};
  Info << "transportModel " << model.viscosityProperties().get<word>("transportModel")
       << " is no Herschel-Bulkley law: it is not compared with fix fluid/force" << endl;
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
