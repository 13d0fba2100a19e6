// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fixes that come between two runs keep their values with the atoms that they belong to, whatever rolling model acts.
#include "styles/rolling/rolling_scene.h"

#include <gtest/gtest.h>

#include "fix_property_atom.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

using namespace eccentra::test;

namespace {

constexpr int kSpheres = 6 * 3 * 2;
constexpr double kMark = 1000; ///< of an atom: this and its tag

/// Spheres that fly about in a box that is periodic along x: they are sorted, and change ranks, while they run.
std::string flying_spheres(const RollingScene& scene) {
  std::string text = rolling_scene(scene);
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z)
        text += sphere_at({-0.03 + 0.01 * x, -0.01 + 0.01 * y, 0.02 + 0.02 * z});
  return text + spheres_done();
}

/// A fix with a value for each atom, added now and there in a run already, and what it has in the end.
class Marks {
 public:
  Marks(LiggghtsSession& session, const std::string& name) : session_(session), name_(name) {
    session.command("fix " + name + " all property/atom " + name + " scalar yes no no 0");
    run(session, 0); // gives all atoms the default
    for (int i = 0; i < session.atom().nlocal; ++i)
      values()[i] = kMark + session.atom().tag[i];
  }
  /// Number of atoms with the mark of another one, on all ranks.
  int wrong() const {
    int count = 0;
    for (int i = 0; i < session_.atom().nlocal; ++i)
      count += values()[i] != kMark + session_.atom().tag[i];
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return count;
  }

 private:
  double* values() const {
    return dynamic_cast<LAMMPS_NS::FixPropertyAtom*>(session_.lammps().modify->find_fix_id(name_.c_str()))->vector_atom;
  }
  LiggghtsSession& session_;
  std::string name_;
};

} // namespace

class FixesBetweenRuns : public ::testing::TestWithParam<const char*> {};

// Sorting, migration and growth reach a fix by its place in LIGGGHTS's list: nobody may move it there.
TEST_P(FixesBetweenRuns, KeepTheirValues) {
  RollingScene scene;
  const std::string words = GetParam();
  scene.model = words.substr(0, words.find(' '));
  if (words.find(' ') != std::string::npos)
    scene.arguments = words.substr(words.find(' ') + 1);
  if (scene.model == "eccentric")
    scene.pair_arguments = "shape cube 8";
  scene.mu_r = 0.1;
  scene.timestep = 2e-5;
  scene.boundary = "p f f";
  scene.box = "-0.035 0.035 -0.05 0.05 -0.01 0.1";
  LiggghtsSession session;
  session.script("processors * 1 1\n" + flying_spheres(scene) + "atom_modify sort 20 0.004\n");
  std::mt19937 random(5);
  std::uniform_real_distribution<double> speed(-2, 2);
  for (int tag = 1; tag <= kSpheres; ++tag) {
    const Eigen::Vector3d v(speed(random), 0.2 * speed(random), 0);
    set_motion(session, tag, v, {0, 0, 0});
  }
  run(session, 10);
  const Marks first(session, "first");
  const Marks second(session, "second");
  run(session, 500);
  EXPECT_EQ(first.wrong(), 0);
  EXPECT_EQ(second.wrong(), 0);
  session.command("unfix first");
  run(session, 500);
  EXPECT_EQ(second.wrong(), 0);
}

INSTANTIATE_TEST_SUITE_P(Models, FixesBetweenRuns,
                         ::testing::Values("off", "cdt", "shape form limited", "shape form epsd",
                                           "shape form directional", "eccentric"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });
