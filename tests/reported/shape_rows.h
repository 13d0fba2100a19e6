// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows about shapes share: a shape of arguments, the tools, a script with one template.
#pragma once

#include "shape/shape_keywords.h"
#include "shape/vtk/stl_shape.h"
#include "support/granular_script.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

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

/// A script with one cluster template; what it prints. `then` follows the template.
inline ProgramResult dem(const std::string& shape, const std::string& then = "") {
  write_file("./shape.in",
             granular_box() + granular_material({5e6, 0.9, 0.5, 0.25}) + cluster_contacts() +
                 "timestep 1e-6\nfix r all particletemplate/cluster 15485867 atom_type 1 density constant "
                 "2500 shape " +
                 shape + "\n" + then);
  return run_program({program("eccentra-dem"), "-in", "shape.in"});
}

} // namespace eccentra::test
