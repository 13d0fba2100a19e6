// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Restart files of another version are refused in one sentence, wherever in the file the difference shows.
#include "styles/bodies/restart_seal.h"
#include "styles/bodies/restart_version.h"
#include "support/granular_script.h"
#include "support/program_output.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

using namespace eccentra;
using namespace eccentra::test;

namespace {

constexpr const char* head = "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\n"
                             "units si\n";
const std::string body = granular_material() + cluster_contacts("rolling_friction off") + R"(timestep 1e-5
fix floor all wall/gran/cluster model hertz tangential history primitive type 1 zplane 0
fix move all nve/cluster
)";

ProgramResult run_script(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
  write_file(folder / name, text);
  ProgramOptions options;
  options.directory = folder;
  return run_program({program("eccentra-dem"), "-in", name, "-log", "none"}, options);
}

} // namespace

TEST(RestartVersion, AnotherFormatIsRefused) {
  const auto folder = fresh_folder("restart_version");
  const ProgramResult made =
      run_script(folder, "make.in",
                 std::string(head) +
                     "boundary f f f\nregion box block 0 0.1 0 0.1 -0.01 0.1 units box\n"
                     "create_box 1 box\n" +
                     body +
                     "fix t all particletemplate/cluster 15485863 atom_type 1 density constant 2619 shape cube 8 "
                     "diameter 6.35e-3\nfix d all particledistribution/discrete 32452843 1 t 1.0\n"
                     "fix ins all insert/pack seed 86028121 distributiontemplate d insert_every once overlapcheck yes "
                     "all_in yes particles_in_region 5 region box\nrun 1\nunfix ins\nwrite_restart now.restart\n");
  ASSERT_EQ(made.status, 0) << made.output;
  const std::string go_on = std::string(head) + "read_restart now.restart\n" + body + "run 10\n";
  const ProgramResult same = run_script(folder, "go_on.in", go_on);
  ASSERT_EQ(same.status, 0) << same.output;

  const std::string file = contents(folder / "now.restart");
  char mark[sizeof(int)];
  std::memcpy(mark, &styles::restart_mark, sizeof mark);
  int places = 0;
  for (std::size_t at = file.find(mark, 0, sizeof mark); at != std::string::npos;
       at = file.find(mark, at + 1, sizeof mark)) {
    ++places;
    for (const bool numbered : {true, false}) {
      std::string other = file;
      ++other[numbered ? at : at + 2];
      write_file(folder / "now.restart", other);
      ASSERT_TRUE(styles::seal_restart_file((folder / "now.restart").string()));
      const ProgramResult refused = run_script(folder, "go_on.in", go_on);
      EXPECT_GT(refused.status, 0);
      const std::string sentence = "the restart file was written by another version of Eccentra (data format " +
                                   (numbered ? std::to_string(styles::restart_format + 1) : "without a number");
      const std::size_t said = refused.output.find(sentence);
      EXPECT_NE(said, std::string::npos) << "place " << places << ": " << refused.output;
      EXPECT_EQ(refused.output.find(sentence, said + 1), std::string::npos) << "said twice";
    }
  }
  EXPECT_EQ(places, 4) << "pair style, bodies, contacts, wall";
}
