// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows about shapes share: a shape of arguments, the tools, a script with one template.
#pragma once

#include "shape/shape_keywords.h"
#include "shape/vtk/stl_shape.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::test {

/// A shape of these arguments, or the sentence that refuses it.
struct Made {
  std::vector<shape::ClusterShape> shape; ///< one, or none
  std::string sentence;
  shape::Notes said;
  std::string notes() const {
    std::string all;
    for (const shape::Note& note : said)
      all += note.text + "\n";
    return all;
  }
};

inline Made make(const std::vector<std::string>& arguments, double diameter = 0) {
  shape::install_stl_keywords();
  Made made;
  try {
    std::size_t used = 0;
    made.shape.push_back(shape::make_shape(arguments, 0, used, diameter, made.said));
    EXPECT_EQ(used, arguments.size());
  } catch (const std::invalid_argument& problem) {
    made.sentence = problem.what();
  }
  return made;
}

inline void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in: " << text;
}

inline ProgramResult shell(const std::string& command) {
  return run_program({"/bin/sh", "-c", command});
}

inline std::string tool(const std::string& name) {
  return required_environment("ECCENTRA_BIN") + "/" + name;
}

/// A script with one cluster template; what it prints. `then` follows the template.
inline ProgramResult dem(const std::string& shape, const std::string& then = "") {
  std::ofstream("shape.in") << R"(atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block -0.05 0.05 -0.05 0.05 -0.05 0.05 units box
create_box 1 box
neighbor 0.001 bin
neigh_modify delay 0
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.25
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.9
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
pair_style gran/cluster model hertz tangential history
pair_coeff * *
timestep 1e-6
fix r all particletemplate/cluster 15485867 atom_type 1 density constant 2500 shape )"
                            << shape << "\n"
                            << then;
  return run_program({tool("eccentra-dem"), "-in", "shape.in"});
}

inline std::string text_of(const std::string& name) {
  std::ifstream in(name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

} // namespace eccentra::test
