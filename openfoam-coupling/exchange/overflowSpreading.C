// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rounds of moves between neighbours, kept so that they can be repeated and transposed.
#include "exchange/overflowSpreading.H"

#include "syncTools.H"
#include "volFields.H"

namespace eccentra::exchange {

using namespace Foam;

namespace {

/// Rounds until the spreading is given up; each carries the excess one cell further.
constexpr int kMostRounds = 400;
/// A cell may hold this much more than allowed, relatively, when the spreading ends.
constexpr double kSlack = 1e-3;

/// Calls visit(cell, boundary face, area) for every face through a coupled patch.
template <class Visit> void forCoupledFaces(const fvMesh& mesh, Visit visit) {
  for (const polyPatch& patch : mesh.boundaryMesh())
    if (patch.coupled())
      for (label i = 0; i < patch.size(); ++i) {
        const label face = patch.start() + i;
        visit(mesh.faceOwner()[face], face - mesh.nInternalFaces(), mag(mesh.faceAreas()[face]));
      }
}

} // namespace

overflowSpreading::overflowSpreading(const fvMesh& mesh, double largest)
    : mesh_(mesh), largest_(largest), openArea_(mesh.nCells(), VSMALL) {
  for (label face = 0; face < mesh.nInternalFaces(); ++face) {
    const double area = mag(mesh.faceAreas()[face]);
    openArea_[mesh.faceOwner()[face]] += area;
    openArea_[mesh.faceNeighbour()[face]] += area;
  }
  forCoupledFaces(mesh, [this](label cell, label, double area) { openArea_[cell] += area; });
}

scalarField overflowSpreading::behindBoundary(const scalarField& cellValues) const {
  scalarField values;
  syncTools::swapBoundaryCellList(mesh_, cellValues, values);
  return values;
}

void overflowSpreading::move(const Round& part, scalarField& amount) const {
  const scalarField leaving(part * amount);
  const scalarField perArea(leaving / openArea_);
  amount -= leaving;
  for (label face = 0; face < mesh_.nInternalFaces(); ++face) {
    const double area = mag(mesh_.faceAreas()[face]);
    const label own = mesh_.faceOwner()[face];
    const label other = mesh_.faceNeighbour()[face];
    amount[other] += area * perArea[own];
    amount[own] += area * perArea[other];
  }
  const scalarField behind(behindBoundary(perArea));
  forCoupledFaces(mesh_, [&](label cell, label face, double area) { amount[cell] += area * behind[face]; });
}

void overflowSpreading::gather(const Round& part, scalarField& field) const {
  scalarField mean(mesh_.nCells(), Zero);
  for (label face = 0; face < mesh_.nInternalFaces(); ++face) {
    const double area = mag(mesh_.faceAreas()[face]);
    const label own = mesh_.faceOwner()[face];
    const label other = mesh_.faceNeighbour()[face];
    mean[own] += area * field[other];
    mean[other] += area * field[own];
  }
  const scalarField behind(behindBoundary(field));
  forCoupledFaces(mesh_, [&](label cell, label face, double area) { mean[cell] += area * behind[face]; });
  field = (1.0 - part) * field + part * mean / openArea_;
}

bool overflowSpreading::settle(scalarField& solid) {
  rounds_.clear();
  const scalarField room(largest_ * mesh_.V());
  for (int round = 0; round < kMostRounds; ++round) {
    if (gMax(scalarField(solid / room)) <= 1.0 + kSlack)
      return true;
    if (round == 0 && gSum(solid) > gSum(room))
      return false;
    const scalarField part(max(solid - room, 0.0) / max(solid, VSMALL));
    move(part, solid);
    rounds_.push_back(part);
  }
  return false;
}

void overflowSpreading::spread(scalarField& amount) const {
  for (const Round& part : rounds_)
    move(part, amount);
}

void overflowSpreading::sample(scalarField& field) const {
  for (auto part = rounds_.rbegin(); part != rounds_.rend(); ++part)
    gather(*part, field);
}

} // namespace eccentra::exchange
