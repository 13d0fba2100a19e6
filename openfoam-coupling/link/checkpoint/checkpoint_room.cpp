// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Moves what is there, never over what is there.
#include "link/checkpoint/checkpoint_room.h"

#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/resume_command.h"

#include <filesystem>
#include <vector>

namespace eccentra::link {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFinished = "finished";
constexpr const char* kTable = "postProcessing/eccentra/coupling.csv";

[[noreturn]] void cannot_keep(const fs::path& path, const std::error_code& reason) {
  throw Refusal("cannot keep '" + path.string() + "' of an earlier run beside (" + reason.message() +
                "): move it away yourself");
}

fs::path free_name(const fs::path& path) {
  for (int number = 1;; ++number) {
    const fs::path name = path.string() + ".before-" + std::to_string(number);
    if (!fs::exists(fs::symlink_status(name)))
      return name;
  }
}

/// Entries of the DEM side's halves, newer than `step`.
std::vector<std::string> dem_halves(const fs::path& checkpoints, std::int64_t step) {
  std::vector<std::string> names;
  for (const std::int64_t other : numbered_entries(checkpoints, ""))
    if (other > step)
      names.push_back(std::to_string(other));
  return names;
}

/// And of the fluid's.
std::vector<std::string> fluid_halves(const fs::path& checkpoints, std::int64_t step) {
  std::vector<std::string> names;
  for (const std::int64_t other : numbered_entries(checkpoints, kFluidPrefix, kFluidRecord))
    if (other > step) {
      names.push_back(kFluidPrefix + std::to_string(other));
      names.push_back(kFluidPrefix + std::to_string(other) + kFluidRecord);
    }
  return names;
}

} // namespace

std::string keep_beside(const std::string& path) {
  const fs::path name = free_name(path);
  std::error_code problem;
  fs::rename(path, name, problem);
  if (problem)
    cannot_keep(path, problem);
  return name;
}

std::string make_room_for_checkpoints(const std::string& folder, Side side, std::int64_t step, bool asked_to_resume) {
  const fs::path checkpoints = fs::path(folder) / kCheckpoints;
  const fs::path finished = checkpoints / kFinished;
  std::error_code problem;
  std::vector<std::string> names = side == Side::dem ? dem_halves(checkpoints, step) : fluid_halves(checkpoints, step);
  if (names.empty()) {
    fs::remove(finished, problem);
    return "";
  }
  if (step < 0 && !asked_to_resume && !fs::exists(finished))
    throw Refusal("'" + checkpoints.string() + "' has checkpoint " + names.front() +
                  " of a run that was interrupted: go on with: " + resume_command() +
                  "; or remove or rename that folder to begin anew");
  if (side == Side::dem)
    for (const std::string& name : fluid_halves(checkpoints, step))
      names.push_back(name);
  const fs::path beside = free_name(checkpoints);
  fs::create_directory(beside, problem);
  for (const std::string& name : names)
    if (!problem && fs::exists(checkpoints / name))
      fs::rename(checkpoints / name, beside / name, problem);
  // A run that begins keeps the table beside itself.
  if (!problem && step >= 0 && fs::exists(fs::path(folder) / kTable))
    fs::copy_file(fs::path(folder) / kTable, beside / fs::path(kTable).filename(), problem);
  if (problem)
    cannot_keep(checkpoints, problem);
  fs::remove(finished, problem);
  return (step < 0 ? "the checkpoints of an earlier run are kept in '"
                   : "newer checkpoints than the one that this run goes on from are kept in '") +
         beside.string() + "'";
}

void mark_finished(const std::string& folder) {
  const fs::path checkpoints = fs::path(folder) / kCheckpoints;
  if (fs::is_directory(checkpoints))
    write_record(checkpoints / kFinished, {0, 0}, {});
}

} // namespace eccentra::link
