// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: where bodies touch their walls, what these contacts remember, and how they share damping.
#include "styles/walls/fix_wall_gran_cluster.h"

#include "base/eigen_views.h"
#include "contact/wall_gaps.h"
#include "contact/wall_manifold.h"
#include "styles/bodies/fix_cluster_bodies.h"

#include "atom.h"

#include <algorithm>
#include <cmath>

namespace eccentra::styles {

bool FixWallGranCluster::is_plain_sphere(int i) const {
  return !bodies_ || bodies_->shape_id(i) == FixClusterBodies::plain_sphere;
}

// Rolling models act on plain spheres alone.
bool FixWallGranCluster::moves_like_sphere(int i) const {
  return is_plain_sphere(i) || (!arguments_.rolling && bodies_->is_round(i));
}

void FixWallGranCluster::find_touches(int i) {
  if (meshes_)
    collect_mesh(i);
  else
    collect_primitive(i);
}

void FixWallGranCluster::collect(int i) {
  const std::size_t first = touches_.size();
  find_touches(i);
  if (touches_.size() == first) {
    history_[i].clear();
    return;
  }
  renew_history(i, first);
}

void FixWallGranCluster::renew_history(int i, std::size_t first) {
  contact::WallHistory::Entries& entries = history_[i];
  // As a rule the contacts are those of the last step.
  bool same = entries.size() == touches_.size() - first;
  for (std::size_t m = first; same && m < touches_.size(); ++m)
    same = entries[m - first].key == touches_[m].key;
  if (!same) {
    next_history_.clear();
    for (std::size_t m = first; m < touches_.size(); ++m)
      next_history_.push_back(old_entry(i, touches_[m]));
    entries.swap(next_history_);
  }
  for (std::size_t m = first; m < touches_.size(); ++m)
    touches_[m].history = &entries[m - first];
}

void FixWallGranCluster::collect_primitive(int i) {
  const contact::WallSurface& surface = *arguments_.surface;
  const Eigen::Vector3d x = base::vector3(atom->x[i]);
  const auto touch = [&](int sub, const Eigen::Vector3d& arm, double radius, const contact::WallPoint& point) {
    const double overlap = radius - point.distance;
    const Eigen::Vector3d to_wall = arm - point.distance * point.normal;
    touches_.push_back({i, nullptr, contact::WallContactKey(sub, 0, 0), point.normal,
                        arm - (radius - 0.5 * overlap) * point.normal, to_wall, surface.velocity_at(x + to_wall),
                        surface.angular_velocity(), overlap, radius, arguments_.type, -1});
  };
  if (is_plain_sphere(i)) {
    const contact::WallPoint point = surface.nearest(x);
    if (point.distance < reach_ * atom->radius[i])
      touch(0, Eigen::Vector3d::Zero(), atom->radius[i], point);
    return;
  }
  if (surface.distance(x) >= reach_ * atom->radius[i]) // of the bounding sphere
    return;
  const contact::SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
  const Eigen::Matrix3d rotation = base::row_major(bodies_->rotation(i));
  if (spheres.hull) {
    collect_hull(i, spheres, rotation);
    return;
  }
  gaps_.resize(spheres.count);
  contact::wall_gaps(surface, x, rotation, spheres, gaps_.data());
  for (int k = 0; k < spheres.count; ++k)
    if (gaps_[k] < (reach_ - 1) * spheres.r[k]) {
      const Eigen::Vector3d arm = rotation * Eigen::Vector3d(spheres.x[k], spheres.y[k], spheres.z[k]);
      touch(k, arm, spheres.r[k], surface.nearest(x + arm));
    }
}

void FixWallGranCluster::collect_hull(int i, const contact::SurfaceSpheres& spheres, const Eigen::Matrix3d& rotation) {
  const contact::WallSurface& surface = *arguments_.surface;
  const Eigen::Vector3d x = base::vector3(atom->x[i]);
  posed_.pose(spheres.core, rotation);
  hull_contacts_.clear();
  const contact::ContactBody body{&posed_};
  const contact::WallPoint centre = surface.nearest(x);
  if (surface.is_plane()) {
    contact::plane_contacts(body, centre.normal, centre.distance, hull_contacts_);
  } else {
    const contact::CylinderWall wall{surface.reference() - x, surface.direction(), surface.radius()};
    const bool outside = centre.normal.dot(x - surface.reference()) > 0;
    (outside ? contact::pipe_contacts : contact::hole_contacts)(body, wall, hull_contacts_);
  }
  for (const contact::Contact& c : hull_contacts_) {
    const Eigen::Vector3d to_wall = c.arm - c.distance * c.normal;
    touches_.push_back({i, nullptr, contact::WallContactKey(c.id, 0, 0), c.normal, c.contact_point(), to_wall,
                        surface.velocity_at(x + to_wall), surface.angular_velocity(), c.overlap(), c.radius_a,
                        arguments_.type, -1, c.weight, spheres.core.contact_radius});
  }
}

void FixWallGranCluster::collect_mesh(int i) {
  const Eigen::Vector3d x = base::vector3(atom->x[i]);
  if (is_plain_sphere(i)) {
    meshes_->for_each_near(i, [&](int mesh, int triangle) {
      meshes_->touch(mesh, triangle, i, 0, x, Eigen::Vector3d::Zero(), atom->radius[i], touches_);
    });
    return;
  }
  const contact::SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
  const Eigen::Matrix3d rotation = base::row_major(bodies_->rotation(i));
  if (spheres.hull) {
    posed_.pose(spheres.core, rotation);
    meshes_->touch(i, x, posed_, touches_);
    return;
  }
  gaps_.resize(spheres.count);
  meshes_->for_each_near(i, [&](int mesh, int triangle) {
    const contact::WallSurface plane = meshes_->plane(mesh, triangle);
    if (plane.distance(x) >= atom->radius[i]) // of the bounding sphere
      return;
    contact::wall_gaps(plane, x, rotation, spheres, gaps_.data());
    for (int k = 0; k < spheres.count; ++k)
      if (gaps_[k] < 0.0)
        meshes_->touch(mesh, triangle, i, k, x, rotation * Eigen::Vector3d(spheres.x[k], spheres.y[k], spheres.z[k]),
                       spheres.r[k], touches_);
  });
}

contact::WallHistoryEntry FixWallGranCluster::old_entry(int i, const contact::WallTouch& touch) const {
  const contact::WallHistory::Entries& entries = history_[i];
  for (const contact::WallHistoryEntry& old : entries)
    if (old.key == touch.key)
      return old;
  if (meshes_)
    for (const contact::WallHistoryEntry& old : entries)
      if (old.key.sub() == touch.key.sub() && old.key.mesh() == touch.key.mesh() &&
          meshes_->coplanar(touch.key.mesh(), old.key.triangle(), touch.key.triangle()))
        return {touch.key, old.shear, old.rolling, old.more};
  return {touch.key, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

} // namespace eccentra::styles
