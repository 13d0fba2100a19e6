// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that the rolling tests share: spheres of 6.35 mm on planes, with the gravity of a slope.
#pragma once

#include "support/liggghts_session.h"

#include <mpi.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <sstream>
#include <string>

namespace eccentra::test {

constexpr double kDiameter = 6.35e-3; // m
constexpr double kRadius = kDiameter / 2;
constexpr double kDensity = 2619; // kg/m3
constexpr double kGravity = 9.81; // m/s2
constexpr double kPi = 3.14159265358979323846;

/// What a rolling scene is made of.
struct RollingScene {
  std::string model = "shape";       ///< word after rolling_friction
  std::string arguments;             ///< arguments of the model that follow it
  std::string pair_arguments;        ///< arguments that pair_style alone takes: the shape of eccentric
  double mu_r = 0;                   ///< coefficientRollingFriction
  double mu_shape = 0.1;             ///< shapeRollingFriction
  double mu_s = 0.5;                 ///< Coulomb
  double restitution = 0.5;          ///< [-]
  double youngs = 1e7;               ///< Pa
  double timestep = 1e-5;            ///< s
  Eigen::Vector3d gravity{0, 0, -1}; ///< in units of kGravity
  std::string box = "-0.5 0.5 -0.05 0.05 -0.01 0.1";
  std::string boundary = "f f f";
  std::string walls = "primitive type 1 zplane 0.0"; ///< arguments of one wall; empty: none
};

inline std::string number(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// The arguments that tell pair and walls which contact model to use.
inline std::string model_arguments(const RollingScene& scene) {
  return "model hertz tangential history rolling_friction " + scene.model;
}

/// One wall fix; LIGGGHTS wants the arguments of the model after the wall.
inline std::string wall_line(const RollingScene& scene, const std::string& id, const std::string& wall) {
  return "fix " + id + " all wall/gran " + model_arguments(scene) + " " + wall + " " + scene.arguments + "\n";
}

/// Everything up to, and without, particles and integration.
inline std::string materials(const RollingScene& scene) {
  return "fix m1 all property/global youngsModulus peratomtype " + number(scene.youngs) +
         "\nfix m2 all property/global poissonsRatio peratomtype 0.25"
         "\nfix m3 all property/global coefficientRestitution peratomtypepair 1 " +
         number(scene.restitution) + "\nfix m4 all property/global coefficientFriction peratomtypepair 1 " +
         number(scene.mu_s) + "\nfix m5 all property/global coefficientRollingFriction peratomtypepair 1 " +
         number(scene.mu_r) + "\nfix m6 all property/global shapeRollingFriction peratomtypepair 1 " +
         number(scene.mu_shape) + "\n";
}

inline std::string forces(const RollingScene& scene) {
  const double size = scene.gravity.norm() * kGravity;
  std::string text = "pair_style gran " + model_arguments(scene) + " " + scene.arguments + " " + scene.pair_arguments +
                     "\npair_coeff * *\ntimestep " + number(scene.timestep) + "\n";
  if (size > 0)
    text += "fix gravity all gravity " + number(size) + " vector " + number(scene.gravity[0]) + " " +
            number(scene.gravity[1]) + " " + number(scene.gravity[2]) + "\n";
  if (!scene.walls.empty())
    text += wall_line(scene, "floor", scene.walls);
  return text;
}

inline std::string settings(const RollingScene& scene) {
  return "atom_style granular\natom_modify map array\nboundary " + scene.boundary +
         "\nnewton off\ncommunicate single vel yes\nunits si\n";
}

inline std::string rolling_scene(const RollingScene& scene) {
  return settings(scene) + "region box block " + scene.box +
         " units box\ncreate_box 1 box\nneighbor 0.002 bin\nneigh_modify delay 0\n" + materials(scene) + forces(scene);
}

/// A sphere at a place; `create_atoms` numbers them in order.
inline std::string sphere_at(const Eigen::Vector3d& x) {
  return "create_atoms 1 single " + number(x[0]) + " " + number(x[1]) + " " + number(x[2]) + " units box\n";
}

inline std::string spheres_done() {
  return "set group all diameter " + number(kDiameter) + " density " + number(kDensity) +
         "\nfix integrate all nve/sphere\n";
}

/// Overlap [m] with a plane under which the Hertz force of `scene` carries `weight` [N].
inline double resting_overlap(const RollingScene& scene, double weight) {
  const double effective = scene.youngs / (2 * (1 - 0.25 * 0.25)); // both partners alike
  return std::pow(weight / (4.0 / 3.0 * effective * std::sqrt(kRadius)), 2.0 / 3.0);
}

inline double sphere_mass() {
  return kDensity * kPi / 6 * std::pow(kDiameter, 3);
}

/// State of an atom, known on all ranks.
struct SphereState {
  Eigen::Vector3d x, v, omega;
};

inline SphereState sphere(LiggghtsSession& session, int tag) {
  double state[9] = {};
  const int i = session.local(tag);
  if (i >= 0) {
    for (int k = 0; k < 3; ++k) {
      state[k] = session.atom().x[i][k];
      state[3 + k] = session.atom().v[i][k];
      state[6 + k] = session.atom().omega[i][k];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, state, 9, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  using Vector = Eigen::Map<Eigen::Vector3d>;
  return {Vector(state), Vector(state + 3), Vector(state + 6)};
}

/// Gives an atom a velocity and a spin.
inline void set_motion(LiggghtsSession& session, int tag, const Eigen::Vector3d& v, const Eigen::Vector3d& omega) {
  const int i = session.local(tag);
  if (i < 0)
    return;
  for (int k = 0; k < 3; ++k) {
    session.atom().v[i][k] = v[k];
    session.atom().omega[i][k] = omega[k];
  }
}

inline void run(LiggghtsSession& session, long steps) {
  session.command("run " + std::to_string(steps));
}

} // namespace eccentra::test
