// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements LiggghtsSession.
#include "support/liggghts_session.h"

#include "styles/entry/style_registry.h"

#include "comm.h"

#include <cstdlib>
#include <sstream>
#include <vector>

namespace eccentra::test {

LiggghtsSession::LiggghtsSession(MPI_Comm ranks) {
  const bool verbose = std::getenv("ECCENTRA_TEST_VERBOSE") != nullptr;
  std::vector<std::string> words = {"liggghts", "-log", "/dev/null"};
  if (!verbose)
    words.insert(words.end(), {"-screen", "/dev/null"});
  std::vector<char*> arguments;
  for (std::string& word : words)
    arguments.push_back(word.data());
  lammps_ = std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(arguments.size()), arguments.data(), ranks);
  eccentra::styles::enter(lammps_.get());
}

LiggghtsSession::~LiggghtsSession() = default;

void LiggghtsSession::command(const std::string& line) {
  lammps_->input->one(line.c_str());
}

void LiggghtsSession::script(const std::string& lines) {
  std::istringstream stream(lines);
  std::string line;
  std::string pending;
  while (std::getline(stream, line)) {
    line = line.substr(0, line.find('#'));
    const auto last = line.find_last_not_of(" \t");
    if (last == std::string::npos)
      continue;
    line.resize(last + 1);
    if (line.back() == '&') {
      line.back() = ' ';
      pending += line;
      continue;
    }
    command(pending + line);
    pending.clear();
  }
}

int LiggghtsSession::local(int tag) const {
  const LAMMPS_NS::Atom& atom = *lammps_->atom;
  for (int i = 0; i < atom.nlocal; ++i)
    if (atom.tag[i] == tag)
      return i;
  return -1;
}

int LiggghtsSession::rank() const {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int LiggghtsSession::ranks() const {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

} // namespace eccentra::test
