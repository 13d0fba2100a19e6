// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a wall turns: LIGGGHTS tells contact models the wall's velocity but not its spin.
#pragma once

#include <mpi.h>

#include <Eigen/Core>

namespace LAMMPS_NS {
class TriMesh;
class FixWallGran;
} // namespace LAMMPS_NS
namespace LIGGGHTS {
class IContactHistorySetup;
}

namespace eccentra::styles {

/// For wall fixes of ours that are no stock FixWallGran or that turn in ways of their own.
class TurningWall {
 public:
  virtual ~TurningWall() = default;
  /// Angular velocity of the wall, world frame [rad/s].
  virtual Eigen::Vector3d wall_spin() const = 0;
};

/// The spin of the wall that a contact model belongs to.
class WallSpin {
 public:
  /// `owner`: what the contact model got as its set-up of history, which for walls is the wall fix itself.
  explicit WallSpin(LIGGGHTS::IContactHistorySetup* owner);
  /// Looks again at what moves; call once per run.
  void refresh();
  /// Spin [rad/s] at a contact: of triangle `triangle` of `mesh`, or of the primitive wall if `mesh` is null.
  Eigen::Vector3d at(LAMMPS_NS::TriMesh* mesh, int triangle) const;

 private:
  const TurningWall* turning_;
  LAMMPS_NS::FixWallGran* stock_;
  Eigen::Vector3d primitive_ = Eigen::Vector3d::Zero();
};

/// Spin [rad/s] of a rigid triangle from the positions [m] and velocities [m/s] of its nodes.
Eigen::Vector3d triangle_spin(const Eigen::Vector3d (&position)[3], const Eigen::Vector3d (&velocity)[3]);

} // namespace eccentra::styles
