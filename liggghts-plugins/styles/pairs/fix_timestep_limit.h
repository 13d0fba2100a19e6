// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix timestep/limit: how large the time step may be, from the contacts that there are and the impacts that may come.
#pragma once

#include "contact/shared_contacts.h"
#include "contact/timestep_limit_formula.h"
#include "styles/bodies/contact_materials.h"
#include "styles/models/stock_contact.h"

#include <mpi.h>

#include "fix.h"

#include <string>
#include <vector>

namespace eccentra::styles {

class FixClusterBodies;

/// Scalar: critical step [s] (inf where nothing touches or moves). Vector: (1) critical step, (2) step / critical step,
/// (3) step that the safety factor allows [s], (4) tag of the body that sets the limit (0: an impact to come),
/// (5) contacts of that body, (6) the largest (2) of all evaluations since the fix was made, (7) the step of that one.
/// Between evaluations these are the values of the last one.
class FixTimestepLimit : public LAMMPS_NS::Fix {
 public:
  FixTimestepLimit(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  void post_run() override;

 private:
  struct Limit {
    double step;
    int tag;   ///< of the body; 0: an impact to come
    int shape; ///< -1: plain sphere
    int contacts;
  };

  [[noreturn]] void fail(const std::string& sentence);
  void evaluate();
  void add_body_contacts(std::vector<contact::BodyStiffness>& bodies);
  void add_wall_contacts(std::vector<contact::BodyStiffness>& bodies);
  void add_pair(int i, int j, std::vector<contact::BodyStiffness>& bodies);
  double exponent() const;
  void stock_stiffness(int m, int type, int other, double radius_a, double radius_b);
  /// Writes what damping needs of the bodies of a pair, `apart` from i's centre to j's.
  void set_impact(int i, int j, const Eigen::Vector3d& apart);
  Limit limit_of_contacts();
  Limit limit_of_impacts();
  Eigen::Matrix3d inertia(int i) const;
  contact::ContactStiffness stiffness_of_impact(int type, double radius, double mass, double speed);
  std::string describe(const Limit& limit) const;
  void report(const Limit& limit);
  /// To screen and log. `to_host`: also to the terminal, where a solver hosts us and keeps the screen for itself.
  void say(const std::string& line, bool to_host) const;

  double safety_ = 0.3;
  double speed_ = 0.0; ///< of impacts that the user expects [m/s]
  bool enforce_ = false;
  Limit limit_{};
  double worst_ = 0; ///< largest step / critical step of all evaluations
  LAMMPS_NS::bigint worst_at_ = 0;
  std::string worst_of_;  ///< what set it
  double said_worst_ = 0; ///< at the end of the last run
  double reported_ = 0.0; ///< critical step of the last report
  FixClusterBodies* bodies_ = nullptr;
  const contact::ContactModel* model_ = nullptr;
  contact::DampingChoice damping_;
  StockContact* stock_ = nullptr; ///< of the pair style, where it has LIGGGHTS's own models
  std::vector<double> no_history_;
  ContactMaterials materials_;
  bool pair_shares_ = false;
  /// Sub-contacts of the pair at hand: normal from B to A, arm from A's centre to the contact point.
  struct Touching {
    Eigen::Vector3d n, arm;
    double overlap, contact_radius, radius_a, radius_b;
  };
  std::vector<Touching> touching_;
  std::vector<int> group_of_; ///< all 0
  contact::LargeContactBlock block_;
  contact::ImpactRows impact_ = {};
  contact::DampingShares shares_;
};

} // namespace eccentra::styles
