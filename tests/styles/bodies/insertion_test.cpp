// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Stock insertion of clusters: dense fills without a single overlap, rates and streams with exact counts.
#include "styles/bodies/bodies_scene.h"
#include "support/stl_file.h"

#include "pair.h"

#include "force.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double diameter = 6.35e-3;
/// Centres are inserted here; the box is wider by more than any bounding radius, so that no border interferes.
constexpr double side = 0.05;

/// Spheres and clusters at their places, the same on every rank: x y z radius, rotation by rows, shape.
struct Placed {
  Eigen::Vector3d centre;
  double radius;
  Eigen::Matrix3d turn;
  int shape;
};

std::vector<Placed> placed(LiggghtsSession& session) {
  constexpr int arguments = 14;
  std::vector<double> ours;
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  for (int i = 0; i < session.atom().nlocal; ++i) {
    double turn[9];
    contact::rotation_matrix(bodies.quaternion(i), turn);
    ours.insert(ours.end(), session.atom().x[i], session.atom().x[i] + 3);
    ours.push_back(session.atom().radius[i]);
    ours.insert(ours.end(), turn, turn + 9);
    ours.push_back(bodies.shape_id(i));
  }
  int size = static_cast<int>(ours.size());
  std::vector<int> sizes(session.ranks()), starts(session.ranks(), 0);
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
  int total = 0;
  for (int rank = 0; rank < session.ranks(); ++rank) {
    starts[rank] = total;
    total += sizes[rank];
  }
  std::vector<double> all(total);
  MPI_Allgatherv(ours.data(), size, MPI_DOUBLE, all.data(), sizes.data(), starts.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  std::vector<Placed> result;
  for (int n = 0; n < total; n += arguments)
    result.push_back({Eigen::Vector3d(&all[n]), all[n + 3],
                      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&all[n + 4]),
                      static_cast<int>(all[n + 13])});
  return result;
}

/// Every sub-sphere of a body in world.
std::vector<shape::Sphere> spheres_of(const Placed& body, const styles::ShapeTable& shapes) {
  if (body.shape < 0)
    return {{body.centre, body.radius}};
  std::vector<shape::Sphere> world;
  for (const auto& s : shapes[body.shape].spheres())
    world.push_back({body.centre + body.turn * s.centre, s.radius});
  return world;
}

/// Pairs of bodies that overlap anywhere, by brute force.
int overlapping_pairs(LiggghtsSession& session) {
  const auto all = placed(session);
  const auto& shapes = styles::FixClusterBodies::require(&session.lammps()).shapes();
  std::vector<std::vector<shape::Sphere>> spheres;
  for (const Placed& body : all)
    spheres.push_back(spheres_of(body, shapes));
  int pairs = 0;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if ((all[a].centre - all[b].centre).norm() > all[a].radius + all[b].radius)
        continue;
      bool touch = false;
      for (const auto& s : spheres[a])
        for (const auto& t : spheres[b])
          touch = touch || (s.centre - t.centre).norm() < s.radius + t.radius;
      pairs += touch;
    }
  return pairs;
}

std::string cluster_template(const std::string& id, const std::string& shape, int seed) {
  return "fix " + id + " all particletemplate/cluster " + std::to_string(seed) +
         " atom_type 1 density constant 2619 shape " + shape + " diameter " + std::to_string(diameter) + "\n";
}

/// As many as fit within stock's default number of attempts.
std::string pack(const std::string& id, const std::string& distribution, int seed, const std::string& region) {
  return "fix " + id + " all insert/pack seed " + std::to_string(seed) + " distributiontemplate " + distribution +
         " insert_every once overlapcheck yes all_in no verbose no volumefraction_region 0.5 region " + region + "\n";
}

std::string place_region(double low, double high) {
  return "block " + std::to_string(low) + " " + std::to_string(high) + " -0.025 0.025 -0.025 0.025 units box\n";
}

void open_fill(LiggghtsSession& session) {
  open_box(session, {}, "f f f");
  use_clusters(session);
  session.script("timestep 1e-7\nregion place " + place_region(-side / 2, side / 2));
}

/// Bodies in a fill of one shape.
int fill(const std::string& shape) {
  LiggghtsSession session;
  open_fill(session);
  session.script(cluster_template("t", shape, 15485863) + "fix d all particledistribution/discrete 32452843 1 t 1.0\n" +
                 pack("ins", "d", 86028121, "place") + "run 1\n");
  EXPECT_EQ(overlapping_pairs(session), 0) << shape;
  int dim;
  int contacts = *static_cast<int*>(session.lammps().force->pair->extract("contacts", dim));
  MPI_Allreduce(MPI_IN_PLACE, &contacts, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(contacts, 0) << shape;
  return static_cast<int>(session.atom().natoms);
}

} // namespace

TEST(Insertion, DenseFillsOfClustersReachWhatSpheresReach) {
  const int spheres = fill("sphere 1"), disks = fill("disk 48"), cubes = fill("cube 64");
  std::printf("bodies in one fill: %d spheres, %d disks (D48), %d cubes (C64)\n", spheres, disks, cubes);
  // Tested with their bounding spheres, disks would reach 1 / 1.37^3 = 0.39 of the spheres. Borders of ranks keep a
  // bounding radius free; on one rank nothing does.
  const double borders = LiggghtsSession().ranks() == 1 ? 1 : 0.9;
  EXPECT_GT(disks, 0.95 * borders * spheres);
  EXPECT_GT(cubes, 0.95 * borders * spheres);
}

TEST(Insertion, NothingIsPutIntoWhatIsThere) {
  // A mixture with plain spheres, then a second fill into the first one after it has moved.
  LiggghtsSession session;
  open_fill(session);
  session.script(cluster_template("disks", "disk 19", 15485863) + cluster_template("cubes", "cube 27", 15485867) +
                 "fix grains all particletemplate/sphere 32452867 atom_type 1 density constant 2619 radius constant " +
                 std::to_string(diameter / 2) + "\nregion left " + place_region(-side / 2, 0) + "region right " +
                 place_region(-0.25 * side, side / 2) +
                 "fix d all particledistribution/discrete 32452843 3 disks 0.4 cubes 0.3 grains 0.3\n" +
                 pack("first", "d", 86028121, "left") + "run 1\n");
  const int before = static_cast<int>(session.atom().natoms);
  EXPECT_EQ(overlapping_pairs(session), 0);
  session.script("velocity all set 0.1 0.02 0 units box\nrun 20000\nunfix first\n");
  const int touching = overlapping_pairs(session);
  session.script(pack("second", "d", 86028157, "right") + "run 1\n");
  EXPECT_GT(session.atom().natoms, before + 50);
  EXPECT_EQ(overlapping_pairs(session), touching);
}

namespace {

/// Mean of the body axes' components, and of their squares: uniform directions give 0 and 1/3 within 4 standard errors.
void expect_uniform_orientations(LiggghtsSession& session) {
  const auto all = placed(session);
  const double n = static_cast<double>(all.size());
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 3; ++k) {
      double mean = 0, square = 0;
      for (const Placed& body : all) {
        mean += body.turn(k, axis) / n;
        square += body.turn(k, axis) * body.turn(k, axis) / n;
      }
      EXPECT_NEAR(mean, 0, 4 / std::sqrt(3 * n));
      EXPECT_NEAR(square, 1. / 3, 4 * std::sqrt(4. / 45 / n));
    }
}

constexpr int poured = 431; // the paper's rate: bodies in one second

} // namespace

TEST(Insertion, RateIntoARegionIsExact) {
  LiggghtsSession session;
  open_fill(session);
  session.script(cluster_template("t", "disk 48", 15485863) +
                 "fix d all particledistribution/discrete 32452843 1 t 1.0\n"
                 "timestep 1e-4\nregion spout block -0.09 0.09 -0.09 0.09 0.06 0.09 units box\n"
                 "neigh_modify exclude group all all\n"
                 "fix ins all insert/rate/region seed 86028121 distributiontemplate d nparticles " +
                 std::to_string(poured) + " particlerate " + std::to_string(poured) +
                 " insert_every 1000 overlapcheck yes all_in yes verbose no vel constant 0 0 -0.1 region spout\n");
  session.script("run 5000\n");
  EXPECT_NEAR(static_cast<double>(session.atom().natoms), poured / 2., 0.11 * poured); // one portion of ten, at most
  session.script("run 6000\n");
  EXPECT_EQ(session.atom().natoms, poured);
}

TEST(Insertion, StreamsOfClustersKeepCountVelocityAndSpin) {
  write_stl_file("stream_face.stl",
                 stl_quad({"-0.08 -0.08 0.05", "0.08 -0.08 0.05", "0.08 0.08 0.05", "-0.08 0.08 0.05"}));
  LiggghtsSession session;
  open_fill(session);
  // 0.4 m/s: a portion of 500 steps is 20 mm high and passes the face before the next one comes. A cube's moments of
  // inertia are equal: in free flight its spin is the one that it was given.
  session.script(cluster_template("t", "cube 27", 15485863) +
                 "fix d all particledistribution/discrete 32452843 1 t 1.0\n"
                 "timestep 1e-4\nfix face all mesh/surface/planar file stream_face.stl type 1\n"
                 "fix ins all insert/stream seed 86028121 distributiontemplate d nparticles " +
                 std::to_string(poured) + " particlerate " + std::to_string(4 * poured) +
                 " overlapcheck yes all_in no verbose no vel constant 0 0 -0.4 omega constant 3 -20 5 "
                 "insert_every 500 insertion_face face\n");
  session.script("run 1\n");
  EXPECT_EQ(overlapping_pairs(session), 0);
  session.script("neigh_modify exclude group all all\nrun 3000\n");
  EXPECT_EQ(session.atom().natoms, poured);
  expect_uniform_orientations(session);
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  const Eigen::Vector3d given(3, -20, 5);
  int released = 0;
  for (int i = 0; i < session.atom().nlocal; ++i) {
    EXPECT_NEAR(session.atom().v[i][2], -0.4, 1e-12);
    const Eigen::Map<const Eigen::Vector3d> omega(session.atom().omega[i]), momentum(bodies.angular_momentum(i));
    const bool on_its_way = session.atom().x[i][2] > 0.05;
    const Eigen::Vector3d expected = on_its_way ? Eigen::Vector3d(0, 0, 0) : given;
    EXPECT_LT((omega - expected).norm(), 1e-9 * given.norm());
    EXPECT_LT((momentum - bodies.inertia(i)[0] * expected).norm(), 1e-9 * bodies.inertia(i)[0] * given.norm());
    released += !on_its_way;
  }
  MPI_Allreduce(MPI_IN_PLACE, &released, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_GT(released, poured / 2);
}
