// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The stirred box, whole and interrupted: what a run that goes on must give again.
#pragma once

#include "coupled/checkpoint_scene.h"
#include "link/background_job.h"
#include "link/checkpoint/durable_files.h"
#include "reported/programs_of_a_run.h"
#include "reported/table_of_run.h"

#include <csignal>
#include <cstdint>

namespace eccentra::test {

namespace fs = std::filesystem;

constexpr int kSteps = 24 * kStepsPerCouplingStep;

/// What a run leaves, by name and contents: particles, fields, table; not the clock.
inline std::string result_of(const fs::path& folder) {
  return contents(folder / "end.bodies") + physics_of_table(folder / "postProcessing/eccentra/coupling.csv");
}

/// A prepared box in `name`, and the result of the run that nobody interrupts.
struct Straight {
  fs::path folder;
  std::string result;
};

inline Straight straight(const BoxCase& box, const std::string& name, int ranks = 1) {
  const Outcome outcome = run(box, name, ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.text << contents(fs::path(outcome.folder) / "log.liggghts");
  return {outcome.folder, result_of(outcome.folder)};
}

/// Folders of OpenFOAM's times, all but that of the beginning.
inline std::vector<fs::path> times_of(const fs::path& folder) {
  std::vector<fs::path> times;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != "0" && name.find_first_not_of("0123456789.") == std::string::npos)
      times.push_back(entry.path());
  }
  return times;
}

inline fs::path newest_time(const fs::path& folder) {
  const std::vector<fs::path> times = times_of(folder);
  return *std::max_element(times.begin(), times.end(), [](const fs::path& a, const fs::path& b) {
    return std::stod(a.filename()) < std::stod(b.filename());
  });
}

inline std::int64_t newest_checkpoint_of(const fs::path& folder) {
  const auto steps = eccentra::link::numbered_entries(folder / "checkpoints", "");
  return steps.empty() ? -1 : steps.front();
}

/// The same folder before the run.
inline fs::path beginning_of(const Straight& run, const std::string& name) {
  const fs::path copy = fs::absolute(name);
  fs::remove_all(copy);
  fs::copy(run.folder, copy, fs::copy_options::recursive);
  for (const char* part : {"checkpoints", "postProcessing", "end.bodies", "log.liggghts"})
    fs::remove_all(copy / part);
  for (const fs::path& time : times_of(copy))
    fs::remove_all(time);
  return copy;
}

inline BoxCase resumable_box(const std::string& arguments = "solver every 40 checkpoint 4", bool clusters = false) {
  return stirred_box(arguments, kSteps, clusters, false, true);
}

/// A run of the box that ended in the middle, as after kill -9, with checkpoints of steps 320 and 480.
inline fs::path interrupted(const Straight& run, const std::string& name) {
  const fs::path folder = beginning_of(run, name);
  BackgroundJob job(folder, annulus_foam(), "log.first");
  EXPECT_TRUE(wait_until([&] { return fs::exists(folder / "checkpoints/480"); })) << job.text();
  job.signal(SIGKILL);
  job.wait(kLong);
  return folder;
}

} // namespace eccentra::test
