// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Overlap tests while stock fix insert/* places clusters: sub-sphere against sub-sphere instead of bounding spheres.
#pragma once

#include "contact/surface_spheres.h"
#include "shape/cluster_shape.h"

#include <Eigen/Core>

#include <mpi.h>

#include "region_neighbor_list.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace eccentra::styles {

class FixClusterBodies;

/// What `orientation` of the fix insert/* at work says: nothing, random, or the same for all (template, constant).
enum class InsertionOrientation { not_written, random, fixed };

/// A body at its place. All its sub-spheres count, inner ones too: nothing may be put inside a body.
struct PlacedBody {
  const std::vector<shape::Sphere>* spheres;        ///< body frame [m]
  double bounding_radius;                           ///< about the centre [m]
  Eigen::Matrix3d turn;                             ///< body to world
  const contact::SurfaceSpheres* surface = nullptr; ///< of a rounded body
};

/// True if any sub-sphere of A touches one of B, or the true surfaces where one is a rounded body, whose centre is at
/// `offset` from A's [m], world frame.
bool bodies_touch(const PlacedBody& a, const PlacedBody& b, const Eigen::Vector3d& offset);

/// The deepest overlap of their sub-spheres or rounded surfaces, as part of the smaller radius; 0 where none touches.
double deepest_overlap(const PlacedBody& a, const PlacedBody& b, const Eigen::Vector3d& offset);

/// Bodies that a new one must not run into. Stock's list of what is near an insertion knows positions and bounding
/// radii alone; it serves as the broad phase, and this looks up what stands at a position: a cluster that was there
/// before, one that has just been placed, or else a plain sphere.
class InsertionOverlap {
 public:
  explicit InsertionOverlap(FixClusterBodies& bodies) : bodies_(bodies) {}

  InsertionOrientation orientation = InsertionOrientation::not_written; ///< of the fix insert/* at work

  /// A new round of insertion begins: forgets what was placed, and takes the atoms of this rank (ghosts as well) anew
  /// at the next question.
  void begin() { current_ = false; }
  /// A body of this shape with this orientation (w x y z, body to world), about to be placed.
  PlacedBody body(int shape_id, const double* quaternion) const;
  /// True if it would touch anything, were its centre at x [m].
  bool overlaps(const PlacedBody& body, const double* x, const LAMMPS_NS::RegionNeighborList<false>& near);
  /// Remembers it as placed at x.
  void add(const PlacedBody& body, const double* x);

 private:
  /// The exact place of a centre, all bits of it.
  struct Place {
    explicit Place(const double* x);
    bool operator==(const Place& other) const;
    std::uint64_t bits[3];
  };
  struct Hash {
    std::size_t operator()(const Place& place) const;
  };

  void take_atoms();

  FixClusterBodies& bodies_;
  bool current_ = false;
  std::unordered_map<Place, PlacedBody, Hash> clusters_;
};

} // namespace eccentra::styles
