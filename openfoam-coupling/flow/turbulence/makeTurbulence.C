// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Models of libDPMTurbulenceModels beside particles, of libincompressibleTurbulenceModels for the fluid alone.
#include "flow/turbulence/makeTurbulence.H"

#include "flow/fluidTransport.H"

#include "PhaseIncompressibleTurbulenceModel.H"
#include "singlePhaseTransportModel.H"
#include "turbulentTransportModel.H"

namespace Foam {

namespace {

/// The viscosity of the flow in the form that the models beside particles take.
class transportOfFlow : public singlePhaseTransportModel {
 public:
  transportOfFlow(const volVectorField& U, const surfaceScalarField& phi, const fluidTransport& flow)
      : singlePhaseTransportModel(U, phi), flow_(flow) {}
  tmp<volScalarField> nu() const override { return flow_.nu(); }
  tmp<scalarField> nu(const label patchi) const override { return flow_.nu(patchi); }
  void correct() override {}
  bool read() override { return true; }

 private:
  const fluidTransport& flow_;
};

class turbulenceBesideParticles : public flowTurbulence {
  using model_type = PhaseIncompressibleTurbulenceModel<singlePhaseTransportModel>;

 public:
  turbulenceBesideParticles(const volVectorField& U, const surfaceScalarField& phi, const fluidTransport& transport,
                            const volScalarField& alpha, const surfaceScalarField& alphaPhi)
      : transport_(U, phi, transport), model_(model_type::New(alpha, U, alphaPhi, phi, transport_)) {}
  turbulenceModel& model() override { return model_(); }
  const turbulenceModel& model() const override { return model_(); }

 private:
  const transportOfFlow transport_;
  autoPtr<model_type> model_;
};

class turbulenceOfFluid : public flowTurbulence {
 public:
  turbulenceOfFluid(const volVectorField& U, const surfaceScalarField& phi, const fluidTransport& transport)
      : model_(incompressible::turbulenceModel::New(U, phi, transport)) {}
  turbulenceModel& model() override { return model_(); }
  const turbulenceModel& model() const override { return model_(); }

 private:
  autoPtr<incompressible::turbulenceModel> model_;
};

} // namespace

} // namespace Foam

extern "C" Foam::flowTurbulence* eccentraMakeTurbulence(const Foam::volVectorField& U,
                                                        const Foam::surfaceScalarField& phi,
                                                        const Foam::fluidTransport& transport,
                                                        const Foam::volScalarField* alpha,
                                                        const Foam::surfaceScalarField* alphaPhi) {
  if (alpha) {
    return new Foam::turbulenceBesideParticles(U, phi, transport, *alpha, *alphaPhi);
  }
  return new Foam::turbulenceOfFluid(U, phi, transport);
}
