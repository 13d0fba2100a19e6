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

std::vector<Slopes> slopesOf(label cells, const volTensorField* vectors, const volVectorField* scalars) {
  std::vector<Slopes> slopes(cells, Slopes{});
  for (label cell = 0; cell < cells; ++cell)
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; vectors && k < 3; ++k)
        slopes[cell].along[i].at[k] = (*vectors)[cell][3 * i + k];
      if (scalars)
        slopes[cell].along[i].at[flowReading::kScalar] = (*scalars)[cell][i];
    }
  return slopes;
}

FieldBundle<kNarrow> meansOf(label cells, const volVectorField* vectors, const volScalarField* scalars) {
  FieldBundle<kNarrow> means(cells, Bundled<kNarrow>{});
  for (label cell = 0; cell < cells; ++cell) {
    for (int k = 0; vectors && k < 3; ++k)
      means[cell].at[k] = (*vectors)[cell][k];
    if (scalars)
      means[cell].at[flowReading::kScalar] = (*scalars)[cell];
  }
  return means;
}

void add(const FieldBundle<kNarrow>& more, FieldBundle<kNarrow>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i)
    fields[i].at += more[i].at;
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

SharedFields<kNarrow> flowReading::readable(const volVectorField* vectors, const volTensorField* gradVectors,
                                            const volScalarField* scalars, const volVectorField* gradScalars) const {
  const label cells = mesh_.nCells();
  const FieldBundle<kNarrow> means = meansOf(cells, vectors, scalars);
  const std::vector<Slopes> slopes = slopesOf(cells, gradVectors, gradScalars);

  // What a linear field is at a vertex beyond the mean of its cells, and about a cell beyond its centre.
  SharedFields<kNarrow> flow = sharing_.empty<kNarrow>();
  for (label cell = 0; cell < cells; ++cell) {
    sharing_.forVertices(cell, [&](label vertex, double weight) {
      flow.vertices[vertex].at += weight * slopes[cell].over(vertexOffset_[vertex]).at;
    });
    flow.aroundCells[cell].at = -double(sharing_.vertexCount(cell)) * slopes[cell].over(cellOffset_[cell]).at;
  }
  flow.cells = means;
  sharing_.makeReadable(flow);

  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    // All is linear in the coefficients: the change of them brings that of the rest.
    SharedFields<kNarrow> change = sharing_.empty<kNarrow>();
    for (label cell = 0; cell < cells; ++cell)
      change.cells[cell].at =
          means[cell].at + kPartOfMean * (flow.cells[cell].at - flow.aroundCells[cell].at) - flow.cells[cell].at;
    sharing_.makeReadable(change);
    add(change.cells, flow.cells);
    add(change.aroundCells, flow.aroundCells);
    add(change.vertices, flow.vertices);
  }
  return flow;
}

} // namespace eccentra::exchange
