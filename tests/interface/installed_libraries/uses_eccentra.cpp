// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Calls one function of each installed library and compares with closed forms; exit status 1 and a line for each
// difference.
#include <closures/drag_laws.h>
#include <closures/oriented_shape.h>
#include <contact/support_table.h>
#include <link/terms.h>
#include <shape/cluster_shape.h>

#include <cmath>
#include <cstdio>

// The alignment of a record with arrays of Eigen is that of the libraries, whatever flags this file has.
static_assert(alignof(eccentra::contact::SphereBlock) == EXPECTED_ALIGNMENT,
              "records have another layout than in the libraries");

namespace {

int differences = 0;

void expect_near(const char* what, double found, double exact, double relative) {
  if (std::abs(found - exact) <= relative * std::abs(exact))
    return;
  std::printf("%s is %.17g, not %.17g\n", what, found, exact);
  ++differences;
}

} // namespace

int main() {
  using namespace eccentra;

  // Sphericity pi^(1/3) (6 V)^(2/3)/A of a cube with half edge 1 whose edges have the radius r: core of half edge c = 1
  // - r.
  std::size_t used = 0;
  const shape::ClusterShape cube = shape::make_shape({"smooth", "cube", "rounding", "0.2"}, 0, used, 6e-3);
  const double r = 0.2, c = 0.8;
  const double volume = 8 * c * c * c + 24 * c * c * r + 6 * M_PI * r * r * c + 4.0 / 3.0 * M_PI * r * r * r;
  const double area = 24 * c * c + 12 * M_PI * r * c + 4 * M_PI * r * r;
  expect_near("sphericity of a rounded cube", cube.sphericity(),
              std::cbrt(M_PI) * std::pow(6 * volume, 2.0 / 3.0) / area, 1e-12);
  expect_near("radius of the sphere of equal volume", cube.equivalent_radius(), 3e-3, 1e-12);

  // Stokes: C_D Re = 24.
  expect_near("drag of a sphere at rest", closures::SchillerNaumann({})(0.0).value, 24.0, 0.0);
  // A sphere: K = K_rot = 1, moments of inertia m d^2/10. The record comes from the library by value: its layout is
  // that of the library.
  const closures::OrientedShape sphere = closures::oriented_shape(shape::Resistance(), Eigen::Vector3d::Constant(0.1),
                                                                  [](const Eigen::Vector3d&) { return M_PI / 4; });
  for (int axis = 0; axis < 3; ++axis) {
    expect_near("resistance of a sphere", sphere.drag[axis], 1.0, 1e-12);
    expect_near("shadow of a sphere", sphere.crosswise[axis], 1.0, 1e-12);
    expect_near("rate of a spin of a sphere", sphere.rates[axis], 10.0, 1e-12);
  }

  // A cube of eight spheres lies on a face: the centres of the four spheres below it have the mean (0, 0, -a).
  const shape::ClusterShape eight = shape::make_shape({"cube", "8"}, 0, used, 6e-3);
  const double a = std::abs(eight.spheres()[0].centre.z()) / eight.equivalent_radius();
  const Eigen::Vector3d arm = contact::SupportTable(eight).arm(-Eigen::Vector3d::UnitZ(), 1e-4);
  expect_near("arm of a cube on its face", (arm + a * Eigen::Vector3d::UnitZ()).norm() + 1.0, 1.0, 1e-12);

  link::DemTerms dem;
  dem.protocol = link::kProtocolVersion + 1;
  if (link::disagreement(dem, link::FluidTerms()).empty()) {
    std::printf("two versions of the link agree\n");
    ++differences;
  }
  return differences > 0 ? 1 : 0;
}
