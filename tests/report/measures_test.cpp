// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The measures of annulusReport against geometry that is known in closed form.
#include "report/section_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace {

using namespace eccentra::report;

constexpr double pi = 3.14159265358979323846;
const Section eccentric = {0.0635, 0.02413, {0, -0.019685}, 0.3};

TEST(Layers, VolumesSumToTheAnnulus) {
  for (const std::size_t layers : {1U, 2U, 7U, 40U}) {
    const auto volumes = layer_volumes(eccentric, {0, 1}, layers);
    const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    EXPECT_NEAR(sum / eccentric.volume(), 1, 1e-13);
  }
}

TEST(Layers, ConcentricHalvesAreEqual) {
  const Section concentric = {0.06, 0.02, {0, 0}, 1};
  const auto volumes = layer_volumes(concentric, {0, 1}, 2);
  EXPECT_NEAR(volumes[0] / volumes[1], 1, 1e-13);
}

TEST(Profile, KeepsTheVolumeOfEveryBody) {
  // Bodies anywhere, also beyond the wall: what the layers hold together is what the bodies are.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.07, 0.07);
  std::uniform_real_distribution<double> size(1e-9, 1e-6);
  Snapshot snapshot;
  double all = 0;
  for (int i = 0; i < 200; ++i) {
    snapshot.position.push_back({place(random), place(random), 0.1});
    snapshot.velocity.push_back({0, 0, 0});
    snapshot.volume.push_back(size(random));
    all += snapshot.volume.back();
  }
  for (const std::size_t layers : {1U, 13U, 400U}) {
    const auto profile = concentration_profile(eccentric, snapshot, {0, 1}, layers);
    const auto volumes = layer_volumes(eccentric, {0, 1}, layers);
    const double sum = std::inner_product(profile.begin(), profile.end(), volumes.begin(), 0.0);
    EXPECT_NEAR(sum / all, 1, 1e-12);
  }
}

TEST(Profile, CutsASphereAtTheBounds) {
  // A sphere of radius one layer, centred on the bound between two layers: half in each.
  const Section empty = {0.1, 0.01, {0.05, 0}, 1};
  const double radius = 0.2 / 20;
  Snapshot snapshot{0, {{-0.05, 0, 0.5}}, {{0, 0, 0}}, {4 * pi / 3 * std::pow(radius, 3)}};
  const auto profile = concentration_profile(empty, snapshot, {0, 1}, 20);
  const auto volumes = layer_volumes(empty, {0, 1}, 20);
  EXPECT_NEAR(profile[9] * volumes[9] / (snapshot.volume[0] / 2), 1, 1e-10);
  EXPECT_NEAR(profile[10] * volumes[10] / (snapshot.volume[0] / 2), 1, 1e-10);
  EXPECT_NEAR(profile[8], 0, 1e-15);
  EXPECT_NEAR(profile[11], 0, 1e-15);
}

TEST(BedHeight, IsWhereTheProfileFallsThroughHalfOfPacking) {
  // Layers of 1 mm: 0.55 in the lowest five, nothing above: the bound of packed and clear lies at 5 mm.
  std::vector<double> profile(20, 0.0);
  std::fill_n(profile.begin(), 5, 0.55);
  EXPECT_NEAR(bed_height(profile, 0.02), 0.005, 1e-15);
  EXPECT_EQ(bed_height(std::vector<double>(20, 0.05), 0.02), 0) << "a dilute stream is no bed";
  EXPECT_EQ(bed_height(std::vector<double>(20, 0.6), 0.02), 0.02);
}

TEST(ShareAtRest, OfBodiesThatMoveTogether) {
  const double w = 0.4;
  Snapshot snapshot;
  const int bodies = 100;
  for (int i = 0; i < bodies; ++i) {
    snapshot.position.push_back({0, 0.04, 0.003 * i});
    snapshot.velocity.push_back({0.1, -0.2, w});
    snapshot.volume.push_back(1e-9);
  }
  EXPECT_EQ(share_at_rest(snapshot, 0.3), 0);
  EXPECT_EQ(share_at_rest(snapshot, 0.5), 1);
}

TEST(Profile, RefusesNoLayers) {
  EXPECT_THROW(concentration_profile(eccentric, {}, {0, 1}, 0), std::invalid_argument);
}

TEST(SolidState, WeighsByVolume) {
  // 98 bodies of 1 at height 1, two of 1 at height 11 and 12: a weighted centre, and the top without the last 2 %.
  Snapshot snapshot;
  for (int i = 0; i < 100; ++i) {
    snapshot.position.push_back({0.5, i < 98 ? 1.0 : i - 87.0, 7});
    snapshot.velocity.push_back({3, 0, i < 98 ? 4.0 : 0.0});
    snapshot.volume.push_back(1);
  }
  const SolidState state = solid_state(snapshot, {0, 1, 0});
  EXPECT_DOUBLE_EQ(state.volume, 100);
  EXPECT_NEAR(state.centre, (98 + 11 + 12) / 100.0, 1e-12);
  EXPECT_DOUBLE_EQ(state.top, 1);
  EXPECT_NEAR(state.speed, (98 * 5 + 2 * 3) / 100.0, 1e-12);
  snapshot.volume[99] = 1e3;
  EXPECT_DOUBLE_EQ(solid_state(snapshot, {0, 1, 0}).top, 12) << "one body that is nearly all of the solid";
  EXPECT_DOUBLE_EQ(solid_state({}, {0, 1, 0}).volume, 0);
}

} // namespace
