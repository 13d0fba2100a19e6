// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters in a prescribed flow: volume and sphericity of the union, drag by orientation, torque on the body.
#include "base/linear_algebra.h"
#include "closures/projected_area.h"
#include "styles/bodies/fix_cluster_bodies.h"

#include "fluid_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra::test;
using eccentra::closures::projected_area;
using eccentra::closures::ProjectedAreaTable;
using eccentra::shape::Sphere;
using eccentra::styles::FixClusterBodies;
using eccentra::styles::FixFluidForce;
using Eigen::Vector3d;

namespace {

constexpr double kPiTest = 3.14159265358979323846;

TEST(ProjectedArea, OfOneAndOfTwoSpheres) {
  const std::vector<Sphere> one = {{Vector3d(0, 0, 0), 2.0}};
  EXPECT_NEAR(projected_area(one, Vector3d(1, 2, 3)), 4 * kPiTest, 1e-3 * 4 * kPiTest);
  const std::vector<Sphere> two = {{Vector3d(0, 0, 1), 1.0}, {Vector3d(0, 0, -1), 1.0}};
  EXPECT_NEAR(projected_area(two, Vector3d::UnitZ()), kPiTest, 1e-3 * kPiTest); // one hides the other
  EXPECT_NEAR(projected_area(two, Vector3d::UnitX()), 2 * kPiTest, 2e-3 * kPiTest);
  // Half hidden: two unit discs at distance 1 overlap in 2 pi/3 - sqrt(3)/2.
  const double overlap = 2 * kPiTest / 3 - std::sqrt(3.0) / 2;
  const Vector3d direction = Vector3d(.5, 0, std::sqrt(3.0) / 2); // shows the axis of length 2 as 2 sin(30) = 1
  EXPECT_NEAR(projected_area(two, direction), 2 * kPiTest - overlap, 2e-3 * kPiTest);
}

TEST(ProjectedArea, TableInterpolatesWithinOnePercent) {
  std::size_t used = 0;
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"disk", "48"}, {"cube", "27"}}) {
    const auto shape = eccentra::shape::make_shape(arguments, 0, used, kDiameter);
    const ProjectedAreaTable table(shape.spheres());
    for (int n = 0; n < 40; ++n) {
      const Vector3d direction(std::sin(1.7 * n), std::cos(2.3 * n), std::sin(.9 * n + 1));
      const double exact = projected_area(shape.spheres(), direction);
      EXPECT_NEAR(table.at(direction), exact, 1e-2 * exact);
      EXPECT_NEAR(table.at(-direction), table.at(direction), 1e-12 * exact);
    }
  }
}

/// One cluster at rest in the middle, its body frame turned by this quaternion.
void make_cluster(LiggghtsSession& session, const std::string& shape, const Eigen::Quaterniond& turn) {
  std::string head = scene_head();
  const std::string stock = "pair_style gran model";
  head.replace(head.find(stock), stock.size(), "pair_style gran/cluster model");
  session.script(head + one_sphere() + "timestep 1e-4\n" + gravity() +
                 "fix shape all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape " + shape +
                 " diameter 6.35e-3\nfix integrate all nve/cluster\n");
  const int i = session.local(1);
  const double q[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
  if (i >= 0)
    FixClusterBodies::find(&session.lammps())->make_body(i, 0, kSolidDensity, q);
}

/// Settling speed with F(U) = V (rho_p - rho_f) g for a drag law in plain form.
template <class Drag> double settling(Drag drag) {
  const double weight = kPiTest / 6 * std::pow(kDiameter, 3) * (kSolidDensity - kFluidDensity) * kGravity;
  double low = 0, high = 10;
  for (int n = 0; n < 200; ++n) {
    const double u = .5 * (low + high);
    (drag(u) < weight ? low : high) = u;
  }
  return low;
}

TEST(Clusters, SettleBySphericityAndVolumeOfTheirUnion) {
  for (const char* name : {"cube 8", "disk 19"}) {
    LiggghtsSession session;
    make_cluster(session, name, Eigen::Quaterniond::Identity());
    session.script("fix mud all fluid/force rheology power_law 0.28 0.65 density 1000 drag chien\n"
                   "fix flow all fluid/uniform velocity 0 0 0\nrun 5000\n");
    const double phi = FixClusterBodies::find(&session.lammps())->shapes()[0].sphericity();
    const double expected = settling([&](double u) {
      const double re = kFluidDensity * std::pow(u, 1.35) * std::pow(kDiameter, .65) / .28;
      return kPiTest / 8 * kFluidDensity * kDiameter * kDiameter * u * u * (30 / re + 67.289 * std::exp(-5.03 * phi));
    });
    EXPECT_NEAR(-velocity_of(session, 1, 2), expected, 1e-3 * expected) << name;
    const int i = session.local(1);
    if (i >= 0) {
      FixFluidForce& fluid = *FixFluidForce::find(&session.lammps());
      EXPECT_NEAR(fluid.equivalent_diameter(i), kDiameter, 1e-9 * kDiameter);
      EXPECT_NEAR(fluid.particle_volume(i) * kSolidDensity, session.atom().rmass[i], 1e-9 * session.atom().rmass[i]);
      EXPECT_GT(session.atom().radius[i], 0.5 * kDiameter); // the bounding radius is another thing
    }
  }
}

TEST(Clusters, ADiskSettlesFasterEdgewise) {
  double speed[2];
  for (const bool edgewise : {false, true}) {
    LiggghtsSession session;
    // Body z is a principal axis, not always the disk's own: find the direction of the largest shadow.
    make_cluster(session, "disk 19", Eigen::Quaterniond::Identity());
    const auto& shape = FixClusterBodies::find(&session.lammps())->shapes()[0];
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (projected_area(shape.spheres(), Vector3d::Unit(k)) > projected_area(shape.spheres(), Vector3d::Unit(axis)))
        axis = k;
    const Vector3d down = Vector3d::Unit(edgewise ? (axis + 1) % 3 : axis);
    const Eigen::Quaterniond turn = eccentra::base::rotation_between(down, Vector3d::UnitZ());
    const double q[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    const int i = session.local(1);
    if (i >= 0)
      FixClusterBodies::find(&session.lammps())->make_body(i, 0, kSolidDensity, q);
    session.script("fix mud all fluid/force rheology newtonian 0.01 density 1000 drag holzer_sommerfeld\n"
                   "fix flow all fluid/uniform velocity 0 0 0\nrun 8000\n");
    speed[edgewise] = -velocity_of(session, 1, 2);
    const double phi = shape.sphericity();
    const double crosswise = kPiTest / 4 * kDiameter * kDiameter / projected_area(shape.spheres(), down);
    const double expected = settling([&](double u) {
      const double re = kFluidDensity * u * kDiameter / .01;
      return kPiTest / 8 * kFluidDensity * kDiameter * kDiameter * u * u *
             (8 / re / std::sqrt(crosswise) + 16 / re / std::sqrt(phi) + 3 / std::sqrt(re) / std::pow(phi, .75) +
              .42 * std::pow(10, .4 * std::pow(-std::log10(phi), .2)) / crosswise);
    });
    EXPECT_NEAR(speed[edgewise], expected, 5e-3 * expected);
  }
  EXPECT_GT(speed[1], 1.2 * speed[0]);
}

TEST(Clusters, SpinInShearTendsToHalfTheVorticity) {
  LiggghtsSession session;
  make_cluster(session, "cube 8", Eigen::Quaterniond(Eigen::AngleAxisd(.4, Vector3d(1, 1, 0).normalized())));
  session.script(
      "unfix gravity\nfix mud all fluid/force rheology newtonian 0.1 density 1000 drag chien drag_torque dennis\n"
      "fix flow all fluid/uniform velocity 0 0 0 velocity_gradient 0 8 0 0 0 0 0 0 0 origin 0.05 0.05 0.2\n"
      "run 4000\n");
  const int i = session.local(1);
  if (i >= 0) {
    EXPECT_NEAR(session.atom().omega[i][2], -4.0, 1e-2);
  }
}

TEST(Clusters, RestExactlyAboveTheYieldLimit) {
  LiggghtsSession session;
  make_cluster(session, "cube 27", Eigen::Quaterniond(Eigen::AngleAxisd(.7, Vector3d(1, 2, 3).normalized())));
  session.script("fix mud all fluid/force rheology herschel_bulkley 4.9 0.28 0.65 density 1000 drag chien\n"
                 "fix flow all fluid/uniform velocity 0 0 0\nrun 500\n");
  for (int k = 0; k < 3; ++k)
    EXPECT_LE(std::abs(velocity_of(session, 1, k)), 1e-15);
}

} // namespace
