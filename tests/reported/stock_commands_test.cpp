// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock commands that change atoms (set, displace_atoms, delete_atoms, clear) treat a body as a body.
#include "reported/one_body_scene.h"
#include "reported/throwing_session.h"
#include "styles/pairs/fix_cluster_history.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace eccentra;
using namespace eccentra::test;

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

TEST(Reported, displace_atoms_rotate_bed) {
  // Turned by 90 degrees about the axis of the square box, the bed is the same bed with x and y exchanged: it stays at
  // rest on its floor, none is lost, and as many contacts are there. (Tangential springs at walls are not turned.)
  Session session(bed() + settle);
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
  const std::string start = bed() + settle;
  for (const std::string ranks : {"1", "2"}) {
    std::vector<double> of_way[2];
    for (const bool compress : {false, true}) {
      write_here("in.script", start + "delete_atoms group lonely compress " + (compress ? "yes" : "no") + "\nrun 8\n");
      const ProgramResult result = run_program({"mpirun", "--oversubscribe", "--bind-to", "none", "-np", ranks,
                                                program("eccentra-dem"), "-in", "in.script", "-log", "none"});
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
  Session session(bed() + settle);
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
