// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A script of particles alone, with insertions, goes on from its checkpoint with the same digits.
#include "link/background_job.h"
#include "reported/resumable_heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

using namespace eccentra::test;

namespace {

void expect_heap_goes_on(int ranks) {
  constexpr int kHeapSteps = 9000;
  std::vector<std::string> arguments;
  if (ranks > 1)
    arguments = {"mpirun", "--oversubscribe",    "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1",
                 "-np",    std::to_string(ranks)};
  arguments.insert(arguments.end(), {program("eccentra-dem"), "-in", "in.heap"});
  const fs::path whole = fresh_folder("whole"), parts = fresh_folder("parts");
  for (const fs::path& folder : {whole, parts})
    write_file(folder / "in.heap", heap_script(ranks > 1 ? "processors 2 1 1" : "", kHeapSteps));
  ASSERT_EQ(start(whole, arguments).status, 0);
  ASSERT_FALSE(contents(whole / "end.bodies").empty());
  {
    BackgroundJob job(parts, arguments, "log.first");
    ASSERT_TRUE(wait_until([&] { return fs::exists(parts / "checkpoints/4000"); })) << job.text();
    std::vector<int> all;
    for (int child = 0; ranks > 1 && job.child(child) > 0; ++child)
      all.push_back(job.child(child));
    for (const int child : all)
      kill(child, SIGKILL);
    job.signal(SIGKILL);
    job.wait(kLong);
  }
  EXPECT_FALSE(fs::exists(parts / "end.bodies"));
  arguments.emplace_back("-resume");
  const ProgramResult again = start(parts, arguments);
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_TRUE(holds(again.output, "goes on from checkpoint")) << again.output;
  EXPECT_EQ(contents(parts / "end.bodies"), contents(whole / "end.bodies"));
}

} // namespace

TEST(Reported, adversary_12_a_resumed_run_that_inserts) {
  expect_heap_goes_on(1);
}

TEST(Reported, adversary_12_a_resumed_run_that_inserts_on_two_ranks) {
  expect_heap_goes_on(2);
}

TEST(Reported, resume_every_insertion) {
  const char* const common = " seed 86028121 distributiontemplate grains overlapcheck yes verbose no ";
  const struct {
    const char* style;
    const char* words;
  } insertions[] = {
      {"rate/region",
       "all_in yes mass 0.05 massrate 0.3 insert_every 1000 vel gaussian 0 0 -0.5 0.1 0.1 0.1 region spout"},
      {"pack", "all_in yes insert_every 1000 vel uniform 0 0 -0.5 0.1 0.1 0.1 region spout particles_in_region 25"},
      {"pack", "all_in yes insert_every once vel constant 0 0 -0.5 region spout particles_in_region 40"},
      {"stream",
       "all_in no nparticles 100 particlerate 800 vel constant 0 0 -0.8 insertion_face face extrude_length 0.04"}};
  int number = 0;
  for (const auto& insertion : insertions) {
    SCOPED_TRACE(std::string(insertion.style) + ' ' + insertion.words);
    std::string script = heap_script("", 4000);
    const auto replaced = [&](const std::string& from, const std::string& upto, const std::string& by) {
      const std::size_t at = script.find(from), end = script.find(upto, at);
      ASSERT_NE(end, std::string::npos) << from;
      script.replace(at, end - at, by);
    };
    replaced("fix pour", "fix floor",
             "fix face all mesh/surface/planar file face.stl type 1\nfix pour all insert/" +
                 std::string(insertion.style) + common + insertion.words + '\n');
    replaced("every 1000", "#", "every 700 ");
    const std::string name = std::to_string(++number);
    const fs::path whole = fresh_folder("whole" + name), parts = fresh_folder("parts" + name);
    for (const fs::path& folder : {whole, parts}) {
      write_file(folder / "in.heap", script);
      write_file(folder / "face.stl",
                 "solid f\nfacet normal 0 0 1\nouter loop\nvertex -0.02 -0.02 0.2\nvertex 0.02 -0.02 0.2\n"
                 "vertex 0 0.02 0.2\nendloop\nendfacet\nendsolid f\n");
    }
    const std::vector<std::string> arguments = {program("eccentra-dem"), "-in", "in.heap", "-var", "shape", "cube 8"};
    ASSERT_EQ(start(whole, arguments).status, 0) << start(whole, arguments).output;
    BackgroundJob job(parts, arguments, "log.first");
    ASSERT_TRUE(wait_until([&] { return fs::exists(parts / "checkpoints/1400"); })) << job.text();
    job.signal(SIGKILL);
    job.wait(kLong);
    std::vector<std::string> resumes = arguments;
    resumes.emplace_back("-resume");
    const ProgramResult again = start(parts, resumes);
    EXPECT_EQ(again.status, 0) << again.output;
    const std::string end = contents(whole / "end.bodies");
    EXPECT_GT(std::count(end.begin(), end.end(), '\n'), 40);
    EXPECT_EQ(contents(parts / "end.bodies"), end);
  }
}

TEST(Reported, resume_heap_alone) {
  // Signals, at steps that no checkpoint was planned for; a forgotten word; an insertion that is over.
  const fs::path whole = fresh_folder("whole"), parts = fresh_folder("parts");
  for (const fs::path& folder : {whole, parts}) {
    write_file(folder / "in.heap", heap_script("", 9000));
    replace_in(folder / "in.heap", "count index 400", "count index 60");
  }
  const std::vector<std::string> arguments = {program("eccentra-dem"), "-in", "in.heap"};
  std::vector<std::string> resumes = arguments;
  resumes.emplace_back("-resume");
  ASSERT_EQ(start(whole, arguments).status, 0);
  const auto interrupt = [&](const std::vector<std::string>& words, const char* checkpoint, int number) {
    BackgroundJob job(parts, words, "log.first");
    ASSERT_TRUE(wait_until([&] { return fs::exists(parts / "checkpoints" / checkpoint); })) << job.text();
    job.signal(number);
    EXPECT_NE(job.wait(kLong), 0) << job.text();
    EXPECT_TRUE(holds(job.text(), "is written, go on with: ")) << job.text();
  };
  interrupt(arguments, "3000", SIGTERM);
  const ProgramResult forgotten = start(parts, arguments);
  EXPECT_NE(forgotten.status, 0);
  EXPECT_TRUE(holds(forgotten.output, "of a run that was interrupted")) << forgotten.output;
  interrupt(resumes, "5000", SIGINT);
  const ProgramResult again = start(parts, resumes);
  EXPECT_EQ(again.status, 0) << again.output;
  const std::string end = contents(whole / "end.bodies");
  EXPECT_TRUE(holds(end, "\n60 ")) << end;
  EXPECT_EQ(contents(parts / "end.bodies"), end);
  EXPECT_TRUE(fs::exists(parts / "log.liggghts.before-1"));
  // To more bodies than before: the insertion goes on.
  replace_in(parts / "in.heap", "count index 60", "count index 90");
  replace_in(parts / "in.heap", "run 9000", "run 11500");
  const ProgramResult more = start(parts, resumes);
  EXPECT_EQ(more.status, 0) << more.output;
  EXPECT_TRUE(holds(contents(parts / "end.bodies"), "\n90 ")) << more.output;
}
