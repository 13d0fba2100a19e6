// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The cases' own `run`: its options, names of folders, locale, and --resume.
#include "link/background_job.h"
#include "reported/programs_of_a_run.h"
#include "reported/table_of_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

using namespace eccentra::test;

namespace {

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

} // namespace

TEST(Reported, readme_ctrl_c_in_tomren_section_then_resume) {
  const fs::path here = fresh_folder("cases");
  ASSERT_EQ(start(here, case_run("tomren-section", short_section("whole"))).status, 0);
  {
    BackgroundJob job(here, case_run("tomren-section", short_section("parts")), "log.parts");
    ASSERT_TRUE(job.says("\nt 0.05", kLong)) << job.text();
    job.signal(SIGINT);
    EXPECT_NE(job.wait(kLong), 0);
    EXPECT_TRUE(holds(job.text(), "SIGINT asked to stop: checkpoint")) << job.text();
    EXPECT_TRUE(holds(job.text(), "/tomren-section/run --resume parts")) << job.text();
  }
  const ProgramResult offered = start(here, case_run("tomren-section", short_section("parts")));
  EXPECT_NE(offered.status, 0);
  EXPECT_TRUE(holds(offered.output, "/tomren-section/run --resume parts")) << offered.output;
  const ProgramResult again = start(here, case_run("tomren-section", {"--resume", "parts"}));
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_TRUE(holds(again.output, "goes on from checkpoint")) << again.output;
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
  EXPECT_TRUE(holds(contents(parts / "log.dem"), "goes on from checkpoint")) << contents(parts / "log.dem");
  const char* const table = "postProcessing/eccentra/coupling.csv";
  EXPECT_EQ(physics_of_table(parts / table), physics_of_table(here / "whole" / table));
  for (const char* field : {"0.2/U", "0.2/alpha"})
    EXPECT_EQ(contents(parts / field), contents(here / "whole" / field)) << field;
  EXPECT_FALSE(contents(parts / "0.2/alpha").empty());
}

TEST(Reported, refused_run_has_nothing_to_go_on_with) {
  const fs::path here = fresh_folder("refused");
  const ProgramResult run = start(here, case_run("tomren-section", short_section("run", {"--effects", "drag nobody"})));
  EXPECT_EQ(run.status, 1) << run.output;
  EXPECT_TRUE(holds(run.output, "'nobody'")) << run.output;
  EXPECT_TRUE(holds(run.output, "wrote no checkpoint to go on from: begin it anew")) << run.output;
  EXPECT_FALSE(holds(run.output, "--resume")) << run.output;
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
  EXPECT_TRUE(holds(result.output, "--output: ")) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  EXPECT_TRUE(fs::is_empty(here));
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
                                                       {"--turbulence", "kOmega"},
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
  EXPECT_TRUE(holds(contents(here / "-dash/in.cuttings"), "index 30 ")) << contents(here / "-dash/in.cuttings");
}

TEST(Reported, run_with_a_turbulence_model) {
  const fs::path here = fresh_folder("turbulence");
  const std::string table = "postProcessing/eccentra/coupling.csv";
  ASSERT_EQ(start(here, case_run("tomren-section", short_section("plain", {"--seconds", "0.05"}))).status, 0);
  ASSERT_EQ(
      start(here, case_run("tomren-section", short_section("off", {"--seconds", "0.05", "--turbulence", "laminar"})))
          .status,
      0);
  EXPECT_EQ(physics_of_table(here / "off" / table), physics_of_table(here / "plain" / table));
  for (const auto& [model, link] : {std::pair<const char*, const char*>{"kEpsilon", "solver"},
                                    {"realizableKE", "solver"},
                                    {"kOmegaSST", "socket"}}) {
    const std::vector<std::string> words = {
        "--velocity",   "3",   "--seconds", "0.05", "--effects", "drag chien turbulent_dispersion eddy_interaction",
        "--turbulence", model, "--link",    link};
    const ProgramResult result = start(here, case_run("tomren-section", short_section(model, words)));
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_TRUE(holds(result.output, std::string("turbulence by ") + model)) << result.output;
    EXPECT_TRUE(holds(result.output, "asked for velocity fraction turbulence;")) << result.output;
    EXPECT_NE(physics_of_table(here / model / table), physics_of_table(here / "plain" / table));
  }
  // From an inlet to an outlet.
  const ProgramResult open =
      start(here, case_run("tomren-injection", {"--output", "open", "--seconds", "0.04", "--run-in", "5", "--cells",
                                                "6 24 12", "--length", "0.3", "--turbulence", "kEpsilon"}));
  EXPECT_EQ(open.status, 0) << open.output;
  EXPECT_TRUE(holds(contents(here / "open/0/epsilon"), "inlet { type fixedValue;")) << open.output;
  // Fields that a case has are its own; where nothing says how large eddies are, it must have them.
  const ProgramResult bend = start(here, case_run("pipe-bend", {"--output", "bend", "--turbulence", "kEpsilon"}));
  EXPECT_EQ(bend.status, 1);
  EXPECT_TRUE(holds(bend.output, "write 0/k, 0/epsilon or 0/omega, and 0/nut")) << bend.output;
  EXPECT_FALSE(fs::exists(here / "bend"));
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
