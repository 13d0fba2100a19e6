// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles in homogeneous turbulence, in LIGGGHTS: spread, energy, ranks, restart, and nothing where it is off.
#include "fluid_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <vector>

using namespace eccentra::test;
using eccentra::styles::FixFluidForce;

namespace {

constexpr double kEnergy = 0.06, kDissipation = 0.3; // fluctuation 0.2 m/s, life of an eddy 0.03 s, length 8 mm
constexpr double kSpeed = 0.2, kLife = 0.03, kLength = 0.16432 * 0.06 * 0.24494897427831780 / 0.3;
constexpr double kSmall = 1e-4; ///< diameter [m]

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

/// Particles that do not meet: rows^3, far apart in a box of this size.
std::string cloud(int rows, double edge, double density) {
  return "lattice sc " + number(edge / rows) + "\ncreate_atoms 1 box\nset group all diameter " + number(kSmall) +
         " density " + number(density) + "\n";
}

std::string turbulent(const std::string& words, double energy = kEnergy, double viscosity = 1e-3) {
  return "fix mud all fluid/force rheology newtonian " + number(viscosity) +
         " density 1 drag schiller_naumann buoyancy off " + words +
         "\nfix flow all fluid/uniform velocity 0 0 0 turbulence " + number(energy) + " " + number(kDissipation) + "\n";
}

std::string head(double edge) {
  const std::string side = "0 " + number(edge);
  return granular_box(side + " " + side + " " + side, "p p p") + granular_material({}, "0.004") +
         "pair_style gran model hertz tangential history\npair_coeff * *\nfix integrate all nve/sphere\n";
}

/// By number of the particle, on every rank.
std::map<int, std::array<double, 6>> states(LiggghtsSession& session) {
  std::vector<double> mine;
  auto& atom = session.atom();
  for (int i = 0; i < atom.nlocal; ++i) {
    mine.push_back(atom.tag[i]);
    for (int k = 0; k < 3; ++k)
      mine.push_back(atom.x[i][k]);
    for (int k = 0; k < 3; ++k)
      mine.push_back(atom.v[i][k]);
  }
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<int> counts(ranks), starts(ranks);
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (int r = 1; r < ranks; ++r)
    starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<double> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  std::map<int, std::array<double, 6>> found;
  for (std::size_t i = 0; i < all.size(); i += 7)
    std::copy_n(&all[i + 1], 6, found[static_cast<int>(all[i])].begin());
  return found;
}

/// Mean of the squares of one component of the velocity.
double energy(LiggghtsSession& session, int k) {
  double sum = 0;
  const auto found = states(session);
  for (const auto& [tag, state] : found)
    sum += state[3 + k] * state[3 + k];
  return sum / static_cast<double>(found.size());
}

// Stokes drag of relaxation time t_p on a fluctuation of correlation exp(-t/T): <v^2> = u'^2 T/(T + t_p) (Tchen 1947,
// Hinze). Across a fall with the speed w, T is 1/(1/life + w/length); the fall is fast enough for the fluctuation to
// change its speed by little, (u'/w)^2 of the rate.
TEST(Dispersion, HeavyParticlesTakeTheEnergyThatTchenSays) {
  constexpr int rows = 15, count = rows * rows * rows;
  constexpr double fall = 4.0, viscosity = 0.05, density = 2000.0;
  const double relaxation = density * kSmall * kSmall / (18 * viscosity); // 22 us
  const double rate = 1 / kLife + fall / kLength;                         // 530 1/s: 1.9 ms
  LiggghtsSession session;
  // Creep: Re = fall d/nu = 0.008. Gravity that makes the terminal speed equal to the fall.
  session.script(head(0.1) + cloud(rows, 0.1, density) + "velocity all set 0 0 -4\nfix pull all gravity " +
                 number(fall / relaxation) + " vector 0 0 -1\n" +
                 turbulent("turbulent_dispersion eddy_interaction dispersion_seed 5", kEnergy, viscosity) +
                 "timestep 2e-5\nrun 400\n");
  double sum = 0;
  for (int sample = 0; sample < 10; ++sample) { // 4 ms apart: two integral times
    session.command("run 200");
    sum += (energy(session, 0) + energy(session, 1)) / 20;
  }
  // Backward Euler damps with 1/(1 + dt/t_p) a step: the sum over steps in place of the integral.
  const double step = 2e-5, keep = std::exp(-rate * step), damp = 1 / (1 + step / relaxation);
  const double expected = kSpeed * kSpeed * (1 - damp) / (1 + damp) * (1 + keep * damp) / (1 - keep * damp);
  EXPECT_NEAR(expected, kSpeed * kSpeed / (1 + relaxation * rate), 0.02 * expected);
  const double independent = 2.0 * count * 8;
  EXPECT_NEAR(sum, expected, (4 * std::sqrt(2 / independent) + 1.0 / 400) * expected);
}

// Over long times they spread as tracers do, with the energy and the integral time of what they see.
TEST(Dispersion, ParticlesSpreadWithTheIntegralTimeThatTheySee) {
  constexpr int rows = 15, count = rows * rows * rows;
  constexpr double fall = 4.0, viscosity = 0.05, density = 2000.0, step = 2e-5;
  const double relaxation = density * kSmall * kSmall / (18 * viscosity);
  const double rate = 1 / kLife + fall / kLength;
  LiggghtsSession session;
  session.script(head(0.1) + cloud(rows, 0.1, density) + "velocity all set 0 0 -4\nfix pull all gravity " +
                 number(fall / relaxation) + " vector 0 0 -1\n" +
                 turbulent("turbulent_dispersion eddy_interaction dispersion_seed 9", kEnergy, viscosity) +
                 "timestep 2e-5\nrun 500\n");
  const auto before = states(session);
  session.command("run 1000"); // 20 ms: 10.6 integral times
  double sum = 0;
  for (const auto& [tag, state] : states(session))
    for (int k = 0; k < 2; ++k) {
      const double way = std::remainder(state[k] - before.at(tag)[k], 0.1);
      sum += way * way / (2.0 * count);
    }
  // Taylor's integral over the two-time correlation of the particle's own velocity: for t >> t_p that of the fluid
  // seen, less the memory of both ends.
  const double time = 1000 * step, seen = 1 / rate;
  const double tracer = 2 * std::pow(kSpeed * seen, 2) * (time / seen - 1 + std::exp(-time / seen));
  const double ends = 2 * kSpeed * kSpeed * relaxation * relaxation / (1 + relaxation / seen); // of <v^2> t_p^2
  EXPECT_NEAR(sum, tracer + ends, (4 * std::sqrt(1.0 / count) + 0.01) * tracer);
}

TEST(Dispersion, OffAndWithoutTurbulenceEveryDigitStays) {
  std::vector<std::map<int, std::array<double, 6>>> found;
  for (const auto& [words, energy] : {std::pair<const char*, double>{"", kEnergy},
                                      {"turbulent_dispersion none", kEnergy},
                                      {"turbulent_dispersion eddy_interaction", 0.0}}) {
    LiggghtsSession session;
    session.script(head(0.02) + cloud(4, 0.02, 2000) + "velocity all set 0.1 0.2 -0.1\n" + turbulent(words, energy) +
                   "timestep 2e-5\nrun 200\n");
    found.push_back(states(session));
    EXPECT_EQ(FixFluidForce::find(&session.lammps())->needs() & eccentra::link::kTurbulence,
              std::string(words).find("eddy") == std::string::npos ? 0U : unsigned(eccentra::link::kTurbulence));
  }
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

// One seed, one walk: through migration (the particles cross the box several times), restart and any number of ranks.
TEST(Dispersion, RestartContinuesBitForBit) {
  const std::string scene = turbulent("turbulent_dispersion eddy_interaction") + "timestep 2e-5\n";
  std::map<int, std::array<double, 6>> straight;
  {
    LiggghtsSession session;
    session.script(head(0.02) + cloud(4, 0.02, 2000) + "velocity all set 1 2 -1\n" + scene +
                   "run 1500\nwrite_restart dispersion.restart\nrun 1500\n");
    straight = states(session);
  }
  LiggghtsSession session;
  std::string text = head(0.02);
  const auto box = text.find("region box");
  const auto neighbor = text.find("neighbor");
  text.replace(box, neighbor - box, "read_restart dispersion.restart\n");
  session.script(text + scene + "run 1500\n");
  EXPECT_EQ(states(session), straight);
}

// Eddies of 8 mm: a body of 10 mm sees more of them than it should, which is said; one of 5 mm does not.
TEST(Dispersion, BodiesLargerThanTheirEddiesAreNamed) {
  for (const double diameter : {0.005, 0.010}) {
    LiggghtsSession session;
    session.script(head(0.1) + cloud(2, 0.1, 2000) + "set group all diameter " + number(diameter) + "\n" +
                   turbulent("turbulent_dispersion eddy_interaction") + "timestep 2e-5\n");
    session.script("log warned.log\nrun 5\nlog none\n");
    if (session.rank() != 0)
      continue;
    std::ifstream log("warned.log");
    const std::string text{std::istreambuf_iterator<char>(log), {}};
    EXPECT_NE(text.find("Loop time"), std::string::npos) << text;
    EXPECT_EQ(text.find("turbulent_dispersion moves 8 of 8 particles too far") != std::string::npos, diameter > kLength)
        << text;
  }
}

TEST(Dispersion, MomentumIsThatOfTheFluid) {
  LiggghtsSession session;
  session.script(head(0.02) + cloud(4, 0.02, 2000) + "velocity all set 0.1 0.2 -0.1\n" +
                 turbulent("turbulent_dispersion eddy_interaction") + "timestep 2e-5\n");
  const auto rest = [&] {
    std::array<double, 3> mine{}, all{};
    auto& atom = session.atom();
    for (int i = 0; i < atom.nlocal; ++i)
      for (int k = 0; k < 3; ++k)
        mine[k] += atom.rmass[i] * atom.v[i][k] - FixFluidForce::find(&session.lammps())->received(i)[k];
    MPI_Allreduce(mine.data(), all.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return all;
  };
  const auto before = rest();
  session.command("run 500");
  const auto after = rest();
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(after[k], before[k], 1e-12 * std::abs(before[k]));
}

} // namespace
