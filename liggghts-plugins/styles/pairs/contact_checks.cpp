// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// At the start of each run with clusters: a contact that one body keeps is kept by the other, too.
#include "styles/bodies/body_checks.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/incompatible_styles.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/fix_cluster_history.h"

#include "atom.h"
#include "lammps.h"
#include "update.h"

#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;

/// Contacts are kept by the ids of both bodies: whoever keeps one with a body of this rank must be kept by it.
class ContactCheck {
 public:
  ContactCheck(LAMMPS* lmp, FixClusterHistory* history) : history_(history), tag_(lmp->atom->tag) {
    if (!history_)
      return;
    for (int i = 0; i < lmp->atom->nlocal; ++i)
      if (!history_->touches(i).empty())
        owner_.emplace(tag_[i], i);
    for (int i = 0; i < lmp->atom->nlocal; ++i)
      here_.push_back(tag_[i]);
    std::sort(here_.begin(), here_.end());
  }

  std::string problem(int i) const {
    if (!history_)
      return {};
    for (const Touch& touch : history_->touches(i)) {
      const auto partner = owner_.find(touch.partner);
      const bool kept = partner != owner_.end() && keeps(partner->second, tag_[i]);
      if (!kept && std::binary_search(here_.begin(), here_.end(), touch.partner))
        return "contact with atom '" + std::to_string(touch.partner) +
               "' is not kept by that atom; expected ids that stay as they are between runs; delete atoms with "
               "delete_atoms, and renumber them by no other way";
    }
    return {};
  }

 private:
  bool keeps(int i, int tag) const {
    const std::vector<Touch>& touches = history_->touches(i);
    return std::any_of(touches.begin(), touches.end(), [tag](const Touch& touch) { return touch.partner == tag; });
  }

  FixClusterHistory* history_;
  const int* tag_;
  std::unordered_map<int, int> owner_;
  std::vector<int> here_;
};

void check_contacts(LAMMPS* lmp) {
  const FixClusterBodies* bodies = bodies_in_script(lmp);
  if (!bodies || lmp->update->whichflag != 1)
    return;
  const Atom& atom = *lmp->atom;
  const ContactCheck contacts(lmp, FixClusterHistory::find(lmp));
  int lowest = std::numeric_limits<int>::max();
  std::string sentence;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (bodies->shape_id(i) == FixClusterBodies::plain_sphere || atom.tag[i] >= lowest)
      continue;
    if (const std::string problem = contacts.problem(i); !problem.empty()) {
      lowest = atom.tag[i];
      sentence = body_name(atom, *bodies, i) + ": " + problem;
    }
  }
  stop_at_lowest(lmp, lowest, sentence);
}

const RegisterSceneCheck registered(&check_contacts);

} // namespace
} // namespace eccentra::styles
