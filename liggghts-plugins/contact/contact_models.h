// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The contact models that are evaluated in blocks: a table, one row each, for pairs, walls and the step limit; pure.
#pragma once

#include "contact/contact_law.h"

#include <string>
#include <vector>

namespace eccentra::contact {

/// Which damping: stock's, which returns e with Hertz springs, or the paper's 2 beta (eq 13-17).
enum class DampingLaw { stock, paper };

/// What a user chooses beside the model itself.
struct DampingChoice {
  DampingLaw law = DampingLaw::stock; ///< of the normal damper
  bool tangential = true;             ///< a tangential damper
};

/// A model turns overlap, radii, masses and materials of contacts into kn, kt, gamma_n and gamma_t.
struct ContactModel {
  const char* name; ///< after the keyword `model`
  /// Matrices over pairs of atom types, by their names in LIGGGHTS's property registry; they become the rows `material`
  /// in this order. No more than ContactRows::kMaterials.
  std::vector<const char*> properties;
  /// p of F ~ overlap^p: the tangent stiffness is p kn.
  double exponent;
  /// The kernel over contacts 0..n-1, for blocks of both sizes.
  void (*in_block)(ContactBlock&, int n, const DampingChoice&);
  /// The same kernel over larger blocks.
  void (*in_large_block)(LargeContactBlock&, int n, const DampingChoice&);

  /// Calls the kernel.
  void stiffness(ContactBlock& c, int n, const DampingChoice& damping) const { in_block(c, n, damping); }
  void stiffness(LargeContactBlock& c, int n, const DampingChoice& damping) const { in_large_block(c, n, damping); }
};

/// All models, in the order of the table.
const std::vector<ContactModel>& contact_models();
/// Null if there is no such row.
const ContactModel* find_contact_model(const std::string& name);

} // namespace eccentra::contact
