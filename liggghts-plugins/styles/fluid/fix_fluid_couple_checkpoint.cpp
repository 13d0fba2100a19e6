// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The DEM side's half of a checkpoint, going on from one, and ends in order.
#include "styles/fluid/fix_fluid_couple.h"

#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/checkpoint/resume_command.h"
#include "link/ranks.h"
#include "link/stop_signal.h"
#include "styles/entry/fix_checkpoint.h"
#include "styles/entry/script_replay.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "update.h"
#include "write_restart.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

constexpr int kCellHintDoubles = 2;
constexpr const char* kParticlesAlone = "checkpoints/particles-alone.restart";

} // namespace

// With checkpoints, neighbours are listed anew and atoms are sorted at every exchange with the fluid, as the set-up of
// a run that goes on from there does: whether a checkpoint is then written changes no digit.
void FixFluidCouple::plan_checkpoint() {
  next_reneighbor = checkpoints_ != Checkpoints::off || stop_ ? update->ntimestep + countdown_ : -1;
}

// Only now: a sort of LIGGGHTS's own since the last exchange would have set the next one after this step.
void FixFluidCouple::sort_with_neighbours() {
  if (next_reneighbor == update->ntimestep && atom->sortfreq > 0)
    atom->nextsort = std::min(atom->nextsort, next_reneighbor);
}

void FixFluidCouple::look_for_signals() {
  int state[2] = {link::stop_signal(), 0};
  if (checkpoints_ == Checkpoints::by_clock)
    state[1] = comm->me == 0 && clock_.due();
  MPI_Allreduce(MPI_IN_PLACE, state, 2, MPI_INT, MPI_MAX, world);
  if (stop_ == 0)
    stop_ = state[0];
  due_ = state[1] != 0 || (checkpoints_ == Checkpoints::counted && (coupling_steps_ + 1) % checkpoint_every_ == 0);
  if (stop_ != 0)
    next_reneighbor = update->ntimestep;
}

void FixFluidCouple::write_checkpoint() {
  const double begun = MPI_Wtime();
  mark_ = new_mark(lmp);
  try {
    const std::string fluid_place = peer_->checkpoint(mark_);
    write_dem_checkpoint(lmp, mark_, {{"fluid", fluid_place}});
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
  mark_ = {};
  due_ = false;
  clock_.written(MPI_Wtime() - begun);
}

void FixFluidCouple::stop_for_signal() {
  refuse(std::string(link::name_of_signal(stop_)) + " asked to stop: checkpoint " + std::to_string(update->ntimestep) +
         " is written on both sides, go on with: " + link::resume_command() +
         (own_peer_ ? ", and the fluid side with -resume" : ""));
}

void FixFluidCouple::begin_checkpoints() {
  if (resumed_step() >= 0 && !resuming_ && resumed_step() == update->ntimestep && !resumes_alone())
    refuse("checkpoint " + std::to_string(resumed_step()) +
           " has nothing of it: give it the ID that it had when the checkpoint was written");
  // The DEM side first: the fluid side, in the same folder or in another, looks after what is left.
  FixCheckpoint::find(lmp)->make_room();
}

void FixFluidCouple::keep_particles() {
  try {
    std::string file;
    link::on_root(world, [&] {
      std::filesystem::create_directories(link::kCheckpoints);
      return link::wire::Bytes();
    });
    file = kParticlesAlone;
    std::vector<char> name(file.begin(), file.end());
    name.push_back('\0');
    char* arguments[] = {name.data()};
    WriteRestart(lmp).command(1, arguments);
  } catch (const std::exception&) {
    // The sentence about the link is what counts.
  }
}

int FixFluidCouple::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  buffer[1] = cell_hints_[i].rank;
  buffer[2] = cell_hints_[i].cell;
  return size_restart(i);
}

void FixFluidCouple::unpack_restart(int row, int nth) {
  const double* extra = atom->extra[row];
  for (int i = 0; i < nth; ++i)
    extra += static_cast<int>(*extra);
  cell_hints_[row] = {static_cast<std::int32_t>(extra[1]), static_cast<std::int32_t>(extra[2])};
}

int FixFluidCouple::size_restart(int) {
  return 1 + kCellHintDoubles;
}

int FixFluidCouple::maxsize_restart() {
  return 1 + kCellHintDoubles;
}

void FixFluidCouple::write_restart(FILE* file) {
  if (comm->me != 0)
    return;
  const std::int64_t state[] = {mark_.step, static_cast<std::int64_t>(mark_.id), coupling_steps_,
                                static_cast<std::int64_t>(layout_)};
  const int bytes = sizeof state;
  std::fwrite(&bytes, sizeof bytes, 1, file);
  std::fwrite(state, sizeof state, 1, file);
}

// A restart file that is no checkpoint of both sides begins a run of its own: it begins with the fluid that is
// there.
void FixFluidCouple::restart(char* buffer) {
  std::int64_t state[4];
  std::memcpy(state, buffer, sizeof state);
  if (state[0] < 0)
    return;
  mark_ = {state[0], static_cast<std::uint64_t>(state[1])};
  coupling_steps_ = state[2];
  layout_ = static_cast<std::uint64_t>(state[3]);
  resuming_ = true;
  began_ = true;
}

} // namespace eccentra::styles
