// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Rolling friction at walls: one interface, in which a model sees the spin relative to the wall, however the wall
// turns.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::base {
class OptionReader;
}

namespace eccentra::styles {

/// One contact as a rolling model sees it. World frame, SI.
struct WallRollingContact {
  int atom;                         ///< local index
  int atom_type;                    ///< material of the particle
  int wall_type;                    ///< material of the wall
  double mass;                      ///< [kg]
  double stiffness;                 ///< kn, secant [N/m]
  double elastic_normal;            ///< kn overlap [N]
  double lever;                     ///< effective radius of eq (19): of the (sub-)sphere [m]
  Eigen::Vector3d normal;           ///< unit, from the wall to the particle
  Eigen::Vector3d angular_velocity; ///< of the particle relative to the wall [rad/s]
  Eigen::Vector3d wall_spin;        ///< angular velocity of the wall [rad/s]
  double* memory;                   ///< 3 values that this contact keeps from step to step; they migrate and restart
  bool advance;                     ///< false while setting up: memory is to be read only
  double normal_force;              ///< F_n with its dashpot [N]
  double tangential_stiffness;      ///< kt [N/m]
  double normal_damping;            ///< gamma_n [N s/m]
  double tangential_damping;        ///< gamma_t [N s/m]
};

/// A rolling-friction model at walls.
class WallRolling {
 public:
  virtual ~WallRolling() = default;
  /// Reads one keyword of this model with its value; false, with nothing read, where the next word is none of them.
  virtual bool read_keyword(base::OptionReader& reader) = 0;
  /// Before each run: fetch coefficients. Throws std::invalid_argument with one sentence where that is not possible.
  virtual void init(LAMMPS_NS::LAMMPS* lmp) = 0;
  /// False for a model that stands for the shape of a particle, and so acts on plain spheres alone.
  virtual bool for_clusters() const { return true; }
  /// Torque on the particle [N m]. Called once per contact and step.
  virtual Eigen::Vector3d torque(const WallRollingContact& contact) = 0;
};

using WallRollingCreator = std::function<std::unique_ptr<WallRolling>()>;

/// Models by the word that follows rolling_friction.
std::map<std::string, WallRollingCreator>& wall_rolling_models();

/// Announces a model when the library is loaded: one static object beside the model's code.
struct RegisterWallRolling {
  RegisterWallRolling(const char* word, WallRollingCreator creator) {
    wall_rolling_models()[word] = std::move(creator);
  }
};

} // namespace eccentra::styles
