// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The properties of pairs of materials that a contact model asks for, from LIGGGHTS's registry.
#pragma once

#include "contact/contact_models.h"

#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

class ContactMaterials {
 public:
  /// Fetches the properties of `model` (and Coulomb's coefficient, else it is 0) anew: before each run. `caller` is
  /// named in LIGGGHTS's messages about properties that are missing.
  void connect(LAMMPS_NS::LAMMPS* lmp, const contact::ContactModel& model, bool friction, const char* caller);

  double friction(int type, int other) const { return friction_ ? friction_[type][other] : 0; }

  /// Property k of the model.
  double value(int k, int type, int other) const { return matrices_[k][type][other]; }

  /// Writes the rows `material` and `friction` of contacts first..last-1.
  template <class Block> void fill(Block& c, int first, int last, int type, int other) const {
    const double mu = friction(type, other);
    for (int m = first; m < last; ++m)
      c.friction[m] = mu;
    for (std::size_t k = 0; k < matrices_.size(); ++k) {
      const double value = matrices_[k][type][other];
      for (int m = first; m < last; ++m)
        c.material[k][m] = value;
    }
  }

 private:
  std::vector<double**> matrices_; ///< in the order of contact::ContactModel::properties
  double** friction_ = nullptr;
};

} // namespace eccentra::styles
