// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock styles and commands that read a body as its bounding sphere: made right, or refused in one sentence.
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/restart_seal.h"
#include "styles/bodies/stock_styles.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/fix_cluster_history.h"
#include "support/run_program.h"

#include <mpi.h>

#include "atom.h"
#include "compute.h"
#include "dump.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace eccentra;
using namespace eccentra::test;
using styles::FixClusterBodies;
using styles::StockKind;
using styles::StockStyle;
using styles::StockVerdict;

// LIGGGHTS ends the process with its errors; here they are exceptions, so that one process tries many.
namespace LAMMPS_NS {
void Error::all(const char*, int, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::one(const char*, int, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::fix_error(const char*, int, Fix*, const char* sentence) {
  throw std::runtime_error(sentence);
}
void Error::fix_error(const char*, int, Fix*, const char*, const char* sentence) {
  throw std::runtime_error(sentence);
}
} // namespace LAMMPS_NS

namespace {

constexpr const char* box = R"(atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block -0.05 0.05 -0.05 0.05 -0.05 0.05 units box
create_box 1 box
)";
constexpr const char* material = R"(neighbor 0.001 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
timestep 1e-5
)";
constexpr const char* contacts = "pair_style gran/cluster model hertz tangential history\npair_coeff * *\n";
constexpr const char* cubes =
    R"(fix c all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 diameter 6.35e-3 orientation given
fix d all particledistribution/discrete 32452843 1 c 1.0
)";
constexpr const char* moved = "fix move all nve/cluster\n";
/// One cube at the origin, after a step.
constexpr const char* one_body = R"(region a block -1e-6 1e-6 -1e-6 1e-6 -1e-6 1e-6 volume_limit 1e-30 units box
fix pa all insert/pack seed 49979687 distributiontemplate d insert_every once overlapcheck no all_in no vel constant 0 0 0 orientation constant 1 0 0 0 region a particles_in_region 1
run 1
unfix pa
)";

void write_here(const std::string& name, const std::string& text) {
  write_file(std::filesystem::current_path() / name, text);
}

std::string scene_with_one_body() {
  return std::string(box) + material + contacts + cubes + moved + one_body;
}

ProgramResult run_script(const std::string& text, std::vector<std::string> more = {}) {
  write_here("in.script", text);
  std::vector<std::string> words = {required_environment("ECCENTRA_BIN") + "/eccentra-dem", "-in", "in.script", "-log",
                                    "none"};
  words.insert(words.end(), more.begin(), more.end());
  ProgramOptions options;
  options.timeout = 240;
  return run_program(words, options);
}

/// The numbers of the last line of thermo output that starts with this step.
std::vector<double> columns(const std::string& output, long step) {
  std::istringstream lines(output);
  std::vector<double> found;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<double> values;
    for (double value = 0; words >> value;)
      values.push_back(value);
    if (words.eof() && values.size() > 1 && values[0] == static_cast<double>(step))
      found = values;
  }
  return found;
}

void expect_refused(const ProgramResult& result, const std::vector<std::string>& says) {
  EXPECT_GT(result.status, 0) << result.output;
  const std::size_t at = result.output.find("ERROR");
  ASSERT_NE(at, std::string::npos) << result.output;
  const std::string sentence = result.output.substr(at, result.output.find('\n', at) - at);
  for (const std::string& word : says)
    EXPECT_NE(sentence.find(word), std::string::npos) << "'" << word << "' in: " << sentence;
}

/// LIGGGHTS inside this process, whose errors are exceptions.
class Session {
 public:
  explicit Session(const std::string& script) {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (!initialised) {
      MPI_Init(nullptr, nullptr);
      std::atexit([] { MPI_Finalize(); });
    }
    static std::vector<std::string> words = {"liggghts", "-log", "none", "-screen", "/dev/null"};
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    // An instance that an exception has left is in no state to be taken down.
    lammps_ = new LAMMPS_NS::LAMMPS(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
    styles::enter(lammps_);
    run(script);
  }

  void run(const std::string& script) {
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line);)
      lammps_->input->one(line.c_str());
  }

  /// The sentence that stops the script, or an empty one.
  std::string refusal(const std::string& script) {
    try {
      run(script);
    } catch (const std::runtime_error& sentence) {
      return sentence.what();
    }
    return {};
  }

  LAMMPS_NS::LAMMPS& lammps() { return *lammps_; }
  LAMMPS_NS::Atom& atom() { return *lammps_->atom; }
  FixClusterBodies& bodies() { return FixClusterBodies::require(lammps_); }

 private:
  LAMMPS_NS::LAMMPS* lammps_;
};

// Styles that do nothing, under the names of refused ones: they can be made before there is any cluster, whatever
// arguments the true ones need.
class IdleFix : public LAMMPS_NS::Fix {
 public:
  IdleFix(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {}
  int setmask() override { return 0; }
};

class IdleCompute : public LAMMPS_NS::Compute {
 public:
  IdleCompute(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) : Compute(lmp, at_ = 0, narg, arg) {}
  void init() override {}

 private:
  static int at_;
};
int IdleCompute::at_ = 0;

class IdleDump : public LAMMPS_NS::Dump {
 public:
  IdleDump(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg) : Dump(lmp, narg, arg) {}
  void init_style() override {}
  void write() override {}
  void write_header(LAMMPS_NS::bigint) override {}
  void pack(int*) override {}
  void write_data(int, double*) override {}
};

/// A session whose refused styles do nothing.
class IdleStyles {
 public:
  IdleStyles() {
    for (const StockStyle& style : styles::stock_styles()) {
      styles::StyleRecord record = {styles::kind_name(style.kind), style.name, ""};
      if (style.kind == StockKind::fix)
        record.fix = &styles::create<IdleFix, LAMMPS_NS::Fix>;
      else if (style.kind == StockKind::compute)
        record.compute = [](LAMMPS_NS::LAMMPS* lmp, int, int narg, char** arg) -> LAMMPS_NS::Compute* {
          return new IdleCompute(lmp, narg, arg);
        };
      else if (style.kind == StockKind::dump)
        record.dump = &styles::create<IdleDump, LAMMPS_NS::Dump>;
      else
        continue;
      if (style.verdict == StockVerdict::refused)
        styles::style_records().push_back(record);
    }
  }
};

std::vector<const StockStyle*> refused_styles() {
  std::vector<const StockStyle*> refused;
  for (const StockStyle& style : styles::stock_styles())
    if (style.verdict == StockVerdict::refused)
      refused.push_back(&style);
  return refused;
}

/// A line of a script that uses the style.
std::string use_of(const StockStyle& style) {
  const std::string name = style.name;
  switch (style.kind) {
  case StockKind::fix:
  case StockKind::compute:
    return std::string(styles::kind_name(style.kind)) + " walked all " + name;
  case StockKind::dump:
    return "dump walked all " + name + " 1 walked.*.txt";
  case StockKind::command:
    return name + " all 1 1 1";
  case StockKind::set:
    return "set group all " + name + " 1 1 1 1";
  case StockKind::thermo:
    return "thermo_style custom step " + name;
  default:
    return std::string(styles::kind_name(style.kind)) + " " + name;
  }
}

void expect_one_sentence(const std::string& sentence, const StockStyle& style) {
  SCOPED_TRACE(std::string(styles::kind_name(style.kind)) + " " + style.name);
  EXPECT_NE(sentence.find("'" + std::string(style.name) + "' is not offered with clusters"), std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find(style.remedy), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find(". "), std::string::npos) << sentence;
}

std::string table_of(StockKind kind, const std::string& title) {
  std::string text = "\n## " + title + "\n| name | with clusters | because it | instead |\n|---|---|---|---|\n";
  const char* const verdicts[] = {"acts", "made right", "refused"};
  for (const StockStyle& style : styles::stock_styles())
    if (style.kind == kind)
      text += "| `" + std::string(style.name) + "` | " + verdicts[static_cast<int>(style.verdict)] +
              (style.reach == styles::StockReach::group ? " (its group)" : "") + " | " + style.reason + " | " +
              style.remedy + " |\n";
  return text;
}

} // namespace

TEST(Reported, heat_gran) {
  expect_refused(run_script(std::string(box) + material + contacts +
                            "fix m5 all property/global thermalConductivity peratomtype 100.\n"
                            "fix m6 all property/global thermalCapacity peratomtype 10.\n"
                            "fix heat all heat/gran initial_temperature 300.\n" +
                            cubes + moved + one_body),
                 {"fix heat", "'heat/gran'", "bounding spheres", "remove it"});
}

TEST(Reported, heat_gran_conduction) {
  expect_refused(run_script(scene_with_one_body() + "fix heat all heat/gran/conduction initial_temperature 300.\n"),
                 {"fix heat", "'heat/gran/conduction'", "remove it"});
}

TEST(Reported, set_diameter) {
  // Even to the value of the template.
  expect_refused(run_script(scene_with_one_body() + "set group all diameter 6.35e-3\n"),
                 {"set", "'diameter'", "particletemplate/cluster"});
  // Plain spheres beside bodies keep the word.
  const ProgramResult spheres =
      run_script(scene_with_one_body() + "create_atoms 1 single 0.02 0.02 0.02 units box\n"
                                         "group spheres id 2\nset group spheres diameter 2e-3\n"
                                         "set atom 2 density 2500\nset atom 2 mass 1e-5\nrun 1\n");
  EXPECT_EQ(spheres.status, 0) << spheres.output;
}

TEST(Reported, set_density) {
  Session session(scene_with_one_body() + "set atom 1 omegax 3 omegay 2 omegaz 1\nrun 0\n");
  const double mass = session.atom().rmass[0], *momentum = session.bodies().angular_momentum(0);
  const std::vector<double> before(momentum, momentum + 3);
  session.run("set group all density 2619\nrun 0");
  EXPECT_DOUBLE_EQ(session.atom().rmass[0], mass);
  session.run("set group all density 5238\nrun 0");
  EXPECT_NEAR(session.atom().rmass[0], 2 * mass, 1e-14 * mass);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(session.atom().omega[0][k], 3 - k, 1e-12) << "the spin stays";
    EXPECT_NEAR(session.bodies().angular_momentum(0)[k], 2 * before[k], 1e-12 * std::abs(before[k]));
  }
  EXPECT_DOUBLE_EQ(session.atom().radius[0], session.bodies().shapes()[0].bounding_radius());
}

TEST(Reported, set_mass) {
  Session session(scene_with_one_body());
  session.run("set type 1 mass 1e-3\nrun 10");
  EXPECT_DOUBLE_EQ(session.atom().rmass[0], 1e-3);
  EXPECT_NEAR(session.atom().density[0] * session.bodies().shapes()[0].volume(), 1e-3, 1e-15);
  session.run("set region box mass 1e-3 density 1000\nrun 0");
  EXPECT_DOUBLE_EQ(session.atom().density[0], 1000) << "the later word counts";
  EXPECT_NEAR(session.atom().rmass[0], 1000 * session.bodies().shapes()[0].volume(), 1e-15);
}

TEST(Reported, set_omega) {
  Session session(scene_with_one_body());
  session.run("set group all omegaz 100\nrun 10000");
  // A cube has three equal moments: it turns by 10 rad about z.
  const double* q = session.bodies().quaternion(0);
  const double angle = 100 * 10000 * 1e-5;
  EXPECT_NEAR(q[0], std::cos(angle / 2), 1e-9);
  EXPECT_NEAR(q[3], std::sin(angle / 2), 1e-9);
  session.run("set group all omegaz -100\nrun 10000");
  EXPECT_NEAR(std::abs(session.bodies().quaternion(0)[0]), 1, 1e-8) << "back again";
}

TEST(Reported, displace_atoms_rotate) {
  Session session(scene_with_one_body() + "set group all omegax 5 omegay 7\nrun 0\n");
  session.run("displace_atoms all rotate 0.01 0 0 0 0 2 90 units box");
  const double* x = session.atom().x[0];
  EXPECT_NEAR((Eigen::Vector3d(x[0], x[1], x[2]) - Eigen::Vector3d(0.01, -0.01, 0)).norm(), 0, 2e-6);
  const auto expect_turned = [&] {
    const double* q = session.bodies().quaternion(0);
    const double half = std::sqrt(0.5);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(q[k], k == 0 || k == 3 ? half : 0, 1e-9);
    EXPECT_NEAR(session.atom().omega[0][0], 5, 1e-9);
    EXPECT_NEAR(session.atom().omega[0][1], 7, 1e-9);
  };
  expect_turned();
  session.run("run 0");
  expect_turned();
}

namespace {

/// A bed of disks that has come to rest in a box of walls.
std::string bed(const std::string& words_of_the_box) {
  return "atom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\nunits "
         "si\n" +
         words_of_the_box + "create_box 1 box\n" + R"(neighbor 0.001 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran/cluster model hertz tangential history
pair_coeff * *
timestep 2e-5
fix x0 all wall/gran/cluster model hertz tangential history primitive type 1 xplane 0.0
fix x1 all wall/gran/cluster model hertz tangential history primitive type 1 xplane 0.02
fix y0 all wall/gran/cluster model hertz tangential history primitive type 1 yplane 0.0
fix y1 all wall/gran/cluster model hertz tangential history primitive type 1 yplane 0.02
fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0
fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2500 shape disk 7 diameter 6e-3 orientation random
fix d all particledistribution/discrete 15485867 1 t 1.0
)";
}

constexpr const char* settle = R"(create_atoms 1 single 0.01 0.01 0.055 units box
set group all diameter 3e-3 density 2500
group lonely id 1
group bed initialize
region fill block 0 0.02 0 0.02 0 0.05 units box
fix ins bed insert/pack seed 32452843 distributiontemplate d insert_every once orientation random all_in yes region fill particles_in_region 12
fix g bed gravity 9.81 vector 0 0 -1
fix integr bed nve/cluster
run 12000
unfix ins
thermo_style custom step atoms ke f_cluster_history f_floor[3]
thermo_modify format float %.15g
thermo 1
)";

} // namespace

TEST(Reported, displace_atoms_rotate_bed) {
  // Turned by 90 degrees about the axis of the square box, the bed is the same bed with x and y exchanged: it stays at
  // rest on its floor, none is lost, and as many contacts are there. (Tangential springs at walls are not turned.)
  Session session(bed("region box block -0.001 0.021 -0.001 0.021 -0.002 0.06 units box\n") + settle);
  auto& history = *styles::FixClusterHistory::find(&session.lammps());
  session.run("run 0");
  const double before = history.compute_scalar();
  ASSERT_GT(before, 5);
  session.run("displace_atoms all rotate 0.01 0.01 0 0 0 1 90 units box\nrun 0");
  EXPECT_EQ(history.compute_scalar(), before);
  // The same tangential springs, turned: x -> y, y -> -x.
  session.run("run 2000");
  EXPECT_EQ(session.atom().natoms, 13);
  double fastest = 0;
  for (int i = 0; i < session.atom().nlocal; ++i)
    fastest = std::max(fastest, Eigen::Map<Eigen::Vector3d>(session.atom().v[i]).norm());
  EXPECT_LT(fastest, 0.05) << "without turning bodies it is flung apart at some m/s";
}

TEST(Reported, clear) {
  const ProgramResult result = run_script(std::string("print first\nclear\n") + scene_with_one_body());
  EXPECT_EQ(result.status, 0) << result.output;
}

TEST(Reported, clear_in_loop) {
  std::string pass =
      "variable pass loop 3\nlabel again\n" + scene_with_one_body() +
      "set group all omegax 30 omegay 20\nvelocity all set 0.1 0 0\nfix wall all wall/gran/cluster model "
      "hertz tangential history primitive type 1 xplane 0.006\nthermo_style custom step ke f_move f_wall[1]\n"
      "thermo_modify format float %.17g\nthermo 100\nrun 3000\n"
      "clear\nnext pass\njump in.script again\n";
  const ProgramResult result = run_script(pass);
  ASSERT_EQ(result.status, 0) << result.output;
  std::vector<std::string> lines;
  std::istringstream stream(result.output);
  for (std::string line; std::getline(stream, line);)
    if (line.find(" 3001 ") != std::string::npos)
      lines.push_back(line);
  ASSERT_EQ(lines.size(), 3u) << result.output;
  EXPECT_EQ(lines[0], lines[1]);
  EXPECT_EQ(lines[0], lines[2]);
}

TEST(Reported, delete_atoms) {
  const std::string start = bed("region box block -0.001 0.021 -0.001 0.021 -0.002 0.06 units box\n") + settle;
  for (const std::string ranks : {"1", "2"}) {
    std::vector<double> of_way[2];
    for (const bool compress : {false, true}) {
      write_here("in.script", start + "delete_atoms group lonely compress " + (compress ? "yes" : "no") + "\nrun 8\n");
      const ProgramResult result =
          run_program({"mpirun", "--oversubscribe", "-np", ranks,
                       required_environment("ECCENTRA_BIN") + "/eccentra-dem", "-in", "in.script", "-log", "none"});
      ASSERT_EQ(result.status, 0) << result.output;
      of_way[compress] = columns(result.output, 12008);
      const std::vector<double> first = columns(result.output, 12000);
      ASSERT_EQ(first.size(), 5u);
      ASSERT_EQ(of_way[compress].size(), 5u);
      EXPECT_EQ(of_way[compress][1], 12);
      EXPECT_NEAR(of_way[compress][4], first[4], 2e-3 * std::abs(first[4])) << "no floor force is lost";
    }
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(of_way[1][k], of_way[0][k], 1e-9 * std::abs(of_way[0][k])) << "column " << k << ", ranks " << ranks;
  }
}

TEST(Reported, delete_atoms_in_a_bed) {
  // Bodies out of the middle: ids without gaps and in their order, and contacts with those that stay.
  Session session(bed("region box block -0.001 0.021 -0.001 0.021 -0.002 0.06 units box\n") + settle);
  auto& history = *styles::FixClusterHistory::find(&session.lammps());
  session.run("group some id 3 7\n");
  std::map<std::pair<int, int>, std::size_t> kept;
  const auto renumbered = [](int tag) { return tag - (tag > 3) - (tag > 7); };
  for (int i = 0; i < session.atom().nlocal; ++i)
    for (const styles::Touch& touch : history.touches(i)) {
      const int tag = session.atom().tag[i];
      if (tag != 3 && tag != 7 && touch.partner != 3 && touch.partner != 7)
        ++kept[{renumbered(tag), renumbered(touch.partner)}];
    }
  ASSERT_GT(kept.size(), 4u);
  session.run("delete_atoms group some");
  std::map<std::pair<int, int>, std::size_t> found;
  std::set<int> tags;
  for (int i = 0; i < session.atom().nlocal; ++i) {
    tags.insert(session.atom().tag[i]);
    EXPECT_EQ(session.atom().map(session.atom().tag[i]), i);
    for (const styles::Touch& touch : history.touches(i))
      ++found[{session.atom().tag[i], touch.partner}];
  }
  EXPECT_EQ(found, kept);
  EXPECT_EQ(tags.size(), 11u);
  EXPECT_EQ(*tags.rbegin(), 11);
  session.run("run 10");
}

TEST(Reported, cluster_in_no_integrator) {
  const std::string still = std::string(box) + material + contacts + cubes;
  expect_refused(run_script(still + one_body), {"atom 1", "moved by no fix", "nve/cluster"});
  // A group that the body is not in; two ranks say it once.
  write_here("in.script", scene_with_one_body() + "group none id 999\nunfix move\nfix move none nve/cluster\nrun 1\n");
  const ProgramResult two =
      run_program({"mpirun", "--oversubscribe", "-np", "2", required_environment("ECCENTRA_BIN") + "/eccentra-dem",
                   "-in", "in.script", "-log", "none"});
  expect_refused(two, {"atom 1", "moved by no fix"});
  // Held by fix freeze, or without a step, it is as it was meant.
  Session session(scene_with_one_body() + "unfix move\nrun 0\nfix hold all freeze\nrun 1\n");
  EXPECT_EQ(session.refusal("unfix hold\nrun 1").find("atom 1"), 0u);
}

TEST(Reported, cluster_in_two_integrators) {
  expect_refused(run_script(scene_with_one_body() + "fix move2 all nve/cluster\nrun 1\n"),
                 {"atom 1", "moved twice", "fix move ", "fix move2"});
}

TEST(Reported, move_rotate) {
  expect_refused(run_script(scene_with_one_body() + "unfix move\nfix turn all move rotate 0 0 0 1 0 0 0.4\nrun 1\n"),
                 {"fix turn", "'move'", "nve/cluster"});
}

TEST(Reported, rigid_beside_nve_cluster) {
  expect_refused(run_script(scene_with_one_body() + "fix rg all rigid single\nrun 1\n"),
                 {"fix rg", "'rigid'", "shape"});
}

namespace {

std::string read_all(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

const std::string go_on =
    "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\nunits si\n"
    "read_restart now.restart\n" +
    std::string(material) + contacts + moved + "run 10\n";

} // namespace

TEST(Reported, damaged_restart_file) {
  ASSERT_EQ(run_script(scene_with_one_body() + "write_restart now.restart\nwrite_restart part%.restart\n").status, 0);
  const std::string whole = read_all("now.restart");
  ASSERT_EQ(run_script(go_on).status, 0);
  // Any byte, and any end.
  for (std::size_t n = 0; n < 20; ++n) {
    const std::size_t at = (whole.size() - 1) * n / 19;
    std::string damaged = whole;
    damaged[at] ^= 0x41;
    write_here("now.restart", damaged);
    std::string sentence;
    sentence = styles::seal_problem("now.restart");
    EXPECT_FALSE(sentence.empty()) << "byte " << at << " of " << whole.size();
  }
  for (const std::size_t end : {whole.size() - 1, whole.size() - 32, whole.size() - 100}) {
    write_here("now.restart", whole.substr(0, end));
    EXPECT_EQ(styles::seal_problem("now.restart"), "is cut short");
  }
  expect_refused(run_script(go_on), {"read_restart", "'now.restart'", "cut short", "earlier"});
  std::string part = read_all("part0.restart");
  part[part.size() / 2] ^= 1;
  write_here("part0.restart", part);
  const std::string go_on_parts = std::regex_replace(go_on, std::regex("now"), "part%");
  expect_refused(run_script(go_on_parts), {"read_restart", "'part0.restart'", "damaged"});

  // What a seal cannot show, as it was made for it: each four bytes of the shapes' record, with values that are no
  // counts.
  const std::size_t name = whole.find("cube 8");
  ASSERT_NE(name, std::string::npos);
  int refused = 0;
  for (const std::size_t at : {name - 4, name - 8, name - 12, name + 6}) {
    for (const unsigned value : {0x7fffffffu, 0xffffffffu, 0x00010000u}) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + at, &value, sizeof value);
      write_here("now.restart", damaged);
      ASSERT_TRUE(styles::seal_restart_file("now.restart"));
      const ProgramResult result = run_script(go_on);
      EXPECT_EQ(result.signal, 0);
      expect_refused(result, {"clusters", "damaged", "earlier"});
      ++refused;
    }
  }
  EXPECT_EQ(refused, 12);
}

TEST(Reported, restart_without_clusters) {
  ASSERT_EQ(run_script(scene_with_one_body() + "write_restart now.restart\n").status, 0);
  const std::string stock = std::regex_replace(go_on, std::regex("gran/cluster"), "gran");
  expect_refused(run_script(std::regex_replace(stock, std::regex("nve/cluster"), "nve/sphere")),
                 {"read_restart", "clusters", "pair_style gran/cluster"});
}

TEST(Reported, changed_behind_our_back) {
  // Whatever changes radius, mass or ids where no command can be caught.
  Session session(scene_with_one_body());
  session.atom().radius[0] *= 0.9;
  std::string sentence = session.refusal("run 1");
  EXPECT_EQ(sentence.find("atom 1 (cluster 'cube 8'): radius"), 0u) << sentence;
  Session heavy(scene_with_one_body());
  heavy.atom().rmass[0] *= 1.1;
  sentence = heavy.refusal("run 1");
  EXPECT_EQ(sentence.find("atom 1 (cluster 'cube 8'): mass"), 0u) << sentence;
  Session exchanged(bed("region box block -0.001 0.021 -0.001 0.021 -0.002 0.06 units box\n") + settle);
  exchanged.run("run 0");
  int* tag = exchanged.atom().tag;
  for (int i = 0; i < exchanged.atom().nlocal; ++i)
    tag[i] = tag[i] == 1 ? 1 : 2 + (tag[i] + 3) % 12; // the plain sphere keeps its id
  sentence = exchanged.refusal("run 1");
  EXPECT_NE(sentence.find("is not kept by that atom"), std::string::npos) << sentence;
}

TEST(Reported, stock_styles_are_all_in_the_table) {
  Session session("");
  std::set<std::string> ours;
  for (const styles::StyleRecord& record : styles::style_records())
    ours.insert(record.kind + " " + record.name);
  std::map<StockKind, std::set<std::string>> live;
  const auto add = [&](StockKind kind, const std::string& name) {
    // Some of ours stand in for stock's, under their names.
    if (!ours.count(std::string(styles::kind_name(kind)) + " " + name) || styles::find_stock_style(kind, name))
      live[kind].insert(name);
  };
  for (const std::string& name : styles::registered_fixes(&session.lammps()))
    add(StockKind::fix, name);
  for (const std::string& name : styles::registered_computes(&session.lammps()))
    add(StockKind::compute, name);
  for (const auto& entry : *session.lammps().force->pair_map)
    add(StockKind::pair_style, entry.first);
  // The rest are no maps; LIGGGHTS itself lists them.
  const std::string listed = run_program({"liggghts", "-h"}).output;
  const std::pair<const char*, StockKind> sections[] = {{"Atom styles:", StockKind::atom_style},
                                                        {"Integrate styles:", StockKind::run_style},
                                                        {"Region styles:", StockKind::region},
                                                        {"Dump styles:", StockKind::dump}};
  for (const auto& [title, kind] : sections) {
    const std::size_t at = listed.find(title);
    ASSERT_NE(at, std::string::npos) << title << listed;
    std::istringstream words(
        listed.substr(at + std::string(title).size(), listed.find("* ", at) - at - std::string(title).size()));
    for (std::string name; words >> name;)
      add(kind, name);
  }
  for (const auto& [kind, names] : live) {
    EXPECT_GT(names.size(), 1u) << styles::kind_name(kind);
    for (const std::string& name : names)
      EXPECT_NE(styles::find_stock_style(kind, name), nullptr) << styles::kind_name(kind) << " " << name;
    for (const StockStyle& style : styles::stock_styles())
      if (style.kind == kind) {
        EXPECT_TRUE(names.count(style.name)) << "LIGGGHTS has no " << styles::kind_name(kind) << " " << style.name;
      }
  }
}

TEST(Reported, commands_are_all_in_the_table) {
  Session session("");
  std::set<std::string> live;
  for (const std::string& name : styles::registered_commands(&session.lammps()))
    live.insert(name);
  for (const styles::StyleRecord& record : styles::style_records())
    if (record.command)
      live.erase(record.name);
  // Those that are no entries of the map are members of Input, under their names or nearly so.
  const std::map<std::string, std::string> renamed = {{"ifthenelse", "if"},
                                                      {"next_command", "next"},
                                                      {"variable_command", "variable"},
                                                      {"group_command", "group"},
                                                      {"neighbor_command", "neighbor"}};
  const std::string header = read_all("/usr/include/liggghts/input.h");
  const std::regex member(R"(\n *void ([a-z_]+)\(\);)");
  const std::size_t first = header.find("void clear();");
  ASSERT_NE(first, std::string::npos);
  const std::string members = "\n" + header.substr(first);
  for (std::sregex_iterator found(members.begin(), members.end(), member), end; found != end; ++found) {
    const std::string name = (*found)[1];
    live.insert(renamed.count(name) ? renamed.at(name) : name);
  }
  EXPECT_GT(live.size(), 80u);
  for (const std::string& name : live)
    EXPECT_NE(styles::find_stock_style(StockKind::command, name), nullptr) << name;
  for (const StockStyle& style : styles::stock_styles())
    if (style.kind == StockKind::command) {
      EXPECT_TRUE(live.count(style.name)) << "LIGGGHTS has no command " << style.name;
    }
}

TEST(Reported, refused_with_bodies_there) {
  Session session(scene_with_one_body());
  int tried = 0;
  for (const StockStyle* style : refused_styles()) {
    if (style->kind == StockKind::atom_style)
      continue; // chosen before the box: below
    expect_one_sentence(session.refusal(use_of(*style)), *style);
    ++tried;
  }
  EXPECT_GT(tried, 100);
  session.run("run 1"); // nothing of it is left behind
}

TEST(Reported, refused_before_a_run) {
  const IdleStyles idle;
  const std::string later = std::string(cubes) + moved + "run 0\n"; // no body yet: they will come into the group `all`
  int tried = 0;
  for (const StockStyle* style : refused_styles()) {
    if (style->kind != StockKind::fix && style->kind != StockKind::compute && style->kind != StockKind::dump)
      continue;
    Session session(std::string(box) + material + contacts + use_of(*style) + "\n");
    expect_one_sentence(session.refusal(later), *style);
    ++tried;
  }
  EXPECT_GT(tried, 60);
  for (const std::string style : {"gran model hertz tangential history", "soft 1.0"}) {
    Session session(std::string(box) + material + "pair_style " + style + "\n" +
                    (style[0] == 's' ? "pair_coeff * * 1.0 0.01\n" : "pair_coeff * *\n"));
    EXPECT_EQ(session.refusal(later).find("pair_style: '" + style.substr(0, 4) + "' is not offered with clusters"), 0u);
  }
  Session respa(std::string(box) + material + contacts + "run_style respa 2 2 pair 1\n");
  expect_one_sentence(respa.refusal(later), *styles::find_stock_style(StockKind::run_style, "respa"));
  Session flat("dimension 2\n" + std::regex_replace(std::string(box), std::regex("f f f"), "f f p") + material +
               contacts);
  // Stock's own sentence comes first, at the template; a run would say "dimension: '2'".
  EXPECT_NE(flat.refusal(later).find("3D"), std::string::npos);
}

TEST(Reported, refused_for_late_bodies) {
  // Bodies that come within a run into a group that something else moves.
  Session session(std::string(box) + material + contacts + cubes +
                  "group late id 999\nfix turn late move rotate 0 0 0 1 0 0 0.4\nfix move all nve/cluster\nrun 0\n");
  const std::string insertion = std::regex_replace(std::string(one_body), std::regex("fix pa all"), "fix pa late");
  EXPECT_EQ(session.refusal(insertion).find("fix turn: 'move' is not offered with clusters"), 0u);
}

TEST(Reported, groups_of_plain_spheres) {
  // What acts on the members of its group alone may act on plain spheres beside bodies.
  Session session(std::string(box) + material + contacts + cubes +
                  "create_atoms 1 single 0.02 0.02 0.02 units box\nset atom 1 diameter 2e-3 density 2500\n"
                  "group spheres id 1\ngroup cubes initialize\n"
                  "fix turn spheres move rotate 0 0 0 1 0 0 0.4\nfix move cubes nve/cluster\n" +
                  std::regex_replace(std::string(one_body), std::regex("fix pa all"), "fix pa cubes") +
                  "unfix turn\nfix slow spheres nve/limit absolute 1e-5\ncompute spin spheres erotate/sphere\nrun 1\n");
  EXPECT_EQ(session.atom().natoms, 2);
}

TEST(Reported, nothing_refused_without_clusters) {
  // The same library, the same arguments, no cluster.
  const ProgramResult result = run_script(
      std::string(box) + material +
      "pair_style gran model hertz tangential history\npair_coeff * *\n"
      "create_atoms 1 single 0 0 0 units box\ncreate_atoms 1 single 0.01 0 0 units box\n"
      "create_atoms 1 single 0.02 0 0 units box\ngroup first id 1\n"
      "set group all diameter 5e-3 density 2500\nfix move all nve/sphere\ncompute spin all erotate/sphere\n"
      "fix wall all wall/gran model hertz tangential history primitive type 1 xplane -0.04\n"
      "fix check all check/timestep/gran 10 0.3 0.3\nfix field all ave/euler nevery 1 cell_size_relative 3 "
      "parallel no\n"
      "compute touch all contact/atom\nthermo_style custom step ke c_spin erotate\nrun 1\nset group all mass 2e-4\n"
      "displace_atoms all rotate 0 0 0 0 0 1 90 units box\ndelete_atoms group first\nunfix move\n"
      "fix move all nve/limit absolute 1e-5\nrun 1\nwrite_data spheres.data\nwrite_restart spheres.restart\n");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(read_all("spheres.restart").find("Eccentra seal"), std::string::npos) << "not a byte more";
}

TEST(Reported, page_of_stock_styles) {
  const std::string page = required_environment("ECCENTRA_SOURCE") + "/docs/clusters-and-stock-styles.md";
  const std::string text = read_all(page),
                    mark = "<!-- The tables below are those of the library; a test compares them. -->\n";
  std::string tables;
  const std::pair<StockKind, const char*> titles[] = {{StockKind::fix, "Fixes"},
                                                      {StockKind::compute, "Computes"},
                                                      {StockKind::pair_style, "Pair styles"},
                                                      {StockKind::dump, "Dumps"},
                                                      {StockKind::command, "Commands"},
                                                      {StockKind::set, "Words of set"},
                                                      {StockKind::thermo, "Thermo columns"},
                                                      {StockKind::region, "Regions"},
                                                      {StockKind::atom_style, "Atom styles"},
                                                      {StockKind::run_style, "Run styles"},
                                                      {StockKind::min_style, "Minimiser styles"}};
  for (const auto& [kind, title] : titles)
    tables += table_of(kind, title);
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos) << page;
  if (std::getenv("ECCENTRA_WRITE_PAGE"))
    write_file(page, text.substr(0, at + mark.size()) + tables);
  EXPECT_EQ(read_all(page).substr(at + mark.size()), tables)
      << "write it anew with ECCENTRA_WRITE_PAGE=1 in the environment of this test";
}
