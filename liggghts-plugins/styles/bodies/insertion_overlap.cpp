// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Narrow-phase overlap tests of clusters under insertion.
#include "styles/bodies/insertion_overlap.h"

#include "contact/gjk.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/private_access.h"

#include "atom.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace {

using namespace LAMMPS_NS;

// The public questions of the list answer with bounding spheres; the bins themselves are protected.
struct NearBins {
  using type = std::vector<Bin<false>> RegionNeighborList<false>::*;
};
struct NearStencil {
  using type = std::vector<int> RegionNeighborList<false>::*;
};

} // namespace

namespace eccentra::styles {
template struct PrivateMember<NearBins, &LAMMPS_NS::RegionNeighborList<false>::bins>;
template struct PrivateMember<NearStencil, &LAMMPS_NS::RegionNeighborList<false>::stencil>;
} // namespace eccentra::styles

namespace eccentra::styles {

namespace {

/// Those sub-spheres of `body` that reach into the ball of this radius about `centre` (body frame).
std::vector<shape::Sphere> spheres_within(const PlacedBody& body, const Eigen::Vector3d& centre, double radius) {
  std::vector<shape::Sphere> within;
  for (const shape::Sphere& s : *body.spheres) {
    const double reach = radius + s.radius;
    if ((s.centre - centre).squaredNorm() <= reach * reach)
      within.push_back(s);
  }
  return within;
}

/// Of the true surfaces, at least one of which is a rounded body's: how deep they overlap [m] where that is deepest
/// (negative: how far they are apart), and the smaller radius there. Cores in each other count as touching.
struct HullOverlap {
  double depth, radius;
};
HullOverlap hull_overlap(const PlacedBody& a, const PlacedBody& b, const Eigen::Vector3d& offset) {
  contact::PosedCore hull, other;
  if (a.surface && b.surface) {
    hull.pose(a.surface->core, a.turn);
    other.pose(b.surface->core, b.turn);
    const double ra = a.surface->core.radius, rb = b.surface->core.radius;
    return {ra + rb - contact::gjk_distance(hull, other, offset), std::min(ra, rb)};
  }
  const PlacedBody &rounded = a.surface ? a : b, &spheres = a.surface ? b : a;
  const double radius = rounded.surface->core.radius;
  hull.pose(rounded.surface->core, rounded.turn);
  const Eigen::Vector3d to_spheres = a.surface ? offset : Eigen::Vector3d(-offset);
  HullOverlap deepest{-std::numeric_limits<double>::max(), radius};
  for (const shape::Sphere& s : *spheres.spheres) {
    const double distance = contact::distance_to(hull, to_spheres + spheres.turn * s.centre).distance;
    if (const double depth = radius + s.radius - distance; depth > deepest.depth)
      deepest = {depth, std::min(radius, s.radius)};
  }
  return deepest;
}

} // namespace

bool bodies_touch(const PlacedBody& a, const PlacedBody& b, const Eigen::Vector3d& offset) {
  const double range = a.bounding_radius + b.bounding_radius;
  if (offset.squaredNorm() > range * range)
    return false;
  if (a.surface || b.surface)
    return hull_overlap(a, b, offset).depth >= 0;
  const std::vector<shape::Sphere> of_a = spheres_within(a, a.turn.transpose() * offset, b.bounding_radius);
  const std::vector<shape::Sphere> of_b = spheres_within(b, b.turn.transpose() * -offset, a.bounding_radius);
  const Eigen::Matrix3d b_to_a = a.turn.transpose() * b.turn;
  const Eigen::Vector3d b_in_a = a.turn.transpose() * offset;
  for (const shape::Sphere& s : of_b) {
    const Eigen::Vector3d centre = b_in_a + b_to_a * s.centre;
    for (const shape::Sphere& t : of_a) {
      const double reach = s.radius + t.radius;
      if ((centre - t.centre).squaredNorm() <= reach * reach)
        return true;
    }
  }
  return false;
}

double deepest_overlap(const PlacedBody& a, const PlacedBody& b, const Eigen::Vector3d& offset) {
  if (a.surface || b.surface) {
    const HullOverlap found = hull_overlap(a, b, offset);
    return std::max(0., found.depth / found.radius);
  }
  double deepest = 0;
  for (const shape::Sphere& s : spheres_within(a, a.turn.transpose() * offset, b.bounding_radius))
    for (const shape::Sphere& t : spheres_within(b, b.turn.transpose() * -offset, a.bounding_radius)) {
      const double distance = (a.turn * s.centre - offset - b.turn * t.centre).norm();
      deepest = std::max(deepest, (s.radius + t.radius - distance) / std::min(s.radius, t.radius));
    }
  return deepest;
}

InsertionOverlap::Place::Place(const double* x) {
  std::memcpy(bits, x, sizeof bits);
}

bool InsertionOverlap::Place::operator==(const Place& other) const {
  return std::memcmp(bits, other.bits, sizeof bits) == 0;
}

std::size_t InsertionOverlap::Hash::operator()(const Place& place) const {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
  std::uint64_t hash = 0;
  for (const std::uint64_t word : place.bits)
    hash = (hash ^ (hash >> 29) ^ word) * odd;
  return hash ^ (hash >> 32);
}

PlacedBody InsertionOverlap::body(int shape_id, const double* quaternion) const {
  const shape::ClusterShape& shape = bodies_.shapes()[shape_id];
  double turn[9];
  contact::rotation_matrix(quaternion, turn);
  const contact::SurfaceSpheres& surface = bodies_.shapes().surface(shape_id);
  return {&shape.spheres(), shape.bounding_radius(),
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(turn), surface.hull ? &surface : nullptr};
}

void InsertionOverlap::take_atoms() {
  clusters_.clear();
  const Atom& atom = bodies_.host_atoms();
  for (int i = 0; i < atom.nlocal + atom.nghost; ++i)
    if (bodies_.shape_id(i) != FixClusterBodies::plain_sphere)
      clusters_.emplace(Place(atom.x[i]), body(bodies_.shape_id(i), bodies_.quaternion(i)));
  current_ = true;
}

bool InsertionOverlap::overlaps(const PlacedBody& ours, const double* x,
                                const LAMMPS_NS::RegionNeighborList<false>& near) {
  if (!current_)
    take_atoms();
  const auto& bins = near.*Published<NearBins>::pointer;
  const auto& stencil = near.*Published<NearStencil>::pointer;
  double position[3] = {x[0], x[1], x[2]};
  const int bin = near.coord2bin(position);
  const Eigen::Map<const Eigen::Vector3d> centre(x);
  for (const int step : stencil)
    for (const auto& there : bins.at(bin + step).particles) {
      const Eigen::Vector3d offset = Eigen::Map<const Eigen::Vector3d>(there.x) - centre;
      const double range = ours.bounding_radius + there.radius;
      if (offset.squaredNorm() > range * range)
        continue;
      const auto found = clusters_.find(Place(there.x));
      if (found != clusters_.end()) {
        if (bodies_touch(ours, found->second, offset))
          return true;
        continue;
      }
      const std::vector<shape::Sphere> sphere = {{Eigen::Vector3d::Zero(), there.radius}};
      if (bodies_touch(ours, {&sphere, there.radius, Eigen::Matrix3d::Identity()}, offset))
        return true;
    }
  return false;
}

void InsertionOverlap::add(const PlacedBody& body, const double* x) {
  clusters_.emplace(Place(x), body);
}

} // namespace eccentra::styles
