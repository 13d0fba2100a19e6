// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A scene of one's own: eccentra new writes a case that runs, resumes, changes by one number, and is reported.
#include "support/read_file.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

class OwnScene : public testing::Test {
 protected:
  void SetUp() override { folder = fresh_folder(testing::UnitTest::GetInstance()->current_test_info()->name()); }

  ProgramResult in_folder(const std::vector<std::string>& command) const {
    return run_program(command, {folder, {}, 240});
  }
  ProgramResult eccentra(std::vector<std::string> words) const {
    words.insert(words.begin(), required_environment("ECCENTRA_BIN") + "/eccentra");
    return in_folder(words);
  }

  /// The number behind a row's name in what `new` prints.
  static double printed(const std::string& output, const std::string& row) {
    std::smatch match;
    return std::regex_search(output, match, std::regex(row + R"( +([-+.\deE]+))")) ? std::stod(match.str(1)) : NAN;
  }

  static std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');)
      cells.push_back(cell);
    return cells;
  }

  /// The last row of coupling.csv of a run in `name`.
  std::map<std::string, double> end_of(const std::string& name) const {
    std::istringstream table(contents(folder / name / "postProcessing/eccentra/coupling.csv"));
    std::string line, last;
    std::getline(table, line);
    const std::vector<std::string> names = cells_of(line);
    while (std::getline(table, line))
      last = line;
    const std::vector<std::string> values = cells_of(last);
    std::map<std::string, double> row;
    for (std::size_t column = 0; column < names.size(); ++column)
      row[names[column]] = std::stod(values.at(column));
    return row;
  }

  static std::set<std::string> names_in(const fs::path& place) {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(place))
      names.insert(entry.path().filename());
    return names;
  }

  fs::path folder;
};

TEST_F(OwnScene, SectionOfClustersRunsAndTakesEachNumberFromOnePlace) {
  const ProgramResult made =
      eccentra({"new",  "section", "mine", "--hole",    "8.5in",  "--pipe",    "5in",    "--eccentricity",
                "0.62", "--rpm",   "120",  "--flow",    "300gpm", "--tau0",    "3",      "--k",
                "0.35", "--n",     "0.7",  "--density", "10ppg",  "--shape",   "disk 7", "--diameter",
                "8e-3", "--solid", "0.01", "--length",  "0.1",    "--seconds", "0.05"});
  ASSERT_EQ(made.status, 0) << made.output;
  constexpr double kInch = 0.0254, kGallon = 3.785411784e-3, kPi = 3.14159265358979;
  const double area = kPi / 4 * (std::pow(8.5 * kInch, 2) - std::pow(5 * kInch, 2));
  EXPECT_NEAR(printed(made.output, "area of the annulus"), area, 1e-4 * area);
  EXPECT_NEAR(printed(made.output, "mean velocity"), 300 * kGallon / 60 / area, 1e-3 * 0.79);

  // No dictionary and no script repeats a number of the scene.
  const std::string scene = contents(folder / "mine/scene");
  for (const char* number : {"0.10795", "0.0635", "0.62", "0.35", "1198.26"}) {
    EXPECT_NE(scene.find(number), std::string::npos) << number;
    for (const char* file : {"in.cuttings", "0/U", "system/annulusMeshDict", "system/controlDict",
                             "constant/transportProperties", "constant/flowProperties", "constant/couplingProperties"})
      EXPECT_EQ(contents(folder / "mine" / file).find(number), std::string::npos) << number << " in " << file;
  }

  const fs::path control = folder / "mine/system/controlDict";
  write_file(control, std::regex_replace(contents(control), std::regex("writeInterval +0.5"), "writeInterval 0.02"));
  const ProgramResult run = in_folder({"mine/run", "--output", "fast", "--rpm", "180", "--ranks", "2"});
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(fs::is_regular_file(folder / "fast/0.02/U")) << "the run-in takes no times of output from the run";
  EXPECT_EQ(names_in(folder / "fast/0.02"), (std::set<std::string>{"U", "alpha", "nu", "p", "phi", "uniform"}))
      << "what a user looks at; the checkpoint has what the next step needs besides";
  EXPECT_NE(contents(folder / "fast/scene").find("rpm               180;"), std::string::npos);
  EXPECT_NE(contents(folder / "mine/scene").find("rpm               120;"), std::string::npos)
      << "the case itself stays";
  EXPECT_EQ(run.output.find("warning"), std::string::npos) << run.output;
  // The layout and the run have one definition of the Reynolds numbers.
  EXPECT_NEAR(printed(made.output, "Reynolds number"), printed(run.output, R"(Reynolds number .* m/s:)"),
              0.01 * printed(made.output, "Reynolds number"));
  EXPECT_NEAR(printed(made.output, R"(Reynolds number .* mean,)"), printed(run.output, R"(in the mean,)"),
              0.01 * printed(run.output, R"(in the mean,)"));
  // What the terminal says is what the table says: 1 % was asked for, and the grains lie on the low side.
  EXPECT_NEAR(printed(run.output, "particles, concentration"), 1, 0.02) << run.output;
  EXPECT_NE(run.output.find("bed "), std::string::npos) << run.output;

  const ProgramResult report = eccentra({"report", "fast", "-o", "report"});
  EXPECT_EQ(report.status, 0) << report.output;
  EXPECT_TRUE(fs::is_regular_file(folder / "report/beds.png"));

  const ProgramResult again = eccentra({"new", "section", "mine"});
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.output.find("'mine' exists already"), std::string::npos) << again.output;
}

TEST_F(OwnScene, WellOfSpheresGoesOn) {
  const ProgramResult made = eccentra({"new", "well", "w", "--length", "0.2", "--rate", "60ft/h", "--seconds", "0.05",
                                       "--cells", "6 24 8", "--pv", "20cP", "--yp", "10lbf/100ft2"});
  ASSERT_EQ(made.status, 0) << made.output;
  const ProgramResult run = in_folder({"w/run", "--output", "r"});
  ASSERT_EQ(run.status, 0) << run.output;
  // The case asks for a picture each 0.1 s, and the run is shorter.
  const auto files = names_in(folder / "r/postProcessing/eccentra");
  EXPECT_TRUE(std::any_of(files.begin(), files.end(), [](const std::string& name) {
    return std::regex_match(name, std::regex("particles_[1-9][0-9]*\\.vtk"));
  })) << "no picture after the start";
  // Rate of penetration: the hole's volume as mass.
  constexpr double kRadius = 8.5 * 0.0254 / 2, kDensity = 2619, kSpeed = 60 * 0.3048 / 3600;
  EXPECT_NEAR(printed(contents(folder / "w/scene"), "rate"), kDensity * 3.14159265 * kRadius * kRadius * kSpeed, 1e-4);
  const ProgramResult on = in_folder({"w/run", "--resume", "r", "--seconds", "0.1"});
  EXPECT_EQ(on.status, 0) << on.output;
}

// Grains that settle faster than the fluid rises come down to the inlet: they stay, as on the bottom of a hole.
TEST_F(OwnScene, SolidsThatSlideBackStayInTheWell) {
  const std::string shipped = required_environment("ECCENTRA_SOURCE") + "/cases/tomren-injection";
  ASSERT_EQ(eccentra({"new", "well", "w", "--diameter", "6.35mm", "--rate", "0.15"}).status, 0);
  for (const auto& [run, entry] : {std::pair<std::string, std::vector<std::string>>{shipped, {"--entry", "0.05"}},
                                   {"w", std::vector<std::string>{}}}) {
    std::vector<std::string> words = {run + "/run", "--output", "r",      "--inclination", "0",   "--velocity",
                                      "0.05",       "--rpm",    "0",      "--seconds",     "0.4", "--length",
                                      "0.2",        "--cells",  "6 24 8", "--run-in",      "5"};
    words.insert(words.end(), entry.begin(), entry.end());
    const ProgramResult result = in_folder(words);
    ASSERT_EQ(result.status, 0) << result.output;
    std::map<std::string, double> at_end = end_of("r");
    EXPECT_GT(at_end["inserted"], 100) << run;
    EXPECT_LT(at_end["com_z"], 0.03) << run << ": they have not come down";
    EXPECT_EQ(at_end["particles"], at_end["inserted"]) << run;
    fs::remove_all(folder / "r");
  }
}

// Chien's law, whose terminal velocities docs/closures.md states for this sphere.
TEST_F(OwnScene, SaysHowFastAGrainSettles) {
  for (const auto& [tau0, speed] : {std::pair{"0", 0.2832}, std::pair{"1", 0.2235}, std::pair{"3", 0.0933}}) {
    const ProgramResult made = eccentra({"new", "section", "x", "--plan", "--tau0", tau0});
    EXPECT_NEAR(printed(made.output, "settling velocity"), speed, 2e-3 * speed) << tau0 << made.output;
  }
  const ProgramResult held = eccentra({"new", "section", "x", "--plan", "--tau0", "6"});
  EXPECT_EQ(printed(held.output, "settling velocity"), 0) << held.output;
}

// Cuttings that settle stay, so that their number and the time of a step grow; those that the mud carries leave.
TEST_F(OwnScene, ExpectsTheTimeOfWhatIsInTheHole) {
  const auto expected = [&](const char* tau0, const char* seconds) {
    const ProgramResult made = eccentra(
        {"new", "well", "x", "--plan", "--length", "0.2", "--rate", "2", "--tau0", tau0, "--seconds", seconds});
    return printed(made.output, "expected run time +about");
  };
  EXPECT_NEAR(expected("6", "2") / expected("6", "1"), 2, 0.1);
  EXPECT_GT(expected("0", "2") / expected("0", "1"), 2.5);
}

TEST_F(OwnScene, HeapIsPouredDrawnAndGoesOn) {
  const ProgramResult made = eccentra({"new", "heap", "h", "--shape", "cube 8", "--count", "60", "--seconds", "0.6"});
  ASSERT_EQ(made.status, 0) << made.output;
  const ProgramResult run = in_folder({"h/run", "--output", "r", "--wallFriction", "0.8"});
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_EQ(run.output.find("WARNING"), std::string::npos) << run.output;
  EXPECT_NE(contents(folder / "r/scene").find("wallFriction      0.8;"), std::string::npos);
  const ProgramResult on = in_folder({"h/run", "--resume", "r", "--seconds", "0.8"});
  ASSERT_EQ(on.status, 0) << on.output;
  const ProgramResult report = eccentra({"report", "r", "-o", "report", "--frames", "3"});
  ASSERT_EQ(report.status, 0) << report.output;
  // A cube of the volume of a sphere of 6.35 mm that lies on its face has its centre at 2.56 mm; a cluster is rounder.
  EXPECT_GT(printed(report.output, R"(height of the solid's centre \(bodies\) \[mm\])"), 2.5) << report.output;
  EXPECT_LT(printed(report.output, R"(height of the solid's centre \(bodies\) \[mm\])"), 20) << report.output;
  for (const char* picture : {"report/scene.png", "report/strip.png"})
    EXPECT_GT(fs::file_size(folder / picture), 10000U) << picture;
  const ProgramResult fluid = in_folder({"h/run", "--output", "s", "--velocity", "1"});
  EXPECT_EQ(fluid.status, 1);
  EXPECT_NE(fluid.output.find("--velocity is not for a case without a fluid"), std::string::npos) << fluid.output;
  EXPECT_FALSE(fs::exists(folder / "s"));
}

// A slice of a drum, periodic along its axis.
TEST_F(OwnScene, DrumCarriesItsFillingUp) {
  const ProgramResult made = eccentra({"new", "drum", "d", "--shape", "cube 8", "--drum", "80mm", "--length", "25mm",
                                       "--rpm", "30", "--fill", "0.3", "--seconds", "0.7"});
  ASSERT_EQ(made.status, 0) << made.output;
  EXPECT_NE(made.output.find("cascades"), std::string::npos) << "Fr = 0.04: " << made.output;
  const ProgramResult run = in_folder({"d/run", "--output", "r"});
  ASSERT_EQ(run.status, 0) << run.output;
  const ProgramResult report = eccentra({"report", "r", "--no-pictures"});
  ASSERT_EQ(report.status, 0) << report.output;
  const double grains = printed(contents(folder / "r/scene"), "count");
  EXPECT_NEAR(printed(report.output, "bodies"), grains, 0) << "periodic and closed: none is lost";
}

// The options of `new` are those of `run`, with their units; a shape's file comes from where the user is.
TEST_F(OwnScene, RunTakesTheOptionsOfNew) {
  constexpr double kInch = 0.0254, kGallon = 3.785411784e-3, kPi = 3.14159265358979;
  ASSERT_EQ(eccentra({"new", "well", "w", "--length", "0.1", "--cells", "6 24 4", "--seconds", "0.01"}).status, 0);
  const ProgramResult run = in_folder(
      {"w/run",       "--output",    "r",        "--run-in", "1",      "--flow",          "300gpm",   "--hole",
       "9in",         "--pipe",      "4.5in",    "--rate",   "60ft/h", "--density",       "9ppg",     "--tau0",
       "2lbf/100ft2", "--rpm",       "20",       "--report", "1",      "--void-fraction", "gaussian", "--momentum",
       "explicit",    "--viscosity", "capped 60"});
  ASSERT_EQ(run.status, 0) << run.output;
  const std::string scene = contents(folder / "r/scene");
  const double area = kPi / 4 * (std::pow(9 * kInch, 2) - std::pow(4.5 * kInch, 2));
  EXPECT_NEAR(printed(scene, "velocity"), 300 * kGallon / 60 / area, 1e-6);
  EXPECT_NEAR(printed(scene, "holeRadius"), 4.5 * kInch, 1e-9);
  EXPECT_NEAR(printed(scene, "pipeRadius"), 2.25 * kInch, 1e-9);
  EXPECT_NEAR(printed(scene, "rate"), 2619 * kPi * std::pow(4.5 * kInch, 2) * 60 * 0.3048 / 3600, 1e-6);
  EXPECT_NEAR(printed(scene, "mudDensity"), 9 * 0.45359237 / kGallon, 1e-5);
  EXPECT_NEAR(printed(scene, "tau0"), 2 * 0.4788026, 1e-5);
  EXPECT_NE(contents(folder / "r/constant/couplingProperties").find("gaussian"), std::string::npos);
  EXPECT_NEAR(printed(contents(folder / "r/constant/transportProperties"), "muY"), 60, 0);

  ASSERT_EQ(eccentra({"new", "drum", "d", "--drum", "80mm", "--length", "25mm", "--fill", "0.1"}).status, 0);
  write_file(folder / "pear.csv", "x,y,z,r\n0,0,0,2\n2,0,0,1.5\n");
  const ProgramResult turned = in_folder({"d/run", "--output", "t", "--shape", "file pear.csv", "--drum", "90mm",
                                          "--filling", "0.05", "--seconds", "0.01"});
  ASSERT_EQ(turned.status, 0) << turned.output;
  EXPECT_NEAR(printed(contents(folder / "t/scene"), "drumRadius"), 0.045, 1e-9);
  EXPECT_TRUE(fs::is_regular_file(folder / "t/pear.csv"));

  for (const auto& [word, value, said] :
       {std::array{"--drum", "90furlong", "'90furlong'"}, std::array{"--hole", "9in", "--hole is not an option"},
        std::array{"--diameter", "-1mm", "'-1mm' is not above 0"}}) {
    const ProgramResult refused = in_folder({"d/run", "--output", "x", word, value});
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    EXPECT_NE(refused.output.find(said), std::string::npos) << refused.output;
  }
  EXPECT_FALSE(fs::exists(folder / "x"));
}

// A mesh of snappyHexMesh and the walls of the DEM from the same STL file.
TEST_F(OwnScene, HopperOnAMeshOfSnappyHexMeshLetsItsGrainsOut) {
  const std::string hopper = required_environment("ECCENTRA_SOURCE") + "/cases/hopper";
  const ProgramResult run =
      in_folder({hopper + "/run", "--output", "r", "--count", "100", "--settling", "0.15", "--seconds", "0.4",
                 "--velocity", "0.03", "--fluid_step", "0.002", "--interval", "80"});
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(fs::is_regular_file(folder / "r/log.snappyHexMesh"));
  std::map<std::string, double> at_end = end_of("r");
  // The spout is six grains wide: it does not clog, and no grain goes through the wall.
  EXPECT_GT(at_end["left"], 10);
  EXPECT_EQ(at_end["particles"] + at_end["left"], 100);
  EXPECT_LT(std::abs(at_end["volume_error"]), 1e-10);
  const ProgramResult report = eccentra({"report", "r", "-o", "report"});
  ASSERT_EQ(report.status, 0) << report.output;
  EXPECT_GT(fs::file_size(folder / "report/scene.png"), 10000U);
}

TEST_F(OwnScene, EachWrongWordIsOneSentence) {
  struct Case {
    std::vector<std::string> words;
    std::vector<std::string> said;
  };
  for (const Case& c :
       std::vector<Case>{{{"--pipe", "9in"}, {"--pipe", "'9in'", "does not fit"}},
                         {{"--flow", "3furlong"}, {"--flow", "'3furlong'", "gpm"}},
                         {{"--flow", "-1"}, {"--flow", "'-1'", "positive"}},
                         {{"--eccentricity", "1"}, {"--eccentricity", "'1'", "0.95"}},
                         {{"--pv", "10cP"}, {"--pv and --yp", "both"}},
                         {{"--pv", "10cP", "--yp", "5", "--k", "1"}, {"--pv and --yp", "the one or the other"}},
                         {{"--tau0", "-1"}, {"--tau0", "'-1'"}},
                         {{"--shape", "cube 7"}, {"cube 7", "n^3"}},
                         {{"--diameter", "90mm"}, {"--diameter", "gap"}},
                         {{"--cells", "8 32"}, {"--cells", "three whole numbers"}},
                         {{"--fluid-step", "0"}, {"--fluid-step", "'0'"}},
                         {{"--interval", "1.5"}, {"--interval", "whole number"}},
                         {{"--fill", "0.3"}, {"--fill", "eccentra new --help"}}}) {
    std::vector<std::string> words = {"new", "section", "x", "--plan"};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const ProgramResult run = eccentra(words);
    EXPECT_EQ(run.status, 1) << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    for (const std::string& word : c.said)
      EXPECT_NE(run.output.find(word), std::string::npos) << word << ": " << run.output;
  }
  for (const auto& [kind, option, value, remedy] :
       std::vector<std::array<std::string, 4>>{{"heap", "--count", "0", "whole number from 1"},
                                               {"heap", "--height", "5mm", "not above the heap"},
                                               {"heap", "--step", "1", "critical"},
                                               {"heap", "--stiffness", "1e6", "5 MPa"},
                                               {"drum", "--drum", "10mm", "expected at least"},
                                               {"drum", "--fill", "0.9", "0.6"},
                                               {"drum", "--length", "1mm", "expected at least"},
                                               {"bed", "--velocity", "0umf", "not a number with a unit"},
                                               {"bed", "--width", "5mm", "expected at least"},
                                               {"bed", "--solid-density", "900", "expected grains that sink"},
                                               {"bed", "--fluid", "beer", "choose from"}}) {
    const ProgramResult run = eccentra({"new", kind, "x", "--plan", option, value});
    EXPECT_EQ(run.status, 1) << run.output;
    EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
    EXPECT_NE(run.output.find(option), std::string::npos) << run.output;
    EXPECT_NE(run.output.find(remedy), std::string::npos) << option << ": " << run.output;
  }
  EXPECT_FALSE(fs::exists(folder / "x"));
  const ProgramResult unknown = eccentra({"foo"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.output.find("'foo' is not a command"), std::string::npos) << unknown.output;
}

TEST_F(OwnScene, TheDoctorFindsWhatIsMissing) {
  const ProgramResult whole = eccentra({"doctor"});
  EXPECT_EQ(whole.status, 0) << whole.output;
  const ProgramResult broken = run_program({required_environment("ECCENTRA_BIN") + "/eccentra", "doctor"},
                                           {folder, {"WM_PROJECT_DIR=/nowhere"}, 240});
  EXPECT_EQ(broken.status, 1) << broken.output;
  EXPECT_NE(broken.output.find("OpenFOAM   FAILED  WM_PROJECT_DIR '/nowhere'"), std::string::npos) << broken.output;
}

TEST_F(OwnScene, EveryProgramSaysItsVersion) {
  for (const char* name : {"annulusFoam", "annulusMesh", "annulusReport", "clusterShape", "eccentra", "eccentra-dem",
                           "eccentra-keys", "eccentra-run"}) {
    const std::string program = required_environment("ECCENTRA_BIN") + "/" + name;
    const ProgramResult version = in_folder({program, "--version"});
    EXPECT_EQ(version.status, 0) << name << version.output;
    EXPECT_TRUE(std::regex_search(version.output, std::regex(R"(\d+\.\d+\.\d+)"))) << name << version.output;
    const ProgramResult help = in_folder({program, "--help"});
    EXPECT_EQ(help.status, 0) << name << help.output;
    EXPECT_GT(help.output.size(), 100U) << name << help.output;
  }
}

} // namespace
