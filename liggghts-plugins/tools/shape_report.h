// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What clusterShape says about a shape: numbers first, then text, JSON or LIGGGHTS lines.
#pragma once

#include "shape/cluster_shape.h"
#include "shape/eccentricity.h"
#include "shape/note.h"
#include "shape/resistance.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace eccentra::shape {

/// Everything measured about one shape. The partner of `cluster` is the shape itself unless another one is given.
struct ShapeReport {
  ClusterShape shape;
  EccentricityDistribution plane, sphere, surface, cluster;
  std::string partner; ///< name of the cluster met
  Resistance resistance;
  Notes notes;
};

ShapeReport measure(const ClusterShape& shape, const ClusterShape& partner);

/// The value that clusterShape offers as mu_shape of eq (33): the mean of delta_e / R_eq against a plane.
double default_mu_shape(const ShapeReport& report);

/// JSON object with the keys name, spheres, volume, equivalent_radius, bounding_radius, sphericity, centre, inertia,
/// eccentricity, mu_shape, resistance and more of the same kind; SI units, eccentricities in units of R_eq.
nlohmann::json to_json(const ShapeReport& report);

/// Table for people.
std::string to_text(const ShapeReport& report);

/// Both shapes side by side with the ratio of every number.
std::string compare_text(const ShapeReport& a, const ShapeReport& b);

/// Which estimate of mu_shape a user asks for.
struct MuShapeChoice {
  std::string partner = "plane"; ///< plane, sphere, surface or cluster
  std::string estimate = "mean"; ///< min, mean, max, a probability such as 0.9, or paper
};
/// Throws std::invalid_argument for an unknown partner or estimate.
double mu_shape(const ShapeReport& report, const MuShapeChoice& choice);

/// Which pairs of atom types a LIGGGHTS line is for.
struct PairTypes {
  int types = 1;    ///< number of atom types in the script
  int own = 1;      ///< the one that has the shape
  double mu_r = -1; ///< mu_r of eq (33), for every pair; < 0: no line for it
};

/// LIGGGHTS input: fix property/global shapeRollingFriction peratomtypepair, with mu_shape where type `own` is one of
/// the pair and 0 elsewhere, and coefficientRollingFriction where mu_r is given. Throws std::invalid_argument where own
/// is not one of the types.
std::string property_lines(const ShapeReport& report, const MuShapeChoice& choice, const PairTypes& pairs);

} // namespace eccentra::shape
