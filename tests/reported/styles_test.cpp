// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock styles that read a body as its bounding sphere are refused in one sentence, whenever the body comes; for plain
// spheres they act.
#include "reported/one_body_scene.h"
#include "reported/throwing_session.h"
#include "styles/bodies/stock_styles.h"
#include "support/read_file.h"

#include "compute.h"
#include "dump.h"
#include "fix.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

using namespace eccentra;
using namespace eccentra::test;
using styles::StockKind;
using styles::StockStyle;
using styles::StockVerdict;

namespace {

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

} // namespace

TEST(Reported, heat_gran) {
  expect_refused(run_script(box + material + contacts +
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

TEST(Reported, cluster_in_no_integrator) {
  const std::string still = box + material + contacts + cubes;
  expect_refused(run_script(still + one_body), {"atom 1", "moved by no fix", "nve/cluster"});
  // A group that the body is not in; two ranks say it once.
  write_here("in.script", scene_with_one_body() + "group none id 999\nunfix move\nfix move none nve/cluster\nrun 1\n");
  const ProgramResult two = run_program({"mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2",
                                         program("eccentra-dem"), "-in", "in.script", "-log", "none"});
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
    Session session(box + material + contacts + use_of(*style) + "\n");
    expect_one_sentence(session.refusal(later), *style);
    ++tried;
  }
  EXPECT_GT(tried, 60);
  for (const std::string style : {"gran model hertz tangential history", "soft 1.0"}) {
    Session session(box + material + "pair_style " + style + "\n" +
                    (style[0] == 's' ? "pair_coeff * * 1.0 0.01\n" : "pair_coeff * *\n"));
    EXPECT_EQ(session.refusal(later).find("pair_style: '" + style.substr(0, 4) + "' is not offered with clusters"), 0u);
  }
  Session respa(box + material + contacts + "run_style respa 2 2 pair 1\n");
  expect_one_sentence(respa.refusal(later), *styles::find_stock_style(StockKind::run_style, "respa"));
  Session flat("dimension 2\n" + std::regex_replace(box, std::regex("f f f"), "f f p") + material + contacts);
  // Stock's own sentence comes first, at the template; a run would say "dimension: '2'".
  EXPECT_NE(flat.refusal(later).find("3D"), std::string::npos);
}

TEST(Reported, refused_for_late_bodies) {
  // Bodies that come within a run into a group that something else moves.
  Session session(box + material + contacts + cubes +
                  "group late id 999\nfix turn late move rotate 0 0 0 1 0 0 0.4\nfix move all nve/cluster\nrun 0\n");
  const std::string insertion = std::regex_replace(std::string(one_body), std::regex("fix pa all"), "fix pa late");
  EXPECT_EQ(session.refusal(insertion).find("fix turn: 'move' is not offered with clusters"), 0u);
}

TEST(Reported, groups_of_plain_spheres) {
  // What acts on the members of its group alone may act on plain spheres beside bodies.
  Session session(box + material + contacts + cubes +
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
      box + material +
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
  EXPECT_EQ(contents("spheres.restart").find("Eccentra seal"), std::string::npos) << "not a byte more";
}
