// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The advice on levels of detail: the cheapest level that the data support, how sure they are, and what is said without
// data.
#include "tools/advise.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <stdexcept>

using namespace eccentra::shape;

namespace {

const char* const kHeader =
    "scene,body,result,unit,level,mean,standard_error,runs,deviation,deviation_error,cpu_s,failed\n";

std::vector<LevelResult> read(const std::string& rows, const std::string& header = kHeader) {
  std::istringstream in(header + rows);
  return read_level_results(in, "levels.csv");
}

/// C8 is cheap and off by 8 +- 1 %, C27 by 3 +- 3 %, C64 by 2 +- 1 %; a level that failed has no numbers.
const char* const kHeap = "heap,cube,slope,degrees,S1,10,0.1,3,-0.5,0.01,1,\n"
                          "heap,cube,slope,degrees,S6,nan,nan,0,nan,nan,nan,it blew up\n"
                          "heap,cube,slope,degrees,C8,18.4,0.1,3,-0.08,0.01,2,\n"
                          "heap,cube,slope,degrees,C27,19.4,0.5,3,-0.03,0.03,4,\n"
                          "heap,cube,slope,degrees,C64,19.6,0.1,3,0.02,0.01,8,\n"
                          "heap,cube,slope,degrees,C125,20,0.2,3,nan,nan,16,\n"
                          "drum,cube,angle,degrees,C8,30,0.1,3,0.001,0.001,2,\n"
                          "drum,cube,angle,degrees,C125,30,0.1,3,nan,nan,16,\n"
                          "drum,disk,angle,degrees,D48,30,0.1,3,nan,nan,16,\n";

std::string sentence(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "";
}

} // namespace

TEST(Advise, TakesTheCheapestLevelThatTheDataAreSureOf) {
  const auto all = advise(read(kHeap), "cube", "", 0.05);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].scene, "heap");
  // C27 is cheaper and within 5 %, but its standard error reaches beyond.
  EXPECT_EQ(all[0].level.level, "C64");
  EXPECT_EQ(all[0].confidence, Confidence::sure);
  EXPECT_EQ(all[0].reference.level, "C125");
  EXPECT_EQ(all[1].level.level, "C8");
}

TEST(Advise, SaysSoWhereTheFinestLevelIsMissing) {
  const auto all = advise(read("section,disk,flux,m3/s,S1,250,1,3,nan,nan,7,\n"
                               "section,disk,flux,m3/s,D48,nan,nan,0,nan,nan,nan,not run\n"
                               "section,disk,height,mm,S1,1,1,3,nan,nan,7,\n"
                               "section,disk,height,mm,D48,0,0,3,nan,nan,7,\n"),
                          "disk", "", 0.05);
  ASSERT_EQ(all.size(), 2u);
  for (const Advice& a : all)
    EXPECT_EQ(a.confidence, Confidence::unknown);
  EXPECT_NE(text_of(all, 0.05, "levels.csv").find("D48 has no result"), std::string::npos);
  EXPECT_EQ(json_of(all, 0.05, "levels.csv")["advice"][0]["confidence"], "not known");
}

// Results of the annulus have commas in their names.
TEST(Advise, ReadsQuotedCells) {
  const auto results = read("section,cube,\"annulus 0 deg, 0.58 m/s: \"\"flux\"\"\",m3/s,C64,2,0.1,3,nan,nan,16,\n");
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].result, "annulus 0 deg, 0.58 m/s: \"flux\"");
  EXPECT_EQ(results[0].level, "C64");
}

TEST(Advise, SaysWhereDeviationAloneIsWithinTheErrorAndWhereNoLevelIs) {
  EXPECT_EQ(advise(read(kHeap), "cube", "heap", 0.025)[0].level.level, "C64");
  EXPECT_EQ(advise(read(kHeap), "cube", "heap", 0.025)[0].confidence, Confidence::likely);
  const auto strict = advise(read(kHeap), "cube", "heap", 0.01);
  ASSERT_EQ(strict.size(), 1u);
  EXPECT_EQ(strict[0].confidence, Confidence::reference);
  EXPECT_EQ(strict[0].level.level, "C125");
  EXPECT_EQ(advise(read(kHeap), "cube", "heap", 0.1)[0].level.level, "C8");
  const std::string text = text_of(strict, 0.01, "levels.csv");
  EXPECT_NE(text.find("no cheaper level"), std::string::npos);
  EXPECT_NE(text.find("levels.csv"), std::string::npos);
  EXPECT_EQ(json_of(strict, 0.01, "levels.csv")["advice"][0]["confidence"], "reference only");
}

TEST(Advise, AnswersFromTheTablesThatAreShipped) {
  const char* source = std::getenv("ECCENTRA_SOURCE");
  ASSERT_TRUE(source);
  int tables = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(source) + "/cases/accuracy-cost/levels")) {
    if (entry.path().extension() != ".csv")
      continue;
    ++tables;
    std::ifstream in(entry.path());
    const std::vector<LevelResult> results = read_level_results(in, entry.path());
    std::set<std::string> bodies;
    for (const LevelResult& row : results)
      bodies.insert(row.body);
    EXPECT_EQ(bodies.size(), 1) << entry.path();
    for (const Advice& advice : advise(results, *bodies.begin(), "", 0.1)) {
      EXPECT_NE(advice.confidence, Confidence::unknown) << entry.path() << ' ' << advice.scene;
      EXPECT_GE(advice.level.runs, 3) << entry.path() << ' ' << advice.scene;
      EXPECT_NE(advice.reference.level.find("0.15"), std::string::npos) << "the true body, which has its rounding";
    }
  }
  EXPECT_GE(tables, 4);
}

TEST(Advise, WithoutDataItSaysThatItKnowsGeometryAlone) {
  const auto cubes = geometry_levels("cube");
  // Finer levels of a cube come nearer in every measure.
  for (std::size_t k = 1; k < cubes.size(); ++k)
    EXPECT_LT(cubes[k].largest(), cubes[k - 1].largest()) << cubes[k].name;
  EXPECT_EQ(cubes.back().largest(), 0);
  EXPECT_NE(text_of(cubes, 0.1).find("geometry alone"), std::string::npos);
  EXPECT_EQ(json_of(cubes, 2.0)["level"], cubes.front().name) << "an error of 200 % needs no cluster";
  EXPECT_EQ(json_of(cubes, 1e-9)["level"], cubes.back().name);
  EXPECT_EQ(json_of(geometry_levels("disk"), 0.1)["level"], "disk 19") << "sphericity of disk 7 is off by 13.8 %";
}

TEST(Advise, NamesWhatIsWrong) {
  EXPECT_NE(sentence([] { geometry_levels("ball"); }).find("'ball'"), std::string::npos);
  EXPECT_NE(sentence([] { advise(read(kHeap), "cube", "hopper", 0.1); }).find("'hopper'"), std::string::npos);
  EXPECT_NE(sentence([] { read("", ""); }).find("empty"), std::string::npos);
  EXPECT_NE(sentence([] { read("", "scene,body\n"); }).find("line 1 has no column 'result'"), std::string::npos);
  EXPECT_NE(sentence([] { read("heap,cube\n"); }).find("line 2 has 2 cells"), std::string::npos);
  EXPECT_NE(sentence([] { read("heap,cube,slope,degrees,S1,ten,0.1,3,0,0,1,\n"); }).find("line 2 has 'ten'"),
            std::string::npos);
}
