// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusReport as a program, on a case folder whose numbers are known.
#include "report/flow_fields.h"
#include "report/summary.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

/// Ten spheres of 10 mm at the low side, at rest; a table of four rows.
fs::path make_case(const std::string& name) {
  const fs::path folder = fresh_folder(name);
  write_file(folder / "system/annulusMeshDict",
             "// comment; holeRadius 7;\nholeRadius 0.0635;\npipeRadius 0.02413; /* eccentricity 9; */\n"
             "eccentricity 0.5;\nlength 0.3;\ninclination 80;\n");
  write_file(folder / "system/controlDict",
             "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n");
  write_file(
      folder / "postProcessing/eccentra/coupling.csv",
      "time,particles,solids_flux,pressure_gradient,volume_error,dem_seconds,fluid_seconds\n"
      "0,10,9,900,1e-15,0.5,0.1\n1,10,1e-6,300,3e-15,1,0.2\n2,10,2e-6,310,1e-15,1.5,0.3\n3,10,3e-6,320,1e-15,2,0.4\n");
  std::ostringstream points;
  points << "# vtk DataFile Version 2.0\nparticles\nASCII\nDATASET POLYDATA\nPOINTS 10 float\n";
  for (int i = 0; i < 10; ++i)
    points << "0.01 -0.05 " << 0.03 * i + 0.01 << "\n";
  points << "VERTICES 10 20\n";
  for (int i = 0; i < 10; ++i)
    points << "1 " << i << "\n";
  points << "POINT_DATA 10\nSCALARS radius float 1\nLOOKUP_TABLE default\n";
  for (int i = 0; i < 10; ++i)
    points << "0.005\n";
  points << "VECTORS v float\n";
  for (int i = 0; i < 10; ++i)
    points << "0 0 " << 0.1 * i << "\n";
  write_file(folder / "postProcessing/eccentra/particles_100.vtk", points.str());
  return folder;
}

ProgramResult report(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {program("annulusReport")};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run_program(all, {".", {}, 60});
}

/// Number of different colours, up to 100: a blank picture has one.
int colours(const fs::path& file) {
  const auto reader = vtkSmartPointer<vtkPNGReader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  std::set<std::array<double, 3>> found;
  vtkImageData& image = *reader->GetOutput();
  vtkDataArray& pixels = *image.GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < pixels.GetNumberOfTuples() && found.size() < 100; ++i)
    found.insert({pixels.GetComponent(i, 0), pixels.GetComponent(i, 1), pixels.GetComponent(i, 2)});
  return static_cast<int>(found.size());
}

TEST(Means, AndTheirErrors) {
  using eccentra::report::mean_of;
  const auto constant = mean_of(std::vector<double>(50, 3.0));
  EXPECT_EQ(constant.value, 3);
  EXPECT_NEAR(constant.error, 0, 1e-15);
  // Five batches of means 1..5: standard error sqrt(2.5 / 5).
  const auto ramp = mean_of({1, 1, 2, 2, 3, 3, 4, 4, 5, 5});
  EXPECT_DOUBLE_EQ(ramp.value, 3);
  EXPECT_DOUBLE_EQ(ramp.error, std::sqrt(0.5));
  EXPECT_THROW(mean_of({}), std::invalid_argument);
}

TEST(Report, SaysWhatTheCaseHolds) {
  const fs::path folder = make_case("known");
  const ProgramResult run = report({folder, "--html"});
  ASSERT_EQ(run.status, 0) << run.output;
  std::ifstream stream(folder / "report/summary.csv");
  std::map<std::string, std::string> values;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream arguments(line);
    std::string name, quantity, unit, value;
    std::getline(arguments, name, ','), std::getline(arguments, quantity, ','), std::getline(arguments, unit, ','),
        std::getline(arguments, value, ',');
    values[quantity] = value;
  }
  // The last half of the run: rows at 2 and 3 s.
  EXPECT_EQ(values["pressure gradient"], "315");
  EXPECT_EQ(values["solid flux"], "2.5");
  EXPECT_EQ(values["largest solid volume error"], "3e-15");
  EXPECT_EQ(values["solid slower than 10 mm/s"], "10");
  EXPECT_EQ(values["seconds in DEM"], "2");
  EXPECT_GT(colours(folder / "report/beds.png"), 20);
  EXPECT_GT(colours(folder / "report/charts.png"), 20);
  const std::string vectors = contents(folder / "report/charts.svg");
  EXPECT_NE(vectors.find("<svg"), std::string::npos);
  EXPECT_GT(std::count(vectors.begin(), vectors.end(), '\n'), 50) << "lines of curves and axes";
  std::ifstream page(folder / "report/report.html");
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_NE(html.find("data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(html.find("http"), std::string::npos) << "the page must need no network";
}

// A run without a fluid and without an annulus: its log has the step, the walls and gravity.
TEST(Report, DrawsARunOfLiggghtsAlone) {
  const fs::path folder = make_case("alone");
  fs::remove_all(folder / "system");
  fs::remove(folder / "postProcessing/eccentra/coupling.csv");
  fs::copy(folder / "postProcessing/eccentra/particles_100.vtk", folder / "postProcessing/eccentra/particles_200.vtk");
  write_file(folder / "log.liggghts",
             "Created orthogonal box = (-0.1 -0.1 -0.1) to (0.1 0.1 0.4)\ntimestep 1e-3\n"
             "variable shape index \"cube 8\"\nfix weight all gravity 9.81 vector 0 0 -1\n"
             "fix floor all wall/gran/cluster model hertz primitive type 1 zplane 0\n"
             "fix tube all wall/gran/cluster model hertz primitive type 1 zcylinder 0.06 0 0\n");
  const ProgramResult run = report({folder, "--frames", "2", "--film", "2", "--html"});
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_NE(run.output.find("0.10..0.20"), std::string::npos) << run.output;
  // Ten centres, from 0.01 m on every 0.03 m, at speeds from 0 to 0.9 m/s.
  const std::string table = contents(folder / "report/summary.csv");
  EXPECT_NE(table.find("alone,bodies,,10,"), std::string::npos) << table;
  EXPECT_NE(table.find("alone,height of the solid's centre (bodies),mm,145,"), std::string::npos) << table;
  EXPECT_NE(table.find("alone,height that 98 % of the solid is below,mm,280,"), std::string::npos) << table;
  EXPECT_NE(table.find("alone,mean speed of the solid,m/s,0.45,"), std::string::npos) << table;
  EXPECT_GT(colours(folder / "report/scene.png"), 20);
  EXPECT_GT(colours(folder / "report/strip.png"), 20);
  // A film: two pictures of one size, of which other programs see the first.
  const std::string film = contents(folder / "report/film.png");
  EXPECT_NE(film.find(std::string("acTL\0\0\0\2", 8)), std::string::npos);
  EXPECT_NE(film.find("fdAT"), std::string::npos);
  EXPECT_GT(colours(folder / "report/film.png"), 20);
  EXPECT_FALSE(fs::exists(folder / "report/film.png.0"));
  EXPECT_NE(contents(folder / "report/report.html").find("<td>shape</td><td>cube 8</td>"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "report/beds.png"));
  EXPECT_FALSE(fs::exists(folder / "report/charts.png"));
  EXPECT_NE(contents(folder / "report/report.html").find("data:image/png;base64,"), std::string::npos);
}

/// Columns of a picture in which there is a colour, from the left: neither white nor grey nor black.
std::vector<bool> coloured_columns(const fs::path& file, double top) {
  const auto reader = vtkSmartPointer<vtkPNGReader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  const int width = image.GetDimensions()[0], height = image.GetDimensions()[1];
  std::vector<bool> columns(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x)
    for (int y = static_cast<int>(top * height); y < height; ++y) { // above the scale of colours
      const double red = image.GetScalarComponentAsDouble(x, y, 0, 0);
      const double blue = image.GetScalarComponentAsDouble(x, y, 0, 2);
      if (std::abs(red - blue) > 40)
        columns[static_cast<std::size_t>(x)] = true;
    }
  return columns;
}

/// A file of spheres of 5 mm at rest, at these places ("x y z", a line each), and the log of a script.
void make_row(const fs::path& folder, int count, const std::string& places, const std::string& log) {
  std::ostringstream text;
  text << "# vtk DataFile Version 2.0\nrow\nASCII\nDATASET POLYDATA\nPOINTS " << count << " float\n"
       << places << "POINT_DATA " << count << "\nSCALARS radius float 1\nLOOKUP_TABLE default\n";
  for (int i = 0; i < count; ++i)
    text << "0.005\n";
  text << "VECTORS v float\n";
  for (int i = 0; i < count; ++i)
    text << "0 0 0\n";
  write_file(folder / "particles_100.vtk", text.str());
  write_file(folder / "log.liggghts", log);
}

// A row of spheres at rest, of which the outermost stand a little apart, and one that may have rolled away: the row is
// whole in the picture, which it fills.
TEST(Report, CutsNoBodyAtTheSideOfThePicture) {
  for (const bool rolled : {false, true}) {
    const fs::path folder = fresh_folder("row");
    std::ostringstream places;
    for (int i = 0; i < 61; ++i)
      places << (i == 0 ? 0.19 : i < 60 ? 0.2 + 0.2 * i / 59 : rolled ? 5 : 0.41) << " 0 0.005\n";
    make_row(folder, 61, places.str(),
             "Created orthogonal box = (-1 -1 0) to (6 1 1)\ntimestep 1e-3\n"
             "fix weight all gravity 9.81 vector 0 0 -1\n"
             "fix floor all wall/gran model hertz primitive type 1 zplane 0\n");
    const ProgramResult run = report({folder});
    ASSERT_EQ(run.status, 0) << run.output;
    const std::vector<bool> columns = coloured_columns(folder / "report/scene.png", 0.4);
    const auto width = static_cast<std::ptrdiff_t>(columns.size());
    const auto left = std::find(columns.begin(), columns.end(), true) - columns.begin();
    const auto right = std::find(columns.rbegin(), columns.rend(), true) - columns.rbegin();
    EXPECT_GT(left, 3) << rolled;
    EXPECT_GT(right, 3) << rolled;
    EXPECT_LT(left + right, 0.15 * static_cast<double>(width)) << rolled;
  }
}

// Spheres along the middle of a pipe that lies and is shorter than wide: a line from its side, a spot along its axis.
TEST(Report, SeesAPipeFromItsSide) {
  const fs::path folder = fresh_folder("pipe");
  std::ostringstream places;
  for (int i = 0; i < 30; ++i)
    places << "0 0 " << 0.005 + 0.09 * i / 29 << "\n";
  make_row(folder, 30, places.str(),
           "Created orthogonal box = (-1 -1 0) to (1 1 0.1)\ntimestep 1e-3\n"
           "fix weight all gravity 9.81 vector 0 -0.9 -0.4\n"
           "fix hole all wall/gran model hertz primitive type 1 zcylinder 0.052 0 0\n");
  const ProgramResult run = report({folder});
  ASSERT_EQ(run.status, 0) << run.output;
  const std::vector<bool> columns = coloured_columns(folder / "report/scene.png", 0.4);
  EXPECT_GT(std::count(columns.begin(), columns.end(), true), 0.3 * static_cast<double>(columns.size()));
}

TEST(Report, SaysWhatAFolderLacks) {
  const fs::path folder = fresh_folder("nothing");
  const ProgramResult run = report({folder});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.output.find("neither system/annulusMeshDict nor files of particles"), std::string::npos) << run.output;
}

TEST(Report, LeavesNoServerBehind) {
  const fs::path folder = make_case("server");
  const ProgramResult run = report({folder});
  ASSERT_EQ(run.status, 0) << "signal " << run.signal << "\n" << run.output;
  for (const auto& process : fs::directory_iterator("/proc")) {
    std::ifstream stat(process.path() / "stat");
    std::string word, name, state, parent;
    stat >> word >> name >> state >> parent;
    EXPECT_FALSE(name == "(Xvfb)" && parent == "1" && state != "Z") << "process " << word;
  }
}

#ifdef ECCENTRA_TEST_MESH
constexpr int kTestMeshCells = 6 * 24 * 10; // tests/exchange/mesh

/// Beside the mesh in `part`, 3 m/s along the hole at the time 0.5.
void write_uniform_velocity(const fs::path& part) {
  std::ifstream stream(part / "constant/polyMesh/boundary");
  const std::string boundary{std::istreambuf_iterator<char>(stream), {}};
  const std::regex patch(R"((\w+)\s*\{\s*type)");
  std::string patches;
  for (std::sregex_iterator at(boundary.begin(), boundary.end(), patch), end; at != end; ++at)
    patches += at->str(1) + " { type calculated; value uniform (0 0 3); } ";
  write_file(part / "0.5/U", "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\n"
                             "dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 3); boundaryField { " +
                                 patches + "}\n");
}

/// Size and largest speed of what read_flow finds.
void expect_flow(const fs::path& folder, const char* how) {
  const auto flow = eccentra::report::read_flow(folder);
  ASSERT_NE(flow, nullptr) << how;
  EXPECT_EQ(flow->GetNumberOfCells(), kTestMeshCells) << how;
  double range[2] = {};
  flow->GetPointData()->GetArray("U")->GetRange(range, 2);
  EXPECT_FLOAT_EQ(range[0], 3) << how;
  EXPECT_FLOAT_EQ(range[1], 3) << how;
}

TEST(Report, ReadsTheFlowWholeAndInParts) {
  const fs::path folder = make_case("flow");
  fs::copy(ECCENTRA_TEST_MESH, folder, fs::copy_options::recursive | fs::copy_options::skip_existing);
  for (const char* part : {"processor0", "processor1"})
    write_uniform_velocity(folder / part);
  expect_flow(folder, "in parts");
  const ProgramResult run = report({folder});
  EXPECT_EQ(run.status, 0) << "signal " << run.signal << "\n" << run.output;
  write_uniform_velocity(folder);
  expect_flow(folder, "put together");
  fs::remove_all(folder / "processor0");
  expect_flow(folder, "whole");
  const ProgramResult files = report({folder, "--no-pictures", "--paraview"});
  ASSERT_EQ(files.status, 0) << files.output;
  const auto fluid = eccentra::report::read_all_fields(folder, 0.5);
  ASSERT_NE(fluid, nullptr);
  EXPECT_EQ(fluid->GetNumberOfCells(), kTestMeshCells);
  EXPECT_NE(contents(folder / "report/flow/100.vtm").find("name=\"fluid\" file=\"fluid_0.5.vtu\""), std::string::npos);
  EXPECT_TRUE(fs::is_regular_file(folder / "report/flow/fluid_0.5.vtu"));
}
#endif

} // namespace
