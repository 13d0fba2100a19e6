// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// eccentra-keys: makes the keys of a socket link between machines.
#include "base/standard_output.h"
#include "eccentra/version.h"
#include "link/socket/keys.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

int main(int argc, char** argv) {
  if (argc == 2 && !std::strcmp(argv[1], "--version")) {
    std::printf("eccentra-keys " ECCENTRA_VERSION "\n");
    return EXIT_SUCCESS;
  }
  const bool help = argc == 2 && (!std::strcmp(argv[1], "-h") || !std::strcmp(argv[1], "--help"));
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(
        help ? stdout : stderr,
        "usage: eccentra-keys FOLDER\n"
        "Makes dem.public, dem.secret, fluid.public and fluid.secret. Give the DEM side dem.secret and both public\n"
        "files, the fluid side fluid.secret and both public files (docs/link.md), by a safe way such as scp.\n");
    if (!help)
      return EXIT_FAILURE;
  }
  try {
    if (!help) {
      eccentra::link::make_keys(argv[1]);
      std::printf("keys are in %s\n", argv[1]);
    }
    eccentra::finish_standard_output();
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "eccentra-keys: error: %s\n", problem.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
