// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A coupled run that is interrupted and resumed as the message says gives the digits of the run that nobody
// interrupted; a forgotten -resume loses nothing.
#include "reported/resumable_box.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

using namespace eccentra::test;

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
  EXPECT_TRUE(holds(again.output, "rows that the checkpoint's run had written")) << again.output;
  EXPECT_EQ(contents(table).substr(0, head.size()), head);
  EXPECT_EQ(contents(folder / "end.bodies") + '\n',
            whole.result.substr(0, contents(folder / "end.bodies").size()) + '\n');
  EXPECT_FALSE(holds(contents(table), "half a r"));
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
  EXPECT_TRUE(holds(forgotten.output, "of a run that was interrupted: go on with: ")) << forgotten.output;
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
  EXPECT_TRUE(holds(none.output, "none of the checkpoints")) << none.output;
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
    EXPECT_TRUE(holds(again.output, "is not the mesh of checkpoint")) << change[1] << again.output;
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
    EXPECT_TRUE(holds(again.output, sentence)) << by << again.output;
  };
  expect("in.dem", "every 40", "every 20", "timestep is 0.0001");
  expect("system/controlDict", "deltaT 0.002", "deltaT 0.001", "");
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
    EXPECT_TRUE(holds(again.output, sentence)) << sentence << again.output;
    EXPECT_EQ(contents(folder / "postProcessing/eccentra/coupling.csv"), table) << sentence;
    EXPECT_EQ(eccentra::link::numbered_entries(folder / "checkpoints", ""), steps) << sentence;
  };
  const auto with = [&](const std::string& part, const std::string& by) {
    std::string text = script;
    EXPECT_TRUE(holds(text, part)) << part;
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
  ASSERT_TRUE(holds(box.script, last));
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
      EXPECT_TRUE(holds(again.output, "goes on from checkpoint " + std::to_string(end.step))) << again.output;
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
    ASSERT_EQ(cut, 5) << "U, p, phi, alpha and OpenFOAM's own state";
    const ProgramResult again = start(folder, annulus_foam({"-resume"}));
    EXPECT_EQ(again.status, 0) << kept << again.output;
    EXPECT_TRUE(holds(again.output, "goes on from checkpoint 960")) << again.output;
    EXPECT_TRUE(holds(again.output, "is not whole, as an interrupted run leaves it: removed")) << again.output;
    EXPECT_EQ(result_of(folder), whole.result) << kept;
    for (const char* field : {"U", "p", "phi", "alpha"})
      EXPECT_TRUE(contents(folder / last.filename() / field) == contents(last / field)) << field << kept;
  }
}
