// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The DEM side's half of a checkpoint, going on from one, and ends in order.
#include "styles/fluid/fix_fluid_couple.h"

#include "link/checkpoint/checkpoint_choice.h"
#include "link/ranks.h"
#include "link/stop_signal.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "modify.h"
#include "update.h"
#include "write_restart.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

/// The newest checkpoints that are kept: a damaged one has one before it.
constexpr int kKept = 2;
constexpr int kForceDoubles = 6;
constexpr int kCellHintDoubles = 2;

/// A restart file in memory, where no disk can be full: LIGGGHTS does not look whether its writing succeeds.
class FileInMemory {
 public:
  FileInMemory() : descriptor_(memfd_create("eccentra-restart", MFD_CLOEXEC)) {
    if (descriptor_ < 0)
      throw link::Refusal(std::string("no memory for a checkpoint: ") + std::strerror(errno));
  }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory() { ::close(descriptor_); }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  std::vector<char> contents() const {
    std::vector<char> bytes(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)));
    // A process whose files may not grow may not grow this one either.
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && bytes.size() >= limit.rlim_cur)
      throw link::Refusal("cannot write a checkpoint: files of this process may have " +
                          std::to_string(limit.rlim_cur) + " bytes only (ulimit -f): raise the limit");
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count = pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (count <= 0)
        throw link::Refusal("the restart file in memory cannot be read back");
      done += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

/// Also removes those that are newer: they belong to a run that was given up.
void remove_others(std::int64_t step) {
  int kept = 0;
  for (const std::int64_t other : link::numbered_entries(link::kCheckpoints, "")) {
    if (other <= step && kept++ < kKept)
      continue;
    std::error_code ignored;
    std::filesystem::remove_all(std::string(link::kCheckpoints) + '/' + std::to_string(other), ignored);
  }
}

} // namespace

void FixFluidCouple::plan_checkpoint() {
  const bool due = checkpoint_every_ > 0 && (coupling_steps_ + 1) % checkpoint_every_ == 0;
  next_reneighbor = due || stop_ ? update->ntimestep + countdown_ : -1;
  // The set-up of a run sorts the atoms; what it reads shall be sorted already.
  if (next_reneighbor >= 0 && atom->sortfreq > 0)
    atom->nextsort = std::min(atom->nextsort, next_reneighbor);
}

void FixFluidCouple::look_for_signals() {
  const int mine = link::stop_signal();
  int any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, world);
  if (stop_ == 0)
    stop_ = any;
  if (stop_ == 0)
    return;
  next_reneighbor = update->ntimestep;
  if (atom->sortfreq > 0)
    atom->nextsort = std::min(atom->nextsort, next_reneighbor);
}

void FixFluidCouple::write_checkpoint() {
  std::uint64_t id = 0;
  if (comm->me == 0) {
    std::random_device device;
    while (id == 0)
      id = (std::uint64_t(device()) << 32) | device();
  }
  MPI_Bcast(&id, 1, MPI_UINT64_T, 0, world);
  mark_ = {update->ntimestep, id};
  try {
    const std::string fluid_place = peer_->checkpoint(mark_);
    // Contact history is with the neighbour lists until somebody asks for it.
    modify->setup_pre_exchange();
    std::unique_ptr<FileInMemory> file;
    std::string path;
    link::on_root(world, [&] {
      file = std::make_unique<FileInMemory>();
      path = file->path();
      return link::wire::Bytes();
    });
    WriteRestart(lmp).write(path.data());
    link::on_root(world, [&] {
      const std::vector<char> bytes = file->contents();
      link::DurableFolder folder(std::string(link::kCheckpoints) + '/' + std::to_string(mark_.step));
      folder.add(link::kDemFile, bytes.data(), bytes.size());
      folder.commit(mark_, {{"fluid", fluid_place}});
      remove_others(mark_.step);
      return link::wire::Bytes();
    });
  } catch (const link::Refusal& refusal) {
    refuse(refusal.what());
  }
  mark_ = {};
}

void FixFluidCouple::stop_for_signal() {
  refuse(std::string(link::name_of_signal(stop_)) + " asked to stop: checkpoint " + std::to_string(update->ntimestep) +
         " is written on both sides, go on with -resume");
}

void FixFluidCouple::keep_particles() {
  try {
    std::string file;
    link::on_root(world, [&] {
      std::filesystem::create_directories(link::kCheckpoints);
      return link::wire::Bytes();
    });
    file = std::string(link::kCheckpoints) + "/particles-alone.restart";
    std::vector<char> name(file.begin(), file.end());
    name.push_back('\0');
    char* arguments[] = {name.data()};
    WriteRestart(lmp).command(1, arguments);
  } catch (const std::exception&) {
    // The sentence about the link is what counts.
  }
}

void FixFluidCouple::restore_forces() {
  resuming_ = false;
  mark_ = {};
  for (int i = 0; i < atom->nlocal; ++i) {
    std::copy_n(resumed_[i].values, 3, atom->f[i]);
    std::copy_n(resumed_[i].values + 3, 3, atom->torque[i]);
  }
  resumed_.clear();
  resumed_.shrink_to_fit();
}

int FixFluidCouple::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  std::copy_n(atom->f[i], 3, buffer + 1);
  std::copy_n(atom->torque[i], 3, buffer + 4);
  buffer[1 + kForceDoubles] = cell_hints_[i].rank;
  buffer[2 + kForceDoubles] = cell_hints_[i].cell;
  return size_restart(i);
}

void FixFluidCouple::unpack_restart(int row, int nth) {
  const double* extra = atom->extra[row];
  for (int i = 0; i < nth; ++i)
    extra += static_cast<int>(*extra);
  if (resuming_)
    std::copy_n(extra + 1, kForceDoubles, resumed_[row].values);
  cell_hints_[row] = {static_cast<std::int32_t>(extra[1 + kForceDoubles]),
                      static_cast<std::int32_t>(extra[2 + kForceDoubles])};
}

int FixFluidCouple::size_restart(int) {
  return 1 + kForceDoubles + kCellHintDoubles;
}

int FixFluidCouple::maxsize_restart() {
  return 1 + kForceDoubles + kCellHintDoubles;
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

// A restart file that is no checkpoint of both sides begins a run of its own: the particles meet the fluid that is
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
  met_ = true;
  resumed_.assign(atom->nmax, Resumed{});
}

} // namespace eccentra::styles
