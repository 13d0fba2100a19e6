// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// On even cells, in one direction: means of a quadratic spline with coefficients c are (c- + 4 c + c+)/6.
#include "exchange/flowReading.H"

#include "syncTools.H"
#include "volFields.H"

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// The spline's mean over a cell is its coefficient less this part of what that lies above the coefficients about it,
/// which are weighted 1 2 1 in each direction.
constexpr double kPartOfMean = 2.0 / 3.0;
/// Coefficients from means, by repetition: each leaves a third of the error of the shortest wave that cells bear.
constexpr int kRepetitions = 2;

/// Derivatives of a cell's fields along x, y and z.
struct Slopes {
  Bundled<kNarrow> along[3];

  Bundled<kNarrow> over(const vector& way) const {
    return {way.x() * along[0].at + way.y() * along[1].at + way.z() * along[2].at};
  }
};

Slopes slopesOf(label cell, const volTensorField* vectors, const volVectorField* scalars) {
  Slopes slopes{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; vectors && k < 3; ++k)
      slopes.along[i].at[k] = (*vectors)[cell][3 * i + k];
    if (scalars)
      slopes.along[i].at[flowReading::kScalar] = (*scalars)[cell][i];
  }
  return slopes;
}

Bundled<kNarrow> meanOf(label cell, const volVectorField* vectors, const volScalarField* scalars) {
  Bundled<kNarrow> mean{};
  for (int k = 0; vectors && k < 3; ++k)
    mean.at[k] = (*vectors)[cell][k];
  if (scalars)
    mean.at[flowReading::kScalar] = (*scalars)[cell];
  return mean;
}

} // namespace

flowReading::flowReading(const fvMesh& mesh, const vertexSharing& sharing)
    : mesh_(mesh), sharing_(sharing), vertexOffset_(mesh.nPoints(), Zero), cellOffset_(mesh.nCells(), Zero) {
  forAll(cellOffset_, cell) {
    sharing.forVertices(cell, [&](label vertex, double weight) {
      const vector fromCentre(mesh.points()[vertex] - mesh.cellCentres()[cell]);
      vertexOffset_[vertex] += weight * fromCentre;
      cellOffset_[cell] += fromCentre / sharing.vertexCount(cell);
    });
  }
  syncTools::syncPointList(mesh, vertexOffset_, plusEqOp<vector>(), vector::zero);
}

const SharedFields<kNarrow>& flowReading::readable(const volVectorField* vectors, const volTensorField* gradVectors,
                                                   const volScalarField* scalars, const volVectorField* gradScalars,
                                                   const touchedCells& touched) {
  // Each use of neighbours needs values of one more ring of cells.
  static_assert(kRepetitions + 1 <= touchedCells::kRings, "the rings must reach as far as the repetitions");

  // What a linear field is at a vertex beyond the mean of its cells, and about a cell beyond its centre.
  sharing_.clear(flow_, touched, kRepetitions + 1);
  touched.forCells(kRepetitions + 1, [&](label cell) {
    const Slopes slopes = slopesOf(cell, gradVectors, gradScalars);
    sharing_.forVertices(cell, [&](label vertex, double weight) {
      flow_.vertices[vertex].at += weight * slopes.over(vertexOffset_[vertex]).at;
    });
    flow_.aroundCells[cell].at = -double(sharing_.vertexCount(cell)) * slopes.over(cellOffset_[cell]).at;
    flow_.cells[cell] = meanOf(cell, vectors, scalars);
  });
  sharing_.makeReadable(flow_, touched, kRepetitions);

  for (int rings = kRepetitions - 1; rings >= 0; --rings) {
    // All is linear in the coefficients: the change of them brings that of the rest.
    sharing_.clear(change_, touched, rings + 1);
    touched.forCells(rings + 1, [&](label cell) {
      change_.cells[cell].at = meanOf(cell, vectors, scalars).at +
                               kPartOfMean * (flow_.cells[cell].at - flow_.aroundCells[cell].at) - flow_.cells[cell].at;
    });
    sharing_.makeReadable(change_, touched, rings);
    touched.forCells(rings + 1, [&](label cell) {
      flow_.cells[cell].at += change_.cells[cell].at;
      flow_.aroundCells[cell].at += change_.aroundCells[cell].at;
    });
    touched.forVertices(rings + 1, [&](label vertex) { flow_.vertices[vertex].at += change_.vertices[vertex].at; });
  }
  return flow_;
}

} // namespace eccentra::exchange
