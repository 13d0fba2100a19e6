// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// annulusReport --paraview: surfaces of known bodies, walls and times, read back as ParaView reads them.
#include "support/read_file.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTriangle.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>
#include <cmath>
#include <vector>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;
using Point = std::array<double, 3>;

constexpr double kRadius = 0.01, kSmall = 0.005; // of the spheres of a cluster, of a plain sphere
constexpr double kSpeed = 0.25;

struct Row {
  Point at;
  double radius;
  int body, shape;
  std::array<double, 4> orientation;
};

/// As dump cluster/vtk writes it: two clusters of two spheres, one turned by 90 degrees about z, and a sphere.
void write_grains(const fs::path& file) {
  const double half = std::sqrt(0.5);
  const std::vector<Row> rows = {{{0, 0, 0.01}, kRadius, 1, 0, {1, 0, 0, 0}},
                                 {{kRadius, 0, 0.01}, kRadius, 1, 0, {1, 0, 0, 0}},
                                 {{0.1, 0, 0.01}, kRadius, 2, 0, {half, 0, 0, half}},
                                 {{0.1, kRadius, 0.01}, kRadius, 2, 0, {half, 0, 0, half}},
                                 {{0, 0.2, 0.01}, kSmall, 3, -1, {1, 0, 0, 0}}};
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkFloatArray> radius, velocity, orientation;
  vtkNew<vtkIntArray> body, shape;
  radius->SetName("radius");
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  orientation->SetName("orientation");
  orientation->SetNumberOfComponents(4);
  body->SetName("body");
  shape->SetName("shape");
  for (const Row& row : rows) {
    const vtkIdType point = points->InsertNextPoint(row.at.data());
    vertices->InsertNextCell(1, &point);
    radius->InsertNextValue(static_cast<float>(row.radius));
    velocity->InsertNextTuple3(0, 0, kSpeed);
    orientation->InsertNextTuple(row.orientation.data());
    body->InsertNextValue(row.body);
    shape->InsertNextValue(row.shape);
  }
  data->SetPoints(points);
  data->SetVerts(vertices);
  for (vtkDataArray* array :
       std::initializer_list<vtkDataArray*>{radius.Get(), velocity.Get(), orientation.Get(), body.Get(), shape.Get()})
    data->GetPointData()->AddArray(array);
  fs::create_directories(file.parent_path());
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(data);
  writer->Write();
}

fs::path reported(const std::string& name) {
  fs::path folder = fresh_folder(name);
  for (const char* step : {"100", "250"})
    write_grains(folder / "post" / ("grains_" + std::string(step) + ".vtp"));
  write_file(folder / "log.liggghts",
             "Created orthogonal box = (-0.1 -0.1 0) to (0.3 0.3 0.4)\ntimestep 1e-3\n"
             "fix weight all gravity 9.81 vector 0 0 -1\n"
             "fix floor all wall/gran/cluster model hertz primitive type 1 zplane 0\n"
             "fix far all wall/gran/cluster model hertz primitive type 1 xplane 7\n"
             "fix tube all wall/gran/cluster model hertz primitive type 1 zcylinder 0.3 0.1 0.1\n");
  const ProgramResult run = run_program(
      {required_environment("ECCENTRA_BIN") + "/annulusReport", folder, "--no-pictures", "--paraview"}, {".", {}, 60});
  EXPECT_EQ(run.status, 0) << run.output;
  EXPECT_NE(run.output.find((folder / "report" / (name + ".pvd")).string()), std::string::npos) << run.output;
  return folder;
}

vtkSmartPointer<vtkMultiBlockDataSet> blocks_of(const fs::path& file) {
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
}

vtkDataObject* block_of(vtkMultiBlockDataSet& blocks, const std::string& name) {
  for (unsigned i = 0; i < blocks.GetNumberOfBlocks(); ++i)
    if (blocks.HasMetaData(i) && blocks.GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) == name)
      return blocks.GetBlock(i);
  return nullptr;
}

/// Area of the triangles of one body [m2].
double area_of(vtkPolyData& surface, int body) {
  vtkDataArray& bodies = *surface.GetPointData()->GetArray("body");
  double area = 0;
  vtkNew<vtkIdList> corners;
  vtkCellArray& cells = *surface.GetPolys();
  for (cells.InitTraversal(); cells.GetNextCell(corners);) {
    EXPECT_EQ(corners->GetNumberOfIds(), 3);
    if (static_cast<int>(bodies.GetTuple1(corners->GetId(0))) != body)
      continue;
    std::array<Point, 3> p{};
    for (int k = 0; k < 3; ++k)
      surface.GetPoint(corners->GetId(k), p[k].data());
    area += vtkTriangle::TriangleArea(p[0].data(), p[1].data(), p[2].data());
  }
  return area;
}

TEST(Paraview, HasSecondsAndNamedBlocks) {
  const fs::path folder = reported("named");
  const std::string collection = contents(folder / "report/named.pvd");
  EXPECT_NE(collection.find("timestep=\"0.1\" part=\"0\" file=\"named/100.vtm\""), std::string::npos) << collection;
  EXPECT_NE(collection.find("timestep=\"0.25\" part=\"0\" file=\"named/250.vtm\""), std::string::npos) << collection;
  const auto blocks = blocks_of(folder / "report/named/250.vtm");
  ASSERT_NE(blocks, nullptr);
  ASSERT_NE(vtkPolyData::SafeDownCast(block_of(*blocks, "particles")), nullptr);
  auto* walls = vtkMultiBlockDataSet::SafeDownCast(block_of(*blocks, "walls"));
  ASSERT_NE(walls, nullptr);
  EXPECT_EQ(walls->GetNumberOfBlocks(), 2U) << "a plane outside of the box is none of the scene";
  std::array<double, 6> sides{};
  auto* floor = vtkPolyData::SafeDownCast(block_of(*walls, "floor"));
  ASSERT_NE(floor, nullptr);
  floor->GetBounds(sides.data());
  EXPECT_NEAR(sides[0], -0.1, 1e-3);
  EXPECT_NEAR(sides[3], 0.3, 1e-3);
  EXPECT_NEAR(sides[5], 0, 1e-9);
  auto* tube = vtkPolyData::SafeDownCast(block_of(*walls, "tube"));
  ASSERT_NE(tube, nullptr);
  tube->GetBounds(sides.data());
  EXPECT_NEAR(sides[1], 0.4, 1e-3);
  EXPECT_NEAR(sides[5], 0.4, 1e-6);
  EXPECT_EQ(block_of(*blocks, "fluid"), nullptr);
}

TEST(Paraview, SurfacesAreThoseOfTheBodies) {
  const fs::path folder = reported("surfaces");
  const auto blocks = blocks_of(folder / "report/surfaces/100.vtm");
  ASSERT_NE(blocks, nullptr);
  auto* bodies = vtkPolyData::SafeDownCast(block_of(*blocks, "bodies"));
  ASSERT_NE(bodies, nullptr);
  // Two spheres of radius R at a distance of R: each has a cap of pi R^2 inside the other.
  const double pair = 6 * M_PI * kRadius * kRadius, sphere = 4 * M_PI * kSmall * kSmall;
  constexpr double kFacets = 0.04; // of the area that facets and the margin of the seam may cost
  EXPECT_NEAR(area_of(*bodies, 1), pair, kFacets * pair);
  EXPECT_NEAR(area_of(*bodies, 2), pair, kFacets * pair);
  EXPECT_NEAR(area_of(*bodies, 3), sphere, kFacets * sphere);
  // The turned one lies along y, at its own place; nothing is deep inside of a sphere.
  vtkDataArray& tags = *bodies->GetPointData()->GetArray("body");
  double highest = 0, deepest = 0;
  for (vtkIdType i = 0; i < bodies->GetNumberOfPoints(); ++i) {
    if (tags.GetTuple1(i) != 2)
      continue;
    Point p{};
    bodies->GetPoint(i, p.data());
    highest = std::max(highest, p[1]);
    for (const double y : {0.0, kRadius})
      deepest = std::max(deepest, kRadius - std::hypot(p[0] - 0.1, p[1] - y, p[2] - 0.01));
  }
  EXPECT_NEAR(highest, 2 * kRadius, 0.03 * kRadius);
  EXPECT_LT(deepest, 0.06 * kRadius);
  EXPECT_FLOAT_EQ(bodies->GetPointData()->GetArray("velocity")->GetRange(2)[1], kSpeed);
  EXPECT_NE(bodies->GetPointData()->GetNormals(), nullptr);
}

} // namespace
