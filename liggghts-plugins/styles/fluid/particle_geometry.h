// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the closures may know of a particle: its sphere of equal volume and its shape, for spheres and clusters alike.
#pragma once

#include "closures/drag_laws.h"
#include "closures/effect.h"
#include "closures/oriented_shape.h"
#include "closures/rheology.h"

#include "closures/projected_area.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}
namespace eccentra::styles {
class FixClusterBodies;
}

namespace eccentra::styles {

/// Size and shape of every local atom. A plain sphere is itself; a cluster is the union of its spheres, never its
/// bounding sphere. A "kind" numbers all particles that share shape factors: atom types (from 1), then clusters'
/// shapes.
class ParticleGeometry : public closures::ShapeCatalogue {
 public:
  explicit ParticleGeometry(LAMMPS_NS::LAMMPS* lmp) : lmp_(lmp) {}

  /// Sphericity of plain spheres: one value, or one per atom type (a sphere that stands for another shape).
  void set_sphericity(std::vector<double> per_type) { sphericity_ = std::move(per_type); }
  /// Finds out which shapes the scene has; call at set-up.
  void init();
  /// Brings per-atom data up to date with migration; nothing to do where all particles are plain spheres.
  void refresh();

  /// Radius of the sphere of equal volume of each local atom [m]; valid until atoms move to other rows.
  const double* radius() const;
  /// Kind of each local atom.
  const int* kind() const;
  int kinds() const override;
  closures::ShapeFactors factors(int kind) const override;
  double inertia_factor(int kind) const override;
  double crosswise_sphericity(int i, const double* direction) const override;
  const closures::OrientedShape* oriented(int kind) const override;
  const double* quaternion(int i) const override;

  double volume(int i) const { return closures::sphere_volume(radius_of(i)); }
  double diameter(int i) const { return 2.0 * radius_of(i); }

 private:
  double radius_of(int i) const;

  LAMMPS_NS::LAMMPS* lmp_;
  std::vector<double> sphericity_ = {1.0};
  FixClusterBodies* bodies_ = nullptr; ///< null where no cluster was declared; then nothing below is used
  std::vector<double> radius_;
  std::vector<int> kind_;
  mutable std::vector<std::unique_ptr<closures::ProjectedAreaTable>> areas_; ///< by shape id, made at first use
  mutable std::vector<std::unique_ptr<closures::OrientedShape>> oriented_;   ///< the same
};

} // namespace eccentra::styles
