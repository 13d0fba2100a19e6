// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Cohesion, liquid bridges and dampers of every model for bodies of several sub-spheres: N contacts at once do to a
// body of N spheres what one does to a sphere, and bridges to bodies that turn add up.
#include "base/linear_algebra.h"
#include "styles/pairs/all_materials.h"
#include "support/row_properties.h"

#include "fix_property_atom.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <sstream>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double kSpacing = 7e-3, kDensity = 2619;

/// `count` spheres beside each other along y, and between them smaller ones that make them one body and that nothing
/// reaches: mass and moments are those of the former.
shape::ClusterShape row(int count, double radius) {
  std::vector<shape::Sphere> spheres;
  for (int k = 0; k < count; ++k) {
    const double y = (k - 0.5 * (count - 1)) * kSpacing;
    if (k > 0)
      spheres.push_back({Eigen::Vector3d(0, y - 0.5 * kSpacing, 0), 0.5 * kSpacing - radius + 1e-4});
    spheres.push_back({Eigen::Vector3d(0, y, 0), radius});
  }
  return {"row " + std::to_string(count), spheres, row_properties(count, radius, kSpacing, 1)};
}

void add_row(LiggghtsSession& session, int count, double radius, Start start) {
  const shape::ClusterShape shape = row(count, radius);
  if (count > 1)
    start.orientation = eccentra::base::rotation_between(shape.spheres()[1].centre - shape.spheres()[0].centre,
                                                         Eigen::Vector3d::UnitY());
  add_body(session, shape, start);
}

constexpr double kRadius[2] = {3e-3, 2.4e-3};

/// What is left of the meeting of two bodies, or of one body and a wall.
struct After {
  Eigen::Vector3d x[2], v[2];
  double liquid[2];
};

double* liquid_of(LiggghtsSession& session) {
  for (int f = 0; f < session.lammps().modify->nfix; ++f)
    if (!std::strcmp(session.lammps().modify->fix[f]->id, "surfaceLiquidContent"))
      return static_cast<LAMMPS_NS::FixPropertyAtom*>(session.lammps().modify->fix[f])->vector_atom;
  return nullptr;
}

After result(LiggghtsSession& session, int bodies) {
  After after{};
  for (int k = 0; k < bodies; ++k) {
    const int i = session.local(k + 1);
    after.x[k] = Eigen::Map<Eigen::Vector3d>(session.atom().x[i]);
    after.v[k] = Eigen::Map<Eigen::Vector3d>(session.atom().v[i]);
    after.liquid[k] = liquid_of(session) ? liquid_of(session)[i] : 0;
  }
  return after;
}

enum class Partner { body, wall };

/// Models by their names, and keywords of theirs: walls have these after the wall.
struct Models {
  std::string names, keywords = "";
  std::map<std::string, std::string> materials = {};
};

std::string scaled(double value, double factor) {
  std::ostringstream text;
  text.precision(17);
  text << value * factor;
  return text.str();
}

/// Materials with which each of the contacts of a body of `count` times a sphere's mass has the stiffness and the
/// damping ratio of that sphere's only contact. hooke takes its stiffness from (mass v^2)^(1/5), and the models
/// /stiffness take the damping per mass or, with absolute_damping, as it is.
std::map<std::string, std::string> as_of_one(const Models& models, int count) {
  std::map<std::string, std::string> given = models.materials;
  const double root = std::sqrt(std::max(1, count));
  given["characteristicVelocity"] = scaled(0.5, 1 / root);
  given["gamman"] = scaled(500, 1 / root);
  given["gammat"] = scaled(200, 1 / root);
  given["gamman_abs"] = scaled(0.05, root);
  given["gammat_abs"] = scaled(0.02, root);
  return given;
}

/// Two rows of `count` spheres run into each other, or one into a wall, and part again. 0: stock's spheres.
After meet(const Models& models, int count, Partner partner, double restitution, double speed = 0.2) {
  LiggghtsSession session;
  Material material;
  material.restitution = restitution;
  open_box(session, material);
  give_materials(session, as_of_one(models, count));
  const std::string line = (count ? "gran/cluster " : "gran ") + models.names;
  session.script("pair_style " + line + " " + models.keywords + "\npair_coeff * *\n");
  if (partner == Partner::wall)
    session.script("fix side all wall/" + line + " primitive type 1 xplane 0.0 " + models.keywords + "\n");
  session.script("fix integrate all " + std::string(count ? "nve/cluster" : "nve/sphere") + "\n");
  const int bodies = partner == Partner::body ? 2 : 1;
  for (int k = 0; k < bodies; ++k) {
    Start start;
    const double side = k == 0 ? -1 : 1;
    start.position.x() = side * (kRadius[k] + 1e-5);
    start.velocity.x() = -side * speed;
    if (count)
      add_row(session, count, kRadius[k], start);
    else
      add_sphere(session, start, kRadius[k], kDensity);
  }
  session.script("timestep 2e-6\nrun 6000\n");
  return result(session, bodies);
}

void expect_same(const After& ours, const After& one, int bodies, const std::string& what) {
  for (int k = 0; k < bodies; ++k) {
    EXPECT_LT((ours.x[k] - one.x[k]).norm(), 1e-8 * 3e-3) << what << ", body " << k;
    EXPECT_LT((ours.v[k] - one.v[k]).norm(), 1e-8 * 0.2) << what << ", body " << k;
    EXPECT_NEAR(ours.liquid[k], one.liquid[k], 1e-9) << what << ", body " << k;
  }
}

std::vector<Models> cohesive_models() {
  std::vector<Models> all;
  for (const std::string& normal : known("model"))
    if (normal != "off")
      all.push_back({"model " + normal});
  all.push_back({"model hooke/stiffness", "absolute_damping on"});
  // Without tension: what a contact would pull it lets go.
  for (const char* normal : {"hertz", "hertz/stiffness", "hooke", "hooke/stiffness"})
    all.push_back({std::string("model ") + normal, "limitForce on"});
  const std::map<std::string, std::string> dry = {
      {"pullOffForce", "0"}, {"surfaceEnergy", "0"}, {"coefficientAdhesionStiffness", "0"}};
  for (const char* normal : {"edinburgh", "edinburgh/stiffness", "luding"}) // do so by default where nothing adheres
    all.push_back({std::string("model ") + normal, "", dry});
  all.push_back({"model edinburgh", "limitForce off", dry});
  for (const std::string& cohesion : known("cohesion"))
    if (cohesion != "off")
      all.push_back({"model hertz cohesion " + cohesion});
  return all;
}

std::string name_of(const Models& models, int count) {
  return models.names + " " + models.keywords + (models.materials.empty() ? "" : " dry") + ", " + std::to_string(count);
}

} // namespace

// Stock's single spheres, and rows of one, two and four: the same motion with `contacts shared`, since the dampers of N
// contacts suit the N-fold mass. Damping by viscous liquid and cohesion add up as the masses do.
TEST(Cohesion, RowsOfSpheresMeetAsTwoSpheresDo) {
  for (const Models& models : cohesive_models()) {
    const After stock = meet(models, 0, Partner::body, 0.5);
    for (const int count : {1, 2, 4})
      expect_same(meet(models, count, Partner::body, 0.5), stock, 2, name_of(models, count));
  }
}

TEST(Cohesion, RowsOfSpheresMeetAWallAsOneSphereDoes) {
  for (const Models& models : cohesive_models()) {
    // Stock's easo reads the velocity of a wall from in front of the array of velocities.
    const bool readable = models.names.find("easo") == std::string::npos;
    const After one = meet(models, readable ? 0 : 1, Partner::wall, 0.5);
    for (const int count : {1, 2, 4})
      expect_same(meet(models, count, Partner::wall, 0.5), one, 1, name_of(models, count));
  }
}

// A bridge pulls once the sphere has left the wall.
TEST(Cohesion, BridgesHoldBackWhatLeavesAWall) {
  for (const char* cohesion : {"easo/capillary/viscous", "washino/capillary/viscous"}) {
    const double dry = meet({"model hertz"}, 2, Partner::wall, 0.9, 0.05).v[0].x();
    const double wet = meet({std::string("model hertz cohesion ") + cohesion}, 2, Partner::wall, 0.9, 0.05).v[0].x();
    EXPECT_NEAR(dry, -0.045, 1e-3);
    EXPECT_GT(wet, dry + 2e-3) << cohesion; // towards the wall is +x
  }
}

namespace {

struct Load {
  Eigen::Vector3d force, torque;
};

/// Force and torque on the first of two bodies, after they have touched and then been put a gap apart. 0: one of
/// stock's spheres at `arm` from the centre of its body.
Load bridge(const std::string& cohesion, int count, const Eigen::Vector3d& arm, const Eigen::Vector3d (&v)[2],
            const Eigen::Vector3d (&omega)[2]) {
  LiggghtsSession session;
  open_box(session, {});
  give_materials(session);
  session.script("pair_style " + std::string(count ? "gran/cluster" : "gran") + " model hertz cohesion " + cohesion +
                 "\npair_coeff * *\nfix integrate all " + (count ? "nve/cluster" : "nve/sphere") + "\ntimestep 1e-9\n");
  const auto place = [&](int k, double distance) -> Eigen::Vector3d {
    return arm + Eigen::Vector3d((k == 0 ? -1 : 1) * (kRadius[k] + 0.5 * distance), 0, 0);
  };
  for (int k = 0; k < 2; ++k) {
    Start start;
    start.position = place(k, -1e-6);
    if (count)
      add_row(session, count, kRadius[k], start);
    else
      add_sphere(session, start, kRadius[k], kDensity);
  }
  session.script("run 2\n");
  constexpr double gap = 5e-5;
  for (int k = 0; k < 2; ++k) {
    const int i = session.local(k + 1);
    const Eigen::Vector3d x = place(k, gap), speed = v[k] + omega[k].cross(arm);
    for (int d = 0; d < 3; ++d) {
      session.atom().x[i][d] = x[d];
      session.atom().v[i][d] = speed[d];
      session.atom().omega[i][d] = omega[k][d];
    }
  }
  session.script("run 1\n");
  const int i = session.local(1);
  return {Eigen::Map<Eigen::Vector3d>(session.atom().f[i]), Eigen::Map<Eigen::Vector3d>(session.atom().torque[i])};
}

} // namespace

TEST(Cohesion, BridgesOfBodiesThatTurnAddUp) {
  const Eigen::Vector3d v[2] = {{0.02, 0.01, -0.03}, {-0.01, 0.02, 0.01}}, omega[2] = {{3, -2, 4}, {-1, 5, 2}};
  for (const char* cohesion : {"washino/capillary/viscous", "easo/capillary/viscous"}) {
    Load sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    for (const double side : {-0.5, 0.5}) {
      const Eigen::Vector3d arm(0, side * kSpacing, 0);
      const Load one = bridge(cohesion, 0, arm, v, omega);
      sum.force += one.force;
      sum.torque += one.torque + arm.cross(one.force);
    }
    const Load both = bridge(cohesion, 2, Eigen::Vector3d::Zero(), v, omega);
    EXPECT_GT(sum.force.norm(), 1e-5) << cohesion;
    // The bodies move by 1e-11 m within the step.
    EXPECT_LT((both.force - sum.force).norm(), 1e-6 * sum.force.norm()) << cohesion;
    EXPECT_LT((both.torque - sum.torque).norm(), 1e-6 * sum.torque.norm()) << cohesion;
  }
}
