// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What users read from a bed of clusters: contacts with their forces, coordination numbers, volume fraction on a grid.
#include "styles/bodies/bodies_scene.h"

#include "compute.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <vector>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr int bodies = 12;
constexpr double gravity = 9.81;

LAMMPS_NS::Compute& compute(LiggghtsSession& session, const char* id) {
  return *session.lammps().modify->compute[session.lammps().modify->find_compute(id)];
}

/// A heap on a floor in a periodic box so narrow that bodies touch their images, still moving.
void pile_up(LiggghtsSession& session, const std::string& more = "") {
  session.script(
      "atom_style granular\natom_modify map array\nboundary p p f\nnewton off\ncommunicate single vel yes\nunits si\n"
      "region box block 0 0.018 0 0.018 0 0.06 units box\ncreate_box 1 box\nneighbor 0.001 bin\nneigh_modify delay 0\n"
      "fix m1 all property/global youngsModulus peratomtype 5e6\n"
      "fix m2 all property/global poissonsRatio peratomtype 0.3\n"
      "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5\n"
      "fix m4 all property/global coefficientFriction peratomtypepair 1 0.4\n");
  use_clusters(session);
  session.script("fix g all gravity 9.81 vector 0 0 -1\ntimestep 2e-5\n"
                 "fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0\n" +
                 more);
  for (int n = 0; n < bodies; ++n) {
    Start start;
    start.position = {0.0045 + 0.009 * (n % 2), 0.0045 + 0.009 * (n / 2 % 2), 0.005 + 0.009 * (n / 4)};
    start.orientation = Eigen::AngleAxisd(0.3 * n, Eigen::Vector3d(1, 2, 0.5).normalized());
    start.velocity = {0, 0, -0.6};
    add_body(session, shape_of(n % 3 ? "cube" : "disk", n % 3 ? "8" : "19", 7e-3), start);
  }
  session.command("run 2500");
}

/// Sum over all ranks.
std::vector<double> summed(std::vector<double> values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return values;
}

} // namespace

// Force and torque on each body are those of its contacts: nothing is missing, nothing stands twice.
TEST(ContactOutput, AddsUpToTheForcesOfTheStep) {
  LiggghtsSession session;
  pile_up(session, "compute c all contact/cluster/local of all id force torque contactPoint pos delta force_normal "
                   "force_tangential sub\n"
                   "compute rows all reduce sum c_c[1]\nthermo_style custom step c_rows\nthermo 500\n");
  const LAMMPS_NS::Compute& contacts = compute(session, "c");
  ASSERT_EQ(contacts.invoked_local, session.lammps().update->ntimestep);
  constexpr int columns = 6; // force, torque of each body
  std::vector<double> sum(columns * bodies, 0.), acting(columns * bodies, 0.);
  int rows = 0, wall_rows = 0;
  // Columns in the fixed order: pos 0-5, id 6-8, force 9-11, normal 12-14, tangential 15-17, torque 18-20, delta 21,
  // point 22-24, sub 25-26.
  ASSERT_EQ(contacts.size_local_cols, 27);
  for (int n = 0; n < contacts.size_local_rows; ++n) {
    const double* row = contacts.array_local[n];
    const Eigen::Map<const Eigen::Vector3d> at_a(row), at_b(row + 3), force(row + 9), along(row + 12), across(row + 15),
        torque(row + 18), point(row + 22);
    EXPECT_LT((along + across - force).norm(), 1e-12);
    EXPECT_LT(std::abs(along.dot(across)), 1e-15);
    EXPECT_GT(row[21], 0);
    EXPECT_LT((torque - (point - at_a).cross(force)).norm(), 1e-12);
    const int a = static_cast<int>(row[6]) - 1, b = static_cast<int>(row[7]) - 1;
    for (int k = 0; k < 3; ++k) {
      sum[columns * a + k] += force[k];
      sum[columns * a + 3 + k] += torque[k];
    }
    if (b >= 0) {
      EXPECT_LT(a, b);
      const Eigen::Vector3d on_b = (point - at_b).cross(-force);
      for (int k = 0; k < 3; ++k) {
        sum[columns * b + k] -= force[k];
        sum[columns * b + 3 + k] += on_b[k];
      }
    } else {
      EXPECT_NEAR(point.z(), 0, 1e-4);
      ++wall_rows;
    }
    ++rows;
  }
  for (int i = 0; i < session.atom().nlocal; ++i) {
    const int n = session.atom().tag[i] - 1;
    for (int k = 0; k < 3; ++k) {
      acting[columns * n + k] = session.atom().f[i][k];
      acting[columns * n + 3 + k] = session.atom().torque[i][k];
    }
    acting[columns * n + 2] += gravity * session.atom().rmass[i];
  }
  sum = summed(sum);
  acting = summed(acting);
  double largest = 0;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    EXPECT_NEAR(sum[k], acting[k], 1e-10 * (k % columns < 3 ? 1 : 1e-2)) << k;
    largest = std::max(largest, std::abs(acting[k]));
  }
  EXPECT_GT(largest, 1e-4);
  const auto counts = summed({static_cast<double>(rows), static_cast<double>(wall_rows)});
  EXPECT_GT(counts[0], 15);
  EXPECT_GT(counts[1], 3);
  EXPECT_EQ(session.lammps().modify->find_fix_id("floor")->compute_scalar(), counts[1]);
}

// The forces must be the same where an output wants the contacts, with bodies asleep and not.
TEST(ContactOutput, ChangesNothing) {
  std::vector<double> states[2];
  for (const bool output : {false, true}) {
    LiggghtsSession session;
    pile_up(session, output ? "compute c all contact/cluster/local of all\ncompute rows all reduce sum c_c[1]\n"
                              "thermo_style custom step c_rows\nthermo 50\n"
                            : "thermo 50\n");
    std::vector<double>& state = states[output];
    state.assign(6 * bodies, 0.);
    for (int i = 0; i < session.atom().nlocal; ++i)
      for (int k = 0; k < 3; ++k) {
        state[6 * (session.atom().tag[i] - 1) + k] = session.atom().x[i][k];
        state[6 * (session.atom().tag[i] - 1) + 3 + k] = session.atom().omega[i][k];
      }
    state = summed(state);
  }
  EXPECT_EQ(states[0], states[1]);
}

TEST(ContactOutput, CountsTouchingBodies) {
  LiggghtsSession session;
  pile_up(session, "compute c all contact/cluster/local of all id sub\ncompute rows all reduce sum c_c[1]\n"
                   "compute n all contact/cluster/atom\ncompute touching all reduce sum c_n[1]\n"
                   "thermo_style custom step c_rows c_touching\nthermo 2500\n");
  const LAMMPS_NS::Compute& rows = compute(session, "c");
  std::vector<double> contacts(2 * bodies, 0.), partners(bodies * (bodies + 1), 0.);
  for (int n = 0; n < rows.size_local_rows; ++n) {
    const int a = static_cast<int>(rows.array_local[n][0]) - 1, b = static_cast<int>(rows.array_local[n][1]) - 1;
    contacts[2 * a + (b < 0)] += 1;
    if (b >= 0) {
      contacts[2 * b] += 1;
      partners[a * bodies + b] = partners[b * bodies + a] = 1;
    }
  }
  contacts = summed(contacts);
  partners = summed(partners);
  const LAMMPS_NS::Compute& counted = compute(session, "n");
  double most = 0;
  for (int i = 0; i < session.atom().nlocal; ++i) {
    const int n = session.atom().tag[i] - 1;
    int touching = 0;
    for (int m = 0; m < bodies; ++m)
      touching += partners[n * bodies + m] > 0;
    EXPECT_GE(counted.array_atom[i][0], touching); // images count each
    EXPECT_EQ(counted.array_atom[i][1], contacts[2 * n]);
    EXPECT_EQ(counted.array_atom[i][2], contacts[2 * n + 1]);
    most = std::max(most, counted.array_atom[i][0]);
  }
  EXPECT_GE(summed({most})[0], 2);
}

TEST(AveEuler, SeesTrueVolumes) {
  LiggghtsSession session;
  pile_up(session, "fix grid all ave/euler nevery 100 cell_size_relative 3 parallel no\n");
  LAMMPS_NS::Fix* grid = session.lammps().modify->find_fix_id("grid");
  session.command("run 100");
  // One column of cells over the whole box.
  const double box = 0.018 * 0.018 * 0.06, body = M_PI / 6 * std::pow(7e-3, 3);
  double volume = 0;
  int cells = 0;
  while (grid->compute_array(cells, 0) > 0)
    ++cells;
  for (int n = 0; n < cells; ++n)
    volume += grid->compute_array(n, 3) * box / cells;
  EXPECT_NEAR(volume, bodies * body, 1e-3 * bodies * body);
}

TEST(CreateBodies, PlacesAListInItsOrderOnAnyNumberOfRanks) {
  LiggghtsSession session;
  open_box(session, {});
  use_clusters(session);
  session.script(
      "timestep 1e-6\nfix t all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube "
      "8 diameter 6.35e-3\n");
  if (session.rank() == 0)
    std::ofstream("bodies.txt") << "# x y z, orientation, velocity, spin\n"
                                   "-0.05, 0, 0\n\n"
                                   "0.05 0.01 0.02  0.5 0.5 -0.5 0.5  # comment\n"
                                   "0 0 0.08  1 0 0 0  0.1 0.2 0.3  4 5 6\n";
  MPI_Barrier(MPI_COMM_WORLD);
  session.command("create_bodies bodies.txt template t");
  EXPECT_EQ(session.atom().natoms, 3);
  session.command("run 0");
  const auto& all = styles::FixClusterBodies::require(&session.lammps());
  std::vector<double> state(3 * 13, 0.);
  for (int i = 0; i < session.atom().nlocal; ++i) {
    double* row = &state[13 * (session.atom().tag[i] - 1)];
    std::copy_n(session.atom().x[i], 3, row);
    std::copy_n(all.quaternion(i), 4, row + 3);
    std::copy_n(session.atom().v[i], 3, row + 7);
    std::copy_n(session.atom().omega[i], 3, row + 10);
    EXPECT_NEAR(session.atom().rmass[i], 2619 * M_PI / 6 * std::pow(6.35e-3, 3), 1e-12);
  }
  const std::vector<double> expected = {-0.05, 0,    0,    1,   0,   0,    0,   0,   0,   0,   0, 0, 0,
                                        0.05,  0.01, 0.02, 0.5, 0.5, -0.5, 0.5, 0,   0,   0,   0, 0, 0,
                                        0,     0,    0.08, 1,   0,   0,    0,   0.1, 0.2, 0.3, 4, 5, 6};
  state = summed(state);
  for (std::size_t k = 0; k < state.size(); ++k)
    EXPECT_NEAR(state[k], expected[k], 1e-12) << k;
}
