// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// First-kind boundary integral of Stokes flow: u = (1/8 pi mu) sum of G f over panels, one solve for each parity.
#include "shape/resistance.h"

#include "shape/rounded_surface.h"
#include "shape/surface_panels.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>

namespace eccentra::shape {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Panels on the kept part of the surface by number of mirror planes: each choice costs about 2e9 operations.
constexpr std::array<std::size_t, 4> kPanels = {600, 450, 375, 300};
/// Panels nearer than this many times their extents see each other's points.
constexpr double kNearField = 3.0;
/// Values that must be equal by symmetry and differ by more than this are not averaged: the symmetry is not there.
constexpr double kAlike = 0.02;
/// A centre of resistance nearer to the centre of mass than this part of d is there.
constexpr double kCentred = 1e-3;
/// Places of spheres, in units of d.
constexpr double kDigits = 1e-9;
constexpr int kRightHandSides = 12;

/// The Stokeslet I/q + r r/q^3 times an area.
void add_stokeslet(Matrix3d& sum, const Vector3d& r, double area) {
  const double q2 = r.squaredNorm();
  const double inverse = 1 / std::sqrt(q2);
  sum.noalias() += r * r.transpose() * (area * inverse / q2);
  sum.diagonal().array() += area * inverse;
}

/// Integral over the panel as the point `from` sees it.
Matrix3d seen_from(const Vector3d& from, const Panel& panel, const Vector3d& sign) {
  Matrix3d sum = Matrix3d::Zero();
  for (const PanelPoint& point : panel.points)
    add_stokeslet(sum, from - point.place.cwiseProduct(sign), point.area);
  return sum;
}

/// Integral over a panel as seen from its own middle, where a disc of the same area stands for the middle point.
Matrix3d seen_from_itself(const Panel& panel) {
  const PanelPoint& middle = panel.points[std::size_t(panel.middle)];
  const double radius = std::sqrt(middle.area / M_PI);
  Matrix3d sum = 2 * M_PI * radius * Matrix3d::Identity() +
                 M_PI * radius * (Matrix3d::Identity() - middle.normal * middle.normal.transpose());
  for (std::size_t k = 0; k < panel.points.size(); ++k)
    if (static_cast<int>(k) != panel.middle)
      add_stokeslet(sum, middle.place - panel.points[k].place, panel.points[k].area);
  return sum;
}

const Vector3d& middle_of(const Panel& panel) {
  return panel.points[std::size_t(panel.middle)].place;
}

/// Rows and columns weighted by area, so that the operator is symmetric: A_i G_ij A_j.
Matrix3d interaction(const Panel& i, const Panel& j, const Vector3d& sign, bool itself) {
  if (itself)
    return i.area * seen_from_itself(i);
  const double distance = (i.centre - j.centre.cwiseProduct(sign)).norm();
  if (distance < kNearField * (i.extent + j.extent)) {
    const Matrix3d there = i.area * seen_from(middle_of(i), j, sign);
    // The other way round, mirrored: G(S x) = S G(x) S.
    const Matrix3d back = j.area * seen_from(middle_of(j).cwiseProduct(sign), i, Vector3d::Ones());
    return 0.5 * (there + back);
  }
  Matrix3d sum = Matrix3d::Zero();
  add_stokeslet(sum, i.centre - j.centre.cwiseProduct(sign), i.area * j.area);
  return sum;
}

/// Rigid motions and strains: translations, rotations, strains xx yy zz yz xz xy.
Vector3d prescribed(int which, const Vector3d& x) {
  const int k = which % 3;
  if (which < 3)
    return Vector3d::Unit(k);
  if (which < 6)
    return Vector3d::Unit(k).cross(x);
  if (which < 9)
    return x[k] * Vector3d::Unit(k) - x / 3; // its trace is left out: a closed surface takes no flux
  const int a = (k + 1) % 3, b = (k + 2) % 3;
  return x[b] * Vector3d::Unit(a) + x[a] * Vector3d::Unit(b);
}

/// How each field above changes sign in the mirror normal to `axis`, relative to a vector that the mirror turns.
int parity(int which, int axis) {
  const int k = which % 3;
  if (which < 3)
    return k == axis ? -1 : 1;
  if (which < 6 || which >= 9)
    return k == axis ? 1 : -1;
  return 1;
}

struct Loads {
  Vector3d force, torque;
};

class Solver {
 public:
  Solver(const std::vector<Panel>& panels, const MirrorPlanes& mirrors) : panels_(panels), mirrors_(mirrors) {
    for (int code = 0; code < 8; ++code) {
      Vector3d sign = Vector3d::Ones();
      bool kept = true;
      for (int k = 0; k < 3; ++k)
        if (code >> k & 1) {
          kept = kept && mirrors[k];
          sign[k] = -1;
        }
      if (kept)
        images_.push_back(sign);
    }
  }

  std::array<Loads, kRightHandSides> solve() const {
    std::map<std::array<int, 3>, std::vector<int>> classes;
    for (int which = 0; which < kRightHandSides; ++which)
      classes[parities(which)].push_back(which);
    std::array<Loads, kRightHandSides> loads;
    for (const auto& [signs, members] : classes)
      solve_class(signs, members, loads);
    return loads;
  }

 private:
  std::array<int, 3> parities(int which) const {
    std::array<int, 3> signs{1, 1, 1};
    for (int k = 0; k < 3; ++k)
      if (mirrors_[k])
        signs[k] = parity(which, k);
    return signs;
  }
  static double character(const std::array<int, 3>& signs, const Vector3d& image) {
    double product = 1;
    for (int k = 0; k < 3; ++k)
      product *= image[k] < 0 ? signs[k] : 1;
    return product;
  }

  /// f(S x) = character(S) S f(x): the panels of the kept part carry all unknowns.
  void solve_class(const std::array<int, 3>& signs, const std::vector<int>& members,
                   std::array<Loads, kRightHandSides>& loads) const {
    const auto count = static_cast<Eigen::Index>(panels_.size());
    MatrixXd matrix(3 * count, 3 * count);
    Eigen::VectorXd outward(3 * count);
    bool flux = true; // a pressure inside does nothing: the integral cannot see the part of f along the normal
    for (int k = 0; k < 3; ++k)
      flux = flux && signs[k] > 0;
    for (Eigen::Index j = 0; j < count; ++j) {
      const Panel& pj = panels_[std::size_t(j)];
      for (Eigen::Index i = j; i < count; ++i) {
        const Panel& pi = panels_[std::size_t(i)];
        Matrix3d sum = Matrix3d::Zero();
        for (std::size_t g = 0; g < images_.size(); ++g)
          sum += character(signs, images_[g]) * interaction(pi, pj, images_[g], g == 0 && i == j) *
                 images_[g].asDiagonal();
        matrix.block<3, 3>(3 * i, 3 * j) = sum;
      }
      Vector3d normal = Vector3d::Zero();
      for (const PanelPoint& point : pj.points)
        normal += point.area * point.normal;
      outward.segment<3>(3 * j) = normal;
    }
    if (flux)
      matrix += outward * outward.transpose() / std::sqrt(outward.squaredNorm());
    MatrixXd sides(3 * count, static_cast<Eigen::Index>(members.size()));
    for (Eigen::Index i = 0; i < count; ++i)
      for (std::size_t m = 0; m < members.size(); ++m) {
        Vector3d velocity = Vector3d::Zero();
        for (const PanelPoint& point : panels_[std::size_t(i)].points)
          velocity += point.area * prescribed(members[m], point.place);
        sides.block<3, 1>(3 * i, Eigen::Index(m)) = 8 * M_PI * velocity;
      }
    // Positive definite but for panels that are long and thin, whose middles stand badly for the whole.
    const Eigen::LLT<MatrixXd, Eigen::Lower> cholesky(matrix);
    if (cholesky.info() == Eigen::Success)
      cholesky.solveInPlace(sides);
    else
      sides = MatrixXd(matrix.selfadjointView<Eigen::Lower>()).partialPivLu().solve(sides).eval();
    for (std::size_t m = 0; m < members.size(); ++m) {
      Loads& load = loads[std::size_t(members[m])];
      load = {Vector3d::Zero(), Vector3d::Zero()};
      for (Eigen::Index i = 0; i < count; ++i) {
        const Panel& panel = panels_[std::size_t(i)];
        const Vector3d f = sides.block<3, 1>(3 * i, Eigen::Index(m)) * panel.area;
        Vector3d arm = panel.centre;
        load.force += f;
        load.torque += arm.cross(f);
      }
      Vector3d of_force = Vector3d::Zero(), of_torque = Vector3d::Zero();
      for (const Vector3d& image : images_) {
        const double c = character(signs, image);
        of_force += c * image;
        of_torque += c * image.prod() * image;
      }
      load.force = load.force.cwiseProduct(of_force);
      load.torque = load.torque.cwiseProduct(of_torque);
    }
  }

  const std::vector<Panel>& panels_;
  MirrorPlanes mirrors_;
  std::vector<Vector3d> images_;
};

/// Solves and scales; `d` in the unit of the panels.
Resistance solve(const std::vector<Panel>& panels, const MirrorPlanes& mirrors, double d) {
  const auto loads = Solver(panels, mirrors).solve();
  Resistance r;
  for (int k = 0; k < 3; ++k) {
    r.translation.col(k) = loads[std::size_t(k)].force / (3 * M_PI * d);
    r.coupling.col(k) = loads[std::size_t(k)].torque / (M_PI * d * d);
    r.rotation.col(k) = loads[3 + std::size_t(k)].torque / (M_PI * d * d * d);
  }
  for (int k = 0; k < 6; ++k)
    r.strain.col(k) = loads[6 + std::size_t(k)].torque / (M_PI * d * d * d);
  r.translation = (0.5 * (r.translation + r.translation.transpose())).eval();
  r.rotation = (0.5 * (r.rotation + r.rotation.transpose())).eval();
  return r;
}

/// Axes a and b are alike: a body with such moments of inertia is as good as round in their plane.
void average_about(Resistance& r, int axis) {
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  for (Matrix3d* m : {&r.translation, &r.rotation}) {
    const double mean = 0.5 * ((*m)(a, a) + (*m)(b, b));
    const double along = (*m)(axis, axis);
    m->setZero();
    (*m)(a, a) = (*m)(b, b) = mean;
    (*m)(axis, axis) = along;
  }
  // Torque about a by strain in the plane of b and the axis, and about b by that of the axis and a.
  const double about = 0.5 * (r.strain(a, 3 + a) - r.strain(b, 3 + b));
  r.strain.setZero();
  r.strain(a, 3 + a) = about;
  r.strain(b, 3 + b) = -about;
}

bool alike(double a, double b) {
  return std::abs(a - b) < kAlike * std::max(std::abs(a), std::abs(b));
}

void make_symmetric(Resistance& r, const Vector3d& inertia, bool three_mirrors) {
  const Vector3d k = r.translation.diagonal(), spin = r.rotation.diagonal();
  const auto same = [&](int a, int b) {
    return inertia[a] == inertia[b] && alike(k[a], k[b]) && alike(spin[a], spin[b]);
  };
  const double off = (r.translation - Matrix3d(k.asDiagonal())).cwiseAbs().maxCoeff() +
                     (r.rotation - Matrix3d(spin.asDiagonal())).cwiseAbs().maxCoeff();
  if (same(0, 1) && same(1, 2) && off < kAlike) {
    r.translation = k.mean() * Matrix3d::Identity();
    r.rotation = spin.mean() * Matrix3d::Identity();
    if (r.strain.cwiseAbs().maxCoeff() < kAlike)
      r.strain.setZero();
  } else if (off < kAlike) {
    for (int axis = 0; axis < 3 && three_mirrors; ++axis)
      if (same((axis + 1) % 3, (axis + 2) % 3))
        average_about(r, axis);
  }
}

/// Where the antisymmetric part of the coupling vanishes (Happel & Brenner 1973, section 5-2).
Vector3d centre_of(const Resistance& r) {
  const Matrix3d& c = r.coupling;
  // T = C u with C in units of pi mu d^2, F = K u in units of 3 pi mu d.
  const Matrix3d k = 3 * r.translation;
  const Vector3d twist(c(1, 2) - c(2, 1), c(2, 0) - c(0, 2), c(0, 1) - c(1, 0));
  const Vector3d centre = (k - k.trace() * Matrix3d::Identity()).lu().solve(twist);
  return centre.norm() < kCentred ? Vector3d::Zero() : centre;
}

Resistance finished(Resistance r, const Vector3d& inertia, const MirrorPlanes& mirrors) {
  make_symmetric(r, inertia, mirrors[0] && mirrors[1] && mirrors[2]);
  r.centre = centre_of(r);
  return r;
}

std::size_t panels_for(const MirrorPlanes& mirrors) {
  return kPanels[std::size_t(mirrors[0] + mirrors[1] + mirrors[2])];
}

} // namespace

Eigen::Matrix<double, 3, 6> Resistance::spin_by_strain() const {
  return rotation.ldlt().solve(strain);
}

Eigen::Vector3d Resistance::bretherton() const {
  const auto spin = spin_by_strain();
  return {spin(0, 3), spin(1, 4), spin(2, 5)};
}

double Resistance::jeffery_period(int axis) const {
  const double b = bretherton()[axis];
  return 4 * M_PI / std::sqrt(1 - b * b);
}

Resistance resistance_of(const ClusterShape& shape) {
  if (shape.spheres().size() == 1)
    return {};
  // In units of d and to so many digits, so that one shape has one resistance whatever its size.
  const double d = 2 * shape.equivalent_radius();
  const auto rounded = [d](double value) { return std::round(value / d / kDigits) * kDigits; };
  std::vector<Sphere> spheres;
  for (const Sphere& sphere : shape.spheres())
    spheres.push_back({sphere.centre.unaryExpr(rounded), rounded(sphere.radius)});
  const MirrorPlanes mirrors = mirror_planes(spheres);
  const std::vector<Panel> panels = panels_of(spheres, mirrors, panels_for(mirrors));
  return finished(solve(panels, mirrors, 1), shape.inertia_per_mass(), mirrors);
}

Resistance resistance_of(const Surface& surface, double volume, const Eigen::Vector3d& inertia_per_mass) {
  const MirrorPlanes mirrors = mirror_planes(surface);
  const std::vector<Panel> panels = panels_of(surface, mirrors, panels_for(mirrors));
  return finished(solve(panels, mirrors, std::cbrt(6 * volume / M_PI)), inertia_per_mass, mirrors);
}

Resistance resistance_of(const RoundedHull& body) {
  // The most triangles that the panels of a body with three mirror planes leave; with fewer planes panels are joined.
  const int n = static_cast<int>(std::sqrt(double(kPanels[3])));
  return resistance_of(surface_of(body, n), body.volume(), body.inertia_per_mass());
}

} // namespace eccentra::shape
