// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Coupled runs against the closed forms of this closure (eq 20 to 23, model A): terminal velocities in mud, pressure
// drop of a bed, onset of fluidisation, hindered settling, hold-up of a vertical hole.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using namespace eccentra::test;

constexpr double kDiameter = 6.35e-3, kGravity = 9.81, kSolid = 2619, kFluid = 1000;
const double kVolume = M_PI / 6 * std::pow(kDiameter, 3);

struct Mud {
  double tau0, k, n;
  double muY = 100; ///< cap of the viscosity [Pa s]

  /// Eq (20) to (23) without alpha: force on a sphere at this slip [N].
  double force(double slip, double sphericity = 1) const {
    const double stress = k * std::pow(slip / kDiameter, n) + 7 * M_PI / 24 * tau0;
    return M_PI / 8 * kDiameter * kDiameter *
           (30 * stress + 67.289 * std::exp(-5.03 * sphericity) * kFluid * slip * slip);
  }
  /// Slip in a suspension of fluid fraction alpha that carries its weight: F alpha^-1.65 = alpha V (rho_p - rho) g.
  double slip(double alpha, double sphericity = 1) const {
    const double load = std::pow(alpha, 2.65) * kVolume * (kSolid - kFluid) * kGravity;
    double low = 0, high = 10;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (force(middle, sphericity) < load ? low : high) = middle;
    }
    return low;
  }
  std::string dem(const std::string& drag = "chien") const {
    std::ostringstream text;
    text << "fluid/force rheology herschel_bulkley " << tau0 << ' ' << k << ' ' << n << " density " << kFluid
         << " drag " << drag << " pressure_gradient on ";
    return text.str();
  }
  std::string foam() const {
    std::ostringstream text;
    text << "transportModel HerschelBulkleyCapped; HerschelBulkleyCappedCoeffs { tau0 " << tau0 << "; k " << k << "; n "
         << n << "; muY " << muY << "; }";
    return text.str();
  }
};

const Mud kPowerLaw{0, 0.28, 0.65};

std::string sphere(double x, double y, double z) {
  std::ostringstream text;
  text << "create_atoms 1 single " << x << ' ' << y << ' ' << z << " units box\n";
  return text.str();
}

const char* const kSize = "set group all diameter 6.35e-3 density 2619\n";
const char* const kWeight = "fix weight all gravity 9.81 vector 0 0 -1\n";

std::string coupled_every(int every, int steps) {
  return "\nfix flow all fluid/couple link solver every " + std::to_string(every) + "\nrun " + std::to_string(steps) +
         "\n";
}

/// Periodic box with 3 x 3 x 3 spheres on a cubic lattice of this solid fraction, through which fluid flows upwards.
BoxCase lattice(double solid, const Mud& mud, double superficial) {
  BoxCase box;
  const double spacing = kDiameter * std::cbrt(M_PI / 6 / solid);
  std::ostringstream drive;
  for (int k = 0; k < 3; ++k) {
    box.size[k] = 3 * spacing;
    box.cells[k] = 3;
  }
  drive << "drive { type meanVelocity; direction (0 0 1); Ubar " << superficial << "; initialGradient 0; }";
  box.drive = drive.str();
  box.rheology = mud.foam();
  box.tolerance = 1e-9;
  std::ostringstream script;
  script << script_head(box, 1e-4);
  for (int i = 0; i < 27; ++i)
    script << sphere((i % 3 + 0.5) * spacing, (i / 3 % 3 + 0.5) * spacing, (i / 9 + 0.5) * spacing);
  script << kSize;
  box.script = script.str();
  return box;
}

/// One particle of the sphere's volume in a large box of mud at rest, `across` cells wide.
Outcome falling(const Mud& mud, const std::string& name, double step, int steps, double sphericity, int across) {
  BoxCase box;
  const double wide = 0.24, high = 0.48;
  box.size[0] = box.size[1] = wide;
  box.size[2] = high;
  box.cells[0] = box.cells[1] = across;
  box.cells[2] = 2 * across;
  for (bool& periodic : box.periodic)
    periodic = false;
  box.rheology = mud.foam();
  box.step = step;
  box.tolerance = 1e-7;
  box.coupling = "length 0.05;";
  box.script = script_head(box, 2e-4, kWeight) + sphere(0.5 * wide, 0.5 * wide, 0.4) + kSize + "fix mud all " +
               mud.dem() + " sphericity " + std::to_string(sphericity) +
               coupled_every(int(std::lround(step / 2e-4)), steps);
  return run(box, name);
}

/// Its terminal velocity.
double fall(const Mud& mud, const std::string& name, double sphericity = 1, int across = 12) {
  const Outcome outcome = falling(mud, name, 1e-2, 3000, sphericity, across);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  return outcome.status == 0 ? outcome.last("fastest_particle") : 0;
}

} // namespace

TEST(CoupledClosedForms, TerminalVelocityInANewtonianFluid) {
  const Mud newtonian{0, 0.01, 1};
  EXPECT_NEAR(fall(newtonian, "fall_newtonian"), newtonian.slip(1), 0.02 * newtonian.slip(1));
}

TEST(CoupledClosedForms, TerminalVelocityInAPowerLawFluid) {
  EXPECT_NEAR(kPowerLaw.slip(1), 0.283247422422, 1e-9);
  EXPECT_NEAR(fall(kPowerLaw, "fall_power_law"), 0.283247422422, 0.02 * 0.283247422422);
}

TEST(CoupledClosedForms, TerminalVelocityInAHerschelBulkleyFluid) {
  EXPECT_NEAR(fall({1, 0.28, 0.65}, "fall_yield_stress"), 0.223469099117, 0.02 * 0.223469099117);
  EXPECT_NEAR(fall({2, 0.28, 0.65}, "fall_yield_stress_2"), 0.159555286524, 0.02 * 0.159555286524);
}

// The shapes of Table 1, by their sphericities; the sphere has tests of its own above.
TEST(CoupledClosedForms, TerminalVelocityOfEachSphericity) {
  constexpr int kAcross = 8;
  const struct {
    const char* name;
    Mud mud;
  } fluids[] = {{"newtonian", {0, 0.01, 1}}, {"power_law", kPowerLaw}, {"yield_stress", {1, 0.28, 0.65}}};
  ASSERT_NEAR(kPowerLaw.slip(1, .91), .249634022766, 1e-9);
  ASSERT_NEAR(kPowerLaw.slip(1, .85), .227561833356, 1e-9);
  for (const auto& fluid : fluids)
    for (const double sphericity : {.91, .87, .85, .68, .75, .789}) {
      const std::string name = std::string("fall_") + fluid.name + "_" + std::to_string(sphericity);
      const double expected = fluid.mud.slip(1, sphericity);
      EXPECT_NEAR(fall(fluid.mud, name, sphericity, kAcross), expected, 0.02 * expected) << name;
    }
}

// Held is held exactly: no slip, no swing. What is left is the creep of the fluid itself under the weight, below its
// cap of viscosity, steady and inversely proportional to that cap.
TEST(CoupledClosedForms, AYieldStressAboveTheLimitHoldsTheParticle) {
  const double creep = 6.76e-6, cap = 100;
  for (const double step : {1e-3, 1e-2})
    for (const double muY : {cap, 1e4}) {
      Mud mud{5.2, 0.28, 0.65};
      mud.muY = muY;
      std::ostringstream name;
      name << "held_" << step << '_' << muY;
      const Outcome outcome = falling(mud, name.str(), step, 2000, 1, 8);
      ASSERT_EQ(outcome.status, 0) << outcome.text;
      double least = 1, most = 0;
      for (std::size_t i = 3 * outcome.rows.size() / 4; i < outcome.rows.size(); ++i) {
        least = std::min(least, outcome.rows[i].at("fastest_particle"));
        most = std::max(most, outcome.rows[i].at("fastest_particle"));
      }
      EXPECT_NEAR(most, creep * cap / muY, 0.1 * creep * cap / muY) << name.str();
      EXPECT_LT(most - least, 0.002 * most) << name.str() << ": it swings";
    }
}

TEST(CoupledClosedForms, PressureDropOfABed) {
  const double solid = M_PI / 6, alpha = 1 - solid, superficial = 0.1, mu = 0.01;
  const Mud newtonian{0, mu, 1};
  const double ergun = 150 * mu * solid * solid * superficial / (std::pow(alpha, 3) * kDiameter * kDiameter) +
                       1.75 * kFluid * solid * superficial * superficial / (std::pow(alpha, 3) * kDiameter);
  const double chien = solid / (alpha * kVolume) * std::pow(alpha, -1.65) * newtonian.force(superficial / alpha);
  for (const bool paper : {false, true}) {
    BoxCase box = lattice(solid, newtonian, superficial);
    box.script +=
        "fix hold all freeze\nfix mud all " + newtonian.dem(paper ? "chien" : "gidaspow") + coupled_every(20, 4000);
    const Outcome outcome = run(box, paper ? "bed_chien" : "bed_ergun");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const double expected = paper ? chien : ergun;
    EXPECT_NEAR(outcome.last("pressure_gradient"), expected, 0.005 * expected) << (paper ? "chien" : "Ergun");
  }
}

TEST(CoupledClosedForms, HinderedSettling) {
  const struct { double alpha, ratio; } references[] = {{.9, .672088}, {.7, .232011}};
  for (const auto& r : references) {
    ASSERT_NEAR(r.alpha * kPowerLaw.slip(r.alpha) / kPowerLaw.slip(1), r.ratio, 1e-5);
    // The fluid as a whole stands still, so that the particles fall with the slip; alpha of it is the speed of
    // settling.
    BoxCase box = lattice(1 - r.alpha, kPowerLaw, 0);
    box.script += kWeight + ("fix mud all " + kPowerLaw.dem()) + coupled_every(20, 6000);
    const Outcome outcome = run(box, "settling_" + std::to_string(r.alpha));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_NEAR(r.alpha * outcome.last("fastest_particle") / kPowerLaw.slip(1), r.ratio, 0.01 * r.ratio);
  }
}

// Qs = C A v_s at the concentrations that semi-analytic hold-up gives for the paper's flux of cuttings, vertical hole.
TEST(CoupledClosedForms, HoldUpOfAVerticalHole) {
  const double area = 0.0108384730, flux = 0.1512 / 2619;
  const struct {
    double velocity, sphericity, concentration;
  } references[] = {{0.58, 1, .01670}, {1.165, 1, .00596}, {0.58, .79, .01372}};
  for (const auto& r : references) {
    BoxCase box = lattice(r.concentration, kPowerLaw, r.velocity);
    std::ostringstream text;
    text << kWeight << "fix mud all " << kPowerLaw.dem() << " sphericity " << r.sphericity << coupled_every(20, 6000);
    box.script += text.str();
    const Outcome outcome = run(box, "holdup_" + std::to_string(r.velocity) + "_" + std::to_string(r.sphericity));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const double rise = flux / (r.concentration * area);
    EXPECT_NEAR(outcome.last("solids_flux") / r.concentration / (box.size[0] * box.size[1]), rise, 0.01 * rise)
        << "U " << r.velocity << " sphericity " << r.sphericity;
  }
}

// At the onset the fluid carries the bed: 2 % more lifts it, 2 % less lets it sink. (alpha 0.5, so that no spheres
// touch.)
TEST(CoupledClosedForms, OnsetOfFluidisation) {
  const double alpha = 0.5;
  for (const double mu : {1e-3, 0.1}) {
    const Mud newtonian{0, mu, 1};
    const double onset = alpha * newtonian.slip(alpha);
    for (const double part : {0.98, 1.02}) {
      BoxCase box = lattice(1 - alpha, newtonian, part * onset);
      box.script += kWeight + ("fix mud all " + newtonian.dem()) + coupled_every(20, 4000);
      const Outcome outcome = run(box, "onset_" + std::to_string(mu) + "_" + std::to_string(part));
      ASSERT_EQ(outcome.status, 0) << outcome.text;
      const double rise = outcome.last("solids_flux") / (1 - alpha) / (box.size[0] * box.size[1]);
      EXPECT_EQ(rise > 0, part > 1) << "viscosity " << mu << ", " << part << " of the onset, rise " << rise;
      // And a bed in suspension rises with what the fluid has beyond the onset.
      EXPECT_NEAR(rise, (part - 1) * onset / alpha, 0.1 * std::abs(part - 1) * onset / alpha);
    }
  }
}
