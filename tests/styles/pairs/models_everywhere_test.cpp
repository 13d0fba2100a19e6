// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of contacts in scenes of clusters and spheres: the same digits on two ranks as on one and through a
// restart.
#include "styles/bodies/body_rows.h"
#include "styles/pairs/each_model.h"

#include "fix_property_atom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr int kBodies = 12;

/// Bodies and spheres as they run into each other.
void fill(LiggghtsSession& session) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, 1);
  const std::vector<shape::ClusterShape> shapes = {shape_of("cube", "8"), shape_of("disk", "7"),
                                                   shape_of("cube", "27")};
  for (int n = 0; n < kBodies; ++n) {
    Start start;
    start.position = Eigen::Vector3d((n % 3 - 1) * 8e-3, (n / 3 % 2 - 0.5) * 9e-3, kFloor + 5e-3 + (n / 6) * 8e-3);
    start.velocity = Eigen::Vector3d(0.2 * normal(random), 0.2 * normal(random), -0.3);
    start.omega = 20 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    start.orientation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    if (n % 4 == 3)
      add_sphere(session, start, 3.1e-3);
    else
      add_body(session, shapes[n % 4], start);
  }
}

/// The state of a body and its liquid.
using Row = std::array<double, 14>;

/// By tag, the same on every rank.
std::vector<Row> rows_of(LiggghtsSession& session, MPI_Comm ranks) {
  const std::vector<BodyRow> bodies = body_rows(session, kBodies, ranks);
  std::vector<Row> all(kBodies, Row{});
  const double* liquid = nullptr;
  for (int f = 0; f < session.lammps().modify->nfix; ++f)
    if (!std::strcmp(session.lammps().modify->fix[f]->id, "surfaceLiquidContent"))
      liquid = static_cast<LAMMPS_NS::FixPropertyAtom*>(session.lammps().modify->fix[f])->vector_atom;
  std::array<double, kBodies> liquids{};
  for (int tag = 1; tag <= kBodies && liquid != nullptr; ++tag)
    if (const int i = session.local(tag); i >= 0)
      liquids[tag - 1] = liquid[i];
  MPI_Allreduce(MPI_IN_PLACE, liquids.data(), kBodies, MPI_DOUBLE, MPI_SUM, ranks);
  for (int k = 0; k < kBodies; ++k) {
    std::copy(bodies[k].begin(), bodies[k].end(), all[k].begin());
    all[k].back() = liquids[k];
  }
  return all;
}

void expect_identical(const std::vector<Row>& ours, const std::vector<Row>& reference, const std::string& what) {
  int different = 0;
  double largest = 0;
  for (int n = 0; n < kBodies; ++n) {
    different += ours[n] != reference[n];
    for (int k = 0; k < 14; ++k)
      largest = std::max(largest, std::abs(ours[n][k] - reference[n][k]));
  }
  EXPECT_EQ(different, 0) << what << ": bodies whose state differs in any bit, by up to " << largest;
}

constexpr double kStep = 1e-5;
constexpr int kHalf = 1500;

} // namespace

TEST(EachModel, HasTheSameDigitsOnAnyNumberOfRanksAndThroughARestart) {
  EXPECT_GT(all_models().size(), 25u);
  for (const Models& models : all_models()) {
    std::vector<Row> reference;
    {
      LiggghtsSession session(MPI_COMM_SELF);
      open_empty(session, models, kStep);
      fill(session);
      const std::vector<Row> start = rows_of(session, MPI_COMM_SELF);
      session.command("run " + std::to_string(2 * kHalf));
      reference = rows_of(session, MPI_COMM_SELF);
      double turned = 0;
      for (int n = 0; n < kBodies; ++n)
        for (int k = 3; k < 6; ++k)
          turned = std::max(turned, std::abs(reference[n][k] - start[n][k]));
      EXPECT_GT(turned, 0.1) << name_of(models) << ": they must have met";
    }
    {
      LiggghtsSession session;
      open_empty(session, models, kStep);
      fill(session);
      session.script("restart " + std::to_string(kHalf) + " half.restart\nrun " + std::to_string(2 * kHalf - 1) + "\n");
      session.script("restart 0\nrun 1\n");
      expect_identical(rows_of(session, MPI_COMM_WORLD), reference, name_of(models) + ", all ranks");
    }
    LiggghtsSession session(MPI_COMM_SELF); // written by all ranks, read by one
    session.script(std::string(head) + "read_restart half.restart." + std::to_string(kHalf) + "\n");
    open_world(session, models, kStep);
    session.command("run " + std::to_string(kHalf));
    expect_identical(rows_of(session, MPI_COMM_SELF), reference, name_of(models) + ", restart");
  }
}
