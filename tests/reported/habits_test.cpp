// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Habits of OpenFOAM users: what acts must act, all else is refused or named in one sentence.
#include "flow/caseFiles.H"
#include "reported/flow_scene.h"

#include "dlLibraryTable.H"
#include "functionObject.H"
#include "fvPatchFields.H"

#include <cmath>
#include <fstream>
#include <set>

namespace eccentra::test {
namespace {

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
  expect_refused(scene.run(), {"0/k", "kEpsilon", "constant/turbulenceProperties"});
  scene.file("constant/turbulenceProperties", "dictionary",
             "simulationType LES; LES { LESModel Smagorinsky; turbulence on; delta cubeRootVol; }");
  expect_refused(scene.run(), {"constant/turbulenceProperties", "laminar or RAS"});
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

} // namespace
} // namespace eccentra::test
