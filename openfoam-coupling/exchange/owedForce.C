// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Accounts of impulse, cell by cell.
#include "exchange/owedForce.H"

namespace eccentra::exchange {

using namespace Foam;

namespace {
/// Solid fraction below which nobody is there to take a debt; sampling gives such a cell this weight at most.
constexpr scalar kNobody = 1e-9;
/// Where the particles of a cell left most of it since the fluid was told, the rest of them does not take it all.
constexpr scalar kLeast = 0.5;
} // namespace

owedForce::owedForce(label cells) : back_(cells, Zero) {
  for (scalarField& component : owed_)
    component.setSize(cells, Zero);
}

vectorField owedForce::tell(const vectorField& given, const scalarField& fluidSolid, const scalarField& solid,
                            const scalarField& share) {
  vectorField told(given);
  forAll(given, cell) {
    const bool taken = solid[cell] > kNobody && solid[cell] > kLeast * fluidSolid[cell];
    for (direction k = 0; k < 3; ++k) {
      scalar& owed = owed_[k][cell];
      if (taken && share[cell] == 1 && owed == 0 && solid[cell] == fluidSolid[cell])
        continue;
      owed += fluidSolid[cell] * given[cell][k];
      if (taken)
        told[cell][k] = share[cell] * owed / solid[cell];
      owed -= solid[cell] * told[cell][k];
      back_[cell][k] = taken ? 0 : owed;
      if (!taken)
        owed = 0;
    }
  }
  return told;
}

void owedForce::addMemory(std::vector<scalarField*>& fields) {
  for (scalarField& component : owed_)
    fields.push_back(&component);
}

} // namespace eccentra::exchange
