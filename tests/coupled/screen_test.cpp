// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A screen in a coupled run: what its verdict drops is neither computed nor sent, over either link, and what a second
// look finds to matter comes back.
#include "coupled/coupled_case.h"
#include "link/background_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

constexpr int kInterval = 40, kMeasured = 200, kPause = 200, kSteps = 800;
constexpr int kCouplingSteps = kSteps / kInterval + 1;

/// Spheres in a vertical periodic box. A pressure gradient of a fifth of their weight begins at step 300, when the
/// first verdict (step 200) has been spoken and the second (step 600) has not.
BoxCase scene(const std::string& link) {
  BoxCase box;
  box.drive = "drive { type pressureGradient; direction (0 0 1); "
              "gradient table ((0 0) (0.0149 0) (0.015 3000) (1 3000)); }";
  std::ostringstream script;
  script << script_head(box, 5e-5, "fix weight all gravity 9.81 vector 0 0 -1\n");
  for (int i = 0; i < 27; ++i)
    script << "create_atoms 1 single " << 0.005 + 0.02 * (i % 3) << ' ' << 0.006 + 0.02 * (i / 3 % 3) << ' '
           << 0.007 + 0.02 * (i / 9) << " units box\n";
  script << "set group all diameter 6.35e-3 density 2619\nvelocity all set 0 0 -0.2\n"
         << "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag_torque none screen 0.05 "
            "screen_steps "
         << kMeasured << " screen_recheck " << kPause << "\nfix flow all fluid/couple link " << link << " every "
         << kInterval << "\nrun " << kSteps << "\n";
  box.script = script.str();
  return box;
}

/// What stands between `before` and ';' in each line that has it.
std::vector<std::string> found(const std::string& text, const std::string& before) {
  std::vector<std::string> all;
  for (auto at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
    const auto from = at + before.size();
    all.push_back(text.substr(from, text.find(';', from) - from));
  }
  return all;
}

double number_after(const std::string& text, const std::string& before) {
  const auto at = text.find(before);
  return at == std::string::npos ? -1 : std::stod(text.substr(at + before.size()));
}

void expect_shrinks_and_grows(const Outcome& outcome) {
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::vector<std::string> asked = found(outcome.text, "the fluid is asked for");
  ASSERT_EQ(asked.size(), 4u) << outcome.text;
  const std::string everything = " velocity fraction pressure_gradient stress_divergence vorticity";
  EXPECT_EQ(asked[0], everything);
  EXPECT_EQ(asked[1], " velocity fraction");
  EXPECT_EQ(asked[2], everything);
  EXPECT_EQ(asked[3], " velocity fraction pressure_gradient");
  EXPECT_NE(outcome.text.find("to the fluid, 104 back"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("to the fluid, 32 back"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("to the fluid, 56 back"), std::string::npos) << outcome.text;
  // Coupling steps 0 to 4 see all effects, so do those at steps 400 to 600; the pressure gradient comes back to stay.
  const int all = kMeasured / kInterval, again = kMeasured / kInterval + 1, rest = kCouplingSteps - (400 / kInterval);
  EXPECT_EQ(number_after(outcome.text, " times, pressure_gradient "), all + rest) << outcome.text;
  EXPECT_EQ(number_after(outcome.text, " times, stress_divergence "), all + again) << outcome.text;
  EXPECT_EQ(number_after(outcome.text, "coupling steps: velocity "), kCouplingSteps);
  const double back =
      27e-6 * (104 * (all + again) + 32 * (400 / kInterval - all) + 56 * (kCouplingSteps - 400 / kInterval - again));
  EXPECT_NEAR(number_after(outcome.text, "MB of particles to the fluid, "), back, 1e-5 * back) << outcome.text;
}

} // namespace

TEST(CoupledScreen, FieldsFallAwayAndComeBackOverBothLinks) {
  const Outcome hosted = run(scene("solver"), "screen_solver");
  expect_shrinks_and_grows(hosted);

  const std::string address =
      "ipc://" + (fs::temp_directory_path() / ("eccentra-screen-" + std::to_string(getpid()))).string();
  BoxCase apart = scene("socket " + address + " wait 60");
  apart.coupling = "link socket; address \"" + address + "\"; wait 60;";
  const fs::path folder = fs::absolute("screen_socket_dem");
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "in.dem") << apart.script;
  BackgroundJob particles(folder.string(),
                          {std::string(std::getenv("ECCENTRA_BIN")) + "/eccentra-dem", "-in", "in.dem", "-log", "none"},
                          "log");
  const Outcome served = run(apart, "screen_socket");
  EXPECT_EQ(particles.wait(40), 0) << particles.text();
  expect_shrinks_and_grows(served);
  for (const char* column : {"com_z", "fastest_particle", "fastest_fluid", "momentum_z"})
    EXPECT_NEAR(served.last(column), hosted.last(column), 1e-9) << column;
}

TEST(CoupledScreen, ResultStaysWithinTwiceTheTolerance) {
  const Outcome screened = run(scene("solver"), "screen_within");
  BoxCase box = scene("solver");
  const std::string word = "screen 0.05 screen_steps 200 screen_recheck 200";
  box.script.replace(box.script.find(word), word.size(),
                     "drag chien shear_lift saffman_mei rotational_lift oesterle_bui_dinh "
                     "pressure_gradient on viscous_stress on");
  const Outcome all = run(box, "screen_everything_on");
  ASSERT_EQ(screened.status, 0) << screened.text;
  ASSERT_EQ(all.status, 0) << all.text;
  EXPECT_NEAR(screened.last("solids_flux"), all.last("solids_flux"), 0.1 * std::abs(all.last("solids_flux")));
  EXPECT_NEAR(screened.last("mean_velocity"), all.last("mean_velocity"), 0.1 * std::abs(all.last("mean_velocity")));
}
