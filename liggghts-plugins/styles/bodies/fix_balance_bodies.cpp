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
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
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
/// the mean. A restart file contains the planes: a run goes on with them on the same grid of ranks.
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
    restart_global = 1;
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
    Planes next = planes();
    for (int k = 0; k < 3; ++k)
      if (comm->procgrid[k] > 1)
        next[k] = balanced(k, next[k]);
    set(next);
  }

  /// Bodies of a restart file are with the ranks of equal parts. They go to those of its planes here, where no rank has
  /// made a list of neighbours or a record of a contact yet. A run with a longer reach than that of the file, for which
  /// its slabs are too narrow, begins with equal parts.
  void setup_pre_exchange() override {
    if (restarted_[0].empty())
      return;
    for (int k = 0; k < 3; ++k)
      if (!contact::as_wide_as(restarted_[k], neighbor->cutneighmax / domain->prd[k])) {
        restarted_ = {};
        return;
      }
    domain->pbc();
    for (Planes now = planes(); now != restarted_; now = planes()) {
      for (int k = 0; k < 3; ++k)
        now[k] = contact::planes_towards(now[k], restarted_[k]);
      set(now);
      make_room();
      comm->exchange();
      // The next exchange forgets where each atom is, in an array that has room for those of the last map.
      if (atom->map_style)
        atom->map_set();
    }
    restarted_ = {};
  }

  void write_restart(FILE* file) override {
    if (comm->me != 0)
      return;
    std::vector<double> state;
    for (const std::vector<double>& of_direction : planes()) {
      state.push_back(static_cast<double>(of_direction.size()));
      state.insert(state.end(), of_direction.begin(), of_direction.end());
    }
    const int bytes = static_cast<int>(state.size() * sizeof(double));
    std::fwrite(&bytes, sizeof(int), 1, file);
    std::fwrite(state.data(), sizeof(double), state.size(), file);
  }

  void restart(char* buffer) override {
    Planes read;
    for (int k = 0; k < 3; ++k) {
      double count = 0;
      std::memcpy(&count, buffer, sizeof count);
      read[k].resize(static_cast<std::size_t>(count));
      std::memcpy(read[k].data(), buffer + sizeof count, read[k].size() * sizeof count);
      buffer += (1 + read[k].size()) * sizeof count;
      if (static_cast<int>(read[k].size()) != comm->procgrid[k] + 1)
        return; // another grid of ranks begins with equal parts
    }
    restarted_ = read;
  }

  double compute_scalar() override {
    const int local = atom->nlocal;
    int most = 0, all = 0;
    MPI_Allreduce(&local, &most, 1, MPI_INT, MPI_MAX, world);
    MPI_Allreduce(&local, &all, 1, MPI_INT, MPI_SUM, world);
    return all > 0 ? static_cast<double>(most) * comm->nprocs / all : 1;
  }

 private:
  /// Of each direction, as parts of the box, from 0 to 1.
  using Planes = std::array<std::vector<double>, 3>;

  Planes planes() const {
    Planes now;
    const double* const splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
    for (int k = 0; k < 3; ++k)
      now[k].assign(splits[k], splits[k] + comm->procgrid[k] + 1);
    return now;
  }

  void set(const Planes& next) {
    double* const splits[3] = {comm->xsplit, comm->ysplit, comm->zsplit};
    for (int k = 0; k < 3; ++k)
      std::copy(next[k].begin(), next[k].end(), splits[k]);
    comm->uniform = 0;
    domain->set_local_box();
  }

  /// In the buffers of migration, for the largest body of this rank: who keeps records of contacts makes room for them
  /// before each exchange of a run, but after this one. The records of a restart file are theirs; what else travels is
  /// short, and LIGGGHTS has room for a thousand numbers more.
  void make_room() const {
    int most = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
      int words = 0;
      for (int n = 0; n < modify->nfix; ++n)
        if (modify->fix[n]->restart_peratom)
          words += modify->fix[n]->size_restart(i);
      most = std::max(most, words);
    }
    comm->maxexchange_fix = std::max(comm->maxexchange_fix, most);
  }

  [[noreturn]] void fail(const std::string& sentence) {
    error->all(FLERR, ("fix " + std::string(id) + " balance/bodies: " + sentence).c_str());
    std::abort(); // not reached: error->all ends the run
  }

  std::vector<double> balanced(int k, const std::vector<double>& planes) const {
    std::vector<double> counts(bins, 0.);
    for (int i = 0; i < atom->nlocal; ++i) {
      const double part = (atom->x[i][k] - domain->boxlo[k]) / domain->prd[k];
      ++counts[std::clamp(static_cast<int>(part * bins), 0, bins - 1)];
    }
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), bins, MPI_DOUBLE, MPI_SUM, world);
    // Narrower slabs would take their ghosts from ranks farther away.
    const double narrowest = std::max(comm->cutghost[k], neighbor->cutneighmax) / domain->prd[k];
    return contact::balanced_planes(planes, counts, narrowest);
  }

  int every_ = 0;
  double threshold_ = 1.1;
  Planes restarted_; ///< of the restart file, until they are in use
};

namespace {
const RegisterFix<FixBalanceBodies> registered("balance/bodies", "moves the planes between ranks by their load");
}

} // namespace eccentra::styles
