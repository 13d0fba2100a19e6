// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of cells and vertices; vertices on processor and periodic patches are one vertex.
#include "exchange/vertexSharing.H"

#include "exchange/coupledVertices.H"

#include "cellPointWeight.H"
#include "polyMeshTetDecomposition.H"
#include "syncTools.H"
#include "volFields.H"

#include <algorithm>
#include <cmath>

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// A point belongs to a tetrahedron if no weight is below this.
constexpr double kLeastWeight = -1e-12;

/// How globalMeshData adds up values that no rotation changes.
template <int width> using Packet = FixedList<scalar, width>;
template <int width> struct AddPackets {
  void operator()(Packet<width>& sum, const Packet<width>& other) const {
    for (int k = 0; k < width; ++k)
      sum[k] += other[k];
  }
};

} // namespace

vertexSharing::vertexSharing(const fvMesh& mesh) : mesh_(mesh) {
  // Made by all ranks together, before any of them asks for the shares of a point.
  mesh.tetBasePtIs();
  mesh.globalData().globalTransforms();
  mesh.globalData().globalPointSlavesMap();
  scalarField sums(mesh.nPoints(), Zero);
  begin_.push_back(0);
  tetrahedraBegin_.push_back(0);
  forAll(mesh.cellPoints(), cell) {
    for (const label vertex : mesh.cellPoints()[cell]) {
      vertices_.push_back(vertex);
      weights_.push_back(1.0 / mag(mesh.points()[vertex] - mesh.cellCentres()[cell]));
      sums[vertex] += weights_.back();
    }
    begin_.push_back(static_cast<label>(vertices_.size()));
    for (const tetIndices& tetrahedron : polyMeshTetDecomposition::cellTetIndices(mesh, cell))
      for (const label vertex : tetrahedron.faceTriIs(mesh))
        tetrahedra_.push_back(vertex);
    tetrahedraBegin_.push_back(static_cast<label>(tetrahedra_.size()));
  }
  syncTools::syncPointList(mesh, sums, plusEqOp<scalar>(), scalar(0));
  for (std::size_t k = 0; k < weights_.size(); ++k)
    weights_[k] /= sums[vertices_[k]];
}

bool vertexSharing::findTetrahedron(const point& position, label cell, double* weights, label* vertex) const {
  const point& centre = mesh_.cellCentres()[cell];
  const pointField& points = mesh_.points();
  const vector p(position - centre);
  for (label k = tetrahedraBegin_[cell]; k < tetrahedraBegin_[cell + 1]; k += 3) {
    // Cramer's rule; volumes of tetrahedra that leave out one corner in turn.
    const vector a(points[tetrahedra_[k]] - centre), b(points[tetrahedra_[k + 1]] - centre),
        c(points[tetrahedra_[k + 2]] - centre);
    const vector bc(b ^ c);
    const double volume = a & bc;
    if (std::abs(volume) < SMALL * mesh_.V()[cell])
      continue;
    const double ofA = (p & bc) / volume;
    if (ofA < kLeastWeight)
      continue;
    const vector ap(a ^ p);
    const double ofB = (c & ap) / volume, ofC = -(b & ap) / volume, ofCentre = 1 - ofA - ofB - ofC;
    if (ofB < kLeastWeight || ofC < kLeastWeight || ofCentre < kLeastWeight)
      continue;
    const double found[] = {ofCentre, ofA, ofB, ofC};
    std::copy_n(found, 4, weights);
    std::copy_n(&tetrahedra_[k], 3, vertex);
    return true;
  }
  return false;
}

PointShares vertexSharing::sharesOf(const double* position, label cell) const {
  // Barycentric weights in the tetrahedron of the cell's centre and three vertices of a face that holds the point.
  PointShares shares;
  shares.cell = cell;
  double weight[4], sum = 0;
  const point place(position[0], position[1], position[2]);
  if (!findTetrahedron(place, cell, weight, shares.vertex)) {
    const cellPointWeight nearest(mesh_, place, cell);
    for (int k = 0; k < 4; ++k)
      weight[k] = nearest.weights()[k];
    for (int k = 0; k < 3; ++k)
      shares.vertex[k] = nearest.faceVertices()[k];
  }
  for (double& w : weight)
    sum += w = std::max(w, 0.0);
  for (int k = 0; k < 3; ++k)
    shares.toVertex[k] = weight[k + 1] / sum;
  // Near the centre the cell would keep all: half of that goes around it, as near its faces.
  const double centre = weight[0] / sum;
  shares.toVertices = 0.5 * centre * centre;
  shares.toCell = centre - shares.toVertices;
  return shares;
}

template <int width>
void vertexSharing::clear(SharedFields<width>& fields, const touchedCells& touched, int rings) const {
  fields.cells.resize(mesh_.nCells());
  fields.aroundCells.resize(mesh_.nCells());
  fields.vertices.resize(mesh_.nPoints());
  touched.forCells(rings, [&](label cell) { fields.cells[cell] = fields.aroundCells[cell] = Bundled<width>{}; });
  touched.forVertices(rings, [&](label vertex) { fields.vertices[vertex] = Bundled<width>{}; });
  // All of these are summed over the ranks.
  for (const label vertex : coupledVertices(mesh_))
    fields.vertices[vertex] = Bundled<width>{};
}

template <int width> void vertexSharing::addUp(FieldBundle<width>& vertices) const {
  const labelList& coupled = coupledVertices(mesh_);
  List<Packet<width>> values(coupled.size());
  forAll(coupled, i) for (int k = 0; k < width; ++k) values[i][k] = vertices[coupled[i]].at[k];
  syncCoupledVertices(mesh_, values, AddPackets<width>());
  forAll(coupled, i) for (int k = 0; k < width; ++k) vertices[coupled[i]].at[k] = values[i][k];
}

template <int width>
void vertexSharing::collect(SharedFields<width>& fields, const touchedCells& touched, int rings) const {
  touched.forCells(rings, [&](label cell) {
    const auto part = fields.aroundCells[cell].at / double(begin_[cell + 1] - begin_[cell]);
    for (label k = begin_[cell]; k < begin_[cell + 1]; ++k)
      fields.vertices[vertices_[k]].at += part;
  });
  addUp(fields.vertices);
  touched.forCells(rings + 1, [&](label cell) {
    for (label k = begin_[cell]; k < begin_[cell + 1]; ++k)
      fields.cells[cell].at += weights_[k] * fields.vertices[vertices_[k]].at;
  });
}

template <int width>
void vertexSharing::makeReadable(SharedFields<width>& fields, const touchedCells& touched, int rings) const {
  touched.forCells(rings + 1, [&](label cell) {
    for (label k = begin_[cell]; k < begin_[cell + 1]; ++k)
      fields.vertices[vertices_[k]].at += weights_[k] * fields.cells[cell].at;
  });
  addUp(fields.vertices);
  touched.forCells(rings, [&](label cell) {
    auto sum = fields.aroundCells[cell].at;
    for (label k = begin_[cell]; k < begin_[cell + 1]; ++k)
      sum += fields.vertices[vertices_[k]].at;
    fields.aroundCells[cell].at = sum / double(begin_[cell + 1] - begin_[cell]);
  });
}

template void vertexSharing::clear(SharedFields<kNarrow>&, const touchedCells&, int) const;
template void vertexSharing::clear(SharedFields<kWide>&, const touchedCells&, int) const;
template void vertexSharing::collect(SharedFields<kNarrow>&, const touchedCells&, int) const;
template void vertexSharing::collect(SharedFields<kWide>&, const touchedCells&, int) const;
template void vertexSharing::makeReadable(SharedFields<kNarrow>&, const touchedCells&, int) const;
template void vertexSharing::makeReadable(SharedFields<kWide>&, const touchedCells&, int) const;

} // namespace eccentra::exchange
