// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes OpenFOAM cases for tests.
#include "flow/flow_case.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/wait.h>

namespace eccentra::test {

namespace fs = std::filesystem;

std::string stock_solver(const std::string& name) {
  return "LD_LIBRARY_PATH=$ECCENTRA_LIB:$LD_LIBRARY_PATH LD_PRELOAD=$ECCENTRA_SANITIZER_LIBRARY " + name;
}

Outcome run_program(const std::string& folder, const std::string& command) {
  const std::string line = "cd '" + folder + "' && " + command + " 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  Outcome outcome{-1, ""};
  char buffer[4096];
  while (size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) {
    outcome.text.append(buffer, n);
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

void FlowCase::reopen() {
  flow_.reset();
  mesh_.reset();
  time_.reset();
}

FlowCase::FlowCase(const std::string& name) : folder_(fs::absolute(name).string()) {
  Foam::messageStream::level = std::getenv("ECCENTRA_TEST_VERBOSE") ? 2 : 0;
  fs::remove_all(folder_);
  fs::create_directories(folder_ + "/0");
  control({});
  numerics("backward", "nCorrectors 2; consistent yes;");
}

void FlowCase::write(const std::string& path, const std::string& foam_class, const std::string& body) const {
  const fs::path file = fs::path(folder_) / path;
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "FoamFile { version 2.0; format ascii; class " << foam_class << "; object "
                      << file.filename().string() << "; }\n"
                      << body;
}

void FlowCase::control(const std::map<std::string, std::string>& entries) {
  std::map<std::string, std::string> all{{"startFrom", "latestTime"},
                                         {"startTime", "0"},
                                         {"stopAt", "endTime"},
                                         {"endTime", "1"},
                                         {"deltaT", "1"},
                                         {"writeControl", "timeStep"},
                                         {"writeInterval", "1000000"},
                                         {"writeFormat", "binary"},
                                         {"writePrecision", "17"},
                                         {"timePrecision", "12"},
                                         {"runTimeModifiable", "false"}};
  for (const auto& [key, value] : entries) {
    all[key] = value;
  }
  std::string body;
  for (const auto& [key, value] : all) {
    body += key + " " + value + ";\n";
  }
  dictionary("system/controlDict", body);
}

void FlowCase::numerics(const std::string& ddt, const std::string& pimple) {
  dictionary("system/fvSchemes",
             "ddtSchemes { default " + ddt +
                 "; }\n"
                 "gradSchemes { default Gauss linear; }\n"
                 "divSchemes { default none; div(phi,U) Gauss linear; div((nuEff*dev2(T(grad(U))))) Gauss linear; }\n"
                 "laplacianSchemes { default Gauss linear corrected; }\n"
                 "interpolationSchemes { default linear; }\n"
                 "snGradSchemes { default corrected; }\n");
  dictionary(
      "system/fvSolution",
      "solvers {\n"
      "\"p|pFinal\" { solver GAMG; smoother symGaussSeidel; nCellsInCoarsestLevel 20; tolerance 1e-12; relTol 0; "
      "maxIter 200; }\n"
      "\"U|UFinal\" { solver PBiCGStab; preconditioner DILU; tolerance 1e-12; relTol 0; maxIter 1000; }\n"
      "}\nPIMPLE { " +
          pimple + " }\n");
}

namespace {

std::string block_mesh(double x, double y, double z, int nx, int ny, int nz, const std::string& boundary) {
  std::ostringstream text;
  text.precision(15);
  text << "scale 1;\nvertices (";
  for (double h : {0.0, z}) {
    text << "(0 0 " << h << ") (" << x << " 0 " << h << ") (" << x << " " << y << " " << h << ") (0 " << y << " " << h
         << ") ";
  }
  text << ");\nblocks (hex (0 1 2 3 4 5 6 7) (" << nx << " " << ny << " " << nz << ") simpleGrading (1 1 1));\n"
       << "boundary (" << boundary << ");\n";
  return text.str();
}

std::string cyclic(const std::string& name, const std::string& other, const std::string& face) {
  return name + " { type cyclic; neighbourPatch " + other + "; faces ((" + face + ")); }\n";
}

const std::string kAlongX = cyclic("inlet", "outlet", "0 4 7 3") + cyclic("outlet", "inlet", "1 2 6 5");
const std::string kAlongY = cyclic("low", "high", "0 1 5 4") + cyclic("high", "low", "3 7 6 2");
const std::string kAlongZ = cyclic("back", "front", "0 3 2 1") + cyclic("front", "back", "4 5 6 7");

void make_mesh(const std::string& folder, const std::string& program) {
  const Outcome outcome = run_program(folder, program);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
}

std::string program_path(const std::string& name) {
  return std::string(std::getenv("ECCENTRA_BIN")) + "/" + name;
}

} // namespace

void FlowCase::channel_mesh(double gap, int cells_along, int cells_across) {
  dictionary("system/blockMeshDict", block_mesh(gap, gap, gap, cells_along, cells_across, 1,
                                                kAlongX + "walls { type wall; faces ((0 1 5 4) (3 7 6 2)); }\n"
                                                          "sides { type empty; faces ((0 3 2 1) (4 5 6 7)); }\n"));
  make_mesh(folder_, "blockMesh");
}

void FlowCase::periodic_box_mesh(double length, int nx, int ny, int nz) {
  dictionary("system/blockMeshDict", block_mesh(length, length, length, nx, ny, nz, kAlongX + kAlongY + kAlongZ));
  make_mesh(folder_, "blockMesh");
}

void FlowCase::annulus_mesh(double eccentricity, int radial, int around, int axial, double length,
                            double wall_grading) {
  std::ostringstream text;
  text.precision(15);
  text << "holeRadius 0.0635; pipeRadius 0.02413; eccentricity " << eccentricity << "; length " << length << "; cells ("
       << radial << " " << around << " " << axial << "); ends periodic; wallGrading " << wall_grading << ";\n";
  dictionary("system/annulusMeshDict", text.str());
  make_mesh(folder_, program_path("annulusMesh"));
}

void FlowCase::fluid(const std::string& model, double rho, const std::string& coefficients, const std::string& more) {
  std::ostringstream text;
  text << "transportModel " << model << ";\nrho " << rho << ";\n"
       << model << "Coeffs { " << coefficients << " }\n"
       << (model == "Newtonian" ? coefficients : "") << more << "\n";
  dictionary("constant/transportProperties", text.str());
}

void FlowCase::newtonian(double rho, double mu) {
  std::ostringstream text;
  text.precision(15);
  text << "transportModel Newtonian;\nrho " << rho << ";\nnu " << mu / rho << ";\n";
  dictionary("constant/transportProperties", text.str());
}

void FlowCase::fields(const std::string& U_internal, const std::string& U_boundary, const std::string& p_boundary) {
  write("0/U", "volVectorField",
        "dimensions [0 1 -1 0 0 0 0];\ninternalField " + U_internal + ";\nboundaryField { " + U_boundary + " }\n");
  write("0/p", "volScalarField",
        "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\nboundaryField { " + p_boundary + " }\n");
}

void FlowCase::channel_fields() {
  const std::string ends = "inlet { type cyclic; } outlet { type cyclic; } sides { type empty; } ";
  fields("uniform (0 0 0)", ends + "walls { type noSlip; }", ends + "walls { type zeroGradient; }");
}

void FlowCase::annulus_fields(double eccentricity, double omega) {
  const std::string ends = "inlet { type cyclic; } outlet { type cyclic; } ";
  std::ostringstream pipe;
  pipe.precision(15);
  pipe << "pipe { type rotatingWallVelocity; origin (0 " << -eccentricity * (0.0635 - 0.02413)
       << " 0); axis (0 0 1); omega " << omega << "; } ";
  fields("uniform (0 0 0)", ends + pipe.str() + "hole { type noSlip; }", ends + "\"pipe|hole\" { type zeroGradient; }");
}

Foam::Time& FlowCase::time() {
  if (!time_) {
    const fs::path path(folder_);
    time_ = std::make_unique<Foam::Time>(Foam::Time::controlDictName, Foam::fileName(path.parent_path().string()),
                                         Foam::fileName(path.filename().string()), Foam::word("system"),
                                         Foam::word("constant"), false);
  }
  return *time_;
}

Foam::fvMesh& FlowCase::mesh() {
  if (!mesh_) {
    mesh_ = std::make_unique<Foam::fvMesh>(
        Foam::IOobject(Foam::fvMesh::defaultRegion, time().timeName(), time(), Foam::IOobject::MUST_READ));
  }
  return *mesh_;
}

Foam::averagedFlow& FlowCase::flow(Foam::averagedFlow::particles presence, Foam::averagedFlow::stressShare share) {
  if (!flow_) {
    flow_ = std::make_unique<Foam::averagedFlow>(mesh(), presence, share);
  }
  return *flow_;
}

void FlowCase::advance(int steps, const std::function<void(double)>& before) {
  flow(); // reads the start time, so it must exist before the first step
  for (int i = 0; i < steps; ++i) {
    ++time();
    if (before) {
      before(time().value());
    }
    flow().advance();
  }
}

double FlowCase::steady(const std::function<double()>& value, double tolerance, int max_steps) {
  double last = 0, present = 0;
  for (int i = 0; i < max_steps; ++i) {
    advance(1);
    last = present;
    present = value();
    if (std::abs(present - last) <= tolerance * std::abs(present)) {
      return present;
    }
  }
  ADD_FAILURE() << "not steady after " << max_steps << " steps: " << last << ", then " << present;
  return present;
}

double mean_velocity(const Foam::averagedFlow& flow, int component) {
  return flow.superficialVelocity()[component];
}

} // namespace eccentra::test
