// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that once held what should have fallen.
#include "reported/throwing_session.h"

#include "shape/cluster_shape.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr double kLarge = 5e-3, kSmall = 0.25e-3, kDensity = 2500; // radii [m], kg/m3

/// Equal spheres in a row along x, each touching the next.
shape::ClusterShape row(int count, double radius) {
  std::vector<shape::Sphere> spheres;
  double spread = 0; // mean square distance along the row
  for (int k = 0; k < count; ++k) {
    const double x = (2 * k - count + 1) * radius;
    spheres.push_back({Eigen::Vector3d(x, 0, 0), radius});
    spread += x * x / count;
  }
  const double own = 0.4 * radius * radius;
  shape::MassProperties properties;
  properties.volume = count * 4. / 3 * M_PI * std::pow(radius, 3);
  properties.surface = count * 4 * M_PI * radius * radius;
  properties.centre.setZero();
  properties.inertia_per_mass = Eigen::Vector3d(own, own + spread, own + spread).asDiagonal();
  return {"row of " + std::to_string(count), spheres, properties};
}

/// A row's own axes are its principal ones: it is turned so that it lies along x.
void make_row(Session& session, int tag, int count, double radius) {
  const shape::ClusterShape shape = row(count, radius);
  const Eigen::Vector3d along =
      count > 1 ? Eigen::Vector3d(shape.spheres()[1].centre - shape.spheres()[0].centre) : Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond q = Eigen::Quaterniond::FromTwoVectors(along, Eigen::Vector3d::UnitX());
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  session.bodies().make_body(session.lammps().atom->map(tag), session.bodies().shapes().add(shape), kDensity, wxyz);
}

/// Who is a cluster: 0, a plain sphere; else so many spheres.
struct Groove {
  const char* name;
  int grain, held;
};

/// Height of a grain of 0.5 mm, one degree off the top of the groove between two held spheres of 10 mm, after 0.22 s:
/// it rolls about the line through its two contacts and falls off after 0.148 s (Vyas et al. 2025).
double height_of_grain(const Groove& groove, const std::string& arguments) {
  const double half = groove.grain == 2 ? kSmall : 0; // from the grain's centre to that of the sphere that touches
  const double orbit = std::sqrt(std::pow(kLarge + kSmall, 2) - std::pow(kLarge - half, 2)), angle = M_PI / 180;
  char place[96];
  std::snprintf(place, sizeof place, "0.005 %.12g %.12g", orbit * std::sin(angle), orbit * std::cos(angle));
  std::string script = "atom_style granular\natom_modify map array\nboundary p p f\nnewton off\n"
                       "communicate single vel yes\nunits si\n"
                       "region box block -0.03 0.03 -0.02 0.02 -0.02 0.02 units box\ncreate_box 2 box\n"
                       "neighbor 0.001 bin\nneigh_modify delay 0\n"
                       "fix m1 all property/global youngsModulus peratomtype 5e8 5e8\n"
                       "fix m2 all property/global poissonsRatio peratomtype 0.3 0.3\n"
                       "fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5\n"
                       "fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5\n"
                       "fix m5 all property/global coefficientRollingFriction peratomtypepair 2 0 0 0 0\n"
                       "pair_style gran/cluster model hertz tangential history " +
                       arguments + "\npair_coeff * *\ntimestep 5e-7\ncreate_atoms 2 single " + place + " units box\n";
  script += groove.held == 2 ? "create_atoms 1 single 0.005 0 0 units box\n"
                             : "create_atoms 1 single 0.01 0 0 units box\ncreate_atoms 1 single 0 0 0 units box\n";
  Session session(script + "set type 1 diameter 0.01 density 2500\nset type 2 diameter 0.0005 density 2500\n"
                           "group large type 1\ngroup fine type 2\n");
  if (groove.grain > 0)
    make_row(session, 1, groove.grain, kSmall);
  if (groove.held == 1)
    for (const int tag : {2, 3})
      make_row(session, tag, 1, kLarge);
  if (groove.held == 2)
    make_row(session, 2, 2, kLarge);
  session.run("fix frz large freeze\nfix g fine gravity 9.81 vector 0 0 -1\nfix integr fine nve/cluster\n");
  double height = orbit;
  for (int n = 0; n < 19 && height > -0.003; ++n) { // until it has fallen
    session.run("run 20000\n");
    height = session.lammps().atom->x[session.lammps().atom->map(1)][2];
  }
  return height;
}

} // namespace

TEST(Reported, grain_in_groove) {
  struct Row {
    Groove groove;
    const char* models; // in blocks, or through LIGGGHTS's own classes
    bool clings;        // with the spring of stock; a pair of spheres can turn about the vertical, too, and falls later
  };
  const Row rows[] = {{{"spheres", 0, 0}, "", true},
                      {{"spheres", 0, 0}, "rolling_friction cdt ", true},
                      {{"clusters of one sphere", 1, 1}, "", true},
                      {{"a sphere in the groove of a cluster", 0, 2}, "", true},
                      {{"a sphere in the groove of a cluster", 0, 2}, "rolling_friction cdt ", true},
                      {{"a cluster in the groove of a cluster", 2, 2}, "", false}};
  for (const auto& [groove, models, clings] : rows) {
    const double ours = height_of_grain(groove, models);
    const double stock = height_of_grain(groove, models + std::string("tangential_update stock"));
    std::printf("%s, %s: %.4f m, with the spring of stock %.4f m\n", groove.name, models, ours, stock);
    EXPECT_LE(ours, -0.003) << groove.name << ' ' << models << ": it has fallen";
    EXPECT_GT(stock, clings ? -0.002 : ours)
        << groove.name << ' ' << models << ": it clings, on the circle about the large spheres";
  }
}
