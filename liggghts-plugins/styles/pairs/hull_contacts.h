// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What pair_style gran/cluster keeps for pairs with a rounded body.
#pragma once

#include "contact/body_state.h"
#include "contact/box_contacts.h"
#include "contact/feature_search.h"
#include "contact/manifold.h"
#include "styles/pairs/near_pairs.h"
#include "styles/pairs/waiting_pairs.h"

#include <Eigen/Core>

#include <vector>

namespace eccentra::styles {

/// The manifolds of the pairs that wait, and the cores of the bodies where they are in this step.
class HullContacts {
 public:
  /// So many pairs are evaluated together.
  static constexpr int enough = 16;
  /// Forces are computed once so many contacts are in the block: enough to fill vectors, few enough to stay in the
  /// first-level cache.
  static constexpr int in_block = 24;

  bool warned_of_sunk_cores = false;

  /// A new step: bodies have moved.
  void begin_step(int bodies) {
    ++step_;
    boxes.forget_cores();
    if (static_cast<int>(posed_.size()) < bodies) {
      posed_.resize(bodies);
      posed_at_.resize(bodies, 0);
    }
  }
  /// The core of body i, posed when it is first asked for. Stays where it is until the next step.
  const contact::PosedCore& posed(int i, const contact::SurfaceSpheres& surface, const contact::BodyState& body) {
    contact::PosedCore& posed = posed_[i];
    if (posed_at_[i] == step_)
      return posed;
    posed_at_[i] = step_;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (!surface.single_at_centre)
      for (int k = 0; k < 3; ++k)
        turn.col(k) = Eigen::Vector3d(body.column[k][0], body.column[k][1], body.column[k][2]);
    posed.pose(surface.core, turn);
    return posed;
  }
  contact::BodyPair pair(const NearPair& p, const NearPairs& near, const double* offset) {
    const contact::BodyState &a = near.body(p.a), &b = near.body(p.b);
    return {{&posed(p.a, *a.surface, a), a.extra_radius},
            {&posed(p.b, *b.surface, b), b.extra_radius},
            {offset[0], offset[1], offset[2]}};
  }

  /// Force and torque on A that a pair's elastic corrections add.
  struct Correction {
    int pair; ///< in the block
    Eigen::Vector3d force, torque;
  };

  contact::BoxContacts boxes;
  std::vector<contact::Contact> of_boxes; ///< of a pair of boxes with elastic corrections
  contact::FeatureSearch search;
  contact::Manifolds manifolds;
  std::vector<WaitingPair> waiting; ///< one per pair of the manifolds
  std::vector<Correction> corrections;

 private:
  std::vector<contact::PosedCore> posed_;
  std::vector<int> posed_at_;
  int step_ = 0;
};

} // namespace eccentra::styles
