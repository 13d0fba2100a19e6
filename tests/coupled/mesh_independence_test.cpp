// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Neither the drag on a bed nor that on a sphere depends on the cells, from a quarter of a particle to four particles
// across, nor on where in them it is.
#include "coupled/coupled_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

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
    for (int row = 0; row < kWide; ++row)
      for (int i = 0; i < kWide; ++i)
        script << "create_atoms 1 single " << (i + 0.5) * kDiameter << ' ' << (row + 0.5) * kDiameter << ' '
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

/// What is dragged: a sphere; a disk of 48 spheres that lies askew, whose volume and force go to six points; a sphere
/// with the volume and the sphericity of this disk, whose volume and force go to its centre.
enum class Dragged { sphere, disk, disk_at_its_centre };

/// (Largest - smallest)/mean of the force on a body that is dragged at 0.1 m/s through a periodic box, about a
/// straight line, as its wake still grows; of the last two thirds. Infinite where the flow blows up. `coupling`: lines
/// of couplingProperties.
double spread_of_force(double cell_in_diameters, double viscosity, Dragged body = Dragged::sphere,
                       const std::string& coupling = "") {
  BoxCase box;
  box.coupling = coupling;
  const double side = std::max(6.0, 4 * cell_in_diameters) * kDiameter;
  for (int k = 0; k < 3; ++k) {
    box.size[k] = side;
    box.cells[k] = static_cast<int>(std::lround(side / (cell_in_diameters * kDiameter)));
  }
  box.step = 2.5e-3;
  box.tolerance = 1e-9;
  box.viscosity = viscosity;
  box.drive = "drive { type meanVelocity; Ubar 0; direction (0 0 1); initialGradient 0; }";
  constexpr int kEvery = 25;
  const double way = 2.2 * std::max(side / 3, 2 * cell_in_diameters * kDiameter);
  std::ostringstream script;
  std::string head = script_head(box, box.step / kEvery);
  std::ostringstream place;
  place << 0.3 * side << ' ' << 0.4 * side << ' ' << 0.1 * side;
  if (body == Dragged::disk) {
    for (const std::string stock : {"pair_style gran ", "nve/sphere"})
      head.replace(head.find(stock), stock.size(), stock == "nve/sphere" ? "nve/cluster" : "pair_style gran/cluster ");
    script << head << "fix disk all particletemplate/cluster 15485863 atom_type 1 density constant 1e9 shape disk 48 "
           << "diameter 6.35e-3\ncreate_bodies bodies template disk\n";
    box.bodies = place.str() + " 0.9063077870 0 0.4226182617 0\n";
  } else
    script << head << "create_atoms 1 single " << place.str()
           << " units box\nset group all diameter 6.35e-3 density 1e9\n";
  script << "velocity all set 0.013 0.007 0.1\n"
         << "fix mud all fluid/force rheology newtonian " << viscosity
         << " density 1000 drag chien pressure_gradient on buoyancy off"
         << (body == Dragged::disk_at_its_centre ? " sphericity 0.789474" : "")
         << "\nfix flow all fluid/couple link solver every " << kEvery << "\nthermo " << kEvery
         << "\nvariable force equal f_mud[3]+f_mud[12]\n"
         << "fix note all print " << kEvery << " \"${force}\" file force title none screen no\n"
         << "run " << kEvery * std::lround(way / (0.1 * box.step)) << '\n';
  box.script = script.str();
  std::ostringstream name;
  name << "crossing_" << cell_in_diameters << '_' << viscosity << '_' << int(body);
  const Outcome outcome = run(box, name.str());
  if (outcome.status != 0) { // blown up
    std::printf("%s\n", outcome.text.c_str());
    return std::numeric_limits<double>::infinity();
  }
  std::ifstream in(outcome.folder + "/force");
  std::vector<double> force;
  for (double value; in >> value;)
    force.push_back(value);
  force.erase(force.begin(), force.begin() + static_cast<long>(force.size() / 3));
  EXPECT_GT(force.size(), 20U);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const double value : force) {
    x += n;
    xx += n * n;
    y += value;
    xy += n * value;
    n += 1;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  double least = 1e300, most = -1e300;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double off = force[i] - (y + slope * (n * static_cast<double>(i) - x)) / n;
    least = std::min(least, off);
    most = std::max(most, off);
  }
  return (most - least) / std::abs(y / n);
}

} // namespace

// What a particle feels of the flow that it makes itself is largest in thick fluids.
TEST(MeshIndependence, ASphereThatCrossesCellsFeelsASteadyForceInThickFluids) {
  for (const double viscosity : {1.0, 10.0})
    for (const double cell : {1.0, 2.0, 4.0})
      EXPECT_LT(spread_of_force(cell, viscosity), 0.02) << "cells of " << cell << " d, " << viscosity << " Pa s";
}

// A body larger than a cell is felt by the cells that it covers. Prints the table of docs/benchmarks/exchange.md.
TEST(MeshIndependence, ADiskThatCrossesCellsFeelsASteadierForceAtSixPointsThanAtItsCentre) {
  for (const double viscosity : {0.1, 10.0})
    for (const double cell : {0.5, 1.0, 2.0}) {
      const double spread = spread_of_force(cell, viscosity, Dragged::disk);
      const double at_centre = spread_of_force(cell, viscosity, Dragged::disk_at_its_centre);
      std::printf("%g Pa s, cells of %g d: six points %.2f %%, centre %.2f %%\n", viscosity, cell, 100 * spread,
                  100 * at_centre);
      EXPECT_LT(spread, 0.01) << viscosity << " Pa s, cells of " << cell << " d";
      EXPECT_LT(spread, 0.9 * at_centre) << viscosity << " Pa s, cells of " << cell << " d";
    }
}

// What fails: without diffusion the force varies by more than itself, and on cells of 0.5 d the flow blows up.
TEST(MeshIndependence, ADiskThatCrossesCellsNeedsDiffusion) {
  for (const char* method : {"voidFraction gaussian;", "voidFraction centre;"})
    for (const double cell : {0.5, 1.0, 2.0}) {
      const double spread = spread_of_force(cell, 0.1, Dragged::disk, method);
      std::printf("%s 0.1 Pa s, cells of %g d: %.1f times\n", method, cell, spread);
      EXPECT_GT(spread, 1) << method << " cells of " << cell << " d";
      EXPECT_EQ(std::isinf(spread), cell == 0.5) << method << " cells of " << cell << " d";
    }
}

TEST(MeshIndependence, DragInsideABedChangesLittleFromAQuarterToFourDiametersPerCell) {
  const double reference = pressure_drop(1, kHigh);
  ASSERT_GT(reference, 0);
  for (const double cells : {0.25, 0.5, 2.0, 4.0})
    EXPECT_NEAR(pressure_drop(cells, kHigh) / reference, 1.0, 0.05) << cells << " cells per diameter";
}

// Cells of four diameters do not resolve the faces of a bed of six (docs/couplingProperties.md).
TEST(MeshIndependence, DragOfAThinBedChangesLittleFromAQuarterToTwoDiametersPerCell) {
  const double reference = pressure_drop(1, 6);
  ASSERT_GT(reference, 0);
  for (const double cells : {0.5, 2.0, 4.0})
    EXPECT_NEAR(pressure_drop(cells, 6) / reference, 1.0, 0.05) << cells << " cells per diameter";
}
