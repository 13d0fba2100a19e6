// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of friction of a contact law without tangential forces: 0 for all materials.
#pragma once

#include <vector>

namespace eccentra::contact {

/// A matrix of zeros that stands where a property of pairs of atom types is expected.
class NoFriction {
 public:
  double** matrix(int types) {
    row_.assign(types + 1, 0.);
    rows_.assign(types + 1, row_.data());
    return rows_.data();
  }

 private:
  std::vector<double> row_;
  std::vector<double*> rows_;
};

} // namespace eccentra::contact
