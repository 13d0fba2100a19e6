// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The drag on a bed does not depend on the cells: from a quarter of a particle to four particles across.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace {

using namespace eccentra::test;

constexpr double kDiameter = 6.35e-3;
constexpr int kWide = 4, kHigh = 16;

/// A fixed bed that fluid flows through upwards; returns its pressure drop [Pa].
double pressure_drop(double cells_per_diameter, int layers) {
  BoxCase box;
  box.size[0] = box.size[1] = kWide * kDiameter;
  box.size[2] = kHigh * kDiameter;
  box.cells[0] = box.cells[1] = static_cast<int>(kWide * cells_per_diameter);
  box.cells[2] = static_cast<int>(kHigh * cells_per_diameter);
  box.step = 5e-3;
  box.tolerance = 1e-9;
  box.drive = "drive { type meanVelocity; Ubar 0.1; direction (0 0 1); initialGradient 0; }";
  std::ostringstream script;
  script << script_head(box, 5e-4);
  for (int layer = 0; layer < layers; ++layer)
    for (int i = 0; i < kWide * kWide; ++i)
      script << "create_atoms 1 single " << (i % kWide + 0.5) * kDiameter << ' ' << (i / kWide + 0.5) * kDiameter << ' '
             << (layer + 0.5) * kDiameter << " units box\n";
  script << "set group all diameter 6.35e-3 density 2619\nfix hold all freeze\n"
            "fix mud all fluid/force rheology herschel_bulkley 0 0.01 1 density 1000 drag chien pressure_gradient on\n"
            "fix flow all fluid/couple link solver every 10\nrun 400\n";
  box.script = script.str();
  std::ostringstream name;
  name << "layers_" << layers << "_cells_" << cells_per_diameter;
  const Outcome outcome = run(box, name.str());
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  return outcome.status == 0 ? outcome.last("pressure_gradient") * box.size[2] : 0.0;
}

} // namespace

TEST(MeshIndependence, DragInsideABedChangesLittleFromAQuarterToFourDiametersPerCell) {
  const double reference = pressure_drop(1, kHigh);
  ASSERT_GT(reference, 0);
  for (const double cells : {0.25, 0.5, 2.0, 4.0})
    EXPECT_NEAR(pressure_drop(cells, kHigh) / reference, 1.0, 0.05) << cells << " cells per diameter";
}

// Its faces are resolved only by cells that are small beside its height of six diameters.
TEST(MeshIndependence, DragOfAThinBedChangesLittleFromAQuarterToTwoDiametersPerCell) {
  const double reference = pressure_drop(1, 6);
  ASSERT_GT(reference, 0);
  for (const double cells : {0.5, 2.0, 4.0})
    EXPECT_NEAR(pressure_drop(cells, 6) / reference, 1.0, 0.05) << cells << " cells per diameter";
}
