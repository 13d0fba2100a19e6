// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The shares that keep a suspension from answering to itself: the loop between two coupling steps, in a box through
// which nothing flows, does not grow, whatever density, fraction and drag.
#include "flow/feedbackShares.H"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace {

using namespace eccentra;

/// Uniform state of particles (position, speed) and fluid; lengths in intervals, forces per mass of the particles.
struct State {
  double x = 0, v = 0;               ///< particles
  double known = 0, knownBefore = 0; ///< place as the fluid knows it
  double u = 0, uBefore = 0;         ///< fluid
  double applied = 0;                ///< pressure force of the coming interval
  double withheld = 0;
};

struct Loop {
  double k; ///< interval over the drag's relaxation time
  feedbackLoad load;
  double theta, omega;

  /// One interval. The particles' equation dv/dt = told - k (v - u) is integrated exactly; the fluid's volume flux
  /// closes the box; its momentum, with the second-order time scheme and semi-implicit drag, gives the pressure.
  State operator()(const State& s) const {
    State next;
    const double follows = -std::expm1(-k);
    if (k > 0) {
      const double end = s.u + s.applied / k;
      next.v = end + (s.v - end) * (1 - follows);
      next.x = s.x + end + (s.v - end) * follows / k;
    } else {
      next.v = s.v + s.applied;
      next.x = s.x + s.v + 0.5 * s.applied;
    }
    const double impulse = s.v + s.applied - next.v;
    next.known = s.known + theta * (next.x - s.known);
    next.knownBefore = s.known;
    next.u = -load.displaced * (1.5 * next.known - 2 * s.known + 0.5 * s.knownBefore);
    next.uBefore = s.u;
    const double acceleration = 1.5 * next.u - 2 * s.u + 0.5 * s.uBefore;
    next.withheld = follows * (next.u - s.u);
    const double onFluid = impulse - next.withheld + s.withheld;
    const double pressure = load.lightness * acceleration - load.displaced * onFluid;
    next.applied = s.applied + omega * (pressure - s.applied);
    return next;
  }

  /// Mean growth per interval of a disturbance, once the fastest part of it leads.
  double growth() const {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    State s{any(random), any(random), any(random), any(random), any(random), any(random), any(random), any(random)};
    constexpr int kIntervals = 300;
    double sum = 0;
    for (int i = 0; i < kIntervals; ++i) {
      s = (*this)(s);
      // Where the suspension stands as a whole matters to nobody.
      s.known -= s.x;
      s.knownBefore -= s.x;
      s.x = 0;
      double size = 0;
      for (const double part : {s.v, s.known, s.knownBefore, s.u, s.uBefore, s.applied, s.withheld})
        size += part * part;
      size = std::sqrt(size);
      if (size < 1e-200)
        return 0;
      for (double* part : {&s.v, &s.known, &s.knownBefore, &s.u, &s.uBefore, &s.applied, &s.withheld})
        *part /= size;
      if (i >= kIntervals / 2)
        sum += std::log(size);
    }
    return std::exp(sum / (kIntervals / 2));
  }
};

} // namespace

TEST(FeedbackShares, TheLoopDoesNotGrow) {
  int unstableWithoutShares = 0;
  for (const double lightness : {0.1, 0.38, 0.6, 0.91, 1.5, 2.0})
    for (const double displaced : {0.1, 0.25, 0.5, 0.8, 1.2, 1.6, 2.2, 3.0})
      for (const double k : {0.0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8, 1.6, 4.0, 20.0, 200.0}) {
        Loop loop{k, {displaced, -std::expm1(-k), lightness}, 1, 1};
        unstableWithoutShares += loop.growth() > 1.001;
        loop.theta = fractionShare(loop.load);
        loop.omega = forceShare(loop.load);
        // Without drag a uniform motion goes on for ever.
        EXPECT_LT(loop.growth(), 1 + 1e-6) << "r " << displaced << " rho_f/rho_p " << lightness << " k " << k;
      }
  EXPECT_GT(unstableWithoutShares, 100) << "nothing to cure";
}

TEST(FeedbackShares, DiluteSuspensionsLearnAllAtOnce) {
  for (const double follows : {0.0, 0.3, 1.0}) {
    const feedbackLoad cuttings{0.15, follows, 1 / 2.619};
    EXPECT_EQ(fractionShare(cuttings), 1);
    EXPECT_EQ(forceShare(cuttings), 1);
  }
}

TEST(FeedbackShares, TheWorstCellDecidesForTheFraction) {
  Foam::scalarField solid(3, 0.0), drag(3, 0.0);
  solid[1] = 0.1;
  solid[2] = 0.6;
  drag[1] = drag[2] = 1e6; // 2000 intervals' worth: the particles follow at once
  const feedbackLoads loads(solid, &drag, 2619, 1000, 5e-3);
  EXPECT_DOUBLE_EQ(loads.fraction(), fractionShare({1.5, -std::expm1(-1e6 * 5e-3 / (0.6 * 2619)), 1000.0 / 2619}));
  const Foam::scalarField shares(loads.force());
  EXPECT_EQ(shares[0], 1);
  EXPECT_EQ(shares[1], 1);
  EXPECT_LT(shares[2], 0.7);
  // Without its coefficient the drag counts as strong.
  EXPECT_DOUBLE_EQ(feedbackLoads(solid, nullptr, 2619, 1000, 5e-3).fraction(), 1.5 / (1 + 2.5 * 0.6 / 0.4));
}
