// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Who interrupts a run and does what the message says gets the digits of the run that nobody interrupted; who forgets
// to say so loses nothing.
#include "coupled/checkpoint_scene.h"
#include "link/background_job.h"
#include "link/checkpoint/durable_files.h"
#include "reported/table_of_run.h"
#include "support/read_file.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr double kLong = 100; ///< [s], on a busy machine
constexpr int kSteps = 24 * kStepsPerCouplingStep;

std::string program(const char* name) {
  return required_environment("ECCENTRA_BIN") + '/' + name;
}

std::vector<std::string> annulus_foam(const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {program("annulusFoam")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

ProgramResult start(const fs::path& folder, const std::vector<std::string>& arguments) {
  ProgramOptions options;
  options.directory = folder;
  options.timeout = kLong;
  return run_program(arguments, options);
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What a run leaves, by name and contents: particles, fields, table; not the clock.
std::string result_of(const fs::path& folder) {
  return contents(folder / "end.bodies") + physics_of_table(folder / "postProcessing/eccentra/coupling.csv");
}

template <class Condition> bool wait_until(const Condition& condition, double seconds = kLong) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

std::size_t rows_of(const fs::path& folder) {
  const std::string text = contents(folder / "postProcessing/eccentra/coupling.csv");
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// A prepared box in `name`, and the result of the run that nobody interrupts.
struct Straight {
  fs::path folder;
  std::string result;
};

Straight straight(const BoxCase& box, const std::string& name, int ranks = 1) {
  const Outcome outcome = run(box, name, ranks);
  EXPECT_EQ(outcome.status, 0) << outcome.text << contents(fs::path(outcome.folder) / "log.liggghts");
  return {outcome.folder, result_of(outcome.folder)};
}

/// Folders of OpenFOAM's times, all but that of the beginning.
std::vector<fs::path> times_of(const fs::path& folder) {
  std::vector<fs::path> times;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name != "0" && name.find_first_not_of("0123456789.") == std::string::npos)
      times.push_back(entry.path());
  }
  return times;
}

fs::path newest_time(const fs::path& folder) {
  const std::vector<fs::path> times = times_of(folder);
  return *std::max_element(times.begin(), times.end(), [](const fs::path& a, const fs::path& b) {
    return std::stod(a.filename()) < std::stod(b.filename());
  });
}

std::int64_t newest_checkpoint_of(const fs::path& folder) {
  const auto steps = eccentra::link::numbered_entries(folder / "checkpoints", "");
  return steps.empty() ? -1 : steps.front();
}

/// The same folder before the run.
fs::path beginning_of(const Straight& run, const std::string& name) {
  const fs::path copy = fs::absolute(name);
  fs::remove_all(copy);
  fs::copy(run.folder, copy, fs::copy_options::recursive);
  for (const char* part : {"checkpoints", "postProcessing", "end.bodies", "log.liggghts"})
    fs::remove_all(copy / part);
  for (const fs::path& time : times_of(copy))
    fs::remove_all(time);
  return copy;
}

BoxCase resumable_box(const std::string& arguments = "solver every 40 checkpoint 4", bool clusters = false) {
  return stirred_box(arguments, kSteps, clusters, false, true);
}

/// A run of the box that ended in the middle, as after kill -9, with checkpoints of steps 320 and 480.
fs::path interrupted(const Straight& run, const std::string& name) {
  const fs::path folder = beginning_of(run, name);
  BackgroundJob job(folder, annulus_foam(), "log.first");
  EXPECT_TRUE(wait_until([&] { return fs::exists(folder / "checkpoints/480"); })) << job.text();
  job.signal(SIGKILL);
  job.wait(kLong);
  return folder;
}

/// Programs of a run in `folder`.
std::vector<int> processes_in(const fs::path& folder) {
  std::vector<int> found;
  for (const fs::directory_entry& process : fs::directory_iterator("/proc")) {
    const std::string id = process.path().filename();
    std::error_code gone;
    if (id.find_first_not_of("0123456789") == std::string::npos &&
        fs::read_symlink(process.path() / "cwd", gone) == fs::absolute(folder))
      found.push_back(std::stoi(id));
  }
  return found;
}

std::vector<std::string> case_run(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {required_environment("ECCENTRA_CASES") + '/' + name + "/run", "--bin",
                                        required_environment("ECCENTRA_BIN")};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Some seconds of a case.
std::vector<std::string> short_section(const std::string& output, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"--output", output, "--seconds", "0.2",    "--run-in", "5", "--report", "1",
                                        "--length", "0.06", "--cells",   "6 24 4", "--count",  "60"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void replace_in(const fs::path& file, const std::string& part, const std::string& by) {
  std::string text = contents(file);
  ASSERT_NE(text.find(part), std::string::npos) << file << part;
  std::ofstream(file) << text.replace(text.find(part), part.size(), by);
}

std::string heap_script(const std::string& head, int steps) {
  std::string text = contents(fs::path(required_environment("ECCENTRA_CASES")) / "heap/in.heap");
  const std::string last = "run             50000";
  EXPECT_TRUE(says(text, last));
  text.replace(
      text.find(last), last.size(),
      "run " + std::to_string(steps) +
          "\ndump end all custom 1 end.bodies id x y z vx vy vz omegax omegay omegaz\n"
          "dump_modify end sort id format \"%d %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\"\nrun 0\n");
  const std::string word = "resumable ";
  EXPECT_TRUE(says(text, word));
  return text.replace(text.find(word), word.size(), head + '\n' + "resumable every 1000 ");
}

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
  EXPECT_TRUE(says(again.output, "goes on from checkpoint")) << again.output;
  EXPECT_EQ(contents(parts / "end.bodies"), contents(whole / "end.bodies"));
}

} // namespace

TEST(Reported, readme_ctrl_c_in_tomren_section_then_resume) {
  const fs::path here = fresh_folder("cases");
  ASSERT_EQ(start(here, case_run("tomren-section", short_section("whole"))).status, 0);
  {
    BackgroundJob job(here, case_run("tomren-section", short_section("parts")), "log.parts");
    ASSERT_TRUE(job.says("\nt 0.05", kLong)) << job.text();
    job.signal(SIGINT);
    EXPECT_NE(job.wait(kLong), 0);
    EXPECT_TRUE(says(job.text(), "SIGINT asked to stop: checkpoint")) << job.text();
    EXPECT_TRUE(says(job.text(), "/tomren-section/run --resume parts")) << job.text();
  }
  const ProgramResult offered = start(here, case_run("tomren-section", short_section("parts")));
  EXPECT_NE(offered.status, 0);
  EXPECT_TRUE(says(offered.output, "/tomren-section/run --resume parts")) << offered.output;
  const ProgramResult again = start(here, case_run("tomren-section", {"--resume", "parts"}));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_TRUE(says(again.output, "goes on from checkpoint")) << again.output;
  const char* const table = "postProcessing/eccentra/coupling.csv";
  EXPECT_EQ(physics_of_table(here / "parts" / table), physics_of_table(here / "whole" / table));
  EXPECT_EQ(contents(here / "parts/0.2/U"), contents(here / "whole/0.2/U"));
  // To another end.
  const ProgramResult longer = start(here, case_run("tomren-section", {"--resume", "parts", "--seconds", "0.25"}));
  EXPECT_EQ(longer.status, 0) << longer.output;
  EXPECT_EQ(rows_of(here / "parts"), 52U);
}

TEST(Reported, resume_over_the_socket_on_two_ranks) {
  const fs::path here = fresh_folder("socket");
  const std::vector<std::string> more = {"--link", "socket", "--ranks", "2", "--shape", "cube 8"};
  ASSERT_EQ(start(here, case_run("tomren-section", short_section("whole", more))).status, 0);
  const fs::path parts = here / "parts";
  const auto interrupt = [&](const std::vector<std::string>& arguments, std::size_t rows, int number) {
    BackgroundJob job(here, arguments, "log.parts");
    ASSERT_TRUE(wait_until([&] { return fs::exists(parts / "checkpoints") && rows_of(parts) >= rows; })) << job.text();
    if (number == SIGKILL)
      for (const int process : processes_in(parts))
        kill(process, SIGKILL);
    job.signal(number);
    EXPECT_NE(job.wait(kLong), 0) << job.text();
    EXPECT_TRUE(wait_until([&] { return processes_in(parts).empty(); }));
  };
  interrupt(case_run("tomren-section", short_section("parts", more)), 8, SIGTERM);
  interrupt(case_run("tomren-section", {"--resume", "parts"}), 16, SIGINT);
  interrupt(case_run("tomren-section", {"--resume", "parts"}), 26, SIGKILL);
  const ProgramResult again = start(here, case_run("tomren-section", {"--resume", "parts"}));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_TRUE(says(contents(parts / "log.dem"), "goes on from checkpoint")) << contents(parts / "log.dem");
  const char* const table = "postProcessing/eccentra/coupling.csv";
  EXPECT_EQ(physics_of_table(parts / table), physics_of_table(here / "whole" / table));
  for (const char* field : {"0.2/U", "0.2/alpha"})
    EXPECT_EQ(contents(parts / field), contents(here / "whole" / field)) << field;
  EXPECT_FALSE(contents(parts / "0.2/alpha").empty());
}

TEST(Reported, readme_cp_r_tomren_section_run) {
  const fs::path here = fresh_folder("copied");
  const fs::path cases = required_environment("ECCENTRA_CASES");
  fs::copy(cases / "tomren-section", here / "mine", fs::copy_options::recursive);
  fs::create_directory(here / "elsewhere");
  fs::create_symlink("../mine/run", here / "elsewhere/linked");
  ProgramOptions options;
  options.environment = {"CDPATH=.", "ECCENTRA_BIN=" + required_environment("ECCENTRA_BIN")};
  options.timeout = kLong;
  const auto run = [&](const fs::path& folder, const char* word, const std::string& output) {
    options.directory = folder;
    std::vector<std::string> arguments = {word};
    for (const std::string& more : short_section(output, {"--seconds", "0.01"}))
      arguments.push_back(more);
    return run_program(arguments, options);
  };
  const ProgramResult plain = run(here / "mine", "./run", "out");
  EXPECT_EQ(plain.status, 0) << plain.output;
  const ProgramResult linked = run(here / "elsewhere", "./linked", "out");
  EXPECT_EQ(linked.status, 0) << linked.output;
  const ProgramResult named = run(here, "mine/run", "out");
  EXPECT_EQ(named.status, 0) << named.output;
  EXPECT_GT(rows_of(here / "out"), 1U);
  // Without a word from the environment, by the note that the build left in the case.
  options.environment = {"ECCENTRA_BIN="};
  const ProgramResult noted = run(here / "mine", "./run", "noted");
  EXPECT_EQ(noted.status, 0) << noted.output;
}

TEST(Reported, readme_output_a_b) {
  const fs::path here = fresh_folder("blank");
  const ProgramResult result = start(here, case_run("tomren-section", short_section("a b")));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(says(result.output, "--output: ")) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  EXPECT_TRUE(fs::is_empty(here));
}

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
  EXPECT_TRUE(says(job.text(), "dump pictures cluster/vtk: file 'heap_5000.vtp' cannot be written (File too large)"))
      << job.text();
  EXPECT_FALSE(fs::exists(folder / "heap_5000.vtp"));
  EXPECT_FALSE(fs::exists(folder / "heap_5000.vtp.part"));
}

TEST(Reported, adversary_2_shorter_coupling_csv) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = interrupted(whole, "parts");
  const fs::path table = folder / "postProcessing/eccentra/coupling.csv";
  std::string text = contents(table), head;
  for (int line = 0; line < 6; ++line)
    head += text.substr(head.size(), text.find('\n', head.size()) + 1 - head.size());
  std::ofstream(table) << head << "0.01,half a r";
  const ProgramResult again = start(folder, annulus_foam({"-resume"}));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_TRUE(says(again.output, "rows that the checkpoint's run had written")) << again.output;
  EXPECT_EQ(contents(table).substr(0, head.size()), head);
  EXPECT_EQ(contents(folder / "end.bodies") + '\n',
            whole.result.substr(0, contents(folder / "end.bodies").size()) + '\n');
  EXPECT_FALSE(says(contents(table), "half a r"));
  // No table at all, or one with other columns: kept beside.
  const fs::path other = interrupted(whole, "other");
  write_file(other / "postProcessing/eccentra/coupling.csv", "time,something\n0,1\n");
  EXPECT_EQ(start(other, annulus_foam({"-resume"})).status, 0);
  EXPECT_EQ(contents(other / "postProcessing/eccentra/coupling.csv.before-1"), "time,something\n0,1\n");
}

TEST(Reported, adversary_2b_a_forgotten_resume) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = interrupted(whole, "parts");
  const std::string table = contents(folder / "postProcessing/eccentra/coupling.csv");
  const auto steps = eccentra::link::numbered_entries(folder / "checkpoints", "");
  const ProgramResult forgotten = start(folder, annulus_foam());
  EXPECT_NE(forgotten.status, 0);
  EXPECT_TRUE(says(forgotten.output, "of a run that was interrupted: go on with: ")) << forgotten.output;
  EXPECT_EQ(contents(folder / "postProcessing/eccentra/coupling.csv"), table);
  EXPECT_EQ(eccentra::link::numbered_entries(folder / "checkpoints", ""), steps);
  EXPECT_EQ(start(folder, annulus_foam({"-resume"})).status, 0);
  EXPECT_EQ(result_of(folder), whole.result);
  // A run that had come to its end is kept beside.
  const std::string of_end = contents(folder / "postProcessing/eccentra/coupling.csv");
  for (const fs::path& time : times_of(folder))
    fs::remove_all(time);
  const ProgramResult anew = start(folder, annulus_foam());
  EXPECT_EQ(anew.status, 0) << anew.output;
  EXPECT_TRUE(fs::exists(folder / "checkpoints.before-1/960/dem.restart"));
  EXPECT_TRUE(fs::exists(folder / "checkpoints.before-1/fluid-960.complete"));
  EXPECT_EQ(contents(folder / "postProcessing/eccentra/coupling.csv.before-1"), of_end);
  EXPECT_EQ(result_of(folder), whole.result);
  // And -resume, which a batch script always says, where there is no checkpoint but a table.
  fs::remove_all(folder / "checkpoints");
  for (const fs::path& time : times_of(folder))
    fs::remove_all(time);
  EXPECT_EQ(start(folder, annulus_foam({"-resume"})).status, 0);
  EXPECT_TRUE(fs::exists(folder / "postProcessing/eccentra/coupling.csv.before-2"));
}

TEST(Reported, adversary_2b_newer_checkpoints_are_kept) {
  const Straight whole = straight(resumable_box(), "whole");
  // The newest is damaged: the run goes on from the one before.
  fs::resize_file(whole.folder / "checkpoints/960/dem.restart", 1000);
  fs::create_directory(whole.folder / "checkpoints/999999999");
  write_file(whole.folder / "checkpoints/backup", "mine");
  const ProgramResult again = start(whole.folder, annulus_foam({"-resume"}));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_EQ(result_of(whole.folder), whole.result);
  EXPECT_TRUE(fs::exists(whole.folder / "checkpoints.before-1/960/dem.restart"));
  EXPECT_TRUE(fs::exists(whole.folder / "checkpoints.before-1/999999999"));
  EXPECT_TRUE(fs::exists(whole.folder / "checkpoints.before-1/coupling.csv"));
  EXPECT_TRUE(fs::exists(whole.folder / "checkpoints/backup"));
  // None is whole: -resume does not begin anew.
  for (const auto step : eccentra::link::numbered_entries(whole.folder / "checkpoints", ""))
    fs::resize_file(whole.folder / "checkpoints" / std::to_string(step) / "dem.restart", 1000);
  const std::string table = contents(whole.folder / "postProcessing/eccentra/coupling.csv");
  const ProgramResult none = start(whole.folder, annulus_foam({"-resume"}));
  EXPECT_NE(none.status, 0);
  EXPECT_TRUE(says(none.output, "none of the checkpoints")) << none.output;
  EXPECT_EQ(contents(whole.folder / "postProcessing/eccentra/coupling.csv"), table);
}

TEST(Reported, adversary_5_another_mesh) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = interrupted(whole, "parts");
  const fs::path dictionary = folder / "system/blockMeshDict";
  const std::string usual = contents(dictionary);
  const char* const changes[][2] = {{"(6 6 9)", "(6 9 6)"}, {"simpleGrading (1 1 1)", "simpleGrading (1 1 1.02)"}};
  for (const auto& change : changes) {
    replace_in(dictionary, change[0], change[1]);
    ASSERT_EQ(start(folder, {"blockMesh"}).status, 0);
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_NE(again.status, 0) << change[1];
    EXPECT_TRUE(says(again.output, "is not the mesh of checkpoint")) << change[1] << again.output;
    std::ofstream(dictionary) << usual;
  }
  // The same mesh, made again, is no other one.
  ASSERT_EQ(start(folder, {"blockMesh"}).status, 0);
  EXPECT_EQ(start(folder, annulus_foam({"-resume"})).status, 0);
  EXPECT_EQ(result_of(folder), whole.result);
}

TEST(Reported, adversary_5_another_interval_or_step) {
  const Straight whole = straight(resumable_box(), "whole");
  const auto expect = [&](const char* file, const char* part, const char* by, const char* sentence) {
    const fs::path folder = interrupted(whole, "parts");
    replace_in(folder / file, part, by);
    if (std::string(by).find("every 20") != std::string::npos)
      replace_in(folder / "in.dem", "timestep 5e-5\nfix floor", "timestep 1e-4\nfix floor");
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_NE(again.status, 0) << by;
    EXPECT_TRUE(says(again.output, sentence)) << by << again.output;
  };
  expect("in.dem", "every 40", "every 20", "timestep is 0.0001");
  expect("system/controlDict", "deltaT 0.002", "deltaT 0.001", "");
}

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
    EXPECT_TRUE(says(job.text(), "is written, go on with: ")) << job.text();
  };
  interrupt(arguments, "3000", SIGTERM);
  const ProgramResult forgotten = start(parts, arguments);
  EXPECT_NE(forgotten.status, 0);
  EXPECT_TRUE(says(forgotten.output, "of a run that was interrupted")) << forgotten.output;
  interrupt(resumes, "5000", SIGINT);
  const ProgramResult again = start(parts, resumes);
  EXPECT_EQ(again.status, 0) << again.output;
  const std::string end = contents(whole / "end.bodies");
  EXPECT_TRUE(says(end, "\n60 ")) << end;
  EXPECT_EQ(contents(parts / "end.bodies"), end);
  EXPECT_TRUE(fs::exists(parts / "log.liggghts.before-1"));
  // To more bodies than before: the insertion goes on.
  replace_in(parts / "in.heap", "count index 60", "count index 90");
  replace_in(parts / "in.heap", "run 9000", "run 11500");
  const ProgramResult more = start(parts, resumes);
  EXPECT_EQ(more.status, 0) << more.output;
  EXPECT_TRUE(says(contents(parts / "end.bodies"), "\n90 ")) << more.output;
}

TEST(Reported, adversary_14_standard_output_on_a_full_disk) {
  const Straight whole = straight(resumable_box(), "whole");
  const fs::path folder = beginning_of(whole, "full");
  const ProgramResult result = start(folder, {"sh", "-c", "exec '" + program("annulusFoam") + "' > /dev/full"});
  EXPECT_EQ(result.signal, 0) << result.output;
  EXPECT_NE(result.status, 134) << result.output;
  EXPECT_FALSE(says(result.output, "terminate called")) << result.output;
  EXPECT_LE(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  EXPECT_TRUE(says(result.output, "standard output")) << result.output;
}

TEST(Reported, adversary_15_words_of_run) {
  const fs::path here = fresh_folder("words");
  const std::vector<std::vector<std::string>> wrong = {{"--output", ""},
                                                       {"--bin", "/nonexistent"},
                                                       {"--bin", ""},
                                                       {"--count", "1e9"},
                                                       {"--count", "60|x"},
                                                       {"--count", "1.5"},
                                                       {"--count", "-3"},
                                                       {"--count", ""},
                                                       {"--velocity", "1/2"},
                                                       {"--velocity", "fast"},
                                                       {"--seconds", "0"},
                                                       {"--seconds", "nan"},
                                                       {"--seconds", "1;2"},
                                                       {"--ranks", "0"},
                                                       {"--ranks", "two"},
                                                       {"--ranks", "1e3000"},
                                                       {"--link", "wire"},
                                                       {"--overlap", "yes"},
                                                       {"--cells", "6 24"},
                                                       {"--cells", "6 24 0"},
                                                       {"--report", "0"},
                                                       {"--run-in", "-1"},
                                                       {"--momentum", "no"},
                                                       {"--void-fraction", "x"},
                                                       {"--viscosity", "thick"},
                                                       {"--shape", ""},
                                                       {"--shape", "cube\n8"},
                                                       {"--effects", "$x"},
                                                       {"--no_such", "1"},
                                                       {"--rpm", "1,5"},
                                                       {"rest"},
                                                       {"--seconds"},
                                                       {"-x", "1"},
                                                       {"--resume", ""},
                                                       {"--resume", "nothing"},
                                                       {"--resume", "words", "--count", "5"}};
  for (const std::vector<std::string>& arguments : wrong) {
    std::vector<std::string> all = {required_environment("ECCENTRA_CASES") + "/tomren-section/run", "--output", "out"};
    if (arguments[0] == "--output" || arguments[0] == "--resume")
      all.resize(1);
    all.insert(all.end(), arguments.begin(), arguments.end());
    ProgramOptions options;
    options.directory = here;
    options.environment = {"ECCENTRA_BIN=" + required_environment("ECCENTRA_BIN")};
    const ProgramResult result = run_program(all, options);
    const std::string word = arguments[0] + ' ' + arguments.back();
    EXPECT_EQ(result.status, 1) << word << result.output;
    EXPECT_EQ(result.output.rfind("run: error: ", 0), 0U) << word << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), arguments.back() == "cube\n8" ? 2 : 1)
        << word << result.output;
    EXPECT_TRUE(fs::is_empty(here)) << word;
  }
  // Whole numbers may be written as one likes.
  const ProgramResult right =
      start(here, case_run("tomren-section", short_section("-dash", {"--count", "3e1", "--seconds", "0.01"})));
  EXPECT_EQ(right.status, 0) << right.output;
  EXPECT_TRUE(says(contents(here / "-dash/in.cuttings"), "index 30 ")) << contents(here / "-dash/in.cuttings");
}

TEST(Reported, adversary_17_names_of_folders) {
  const fs::path here = fresh_folder("names");
  for (const std::string& name : {std::string("my results"), std::string("it's"), std::string("a\"b"),
                                  std::string("a\nb"), std::string("a\tb")}) {
    const ProgramResult result = start(here, case_run("tomren-section", short_section(name)));
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_EQ(result.output.rfind("run: error: --output: ", 0), 0U) << name << result.output;
    EXPECT_TRUE(fs::is_empty(here)) << name;
  }
  for (const std::string& name : {std::string("$HOME"), std::string("a;b"), std::string("grün"), std::string("*")}) {
    const ProgramResult result = start(here, case_run("tomren-section", short_section(name, {"--seconds", "0.01"})));
    EXPECT_EQ(result.status, 0) << name << result.output;
    EXPECT_TRUE(fs::exists(here / name / "postProcessing/eccentra/coupling.csv")) << name;
  }
}

TEST(Reported, adversary_4_comma_locale) {
  const fs::path here = fresh_folder("locale");
  ASSERT_EQ(start(here, {"localedef", "-i", "de_DE", "-f", "UTF-8", "./de_DE.UTF-8"}).status, 0)
      << "no locale with decimal commas can be made: scripts/setup installs the package locales";
  ProgramOptions options;
  options.directory = here;
  options.timeout = kLong;
  options.environment = {"LOCPATH=" + here.string(), "LC_ALL=de_DE.UTF-8"};
  const ProgramResult result =
      run_program(case_run("tomren-section", short_section("out", {"--seconds", "0.01", "--rpm", "9"})), options);
  EXPECT_EQ(result.status, 0) << result.output;
  const std::string velocity = contents(here / "out/0/U");
  const std::size_t at = velocity.find("omega");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(velocity.substr(at + 5)), 9 * std::acos(-1.0) / 30, 1e-9);
}

TEST(Reported, resume_script_that_does_not_read_the_checkpoint) {
  const Straight whole = straight(resumable_box(), "whole");
  const std::string script = contents(whole.folder / "in.dem");
  const auto expect = [&](const std::string& changed, const char* sentence) {
    const fs::path folder = interrupted(whole, "parts");
    const std::string table = contents(folder / "postProcessing/eccentra/coupling.csv");
    const auto steps = eccentra::link::numbered_entries(folder / "checkpoints", "");
    std::ofstream(folder / "in.dem") << changed;
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_NE(again.status, 0) << sentence;
    EXPECT_TRUE(says(again.output, sentence)) << sentence << again.output;
    EXPECT_EQ(contents(folder / "postProcessing/eccentra/coupling.csv"), table) << sentence;
    EXPECT_EQ(eccentra::link::numbered_entries(folder / "checkpoints", ""), steps) << sentence;
  };
  const auto with = [&](const std::string& part, const std::string& by) {
    std::string text = script;
    EXPECT_TRUE(says(text, part)) << part;
    return text.replace(text.find(part), part.size(), by);
  };
  expect(with("resumable\n", ""), "write the line 'resumable' before it");
  expect(with("resumable\n", "atom_style granular\natom_modify map array\ncommunicate single vel yes\nread_restart "
                             "checkpoints/320/dem.restart\n"),
         "but the script reads 'checkpoints/320/dem.restart'");
  expect(with("fix flow all", "fix other all"), "give it the ID that it had");
  expect(with("fix flow all", "run 40\nfix flow all"), "run 1 of the script ends at step 40 but checkpoint");
  expect(with("run 960 upto", "run 80 upto"), "is beyond it");
  std::string reads = script;
  reads.erase(reads.find("resumable\n"), 10);
  const std::string box = "region box block";
  reads.replace(reads.find(box), reads.find("neighbor") - reads.find(box), "read_restart ${checkpoint}\n");
  const std::string last = "run 960 upto";
  expect(reads.replace(reads.find(last), last.size(), "reset_timestep 0\nrun 960 upto"),
         "is read but the first run begins at step 0");
}

TEST(Reported, resume_any_script_goes_on_from_any_signal) {
  // Several runs, a loop, run every, groups, text files: none of it is done twice or left out.
  BoxCase box = stirred_box("solver every 40 checkpoint auto", kSteps, true, false, true);
  const std::string last = "run 960 upto\n";
  ASSERT_TRUE(says(box.script, last));
  box.script.replace(
      box.script.find(last), last.size(),
      "group low region spout\nvariable n loop 3\nlabel again\nrun 120\nvelocity low set 0 0 0.05\nnext n\n"
      "jump in.dem again\ncompute ke all ke\nfix sums all ave/time 40 1 40 c_ke file sums.txt\n"
      "run 600 every 200 \"velocity low set 0.01 0 0\"\nunfix sums\n");
  const Straight whole = straight(box, "whole");
  struct End {
    int signal, every, step; // checkpoints each so many coupling steps; the run goes on from the one of this step
    const char* where;
  };
  for (const End& end :
       {End{SIGINT, 2, 80, "within a run"}, End{SIGKILL, 3, 120, "at the last step of a run"},
        End{SIGKILL, 3, 360, "at the last step of a run, before one of pieces"}, End{SIGTERM, 5, 400, "within a piece"},
        End{SIGKILL, 7, 560, "at the last step of a piece"}, End{SIGKILL, 8, 960, "at the last step of all"}}) {
    fs::path folder, checkpoints;
    // Only two checkpoints stay: on a busy machine the signal may come after the one that is meant is gone.
    for (int attempt = 0; attempt < 8 && !(attempt && fs::exists(checkpoints / std::to_string(end.step))); ++attempt) {
      folder = beginning_of(whole, "parts");
      checkpoints = folder / "checkpoints";
      replace_in(folder / "in.dem", "checkpoint auto", "checkpoint " + std::to_string(end.every));
      BackgroundJob job(folder, annulus_foam(), "log.first");
      ASSERT_TRUE(wait_until([&] { return newest_checkpoint_of(folder) >= end.step; })) << job.text();
      job.signal(end.signal);
      ASSERT_NE(job.wait(kLong), -1);
      if (end.signal != SIGKILL)
        break;
    }
    for (const auto step : eccentra::link::numbered_entries(checkpoints, ""))
      if (end.signal == SIGKILL && step > end.step)
        fs::remove_all(checkpoints / std::to_string(step));
    fs::remove(checkpoints / "finished");
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_EQ(again.status, 0) << end.where << again.output << contents(folder / "log.liggghts");
    if (end.signal == SIGKILL) {
      EXPECT_TRUE(says(again.output, "goes on from checkpoint " + std::to_string(end.step))) << again.output;
    }
    EXPECT_EQ(result_of(folder), whole.result) << end.where;
  }
}

TEST(Reported, resume_beside_fields_that_a_kill_left_in_pieces) {
  // Killed while the fields of the last time were written, beside the checkpoint of the same time.
  BoxCase box = resumable_box("solver every 40 checkpoint 8", true);
  const Straight whole = straight(box, "whole");
  const fs::path last = newest_time(whole.folder);
  for (const double kept : {0.0, 0.3, 0.97}) {
    const fs::path folder = fs::absolute("parts");
    fs::remove_all(folder);
    fs::copy(whole.folder, folder, fs::copy_options::recursive);
    fs::remove(folder / "checkpoints/finished");
    int cut = 0;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder / last.filename()))
      if (file.is_regular_file()) {
        fs::resize_file(file.path(), static_cast<std::uintmax_t>(kept * static_cast<double>(file.file_size())));
        ++cut;
      }
    ASSERT_GE(cut, 6) << "fields, their older levels and OpenFOAM's own state";
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_EQ(again.status, 0) << kept << again.output;
    EXPECT_TRUE(says(again.output, "goes on from checkpoint 960")) << again.output;
    EXPECT_TRUE(says(again.output, "is not whole, as an interrupted run leaves it: removed")) << again.output;
    EXPECT_EQ(result_of(folder), whole.result) << kept;
    for (const char* field : {"U", "U_0", "p", "phi", "alpha"})
      EXPECT_TRUE(contents(folder / last.filename() / field) == contents(last / field)) << field << kept;
  }
}
