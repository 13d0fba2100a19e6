// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Contacts that once held what should have fallen.
#include "base/linear_algebra.h"
#include "reported/throwing_session.h"
#include "support/groove_scene.h"
#include "support/row_properties.h"

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
  for (int k = 0; k < count; ++k)
    spheres.push_back({Eigen::Vector3d((2 * k - count + 1) * radius, 0, 0), radius});
  return {"row of " + std::to_string(count), spheres, row_properties(count, radius, 2 * radius, 0)};
}

/// A row's own axes are its principal ones: it is turned so that it lies along x.
void make_row(Session& session, int tag, int count, double radius) {
  const shape::ClusterShape shape = row(count, radius);
  const Eigen::Vector3d along =
      count > 1 ? Eigen::Vector3d(shape.spheres()[1].centre - shape.spheres()[0].centre) : Eigen::Vector3d::UnitX();
  const Eigen::Quaterniond q = eccentra::base::rotation_between(along, Eigen::Vector3d::UnitX());
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
  std::vector<std::string> held = {"0.01 0 0", "0 0 0"};
  if (groove.held == 2)
    held = {"0.005 0 0"};
  Session session(groove_scene(arguments, place, held));
  if (groove.grain > 0)
    make_row(session, 1, groove.grain, kSmall);
  if (groove.held == 1)
    for (const int tag : {2, 3})
      make_row(session, tag, 1, kLarge);
  if (groove.held == 2)
    make_row(session, 2, 2, kLarge);
  session.run(groove_motion);
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
