// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of flow quantities: what travels is its columns, for every subset; docs/link.md has the same table.
#include "link/socket/wire.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace eccentra::link;

TEST(FlowQuantities, NamesDiffer) {
  std::set<std::string> names;
  for (const FlowQuantity& quantity : kFlowQuantities) {
    EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
    EXPECT_EQ(names_of(quantity.bit), quantity.name);
    EXPECT_EQ(kFlowQuantities[place_of(quantity.bit)].name, quantity.name);
  }
  EXPECT_EQ(names_of(0), "");
  EXPECT_EQ(names_of(kVelocity | kVorticity, " "), "velocity vorticity");
  EXPECT_EQ(names_of(1u << 31), "number 31");
}

/// A value that no other place of the samples has.
double value_of(const FlowQuantity& quantity, std::size_t place) {
  return 1e6 * quantity.bit + double(place);
}

TEST(FlowQuantities, EverySubsetTravels) {
  constexpr std::size_t kRows = 3;
  const double position[kRows][3] = {}, impulse[kRows][3] = {}, drag[kRows] = {}, volume[kRows] = {1, 1, 1};
  CellHint hints[kRows];
  ParticleArrays particles;
  particles.count = kRows;
  particles.position = position;
  particles.volume = volume;
  particles.impulse = impulse;
  particles.drag_coefficient = drag;
  particles.cell_hint = hints;
  wire::Bytes rows(kRows * wire::particle_row_bytes(false));
  wire::pack_particles(particles, false, rows.data());

  for (unsigned asked = 0; asked <= kAllQuantities; ++asked) {
    wire::ParticlePoints points;
    points.load({{kRows, rows.data()}}, false, asked);
    const FluidSamples there = points.samples();
    std::size_t doubles = 0;
    for (const FlowQuantity& quantity : kFlowQuantities) {
      ASSERT_EQ(there[quantity.bit] != nullptr, bool(asked & quantity.bit)) << quantity.name;
      if (!(asked & quantity.bit))
        continue;
      doubles += quantity.columns;
      for (std::size_t k = 0; k < kRows * quantity.columns; ++k)
        there[quantity.bit][k] = value_of(quantity, k);
    }
    const std::size_t bytes = wire::samples_row_bytes(asked);
    ASSERT_EQ(bytes, doubles * sizeof(double) + sizeof(CellHint));
    wire::Bytes answer(kRows * bytes);
    points.pack_samples(0, kRows, answer.data());

    PerQuantity<std::vector<double>> values;
    FluidSamples here;
    for (const FlowQuantity& quantity : kFlowQuantities) {
      values[quantity.bit].assign(kRows * quantity.columns, std::numeric_limits<double>::quiet_NaN());
      here[quantity.bit] = values[quantity.bit].data();
    }
    wire::unpack_samples({kRows, answer.data()}, asked, here, hints);
    for (const FlowQuantity& quantity : kFlowQuantities)
      for (std::size_t k = 0; asked & quantity.bit && k < kRows * quantity.columns; ++k)
        EXPECT_EQ(values[quantity.bit][k], value_of(quantity, k)) << quantity.name << " of set " << asked;
  }
}

TEST(FlowQuantities, AreThoseOfThePage) {
  const std::string page = eccentra::test::contents(std::string(std::getenv("ECCENTRA_SOURCE")) + "/docs/link.md");
  std::string rows;
  std::istringstream lines(page.substr(page.find("| bit | quantity | f64 |")));
  std::getline(lines, rows);
  std::getline(lines, rows);
  for (const FlowQuantity& quantity : kFlowQuantities) {
    std::getline(lines, rows);
    std::ostringstream begin;
    begin << "| " << unsigned(quantity.bit) << " | " << quantity.name << " | " << quantity.columns << " | ";
    EXPECT_EQ(rows.rfind(begin.str(), 0), 0u)
        << "docs/link.md has '" << rows << "' where '" << begin.str() << "...' belongs";
  }
  std::getline(lines, rows);
  EXPECT_EQ(rows.rfind('|', 0), std::string::npos) << "docs/link.md has a row too many: " << rows;
}

} // namespace
