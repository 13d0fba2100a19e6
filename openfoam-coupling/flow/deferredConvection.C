// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One diffusion coefficient per face, the same seen from both sides, so that nothing is lost between cells or ranks.
#include "flow/deferredConvection.H"

#include "fvMesh.H"

namespace Foam {

namespace {

/// The faces of a hexahedron share its time derivative.
const scalar facesPerCell = 6;

/// Coefficients of the wrong sign up to this many times the viscous one are left to the Krylov solver: what is deferred
/// takes further iterations, about as many as the Courant number where all of it is.
const scalar solvable = 100;

/// Excess of a coefficient of the wrong sign over what is there to outweigh it [m3/s].
scalar excess(scalar wrong, scalar viscous, scalar inertia) {
  return max(wrong - solvable * viscous - inertia / facesPerCell, scalar(0));
}

} // namespace

void deferCentralDifferences(fvVectorMatrix& convection, const volVectorField& U, const surfaceScalarField& nu) {
  const fvMesh& mesh = U.mesh();
  const surfaceScalarField& delta = mesh.nonOrthDeltaCoeffs();
  const scalar perStep = 1 / mesh.time().deltaTValue();

  if (!convection.asymmetric()) {
    return;
  }
  scalarField& upper = convection.upper();
  scalarField& lower = convection.lower();
  scalarField& diag = convection.diag();
  vectorField& source = convection.source();
  const scalarField& magSf = mesh.magSf().primitiveField();
  forAll(upper, facei) {
    const scalar conductance = magSf[facei] * delta[facei];
    const scalar added =
        excess(max(upper[facei], lower[facei]), nu[facei] * conductance, perStep * magSf[facei] / delta[facei]);
    if (added > 0) {
      const label own = mesh.owner()[facei], nei = mesh.neighbour()[facei];
      upper[facei] -= added;
      lower[facei] -= added;
      diag[own] += added;
      diag[nei] += added;
      const vector held = added * (U[own] - U[nei]);
      source[own] += held;
      source[nei] -= held;
    }
  }
  forAll(mesh.boundary(), patchi) {
    const fvPatch& patch = mesh.boundary()[patchi];
    if (!patch.coupled()) {
      continue;
    }
    vectorField& internal = convection.internalCoeffs()[patchi];
    vectorField& boundary = convection.boundaryCoeffs()[patchi];
    const vectorField difference(U.boundaryField()[patchi].patchInternalField() -
                                 U.boundaryField()[patchi].patchNeighbourField());
    const scalarField& area = patch.magSf();
    const scalarField& coeffs = delta.boundaryField()[patchi];
    const scalarField& viscosity = nu.boundaryField()[patchi];
    const labelUList& cells = patch.faceCells();
    forAll(cells, i) {
      // The coefficient of this cell in the row behind the patch is -internal: the flux leaves one and enters the
      // other.
      const scalar wrong = max(-cmptMin(boundary[i]), -cmptMin(internal[i]));
      const scalar added = excess(wrong, viscosity[i] * area[i] * coeffs[i], perStep * area[i] / coeffs[i]);
      internal[i] += added * vector::one;
      boundary[i] += added * vector::one;
      source[cells[i]] += added * difference[i];
    }
  }
}

} // namespace Foam
