// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads Herschel-Bulkley coefficients and keeps the viscosity field.
#include "rheology/yieldStressViscosity.H"

#include "calculatedFvPatchFields.H"
#include "fvcGrad.H"
#include "surfaceFields.H"

namespace Foam {
namespace viscosityModels {

namespace {

/// A coefficient that must exceed `above` (or equal it if `orEqual`), or one sentence.
scalar readAbove(const dictionary& coeffs, const word& keyword, scalar above, bool orEqual = false) {
  const scalar value = coeffs.get<scalar>(keyword);
  const bool valid = value > above || (orEqual && value == above);
  if (!valid || !std::isfinite(value)) {
    FatalIOErrorInFunction(coeffs) << keyword << " is " << value << ": give a number "
                                   << (orEqual ? "not below " : "above ") << above << exit(FatalIOError);
  }
  return value;
}

} // namespace

yieldStressViscosity::yieldStressViscosity(const word& name, const word& type, const dictionary& transportProperties,
                                           const volVectorField& U, const surfaceScalarField& phi)
    : viscosityModel(name, transportProperties, U, phi), type_(type),
      nu_(IOobject(name, U.time().timeName(), U.db(), IOobject::NO_READ, IOobject::AUTO_WRITE), U.mesh(),
          dimensionedScalar("initial", dimViscosity, 0), calculatedFvPatchScalarField::typeName) {
  readCoefficients(transportProperties);
}

void yieldStressViscosity::readCoefficients(const dictionary& transportProperties) {
  const dictionary& coeffs = transportProperties.optionalSubDict(type_ + "Coeffs");
  const scalar rho = dimensionedScalar("rho", dimDensity, transportProperties).value();
  if (!(rho > 0)) {
    FatalIOErrorInFunction(transportProperties)
        << "rho is " << rho << ": give the density of the fluid, above 0 kg/m3" << exit(FatalIOError);
  }
  kinematic_.tau0 = readAbove(coeffs, "tau0", 0, true) / rho;
  kinematic_.k = readAbove(coeffs, "k", 0) / rho;
  kinematic_.n = readAbove(coeffs, "n", 0);
  kinematic_.mu_y = readAbove(coeffs, "muY", 0) / rho;
  relaxation_ = coeffs.getOrDefault<scalar>("relaxation", 1);
  if (!(relaxation_ > 0 && relaxation_ <= 1)) {
    FatalIOErrorInFunction(coeffs) << "relaxation is " << relaxation_ << ": give a number above 0 and up to 1"
                                   << exit(FatalIOError);
  }
}

tmp<volScalarField> yieldStressViscosity::law() const {
  tmp<volScalarField> rate = strainRate();
  tmp<volScalarField> result(new volScalarField("law", rate * dimensionedScalar("1", dimViscosity * dimTime, 1)));
  evaluate(kinematic_, result.ref().primitiveFieldRef());
  forAll(result().boundaryField(), patchi) {
    evaluate(kinematic_, result.ref().boundaryFieldRef()[patchi]);
  }
  return result;
}

namespace {

/// Strain rate sqrt(2 D:D) of a face from the interpolated gradient and the compact derivative along the unit normal n.
scalar faceRate(tensor gradient, const vector& n, const vector& derivative) {
  gradient += n * (derivative - (n & gradient));
  return Foam::sqrt(2.0) * mag(symm(gradient));
}

} // namespace

tmp<surfaceScalarField> yieldStressViscosity::faceNu(const volVectorField& velocity,
                                                     const volTensorField& gradU) const {
  const fvMesh& mesh = U_.mesh();
  tmp<surfaceScalarField> result(new surfaceScalarField(IOobject("faceNu", U_.time().timeName(), mesh), mesh,
                                                        dimensionedScalar("initial", dimViscosity, 0)));
  scalarField& inner = result.ref().primitiveFieldRef();
  const scalarField& weights = mesh.weights().primitiveField();
  const scalarField& delta = mesh.nonOrthDeltaCoeffs().primitiveField();
  const vectorField& Sf = mesh.Sf().primitiveField();
  const scalarField& magSf = mesh.magSf().primitiveField();
  forAll(inner, facei) {
    const label own = mesh.owner()[facei], nei = mesh.neighbour()[facei];
    const tensor gradient = weights[facei] * gradU[own] + (1 - weights[facei]) * gradU[nei];
    inner[facei] = faceRate(gradient, Sf[facei] / magSf[facei], delta[facei] * (velocity[nei] - velocity[own]));
  }
  evaluate(kinematic_, inner);
  forAll(mesh.boundary(), patchi) {
    const fvPatch& patch = mesh.boundary()[patchi];
    scalarField& values = result.ref().boundaryFieldRef()[patchi];
    if (!patch.coupled()) {
      // The gradient of a boundary has the derivative to the wall already.
      values = Foam::sqrt(2.0) * mag(symm(gradU.boundaryField()[patchi]));
      evaluate(kinematic_, values);
      continue;
    }
    const tensorField gradient(patch.weights() * gradU.boundaryField()[patchi].patchInternalField() +
                               (1 - patch.weights()) * gradU.boundaryField()[patchi].patchNeighbourField());
    const fvPatchVectorField& U = velocity.boundaryField()[patchi];
    const vectorField derivative(patch.deltaCoeffs() * (U.patchNeighbourField() - U.patchInternalField()));
    const vectorField n(patch.nf());
    forAll(values, i) {
      values[i] = faceRate(gradient[i], n[i], derivative[i]);
    }
    evaluate(kinematic_, values);
  }
  return result;
}

void yieldStressViscosity::initialise() {
  nu_ = law();
}

void yieldStressViscosity::correct() {
  if (relaxation_ < 1) {
    const dimensionedScalar one("one", dimViscosity, 1);
    nu_ = one * pow(nu_ / one, 1 - relaxation_) * pow(law() / one, relaxation_);
  } else {
    nu_ = law();
  }
}

bool yieldStressViscosity::read(const dictionary& transportProperties) {
  viscosityModel::read(transportProperties);
  readCoefficients(transportProperties);
  return true;
}

} // namespace viscosityModels
} // namespace Foam
