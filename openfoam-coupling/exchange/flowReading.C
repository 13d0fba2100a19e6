// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// On even cells, in one direction: means of a quadratic spline with coefficients c are (c- + 4 c + c+)/6.
#include "flowReading.H"

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

} // namespace

flowReading::flowReading(const fvMesh& mesh)
    : mesh_(mesh), vertexOffset_(mesh.nPoints(), Zero), cellOffset_(mesh.nCells(), Zero) {
  const labelListList& vertices = mesh.cellPoints();
  scalarField sums(mesh.nPoints(), Zero);
  first_.push_back(0);
  forAll(vertices, cell) {
    for (const label vertex : vertices[cell]) {
      const vector fromCentre(mesh.points()[vertex] - mesh.cellCentres()[cell]);
      vertex_.push_back(vertex);
      weight_.push_back(1.0 / mag(fromCentre));
      sums[vertex] += weight_.back();
      vertexOffset_[vertex] += weight_.back() * fromCentre;
      cellOffset_[cell] += fromCentre / vertices[cell].size();
    }
    first_.push_back(label(vertex_.size()));
  }
  syncTools::syncPointList(mesh, sums, plusEqOp<scalar>(), scalar(0));
  syncTools::syncPointList(mesh, vertexOffset_, plusEqOp<vector>(), vector::zero);
  vertexOffset_ /= sums;
  for (std::size_t at = 0; at < vertex_.size(); ++at)
    weight_[at] /= sums[vertex_[at]];
}

template <class Type> Field<Type> flowReading::toVertices(const Field<Type>& cells) const {
  Field<Type> vertices(mesh_.nPoints(), Zero);
  forAll(cells, cell) for (label at = first_[cell]; at < first_[cell + 1]; ++at) vertices[vertex_[at]] +=
      weight_[at] * cells[cell];
  syncTools::syncPointList(mesh_, vertices, plusEqOp<Type>(), pTraits<Type>::zero);
  return vertices;
}

template <class Type>
void flowReading::aroundCells(ReadableFlow<Type>& flow, const Field<Type>& atVertices,
                              const Field<Type>& atCells) const {
  flow.vertices = toVertices(flow.cells) + atVertices;
  flow.aroundCells = -atCells;
  forAll(flow.cells, cell) {
    Type sum = Zero;
    for (label at = first_[cell]; at < first_[cell + 1]; ++at)
      sum += flow.vertices[vertex_[at]];
    flow.aroundCells[cell] += sum / scalar(first_[cell + 1] - first_[cell]);
  }
}

template <class Type, class Gradient>
ReadableFlow<Type> flowReading::spline(const Field<Type>& means, const Field<Gradient>& gradient) const {
  // What a linear field is at a vertex beyond the mean of its cells, and about a cell beyond its centre.
  const Field<Type> atVertices(vertexOffset_ & toVertices(gradient));
  const Field<Type> atCells(cellOffset_ & gradient);
  ReadableFlow<Type> flow;
  flow.cells = means;
  aroundCells(flow, atVertices, atCells);
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    flow.cells = means + kPartOfMean * (flow.cells - flow.aroundCells);
    aroundCells(flow, atVertices, atCells);
  }
  return flow;
}

ReadableFlow<scalar> flowReading::readable(const volScalarField& field, const volVectorField& gradient) const {
  return spline(field.primitiveField(), gradient.primitiveField());
}

ReadableFlow<vector> flowReading::readable(const volVectorField& field, const volTensorField& gradient) const {
  return spline(field.primitiveField(), gradient.primitiveField());
}

} // namespace eccentra::exchange
