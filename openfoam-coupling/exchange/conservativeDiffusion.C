// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The matrix uses the orthogonal part of the face gradient only: symmetric, and no new extrema.
#include "exchange/conservativeDiffusion.H"

#include "exchange/chebyshevSeries.H"

#include "cyclicPolyPatch.H"
#include "surfaceFields.H"
#include "syncTools.H"
#include "volFields.H"

#include <algorithm>
#include <numeric>
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

std::vector<double> conductances(const fvMesh& mesh, double length, int steps) {
  const dimensionedScalar whole("whole", dimArea, kStepPerSquaredLength * sqr(length));
  const surfaceScalarField rest(max(whole - kStepPerSquaredCell / sqr(mesh.nonOrthDeltaCoeffs()), whole * 0.0));
  return onAllFaces(mesh, surfaceScalarField(rest / scalar(steps) * mesh.magSf() * mesh.nonOrthDeltaCoeffs()));
}

/// Boundary faces through which something flows, as either side computes it.
boolList conducting(const fvMesh& mesh, const std::vector<double>& conductance) {
  boolList flows(mesh.nBoundaryFaces());
  forAll(flows, i) flows[i] = conductance[mesh.nInternalFaces() + i] > 0;
  syncTools::syncBoundaryFaceList(mesh, flows, orEqOp<bool>());
  return flows;
}

/// The smallest number of a set that has been united, with shorter ways for the next time.
label rootOf(std::vector<label>& parent, label cell) {
  while (parent[cell] != cell)
    cell = parent[cell] = parent[parent[cell]];
  return cell;
}

void unite(std::vector<label>& parent, label a, label b) {
  a = rootOf(parent, a);
  b = rootOf(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

} // namespace

conservativeDiffusion::conservativeDiffusion(const fvMesh& mesh, double length, int steps, double tolerance)
    : conservativeDiffusion(mesh, conductances(mesh, length, steps), steps, tolerance) {}

conservativeDiffusion::conservativeDiffusion(const fvMesh& mesh, const std::vector<double>& conductance, int steps,
                                             double tolerance)
    : mesh_(mesh), halo_(mesh, conducting(mesh, conductance)), steps_(steps), diagonal_(mesh.nCells(), 0.0) {
  const auto coefficientOf = [&](label cell, label face) { return conductance[face] / mesh.V()[cell]; };
  rowBegin_.assign(mesh.nCells() + 1, 0);
  forNeighbours(mesh, [&](label cell, label neighbour, label face) {
    if (conductance[face] > 0) {
      neighbour_.push_back(neighbour);
      coefficient_.push_back(coefficientOf(cell, face));
      diagonal_[cell] += coefficient_.back();
    }
    rowBegin_[cell + 1] = static_cast<label>(neighbour_.size());
  });
  // Cells without neighbours have empty rows.
  for (std::size_t cell = 1; cell < rowBegin_.size(); ++cell)
    rowBegin_[cell] = std::max(rowBegin_[cell], rowBegin_[cell - 1]);
  for (const label face : halo_.faces()) {
    haloPlace_.push_back(mesh.faceOwner()[face]);
    haloCoefficient_.push_back(coefficientOf(haloPlace_.back(), face));
    diagonal_[haloPlace_.back()] += haloCoefficient_.back();
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
  scale_ = largest;
  divideInParts();
  orderRows();
  layered_ = isLayered();
  factors_.resize(parts_.size());
}

bool conservativeDiffusion::isLayered() const {
  const auto spreads = [&](const Part& part) { return rowBegin_[part.end] > rowBegin_[part.begin]; };
  const label spreading = static_cast<label>(std::count_if(parts_.begin(), parts_.end(), spreads));
  return returnReduce(spreading, sumOp<label>()) > Pstream::nProcs();
}

partFactors& conservativeDiffusion::factorsOf(const Part& part) {
  auto& factors = factors_[&part - parts_.data()];
  if (!factors) {
    std::vector<MatrixEntry> lower;
    for (label row = part.begin, i = 0; row < part.end; ++row, ++i) {
      const double volume = mesh_.V()[cellOf_[row]];
      lower.push_back({static_cast<int>(i), static_cast<int>(i), volume * (1 + scale_ * diagonal_[row])});
      for (label k = rowBegin_[row]; k < rowBegin_[row + 1]; ++k)
        if (neighbour_[k] < i)
          lower.push_back({static_cast<int>(i), static_cast<int>(neighbour_[k]), -volume * scale_ * coefficient_[k]});
    }
    factors = std::make_unique<partFactors>(static_cast<int>(part.end - part.begin), lower);
  }
  return *factors;
}

template <int width> void conservativeDiffusion::takeSteps(const Part& part, FieldBundle<width>& values) {
  const scalarField& volume = mesh_.V();
  const partFactors& factors = factorsOf(part);
  for (int n = 0; n < steps_; ++n) {
    for (label i = 0; i < part.end - part.begin; ++i)
      values[i].at *= volume[cellOf_[part.begin + i]];
    factors.solve(values);
  }
}

void conservativeDiffusion::divideInParts() {
  std::vector<label> parent(mesh_.nCells());
  std::iota(parent.begin(), parent.end(), 0);
  for (label cell = 0; cell < mesh_.nCells(); ++cell)
    for (label k = rowBegin_[cell]; k < rowBegin_[cell + 1]; ++k)
      unite(parent, cell, neighbour_[k]);
  for (const label cell : haloPlace_)
    unite(parent, haloPlace_[0], cell);
  // A root comes before all other cells of its part.
  partOf_.resize(mesh_.nCells());
  for (label cell = 0; cell < mesh_.nCells(); ++cell) {
    const label root = rootOf(parent, cell);
    if (root == cell) {
      partOf_[cell] = static_cast<label>(parts_.size());
      parts_.push_back({0, 0, false});
    } else
      partOf_[cell] = partOf_[root];
    ++parts_[partOf_[cell]].end;
  }
  if (!haloPlace_.empty())
    parts_[partOf_[haloPlace_[0]]].acrossRanks = true;
  label end = 0;
  for (Part& part : parts_) {
    part.begin = end;
    end = part.end += end;
  }
}

void conservativeDiffusion::orderRows() {
  std::vector<label> next, place(mesh_.nCells());
  for (const Part& part : parts_)
    next.push_back(part.begin);
  cellOf_.resize(mesh_.nCells());
  for (label cell = 0; cell < mesh_.nCells(); ++cell) {
    label& at = next[partOf_[cell]];
    place[cell] = at - parts_[partOf_[cell]].begin;
    cellOf_[at++] = cell;
  }
  std::vector<label> rowBegin{0}, neighbour;
  std::vector<double> coefficient, diagonal;
  for (const label cell : cellOf_) {
    for (label k = rowBegin_[cell]; k < rowBegin_[cell + 1]; ++k) {
      neighbour.push_back(place[neighbour_[k]]);
      coefficient.push_back(coefficient_[k]);
    }
    rowBegin.push_back(static_cast<label>(neighbour.size()));
    diagonal.push_back(diagonal_[cell]);
  }
  rowBegin_ = std::move(rowBegin);
  neighbour_ = std::move(neighbour);
  coefficient_ = std::move(coefficient);
  diagonal_ = std::move(diagonal);
  for (label& cell : haloPlace_)
    cell = place[cell];
}

template <int width>
void conservativeDiffusion::step(const Part& part, double factor, const FieldBundle<width>& fields, int used, double c,
                                 const FieldBundle<width>& start, FieldBundle<width>& values) {
  if (part.acrossRanks)
    halo_.send(fields, haloPlace_, used);
  for (label row = part.begin, i = 0; row < part.end; ++row, ++i) {
    auto sum = (diagonal_[row] - 1.0) * fields[i].at;
    for (label k = rowBegin_[row]; k < rowBegin_[row + 1]; ++k)
      sum -= coefficient_[k] * fields[neighbour_[k]].at;
    values[i].at = factor * sum + c * start[i].at - values[i].at;
  }
  if (!part.acrossRanks)
    return;
  const double* behind = halo_.values();
  for (std::size_t i = 0; i < haloCoefficient_.size(); ++i)
    for (int k = 0; k < used; ++k)
      values[haloPlace_[i]].at[k] -= factor * haloCoefficient_[i] * *behind++;
}

template <int width, class Load, class Store>
void conservativeDiffusion::apply(const Part& part, int used, Load load, Store store) {
  const label cells = part.end - part.begin;
  FieldBundle<width> start(cells), now(cells, Bundled<width>{}), before(now);
  for (label i = 0; i < cells; ++i)
    start[i] = load(cellOf_[part.begin + i]);
  if (layered_ && !part.acrossRanks) {
    takeSteps(part, start);
    for (label i = 0; i < cells; ++i)
      store(cellOf_[part.begin + i], start[i]);
    return;
  }
  // Clenshaw's recurrence.
  for (std::size_t k = series_.size() - 1; k >= 1; --k) {
    step(part, 2.0, now, used, series_[k], start, before);
    std::swap(now, before);
  }
  step(part, 1.0, now, used, series_[0], start, before);
  for (label i = 0; i < cells; ++i)
    store(cellOf_[part.begin + i], before[i]);
}

template <int width>
void conservativeDiffusion::sample(FieldBundle<width>& fields, int used, const touchedCells& touched, int rings) {
  std::vector<bool> wanted(parts_.size(), false);
  if (!series_.empty())
    touched.forCells(rings, [&](label cell) { wanted[partOf_[cell]] = true; });
  for (std::size_t p = 0; p < parts_.size(); ++p)
    if (wanted[p] || parts_[p].acrossRanks)
      apply<width>(
          parts_[p], used, [&](label cell) { return fields[cell]; },
          [&](label cell, const Bundled<width>& result) { fields[cell] = result; });
}

template <int width> void conservativeDiffusion::spread(FieldBundle<width>& amounts, int used) {
  const scalarField& volume = mesh_.V();
  const auto carries = [&](label cell) {
    for (int k = 0; k < used; ++k)
      if (amounts[cell].at[k] != 0)
        return true;
    return false;
  };
  for (const Part& part : parts_)
    if (part.acrossRanks || std::any_of(cellOf_.begin() + part.begin, cellOf_.begin() + part.end, carries))
      apply<width>(
          part, used, [&](label cell) { return Bundled<width>{amounts[cell].at / volume[cell]}; },
          [&](label cell, const Bundled<width>& result) { amounts[cell].at = result.at * volume[cell]; });
}

template void conservativeDiffusion::spread(FieldBundle<kNarrow>&, int);
template void conservativeDiffusion::spread(FieldBundle<kWide>&, int);
template void conservativeDiffusion::sample(FieldBundle<kNarrow>&, int, const touchedCells&, int);
template void conservativeDiffusion::sample(FieldBundle<kWide>&, int, const touchedCells&, int);

} // namespace eccentra::exchange
