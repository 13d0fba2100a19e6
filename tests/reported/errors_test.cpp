// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of every program: one sentence, on the terminal and in the log, and nothing after it; numbers in any language.
#include "reported/short_section.h"

#include <regex>
#include <sstream>

using namespace eccentra::test;

namespace {

struct Fault {
  std::string what, part, by, sentence;
  bool apart; ///< over the socket, too
};

void expect_shown(const std::vector<Fault>& faults, int ranks) {
  for (const Fault& fault : faults) {
    Section section("hosted", {{"", kScript, fault.part, fault.by}});
    expect_refused(section.run(ranks), {fault.sentence, "annulusFoam: "}, fault.what);
    EXPECT_TRUE(holds(contents(section.folder() / "log.liggghts"), fault.sentence)) << fault.what << ": the log";
    if (!fault.apart)
      continue;
    Section apart("jobs", {{"", kScript, fault.part, fault.by}});
    const auto [fluid, dem] = apart.run_apart(ranks, socket_path("err" + std::to_string(ranks)));
    expect_refused(dem, {fault.sentence}, fault.what + ", DEM");
    // A rank that has no connection yet ends the others: the fluid side sees them go.
    expect_refused(fluid, {ranks == 1 ? fault.sentence : "the DEM side"}, fault.what + ", fluid");
    EXPECT_TRUE(holds(contents(apart.folder() / "log.liggghts"), fault.sentence)) << fault.what << ": the log of DEM";
  }
}

} // namespace

TEST(Reported, error_on_proc_of_a_hosted_script) {
  expect_shown({{"set", kRun, "set group all type 7\nrun 64", "Invalid value in set command", true},
                {"seed", "particletemplate/sphere 15485863", "particletemplate/sphere 15485862", "prime number", false},
                {"square root", kRun,
                 "variable q atom sqrt(-1-x*x)\ncompute q all reduce sum v_q\nthermo_style custom step c_q\nrun 64",
                 "Sqrt of negative value", false},
                {"all ranks", kRun, "fix a all bogus\nrun 64", "Invalid fix style", true},
                {"crash", kRun, "shell \"kill -SEGV $PPID\"\nrun 64", "has crashed by a segmentation fault", false}},
               1);
}

TEST(Reported, error_on_proc_of_a_hosted_script_on_two_ranks) {
  expect_shown(
      {{"set on one rank", kRun, "region up block INF INF INF INF 0.03 INF units box\nset region up type 7\nrun 64",
        "Invalid value in set command", true},
       {"all ranks", kRun, "fix a all bogus\nrun 64", "Invalid fix style", false}},
      2);
}

namespace {

/// The last line of the output holds these parts, no line names a source file, and none is MPI's.
void expect_last_line(const ProgramResult& result, const std::vector<std::string>& parts, const std::string& what) {
  std::string text = result.output;
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  const std::string last = text.substr(text.rfind('\n') + 1);
  EXPECT_NE(result.status, 0) << what;
  for (const std::string& part : parts)
    EXPECT_TRUE(holds(last, part)) << what << ": the last line does not say '" << part << "'\n" << result.output;
  EXPECT_FALSE(std::regex_search(text, std::regex("\\.(cpp|h|C|H):[0-9]"))) << what << "\n" << result.output;
  EXPECT_FALSE(holds(text, "MPI_ABORT")) << what << "\n" << result.output;
}

} // namespace

TEST(Reported, errors_end_with_the_sentence) {
  const fs::path here = fresh_folder("errors");
  const std::string head = "atom_style granular\natom_modify map array\nboundary f f f\nnewton off\nunits si\n"
                           "communicate single vel yes\nregion box block 0 1 0 1 0 1 units box\ncreate_box 1 box\n";
  struct Script {
    std::string name, line;
    std::vector<std::string> parts;
    int times_on_two_ranks; ///< an error of one rank may come from each
  };
  const std::vector<Script> scripts = {
      {"stock, all ranks", "fix a all bogus", {"ERROR: Invalid fix style"}, 1},
      {"stock, of a fix", "fix a all gravity 9.81 vector", {"ERROR: ", "gravity"}, 1},
      {"stock, one rank",
       "create_atoms 1 single 0.5 0.5 0.5 units box\nset group all type 7",
       {"Invalid value in set"},
       0},
      {"ours",
       "fix a all fluid/couple link nowhere every 2",
       {"fix fluid/couple 'a'", "nowhere", "solver or socket"},
       1},
      {"ours, of a fluid side that never comes",
       "fix a all fluid/couple link solver every 2\nfix move all nve/sphere\nfix b all fluid/force rheology "
       "herschel_bulkley 0 0.01 1 density 1000 drag chien\nrun 2",
       {"hosts this script: start annulusFoam", "instead of this program"},
       1},
  };
  for (const Script& script : scripts) {
    write_file(here / "in.bad", head + script.line + "\n");
    const std::vector<std::string> command = {program("eccentra-dem"), "-in", "in.bad", "-log", "log.dem"};
    expect_last_line(run_program(command, {here, {}, 60}), script.parts, script.name);
    const std::string log = contents(here / "log.dem");
    EXPECT_EQ(occurrences(log, script.parts[0]), 1u) << script.name << ", the log\n" << log;
    if (script.times_on_two_ranks == 0)
      continue;
    const ProgramResult two = run_program(with_ranks(2, command), {here, {}, 60});
    EXPECT_NE(two.status, 0) << script.name;
    EXPECT_EQ(occurrences(two.output, script.parts[0]), 1u) << script.name << "\n" << two.output;
  }
  // Programs that host scripts, and those that read dictionaries, command lines and files.
  Section hosted("hosted", {{"", kScript, "run             ${steps}", "fix a all bogus\nrun 64"}});
  expect_last_line(hosted.run(), {"annulusFoam: error: ", "Invalid fix style"}, "hosted script");
  hosted.mesh(2);
  const ProgramResult two = hosted.solve(2);
  EXPECT_EQ(occurrences(two.output, "Invalid fix style"), 1u) << two.output;
  Section wrong("wrong", {{"", "constant/couplingProperties", "link            solver", "link            sokket"}});
  expect_last_line(wrong.run(), {"annulusFoam: error: ", "sokket", "socket"}, "dictionary");
  wrong.mesh(2);
  const ProgramResult both = wrong.solve(2);
  EXPECT_EQ(occurrences(both.output, "annulusFoam: error: "), 1u) << both.output;
  Section mesh("mesh", {{"", kMesh, "pipeRadius      0.02413", "pipeRadius      0.07"}});
  expect_last_line(run_program({program("annulusMesh")}, {mesh.folder(), {}, 60}),
                   {"annulusMesh: error: ", "pipeRadius"}, "annulusMesh");
  expect_last_line(run_program({program("annulusReport"), "nowhere"}, {here, {}, 60}), {"nowhere"}, "annulusReport");
  expect_last_line(run_program({program("clusterShape"), "cube", "9"}, {here, {}, 60}), {"clusterShape: error: ", "9"},
                   "clusterShape");
  write_file(here / "keys", "");
  expect_last_line(run_program({program("eccentra-keys"), "keys"}, {here, {}, 60}), {"eccentra-keys: error: ", "keys"},
                   "eccentra-keys");
}

TEST(Reported, comma_locale_of_programs) {
  const fs::path place = fresh_folder("locale");
  const ProgramResult made = run_program({"localedef", "-i", "de_DE", "-f", "UTF-8", (place / "de_DE.UTF-8").string()});
  ASSERT_TRUE(fs::exists(place / "de_DE.UTF-8"))
      << "no comma locale can be made here: install Debian's package locales\n"
      << made.output;
  const std::vector<std::string> german = {"LOCPATH=" + fs::absolute(place).string(), "LC_ALL=de_DE.UTF-8"};
  const ProgramResult comma = run_program({"bash", "-c", "printf %.1f 0,5"}, {".", german, 60});
  ASSERT_EQ(comma.output, "0,5") << "the locale is not in force";
  // The same numbers, digit by digit, in both.
  const auto table = [](const std::string& name, const std::vector<std::string>& environment) {
    Section section(name);
    EXPECT_EQ(run_program({program("annulusMesh")}, {section.folder(), environment, 60}).status, 0);
    const ProgramResult result = section.solve(1, environment);
    EXPECT_EQ(result.status, 0) << result.output;
    const ProgramResult report =
        run_program({program("annulusReport"), ".", "--no-pictures"}, {section.folder(), environment, 60});
    EXPECT_EQ(report.status, 0) << report.output;
    std::string rows = contents(section.folder() / "constant/polyMesh/points");
    std::istringstream csv(contents(section.folder() / "postProcessing/eccentra/coupling.csv"));
    for (std::string line; std::getline(csv, line);)
      rows += line.substr(0, 120) + "\n"; // without the wall-clock times
    return rows;
  };
  EXPECT_EQ(table("point", {"LC_ALL=C"}), table("comma", german));
  const fs::path dem = fresh_folder("dem");
  write_file(dem / "in.numbers",
             "atom_style granular\n"
             "atom_modify map array sort 0 0\n"
             "boundary f f f\n"
             "newton off\n"
             "units si\n"
             "communicate single vel yes\n"
             "region box block -0.5 1.5 0 1 0 1 units box\n"
             "create_box 1 box\n"
             "neighbor 0.002 bin\n"
             "pair_style none\n"
             "variable a equal 0.5*2.5\n"
             "print \"a is $a\"\n"
             "create_atoms 1 single 0.25 0.5 0.75 units box\n"
             "set group all diameter 0.00635 density 2619.5\n"
             "fix move all nve/sphere\n"
             "fix mud all fluid/force rheology herschel_bulkley 0 0.015 1 density 1000.5 drag schiller_naumann\n"
             "fix flow all fluid/uniform velocity 0.125 0 0\n"
             "timestep 1e-5\n"
             "dump d all custom 10 numbers.txt id x y z vx fx\n"
             "run 10\n");
  const auto numbers = [&dem](const std::string& locale) {
    std::vector<std::string> environment = {"LC_ALL=" + locale, "LOCPATH=" + fs::absolute("locale").string()};
    const ProgramResult result =
        run_program({program("eccentra-dem"), "-in", "in.numbers", "-log", "none"}, {dem, environment, 60});
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_TRUE(holds(result.output, "a is 1.25")) << result.output;
    return contents(dem / "numbers.txt");
  };
  EXPECT_TRUE(holds(numbers("C"), "0.25 0.5 0.75 0.000105"));
  EXPECT_EQ(numbers("C"), numbers("de_DE.UTF-8"));
  const std::vector<std::string> shape = {program("clusterShape"), "cube", "8"};
  EXPECT_EQ(run_program(shape, {".", german, 60}).output, run_program(shape, {".", {"LC_ALL=C"}, 60}).output);
}
