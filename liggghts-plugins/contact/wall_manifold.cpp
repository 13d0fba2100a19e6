// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Walls: each is a distance function of points, which lines meet as they meet a solid.
#include "contact/wall_manifold.h"

#include "contact/arc_minimum.h"
#include "contact/hand_over.h"
#include "contact/rim_on_solid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace eccentra::contact {

using Eigen::Vector3d;

namespace {

/// Contacts of one body with one wall, under construction.
template <typename Distance> class WallContacts {
 public:
  WallContacts(const ContactBody& body, const Distance& distance, std::vector<Contact>& contacts)
      : posed_(*body.posed), core_(*body.posed->core), extra_(body.extra), distance_(distance), contacts_(contacts),
        first_(contacts.size()) {}

  void take_points() {
    at_.resize(core_.points);
    contact_of_.assign(core_.points, -1);
    for (int k = 0; k < core_.points; ++k) {
      const Vector3d p = posed_.point(k);
      at_[k] = distance_(p);
      const double reach = (core_.solid == SolidKind::none ? core_.point_radius[k] : core_.radius) + extra_;
      if (at_[k].distance >= reach)
        continue;
      contact_of_[k] = static_cast<int>(contacts_.size());
      contacts_.push_back({k, false, p, at_[k].normal, at_[k].distance, reach, reach, 1});
    }
  }

  /// Points alone, where nothing else needs to know them.
  void take_points_alone() {
    for (int k = 0; k < core_.points; ++k) {
      const Vector3d p = posed_.point(k);
      const shape::CoreDistance at = distance_(p);
      const double reach = (core_.solid == SolidKind::none ? core_.point_radius[k] : core_.radius) + extra_;
      if (at.distance < reach)
        contacts_.push_back({k, false, p, at.normal, at.distance, reach, reach, 1});
    }
  }

  /// The closest or farthest point of each arc of a disk's rims.
  void take_arcs() {
    const double reach = core_.radius + extra_, step = 2 * M_PI / core_.ring;
    for (int rim_number = 0; rim_number < core_.rims; ++rim_number) {
      const Rim rim(posed_, rim_number);
      for (int k = 0; k < core_.ring; ++k) {
        const int from = rim_number * core_.ring + k, to = rim_number * core_.ring + (k + 1) % core_.ring;
        const double least = (at_[from].distance + at_[to].distance - core_.half.x() * step) / 2;
        if (least >= reach)
          continue;
        const auto slope_at = [&](int point, int number) {
          const Vector3d along = ring_directions.cosine[number] * rim.y - ring_directions.sine[number] * rim.x;
          return at_[point].normal.dot(along) / core_.half.x();
        };
        const double angle = k * step, slope_from = slope_at(from, k), slope_to = slope_at(to, k + 1);
        extremes_.clear();
        extremes_on_arc(angle, slope_from, angle + step, slope_to, 1, Sample{rim, distance_, core_.half.x()},
                        extremes_);
        if (extremes_.empty())
          continue;
        const ArcSpring spring({reach - at_[from].distance, reach - at_[to].distance}, {slope_from, slope_to},
                               extremes_, reach);
        for (int end = 0; end < 2; ++end)
          if (const int own = contact_of_[end == 0 ? from : to]; own >= 0)
            contacts_[own].weight -= spring.loss[end];
        const shape::CoreDistance& at = extremes_[0].point.at;
        if (spring.share > no_weight && at.distance < reach)
          contacts_.push_back({core_.line_feature(from), !extremes_[0].closest, extremes_[0].point.point, at.normal,
                               at.distance, reach, reach, extremes_[0].closest ? spring.share : -spring.share});
      }
    }
  }

  /// A line's closest point in its inside, with vertices as its ends.
  template <int ends>
  void add_line(int feature, const Vector3d& point, const shape::CoreDistance& at, const int (&end)[ends]) {
    const double reach = core_.radius + extra_;
    if (at.distance >= reach)
      return;
    double end_overlap[ends];
    for (int k = 0; k < ends; ++k)
      end_overlap[k] = reach - at_[end[k]].distance;
    const HandOver<ends> share(reach - at.distance, end_overlap);
    for (int k = 0; k < ends; ++k)
      if (share.loss[k] > 0)
        contacts_[contact_of_[end[k]]].weight -= share.loss[k];
    if (share.line <= no_weight)
      return;
    contacts_.push_back({feature, false, point, at.normal, at.distance, reach, reach, share.line});
  }

  /// A disk's side, whose ends are its rims.
  void add_side(const Vector3d& point, const shape::CoreDistance& at) {
    const double reach = core_.radius + extra_;
    if (at.distance >= reach)
      return;
    int closest[2] = {-1, -1};
    for (std::size_t k = first_; k < contacts_.size(); ++k) {
      const int feature = contacts_[k].id;
      const int rim = (feature < core_.points ? feature : feature - core_.points) / core_.ring;
      if (closest[rim] < 0 || contacts_[k].distance < contacts_[closest[rim]].distance)
        closest[rim] = static_cast<int>(k);
    }
    double end_overlap[2];
    for (int k = 0; k < 2; ++k)
      end_overlap[k] = closest[k] < 0 ? 0 : contacts_[closest[k]].overlap();
    const HandOver<2, 2> share(reach - at.distance, end_overlap);
    for (int k = 0; k < 2; ++k)
      if (share.loss[k] > 0)
        contacts_[closest[k]].weight -= share.loss[k];
    if (share.line > no_weight)
      contacts_.push_back({core_.axis_feature(), false, point, at.normal, at.distance, reach, reach, share.line});
  }

  /// Drops what has been handed over.
  void finish() {
    std::size_t kept = first_;
    for (std::size_t k = first_; k < contacts_.size(); ++k) {
      Contact c = contacts_[k];
      if (std::abs(c.weight) < no_weight)
        continue;
      c.elastic = c.weight < 0;
      contacts_[kept++] = c;
    }
    contacts_.resize(kept);
  }

 private:
  /// A rim's points as the wall sees them.
  struct Sample {
    const Rim& rim;
    const Distance& distance;
    double unit; ///< radius of the rim
    RimSample operator()(double angle) const {
      const double cosine = std::cos(angle), sine = std::sin(angle);
      const Vector3d out = cosine * rim.x + sine * rim.y, along = cosine * rim.y - sine * rim.x;
      const Vector3d point = rim.centre + out;
      const shape::CoreDistance at = distance(point);
      return {{point, at}, at.normal.dot(along) / unit, distance.rate(point, along, out) / unit};
    }
    void slopes(double low, double step, int count, double* found) const {
      for (int k = 0; k < count; ++k)
        found[k] = (*this)(low + (k + 1) * step).slope;
    }
  };

  const PosedCore& posed_;
  const ContactCore& core_;
  double extra_;
  const Distance& distance_;
  std::vector<Contact>& contacts_;
  std::size_t first_;
  std::vector<shape::CoreDistance> at_;
  std::vector<int> contact_of_;
  std::vector<ArcExtreme> extremes_;
};

/// Where the line from + t along is closest to an infinite axis through `on_axis`; false where they are parallel.
bool closest_to_axis(const Vector3d& from, const Vector3d& along, const Vector3d& on_axis, const Vector3d& direction,
                     double& t) {
  const Vector3d r = from - on_axis, across = along - along.dot(direction) * direction,
                 r_across = r - r.dot(direction) * direction;
  const double square = across.squaredNorm();
  if (square <= 1e-9 * along.squaredNorm())
    return false;
  t = -r_across.dot(across) / square;
  return true;
}

/// Distance of a point, and the second derivative of the distance along a circle: of the point `along` is the first
/// derivative by the angle, minus `out` the second.
struct PlaneDistance {
  const Vector3d& normal;
  double height; ///< of the body's centre
  shape::CoreDistance operator()(const Vector3d& point) const { return {height + normal.dot(point), normal}; }
  double rate(const Vector3d&, const Vector3d&, const Vector3d& out) const { return -normal.dot(out); }
};
struct CylinderDistance {
  const CylinderWall& wall;
  double side; ///< 1 outside of it, -1 inside
  Vector3d from_axis(const Vector3d& r) const { return r - r.dot(wall.direction) * wall.direction; }
  shape::CoreDistance operator()(const Vector3d& point) const {
    const Vector3d radial = from_axis(point - wall.to_axis);
    const double rho = radial.norm();
    return {side * (rho - wall.radius),
            rho > 0 ? Vector3d(side / rho * radial) : Vector3d(wall.direction.unitOrthogonal())};
  }
  double rate(const Vector3d& point, const Vector3d& along, const Vector3d& out) const {
    const Vector3d radial = from_axis(point - wall.to_axis);
    const double rho = radial.norm(), first = radial.dot(along) / rho;
    return side * ((from_axis(along).squaredNorm() - first * first) / rho - radial.dot(out) / rho);
  }
};

/// A wall that no edge of a body touches between its ends: a plane, or a cylinder from inside.
template <class Distance>
void flat_or_hollow(const ContactBody& body, const Distance& distance, std::vector<Contact>& contacts) {
  WallContacts<Distance> wall(body, distance, contacts);
  if (!body.posed->core->is_disk()) {
    wall.take_points_alone();
    return;
  }
  wall.take_points();
  wall.take_arcs();
  wall.finish();
}

} // namespace

void plane_contacts(const ContactBody& body, const Vector3d& normal, double height, std::vector<Contact>& contacts) {
  flat_or_hollow(body, PlaneDistance{normal, height}, contacts);
}

void hole_contacts(const ContactBody& body, const CylinderWall& cylinder, std::vector<Contact>& contacts) {
  flat_or_hollow(body, CylinderDistance{cylinder, -1}, contacts);
}

void pipe_contacts(const ContactBody& body, const CylinderWall& cylinder, std::vector<Contact>& contacts) {
  const CylinderDistance distance{cylinder, 1};
  const PosedCore& posed = *body.posed;
  const ContactCore& core = *posed.core;
  WallContacts<CylinderDistance> wall(body, distance, contacts);
  wall.take_points();
  double t = 0;
  for (std::size_t k = 0; k < core.edges.size(); ++k) {
    const auto& edge = core.edges[k];
    const Vector3d from = posed.point(edge[0]), along = posed.point(edge[1]) - from;
    if (!closest_to_axis(from, along, cylinder.to_axis, cylinder.direction, t) || t <= 0 || t >= 1)
      continue;
    const Vector3d on = from + t * along;
    wall.add_line<2>(core.line_feature(static_cast<int>(k)), on, distance(on), {edge[0], edge[1]});
  }
  if (core.is_disk()) {
    wall.take_arcs();
    const Vector3d up = core.half.z() * posed.rotation.col(2);
    if (core.has_axis() && closest_to_axis(-up, 2 * up, cylinder.to_axis, cylinder.direction, t) && t > 0 && t < 1) {
      const Vector3d on = (2 * t - 1) * up;
      shape::CoreDistance at = distance(on);
      at.distance -= core.half.x();
      wall.add_side(on - core.half.x() * at.normal, at);
    }
  }
  wall.finish();
}

} // namespace eccentra::contact
