// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One time step of the locally averaged equations: momentum predictor, consistent pressure corrections, what is held
// back.
#include "flow/averagedFlow.H"

#include "flow/caseFiles.H"
#include "flow/deferredConvection.H"
#include "flow/extrapolatedVelocity.H"
#include "flow/facewardForce.H"
#include "flow/flowTurbulence.H"

#include "adjustPhi.H"
#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "fvcCurl.H"
#include "fvcDdt.H"
#include "fvcDiv.H"
#include "fvcFlux.H"
#include "fvcGrad.H"
#include "fvcLaplacian.H"
#include "fvcMeshPhi.H"
#include "fvcReconstruct.H"
#include "fvcSnGrad.H"
#include "fvcSurfaceIntegrate.H"
#include "fvmDdt.H"
#include "fvmDiv.H"
#include "fvmLaplacian.H"
#include "fvmSup.H"
#include "rheology/yieldStressViscosity.H"
#include "support/inputError.H"
#include "support/rankSums.H"
#include "turbulenceModel.H"
#include "wallFvPatch.H"
#include "zeroGradientFvPatchFields.H"

#include <chrono>

namespace Foam {

namespace {

// The names under which stock pimpleFoam looks its schemes up: one fvSchemes serves both solvers.
const char* const convectionScheme = "div(phi,U)";
const char* const diffusionScheme = "laplacian(nuEff,U)";
const char* const transposedStressScheme = "div((nuEff*dev2(T(grad(U)))))";
const char* const secondOrderTime = "backward";

// A solid volume that changes by more than this share of the section within one step is no round-off.
const scalar solidVolumeTolerance = 1e-8;

// Guards the division only: see correctPressure.
const scalar minRowSum = 1e-12;

// Part of what is held back that returns in one step, at least.
const scalar minReturned = 0.02;

// No incompressible flow is faster [m/s]: sound in water travels at 1500 m/s.
const scalar fastestFlow = 1e4;

/// Adds the seconds of its life to a sum.
class stopwatch {
 public:
  explicit stopwatch(scalar& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
  ~stopwatch() { sum_ += std::chrono::duration<scalar>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  scalar& sum_;
  const std::chrono::steady_clock::time_point start_;
};

IOobject input(const char* name, const fvMesh& mesh) {
  return IOobject(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
}

IOobject state(const char* name, const fvMesh& mesh) {
  return IOobject(name, mesh.time().timeName(), mesh, IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE);
}

IOobject scratch(const char* name, const fvMesh& mesh) {
  return IOobject(name, mesh.time().timeName(), mesh);
}

scalar readDensity(const dictionary& transportProperties) {
  const dimensionedScalar rho("rho", dimDensity, transportProperties);
  if (!(rho.value() > 0)) {
    throw inputError(transportProperties, "rho", rho.value(), "give the density of the fluid, above 0 kg/m3");
  }
  return rho.value();
}

/// Gives the field both old levels, so that the second-order scheme finds them and a restart writes them.
template <class Field> void keepOldTimes(const Field& field) {
  field.oldTime().oldTime();
}

} // namespace

averagedFlow::coupledFields::coupledFields(const fvMesh& mesh, const surfaceScalarField& phi)
    : alpha(state("alpha", mesh), mesh, dimensionedScalar("initial", dimless, 1),
            zeroGradientFvPatchScalarField::typeName),
      exchange(scratch("exchange", mesh), mesh, dimensionedScalar("initial", dimless / dimTime, 0),
               zeroGradientFvPatchScalarField::typeName),
      particleForce(scratch("particleForce", mesh), mesh, dimensionedVector(dimAcceleration, Zero),
                    zeroGradientFvPatchVectorField::typeName),
      facesForce("facesForce", particleForce),
      withheld(state("withheldForce", mesh), mesh, dimensionedVector(dimAcceleration, Zero),
               zeroGradientFvPatchVectorField::typeName),
      returned(mesh.nCells(), Zero), alphaf("alphaf", fvc::interpolate(alpha)), alphaPhi("alphaPhi", alphaf * phi),
      imbalance(scratch("imbalance", mesh), mesh, dimensionedScalar("initial", dimless / dimTime, 0)) {
  keepOldTimes(alpha);
}

averagedFlow::averagedFlow(fvMesh& mesh, particles presence, stressShare share)
    : mesh_(mesh), pimple_(mesh), share_(share), U_(input("U", mesh), mesh), p_(input("p", mesh), mesh),
      phi_(state("phi", mesh), fvc::flux(U_)),
      coupled_(presence == particles::coupled ? new coupledFields(mesh, phi_) : nullptr), transport_(U_, phi_),
      turbulence_(flowTurbulence::New(U_, phi_, transport_, coupled_.valid() ? &coupled_->alpha : nullptr,
                                      coupled_.valid() ? &coupled_->alphaPhi : nullptr)),
      rho_(readDensity(transport_)), drive_(mesh, rho_) {
  const word where = transport_.getOrDefault<word>("faceViscosity", "strainRate");
  if (where != "strainRate" && where != "interpolated") {
    throw inputError(transport_, "faceViscosity", where, "give strainRate or interpolated");
  }
  if (where == "strainRate") {
    faceLaw_ = dynamic_cast<const viscosityModels::yieldStressViscosity*>(&rheology());
  }
  // The eddy viscosity of the end of a step does not follow from a velocity.
  extrapolates_ = faceLaw_ && !turbulence_.valid() && word(mesh_.ddtScheme("ddt(U)")) == secondOrderTime;
  keepOldTimes(U_);
  if (extrapolates_) {
    keepOldTimes(U_.oldTime());
  }
  keepOldTimes(phi_);
  mesh_.setFluxRequired(p_.name());
  checkBoundaryTypes(U_, p_);
  checkStatedDensities(mesh_.time(), rho_);
  offerLookups();
  if (p_.needReference()) {
    // The level of the pressure is arbitrary here; one cell of the whole mesh fixes it.
    pRefCell_ = Pstream::master() ? pimple_.dict().getOrDefault<label>("pRefCell", 0) : -1;
    pRefValue_ = pimple_.dict().getOrDefault<scalar>("pRefValue", 0);
  }
}

averagedFlow::~averagedFlow() = default;

const turbulenceModel* averagedFlow::turbulence() const {
  return turbulence_.valid() ? &turbulence_->model() : nullptr;
}

tmp<scalarField> averagedFlow::nuEff(label patchi) const {
  tmp<scalarField> nu(new scalarField(rheology().nu(patchi)));
  if (turbulence_.valid()) {
    nu.ref() += turbulence_->model().nut(patchi);
  }
  return nu;
}

void averagedFlow::offerLookups() {
  forAll(U_.boundaryField(), patchi) {
    const word& U = U_.boundaryField()[patchi].type();
    if (U == "interstitialInletVelocity" && !coupled_.valid() && !noParticles_.valid()) {
      noParticles_.reset(new volScalarField(scratch("alpha", mesh_), mesh_, dimensionedScalar("one", dimless, 1),
                                            zeroGradientFvPatchScalarField::typeName));
    }
    if (U == "fixedShearStress" || p_.boundaryField()[patchi].type() == "porousBafflePressure") {
      transport_.offerStress();
    }
  }
  const dictionary* const functions = mesh_.time().controlDict().findDict("functions");
  if (functions && !functions->empty()) {
    transport_.offerStress();
  }
}

averagedFlow::coupledFields& averagedFlow::fields(const char* what) {
  return const_cast<coupledFields&>(static_cast<const averagedFlow&>(*this).fields(what));
}

const averagedFlow::coupledFields& averagedFlow::fields(const char* what) const {
  if (!coupled_.valid()) {
    throw inputError(std::string("a single-phase flow has no ") + what + ": construct it with particles::coupled");
  }
  return coupled_();
}

volScalarField& averagedFlow::alpha() {
  return fields("fluid fraction").alpha;
}
volVectorField& averagedFlow::particleForce() {
  return fields("particle force").particleForce;
}
volScalarField& averagedFlow::exchange() {
  return fields("exchange coefficient").exchange;
}
const volVectorField& averagedFlow::withheldForce() const {
  return fields("withheld force").withheld;
}

void averagedFlow::takeBack(const vectorField& force) {
  volVectorField& withheld = fields("withheld force").withheld;
  withheld.primitiveFieldRef() += force;
  withheld.correctBoundaryConditions();
}

void averagedFlow::resetFractionHistory() {
  volScalarField& present = alpha();
  present.correctBoundaryConditions();
  present.oldTime() == present;
  present.oldTime().oldTime() == present;
  coupled_->alphaf = fvc::interpolate(present);
  coupled_->alphaPhi = coupled_->alphaf * phi_;
}

void averagedFlow::resume(scalar G) {
  drive_.resume(G);
  transport_.correct();
  if (coupled_.valid()) {
    coupled_->alphaf = fvc::interpolate(coupled_->alpha);
    coupled_->alphaPhi = coupled_->alphaf * phi_;
  }
}

void averagedFlow::advance() {
  drive_.update();
  residualAt_ = -1;
  offerLookups(); // function objects may come during a run
  if (coupled_.valid()) {
    checkSolidVolume();
    coupled_->alphaf = fvc::interpolate(coupled_->alpha);
    coupled_->facesForce == facewardForce(coupled_->particleForce);
    chooseReturned();
  }
  convergence_.beginStep();
  label outerCorrectors = 0;
  scalar fastest = 0;
  while (pimple_.loop()) {
    ++outerCorrectors;
    tmp<fvVectorMatrix> tUEqn = momentumMatrix(extrapolates_ && pimple_.firstIter());
    fvVectorMatrix& UEqn = tUEqn.ref();
    UEqn.relax();
    predictVelocity(UEqn);
    while (pimple_.correct()) {
      correctPressure(UEqn);
    }
    drive_.correct(U_, coupled_.valid() ? &coupled_->alpha : nullptr);
    fastest = gMax(mag(U_.primitiveField())());
    refuseBlowUp(fastest < fastestFlow);
    if (pimple_.turbCorr()) {
      const stopwatch watch(cost_.rheology);
      transport_.correct();
      if (turbulence_.valid()) {
        turbulence_->model().correct();
      }
    }
  }
  convergence_.endStep(outerCorrectors, pimple_.dict(), fastest);
  if (coupled_.valid()) {
    storeWithheldForce();
  }
}

void averagedFlow::refuseBlowUp(bool bounded) const {
  if (!bounded) {
    throw inputError("the flow has blown up at t = " + mesh_.time().timeName() + " s (Courant number " +
                     std::to_string(CourantNo()) +
                     "): reduce deltaT, give PIMPLE consistent yes, or a bounded scheme " + "for " + convectionScheme);
  }
}

void averagedFlow::checkSolidVolume() const {
  if (!p_.needReference()) {
    return;
  }
  const scalarField& V = mesh_.V().field();
  std::array<double, 2> sums{sum(fvc::ddt(coupled_->alpha)().primitiveField() * V), sum(V)};
  eccentra::exchange::sumOverRanks(sums);
  const scalar change = sums[0] * mesh_.time().deltaTValue() / sums[1];
  if (mag(change) > solidVolumeTolerance) {
    std::ostringstream text;
    text
        << "the fluid fraction of a closed or periodic section changed by " << change
        << " of its volume in one step, at t = " << mesh_.time().timeName()
        << " s: an incompressible fluid cannot make room; keep the volume of the particles constant or open a boundary";
    throw solidVolumeError(text.str());
  }
}

tmp<surfaceScalarField> averagedFlow::faceViscosity(const volVectorField& U, const volTensorField& gradU) const {
  if (faceLaw_) {
    return faceLaw_->faceNu(U, gradU);
  }
  return fvc::interpolate(rheology().nu(), "interpolate(nuEff)");
}

tmp<volVectorField> averagedFlow::transposedStress(const surfaceScalarField& nu, const volTensorField& gradU) const {
  if (faceLaw_) {
    return fvc::div(nu * fvc::dotInterpolate(mesh_.Sf(), dev2(T(gradU))));
  }
  return fvc::div(rheology().nu() * dev2(T(gradU)), transposedStressScheme);
}

tmp<fvVectorMatrix> averagedFlow::convection(const surfaceScalarField& flux, const surfaceScalarField& nu) {
  tmp<fvVectorMatrix> matrix = fvm::div(flux, U_, convectionScheme);
  if (CourantNo() > 1) {
    deferCentralDifferences(matrix.ref(), U_, nu);
  }
  return matrix;
}

void averagedFlow::addReynoldsStress(fvVectorMatrix& matrix, const surfaceScalarField& nut,
                                     const volTensorField& gradU) const {
  const tmp<surfaceScalarField> share(coupled_.valid() ? coupled_->alphaf * nut : tmp<surfaceScalarField>(nut));
  matrix -= fvm::laplacian(share(), U_, diffusionScheme);
  matrix -= fvc::div(share() * fvc::dotInterpolate(mesh_.Sf(), dev2(T(gradU))));
}

tmp<fvVectorMatrix> averagedFlow::momentumMatrix(bool ahead) {
  const stopwatch watch(cost_.momentum);
  const tmp<volVectorField> U = ahead ? extrapolatedVelocity(U_) : tmp<volVectorField>(U_);
  const tmp<volTensorField> gradU = fvc::grad(U(), "grad(U)");
  tmp<surfaceScalarField> nu = faceViscosity(U(), gradU());
  tmp<fvVectorMatrix> stress(-fvm::laplacian(nu(), U_, diffusionScheme) - transposedStress(nu(), gradU()));
  if (coupled_.valid() && share_ == stressShare::fraction) {
    stress.ref() *= coupled_->alpha;
  }
  if (turbulence_.valid()) {
    const surfaceScalarField nut(fvc::interpolate(turbulence_->model().nut(), "interpolate(nuEff)"));
    addReynoldsStress(stress.ref(), nut, gradU());
    nu = nu + nut;
  }
  tmp<fvVectorMatrix> tUEqn;
  if (!coupled_.valid()) {
    tUEqn = fvm::ddt(U_) + convection(phi_, nu()) + stress;
    if (drive_.active()) {
      tUEqn.ref() -= drive_.acceleration();
    }
  } else {
    coupledFields& c = coupled_();
    c.alphaPhi = c.alphaf * phi_;
    c.imbalance = (fvc::ddt(c.alpha) + fvc::div(c.alphaPhi))()();
    tUEqn = fvm::ddt(c.alpha, U_) + convection(c.alphaPhi, nu()) - fvm::Sp(c.imbalance, U_) + fvm::Sp(c.exchange, U_) +
            stress;
    const scalarField& V = mesh_.V().field();
    const vectorField& Uold = U_.oldTime().primitiveField();
    const scalarField& alpha = c.alpha.primitiveField();
    const vector G = drive_.acceleration().value();
    vectorField& source = tUEqn.ref().source();
    forAll(source, celli) {
      source[celli] +=
          V[celli] * (c.facesForce[celli] + c.returned[celli] + c.exchange[celli] * Uold[celli] + alpha[celli] * G);
    }
  }
  return tUEqn;
}

void averagedFlow::predictVelocity(fvVectorMatrix& UEqn) {
  const stopwatch watch(cost_.momentum);
  const volScalarField* alpha = coupled_.valid() ? &coupled_->alpha : nullptr;
  drive_.solveResponse(UEqn, alpha);
  if (!pimple_.momentumPredictor()) {
    return;
  }
  if (alpha) {
    convergence_.solved(solve(UEqn == -(*alpha) * fvc::grad(p_)));
  } else {
    convergence_.solved(solve(UEqn == -fvc::grad(p_)));
  }
  const vector dG = drive_.correct(U_, alpha) * drive_.axis();
  if (alpha) {
    UEqn.source() += dG * (mesh_.V().field() * alpha->primitiveField());
  } else {
    UEqn.source() += dG * mesh_.V().field();
  }
}

void averagedFlow::correctPressure(fvVectorMatrix& UEqn) {
  const stopwatch watch(cost_.pressure);
  coupledFields* const c = coupled_.valid() ? &coupled_() : nullptr;
  tmp<volScalarField> A = UEqn.A();
  refuseBlowUp(gMin(A().primitiveField()) > 0);
  const volScalarField rAU("rAU", 1.0 / A);
  volVectorField HbyA(constrainHbyA(rAU * UEqn.H(), U_, p_));
  surfaceScalarField phiHbyA("phiHbyA", fvc::flux(HbyA));
  {
    tmp<surfaceScalarField> history = fvc::interpolate(rAU) * fvc::ddtCorr(U_, phi_);
    if (c) {
      history.ref() *= c->alphaf;
    }
    phiHbyA += history;
  }
  if (c) {
    // The faces see the force itself, of which the cells have the means.
    phiHbyA += fvc::interpolate(rAU) * fvc::flux(c->particleForce - c->facesForce);
  }
  if (!c && p_.needReference()) {
    adjustPhi(phiHbyA, U_, p_);
  }

  // rAtU: response of U to -grad p (model A: times alpha), of the whole row if consistent.
  tmp<volScalarField> rAtU(rAU);
  if (pimple_.consistent()) {
    // The stock solvers never let the row sum A - H1 fall below A/10. Where viscosity makes A large (an unyielded plug)
    // that understates the response to the pressure, and the scheme diverges at any time step above some 10 dx^2/nu.
    rAtU = 1.0 / max(1.0 / rAU - UEqn.H1(), minRowSum / rAU);
    tmp<surfaceScalarField> shift = fvc::interpolate(rAtU() - rAU) * fvc::snGrad(p_) * mesh_.magSf();
    if (c) {
      HbyA -= (rAU - rAtU()) * c->alpha * fvc::grad(p_);
      shift.ref() *= c->alphaf;
    } else {
      HbyA -= (rAU - rAtU()) * fvc::grad(p_);
    }
    phiHbyA += shift;
  }
  if (c) {
    rAtU = tmp<volScalarField>(new volScalarField("rAtU", rAtU() * c->alpha));
  }
  constrainPressure(p_, U_, phiHbyA, rAtU());

  tmp<volScalarField::Internal> rate;
  if (c) {
    // A copy: what ddt returns does not live beyond this line.
    rate = tmp<volScalarField::Internal>(new volScalarField::Internal(fvc::ddt(c->alpha)()()));
  }
  while (pimple_.correctNonOrthogonal()) {
    tmp<fvScalarMatrix> tpEqn;
    if (c) {
      tpEqn = fvm::laplacian(c->alphaf * fvc::interpolate(rAtU()), p_) == rate() + fvc::div(c->alphaf * phiHbyA)()();
    } else {
      tpEqn = fvm::laplacian(rAtU(), p_) == fvc::div(phiHbyA);
    }
    fvScalarMatrix& pEqn = tpEqn.ref();
    pEqn.setReference(pRefCell_, pRefValue_);
    convergence_.solved(pEqn.solve(mesh_.solver(p_.select(pimple_.finalInnerIter()))));
    if (pimple_.finalNonOrthogonalIter()) {
      if (c) {
        c->alphaPhi = c->alphaf * phiHbyA - pEqn.flux();
        phi_ = c->alphaPhi / c->alphaf;
      } else {
        phi_ = phiHbyA - pEqn.flux();
      }
    }
  }
  p_.relax();
  U_ = HbyA - rAtU * fvc::grad(p_);
  U_.correctBoundaryConditions();
}

// Particles on the springs of their contacts and the fluid that drag ties to them swing together. What comes back late
// drives that swing where the fluid is light beside the drag of one step; there it comes back slowly, and the drag of a
// step, which is all that is ever on its way, is hardly missed.
void averagedFlow::chooseReturned() {
  coupledFields& c = coupled_();
  const scalar dt = mesh_.time().deltaTValue();
  // What was held back is an impulse: a force of the last step's length.
  c.withheld.primitiveFieldRef() *= mesh_.time().deltaT0Value() / dt;
  forAll(c.withheld, celli) {
    const scalar tied = c.exchange[celli] * dt / c.alpha[celli];
    c.returned[celli] = max(minReturned, 1 / max(scalar(1), sqr(tied))) * c.withheld[celli];
  }
}

void averagedFlow::storeWithheldForce() {
  coupledFields& c = coupled_();
  const vectorField& Uold = U_.oldTime().primitiveField();
  forAll(c.withheld, celli) {
    c.withheld[celli] +=
        c.exchange[celli] * (U_[celli] - Uold[celli]) - c.imbalance[celli] * U_[celli] - c.returned[celli];
  }
  c.withheld.correctBoundaryConditions();
}

tmp<volVectorField> averagedFlow::pressureGradient() const {
  tmp<volVectorField> gradient(fvc::grad(p_));
  gradient.ref() -= drive_.acceleration();
  return dimensionedScalar("rho", dimDensity, rho_) * gradient;
}

tmp<volVectorField> averagedFlow::velocityOfFluxes() const {
  const coupledFields& c = fields("fluid fraction");
  tmp<volVectorField> U(new volVectorField(scratch("velocityOfFluxes", mesh_), U_));
  U.ref().primitiveFieldRef() = fvc::reconstruct(c.alphaPhi)().primitiveField() / c.alpha.primitiveField();
  U.ref().correctBoundaryConditions();
  return U;
}

tmp<volVectorField> averagedFlow::vorticity() const {
  return fvc::curl(U_);
}

tmp<volVectorField> averagedFlow::stressDivergence() const {
  const tmp<volTensorField> gradU = fvc::grad(U_);
  const tmp<surfaceScalarField> nu = faceViscosity(U_, gradU());
  return dimensionedScalar("rho", dimDensity, rho_) *
         (fvc::laplacian(nu(), U_, diffusionScheme) + transposedStress(nu(), gradU()));
}

scalar averagedFlow::momentumResidual() {
  // A run-in sets the time back: advance() tells that there is a new step.
  if (residualAt_ >= 0) {
    return residual_;
  }
  residualAt_ = mesh_.time().timeIndex();
  const scalarField& V = mesh_.V().field();
  vectorField pressure(fvc::grad(p_)().primitiveField() * V);
  vectorField inertia;
  if (coupled_.valid()) {
    pressure *= coupled_->alpha.primitiveField();
    inertia = fvc::ddt(coupled_->alpha, U_)().primitiveField() * V;
  } else {
    inertia = fvc::ddt(U_)().primitiveField() * V;
  }
  // fvMatrix::residual counts coupled patches twice.
  const autoPtr<surfaceScalarField> alphaPhi(coupled_.valid() ? new surfaceScalarField(coupled_->alphaPhi) : nullptr);
  const tmp<fvVectorMatrix> matrix = momentumMatrix(false);
  const vectorField missing(
      V * (matrix->H()().primitiveField() - matrix->A()().primitiveField() * U_.primitiveField()) - pressure);
  pressure -= drive_.acceleration().value() * V;
  const tmp<volTensorField> gradU = fvc::grad(U_, "grad(U)");
  scalar walls = 0;
  forAll(mesh_.boundary(), patchi) {
    if (isA<wallFvPatch>(mesh_.boundary()[patchi])) {
      walls +=
          sum(mag(nuEff(patchi) * (mesh_.boundary()[patchi].Sf() & dev(twoSymm(gradU().boundaryField()[patchi])))));
    }
  }
  std::array<double, 4> sums{sum(mag(missing)), sum(mag(pressure)), sum(mag(inertia)), walls};
  eccentra::exchange::sumOverRanks(sums);
  const scalar largest = max(max(sums[1], sums[2]), sums[3]);
  residual_ = largest > VSMALL && convergence_.moving() ? sums[0] / largest : 0;
  unsteadiness_ = largest > VSMALL && convergence_.moving() ? sums[2] / largest : 0;
  // A look at the flow leaves it as it was: the fluxes to the last digit, and boundary conditions that are due.
  if (alphaPhi.valid()) {
    coupled_->alphaPhi = alphaPhi();
  }
  U_.correctBoundaryConditions();
  convergence_.measured(residual_);
  return residual_;
}

vector averagedFlow::superficialVelocity() const {
  const scalarField& V = mesh_.V().field();
  const vector flow =
      coupled_.valid() ? sum(U_.primitiveField() * coupled_->alpha.primitiveField() * V) : sum(U_.primitiveField() * V);
  std::array<double, 4> sums{flow.x(), flow.y(), flow.z(), sum(V)};
  eccentra::exchange::sumOverRanks(sums);
  return vector(sums[0], sums[1], sums[2]) / sums[3];
}

scalar averagedFlow::CourantNo() const {
  const scalarField fluxes(fvc::surfaceSum(mag(phi_))().primitiveField());
  return 0.5 * gMax((fluxes / mesh_.V().field())()) * mesh_.time().deltaTValue();
}

namespace {

scalarField massImbalance(const volScalarField* alpha, const surfaceScalarField& flux) {
  scalarField rate(fvc::div(flux)().primitiveField());
  if (alpha) {
    rate += fvc::ddt(*alpha)().primitiveField();
  }
  return rate;
}

} // namespace

scalar averagedFlow::continuityError() const {
  const scalarField rate(coupled_.valid() ? massImbalance(&coupled_->alpha, coupled_->alphaPhi)
                                          : massImbalance(nullptr, phi_));
  const scalarField& V = mesh_.V().field();
  return mesh_.time().deltaTValue() * gSum(mag(rate) * V) / gSum(V);
}

scalar averagedFlow::globalContinuityError() const {
  const scalarField rate(coupled_.valid() ? massImbalance(&coupled_->alpha, coupled_->alphaPhi)
                                          : massImbalance(nullptr, phi_));
  const scalarField& V = mesh_.V().field();
  return mesh_.time().deltaTValue() * gSum(rate * V) / gSum(V);
}

} // namespace Foam
