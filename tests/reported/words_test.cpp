// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Words that meant something else for clusters than they do in stock: each is obeyed, or refused in one sentence.
#include "support/granular_script.h"
#include "support/program_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace eccentra::test;

/// A scene up to its integrator; a test replaces or appends lines.
const std::string head = granular_box("0 0.03 0 0.03 -0.002 0.05", "p p f") + granular_material({5e6, 0.3, 0.5, 0.3}) +
                         R"(pair_style gran/cluster model hertz tangential history
pair_coeff * *
timestep 2e-5
fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0
fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2500 shape disk 19 diameter 6e-3
fix d all particledistribution/discrete 15485867 1 t 1.0
fix integr all nve/cluster
)";

const std::string one_place = "region one block 0.01 0.02 0.01 0.02 0.006 0.012 units box\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos)
    throw std::runtime_error("the scene has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

ProgramResult run_script(const std::string& script, const std::string& name = "scene") {
  const auto folder = fresh_folder(name);
  write_file(folder / "in.script", script);
  return run_program({program("eccentra-dem"), "-in", "in.script", "-log", "none"}, {folder, {}, 250});
}

/// The numbers behind "RESULT" in what a script has printed last.
std::vector<double> results(const ProgramResult& run) {
  std::vector<double> numbers;
  std::istringstream lines(run.output);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("RESULT ", 0) == 0) {
      numbers.clear();
      std::istringstream arguments(line.substr(7));
      for (double number; arguments >> number;)
        numbers.push_back(number);
    }
  return numbers;
}

/// Lines that print variables as results.
std::string print_results(const std::vector<std::string>& formulas) {
  std::string script, print = "print \"RESULT";
  for (std::size_t k = 0; k < formulas.size(); ++k) {
    script += "variable r" + std::to_string(k) + " equal " + formulas[k] + "\n";
    print += " ${r" + std::to_string(k) + "}";
  }
  return script + print + "\"\n";
}

void expect_refused(const ProgramResult& run, const std::vector<std::string>& parts) {
  EXPECT_GT(run.status, 0) << run.output;
  EXPECT_EQ(run.signal, 0);
  std::smatch sentence;
  ASSERT_TRUE(std::regex_search(run.output, sentence, std::regex("ERROR: [^\n]*"))) << run.output;
  for (const std::string& part : parts)
    EXPECT_NE(sentence.str().find(part), std::string::npos) << "'" << part << "' is not in: " << sentence.str();
}

} // namespace

// A disk bounces and slides; the set-up of a run must change nothing.
TEST(Reported, run_every) {
  const auto final_energies = [](int every) {
    return results(run_script(head + one_place +
                              "fix ins all insert/pack seed 32452843 distributiontemplate d vel constant 0.5 0.1 -0.3 "
                              "insert_every once orientation random region one particles_in_region 1\n"
                              "fix g all gravity 9.81 vector 0 0 -1\nrun 1\nunfix ins\n"
                              "thermo_style custom step ke f_integr\nthermo 100000\nrun 1000 every " +
                              std::to_string(every) + " NULL\nrun 0\n" +
                              print_results({"f_integr[1]", "f_integr[2]"})));
  };
  const std::vector<double> whole = final_energies(1000);
  ASSERT_EQ(whole.size(), 2u);
  EXPECT_GT(whole[0], 1e-6);
  for (const int every : {100, 7, 1}) {
    const std::vector<double> pieces = final_energies(every);
    ASSERT_EQ(pieces.size(), 2u) << every;
    for (int k = 0; k < 2; ++k)
      EXPECT_NEAR(pieces[k], whole[k], 1e-9 * whole[k]) << every;
  }
}

TEST(Reported, overlap_at_border) {
  const ProgramResult run = run_script(
      head +
      "region fill block 0 0.03 0 0.03 0.006 0.045 units box\n"
      "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once overlapcheck yes orientation "
      "random region fill check_dist_from_subdomain_border no ntry_mc 10000 volumefraction_region 0.4\nrun 200\n");
  expect_refused(run, {"fix ins insert/pack", "overlap", "check_dist_from_subdomain_border", "'no'"});
  EXPECT_EQ(run.output.find("smaller time step"), std::string::npos);
}

TEST(Reported, density_uniform) {
  const double volume = M_PI / 6 * std::pow(6e-3, 3); // of the union, by the diameter's definition
  // Mean, least and largest density, mass, number of bodies.
  const auto densities = [volume](const std::string& density) {
    auto found = results(
        run_script(replaced(head, "density constant 2500 shape disk 19", density + " shape cube 8") +
                   "region fill block 0 0.03 0 0.03 0.006 0.045 units box\n"
                   "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once region fill "
                   "particles_in_region "
                   "60\nrun 1\ncompute m all property/atom mass\ncompute mean all reduce ave c_m\n"
                   "compute least all reduce min c_m\ncompute most all reduce max c_m\ncompute sum all reduce sum c_m\n"
                   "thermo_style custom step c_mean c_least c_most c_sum atoms\nrun 0\n" +
                   print_results({"c_mean", "c_least", "c_most", "c_sum", "atoms"})));
    for (std::size_t k = 0; k < found.size() && k < 3; ++k)
      found[k] /= volume;
    return found;
  };
  const auto constant = densities("density constant 2500");
  ASSERT_EQ(constant.size(), 5u);
  EXPECT_NEAR(constant[3], constant[4] * 2500 * volume, 1e-9);
  const auto uniform = densities("density uniform 2000 3000");
  ASSERT_EQ(uniform.size(), 5u);
  EXPECT_GE(uniform[1], 2000);
  EXPECT_LE(uniform[2], 3000);
  EXPECT_GT(uniform[2] - uniform[1], 700);
  EXPECT_NEAR(uniform[0], 2500, 4 * 1000 / std::sqrt(12 * uniform[4]));
  EXPECT_NEAR(uniform[3], uniform[4] * uniform[0] * volume, 1e-9);
  const auto gaussian = densities("density gaussian 2500 100");
  ASSERT_EQ(gaussian.size(), 5u);
  EXPECT_GE(gaussian[1], 2200);
  EXPECT_LE(gaussian[2], 2800);
  EXPECT_GT(gaussian[2] - gaussian[1], 200);
  EXPECT_NEAR(gaussian[0], 2500, 4 * 100 / std::sqrt(gaussian[4]));
}

TEST(Reported, insert_orientation_constant) {
  const auto quaternion = [](const std::string& orientation, const std::string& word) {
    const ProgramResult run =
        run_script(replaced(head, "diameter 6e-3", "diameter 6e-3 " + word) + one_place +
                   "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once " + orientation +
                   " region one particles_in_region 1\nrun 1\nunfix ins\n" +
                   "compute w all reduce sum f_cluster_bodies[1]\ncompute x all reduce sum f_cluster_bodies[2]\n"
                   "compute y all reduce sum f_cluster_bodies[3]\ncompute z all reduce sum f_cluster_bodies[4]\n"
                   "thermo_style custom step c_w c_x c_y c_z\nrun 0\n" +
                   print_results({"c_w", "c_x", "c_y", "c_z"}));
    const auto q = results(run);
    EXPECT_EQ(q.size(), 4u) << run.output;
    return q;
  };
  const std::vector<double> turned = {0.5, 0.5, -0.5, 0.5}, upright = {1, 0, 0, 0};
  for (const char* word : {"", "orientation given"}) {
    EXPECT_EQ(quaternion("orientation constant 0.5 0.5 -0.5 0.5", word), turned) << word;
    EXPECT_EQ(quaternion("orientation template", word), upright) << word;
  }
  // Random where the insertion says so, and where it says nothing.
  EXPECT_NE(quaternion("orientation random", ""), upright);
  EXPECT_NE(quaternion("", ""), upright);
  EXPECT_EQ(quaternion("", "orientation given"), upright);
  expect_refused(
      run_script(replaced(head, "diameter 6e-3", "diameter 6e-3 orientation random") + one_place +
                 "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once orientation "
                 "constant 0 1 0 0 region one particles_in_region 1\nrun 1\n"),
      {"fix ins insert/pack", "orientation", "'t'"});
}

// A disk slides on the floor: without a tangential model nothing slows it down.
TEST(Reported, gran_cluster_without_tangential) {
  const auto momentum = [](const std::string& arguments) {
    std::string scene = head;
    for (int k = 0; k < 2; ++k)
      scene = replaced(scene, "model hertz tangential history", "model hertz!" + arguments);
    for (int k = 0; k < 2; ++k)
      scene = replaced(scene, "hertz!", "hertz ");
    const ProgramResult run = run_script(
        scene + one_place +
        "fix ins all insert/pack seed 32452843 distributiontemplate d vel constant 0.3 0 -0.3 insert_every once "
        "orientation random region one particles_in_region 1\nfix g all gravity 9.81 vector 0 0 -1\nrun 1\nunfix ins\n"
        "run 0\n" +
        print_results({"f_integr[3]"}) + "run 3000\n" + print_results({"f_integr[3]", "f_floor"}));
    const auto all = results(run);
    EXPECT_EQ(all.size(), 2u) << run.output;
    return all.empty() ? -1 : all[0] / (2500 * M_PI / 6 * std::pow(6e-3, 3) * 0.3);
  };
  EXPECT_NEAR(momentum(""), 1, 1e-12);
  EXPECT_NEAR(momentum("tangential off"), 1, 1e-12);
  EXPECT_LT(momentum("tangential history"), 0.9);
}

TEST(Reported, wall_rolling_with_clusters_only) {
  const std::string scene =
      replaced(replaced(head, "history primitive", "history rolling_friction cdt primitive"), "fix floor",
               "fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.3\nfix floor");
  EXPECT_EQ(run_script(scene + "run 1\n").status, 0) << "it acts on their sub-spheres";
  const std::string sphere = "fix s all particletemplate/sphere 15485917 atom_type 1 density constant 2500 radius "
                             "constant 2e-3\n";
  EXPECT_EQ(run_script(scene + sphere + "run 1\n").status, 0);
}

TEST(Reported, second_pour_of_smaller_bodies) {
  const ProgramResult run = run_script(
      replaced(replaced(head, "boundary p p f", "boundary f f f"), "0 0.03 0 0.03 -0.002 0.05",
               "-0.05 0.05 -0.05 0.05 -0.05 0.05") +
      "fix b all particletemplate/cluster 15485917 atom_type 1 density constant 2619 shape cube 64 diameter 0.02\n"
      "fix d_b all particledistribution/discrete 32452867 1 b 1.0\n"
      "fix s all particletemplate/cluster 49979693 atom_type 1 density constant 2619 shape disk 19 diameter 0.002\n"
      "fix d_s all particledistribution/discrete 67867967 1 s 1.0\n"
      "region r block -0.03 0.03 -0.03 0.03 -0.03 0.03 units box\n"
      "fix p1 all insert/pack seed 49979687 distributiontemplate d_b insert_every once overlapcheck yes maxattempt 300 "
      "region r particles_in_region 6\nrun 1\nunfix p1\n"
      "fix p2 all insert/pack seed 67867979 distributiontemplate d_s insert_every once overlapcheck yes maxattempt 300 "
      "region r particles_in_region 800\nrun 1\nunfix p2\n"
      "compute c all contact/cluster/atom\ncompute touching all reduce sum c_c[1]\nthermo_style custom step "
      "c_touching\n"
      "run 0\n" +
      print_results({"c_touching", "atoms"}));
  const auto found = results(run);
  ASSERT_EQ(found.size(), 2u) << run.output;
  EXPECT_EQ(found[0], 0);
  EXPECT_GT(found[1], 700);
}

TEST(Reported, unread_material_property) {
  const std::string unread = replaced(
      head, "pair_style", "fix m5 all property/global coefficientRollingFriction peratomtypepair 1 0.3\npair_style");
  const ProgramResult run = run_script(unread + "run 1\n");
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(
      std::regex_search(run.output, std::regex("WARNING: fix m5 .*coefficientRollingFriction.*read by no model")))
      << run.output;
  EXPECT_EQ(run.output.find("WARNING: fix m4"), std::string::npos) << run.output;
  // A coefficient of 0 asks for nothing.
  EXPECT_EQ(run_script(replaced(unread, "1 0.3\npair", "1 0\npair") + "run 1\n").output.find("read by no model"),
            std::string::npos);
}

// The DEM side of each coupled case, without its fluid, with a grain a thousand times as stiff.
TEST(Reported, copied_case_with_another_grain) {
  int cases = 0;
  const std::filesystem::path source = required_environment("ECCENTRA_SOURCE");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "cases")) {
    std::ifstream in(entry.path());
    std::stringstream text;
    if (!entry.is_regular_file() || !(text << in.rdbuf()) || text.str().find(" fluid/couple ") == std::string::npos ||
        entry.path().filename().string().rfind("in.", 0) != 0)
      continue;
    ++cases;
    const std::string script = text.str();
    std::smatch limit;
    ASSERT_TRUE(std::regex_search(script, limit, std::regex("fix +\\S+ all timestep/limit [^\n]*enforce yes")))
        << entry.path();
    if (script.find("youngsModulus peratomtype 5e6") == std::string::npos)
      continue;
    std::string stiff = replaced(script, "youngsModulus peratomtype 5e6", "youngsModulus peratomtype 5e8");
    stiff = std::regex_replace(stiff, std::regex("\nfix +\\S+ all fluid/([^\n]*&\n)*[^\n]*"), "");
    stiff = std::regex_replace(stiff, std::regex("(variable +seconds +index) [^\n]*"), "$1 0.2");
    stiff = std::regex_replace(stiff, std::regex("\ndump [^\n]*"), "");
    expect_refused(run_script(stiff, "case" + std::to_string(cases)), {"timestep/limit", "critical step"});
  }
  EXPECT_GE(cases, 2);
}

// Columns of the stock dumps that read the size or the spin of a body: the body's own, or not offered.
TEST(Reported, dump_columns_of_bodies) {
  const std::string body = head + one_place +
                           "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once omega "
                           "constant 1 2 3 region one particles_in_region 1\nrun 1\nunfix ins\n";
  const auto print_first = [](const std::string& columns) {
    return "dump c all custom 1 columns.txt " + columns +
           "\ndump_modify c format \"%.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\"\nrun 0\n";
  };
  const ProgramResult run = run_script(
      body + print_first("mass density radius diameter omegax omegay omegaz f_cluster_bodies[5] f_cluster_bodies[6] "
                         "f_cluster_bodies[7]"));
  EXPECT_EQ(run.status, 0) << run.output;
  std::ifstream file("scene/columns.txt");
  std::string line;
  while (std::getline(file, line) && line.rfind("ITEM: ATOMS", 0) != 0)
    ;
  double mass = 0, density = 0, radius = 0, diameter = 0, spin[3] = {}, momentum[3] = {};
  ASSERT_TRUE(file >> mass >> density >> radius >> diameter >> spin[0] >> spin[1] >> spin[2] >> momentum[0] >>
              momentum[1] >> momentum[2])
      << run.output;
  const double volume = std::acos(-1.0) / 6 * std::pow(6e-3, 3);
  EXPECT_NEAR(mass, 2500 * volume, 1e-9 * mass);
  EXPECT_NEAR(density, 2500, 1e-9 * density);
  EXPECT_GT(radius, 3e-3) << "of the bounding sphere";
  EXPECT_NEAR(diameter, 2 * radius, 1e-9 * radius);
  // Inserted with this spin, and turned freely for one step of 20 us.
  const double inertia_of_ball = 0.4 * mass * 9e-6;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(spin[k], 1 + k, 0.01);
    EXPECT_GT(std::abs(momentum[k]), 0.1 * inertia_of_ball);
  }
  for (const char* column : {"angmomx", "quat1", "shapex", "inertiax", "blockiness1", "roundness1", "eradius", "mux"}) {
    const ProgramResult none = run_script(body + print_first(column), "column");
    expect_refused(none, {"isn't allocated"});
  }
}

// Every keyword of the stock styles that ours stand in for, but for those that are simply obeyed: refused by name.
TEST(Reported, keywords_of_stock_styles) {
  struct Row {
    const char* from;
    const char* to;
    const char* keyword; ///< in the sentence; null: accepted, as it asks for nothing
  };
  const Row rows[] = {
      // particletemplate/sphere and /multisphere
      {"diameter 6e-3", "diameter 6e-3 radius constant 3e-3", "radius"},
      {"diameter 6e-3", "diameter uniform 5e-3 6e-3", nullptr},
      {"diameter 6e-3", "diameter constant 6e-3", nullptr},
      {"diameter 6e-3", "diameter 6e-3 relative yes", "relative"},
      {"diameter 6e-3", "diameter 6e-3 region box", "region"},
      {"diameter 6e-3", "diameter 6e-3 volume_limit 1e-20", nullptr},
      {"diameter 6e-3", "diameter 6e-3 additional_group all", nullptr},
      {"diameter 6e-3", "diameter 6e-3 nspheres 8", "nspheres"},
      {"diameter 6e-3", "diameter 6e-3 ntry 100000", "ntry"},
      {"diameter 6e-3", "atom_type 1 spheres file a.clump", "spheres"},
      {"diameter 6e-3", "diameter 6e-3 spheres_different_types file a.clump", "spheres_different_types"},
      {"diameter 6e-3", "diameter 6e-3 bonded yes", "bonded"},
      {"diameter 6e-3", "diameter 6e-3 type 1", "type"},
      {"diameter 6e-3", "diameter 6e-3 mass 1e-3", "mass"},
      {"diameter 6e-3", "diameter 6e-3 inertia_tensor 1 0 0 1 0 1", "inertia_tensor"},
      {"diameter 6e-3", "diameter 6e-3 use_volume", "use_volume"},
      {"diameter 6e-3", "diameter 6e-3 use_density", "use_density"},
      {"diameter 6e-3", "diameter 6e-3 fflag on on off", "fflag"},
      {"diameter 6e-3", "diameter 6e-3 tflag on on off", "tflag"},
      {"density constant 2500", "density lognormal 7 0.1", "density lognormal '7'"},
      {"density constant 2500", "density lognormal 2500 0.1", nullptr},
      {"density constant 2500", "density gaussian 2500 1000", "density gaussian '1000'"},
      {"density constant 2500", "density uniform 3000 2000", "density uniform '2000'"},
      // pair gran
      {"history\npair_coeff", "no_history\npair_coeff", nullptr},
      {"history\npair_coeff", "history cohesion bubble\npair_coeff", "cohesion: 'bubble'"},
      {"history\npair_coeff", "history rolling_friction eccentric\npair_coeff", "rolling_friction: 'eccentric'"},
      {"history\npair_coeff", "history surface multicontact\npair_coeff", "surface': 'multicontact'"},
      {"history\npair_coeff", "history surface default cohesion off rolling_friction off\npair_coeff", nullptr},
      {"history\npair_coeff", "history tangential_damping off\npair_coeff", nullptr},
      {"history\npair_coeff", "history limitForce on\npair_coeff", nullptr},
      {"history\npair_coeff", "history limitForce off\npair_coeff", nullptr},
      {"history\npair_coeff", "history computeElasticPotential on\npair_coeff", "computeElasticPotential"},
      {"history\npair_coeff", "history computeDissipatedEnergy on\npair_coeff", "computeDissipatedEnergy"},
      {"history\npair_coeff", "history heating_normal_hertz on\npair_coeff", "heating_normal_hertz"},
      {"history\npair_coeff", "history heating_tangential_history on\npair_coeff", "heating_tangential_history"},
      {"history\npair_coeff", "history absolute_damping on\npair_coeff", "absolute_damping"},
      {"history\npair_coeff", "history viscous on\npair_coeff", "viscous"},
      // wall/gran
      {"zplane 0.0", "zplane 0.0 shear x 1.0", "shear"},
      {"zplane 0.0", "zplane 0.0 temperature 300", "temperature"},
      {"zplane 0.0", "zplane 0.0 contact_area overlap", "contact_area"},
      {"zplane 0.0", "zplane 0.0 store_force yes", "'store_force': 'yes'"},
      {"zplane 0.0", "zplane 0.0 store_force no", nullptr},
      {"zplane 0.0", "zplane 0.0 store_force_contact yes", "'store_force_contact': 'yes'"},
      {"zplane 0.0", "zplane 0.0 store_force_contact_stress yes", "store_force_contact_stress"},
      {"zplane 0.0", "zplane 0.0 track_energy yes", "track_energy"},
      {"zplane 0.0", "zplane 0.0 limitForce on", nullptr},
      {"history primitive", "no_history primitive", nullptr},
      {"history primitive", "history cohesion bubble primitive", "cohesion: 'bubble'"},
      {"history primitive", "history surface superquadric primitive", "'surface': 'superquadric'"},
      {"history primitive", "history surface default cohesion off primitive", nullptr},
      // nve/sphere
      {"nve/cluster", "nve/cluster update dipole", "update"},
      // insert/*
      {"fix integr",
       "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once compress_tags yes "
       "region box particles_in_region 1\nfix integr",
       "compress_tags"},
      {"fix integr",
       "fix ins all insert/pack seed 32452843 distributiontemplate d insert_every once compress_tags no "
       "verbose no random_distribute exact maxattempt 10 vel gaussian 0 0 0 0.1 0.1 0.1 omega constant 1 0 "
       "0 region box particles_in_region 1\nfix integr",
       nullptr},
      // fix balance, which LAMMPS has
      {"fix integr", "fix b all balance/bodies every 10 shift xyz\nfix integr", "shift"},
      {"fix integr", "fix b all balance/bodies every 10 threshold 0.5\nfix integr", "threshold"},
      {"fix integr", "fix b all balance/bodies threshold 1.5\nfix integr", "every"},
      {"fix integr", "fix b all balance/bodies every 10 threshold 1.5\nfix integr", nullptr},
      // dump_modify of dump custom/vtk
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v append yes\nfix integr", "append 'yes'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v format %g\nfix integr", "format '%g'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v region box\nfix integr", "'region'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v thresh z < 0.01\nfix integr", "'thresh'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v label x\nfix integr", "'label'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v element C\nfix integr", "'element'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v binary yes\nfix integr", "'binary'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v sort -2\nfix integr", "sort '-2'"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v nfile 1\nfix integr", "dump_modify nfile"},
      {"fix integr", "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v fileper 1\nfix integr", "dump_modify fileper"},
      {"fix integr",
       "dump v all cluster/vtk 1 v_*.vtp\ndump_modify v append no sort id pad 6 first yes every 2 flush yes buffer no "
       "format none\nfix integr",
       nullptr},
      // check/timestep/gran
      {"fix integr", "fix c all check/timestep/gran 10 0.3 0.3\nfix integr", "check/timestep/gran"},
  };
  for (const Row& row : rows) {
    SCOPED_TRACE(row.to);
    const ProgramResult run = run_script(replaced(head, row.from, row.to) + "run 1\n", "keyword");
    if (row.keyword)
      expect_refused(run, {row.keyword});
    else
      EXPECT_EQ(run.status, 0) << run.output;
  }
}
