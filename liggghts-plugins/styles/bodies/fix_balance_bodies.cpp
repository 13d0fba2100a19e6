// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix balance/bodies: moves the planes between ranks so that each has as many bodies to compute.
#include "base/option_reader.h"
#include "contact/balanced_planes.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {
/// Resolution of the counts along each direction.
constexpr int bins = 2000;
} // namespace

/// Fix style "balance/bodies": fix ID all balance/bodies every N [threshold T]. Stock LIGGGHTS keeps sub-domains of
/// equal size, but its communication works with any planes (Comm::uniform 0). Scalar: bodies of the fullest rank over
/// the mean.
class FixBalanceBodies : public Fix {
 public:
  FixBalanceBodies(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
    try {
      base::OptionReader reader({arg + 3, arg + narg});
      while (reader.more()) {
        const std::string& keyword = reader.keyword();
        if (keyword == "every")
          every_ = reader.count(1, "steps");
        else if (keyword == "threshold")
          threshold_ = reader.at_least(1);
        else
          reader.unknown("every, threshold");
      }
    } catch (const std::invalid_argument& problem) {
      fail(problem.what());
    }
    if (every_ == 0)
      fail("no interval: write `every N`, in steps");
    if (domain->triclinic)
      fail("works in orthogonal boxes only");
    scalar_flag = 1;
    global_freq = 1;
    force_reneighbor = 1;
    box_change_domain = 1;
    next_reneighbor = -1;
  }

  int setmask() override { return FixConst::PRE_EXCHANGE; }

  void init() override { next_reneighbor = (update->ntimestep / every_ + 1) * every_; }

  void pre_exchange() override {
    if (update->ntimestep < next_reneighbor)
      return;
    next_reneighbor = (update->ntimestep / every_ + 1) * every_;
    if (comm->nprocs == 1 || compute_scalar() <= threshold_)
      return;
    double* splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
    for (int k = 0; k < 3; ++k)
      if (comm->procgrid[k] > 1)
        move_planes(k, splits[k]);
    comm->uniform = 0;
    domain->set_local_box();
  }

  double compute_scalar() override {
    const int local = atom->nlocal;
    int most = 0, all = 0;
    MPI_Allreduce(&local, &most, 1, MPI_INT, MPI_MAX, world);
    MPI_Allreduce(&local, &all, 1, MPI_INT, MPI_SUM, world);
    return all > 0 ? static_cast<double>(most) * comm->nprocs / all : 1;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) {
    error->all(FLERR, ("fix " + std::string(id) + " balance/bodies: " + sentence).c_str());
    std::abort(); // not reached: error->all ends the run
  }

  void move_planes(int k, double* split) {
    std::vector<double> counts(bins, 0.);
    for (int i = 0; i < atom->nlocal; ++i) {
      const double part = (atom->x[i][k] - domain->boxlo[k]) / domain->prd[k];
      ++counts[std::clamp(static_cast<int>(part * bins), 0, bins - 1)];
    }
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), bins, MPI_DOUBLE, MPI_SUM, world);
    // Narrower slabs would take their ghosts from ranks farther away.
    const double narrowest = std::max(comm->cutghost[k], neighbor->cutneighmax) / domain->prd[k];
    const std::vector<double> planes(split, split + comm->procgrid[k] + 1);
    const std::vector<double> next = contact::balanced_planes(planes, counts, narrowest);
    std::copy(next.begin(), next.end(), split);
  }

  int every_ = 0;
  double threshold_ = 1.1;
};

namespace {
const RegisterFix<FixBalanceBodies> registered("balance/bodies", "moves the planes between ranks by their load");
}

} // namespace eccentra::styles
