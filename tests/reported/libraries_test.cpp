// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Programs of the build load nothing from the folder that they are started in.
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

using namespace eccentra::test;
namespace fs = std::filesystem;

TEST(Reported, library_in_the_working_folder) {
  const fs::path build = required_environment("ECCENTRA_BUILD");
  int looked_at = 0;
  for (const char* folder : {"bin", "lib", "tests"})
    for (const auto& file : fs::directory_iterator(build / folder)) {
      if (!file.is_regular_file())
        continue;
      const ProgramResult read = run_program({"readelf", "-d", file.path().string()});
      for (const char* tag : {"Library runpath: [", "Library rpath: ["}) {
        const auto at = read.output.find(tag);
        if (at == std::string::npos)
          continue;
        ++looked_at;
        const auto begin = read.output.find('[', at) + 1;
        std::istringstream entries(read.output.substr(begin, read.output.find(']', begin) - begin) + ":end");
        for (std::string entry; std::getline(entries, entry, ':') && entry != "end";)
          EXPECT_TRUE(!entry.empty() && (entry[0] == '/' || entry.rfind("$ORIGIN", 0) == 0))
              << file.path() << " has '" << entry << "' in its RUNPATH";
      }
    }
  EXPECT_GT(looked_at, 6);
  // Nothing is loaded from there, either.
  const fs::path trap = fresh_folder("trap");
  write_file(trap / "e.c",
             "#include <stdio.h>\n__attribute__((constructor)) static void f(void) { puts(\"TRAPPED\"); }\n");
  for (const char* name : {"libzmq.so.5", "libOpenFOAM.so", "libeccentra_link.so", "libmpi.so.40"}) {
    const ProgramResult made = run_program({"cc", "-shared", "-fPIC", "-o", name, "e.c"}, {trap, {}, 60});
    ASSERT_EQ(made.status, 0) << made.output;
  }
  for (const char* program :
       {"eccentra-dem", "annulusReport", "clusterShape", "eccentra-keys", "annulusFoam", "annulusMesh"})
    EXPECT_EQ(run_program({required_environment("ECCENTRA_BIN") + "/" + program, "-help"}, {trap, {}, 60})
                  .output.find("TRAPPED"),
              std::string::npos)
        << program;
}
