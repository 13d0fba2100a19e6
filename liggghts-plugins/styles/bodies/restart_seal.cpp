// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Seals restart files when LIGGGHTS has written them and checks the seal before LIGGGHTS reads them.
#include "styles/bodies/restart_seal.h"

#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/restart_version.h"
#include "styles/entry/style_registry.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace eccentra::styles {
namespace {

using namespace LAMMPS_NS;
namespace fs = std::filesystem;

struct Seal {
  char letters[16] = {'E', 'c', 'c', 'e', 'n', 't', 'r', 'a', ' ', 's', 'e', 'a', 'l', ' ', '1', '\n'};
  std::uint64_t bytes = 0; ///< of the file without its seal
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Seal) == 32, "the same on all machines");

std::uint64_t checksum(const std::string& text, std::size_t size) {
  constexpr std::size_t piece = 1u << 30; // zlib counts in 32 bits
  uLong sum = crc32(0, nullptr, 0);
  for (std::size_t at = 0; at < size; at += piece)
    sum = crc32(sum, reinterpret_cast<const Bytef*>(text.data() + at), static_cast<uInt>(std::min(piece, size - at)));
  return sum;
}

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The seal at the end of a file, or null.
bool read_seal(const std::string& text, Seal& seal) {
  const Seal ours;
  if (text.size() < sizeof seal)
    return false;
  std::memcpy(&seal, text.data() + text.size() - sizeof seal, sizeof seal);
  return std::memcmp(seal.letters, ours.letters, sizeof ours.letters) == 0;
}

bool holds_clusters_of_this_format(const std::string& text) {
  char mark[sizeof(int)];
  std::memcpy(mark, &restart_mark, sizeof mark);
  return text.find(FixClusterBodies::style_name) != std::string::npos &&
         text.find(std::string(mark, sizeof mark)) != std::string::npos;
}

std::string with(std::string name, char wildcard, const std::string& text) {
  const std::size_t at = name.find(wildcard);
  return at == std::string::npos ? name : name.replace(at, 1, text);
}

/// The file of the latest step among those that a name with '*' stands for, as LIGGGHTS chooses it.
std::string latest(const std::string& pattern) {
  const fs::path path(with(pattern, '%', "base"));
  const std::string name = path.filename().string();
  const std::size_t star = name.find('*');
  if (star == std::string::npos)
    return pattern;
  const std::string before = name.substr(0, star), after = name.substr(star + 1);
  long long newest = -1;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path("."), ignored)) {
    const std::string found = entry.path().filename().string();
    if (found.size() <= before.size() + after.size() || found.compare(0, before.size(), before) != 0 ||
        found.compare(found.size() - after.size(), after.size(), after) != 0)
      continue;
    const std::string step = found.substr(before.size(), found.size() - before.size() - after.size());
    if (step.size() < 19 && step.find_first_not_of("0123456789") == std::string::npos)
      newest = std::max(newest, std::stoll(step));
  }
  return with(pattern, '*', std::to_string(newest));
}

/// Written by LIGGGHTS: one file, or one for the whole scene and one per rank.
void seal_written(LAMMPS* lmp, const std::string& file) {
  if (!FixClusterBodies::find(lmp))
    return;
  std::vector<std::string> mine;
  if (lmp->comm->me == 0)
    mine.push_back(with(file, '%', "base"));
  if (file.find('%') != std::string::npos)
    mine.push_back(with(file, '%', std::to_string(lmp->comm->me)));
  for (const std::string& path : mine)
    if (!seal_restart_file(path))
      lmp->error->one(FLERR, ("write_restart: '" + path +
                              "' is not written in full; expected room on the disk; free some and write it again")
                                 .c_str());
}

void read_restart(LAMMPS* lmp, const std::string&, const std::vector<std::string>& arguments,
                  const StockCommand& stock) {
  std::string sentence;
  if (lmp->comm->me == 0 && arguments.size() == 1) {
    const std::string file = latest(arguments[0]);
    std::vector<std::string> parts = {with(file, '%', "base")};
    if (file.find('%') != std::string::npos)
      for (int rank = 0; fs::exists(with(file, '%', std::to_string(rank))); ++rank)
        parts.push_back(with(file, '%', std::to_string(rank)));
    for (const std::string& part : parts)
      if (const std::string problem = seal_problem(part); sentence.empty() && !problem.empty())
        sentence = "read_restart: '" + part + "' " + problem +
                   "; expected the file as write_restart left it; read an earlier one, or start the run anew";
  }
  int size = static_cast<int>(sentence.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, lmp->world);
  sentence.resize(size);
  MPI_Bcast(sentence.data(), size, MPI_CHAR, 0, lmp->world);
  if (size > 0)
    lmp->error->all(FLERR, sentence.c_str());
  stock(arguments);
}

const RegisterCommandGuard registered_guard("read_restart", &read_restart);
const RegisterRestartListener registered_listener(&seal_written);

} // namespace

bool seal_restart_file(const std::string& path) {
  const std::string text = contents(path);
  Seal seal;
  const std::size_t size = text.size() - (read_seal(text, seal) ? sizeof seal : 0);
  seal = Seal();
  seal.bytes = size;
  seal.checksum = checksum(text, size);
  std::fstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekp(static_cast<std::streamoff>(size));
  stream.write(reinterpret_cast<const char*>(&seal), sizeof seal);
  stream.close();
  return size > 0 && stream.good();
}

std::string seal_problem(const std::string& path) {
  const std::string text = contents(path);
  Seal seal;
  if (!read_seal(text, seal))
    return holds_clusters_of_this_format(text) ? "is cut short" : "";
  const std::size_t size = text.size() - sizeof seal;
  if (seal.bytes != size)
    return "is cut short";
  return seal.checksum == checksum(text, size) ? "" : "is damaged, as its checksum does not fit";
}

} // namespace eccentra::styles
