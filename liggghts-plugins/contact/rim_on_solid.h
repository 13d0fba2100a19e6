// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A rim of a disk as another body's solid sees it: distance, slope and curvature of the distance along the rim.
#pragma once

#include "contact/arc_minimum.h"
#include "contact/contact_core.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace eccentra::contact {

/// Directions of the points on a rim from its centre.
struct RingDirections {
  std::array<double, shape::points_on_rim + 1> cosine, sine;               ///< the last is the first
  std::array<double, shape::points_on_rim> middle_cosine, middle_sine;     ///< half a step on
  static constexpr double step = 2 * M_PI / shape::points_on_rim;          ///< between two points [rad]
  double half_sine = std::sin(step / 2), sagitta = 1 - std::cos(step / 2); ///< of half a step, on a circle of radius 1
  RingDirections() {
    for (int k = 0; k <= shape::points_on_rim; ++k) {
      cosine[k] = std::cos(k % shape::points_on_rim * step);
      sine[k] = std::sin(k % shape::points_on_rim * step);
      if (k < shape::points_on_rim) {
        middle_cosine[k] = std::cos((k + 0.5) * step);
        middle_sine[k] = std::sin((k + 0.5) * step);
      }
    }
  }
};
inline const RingDirections ring_directions; ///< the same for all disks

/// One end of an arc: distance from the solid [m], its slope along the rim, the part of the normal out of the rim's
/// centre, the change of the slope per radian (NaN: not known), and the number of the solid's feature that is closest.
struct RimEnd {
  /// In this order: [m], [-], [-], [1/rad], number.
  double distance, slope, rise, rate, region;
};

/// A rim in the frame of a solid. `to_disk` leads from the solid's centre to the disk's, world axes [m].
class RimOnSolid {
 public:
  RimOnSolid() = default;
  /// `to_disk` leads from the solid's centre to the disk's [m], world axes.
  RimOnSolid(const PosedCore& disk, int rim, const PosedCore& solid, const Eigen::Vector3d& to_disk) : solid_(&solid) {
    const Eigen::Matrix3d turn = solid.rotation.transpose() * disk.rotation;
    const Eigen::Vector3d& half = disk.core->half;
    radius_ = half.x();
    centre_ = solid.rotation.transpose() * to_disk + (rim == 0 ? half.z() : -half.z()) * turn.col(2);
    x_ = half.x() * turn.col(0);
    y_ = half.x() * turn.col(1);
  }
  /// Of the rim [m].
  double radius() const { return radius_; }

  /// Of the rim, in the frame of the solid [m].
  const Eigen::Vector3d& centre() const { return centre_; }
  /// The other body.
  const ContactCore& solid() const { return *solid_->core; }

  /// From the rim's centre to its point k, and as long along the rim there.
  void directions(int k, Eigen::Vector3d& out, Eigen::Vector3d& along) const {
    const double c = ring_directions.cosine[k], s = ring_directions.sine[k];
    out = c * x_ + s * y_;
    along = c * y_ - s * x_;
  }

  /// At least the distance between two neighbours on the rim. The signed distance from a convex solid is convex: it
  /// lies above its tangents, of which each end's serves for its half of the arc.
  double least_between(const RimEnd& from, const RimEnd& to) const {
    const double half_sine = ring_directions.half_sine, sagitta = ring_directions.sagitta;
    return std::min(from.distance +
                        radius_ * (std::min(from.slope, 0.) * half_sine - std::max(from.rise, 0.) * sagitta),
                    to.distance + radius_ * (std::min(-to.slope, 0.) * half_sine - std::max(to.rise, 0.) * sagitta));
  }
  /// Whether the slope between two neighbours surely is monotonic: the same feature of the solid is closest to both,
  /// and the slope changes as it does at the ends.
  static bool monotonic(const RimEnd& from, const RimEnd& to) {
    const double change = to.slope - from.slope, expected = RingDirections::step / 2 * (from.rate + to.rate);
    return from.region == to.region && from.rate * to.rate > 0 && std::abs(change - expected) < 0.1 * std::abs(change);
  }

  /// Where a cubic through the slopes at both ends of an arc and their rates has its root, by one step from the
  /// chord's.
  static double cubic_root(const RimEnd& from, const RimEnd& to) {
    constexpr double h = RingDirections::step;
    const double x = from.slope / (from.slope - to.slope), y = 1 - x, m0 = h * from.rate, m1 = h * to.rate;
    const double value = y * y * ((1 + 2 * x) * from.slope + x * m0) + x * x * ((1 + 2 * y) * to.slope - y * m1);
    const double rate = 6 * x * y * (to.slope - from.slope) + y * (1 - 3 * x) * m0 + x * (1 - 3 * y) * m1;
    return h * (std::clamp(x - value / rate, 0., 1.) - 0.5);
  }

  /// The arc from point k to the next: angles from its middle, within half a step.
  class Arc {
   public:
    /// Keeps a reference to the solid of `rim`.
    Arc(const RimOnSolid& rim, int k)
        : core_(*rim.solid_->core), centre_(rim.centre_), inverse_radius_(1 / rim.radius_),
          out_(ring_directions.middle_cosine[k] * rim.x_ + ring_directions.middle_sine[k] * rim.y_),
          along_(ring_directions.middle_cosine[k] * rim.y_ - ring_directions.middle_sine[k] * rim.x_) {}

    /// Point and normal in the solid's frame.
    RimSample operator()(double angle) const {
      const SmallTurn turn(angle);
      const Eigen::Vector3d out = turn.cosine * out_ + turn.sine * along_,
                            along = turn.cosine * along_ - turn.sine * out_;
      RimSample found;
      found.point.point = centre_ + out;
      if (core_.is_disk())
        of_disk(core_.half, found.point.point, along, out, found);
      else if (core_.solid == SolidKind::box)
        of_box(core_.half, found.point.point, along, out, found);
      else
        of_polyhedron(core_, found.point.point, along, found);
      found.slope *= inverse_radius_;
      found.rate *= inverse_radius_;
      return found;
    }
    /// Slopes of the distance along the rim at low + step .. low + count step [-]; `found` has room for lane_width.
    void slopes(double low, double step, int count, double* found) const {
      if (core_.is_disk())
        slopes_on_disk(low, step, found);
      else
        for (int k = 0; k < count; ++k)
          found[k] = (*this)(low + (k + 1) * step).slope;
    }

   private:
    void slopes_on_disk(double low, double step, double* found) const {
      double sine[lane_width], cosine[lane_width];
      for (int k = 0; k < lane_width; ++k) {
        const SmallTurn turn(low + (k + 1) * step);
        sine[k] = turn.sine;
        cosine[k] = turn.cosine;
      }
      const double radius = core_.half.x(), half_height = core_.half.z(), scale = inverse_radius_;
      const double cx = centre_.x(), cy = centre_.y(), cz = centre_.z(), ox = out_.x(), oy = out_.y(), oz = out_.z(),
                   ax = along_.x(), ay = along_.y(), az = along_.z();
#pragma GCC ivdep
      for (int k = 0; k < lane_width; ++k) {
        const double x = cx + cosine[k] * ox + sine[k] * ax, y = cy + cosine[k] * oy + sine[k] * ay,
                     z = cz + cosine[k] * oz + sine[k] * az;
        const double x1 = cosine[k] * ax - sine[k] * ox, y1 = cosine[k] * ay - sine[k] * oy,
                     z1 = std::copysign(1., z) * (cosine[k] * az - sine[k] * oz);
        const double rho = std::sqrt(x * x + y * y), beside = rho - radius, above = std::fabs(z) - half_height;
        const double rho1 = rho > 0 ? (x * x1 + y * y1) / (rho > 0 ? rho : 1.) : x1;
        const bool corner = (beside > 0) & (above > 0), side = beside > above;
        const double over = 1 / std::sqrt(corner ? beside * beside + above * above : 1.);
        found[k] = scale * (corner ? over * (beside * rho1 + above * z1) : side ? rho1 : z1);
      }
    }

    const ContactCore& core_;
    Eigen::Vector3d centre_;
    double inverse_radius_;
    Eigen::Vector3d out_, along_;
  };

 private:
  /// By their series, for angles of up to half a step.
  struct SmallTurn {
    double sine, cosine;
    explicit SmallTurn(double angle) {
      // Products alone: quotients take most of the time of a loop over pieces.
      constexpr double s3 = 1. / 6, s5 = s3 / 20, s7 = s5 / 42, s9 = s7 / 72, s11 = s9 / 110;
      constexpr double c4 = 1. / 24, c6 = c4 / 30, c8 = c6 / 56, c10 = c8 / 90, c12 = c10 / 132;
      const double q = angle * angle;
      sine = angle * (1 - q * (s3 - q * (s5 - q * (s7 - q * (s9 - q * s11)))));
      cosine = 1 - q * (0.5 - q * (c4 - q * (c6 - q * (c8 - q * (c10 - q * c12)))));
    }
  };
  // Derivatives by the angle: of the point `along`, of that -`out`.
  static void of_disk(const Eigen::Vector3d& half, const Eigen::Vector3d& p, const Eigen::Vector3d& along,
                      const Eigen::Vector3d& out, RimSample& found) {
    const double rho = std::sqrt(p.x() * p.x() + p.y() * p.y()), inverse = rho > 0 ? 1 / rho : 0;
    const double ex = rho > 0 ? p.x() * inverse : 1, ey = p.y() * inverse, up = p.z() < 0 ? -1 : 1;
    const double beside = rho - half.x(), above = up * p.z() - half.z();
    const double rho1 = ex * along.x() + ey * along.y(), z1 = up * along.z();
    const double rho2 = (along.x() * along.x() + along.y() * along.y() - rho1 * rho1) * inverse -
                        (ex * out.x() + ey * out.y()),
                 z2 = -up * out.z();
    if (beside > 0 && above > 0) {
      const double d = std::sqrt(beside * beside + above * above), nb = beside / d, na = above / d;
      found.point.at = {d, {nb * ex, nb * ey, na * up}};
      found.slope = nb * rho1 + na * z1;
      found.rate = (rho1 * rho1 + z1 * z1 - found.slope * found.slope) / d + nb * rho2 + na * z2;
    } else if (beside > above) {
      found.point.at = {beside, {ex, ey, 0}};
      found.slope = rho1;
      found.rate = rho2;
    } else {
      found.point.at = {above, {0, 0, up}};
      found.slope = z1;
      found.rate = z2;
    }
  }
  static void of_box(const Eigen::Vector3d& half, const Eigen::Vector3d& p, const Eigen::Vector3d& along,
                     const Eigen::Vector3d& out, RimSample& found) {
    double beyond[3], square = 0;
    for (int k = 0; k < 3; ++k) {
      beyond[k] = std::abs(p[k]) - half[k];
      if (beyond[k] > 0)
        square += beyond[k] * beyond[k];
    }
    if (square > 0) {
      const double d = std::sqrt(square), inverse = 1 / d;
      double speed = 0;
      found.slope = found.rate = 0;
      for (int k = 0; k < 3; ++k) {
        const double n = beyond[k] > 0 ? std::copysign(beyond[k] * inverse, p[k]) : 0;
        found.point.at.normal[k] = n;
        found.slope += n * along[k];
        found.rate -= n * out[k];
        speed += beyond[k] > 0 ? along[k] * along[k] : 0;
      }
      found.point.at.distance = d;
      found.rate += (speed - found.slope * found.slope) * inverse;
      return;
    }
    const int k = beyond[0] > beyond[1] ? (beyond[0] > beyond[2] ? 0 : 2) : (beyond[1] > beyond[2] ? 1 : 2);
    const double n = p[k] < 0 ? -1 : 1;
    found.point.at.distance = beyond[k];
    found.point.at.normal = n * Eigen::Vector3d::Unit(k);
    found.slope = n * along[k];
    found.rate = -n * out[k];
  }
  static void of_polyhedron(const ContactCore& core, const Eigen::Vector3d& p, const Eigen::Vector3d& along,
                            RimSample& found) {
    found.point.at = distance_to_faces(core, p);
    found.slope = found.point.at.normal.dot(along);
    found.rate = std::numeric_limits<double>::quiet_NaN();
  }

  const PosedCore* solid_ = nullptr;
  double radius_ = 0;
  Eigen::Vector3d centre_, x_, y_; ///< the latter two of the rim's radius [m]
};

} // namespace eccentra::contact
