// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// clusterShape as a user runs it: arguments, files, JSON, pictures, exit codes.
#include "shape/stl_solids.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace {

struct Result {
  int code;
  std::string text; // both streams
};

Result run(const std::string& arguments) {
  const char* bin = std::getenv("ECCENTRA_BIN");
  const std::string command = std::string(bin ? bin : ".") + "/clusterShape " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Result result{-1, {}};
  std::array<char, 4096> buffer;
  while (std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    result.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

nlohmann::json json_of(const std::string& arguments) {
  const Result r = run(arguments + " --json");
  EXPECT_EQ(r.code, 0) << r.text;
  return nlohmann::json::parse(r.text);
}

std::string read(const std::string& name) {
  std::ifstream in(name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(ClusterShapeTool, PrintsTheResistanceInCreepingFlow) {
  const nlohmann::json r = json_of("disk 48")["resistance"];
  EXPECT_NEAR(r["translation"][2][2].get<double>(), 1.232, 5e-3);
  EXPECT_EQ(r["translation"][0][0], r["translation"][1][1]);
  EXPECT_NEAR(r["rotation"][2][2].get<double>(), 1.748, 1e-2);
  EXPECT_NEAR(r["bretherton"][1].get<double>(), -.717, 5e-3);
  EXPECT_NEAR(r["jeffery_period"][1].get<double>(), 18.06, 5e-2);
  EXPECT_EQ(r["centre"], nlohmann::json({0., 0., 0.}));
  const std::string text = run("disk 48").text;
  for (const char* row :
       {"K, of the sphere's drag", "K_rot, of", "B, spin by strain", "Jeffery's period", "centre of resistance"})
    EXPECT_NE(text.find(row), std::string::npos) << row;
}

TEST(ClusterShapeTool, JsonHoldsTheKeysOfTheDesign) {
  const nlohmann::json j = json_of("cube 64 --diameter 6.35e-3");
  EXPECT_EQ(j["name"], "cube 64");
  EXPECT_EQ(j["spheres"], 64);
  EXPECT_NEAR(j["volume"].get<double>(), M_PI / 6 * std::pow(6.35e-3, 3), 1e-15);
  EXPECT_NEAR(j["equivalent_radius"].get<double>(), 3.175e-3, 1e-12);
  EXPECT_NEAR(j["bounding_radius"].get<double>() / 3.175e-3, 1.220, 1e-3);
  EXPECT_NEAR(j["sphericity"].get<double>(), 0.85, 0.005);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(j["centre"][k], 0);
    EXPECT_EQ(j["inertia"][k], j["inertia"][0]);
  }
  EXPECT_NEAR(j["inertia"][0].get<double>() / (0.4 * 3.175e-3 * 3.175e-3), 1.057, 1e-3);
  EXPECT_NEAR(j["eccentricity"]["plane"]["mean"].get<double>(), 0.405, 0.004);
  EXPECT_NEAR(j["eccentricity"]["sphere"]["max"].get<double>(), 0.791, 0.008);
  EXPECT_NEAR(j["eccentricity"]["cluster"]["mean"].get<double>(), 0.427, 0.0043);
  EXPECT_LT(j["eccentricity"]["plane"]["min"].get<double>(), 1e-6);
  EXPECT_EQ(j["mu_shape"], j["eccentricity"]["plane"]["mean"]);
}

TEST(ClusterShapeTool, RunsTwiceToTheSameDigits) {
  EXPECT_EQ(run("disk 19 --json").text, run("disk 19 --json").text);
}

TEST(ClusterShapeTool, WritesAClumpThatItReadsBack) {
  ASSERT_EQ(run("disk 7 --diameter 2e-3 -o made.clump").code, 0);
  const nlohmann::json made = json_of("disk 7 --diameter 2e-3"), back = json_of("made.clump"),
                       words = json_of("file made.clump");
  EXPECT_NEAR(back["volume"].get<double>(), made["volume"].get<double>(), 1e-12 * made["volume"].get<double>());
  EXPECT_EQ(back["volume"], words["volume"]);
  EXPECT_NEAR(json_of("made.clump --scale 2")["equivalent_radius"].get<double>(), 2e-3, 1e-12);
}

TEST(ClusterShapeTool, UnderstandsTheWordsOfAScript) {
  EXPECT_EQ(run("cube 8 diameter 2e-3 --json").text, run("cube 8 --diameter 2e-3 --json").text);
  eccentra::test::write_stl("box.stl", eccentra::test::box(Eigen::Vector3d(2, 1, 1), Eigen::Vector3d(1, 0, 0)));
  EXPECT_EQ(run("stl box.stl spheres 5 mass solid resolution 16 --json").text,
            run("stl box.stl --spheres 5 --mass solid --resolution 16 --json").text);
  EXPECT_EQ(run("cube 8 diameter").code, 1);
  EXPECT_EQ(run("cube 8 diameter -2").code, 1);
  EXPECT_EQ(run("stl box.stl spheres 5 mass air").code, 1);
}

TEST(ClusterShapeTool, CentreIsThatOfTheFile) {
  std::ofstream("moved.clump") << "1 2 3 0.5\n1.5 2 3 0.5\n";
  const nlohmann::json j = json_of("moved.clump");
  EXPECT_NEAR(j["centre"][0].get<double>(), 1.25, 1e-9);
  EXPECT_NEAR(j["centre"][2].get<double>(), 3, 1e-9);
}

TEST(ClusterShapeTool, ComparesTwoShapes) {
  const Result text = run("compare cube 64 disk 48");
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.text.find("sphericity"), std::string::npos);
  const nlohmann::json j = json_of("compare cube 64 disk 48");
  EXPECT_EQ(j["a"]["name"], "cube 64");
  EXPECT_EQ(j["b"]["name"], "disk 48");
  EXPECT_EQ(j["a"]["eccentricity_partner"], "disk 48");
}

TEST(ClusterShapeTool, PropertyLinesNameEveryPair) {
  const Result r = run("disk 48 --property-lines --types 2 --type 2 --partner sphere --estimate max --mu-r 0.05");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.text.find("fix mu_shape all property/global shapeRollingFriction peratomtypepair 2 0 0.94"),
            std::string::npos)
      << r.text;
  EXPECT_NE(r.text.find("coefficientRollingFriction peratomtypepair 2 0.05 0.05 0.05 0.05"), std::string::npos)
      << r.text;
  EXPECT_NE(run("cube 8 --property-lines --estimate paper").text.find("peratomtypepair 1 0.32"), std::string::npos);
  EXPECT_NE(run("disk 7 --property-lines --estimate paper").text.find("peratomtypepair 1 0.95"), std::string::npos);
  EXPECT_EQ(run("cube 8 --property-lines --types 2 --type 3").code, 1);
  EXPECT_EQ(run("sphere 6 --property-lines --estimate paper").code, 1);
}

TEST(ClusterShapeTool, FillsAnStlSolid) {
  eccentra::test::write_stl("box.stl", eccentra::test::box(Eigen::Vector3d(2, 1, 1), Eigen::Vector3d(1, 0, 0)));
  const nlohmann::json j = json_of("stl box.stl --spheres 12 --scale 1e-3 --mass solid --resolution 20 -o box.clump");
  EXPECT_NEAR(j["volume"].get<double>(), 16e-9, 1e-14);
  EXPECT_EQ(j["spheres"], 12);
  ASSERT_FALSE(j["fit"].empty());
  EXPECT_EQ(j["fit"].front()["spheres"], 1);
  EXPECT_EQ(j["fit"].back()["spheres"], 12);
  EXPECT_LT(j["fit"].back()["volume_error"], j["fit"].front()["volume_error"]);
  EXPECT_NEAR(j["solid"]["centre"][0].get<double>(), 1e-3, 1e-9);
  EXPECT_EQ(json_of("box.clump")["spheres"], 12);
}

TEST(ClusterShapeTool, DrawsPicturesAndSurfaces) {
  const Result r = run("compare sphere 6 disk 7 --png pair.png --vtk pair.vtp");
  ASSERT_EQ(r.code, 0) << r.text;
  const std::string png = read("pair.png"), vtp = read("pair.vtp");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  auto number = [&](int at) { // width and height stand in the header, most significant byte first
    return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_GT(number(16), number(20)); // two panels side by side
  EXPECT_GT(png.size(), 40000u) << "an empty picture compresses to less";
  EXPECT_NE(vtp.find("delta_e/R_eq"), std::string::npos);
}

TEST(ClusterShapeTool, BadInputIsOneSentenceAndAnExitCode) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "shape"},
      {"cube 65", "cube 65"},
      {"cone 3", "cone"},
      {"cube 64 67", "'67'"},
      {"nowhere.clump", "nowhere.clump"},
      {"stl nowhere.stl --spheres 4", "nowhere.stl"},
      {"stl nowhere.stl", "--spheres N"},
      {"stl nowhere.stl odd --spheres 4", "'odd'"},
      {"cube 8 --diameter -1", "diameter"},
      {"cube 8 --diameter nan", "diameter"},
      {"cube 8 --spheres 4", "--spheres"},
      {"cube 8 --scale 4", "--scale"},
      {"cube 8 --vtk c8.obj", ".vtp or .vtk"},
      {"cube 8 --png c8.jpg", ".png"},
      {"cube 8 -o nowhere/c8.clump", "nowhere/c8.clump"},
      {"compare cube 8", "missing"},
      {"cube 8 --estimate max", "property-lines"},
      {"cube 8 --property-lines --estimate most", "most"},
      {"cube 8 --colour red", "colour"},
  };
  for (const auto& [arguments, word] : cases) {
    const Result r = run(arguments);
    EXPECT_GT(r.code, 0) << arguments;
    EXPECT_NE(r.text.find(word), std::string::npos) << arguments << ": " << r.text;
    EXPECT_EQ(r.text.find("terminate"), std::string::npos) << r.text;
  }
}

TEST(ClusterShapeTool, HelpAndList) {
  EXPECT_EQ(run("--help").code, 0);
  const std::string list = run("list").text;
  for (const char* shape : {"sphere 1", "sphere 6", "cube 8", "cube 27", "cube 64", "disk 7", "disk 19", "disk 48"})
    EXPECT_NE(list.find(shape), std::string::npos);
}

} // namespace
