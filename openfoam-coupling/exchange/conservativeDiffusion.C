// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix uses the orthogonal part of the face gradient only: symmetric, and no new extrema.
#include "exchange/conservativeDiffusion.H"

#include "exchange/chebyshevSeries.H"

#include "cyclicPolyPatch.H"
#include "surfaceFields.H"
#include "volFields.H"

#include <algorithm>
#include <utility>

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// One implicit step over T spreads with variance 2 T per direction; a length l stands for T = l^2/4.
constexpr double kStepPerSquaredLength = 0.25;
/// What cells of size h spread by themselves, as a variance 2 T: vertexSharing 0.25 to 0.5 h^2, on the average over a
/// cubic cell 0.317 h^2, and a cell over its own width h^2/12.
constexpr double kStepPerSquaredCell = 0.2;

/// Calls visit(cell, neighbour, face) for both sides of every face between two cells of this rank, row by row.
template <class Visit> void forNeighbours(const fvMesh& mesh, Visit visit) {
  std::vector<label> behindPeriodic(mesh.nFaces() - mesh.nInternalFaces(), -1);
  for (const polyPatch& patch : mesh.boundaryMesh())
    if (isA<cyclicPolyPatch>(patch)) {
      const labelUList& other = refCast<const cyclicPolyPatch>(patch).neighbPatch().faceCells();
      for (label i = 0; i < patch.size(); ++i)
        behindPeriodic[patch.start() - mesh.nInternalFaces() + i] = other[i];
    }
  forAll(mesh.cells(), cell) for (const label face : mesh.cells()[cell]) {
    const label neighbour = !mesh.isInternalFace(face)       ? behindPeriodic[face - mesh.nInternalFaces()]
                            : mesh.faceOwner()[face] == cell ? mesh.faceNeighbour()[face]
                                                             : mesh.faceOwner()[face];
    if (neighbour >= 0)
      visit(cell, neighbour, face);
  }
}

/// Values of all faces, from those of the mesh and its patches.
std::vector<double> onAllFaces(const fvMesh& mesh, const surfaceScalarField& field) {
  std::vector<double> values(mesh.nFaces());
  std::copy(field.primitiveField().begin(), field.primitiveField().end(), values.begin());
  forAll(field.boundaryField(), patchi)
      std::copy(field.boundaryField()[patchi].begin(), field.boundaryField()[patchi].end(),
                values.begin() + mesh.boundaryMesh()[patchi].start());
  return values;
}

} // namespace

conservativeDiffusion::conservativeDiffusion(const fvMesh& mesh, double length, int steps, double tolerance)
    : mesh_(mesh), halo_(mesh), diagonal_(mesh.nCells(), 0.0) {
  const dimensionedScalar whole("whole", dimArea, kStepPerSquaredLength * sqr(length));
  const surfaceScalarField rest(max(whole - kStepPerSquaredCell / sqr(mesh.nonOrthDeltaCoeffs()), whole * 0.0));
  const std::vector<double> conductance =
      onAllFaces(mesh, surfaceScalarField(rest / scalar(steps) * mesh.magSf() * mesh.nonOrthDeltaCoeffs()));
  const auto coefficientOf = [&](label cell, label face) { return conductance[face] / mesh.V()[cell]; };
  rowBegin_.assign(mesh.nCells() + 1, 0);
  forNeighbours(mesh, [&](label cell, label neighbour, label face) {
    neighbour_.push_back(neighbour);
    coefficient_.push_back(coefficientOf(cell, face));
    diagonal_[cell] += coefficient_.back();
    rowBegin_[cell + 1] = static_cast<label>(neighbour_.size());
  });
  // Cells without neighbours have empty rows.
  for (std::size_t cell = 1; cell < rowBegin_.size(); ++cell)
    rowBegin_[cell] = std::max(rowBegin_[cell], rowBegin_[cell - 1]);
  for (std::size_t i = 0; i < halo_.faces().size(); ++i) {
    haloCoefficient_.push_back(coefficientOf(halo_.cells()[i], halo_.faces()[i]));
    diagonal_[halo_.cells()[i]] += haloCoefficient_.back();
  }
  // No eigenvalue of V^-1 M is larger than 1 and twice the largest diagonal (Gershgorin).
  const double largest =
      returnReduce(diagonal_.empty() ? 0.0 : *std::max_element(diagonal_.begin(), diagonal_.end()), maxOp<scalar>());
  if (largest <= 0)
    return; // the cells themselves spread as far
  series_ = inversePowerSeries(1 + 2 * largest, steps, tolerance);
  for (auto* values : {&diagonal_, &coefficient_, &haloCoefficient_})
    for (double& value : *values)
      value /= largest;
}

template <int width>
void conservativeDiffusion::step(double factor, const FieldBundle<width>& fields, int used, double c,
                                 const FieldBundle<width>& start, FieldBundle<width>& values) {
  halo_.send(fields, used);
  const label cells = mesh_.nCells();
  for (label cell = 0; cell < cells; ++cell) {
    auto sum = (diagonal_[cell] - 1.0) * fields[cell].at;
    for (label k = rowBegin_[cell]; k < rowBegin_[cell + 1]; ++k)
      sum -= coefficient_[k] * fields[neighbour_[k]].at;
    values[cell].at = factor * sum + c * start[cell].at - values[cell].at;
  }
  const double* behind = halo_.values();
  for (std::size_t i = 0; i < haloCoefficient_.size(); ++i)
    for (int k = 0; k < used; ++k)
      values[halo_.cells()[i]].at[k] -= factor * haloCoefficient_[i] * *behind++;
}

template <int width> void conservativeDiffusion::sample(FieldBundle<width>& fields, int used) {
  if (series_.empty())
    return;
  // Clenshaw's recurrence.
  FieldBundle<width> now(fields.size(), Bundled<width>{}), before(now);
  for (std::size_t k = series_.size() - 1; k >= 1; --k) {
    step(2.0, now, used, series_[k], fields, before);
    std::swap(now, before);
  }
  step(1.0, now, used, series_[0], fields, before);
  std::swap(fields, before);
}

template <int width> void conservativeDiffusion::spread(FieldBundle<width>& amounts, int used) {
  const scalarField& volume = mesh_.V();
  for (std::size_t cell = 0; cell < amounts.size(); ++cell)
    amounts[cell].at /= volume[cell];
  sample(amounts, used);
  for (std::size_t cell = 0; cell < amounts.size(); ++cell)
    amounts[cell].at *= volume[cell];
}

template void conservativeDiffusion::spread(FieldBundle<kNarrow>&, int);
template void conservativeDiffusion::spread(FieldBundle<kWide>&, int);
template void conservativeDiffusion::sample(FieldBundle<kNarrow>&, int);
template void conservativeDiffusion::sample(FieldBundle<kWide>&, int);

} // namespace eccentra::exchange
