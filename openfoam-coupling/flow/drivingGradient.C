// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Imposes a mean velocity or a gradient on a periodic section.
#include "flow/drivingGradient.H"

#include "calculatedFvPatchFields.H"
#include "flow/periodicDirections.H"
#include "support/inputError.H"

#include "support/rankSums.H"

namespace Foam {

namespace {

direction componentOf(const dictionary& dict, const vector& axis) {
  for (direction c = 0; c < vector::nComponents; ++c) {
    vector unit(Zero);
    unit[c] = 1;
    if (mag(axis - unit) < SMALL) {
      return c;
    }
  }
  throw inputError(dict, "direction", axis, "give one of (1 0 0), (0 1 0), (0 0 1)");
}

/// The gradient acts on a section that repeats itself: across walls or ends the pressure would balance it.
void refuseClosedDirection(const dictionary& dict, const fvMesh& mesh, direction component, const vector& axis) {
  const Vector<label> periodic = periodicDirections(mesh);
  if (periodic[component]) {
    return;
  }
  std::string open;
  const char* const names[] = {"(1 0 0)", "(0 1 0)", "(0 0 1)"};
  for (direction c = 0; c < vector::nComponents; ++c) {
    if (periodic[c]) {
      open += std::string(open.empty() ? "" : " or ") + names[c];
    }
  }
  throw inputError(dict, "direction", axis,
                   "the mesh does not repeat itself in it; expected a direction with periodic ends, " +
                       (open.empty()
                            ? "of which this mesh has none: give drive { type none; } and let inlet and outlet "
                              "drive the flow, or make the mesh with ends periodic"
                            : "which is " + open));
}

/// Entries that this type of drive does not read.
void refuseUnreadEntries(const dictionary& dict, const word& type) {
  if (type == "meanVelocity") {
    refuseUnknownKeywords(dict, {"type", "Ubar", "UbarCoeffs", "direction", "initialGradient"});
  } else {
    refuseUnknownKeywords(dict, {"type", "gradient", "gradientCoeffs", "direction"});
  }
}

IOobject flowProperties(const fvMesh& mesh) {
  return IOobject("flowProperties", mesh.time().constant(), mesh, IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false);
}

} // namespace

drivingGradient::drivingGradient(const fvMesh& mesh, scalar rho)
    : mesh_(mesh), rho_(rho), state_(IOobject("drivingGradient", mesh.time().timeName(), "uniform", mesh,
                                              IOobject::READ_IF_PRESENT, IOobject::NO_WRITE)) {
  const IOdictionary properties(flowProperties(mesh));
  refuseUnknownKeywords(properties, {"drive", "report"});
  if (!properties.found("drive")) {
    return;
  }
  const dictionary& dict = properties.subDict("drive");
  const word name = dict.get<word>("type");
  if (name == "none") {
    return;
  }
  axis_ = dict.getOrDefault<vector>("direction", axis_);
  component_ = componentOf(dict, axis_);
  if (name == "meanVelocity" || name == "pressureGradient") {
    refuseUnreadEntries(dict, name);
    refuseClosedDirection(dict, mesh, component_, axis_);
  }
  if (name == "meanVelocity") {
    type_ = type::meanVelocity;
    value_ = Function1<scalar>::New("Ubar", dict);
    G_ = dict.getOrDefault<scalar>("initialGradient", 0) / rho_;
  } else if (name == "pressureGradient") {
    type_ = type::pressureGradient;
    value_ = Function1<scalar>::New("gradient", dict);
    update();
  } else {
    throw inputError(dict, "type", name, "give meanVelocity, pressureGradient or none");
  }
  if (controlsVelocity()) {
    G_ = state_.getOrDefault<scalar>("gradient", G_ * rho_) / rho_;
    response_.reset(new volScalarField(
        IOobject("driveResponse", mesh.time().timeName(), mesh, IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE), mesh,
        dimensionedScalar("initial", dimTime, 0), calculatedFvPatchScalarField::typeName));
    state_.writeOpt() = IOobject::AUTO_WRITE;
  }
}

void drivingGradient::update() {
  if (type_ == type::pressureGradient) {
    G_ = value_->value(mesh_.time().timeOutputValue()) / rho_;
  }
}

void drivingGradient::resume(scalar G) {
  G_ = G;
  state_.set("gradient", G_ * rho_);
}

scalar drivingGradient::target() const {
  return value_->value(mesh_.time().timeOutputValue());
}

void drivingGradient::solveResponse(const fvVectorMatrix& UEqn, const volScalarField* alpha) {
  if (!controlsVelocity()) {
    return;
  }
  fvScalarMatrix response(response_(), dimVolume);
  response.diag() = UEqn.diag();
  response.upper() = UEqn.upper();
  if (UEqn.asymmetric()) {
    response.lower() = UEqn.lower();
  }
  // The response vanishes where the velocity is fixed: of the boundary, only coupled patches contribute to the source.
  forAll(UEqn.internalCoeffs(), patchi) {
    response.internalCoeffs()[patchi] = UEqn.internalCoeffs()[patchi].component(component_);
    if (mesh_.boundary()[patchi].coupled()) {
      response.boundaryCoeffs()[patchi] = UEqn.boundaryCoeffs()[patchi].component(component_);
    }
  }
  response.source() = mesh_.V().field();
  if (alpha) {
    response.source() *= alpha->primitiveField();
  }
  response.solve(mesh_.solver(UEqn.psi().name()));
}

scalar drivingGradient::correct(volVectorField& U, const volScalarField* alpha) {
  if (!controlsVelocity()) {
    return 0;
  }
  const scalarField& w = response_->primitiveField();
  // Volume, and integrals of response and velocity of the fluid, in one sum over the ranks.
  std::array<double, 3> sums{};
  const scalarField& V = mesh_.V().field();
  forAll(w, celli) {
    const scalar fluid = alpha ? (*alpha)[celli] * V[celli] : V[celli];
    sums[0] += V[celli];
    sums[1] += fluid * w[celli];
    sums[2] += fluid * U[celli][component_];
  }
  eccentra::exchange::sumOverRanks(sums);
  const scalar dG = (target() * sums[0] - sums[2]) / sums[1];
  U.primitiveFieldRef() += (dG * axis_) * w;
  U.correctBoundaryConditions();
  G_ += dG;
  state_.set("gradient", G_ * rho_);
  return dG;
}

} // namespace Foam
