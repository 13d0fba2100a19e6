// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of clusters that roll: rows of equal spheres on an axle, which roll as one sphere does, however many they are.
#pragma once

#include "base/linear_algebra.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/rolling/rolling_scene.h"

#include <vector>

namespace eccentra::test {

/// A rolling model as pairs and walls of clusters take it.
struct ClusterModel {
  const char* name;
  const char* model;     ///< after rolling_friction
  const char* arguments; ///< that follow it
  /// At rest under a load below the bound: it holds to round-off, swings about rest, or creeps by its chatter.
  enum Rest { holds, swings, creeps } rest;
};

inline const std::vector<ClusterModel>& cluster_models() {
  static const std::vector<ClusterModel> models = {{"limited", "shape", "form limited", ClusterModel::holds},
                                                   {"spring", "shape", "form epsd", ClusterModel::holds},
                                                   {"directional", "shape", "form directional", ClusterModel::creeps},
                                                   {"cdt", "cdt", "", ClusterModel::creeps},
                                                   {"epsd", "epsd", "", ClusterModel::holds},
                                                   {"epsd2", "epsd2", "", ClusterModel::swings},
                                                   {"epsd3", "epsd3", "", ClusterModel::holds},
                                                   {"luding", "luding", "", ClusterModel::swings}};
  return models;
}

/// The scene of a model with the coefficient mu in the place where the model reads it.
inline RollingScene scene_of(const ClusterModel& model, double mu) {
  RollingScene scene;
  scene.model = model.model;
  scene.arguments = model.arguments;
  const bool ours = scene.model == "shape";
  scene.mu_shape = ours ? mu : 0;
  scene.mu_r = ours ? 0 : mu;
  return scene;
}

/// What stock's spring models read.
inline std::string springs(double damping_ratio = 0.3) {
  return "fix s1 all property/global coefficientRollingViscousDamping peratomtypepair 1 " + number(damping_ratio) +
         "\nfix s2 all property/global rollingStiffness scalar 2.25\n"
         "fix s3 all property/global coeffRollingStiffness peratomtypepair 1 0.3\n";
}

/// Pairs, the floor and what moves bodies; `options` are those of pairs and floor alike.
inline std::string cluster_forces(const RollingScene& scene, const std::string& options) {
  const std::string models = model_arguments(scene) + " " + scene.arguments + " " + options + " ";
  std::string text =
      "pair_style gran/cluster " + models + "\npair_coeff * *\ntimestep " + number(scene.timestep) + "\n";
  if (const double size = scene.gravity.norm() * kGravity; size > 0)
    text += "fix gravity all gravity " + number(size) + " vector " + number(scene.gravity[0]) + " " +
            number(scene.gravity[1]) + " " + number(scene.gravity[2]) + "\n";
  if (!scene.walls.empty())
    text += "fix floor all wall/gran/cluster " + models + scene.walls + "\n";
  return text;
}

inline void open_cluster_scene(LiggghtsSession& session, const RollingScene& scene, const std::string& options,
                               double damping_ratio = 0.3) {
  session.script(settings(scene) + "region box block " + scene.box +
                 " units box\ncreate_box 1 box\nneighbor 0.002 bin\nneigh_modify delay 0\n" + materials(scene) +
                 springs(damping_ratio) + cluster_forces(scene, options) + "fix integrate all nve/cluster\n");
}

/// `count` spheres of kRadius beside each other, each touching the next.
inline shape::ClusterShape roller(int count) {
  std::vector<shape::Sphere> spheres;
  double spread = 0; // mean square distance along the axle
  for (int k = 0; k < count; ++k) {
    const double y = (k - 0.5 * (count - 1)) * kDiameter;
    spheres.push_back({Eigen::Vector3d(0, y, 0), kRadius});
    spread += y * y / count;
  }
  const double about_axle = 0.4 * kRadius * kRadius;
  shape::MassProperties properties;
  properties.volume = count * kPi / 6 * std::pow(kDiameter, 3);
  properties.surface = count * kPi * kDiameter * kDiameter;
  properties.centre.setZero();
  properties.inertia_per_mass = Eigen::Vector3d(about_axle + spread, about_axle, about_axle + spread).asDiagonal();
  return {"roller " + std::to_string(count), spheres, properties};
}

/// Adds a body; returns its tag. Orientation is one of the shape's own frame.
inline int add_cluster(LiggghtsSession& session, const shape::ClusterShape& shape, const Eigen::Vector3d& x,
                       const Eigen::Quaterniond& q = Eigen::Quaterniond::Identity()) {
  session.script(sphere_at(x));
  const int tag = static_cast<int>(session.atom().natoms);
  styles::FixClusterBodies& bodies = styles::FixClusterBodies::require(&session.lammps());
  const int id = bodies.shapes().add(shape);
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  if (const int i = session.local(tag); i >= 0) {
    for (int k = 0; k < 3; ++k)
      session.atom().x[i][k] = x[k];
    bodies.make_body(i, id, kDensity, wxyz);
  }
  return tag;
}

/// Adds a roller whose axle is along y.
inline int add_roller(LiggghtsSession& session, int count, const Eigen::Vector3d& x) {
  const shape::ClusterShape shape = roller(count);
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  if (count > 1)
    q = eccentra::base::rotation_between(shape.spheres()[1].centre - shape.spheres()[0].centre,
                                         Eigen::Vector3d::UnitY());
  return add_cluster(session, shape, x, q);
}

/// A roller on the floor, as deep as its weight presses it. Returns its tag.
inline int add_roller_on_floor(LiggghtsSession& session, const RollingScene& scene, int count) {
  const double weight = -scene.gravity[2] * kGravity * sphere_mass(); // of each sphere
  return add_roller(session, count, {0, 0, kRadius - resting_overlap(scene, weight)});
}

} // namespace eccentra::test
