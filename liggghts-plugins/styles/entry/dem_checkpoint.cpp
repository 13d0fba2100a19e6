// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The restart file passes through memory, where no disk can be full.
#include "styles/entry/dem_checkpoint.h"

#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/ranks.h"
#include "styles/entry/fix_checkpoint.h"
#include "styles/entry/script_replay.h"

#include <mpi.h>

#include "comm.h"
#include "fix_insert_stream.h"
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
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

namespace eccentra::styles {

namespace {

/// The newest checkpoints that are kept: a damaged one has one before it.
constexpr int kKept = 2;
/// Of CheckpointClock.
constexpr double kMinSeconds = 5.0;
constexpr double kMaxShare = 0.01;

/// LIGGGHTS does not look whether its writing succeeds.
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

/// Those that are newer were kept beside when the run began.
void remove_old(std::int64_t step) {
  int kept = 0;
  for (const std::int64_t other : link::numbered_entries(link::kCheckpoints, "")) {
    if (other > step || kept++ < kKept)
      continue;
    std::error_code ignored;
    std::filesystem::remove_all(std::string(link::kCheckpoints) + '/' + std::to_string(other), ignored);
  }
}

} // namespace

link::CheckpointMark new_mark(LAMMPS* lmp) {
  std::uint64_t id = 0;
  if (lmp->comm->me == 0) {
    std::random_device device;
    while (id == 0)
      id = (std::uint64_t(device()) << 32) | device();
  }
  MPI_Bcast(&id, 1, MPI_UINT64_T, 0, lmp->world);
  return {lmp->update->ntimestep, id};
}

void write_dem_checkpoint(LAMMPS* lmp, const link::CheckpointMark& mark, link::Notes notes) {
  // A stream moves its bodies at the end of a step, perhaps after the fix that writes: it may do so twice.
  for (int i = 0; i < lmp->modify->nfix; ++i)
    if (auto* const stream = dynamic_cast<FixInsertStream*>(lmp->modify->fix[i]))
      stream->end_of_step();
  // Contact history is with the neighbour lists until somebody asks for it.
  lmp->modify->setup_pre_exchange();
  std::unique_ptr<FileInMemory> file;
  std::string path;
  link::on_root(lmp->world, [&] {
    file = std::make_unique<FileInMemory>();
    path = file->path();
    return link::wire::Bytes();
  });
  FixCheckpoint* const state = FixCheckpoint::find(lmp);
  if (state)
    state->begin_checkpoint();
  WriteRestart(lmp).write(path.data());
  if (state)
    state->end_checkpoint();
  for (const RunSpan& run : runs_so_far())
    notes.emplace_back("run", std::to_string(run.first) + ' ' + std::to_string(run.last));
  link::on_root(lmp->world, [&] {
    const std::vector<char> bytes = file->contents();
    link::DurableFolder folder(std::string(link::kCheckpoints) + '/' + std::to_string(mark.step));
    folder.add(link::kDemFile, bytes.data(), bytes.size());
    folder.commit(mark, notes);
    remove_old(mark.step);
    return link::wire::Bytes();
  });
}

void make_room_for_checkpoints(LAMMPS* lmp, std::int64_t step) {
  link::on_root(lmp->world, [&] {
    // What this process has written itself is in nobody's way: a script may clear and begin anew.
    static std::set<std::filesystem::path> done;
    if (!done.insert(std::filesystem::current_path()).second)
      return link::wire::Bytes();
    const std::string sentence = link::make_room_for_checkpoints(".", link::Side::dem, step, asked_to_resume());
    if (!sentence.empty())
      for (FILE* out : {lmp->screen, lmp->logfile})
        if (out)
          std::fprintf(out, "%s\n", sentence.c_str());
    return link::wire::Bytes();
  });
}

CheckpointClock::CheckpointClock() : last_(MPI_Wtime()) {}

bool CheckpointClock::due() const {
  return MPI_Wtime() - last_ >= std::max(kMinSeconds, cost_ / kMaxShare);
}

void CheckpointClock::written(double seconds) {
  last_ = MPI_Wtime();
  cost_ = seconds;
}

} // namespace eccentra::styles
