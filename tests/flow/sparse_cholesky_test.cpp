// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The direct solver on a periodic annulus, whole and cut in two: to round-off, alone and under a multigrid.
#include "flow/sparseCholesky.H"

#include "exchange/shared_mesh.h"

#include "fvCFD.H"

#include <gtest/gtest.h>

#include <string>

namespace {

using eccentra::test::sharedMesh;

/// A potential that is 0 on the walls, or that has no flux through them.
Foam::volScalarField potential(const Foam::word& onWalls) {
  Foam::wordList types(sharedMesh->boundary().size());
  forAll(types, patchi) {
    types[patchi] = sharedMesh->boundary()[patchi].coupled() ? sharedMesh->boundary()[patchi].type() : onWalls;
  }
  return Foam::volScalarField(Foam::IOobject("potential", sharedMesh->time().timeName(), *sharedMesh), *sharedMesh,
                              Foam::dimensionedScalar("zero", Foam::dimless, 0), types);
}

/// Laplacian of the potential = a source that differs in every direction and whose integral is 0.
Foam::fvScalarMatrix equation(Foam::volScalarField& field) {
  Foam::volScalarField source(Foam::IOobject("source", sharedMesh->time().timeName(), *sharedMesh), *sharedMesh,
                              Foam::dimensionedScalar("zero", Foam::dimless / Foam::dimArea, 0));
  forAll(source, celli) {
    const Foam::vector& at = sharedMesh->C()[celli];
    source[celli] = std::sin(40 * at.x()) + std::cos(70 * at.y()) * std::sin(50 * at.z() + 1);
  }
  source.primitiveFieldRef() -= Foam::gSum(Foam::scalarField(source * sharedMesh->V())) / Foam::gSum(sharedMesh->V());
  return Foam::fvScalarMatrix(Foam::fvm::laplacian(field) == source);
}

struct Solved {
  Foam::volScalarField field;
  Foam::solverPerformance performance;
};

Solved solved(const Foam::word& onWalls, const std::string& words) {
  Foam::volScalarField field = potential(onWalls);
  Foam::fvScalarMatrix matrix = equation(field);
  const Foam::dictionary controls{Foam::IStringStream(words)()};
  const Foam::solverPerformance performance = matrix.solve(controls);
  return {field, performance};
}

const std::string kIterative = "solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; maxIter 5000;";
const std::string kDirect = "solver sparseCholesky; tolerance 1e-12; relTol 0;";
const std::string kMultigrid =
    "solver GAMG; smoother symGaussSeidel; nCellsInCoarsestLevel 100; tolerance 1e-10; relTol 0; ";

/// Largest difference of two potentials of which a constant is of no meaning, over the spread of the first.
double difference(const Foam::volScalarField& a, const Foam::volScalarField& b) {
  const Foam::scalarField apart(a.primitiveField() - b.primitiveField());
  return (Foam::gMax(apart) - Foam::gMin(apart)) / (Foam::gMax(a.primitiveField()) - Foam::gMin(a.primitiveField()));
}

TEST(SparseCholesky, SolvesToRoundOff) {
  for (const char* walls : {"fixedValue", "zeroGradient"}) { // the second is defined up to a constant
    const Solved exact = solved(walls, kDirect), iterated = solved(walls, kIterative);
    EXPECT_GT(exact.performance.initialResidual(), 0.1) << walls;
    EXPECT_LT(exact.performance.finalResidual(), 1e-12) << walls;
    EXPECT_EQ(exact.performance.nIterations(), 1) << walls;
    EXPECT_GT(iterated.performance.nIterations(), 20) << walls;
    EXPECT_LT(difference(iterated.field, exact.field), 1e-9) << walls;
  }
  // A value on the walls leaves no constant open.
  const Solved exact = solved("fixedValue", kDirect), iterated = solved("fixedValue", kIterative);
  EXPECT_LT(Foam::gMax(Foam::mag(exact.field.primitiveField() - iterated.field.primitiveField())()),
            1e-9 * Foam::gMax(Foam::mag(exact.field.primitiveField())()));
}

TEST(SparseCholesky, EndsAMultigrid) {
  for (const char* walls : {"fixedValue", "zeroGradient"}) {
    const Solved under = solved(walls, kMultigrid + "coarsestLevelCorr { solver sparseCholesky; }");
    EXPECT_LT(under.performance.finalResidual(), 1e-10) << walls;
    EXPECT_LT(under.performance.nIterations(), 20) << walls; // OpenFOAM's own coarsest level diverges with the second
    EXPECT_LT(difference(under.field, solved(walls, kDirect).field), 1e-7) << walls;
  }
}

TEST(SparseCholesky, RefusesWhatHasNoFactors) {
  Foam::volScalarField field = potential("fixedValue");
  Foam::fvScalarMatrix matrix = equation(field);
  matrix.diag() *= 0.5; // of either sign in one matrix
  matrix.diag()[0] = Foam::Pstream::master() ? -matrix.diag()[0] : matrix.diag()[0];
  const bool before = Foam::FatalError.throwExceptions();
  std::string said;
  try {
    matrix.solve(Foam::dictionary{Foam::IStringStream(kDirect)()});
  } catch (const Foam::error& error) {
    said = error.message();
  }
  Foam::FatalError.throwExceptions(before);
  EXPECT_NE(said.find("not definite"), std::string::npos) << said;
}

} // namespace
