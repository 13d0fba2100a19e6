// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Accounts of impulse, cell by cell.
#include "exchange/pendingForce.H"

namespace eccentra::exchange {

using namespace Foam;

namespace {
/// Solid fraction below which nobody is there to take a debt; sampling gives such a cell this weight at most.
constexpr scalar kNobody = 1e-9;
/// Where the particles of a cell left most of it since the fluid was told, the rest of them does not take it all.
constexpr scalar kLeast = 0.5;
} // namespace

pendingForce::pendingForce(label cells) : back_(cells, Zero) {
  for (scalarField& component : pending_)
    component.setSize(cells, Zero);
}

vectorField pendingForce::tell(const vectorField& given, const scalarField& fluidSolid, const scalarField& solid,
                               const scalarField& share) {
  vectorField applied(given);
  forAll(given, cell) {
    const bool taken = solid[cell] > kNobody && solid[cell] > kLeast * fluidSolid[cell];
    for (direction k = 0; k < 3; ++k) {
      scalar& deferred = pending_[k][cell];
      if (taken && share[cell] == 1 && deferred == 0 && solid[cell] == fluidSolid[cell])
        continue;
      deferred += fluidSolid[cell] * given[cell][k];
      if (taken)
        applied[cell][k] = share[cell] * deferred / solid[cell];
      deferred -= solid[cell] * applied[cell][k];
      back_[cell][k] = taken ? 0 : deferred;
      if (!taken)
        deferred = 0;
    }
  }
  return applied;
}

void pendingForce::addMemory(std::vector<scalarField*>& fields) {
  for (scalarField& component : pending_)
    fields.push_back(&component);
}

} // namespace eccentra::exchange
