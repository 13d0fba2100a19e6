// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What dump cluster/vtk writes, read back by VTK's own reader: every sub-sphere where the body's motion puts it.
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/walls/wall_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

using eccentra::styles::FixClusterBodies;
using eccentra::test::LiggghtsSession;
using eccentra::test::wall_scene;

namespace {

constexpr float kFloat = 1e-6f; // single precision, relative

} // namespace

TEST(DumpClusterVtk, SubSpheresAreWhereTheBodiesAre) {
  LiggghtsSession session;
  session.script(wall_scene(1e-5));
  session.script("pair_style gran/cluster model hertz tangential history rolling_friction off\npair_coeff * *");
  session.script(R"(
    create_atoms 1 single -0.03 0.01 0.02 units box
    create_atoms 2 single 0.04 -0.01 0.03 units box
    create_atoms 1 single 0.00 0.05 -0.03 units box
    set group all diameter 6.35e-3 density 2619
  )");
  FixClusterBodies& bodies = FixClusterBodies::require(&session.lammps());
  std::size_t used = 0;
  const auto cube = eccentra::shape::make_shape({"cube", "8"}, 0, used, 6.35e-3);
  const int id = bodies.shapes().add(cube);
  const Eigen::Quaterniond q(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()));
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  for (const int tag : {1, 2}) // the third stays a plain sphere
    if (session.local(tag) >= 0)
      bodies.make_body(session.local(tag), id, 2619, wxyz);
  session.script(R"(
    velocity all set 0.1 0.2 -0.3
    fix integrate all nve/cluster
    dump spheres all cluster/vtk 100 spheres*.vtp
    dump bodies all cluster/vtk 100 bodies*.vtp rows bodies
    dump_modify bodies pad 6
    run 100
  )");
  MPI_Barrier(MPI_COMM_WORLD);

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName("spheres100.vtp");
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ASSERT_EQ(data->GetNumberOfPoints(), 8 + 8 + 1);
  ASSERT_EQ(data->GetNumberOfVerts(), 17); // ParaView shows cells
  const auto array = [&](const char* name) { return data->GetPointData()->GetArray(name); };
  for (const char* name : {"radius", "body", "type", "shape", "velocity", "omega", "orientation"})
    ASSERT_NE(array(name), nullptr) << name;
  const double t = 100 * 1e-5;
  const Eigen::Vector3d v(0.1, 0.2, -0.3);
  const Eigen::Vector3d start[] = {{-0.03, 0.01, 0.02}, {0.04, -0.01, 0.03}, {0.00, 0.05, -0.03}};
  for (int row = 0; row < 17; ++row) {
    const int body = row / 8;
    EXPECT_EQ(array("body")->GetTuple1(row), body + 1);
    EXPECT_EQ(array("type")->GetTuple1(row), body == 1 ? 2 : 1);
    EXPECT_EQ(array("shape")->GetTuple1(row), body < 2 ? id : FixClusterBodies::plain_sphere);
    Eigen::Vector3d expected = start[body] + v * t;
    double radius = 6.35e-3 / 2;
    if (body < 2) {
      expected += q * cube.spheres()[row % 8].centre;
      radius = cube.spheres()[row % 8].radius;
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(array("orientation")->GetComponent(row, k), wxyz[k], kFloat);
    }
    double x[3];
    data->GetPoint(row, x);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(x[k], expected[k], 0.1 * kFloat);
      EXPECT_NEAR(array("velocity")->GetComponent(row, k), v[k], kFloat);
    }
    EXPECT_NEAR(array("radius")->GetTuple1(row), radius, kFloat * radius);
  }
  reader->SetFileName("bodies000100.vtp");
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 3);
}
