// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix uses the orthogonal part of the face gradient only: symmetric, and no new extrema.
#include "conservativeDiffusion.H"

#include "fvm.H"
#include "gaussLaplacianScheme.H"
#include "zeroGradientFvPatchFields.H"

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// One implicit step over T spreads with variance 2 T per direction; a length l stands for T = l^2/4.
constexpr double kStepPerSquaredLength = 0.25;
/// What cells of size h spread by themselves, as a variance 2 T: vertexSharing 0.25 to 0.5 h^2, on the average over a
/// cubic cell 0.317 h^2, and a cell over its own width h^2/12.
constexpr double kStepPerSquaredCell = 0.2;
constexpr label kMostIterations = 1000;

} // namespace

conservativeDiffusion::conservativeDiffusion(const fvMesh& mesh, double length, int steps, double tolerance)
    : mesh_(mesh), steps_(steps),
      helper_(IOobject("spread", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh,
              dimensionedScalar("none", dimless, Zero), zeroGradientFvPatchScalarField::typeName) {
  const dimensionedScalar whole("whole", dimArea, kStepPerSquaredLength * sqr(length));
  const surfaceScalarField rest(max(whole - kStepPerSquaredCell / sqr(mesh.nonOrthDeltaCoeffs()), whole * 0.0));
  const surfaceScalarField stepMagSf(rest / scalar(steps) * mesh.magSf());
  matrix_ = std::make_unique<fvScalarMatrix>(
      fvm::Sp(dimensionedScalar("one", dimless, 1.0), helper_) -
      fv::gaussLaplacianScheme<scalar, scalar>::fvmLaplacianUncorrected(stepMagSf, mesh.nonOrthDeltaCoeffs(), helper_));
  // Walls and openings add nothing to the diagonal (zero gradient); coupled patches do, once and for all.
  forAll(helper_.boundaryField(), patchi) {
    const labelUList& cells = mesh.lduAddr().patchAddr(patchi);
    const scalarField& internal = matrix_->internalCoeffs()[patchi];
    forAll(cells, i) matrix_->diag()[cells[i]] += internal[i];
  }
  controls_.add("solver", "PCG");
  controls_.add("preconditioner", "DIC");
  controls_.add("tolerance", tolerance);
  controls_.add("relTol", 0.0);
  controls_.add("maxIter", kMostIterations);
}

void conservativeDiffusion::solve(const scalarField& source, scalarField& value) {
  lduMatrix::solver::New(helper_.name(), *matrix_, matrix_->boundaryCoeffs(), matrix_->internalCoeffs(),
                         helper_.boundaryField().scalarInterfaces(), controls_)
      ->solve(value, source);
}

void conservativeDiffusion::spread(const scalarField& amount, scalarField& value) {
  solve(amount, value);
  for (int step = 1; step < steps_; ++step)
    solve(scalarField(mesh_.V() * value), value);
  // What the solver's tolerance leaves missing is spread evenly. Twice: the first pass meets its own round-off.
  const scalarField& volume = mesh_.V();
  const double whole = gSum(volume);
  for (int pass = 0; pass < 2; ++pass) {
    const double missing = gSum(amount) - gSum(scalarField(volume * value));
    value += missing / whole;
  }
}

void conservativeDiffusion::sample(const scalarField& field, scalarField& sampled) {
  solve(scalarField(mesh_.V() * field), sampled);
  for (int step = 1; step < steps_; ++step)
    solve(scalarField(mesh_.V() * sampled), sampled);
}

} // namespace eccentra::exchange
