// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Habits of OpenFOAM users: what acts must act, all else is refused or named in one sentence.
#include "flow/caseFiles.H"
#include "rheology/slot_flow.h"
#include "support/run_program.h"

#include "dlLibraryTable.H"
#include "functionObject.H"
#include "fvPatchFields.H"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <sys/mount.h>
#include <sys/stat.h>

namespace eccentra::test {
namespace {

namespace fs = std::filesystem;

std::string program(const char* name) {
  return required_environment("ECCENTRA_BIN") + "/" + name;
}

/// A case of an annulus; the members are the contents of its files.
struct FlowScene {
  std::string mesh = "holeRadius 0.11; pipeRadius 0.10; eccentricity 0; length 0.02; inclination 0; cells (10 16 1);";
  std::string ends = "periodic";
  std::string control = "endTime 2; deltaT 0.02; writeControl runTime; writeInterval 2; progressInterval 0;";
  std::string transport = "transportModel Newtonian; nu [0 2 -1 0 0 0 0] 1e-4; rho 1000;";
  std::string flow; ///< flowProperties; none if empty
  std::string pipe = "type noSlip;";
  std::string U = "(0 0 0.1)";
  std::string inlet = "type fixedValue; value uniform (0 0 0.1);";
  std::string p_pipe = "type zeroGradient;";
  std::string pimple = "PIMPLE { nCorrectors 2; consistent yes; }";
  std::string ddt = "backward";
  std::string iterations = "200"; ///< of the pressure, at most

  void file(const std::string& path, const std::string& cls, const std::string& body) const {
    fs::create_directories((folder / path).parent_path());
    write_file(folder / path, "FoamFile { version 2.0; format ascii; class " + cls + "; object " +
                                  fs::path(path).filename().string() + "; }\n" + body + "\n");
  }
  void write(const std::string& name) {
    folder = fresh_folder(name);
    const bool periodic = ends == "periodic";
    file("system/annulusMeshDict", "dictionary", mesh + " ends " + ends + ";");
    file("system/controlDict", "dictionary",
         "startFrom startTime; startTime 0; stopAt endTime; writeFormat ascii; writePrecision 12; " + control);
    file("system/fvSchemes", "dictionary",
         "ddtSchemes { default " + ddt +
             "; } gradSchemes { default Gauss linear; } divSchemes { default none; div(phi,U) Gauss linear; "
             "div((nuEff*dev2(T(grad(U))))) Gauss linear; } laplacianSchemes { default Gauss linear corrected; } "
             "interpolationSchemes { default linear; } snGradSchemes { default corrected; }");
    file("system/fvSolution", "dictionary",
         "solvers { \"p|pFinal\" { solver GAMG; smoother symGaussSeidel; nCellsInCoarsestLevel 20; tolerance 1e-10; "
         "relTol 0; maxIter " +
             iterations +
             "; } \"U|UFinal\" { solver PBiCGStab; preconditioner DILU; tolerance 1e-10; relTol 0; } "
             "} " +
             pimple);
    file("constant/transportProperties", "dictionary", transport);
    if (!flow.empty())
      file("constant/flowProperties", "dictionary", flow);
    const std::string cyclic = "type cyclic;";
    file("0/U", "volVectorField",
         "dimensions [0 1 -1 0 0 0 0]; internalField uniform " + U + "; boundaryField { hole { type noSlip; } pipe { " +
             pipe + " } inlet { " + (periodic ? cyclic : inlet) + " } outlet { " +
             (periodic ? cyclic : "type zeroGradient;") + " } }");
    file("0/p", "volScalarField",
         "dimensions [0 2 -2 0 0 0 0]; internalField uniform 0; boundaryField { hole { type zeroGradient; } pipe { " +
             p_pipe + " } inlet { " + (periodic ? cyclic : "type zeroGradient;") + " } outlet { " +
             (periodic ? cyclic : "type fixedValue; value uniform 0;") + " } }");
    const ProgramResult made = run_program({program("annulusMesh")}, {folder, {}, 60});
    ASSERT_EQ(made.status, 0) << made.output;
  }
  ProgramResult run() const { return run_program({program("annulusFoam")}, {folder, {}, 150}); }

  fs::path folder;
};

/// The line that holds these arguments, empty if none does.
std::string line_with(const std::string& text, const std::string& arguments) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(arguments) != std::string::npos)
      return line;
  return "";
}

/// One sentence of annulusFoam that names each of these arguments; exit code 1.
void expect_refused(const ProgramResult& result, const std::vector<std::string>& arguments) {
  EXPECT_EQ(result.status, 1) << result.output;
  const std::string line = line_with(result.output, ": error: ");
  for (const std::string& word : arguments)
    EXPECT_NE(line.find(word), std::string::npos) << word << "\n" << result.output;
}

std::string note_of(const ProgramResult& result) {
  return line_with(result.output, "annulusFoam: note: ");
}

std::map<std::string, double> last_row(const fs::path& table) {
  std::ifstream file(table);
  std::string names, line, last;
  std::getline(file, names);
  while (std::getline(file, line))
    last = line;
  std::map<std::string, double> row;
  std::istringstream name(names), value(last);
  for (std::string n, v; std::getline(name, n, ',') && std::getline(value, v, ',');)
    row[n] = std::stod(v);
  return row;
}

/// Numbers of the last line of a table of OpenFOAM, without its brackets.
std::vector<double> last_numbers(const fs::path& table) {
  std::ifstream file(table);
  std::string line, last;
  while (std::getline(file, line))
    if (!line.empty() && line[0] != '#')
      last = line;
  for (char& c : last)
    if (c == '(' || c == ')')
      c = ' ';
  std::istringstream arguments(last);
  std::vector<double> numbers;
  for (std::string word; arguments >> word;) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (end != word.c_str() && *end == '\0')
      numbers.push_back(number);
  }
  return numbers;
}

TEST(Reported, openfoam_habits_fvOptions) {
  FlowScene scene;
  scene.write("fv");
  const char* const drive =
      "drive { type meanVelocityForce; active ACTIVE; meanVelocityForceCoeffs { selectionMode all; "
      "fields (U); Ubar (0 0 0.1); relaxation 1; } }";
  const auto body = [&](const std::string& active) {
    std::string text = drive;
    return text.replace(text.find("ACTIVE"), 6, active);
  };
  for (const char* place : {"constant/fvOptions", "system/fvOptions"}) {
    scene.file(place, "dictionary", body("yes"));
    expect_refused(scene.run(), {place, "flowProperties", "meanVelocity"});
    fs::remove(scene.folder / place);
  }
  // What the remedy says works, and an inactive entry is no reason to stop.
  scene.file("constant/fvOptions", "dictionary", body("no"));
  scene.file("constant/flowProperties", "dictionary", "drive { type meanVelocity; Ubar 0.1; }");
  const ProgramResult result = scene.run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("<alpha U> 0.1 m/s"), std::string::npos) << result.output;
}

TEST(Reported, openfoam_habits_MRF) {
  FlowScene scene;
  scene.write("mrf");
  scene.file("constant/MRFProperties", "dictionary",
             "MRF1 { cellZone all; active yes; nonRotatingPatches (hole); origin (0 0 0); axis (0 0 1); omega 100; }");
  expect_refused(scene.run(), {"constant/MRFProperties", "rotatingWallVelocity"});
}

TEST(Reported, openfoam_habits_RAS) {
  FlowScene scene;
  scene.control = "endTime 0.04; deltaT 0.02; writeControl runTime; writeInterval 2;";
  scene.write("ras");
  scene.file("constant/turbulenceProperties", "dictionary",
             "simulationType RAS; RAS { RASModel kEpsilon; turbulence on; printCoeffs on; }");
  expect_refused(scene.run(), {"constant/turbulenceProperties", "laminar"});
  scene.file("constant/turbulenceProperties", "dictionary", "simulationType laminar;");
  const ProgramResult laminar = scene.run();
  EXPECT_EQ(laminar.status, 0) << laminar.output;
  EXPECT_EQ(note_of(laminar), "");
}

/// Torque per length on a pipe turning in a power-law fluid, and what stock's function objects say of it.
TEST(Reported, openfoam_habits_function_objects) {
  constexpr double R = 0.0635, r = 0.02413, L = 0.05, omega = 5.235988, k = 0.28, n = 0.65;
  const double a = std::pow(r, -2 / n), b = std::pow(R, -2 / n);
  const double stress = k * std::pow(2 / n * omega * a / (a - b), n); // at the pipe
  const double torque = 2 * M_PI * r * r * L * stress;
  FlowScene scene;
  scene.mesh = "holeRadius 0.0635; pipeRadius 0.02413; eccentricity 0; length 0.05; cells (32 32 1); wallGrading 4;";
  scene.U = "(0 0 0)";
  scene.pipe = "type rotatingWallVelocity; origin (0 0 0); axis (0 0 1); omega 5.235988;";
  scene.transport = "transportModel HerschelBulkleyCapped; rho 1000; nu 1e-6; HerschelBulkleyCappedCoeffs { tau0 0; k "
                    "0.28; n 0.65; muY 100; }";
  const char* const forces = "libs (forces); patches (pipe); rho rhoInf; rhoInf 1000; CofR (0 0 0); writeControl "
                             "timeStep; writeInterval 1; log no;";
  std::ostringstream functions;
  functions
      << "functions { forces1 { type forces; " << forces
      << " } coeffs { type forceCoeffs; magUInf 1; lRef 1; Aref 1; dragDir (0 0 1); liftDir (0 1 0); pitchAxis (0 0 "
         "1); "
      << forces
      << " } wall { type wallShearStress; libs (fieldFunctionObjects); patches (pipe); log no; writeControl "
         "writeTime; } plus { type yPlus; libs (fieldFunctionObjects); log no; writeControl timeStep; "
         "writeInterval 1; } mean { type fieldAverage; libs (fieldFunctionObjects); log no; fields (U { mean on; "
         "prime2Mean off; base time; }); writeControl writeTime; } point { type probes; libs (sampling); log no; "
         "fields (U); probeLocations ((0 0.04 0.02)); } drop { type surfaceFieldValue; libs "
         "(fieldFunctionObjects); log no; writeFields no; regionType patch; name pipe; operation areaAverage; "
         "fields (p); } }";
  scene.control =
      "endTime 300; deltaT 1; writeControl timeStep; writeInterval 300; progressInterval 1000; " + functions.str();
  scene.write("function_objects");
  const ProgramResult result = scene.run();
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(note_of(result), "") << result.output;
  const fs::path post = scene.folder / "postProcessing";
  // Pressure and viscous moments (v1912: total, pressure, viscous), z.
  const std::vector<double> moment = last_numbers(post / "forces1/0/moment.dat");
  ASSERT_GE(moment.size(), 4u);
  EXPECT_NEAR(moment[3], -torque, 0.01 * torque);
  EXPECT_FALSE(last_numbers(post / "coeffs/0/coefficient.dat").empty());
  EXPECT_FALSE(last_numbers(post / "plus/0/yPlus.dat").empty());
  EXPECT_FALSE(last_numbers(post / "point/0/U").empty());
  EXPECT_FALSE(last_numbers(post / "drop/0/surfaceFieldValue.dat").empty());
  EXPECT_TRUE(fs::exists(scene.folder / "300/UMean"));
  // Kinematic, along the wall: the components reach the stress over the density.
  const std::vector<double> wall = last_numbers(post / "wall/0/wallShearStress.dat");
  ASSERT_GE(wall.size(), 7u);
  EXPECT_NEAR(wall[4], stress / 1000, 0.02 * stress / 1000);
  // Ours, on the last line of the table: the same force and torque as stock's, the right ones.
  const auto row = last_row(post / "eccentra/0/flow.csv");
  EXPECT_NEAR(row.at("pipe_torque"), moment[3], 1e-4 * torque);
  EXPECT_NEAR(row.at("hole_torque"), torque, 0.01 * torque);
  EXPECT_NE(result.output.find("pipe |F|"), std::string::npos) << result.output;
}

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

TEST(Reported, adversary_17_openfoam_folder_missing) {
  FlowScene scene;
  scene.control = "endTime 0.04; deltaT 0.02; writeControl runTime; writeInterval 2;";
  scene.flow = "drive { type meanVelocity; Ubar 0.1; }";
  scene.write("folder");
  for (const std::string& name : {program("annulusMesh"), program("annulusFoam")})
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"env", "-u", "WM_PROJECT_DIR", name},
          std::vector<std::string>{"env", "WM_PROJECT_DIR=/nonexistent", name},
          std::vector<std::string>{"env", "WM_PROJECT_DIR=", name}}) {
      const ProgramResult result = run_program(arguments, {scene.folder, {}, 60});
      EXPECT_EQ(result.status, 0) << name << result.output;
      EXPECT_EQ(result.output.find("FATAL"), std::string::npos) << result.output;
    }
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

TEST(Reported, issue_files_that_stock_solvers_read) {
  FlowScene scene;
  scene.control = "endTime 0.02; deltaT 0.02; writeControl runTime; writeInterval 2;";
  scene.flow = "drive { type meanVelocity; Ubar 0.1; }";
  scene.write("files");
  ASSERT_EQ(note_of(scene.run()), "");
  // The whole table in this process; the program itself with the rows above.
  int refused = 0, noted = 0;
  for (const Foam::caseFile& file : Foam::caseFiles()) {
    std::string name = file.name;
    const auto star = name.find('*');
    if (star != std::string::npos)
      name.replace(star, 1, star == 0 ? "reacting" : "Extra");
    for (const char* folder : {"constant/", "system/"}) {
      const std::string path = folder + name;
      if (file.decision == Foam::verdict::acts || file.decision == Foam::verdict::harmless)
        continue;
      scene.file(path, "dictionary", "one { type other; active yes; } two 2;");
      testing::internal::CaptureStdout();
      std::string error;
      try {
        Foam::Time time("controlDict", Foam::fileName(scene.folder.parent_path().string()),
                        Foam::fileName(scene.folder.filename().string()), Foam::word("system"), Foam::word("constant"),
                        false);
        Foam::checkCaseFiles(time);
      } catch (const std::exception& problem) {
        error = problem.what();
      }
      const std::string printed = testing::internal::GetCapturedStdout();
      if (file.decision == Foam::verdict::refused) {
        ++refused;
        EXPECT_NE(error.find(path + ": "), std::string::npos) << path << ": " << error;
        EXPECT_NE(error.find(file.remedy), std::string::npos) << path << ": " << error;
        EXPECT_GT(std::string(file.remedy).size(), 20u) << path;
      } else {
        ++noted;
        EXPECT_EQ(error, "") << path;
        EXPECT_NE(printed.find(path), std::string::npos) << printed;
      }
      fs::remove(scene.folder / path);
    }
  }
  // Of a phase, compressed, unknown, a copy, fields of other solvers.
  scene.file("constant/turbulenceProperties.water", "dictionary", "simulationType RAS;");
  expect_refused(scene.run(), {"constant/turbulenceProperties.water"});
  fs::remove(scene.folder / "constant/turbulenceProperties.water");
  scene.file("constant/FlowProperties", "dictionary", "drive { type none; }");
  scene.file("constant/fvOptions.orig", "dictionary", "drive { type meanVelocityForce; }");
  scene.file("0/k", "volScalarField", "dimensions [0 2 -2 0 0 0 0]; internalField uniform 0; boundaryField {}");
  const ProgramResult named = scene.run();
  EXPECT_EQ(named.status, 0) << named.output;
  EXPECT_NE(note_of(named).find("constant/FlowProperties"), std::string::npos) << named.output;
  EXPECT_NE(note_of(named).find("0/k"), std::string::npos) << named.output;
  EXPECT_EQ(note_of(named).find("orig"), std::string::npos) << named.output;
}

TEST(Reported, issue_function_object_types) {
  // All that Debian's libraries offer is known to work on any fields, or is in the table.
  Foam::dlLibraryTable libraries;
  for (const char* library :
       {"libfieldFunctionObjects.so", "libforces.so", "libsampling.so", "libutilityFunctionObjects.so",
        "libsolverFunctionObjects.so", "liblagrangianFunctionObjects.so", "libinitialisationFunctionObjects.so"})
    ASSERT_TRUE(libraries.open(library, true)) << library;
  std::set<std::string> known;
  for (const Foam::caseType& type : Foam::functionObjectTypes())
    known.insert(type.name);
  // Fields, patches, times, files: these need nothing of a solver.
  const std::set<std::string> general{"AMIWeights",
                                      "CourantNo",
                                      "Curle",
                                      "Lambda2",
                                      "PecletNo",
                                      "Q",
                                      "abort",
                                      "add",
                                      "areaWrite",
                                      "blendingFactor",
                                      "coded",
                                      "columnAverage",
                                      "components",
                                      "continuityError",
                                      "ddt",
                                      "ddt2",
                                      "derivedFields",
                                      "div",
                                      "ensightWrite",
                                      "enstrophy",
                                      "extractEulerianParticles",
                                      "fieldAverage",
                                      "fieldCoordinateSystemTransform",
                                      "fieldExtents",
                                      "fieldMinMax",
                                      "fieldValueDelta",
                                      "flowType",
                                      "flux",
                                      "fluxSummary",
                                      "forceCoeffs",
                                      "forces",
                                      "grad",
                                      "histogram",
                                      "lambVector",
                                      "limitFields",
                                      "mag",
                                      "magSqr",
                                      "mapFields",
                                      "momentum",
                                      "nearWallFields",
                                      "parProfiling",
                                      "patchProbes",
                                      "pressure",
                                      "probes",
                                      "processorField",
                                      "randomise",
                                      "readFields",
                                      "reference",
                                      "regionSizeDistribution",
                                      "removeRegisteredObject",
                                      "runTimeControl",
                                      "scalarTransport",
                                      "setFlow",
                                      "setTimeStep",
                                      "sets",
                                      "solverInfo",
                                      "stabilityBlendingFactor",
                                      "streamFunction",
                                      "streamLine",
                                      "subtract",
                                      "surfaceDistance",
                                      "surfaceFieldValue",
                                      "surfaceInterpolate",
                                      "surfaces",
                                      "systemCall",
                                      "timeActivatedFileUpdate",
                                      "timeInfo",
                                      "valueAverage",
                                      "volFieldValue",
                                      "vorticity",
                                      "vtkWrite",
                                      "wallBoundedStreamLine",
                                      "wallShearStress",
                                      "writeCellCentres",
                                      "writeCellVolumes",
                                      "writeDictionary",
                                      "writeObjects",
                                      "yPlus",
                                      "zeroGradient"};
  for (const Foam::word& type : Foam::functionObject::dictionaryConstructorTablePtr_->sortedToc())
    EXPECT_TRUE(known.count(type) || general.count(type)) << type;
  // One that cannot act is named, one that cannot be made too.
  FlowScene scene;
  scene.flow = "drive { type meanVelocity; Ubar 0.1; }";
  scene.control =
      "endTime 0.04; deltaT 0.02; writeControl runTime; writeInterval 2; functions { a { type turbulenceFields; "
      "libs (fieldFunctionObjects); field R; fields (R); } b { type forcez; libs (forces); } c { type forces; "
      "libs (forces); patches (pipe); rho rhoInf; rhoInf 1; CofR (0 0 0); } }";
  scene.write("types");
  const ProgramResult result = scene.run();
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("functions/a of system/controlDict (turbulenceFields"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("b (type forcez)"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("rhoInf is 1"), std::string::npos) << result.output;
}

TEST(Reported, issue_boundary_types) {
  FlowScene scene;
  for (const Foam::caseType& type : Foam::boundaryTypes()) {
    const bool scalar = std::string(type.remedy).find("p is p_rgh") == 0 ||
                        std::string(type.name) == "plenumPressure" ||
                        std::string(type.name) == "fixedPressureCompressibleDensity" ||
                        std::string(type.name) == "variableHeightFlowRate";
    // Each type of stock exists under this name; the sentence itself is the same for all.
    EXPECT_TRUE(scalar ? Foam::fvPatchScalarField::dictionaryConstructorTablePtr_->found(type.name)
                       : Foam::fvPatchVectorField::dictionaryConstructorTablePtr_->found(type.name))
        << type.name;
  }
  scene.p_pipe = "type uniformDensityHydrostaticPressure; rho 1000; pRefValue 0; pRefPoint (0 0 0); value uniform 0;";
  scene.write("boundary");
  expect_refused(scene.run(), {"p: pipe", "uniformDensityHydrostaticPressure", "p_rgh"});
}

TEST(Reported, issue_unread_entries) {
  FlowScene scene;
  scene.control = "endTime 0.04; deltaT 0.02; writeControl runTime; writeInterval 2;";
  scene.flow = "drive { type meanVelocity; Ubar 0.1; }";
  const struct {
    const char *pimple, *word;
    bool refused;
  } cases[] = {
      {"PISO { nCorrectors 2; }", "PISO", true},
      {"SIMPLE { consistent yes; }", "SIMPLE", true},
      {"PIMPLE { nCorrectors 2; solveFlow no; }", "solveFlow", true},
      {"PIMPLE { nCorrectors 2; frozenFlow yes; }", "frozenFlow", true},
      {"PIMPLE { nCorrectors 2; transonic yes; }", "transonic", true},
      {"PIMPLE { nCorrectors 2; pRefPoint (0 0 0); }", "pRefPoint", true},
      {"PIMPLE { nCorrectors 2; } PISO { nCorrectors 3; }", "PISO", false},
      {"PIMPLE { nCorrectors 2; nOuterCorector 5; }", "PIMPLE/nOuterCorector", false},
      {"PIMPLE { nCorrectors 2; correctPhi yes; }", "PIMPLE/correctPhi", false},
      {"PIMPLE { nCorrectors 2; turbOnFinalIterOnly no; }", "turbOnFinalIterOnly", false},
      {"PIMPLE { nCorrectors 2; residualControl { U { tolerance 1e-5; relTol 0; } } }", "residualControl", false},
      {"PIMPLE { nCorrectors 2; } relaxationFactors { equations { U 0.7; } }", "relaxationFactors/equations/U", false},
      {"PIMPLE { nCorrectors 2; } relaxationFactors { fields { p 0.3; } }", "relaxationFactors/fields/p", false},
      {"PIMPLE { nCorrectors 2; } relaxationFactors { equations { k 0.7; } }", "relaxationFactors/equations/k", false},
  };
  for (const auto& c : cases) {
    scene.pimple = c.pimple;
    scene.write("entries");
    const ProgramResult result = scene.run();
    if (c.refused) {
      expect_refused(result, {"fvSolution", c.word});
    } else {
      EXPECT_EQ(result.status, 0) << result.output;
      EXPECT_NE(note_of(result).find(c.word), std::string::npos) << c.word << result.output;
    }
  }
  scene.pimple = "PIMPLE { nOuterCorrectors 2; nCorrectors 2; turbOnFinalIterOnly no; residualControl { U { tolerance "
                 "1e-5; relTol 0; } } } relaxationFactors { equations { U 0.7; } fields { p 0.3; } }";
  scene.write("entries");
  EXPECT_EQ(note_of(scene.run()), "");
  scene.pimple = "PIMPLE { nCorrectors 2; }";
  const char* const wrong[] = {"drive { type meanVelocity; Ubar 0.1; gradient 100; }",
                               "drive { type pressureGradient; gradient 100; Ubar 0.1; }",
                               "drive { type meanVelocity; Ubar 0.1; } Drive { type none; }"};
  const char* const arguments[] = {"gradient", "Ubar", "Drive"};
  for (int i = 0; i < 3; ++i) {
    scene.flow = wrong[i];
    scene.write("entries");
    expect_refused(scene.run(), {"flowProperties", arguments[i]});
  }
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

/// A vertical pipe section with a bed of held spheres at its lower end, which is the inlet.
struct BedScene : FlowScene {
  std::string coupling, script;
  BedScene() {
    ends = "inletOutlet";
    mesh = "holeRadius 0.03; pipeRadius 0.01; eccentricity 0; length 0.06; cells (4 12 8);";
    control = "endTime 1000; deltaT 0.002; writeControl timeStep; writeInterval 100000;";
    transport = "transportModel Newtonian; nu 1e-5; rho 1000;";
    U = "(0 0 0)";
  }
  void write_all(const std::string& name) {
    write(name);
    file("constant/couplingProperties", "dictionary",
         "link solver; demScript \"in.dem\"; report 5; length 0.012; " + coupling);
    write_file(
        folder / "in.dem",
        "atom_style granular\natom_modify map array\nboundary f f f\nnewton off\ncommunicate single vel yes\nunits "
        "si\nregion box block -0.031 0.031 -0.031 0.031 0 0.06 units box\ncreate_box 1 box\nneighbor 0.002 bin\n"
        "neigh_modify delay 0\nfix m1 all property/global youngsModulus peratomtype 5e6\nfix m2 all property/global "
        "poissonsRatio peratomtype 0.25\nfix m3 all property/global coefficientRestitution peratomtypepair 1 0.3\n"
        "fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\npair_style gran model hertz "
        "tangential history\npair_coeff * *\ntimestep 1e-4\nlattice sc 0.0065\nregion ring cylinder z 0 0 0.026 "
        "0.002 0.02 units box\nregion hole cylinder z 0 0 0.0135 0 0.03 side out units box\nregion bed intersect "
        "2 ring hole\ncreate_atoms 1 region bed\nset group all diameter 0.006 density 2600\nfix hold all freeze\n"
        "fix gravity all gravity 9.81 vector 0 0 -1\nfix drag all fluid/force rheology herschel_bulkley 0 0.01 1 "
        "density 1000 drag schiller_naumann\nfix fluid all fluid/couple link solver every 20\nrun 400\n" +
            script);
  }
};

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

TEST(Reported, adversary_17_half_written_time) {
  FlowScene scene;
  scene.mesh = "holeRadius 0.11; pipeRadius 0.10; eccentricity 0; length 0.02; inclination 0; cells (10 32 10);";
  scene.control = "endTime 0.08; deltaT 0.02; writeControl timeStep; writeInterval 2; progressInterval 0;";
  scene.flow = "drive { type meanVelocity; Ubar 0.1; } report 1;";
  scene.write("disk");
  const fs::path small = fresh_folder("small");
  if (mount("tmpfs", small.c_str(), "tmpfs", 0, "size=1500k") != 0)
    GTEST_SKIP() << "needs the right to mount";
  // The mesh takes 0.7 MB; the ballast leaves room for one time, not for two.
  struct Mounted {
    fs::path at;
    ~Mounted() { umount(at.c_str()); }
  } mounted{small};
  const std::string copy = "cp -r " + (scene.folder).string() + "/* " + small.string();
  ASSERT_EQ(std::system(copy.c_str()), 0);
  const auto space = fs::space(small).available;
  std::ofstream(small / "ballast") << std::string(space > 300000 ? space - 300000 : 0, 'x');
  const ProgramResult result = run_program({program("annulusFoam")}, {small, {}, 60});
  const std::string warning = line_with(result.output, "warning: the fields of t = ");
  EXPECT_NE(warning.find("No space left on device"), std::string::npos) << result.output;
  EXPECT_NE(warning.find("removed"), std::string::npos) << result.output;
  // Each time that is there is whole.
  int there = 0;
  for (const char* time : {"0.04", "0.08"})
    if (fs::exists(small / time)) {
      ++there;
      for (const char* field : {"U", "p", "phi"})
        EXPECT_GT(fs::file_size(small / time / field), 1000u) << time << field;
    }
  EXPECT_LT(there, 2);
  EXPECT_EQ(result.status, fs::exists(small / "0.08") ? 0 : 1) << result.output;
}

} // namespace
} // namespace eccentra::test
