// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of cells and vertices; vertices on processor and periodic patches are one vertex.
#include "vertexSharing.H"

#include "cellPointWeight.H"
#include "syncTools.H"

#include <algorithm>
#include <utility>

namespace eccentra::exchange {

using namespace Foam;

template <class Visit> void vertexSharing::forVertices(Visit visit) const {
  const labelListList& vertices = mesh_.cellPoints();
  std::size_t at = 0;
  forAll(vertices, cell) for (const label vertex : vertices[cell]) visit(cell, vertex, at++);
}

vertexSharing::vertexSharing(const fvMesh& mesh) : mesh_(mesh) {
  // Made by all ranks together, before any of them asks for the shares of a point.
  mesh.tetBasePtIs();
  scalarField sums(mesh.nPoints(), Zero);
  forVertices([&](label cell, label vertex, std::size_t) {
    weights_.push_back(1.0 / mag(mesh.points()[vertex] - mesh.cellCentres()[cell]));
    sums[vertex] += weights_.back();
  });
  syncTools::syncPointList(mesh, sums, plusEqOp<scalar>(), scalar(0));
  forVertices([&](label, label vertex, std::size_t at) { weights_[at] /= sums[vertex]; });
}

PointShares vertexSharing::sharesOf(const double* position, label cell) const {
  // Barycentric weights in the tetrahedron of the cell's centre and three vertices of a face that holds the point.
  const cellPointWeight found(mesh_, vector(position[0], position[1], position[2]), cell);
  double weight[4], sum = 0;
  for (int k = 0; k < 4; ++k)
    sum += weight[k] = std::max(found.weights()[k], 0.0);
  PointShares shares;
  shares.cell = cell;
  for (int k = 0; k < 3; ++k) {
    shares.vertex[k] = found.faceVertices()[k];
    shares.toVertex[k] = weight[k + 1] / sum;
  }
  // Near the centre the cell would keep all: half of that goes around it, as near its faces.
  const double centre = weight[0] / sum;
  shares.toVertices = 0.5 * centre * centre;
  shares.toCell = centre - shares.toVertices;
  return shares;
}

SharedField vertexSharing::empty() const {
  return {scalarField(mesh_.nCells(), Zero), scalarField(mesh_.nCells(), Zero), scalarField(mesh_.nPoints(), Zero)};
}

void vertexSharing::put(const PointShares& shares, double amount, SharedField& field) {
  field.cells[shares.cell] += shares.toCell * amount;
  field.aroundCells[shares.cell] += shares.toVertices * amount;
  for (int k = 0; k < 3; ++k)
    field.vertices[shares.vertex[k]] += shares.toVertex[k] * amount;
}

scalarField vertexSharing::collect(SharedField& field) const {
  const labelListList& vertices = mesh_.cellPoints();
  forVertices([&](label cell, label vertex, std::size_t) {
    field.vertices[vertex] += field.aroundCells[cell] / vertices[cell].size();
  });
  syncTools::syncPointList(mesh_, field.vertices, plusEqOp<scalar>(), scalar(0));
  forVertices(
      [&](label cell, label vertex, std::size_t at) { field.cells[cell] += weights_[at] * field.vertices[vertex]; });
  return std::move(field.cells);
}

SharedField vertexSharing::readable(const scalarField& cells) const {
  SharedField field = empty();
  forVertices([&](label cell, label vertex, std::size_t at) { field.vertices[vertex] += weights_[at] * cells[cell]; });
  syncTools::syncPointList(mesh_, field.vertices, plusEqOp<scalar>(), scalar(0));
  const labelListList& vertices = mesh_.cellPoints();
  forVertices([&](label cell, label vertex, std::size_t) {
    field.aroundCells[cell] += field.vertices[vertex] / vertices[cell].size();
  });
  field.cells = cells;
  return field;
}

double vertexSharing::read(const PointShares& shares, const SharedField& field) {
  double value = shares.toCell * field.cells[shares.cell] + shares.toVertices * field.aroundCells[shares.cell];
  for (int k = 0; k < 3; ++k)
    value += shares.toVertex[k] * field.vertices[shares.vertex[k]];
  return value;
}

} // namespace eccentra::exchange
