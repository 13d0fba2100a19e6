// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of one cube and of a bed of disks, run by eccentra-dem, and how it refuses them.
#pragma once

#include "support/granular_script.h"
#include "support/program_output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace eccentra::test {

inline const std::string box = granular_box();
inline const std::string material = granular_material({5e6, 0.9, 0.5, 0.25}) + "timestep 1e-5\n";
inline const std::string contacts = cluster_contacts();
inline constexpr const char* cubes =
    R"(fix c all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 diameter 6.35e-3 orientation given
fix d all particledistribution/discrete 32452843 1 c 1.0
)";
inline constexpr const char* moved = "fix move all nve/cluster\n";
/// One cube at the origin, after a step.
inline constexpr const char* one_body = R"(region a block -1e-6 1e-6 -1e-6 1e-6 -1e-6 1e-6 volume_limit 1e-30 units box
fix pa all insert/pack seed 49979687 distributiontemplate d insert_every once overlapcheck no all_in no vel constant 0 0 0 orientation constant 1 0 0 0 region a particles_in_region 1
run 1
unfix pa
)";

inline void write_here(const std::string& name, const std::string& text) {
  write_file(std::filesystem::current_path() / name, text);
}

inline std::string scene_with_one_body() {
  return box + material + contacts + cubes + moved + one_body;
}

inline ProgramResult run_script(const std::string& text, std::vector<std::string> more = {}) {
  write_here("in.script", text);
  std::vector<std::string> words = {program("eccentra-dem"), "-in", "in.script", "-log", "none"};
  words.insert(words.end(), more.begin(), more.end());
  ProgramOptions options;
  options.timeout = 240;
  return run_program(words, options);
}

/// The numbers of the last line of thermo output that starts with this step.
inline std::vector<double> columns(const std::string& output, long step) {
  std::istringstream lines(output);
  std::vector<double> found;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<double> values;
    for (double value = 0; words >> value;)
      values.push_back(value);
    if (words.eof() && values.size() > 1 && values[0] == static_cast<double>(step))
      found = values;
  }
  return found;
}

inline void expect_refused(const ProgramResult& result, const std::vector<std::string>& says) {
  EXPECT_GT(result.status, 0) << result.output;
  const std::size_t at = result.output.find("ERROR");
  ASSERT_NE(at, std::string::npos) << result.output;
  const std::string sentence = result.output.substr(at, result.output.find('\n', at) - at);
  for (const std::string& word : says)
    EXPECT_NE(sentence.find(word), std::string::npos) << "'" << word << "' in: " << sentence;
}

/// A bed of disks in a box of walls; `settle` lets it come to rest.
inline std::string bed() {
  return granular_box("-0.001 0.021 -0.001 0.021 -0.002 0.06") + granular_material({5e6, 0.3, 0.5, 0.3}) +
         cluster_contacts() + R"(timestep 2e-5
fix x0 all wall/gran/cluster model hertz tangential history primitive type 1 xplane 0.0
fix x1 all wall/gran/cluster model hertz tangential history primitive type 1 xplane 0.02
fix y0 all wall/gran/cluster model hertz tangential history primitive type 1 yplane 0.0
fix y1 all wall/gran/cluster model hertz tangential history primitive type 1 yplane 0.02
fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0.0
fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2500 shape disk 7 diameter 6e-3 orientation random
fix d all particledistribution/discrete 15485867 1 t 1.0
)";
}

inline constexpr const char* settle = R"(create_atoms 1 single 0.01 0.01 0.055 units box
set group all diameter 3e-3 density 2500
group lonely id 1
group bed initialize
region fill block 0 0.02 0 0.02 0 0.05 units box
fix ins bed insert/pack seed 32452843 distributiontemplate d insert_every once orientation random all_in yes region fill particles_in_region 12
fix g bed gravity 9.81 vector 0 0 -1
fix integr bed nve/cluster
run 12000
unfix ins
thermo_style custom step atoms ke f_cluster_history f_floor[3]
thermo_modify format float %.15g
thermo 1
)";

} // namespace eccentra::test
