// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Disks that are full, for a moment or for good.
#include "link/background_job.h"
#include "reported/resumable_box.h"
#include "reported/resumable_heap.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <string>

using namespace eccentra::test;

TEST(Reported, adversary_1_disk_full_for_a_moment) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = beginning_of(whole, "parts");
  // Files of this process may not grow for a while: the table is the longest that it writes between two checkpoints.
  replace_in(folder / "in.dem", "checkpoint 4", "checkpoint 24");
  BackgroundJob job(folder, annulus_foam(), "log.run");
  ASSERT_TRUE(
      wait_until([&] { return fs::exists(folder / "postProcessing/eccentra/coupling.csv") && rows_of(folder) >= 4; }));
  rlimit usual{};
  ASSERT_EQ(prlimit(job.id(), RLIMIT_FSIZE, nullptr, &usual), 0);
  rlimit tight = usual;
  tight.rlim_cur = fs::file_size(folder / "postProcessing/eccentra/coupling.csv") + 100;
  ASSERT_EQ(prlimit(job.id(), RLIMIT_FSIZE, &tight, nullptr), 0);
  EXPECT_TRUE(job.says("takes no row", kLong)) << job.text();
  ASSERT_EQ(prlimit(job.id(), RLIMIT_FSIZE, &usual, nullptr), 0);
  EXPECT_EQ(job.wait(kLong), 0) << job.text();
  EXPECT_EQ(result_of(folder), whole.result);
}

TEST(Reported, adversary_1b_dump_cluster_vtk_on_a_full_disk) {
  const fs::path folder = fresh_folder("full");
  // Without checkpoints, which would find no room earlier.
  std::string script = heap_script("", 6000);
  const std::string keeps = "resumable every 1000";
  script.replace(script.find(keeps), keeps.size(), "#");
  write_file(folder / "in.heap", script);
  BackgroundJob job(folder, {program("eccentra-dem"), "-in", "in.heap", "-log", "none", "-var", "shape", "cube 64"},
                    "log.run");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "heap_0.vtp"); })) << job.text();
  job.limit_files(16384);
  EXPECT_NE(job.wait(kLong), 0);
  EXPECT_TRUE(holds(job.text(), "dump pictures cluster/vtk: file 'heap_5000.vtp' cannot be written (File too large)"))
      << job.text();
  EXPECT_FALSE(fs::exists(folder / "heap_5000.vtp"));
  EXPECT_FALSE(fs::exists(folder / "heap_5000.vtp.part"));
}

TEST(Reported, adversary_14_standard_output_on_a_full_disk) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = beginning_of(whole, "full");
  const ProgramResult result = start(folder, {"sh", "-c", "exec '" + program("annulusFoam") + "' > /dev/full"});
  EXPECT_EQ(result.signal, 0) << result.output;
  EXPECT_NE(result.status, 134) << result.output;
  EXPECT_FALSE(holds(result.output, "terminate called")) << result.output;
  EXPECT_LE(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  EXPECT_TRUE(holds(result.output, "standard output")) << result.output;
}
