// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A case of an annulus as the rows of tests/reported write it, what annulusFoam says of it, and its tables.
#pragma once

#include "support/program_output.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace eccentra::test {

namespace fs = std::filesystem;

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
inline std::string line_with(const std::string& text, const std::string& arguments) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find(arguments) != std::string::npos)
      return line;
  return "";
}

/// One sentence of annulusFoam that names each of these arguments; exit code 1.
inline void expect_refused(const ProgramResult& result, const std::vector<std::string>& arguments) {
  EXPECT_EQ(result.status, 1) << result.output;
  const std::string line = line_with(result.output, ": error: ");
  for (const std::string& word : arguments)
    EXPECT_NE(line.find(word), std::string::npos) << word << "\n" << result.output;
}

inline std::string note_of(const ProgramResult& result) {
  return line_with(result.output, "annulusFoam: note: ");
}

inline std::map<std::string, double> last_row(const fs::path& table) {
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
inline std::vector<double> last_numbers(const fs::path& table) {
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

} // namespace eccentra::test
