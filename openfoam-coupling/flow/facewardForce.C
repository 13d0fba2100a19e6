// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What leaves one cell through a face enters the other.
#include "flow/facewardForce.H"

#include "fvcSurfaceIntegrate.H"
#include "surfaceFields.H"
#include "surfaceInterpolate.H"
#include "zeroGradientFvPatchFields.H"

namespace Foam {

namespace {

/// Of the difference between two cells of equal size, the part that each takes over.
constexpr scalar part = 0.25;

} // namespace

tmp<volVectorField> facewardForce(const volVectorField& force) {
  const fvMesh& mesh = force.mesh();
  volScalarField perVolume(IOobject("perVolume", mesh.time().timeName(), mesh), mesh,
                           dimensionedScalar(dimless / dimVolume, Zero), zeroGradientFvPatchScalarField::typeName);
  perVolume.primitiveFieldRef() = 1.0 / mesh.V().field();
  perVolume.correctBoundaryConditions();
  const surfaceScalarField volume(part / fvc::interpolate(perVolume));
  surfaceVectorField moved(IOobject("moved", mesh.time().timeName(), mesh), mesh,
                           dimensionedVector(force.dimensions() * dimVolume, Zero));
  const auto move = [](const vector& area, const vector& difference, scalar amount) {
    return amount * area * ((area & difference) / magSqr(area));
  };
  const surfaceVectorField& Sf = mesh.Sf();
  const labelUList& owner = mesh.owner();
  const labelUList& neighbour = mesh.neighbour();
  forAll(owner, face) moved[face] = move(Sf[face], force[neighbour[face]] - force[owner[face]], volume[face]);
  forAll(force.boundaryField(), patchi) {
    const fvPatchVectorField& here = force.boundaryField()[patchi];
    if (here.coupled()) {
      const vectorField difference(here.patchNeighbourField() - here.patchInternalField());
      forAll(here, i) moved.boundaryFieldRef()[patchi][i] =
          move(Sf.boundaryField()[patchi][i], difference[i], volume.boundaryField()[patchi][i]);
    }
  }
  return force + fvc::surfaceIntegrate(moved);
}

} // namespace Foam
