// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Registers the viscosity of the flow under the names that stock solvers use.
#include "flow/fluidTransport.H"

#include "turbulentTransportModel.H"

// Needs the models above.
#include "Stokes.H"

namespace Foam {

defineTypeNameAndDebug(fluidTransport, 0);

fluidTransport::fluidTransport(const volVectorField& U, const surfaceScalarField& phi)
    : IOdictionary(
          IOobject("transportProperties", U.time().constant(), U.db(), IOobject::MUST_READ, IOobject::NO_WRITE)),
      U_(U), phi_(phi), viscosity_(viscosityModel::New("nu", *this, U, phi)) {}

fluidTransport::~fluidTransport() = default;

void fluidTransport::offerStress() {
  if (stress_.valid() || U_.db().foundObject<turbulenceModel>(turbulenceModel::propertiesName)) {
    return;
  }
  using laminarFlow = laminarModels::Stokes<incompressible::turbulenceModel>;
  const word& wanted = turbulenceModel::propertiesName;
  // A model reads a dictionary of its name. A case without turbulenceProperties has transportProperties, of which the
  // model uses nothing; it gets its name afterwards.
  IOobject own(wanted, U_.time().constant(), U_.db(), IOobject::MUST_READ, IOobject::NO_WRITE, false);
  const bool present = own.typeHeaderOk<IOdictionary>(true);
  static const geometricOneField one;
  stress_.reset(new laminarFlow(one, one, U_, phi_, phi_, *this, present ? wanted : name()));
  if (!present) {
    stress_->rename(wanted);
  }
}

} // namespace Foam
