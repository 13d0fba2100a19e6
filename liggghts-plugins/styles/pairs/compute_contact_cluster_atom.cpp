// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// compute contact/cluster/atom: how many bodies each body touches, and at how many sub-spheres.
#include "styles/entry/style_registry.h"
#include "styles/pairs/pair_gran_cluster.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <mpi.h>

#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

/// Per-atom array: 1 bodies touched (coordination number), 2 sub-contacts with them, 3 sub-contacts with the walls of
/// wall/gran/cluster.
class ComputeContactClusterAtom : public Compute {
 public:
  ComputeContactClusterAtom(LAMMPS* lmp, int& iarg, int narg, char** arg) : Compute(lmp, iarg, narg, arg) {
    if (iarg < narg)
      refuse("unknown word '" + std::string(arg[iarg]) + "'; expected no further words");
    peratom_flag = 1;
    size_peratom_cols = columns;
  }
  ~ComputeContactClusterAtom() override { memory->destroy(array_atom_own_); }

  void init() override {
    if (!dynamic_cast<PairGranCluster*>(force->pair))
      refuse("reads the contacts of pair_style gran/cluster, not of '" +
             std::string(force->pair ? force->pair_style : "none") + "'; expected compute contact/atom");
  }

  void compute_peratom() override {
    invoked_peratom = update->ntimestep;
    if (atom->nmax > room_) {
      room_ = atom->nmax;
      memory->destroy(array_atom_own_);
      memory->create(array_atom_own_, room_, static_cast<int>(columns), "contact/cluster/atom");
      array_atom = array_atom_own_;
    }
    for (int i = 0; i < atom->nlocal; ++i)
      std::fill(array_atom[i], array_atom[i] + columns, 0.);
    const auto& pair = dynamic_cast<PairGranCluster&>(*force->pair);
    pair.for_each_touching_pair([this](int a, int b, int contacts) {
      if (!(atom->mask[a] & atom->mask[b] & groupbit))
        return;
      for (const int i : {a, b})
        if (i < atom->nlocal) {
          array_atom[i][0] += 1;
          array_atom[i][1] += contacts;
        }
    });
    for (int f = 0; f < modify->nfix; ++f)
      if (auto* wall = dynamic_cast<FixWallGranCluster*>(modify->fix[f]))
        wall->for_each_stiffness([this](const contact::WallTouch& touch, const contact::ContactStiffness&) {
          if (touch.overlap <= 0)
            return; // a liquid bridge
          if (atom->mask[touch.atom] & groupbit)
            array_atom[touch.atom][2] += 1;
        });
  }

  double memory_usage() override { return static_cast<double>(room_) * columns * sizeof(double); }

 private:
  static constexpr int columns = 3;
  void refuse(const std::string& sentence) {
    error->all(FLERR, ("compute " + std::string(id) + " contact/cluster/atom: " + sentence).c_str());
  }
  double** array_atom_own_ = nullptr;
  int room_ = 0;
};

namespace {
const RegisterCompute<ComputeContactClusterAtom> registered("contact/cluster/atom",
                                                            "coordination number and sub-contacts of each body");
}

} // namespace eccentra::styles
