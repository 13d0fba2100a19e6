// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements fix checkpoint/state.
#include "styles/entry/fix_checkpoint.h"

#include "link/checkpoint/resume_command.h"
#include "link/ranks.h"
#include "link/stop_signal.h"
#include "styles/entry/random_states.h"
#include "styles/entry/script_replay.h"
#include "styles/entry/style_registry.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_property_atom.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <sstream>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

const RegisterFix<FixCheckpoint> registered("checkpoint/state",
                                            "added by resumable and fix fluid/couple: what a checkpoint keeps");

constexpr const char* kId = "eccentra_checkpoint";
constexpr int kRelease = 6; ///< place of the release step
constexpr int kDoubles = 7;
constexpr double kNoStep = -1;
/// Fix insert/stream keeps its bodies' data in a fix of this ID; the release step is in this column.
constexpr const char* kStreamData = "release_fix_insert_stream";
constexpr int kReleaseColumn = 4;
/// Listing neighbours anew costs a few steps.
constexpr std::int64_t kMinGrid = 50;
constexpr std::int64_t kMaxGrid = 200;
/// Of two time steps that are the same.
constexpr double kSameTimeStep = 1e-12;

std::int64_t grid_of(std::int64_t every) {
  if (every == 0)
    return kMaxGrid;
  for (std::int64_t grid = std::min(every, kMaxGrid); grid >= kMinGrid; --grid)
    if (every % grid == 0)
      return grid;
  return every;
}

/// Null where no fix insert/stream is there.
double** stream_data(LAMMPS* lmp) {
  const int found = lmp->modify->find_fix(kStreamData);
  const auto* const data = found < 0 ? nullptr : dynamic_cast<FixPropertyAtom*>(lmp->modify->fix[found]);
  return data ? data->array_atom : nullptr;
}

/// The texts of all ranks on the first.
std::vector<std::string> gathered(const std::string& mine, MPI_Comm world) {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(world, &rank);
  MPI_Comm_size(world, &ranks);
  const int size = static_cast<int>(mine.size());
  std::vector<int> sizes(ranks), offsets(ranks + 1);
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, world);
  std::partial_sum(sizes.begin(), sizes.end(), offsets.begin() + 1);
  std::string all(rank == 0 ? offsets.back() : 0, ' ');
  MPI_Gatherv(mine.data(), size, MPI_CHAR, all.data(), sizes.data(), offsets.data(), MPI_CHAR, 0, world);
  std::vector<std::string> texts;
  for (int r = 0; rank == 0 && r < ranks; ++r)
    texts.push_back(all.substr(offsets[r], sizes[r]));
  return texts;
}

} // namespace

FixCheckpoint::FixCheckpoint(LAMMPS* lmp, int narg, char** arg)
    : Fix(lmp, narg, arg), every_(narg > 3 ? std::strtoll(arg[3], nullptr, 10) : 0), grid_(grid_of(every_)) {
  nevery = 1;
  create_attribute = 1;
  restart_global = 1;
  restart_peratom = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  link::catch_stop_signals("eccentra-dem");
  atom->add_callback(0);
  atom->add_callback(1);
}

FixCheckpoint::~FixCheckpoint() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

FixCheckpoint* FixCheckpoint::find(LAMMPS* lmp) {
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* const found = dynamic_cast<FixCheckpoint*>(lmp->modify->fix[i]))
      return found;
  return nullptr;
}

void FixCheckpoint::add(LAMMPS* lmp, std::int64_t every) {
  if (find(lmp))
    return;
  std::string words[] = {kId, "all", "checkpoint/state", std::to_string(every)};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data()};
  lmp->modify->add_fix(4, arguments);
}

void FixCheckpoint::refuse(const std::string& text) {
  error->all(FLERR, ("checkpoint: " + text).c_str());
  std::abort(); // error->all does not return
}

int FixCheckpoint::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::END_OF_STEP;
}

// There is nothing to set for the atoms that are there; LIGGGHTS need not visit them again at the first set-up.
void FixCheckpoint::post_create() {
  just_created = 0;
}

void FixCheckpoint::init() {
  alone_ = modify->find_fix_style("fluid/couple", 0) == nullptr;
  if (resuming())
    restore_insertions(lmp, states_);
}

void FixCheckpoint::setup(int) {
  if (resuming() && update->ntimestep != resumed_step_)
    refuse("this run begins at step " + std::to_string(update->ntimestep) + " but the checkpoint is one of step " +
           std::to_string(resumed_step_) + ": remove what changes the step between reading the checkpoint and the run");
  if (resuming() && std::abs(update->dt - resumed_time_step_) > kSameTimeStep * resumed_time_step_) {
    std::ostringstream text;
    text.precision(12);
    text << "timestep is " << update->dt << " s but the checkpoint was written with " << resumed_time_step_
         << " s: give the script the same, or begin a run of its own from dem.restart by read_restart, without -resume";
    refuse(text.str());
  }
  make_room();
}

void FixCheckpoint::make_room() {
  try {
    make_room_for_checkpoints(lmp, resumed_step_);
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
}

void FixCheckpoint::pre_initial_integrate() {
  if (resuming())
    restore();
  due_ = false;
  if (!alone_ || update->ntimestep % grid_ != 0)
    return;
  int state[2] = {link::stop_signal(), comm->me == 0 && every_ == 0 && clock_.due()};
  MPI_Allreduce(MPI_IN_PLACE, state, 2, MPI_INT, MPI_MAX, world);
  stop_ = state[0];
  due_ = stop_ != 0 || state[1] != 0 || (every_ > 0 && update->ntimestep % every_ == 0);
  // The set-up of a run that goes on from here lists and sorts the atoms, too.
  next_reneighbor = update->ntimestep;
  if (atom->sortfreq > 0)
    atom->nextsort = std::min(atom->nextsort, next_reneighbor);
}

void FixCheckpoint::end_of_step() {
  if (!due_)
    return;
  due_ = false;
  const double begun = MPI_Wtime();
  try {
    write_dem_checkpoint(lmp, new_mark(lmp));
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
  clock_.written(MPI_Wtime() - begun);
  if (stop_)
    refuse(std::string(link::name_of_signal(stop_)) + " asked to stop: checkpoint " +
           std::to_string(update->ntimestep) + " is written, go on with: " + link::resume_command());
}

void FixCheckpoint::restore() {
  resumed_step_ = -1;
  for (int i = 0; forces_carry_on() && i < atom->nlocal; ++i) {
    std::copy_n(resumed_[i].values, 3, atom->f[i]);
    if (atom->torque)
      std::copy_n(resumed_[i].values + 3, 3, atom->torque[i]);
  }
  // LIGGGHTS has taken it from the way that the body has gone, and cut off what comes after the point.
  double** const stream = stream_data(lmp);
  for (int i = 0; stream && i < atom->nlocal; ++i)
    if (resumed_[i].values[kRelease] != kNoStep)
      stream[i][kReleaseColumn] = resumed_[i].values[kRelease];
  restore_random_states(lmp, states_);
  states_.clear();
  resumed_.clear();
  resumed_.shrink_to_fit();
}

void FixCheckpoint::grow_arrays(int rows) {
  if (resuming())
    resumed_.resize(rows);
}

void FixCheckpoint::copy_arrays(int from, int to, int) {
  if (resuming())
    resumed_[to] = resumed_[from];
}

void FixCheckpoint::set_arrays(int i) {
  if (resuming())
    resumed_[i] = Resumed{};
}

int FixCheckpoint::pack_exchange(int i, double* buffer) {
  if (!resuming())
    return 0;
  std::copy_n(resumed_[i].values, kDoubles, buffer);
  return kDoubles;
}

int FixCheckpoint::unpack_exchange(int row, double* buffer) {
  if (!resuming())
    return 0;
  std::copy_n(buffer, kDoubles, resumed_[row].values);
  return kDoubles;
}

int FixCheckpoint::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  std::copy_n(atom->f[i], 3, buffer + 1);
  std::fill_n(buffer + 4, 4, 0.0);
  if (atom->torque)
    std::copy_n(atom->torque[i], 3, buffer + 4);
  if (double** const stream = stream_data(lmp))
    buffer[1 + kRelease] = stream[i][kReleaseColumn];
  return size_restart(i);
}

void FixCheckpoint::unpack_restart(int row, int nth) {
  if (!resuming())
    return;
  const double* extra = atom->extra[row];
  for (int i = 0; i < nth; ++i)
    extra += static_cast<int>(*extra);
  // Records of earlier versions have no release step.
  resumed_[row].values[kRelease] = kNoStep;
  std::copy_n(extra + 1, std::min(static_cast<int>(*extra) - 1, kDoubles), resumed_[row].values);
}

int FixCheckpoint::size_restart(int) {
  return 1 + kDoubles;
}

int FixCheckpoint::maxsize_restart() {
  return 1 + kDoubles;
}

// Step, time step, ranks; then of each rank the number of bytes of its states and these.
void FixCheckpoint::write_restart(FILE* file) {
  const std::vector<std::string> states = gathered(random_states(lmp), world);
  if (comm->me != 0)
    return;
  std::ostringstream text;
  text.precision(17);
  text << (writing_ ? update->ntimestep : -1) << ' ' << update->dt << ' ' << comm->nprocs << '\n';
  for (const std::string& state : states)
    text << state.size() << '\n' << state;
  const std::string all = text.str();
  const int bytes = static_cast<int>(all.size()) + 1;
  std::fwrite(&bytes, sizeof bytes, 1, file);
  std::fwrite(all.c_str(), 1, bytes, file);
}

// A restart file that is no checkpoint begins a run of its own.
void FixCheckpoint::restart(char* buffer) {
  std::istringstream text(buffer);
  long long step = -1;
  int ranks = 0;
  text >> step >> resumed_time_step_ >> ranks;
  if (step < 0)
    return;
  resumed_step_ = step;
  resumed_.assign(atom->nmax, Resumed{});
  // Other ranks have other places to insert at: their generators begin as LIGGGHTS has it.
  const bool same_ranks = ranks == comm->nprocs;
  for (int rank = 0; rank <= (same_ranks ? comm->me : 0); ++rank) {
    std::size_t bytes = 0;
    text >> bytes;
    text.get();
    states_.assign(bytes, ' ');
    text.read(states_.data(), static_cast<std::streamsize>(bytes));
  }
  if (!same_ranks)
    states_ = next_insertions(states_);
  // Insertions that are initialised before this fix.
  restore_insertions(lmp, states_);
}

} // namespace eccentra::styles
