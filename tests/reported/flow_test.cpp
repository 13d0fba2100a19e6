// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of annulusFoam that once went wrong without a word: settings without effect, steps that do not converge, full
// disks.
#include "reported/flow_scene.h"
#include "rheology/slot_flow.h"

#include <cmath>
#include <cstdint>
#include <fstream>

namespace eccentra::test {
namespace {

constexpr std::uintmax_t kLongestFile = 51200; ///< of a full disk [bytes]

TEST(Reported, issue_measures_of_a_single_phase_run) {
  for (const char* ends : {"periodic", "inletOutlet"}) {
    FlowScene scene;
    scene.ends = ends;
    scene.mesh = "holeRadius 0.0635; pipeRadius 0.02413; eccentricity 0.5; length 0.2; cells (8 24 8);";
    scene.control = "endTime 8; deltaT 0.1; writeControl runTime; writeInterval 100; progressInterval 0;";
    scene.transport = "transportModel HerschelBulkleyCapped; rho 1000; HerschelBulkleyCappedCoeffs { tau0 1; k 0.28; n "
                      "0.65; muY 100; }";
    scene.U = "(0 0 0.58)";
    scene.inlet = "type fixedValue; value uniform (0 0 0.58);";
    scene.ddt = "Euler";
    if (scene.ends == std::string("periodic"))
      scene.flow = "drive { type meanVelocity; Ubar 0.58; }";
    scene.write(std::string("measures_") + ends);
    const ProgramResult result = scene.run();
    ASSERT_EQ(result.status, 0) << result.output;
    const auto row = last_row(scene.folder / "postProcessing/eccentra/0/flow.csv");
    // Independent of the case: 12 rho U^2/tau_w of the slot (computed apart).
    EXPECT_NEAR(row.at("reynolds"), 567.3, 0.005 * 567.3) << ends;
    EXPECT_GT(row.at("pressure_gradient"), 100) << ends;
    EXPECT_NE(line_with(result.output, " Re 56").find("hole |F|"), std::string::npos) << result.output;
    if (scene.ends == std::string("periodic")) {
      // In a steady flow the walls take what the pressure gives.
      const double volume = M_PI * (0.0635 * 0.0635 - 0.02413 * 0.02413) * 0.2;
      EXPECT_NEAR(row.at("pipe_force_z") + row.at("hole_force_z"), row.at("pressure_gradient") * volume,
                  0.01 * row.at("pressure_gradient") * volume);
    }
    EXPECT_LT(row.at("momentum_residual"), 0.05) << ends;
  }
  // Values of the brief: mean velocities of the paper, yield stress 0, 1 and 2 Pa.
  constexpr double kGap = 2 * (0.0635 - 0.02413);
  const double expected[3][3] = {{703.2, 941.6, 1803.1}, {567.3, 779.1, 1563.8}, {477.4, 666.7, 1383.3}};
  const double velocity[3] = {0.58, 0.72, 1.165};
  for (int yield = 0; yield < 3; ++yield)
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(rheology::metzner_reed({yield / 1000.0, 0.28e-3, 0.65, 1}, kGap, velocity[j]), expected[yield][j],
                  0.06);
  EXPECT_NEAR(rheology::metzner_reed({0, 1e-6, 1, 1}, kGap, 1), kGap / 1e-6, 1e-6 * kGap / 1e-6);
}

TEST(Reported, water_at_Re_3e5) {
  FlowScene scene;
  scene.mesh = "holeRadius 0.0635; pipeRadius 0.02413; eccentricity 0; length 0.02; cells (8 16 1);";
  scene.control = "endTime 0.004; deltaT 0.001; writeControl runTime; writeInterval 2; progressInterval 0;";
  scene.transport = "transportModel Newtonian; nu 1e-6; rho 1000;";
  scene.U = "(0 0 4)";
  scene.flow = "drive { type meanVelocity; Ubar 4; }";
  scene.write("water");
  const ProgramResult result = scene.run();
  EXPECT_EQ(result.status, 0) << result.output;
  const std::string progress = line_with(result.output, " Re ");
  ASSERT_NE(progress, "") << result.output;
  EXPECT_NEAR(std::atof(progress.c_str() + progress.find(" Re ") + 4), 3.15e5, 0.01 * 3.15e5);
  const std::string line = line_with(result.output, "warning: the Reynolds number");
  EXPECT_NE(line.find("limit 2100 of"), std::string::npos) << result.output;
  EXPECT_NE(line.find("laminar"), std::string::npos) << result.output;
}

TEST(Reported, adversary_16_drive_across_a_closed_direction) {
  FlowScene scene;
  scene.flow = "drive { type meanVelocity; Ubar 0.58; direction (1 0 0); }";
  scene.write("closed");
  expect_refused(scene.run(), {"flowProperties", "direction", "(1 0 0)", "(0 0 1)"});
  scene.ends = "inletOutlet";
  scene.flow = "drive { type pressureGradient; gradient 100; }";
  scene.write("open");
  expect_refused(scene.run(), {"flowProperties", "direction", "(0 0 1)", "none"});
}

TEST(Reported, adversary_17_space_in_the_case_folder) {
  for (const char* name : {"my results", "a\"b", "it's"}) {
    const fs::path folder = fresh_folder(name);
    for (const char* tool : {"annulusMesh", "annulusFoam"})
      for (const bool inside : {true, false}) {
        std::vector<std::string> arguments{program(tool)};
        if (!inside)
          arguments.insert(arguments.end(), {"-case", name});
        const ProgramResult result = run_program(arguments, {inside ? folder : fs::path("."), {}, 60});
        EXPECT_EQ(result.status, 1) << result.output;
        EXPECT_EQ(result.output.find(std::string(tool) + ": error: the case folder '"), 0u) << result.output;
        EXPECT_NE(result.output.find("rename the folder\n"), std::string::npos) << result.output;
      }
  }
}

TEST(Reported, adversary_19_annulusMesh) {
  FlowScene scene;
  scene.write("mesh");
  for (const char* cells :
       {"(2000 2000 600)", "(100000 100000 1000)", "(2147483647 2147483647 2147483647)", "(900 900 800)"}) {
    scene.file("system/annulusMeshDict", "dictionary",
               std::string("holeRadius 0.11; pipeRadius 0.10; eccentricity 0; length 0.02; ends periodic; cells ") +
                   cells + ";");
    const ProgramResult result = run_program({program("annulusMesh")}, {scene.folder, {}, 30});
    EXPECT_EQ(result.status, 1) << result.output;
    const std::string line = line_with(result.output, "annulusMesh: error: ");
    EXPECT_NE(line.find("cells is "), std::string::npos) << result.output;
    EXPECT_NE(line.find("give fewer cells"), std::string::npos) << result.output;
  }
  // 67,200 faces on the walls: seconds if each is appended to a list that moves, else little.
  const auto seconds = [&](const char* cells) {
    scene.file("system/annulusMeshDict", "dictionary",
               std::string("holeRadius 0.11; pipeRadius 0.10; eccentricity 0; length 0.02; ends periodic; cells ") +
                   cells + ";");
    const ProgramResult result = run_program({program("annulusMesh")}, {scene.folder, {}, 150});
    EXPECT_EQ(result.status, 0) << result.output;
    return result.seconds;
  };
  // As many cells, 16 times the wall faces: linear in the faces, some 1.5 times the work; quadratic, 100 times.
  const double thick = seconds("(64 40 48)"), thin = seconds("(1 200 615)");
  EXPECT_LT(thin, 4 * thick + 2);
}

TEST(Reported, issue_not_converged_within_the_step) {
  FlowScene scene;
  scene.ends = "inletOutlet";
  scene.mesh = "holeRadius 0.0635; pipeRadius 0.02413; eccentricity 0.5; length 0.3; cells (8 24 12);";
  scene.control = "endTime 5; deltaT 1; writeControl runTime; writeInterval 100; progressInterval 0;";
  scene.transport =
      "transportModel HerschelBulkleyCapped; rho 1000; HerschelBulkleyCappedCoeffs { tau0 1; k 0.28; n 0.65; "
      "muY 100; }";
  scene.U = "(0 0 0.58)";
  scene.inlet = "type fixedValue; value uniform (0 0 0.58);";
  scene.write("coarse");
  const ProgramResult coarse = scene.run();
  EXPECT_EQ(coarse.status, 0) << coarse.output;
  EXPECT_NE(coarse.output.find("warning: not converged within the step at t = 4 s: the momentum"), std::string::npos)
      << coarse.output;
  EXPECT_NE(line_with(coarse.output, "not converged within the step: ").find("momentum in"), std::string::npos)
      << coarse.output;
  // Outer correctors that end above their residualControl, linear solvers that stop at maxIter.
  scene.pimple = "PIMPLE { nOuterCorrectors 2; nCorrectors 1; residualControl { U { tolerance 1e-12; relTol 0; } } }";
  scene.write("outer");
  EXPECT_NE(scene.run().output.find("nOuterCorrectors ended above"), std::string::npos);
  scene.pimple = "PIMPLE { nCorrectors 1; }";
  scene.iterations = "1";
  scene.write("linear");
  EXPECT_NE(scene.run().output.find("a linear solver stopped at its maxIter"), std::string::npos);
  // Steps that follow the flow say nothing of the kind.
  scene.iterations = "200";
  scene.pimple = "PIMPLE { nCorrectors 3; consistent yes; }";
  scene.control = "endTime 0.2; deltaT 0.004; writeControl runTime; writeInterval 100; progressInterval 0;";
  scene.write("fine");
  const ProgramResult fine = scene.run();
  EXPECT_EQ(fine.status, 0) << fine.output;
  EXPECT_EQ(fine.output.find("not converged"), std::string::npos) << fine.output;
}

TEST(Reported, inlet_fixedValue_below_a_settled_bed) {
  BedScene scene;
  scene.control += "functions { flux { type surfaceFieldValue; libs (fieldFunctionObjects); log no; writeFields no; "
                   "regionType patch; name inlet; operation areaAverage; fields (U); } }";
  scene.write_all("between");
  const ProgramResult between = scene.run();
  ASSERT_EQ(between.status, 0) << between.output;
  const std::string line = line_with(between.output, "warning: 0/U: inlet");
  EXPECT_NE(line.find("interstitialInletVelocity"), std::string::npos) << between.output;
  const double part = last_row(scene.folder / "postProcessing/eccentra/coupling.csv").at("mean_velocity");
  EXPECT_LT(part, 0.09);
  EXPECT_GT(part, 0.04);

  scene.inlet = "type interstitialInletVelocity; inletVelocity uniform (0 0 0.1); value uniform (0 0 0.1);";
  scene.write_all("superficial");
  const ProgramResult superficial = scene.run();
  ASSERT_EQ(superficial.status, 0) << superficial.output;
  EXPECT_EQ(superficial.output.find("warning: 0/U"), std::string::npos) << superficial.output;
  EXPECT_NEAR(last_row(scene.folder / "postProcessing/eccentra/coupling.csv").at("mean_velocity"), 0.1, 2e-3);
  // The same boundary condition alone: the fluid fills everything.
  fs::remove(scene.folder / "constant/couplingProperties");
  scene.file(
      "system/controlDict", "dictionary",
      "startFrom startTime; startTime 0; endTime 0.01; deltaT 0.002; writeControl timeStep; writeInterval 1000; ");
  const ProgramResult alone = scene.run();
  EXPECT_EQ(alone.status, 0) << alone.output;
  const std::string progress = line_with(alone.output, "<alpha U> ");
  ASSERT_NE(progress, "") << alone.output;
  EXPECT_NEAR(std::atof(progress.c_str() + progress.find("<alpha U> ") + 10), 0.1, 0.005) << progress;
}

TEST(Reported, issue_function_objects_of_a_coupled_run) {
  BedScene scene;
  scene.control +=
      "functions { forces1 { type forces; libs (forces); patches (hole); rho rhoInf; rhoInf 1000; CofR (0 0 "
      "0); log no; } wall { type wallShearStress; libs (fieldFunctionObjects); patches (hole); log no; } }";
  scene.write_all("coupled");
  const ProgramResult result = scene.run();
  ASSERT_EQ(result.status, 0) << result.output;
  const auto row = last_row(scene.folder / "postProcessing/eccentra/coupling.csv");
  // One line a step of the fluid (400/20), and at the last one what ours says.
  std::ifstream file(scene.folder / "postProcessing/forces1/0/force.dat");
  int lines = 0;
  for (std::string line; std::getline(file, line);)
    lines += line.empty() || line[0] != '#';
  EXPECT_EQ(lines, 20);
  const std::vector<double> force = last_numbers(scene.folder / "postProcessing/forces1/0/force.dat");
  ASSERT_GE(force.size(), 4u);
  EXPECT_GT(std::abs(force[3]), 1e-6);
  EXPECT_NEAR(row.at("hole_force_z"), force[3], 1e-4 * std::abs(force[3]));
  EXPECT_GT(row.at("reynolds"), 100);
  EXPECT_FALSE(last_numbers(scene.folder / "postProcessing/wall/0/wallShearStress.dat").empty());
}

TEST(Reported, adversary_17_mostSolid) {
  BedScene scene;
  scene.coupling = "mostSolid 0.001;";
  scene.write_all("most");
  expect_refused(scene.run(), {"mostSolid is 0.001", "0.74"});
  scene.coupling = "wait 5; voidFraction centre; diffusionSteps 3;";
  scene.write_all("unread");
  const ProgramResult result = scene.run();
  EXPECT_NE(note_of(result).find("wait (link is solver)"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("diffusionSteps (voidFraction is centre)"), std::string::npos) << result.output;
}

// A limit on the length of files stands for the full disk: a write fails in the middle of a file, without any right.
TEST(Reported, adversary_17_half_written_time) {
  FlowScene scene;
  scene.mesh = "holeRadius 0.11; pipeRadius 0.10; eccentricity 0; length 0.02; inclination 0; cells (10 32 10);";
  scene.control = "endTime 0.04; deltaT 0.02; writeControl timeStep; writeInterval 2; progressInterval 0;";
  scene.flow = "drive { type meanVelocity; Ubar 0.1; } report 1;";
  scene.write("disk");
  const auto expect_whole = [&](const char* time) {
    for (const char* field : {"U", "p", "phi"})
      EXPECT_GT(fs::exists(scene.folder / time / field) ? fs::file_size(scene.folder / time / field) : 0, 10000u)
          << time << '/' << field;
  };
  const ProgramResult room = scene.run();
  EXPECT_EQ(room.status, 0) << room.output;
  expect_whole("0.04");
  EXPECT_GT(fs::file_size(scene.folder / "0.04/U"), kLongestFile);

  scene.file("system/controlDict", "dictionary",
             "startFrom latestTime; stopAt endTime; writeFormat ascii; writePrecision 12; endTime 0.12; deltaT 0.02; "
             "writeControl timeStep; writeInterval 2; progressInterval 0;");
  const ProgramResult full = run_program(
      {"sh", "-c",
       "trap '' XFSZ; ulimit -f " + std::to_string(kLongestFile / 512) + "; exec '" + program("annulusFoam") + "'"},
      {scene.folder, {}, 60});
  for (const char* time : {"0.08", "0.12"}) {
    const std::string warning = line_with(full.output, std::string("warning: the fields of t = ") + time + " s");
    EXPECT_NE(warning.find("were not written"), std::string::npos) << full.output;
    EXPECT_NE(warning.find("removed"), std::string::npos) << full.output;
    EXPECT_FALSE(fs::exists(scene.folder / time)) << time;
  }
  EXPECT_EQ(full.status, 1) << full.output;
  EXPECT_NE(line_with(full.output, "error: the fields of the last time, 0.12 s"), "") << full.output;
  expect_whole("0.04");

  const ProgramResult again = scene.run();
  EXPECT_EQ(again.status, 0) << again.output;
  expect_whole("0.08");
  expect_whole("0.12");
}

} // namespace
} // namespace eccentra::test
