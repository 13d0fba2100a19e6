// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the files of a coupled box case and runs it.
#include "coupled/coupled_case.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace eccentra::test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& cls, const std::string& contents) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file);
  out << "FoamFile { version 2.0; format ascii; class " << cls << "; object " << file.filename().string() << "; }\n"
      << contents << '\n';
}

int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string mesh_dictionary(const BoxCase& box) {
  std::ostringstream text;
  text << "scale 1; vertices (";
  for (int k = 0; k < 8; ++k)
    text << '(' << ((k ^ (k >> 1)) & 1) * box.size[0] << ' ' << ((k >> 1) & 1) * box.size[1] << ' '
         << ((k >> 2) & 1) * box.size[2] << ')';
  text << "); blocks (hex (0 1 2 3 4 5 6 7) (" << box.cells[0] << ' ' << box.cells[1] << ' ' << box.cells[2]
       << ") simpleGrading (1 1 1)); edges (); boundary (";
  const char* names[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
  const char* faces[3][2] = {{"(0 4 7 3)", "(1 2 6 5)"}, {"(0 1 5 4)", "(3 7 6 2)"}, {"(0 3 2 1)", "(4 5 6 7)"}};
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      text << names[d][side] << " { ";
      if (box.periodic[d])
        text << "type cyclic; neighbourPatch " << names[d][1 - side] << "; ";
      else
        text << "type wall; ";
      text << "faces (" << faces[d][side] << "); } ";
    }
  text << "); mergePatchPairs ();";
  return text.str();
}

std::string boundary(const BoxCase& box, const std::string& at_walls) {
  const char* names[3] = {"(left|right)", "(front|back)", "(bottom|top)"};
  std::string text = "boundaryField { ";
  for (int d = 0; d < 3; ++d)
    text += std::string("\"") + names[d] + "\" { type " + (box.periodic[d] ? "cyclic" : at_walls) + "; } ";
  return text + "}";
}

std::vector<std::map<std::string, double>> read_csv(const fs::path& file) {
  std::vector<std::map<std::string, double>> rows;
  std::ifstream in(file);
  std::string line, word;
  std::vector<std::string> names;
  if (std::getline(in, line)) {
    std::istringstream arguments(line);
    while (std::getline(arguments, word, ','))
      names.push_back(word);
  }
  while (std::getline(in, line)) {
    std::istringstream arguments(line);
    std::map<std::string, double> row;
    for (const std::string& name : names) {
      std::getline(arguments, word, ',');
      row[name] = std::stod(word);
    }
    rows.push_back(row);
  }
  return rows;
}

std::string read_all(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A model of k and epsilon and its fields, of a turbulence that a stirrer could have left.
void write_turbulence(const BoxCase& box, const fs::path& folder) {
  write(folder / "constant/turbulenceProperties", "dictionary",
        "simulationType RAS; RAS { RASModel " + box.turbulence + "; turbulence on; printCoeffs off; }");
  const auto field = [&](const char* name, const char* dimensions, const char* value, const char* at_walls) {
    write(folder / "0" / name, "volScalarField",
          std::string("dimensions ") + dimensions + "; internalField uniform " + value + "; " +
              boundary(box, std::string(at_walls) + "; value uniform " + value));
  };
  field("k", "[0 2 -2 0 0 0 0]", "0.01", "kqRWallFunction");
  field("epsilon", "[0 2 -3 0 0 0 0]", "0.05", "epsilonWallFunction");
  field("nut", "[0 2 -1 0 0 0 0]", "0", "nutkWallFunction");
}

void write_case(const BoxCase& box, const fs::path& folder) {
  write(folder / "system/blockMeshDict", "dictionary", mesh_dictionary(box));
  std::ostringstream control, transport, solution;
  control << "startTime 0; endTime 1000; writeControl timeStep; writeInterval 100000; writePrecision 12; deltaT "
          << box.step << "; " << box.control;
  write(folder / "system/controlDict", "dictionary", control.str());
  write(folder / "system/fvSchemes", "dictionary",
        "ddtSchemes { default " + box.time_scheme +
            "; } gradSchemes { default Gauss linear; } interpolationSchemes { default linear; } "
            "snGradSchemes { default corrected; } laplacianSchemes { default Gauss linear corrected; } "
            "divSchemes { default none; div(phi,U) Gauss linear; div((nuEff*dev2(T(grad(U))))) Gauss linear; " +
            (box.turbulence.empty()
                 ? "}"
                 : R"--("div\(alphaPhi,(k|epsilon)\)" Gauss upwind; } wallDist { method meshWave; })--"));
  solution << "solvers { \"(p|pFinal)\" { solver PCG; preconditioner DIC; relTol 0; tolerance " << box.tolerance
           << "; } \"(U|k|epsilon)(Final)?\" { solver PBiCGStab; preconditioner DILU; relTol 0; tolerance "
           << box.tolerance << "; } } PIMPLE { nOuterCorrectors 1; momentumPredictor yes; nCorrectors "
           << box.correctors << "; }";
  write(folder / "system/fvSolution", "dictionary", solution.str());
  write(folder / "system/decomposeParDict", "dictionary", "numberOfSubdomains 2; method simple; coeffs { n (1 1 2); }");
  transport << "rho " << box.density << "; ";
  if (box.rheology.empty())
    transport << "transportModel Newtonian; nu " << box.viscosity / box.density << ';';
  else
    transport << box.rheology;
  write(folder / "constant/transportProperties", "dictionary", transport.str());
  if (!box.drive.empty())
    write(folder / "constant/flowProperties", "dictionary", box.drive);
  write(folder / "constant/couplingProperties", "dictionary",
        "link solver; demScript \"in.dem\"; report 1; " + box.coupling);
  write(folder / "0/U", "volVectorField",
        "dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0); " + boundary(box, "noSlip"));
  write(folder / "0/p", "volScalarField",
        "dimensions [0 2 -2 0 0 0 0]; internalField uniform 0; " + boundary(box, "zeroGradient"));
  if (!box.turbulence.empty())
    write_turbulence(box, folder);
  std::ofstream(folder / "in.dem") << box.script;
  std::ofstream(folder / "bodies") << box.bodies;
}

} // namespace

std::string script_head(const BoxCase& box, double time_step, const std::string& wall_arguments) {
  std::ostringstream text;
  text << "atom_style granular\natom_modify map array\nboundary";
  for (const bool periodic : box.periodic)
    text << (periodic ? " p" : " f");
  text << "\nnewton off\ncommunicate single vel yes\nunits si\nprocessors 1 1 *\nregion box block";
  for (const double size : box.size)
    text << " 0 " << size;
  text << " units box\ncreate_box 1 box\nneighbor 0.002 bin\nneigh_modify delay 0\n"
          "fix m1 all property/global youngsModulus peratomtype 5e6\n"
          "fix m2 all property/global poissonsRatio peratomtype 0.25\n"
          "fix m3 all property/global coefficientRestitution peratomtypepair 1 0.3\n"
          "fix m4 all property/global coefficientFriction peratomtypepair 1 0.5\n"
          "pair_style gran model hertz tangential history\npair_coeff * *\ntimestep "
       << time_step << '\n'
       << wall_arguments << "fix move all nve/sphere\n";
  return text.str();
}

Outcome run(const BoxCase& box, const std::string& name, int ranks) {
  const fs::path folder = fs::absolute(name);
  fs::remove_all(folder);
  write_case(box, folder);
  const std::string enter = "cd '" + folder.string() + "' && ";
  if (shell(enter + "blockMesh > log.mesh 2>&1") != 0)
    throw std::runtime_error("blockMesh failed: see " + (folder / "log.mesh").string());
  std::string launch = "timeout 200 '" + std::string(std::getenv("ECCENTRA_BIN")) + "/annulusFoam'";
  if (ranks > 1) {
    const std::string parts = std::to_string(ranks);
    write(folder / "system/decomposeParDict", "dictionary",
          "numberOfSubdomains " + parts + "; method simple; coeffs { n (1 1 " + parts + "); }");
    if (shell(enter + "decomposePar > log.decompose 2>&1") != 0)
      throw std::runtime_error("decomposePar failed: see " + (folder / "log.decompose").string());
    launch = "timeout 200 mpirun --oversubscribe --bind-to none -np " + std::to_string(ranks) + " '" +
             std::string(std::getenv("ECCENTRA_BIN")) + "/annulusFoam' -parallel";
  }
  Outcome outcome;
  outcome.folder = folder;
  outcome.status = shell(enter + launch + " > log.run 2>&1");
  outcome.text = read_all(folder / "log.run");
  outcome.rows = read_csv(folder / "postProcessing/eccentra/coupling.csv");
  return outcome;
}

} // namespace eccentra::test
