// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and damping of one contact, as whoever limits the time step wants them.
#pragma once

namespace eccentra::contact {

/// Linear stiffness and damping of one contact.
struct ContactStiffness {
  double normal;             ///< d Fn / d overlap [N/m]
  double tangential;         ///< [N/m]
  double normal_damping;     ///< [kg/s]
  double tangential_damping; ///< [kg/s]
};

/// Of contact m of a block whose stiffness and damping a model with this exponent has filled in.
template <class Block> ContactStiffness stiffness_of(const Block& c, int m, double exponent) {
  return {exponent * c.kn[m], c.kt[m], c.gamma_n[m], c.gamma_t[m]};
}

} // namespace eccentra::contact
