// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Keeps the command line.
#include "link/checkpoint/resume_command.h"

#include <cstdlib>
#include <cstring>

namespace eccentra::link {
namespace {

std::string& command() {
  static std::string line;
  return line;
}

} // namespace

std::string shell_word(const std::string& text) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789@%+=:,./_-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos)
    return text;
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

void remember_command(int argc, const char* const* argv) {
  const char* const ranks = std::getenv("OMPI_COMM_WORLD_SIZE");
  std::string line = ranks && std::strcmp(ranks, "1") != 0 ? "mpirun -np " + std::string(ranks) + ' ' : "";
  bool resumes = false;
  for (int i = 0; i < argc; ++i) {
    line += (i > 0 ? " " : "") + shell_word(argv[i]);
    resumes = resumes || std::strcmp(argv[i], "-resume") == 0;
  }
  command() = line + (resumes ? "" : " -resume");
}

std::string resume_command() {
  const char* const given = std::getenv("ECCENTRA_RESUME_COMMAND");
  if (given && *given)
    return given;
  return command().empty() ? "eccentra-dem or annulusFoam, with -resume" : command();
}

} // namespace eccentra::link
