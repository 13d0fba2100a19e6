// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every file that OpenFOAM writes ends with a line of stars between slashes.
#include "support/halfWritten.H"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>

namespace Foam {

namespace {

namespace fs = std::filesystem;

/// The time that a folder's name says; nothing for other folders.
std::optional<double> timeOf(const std::string& name) {
  char* end = nullptr;
  const double time = std::strtod(name.c_str(), &end);
  if (name.empty() || !std::isdigit(static_cast<unsigned char>(name[0])) || *end) {
    return {};
  }
  return time;
}

/// Of OpenFOAM, as far as its first bytes tell; a file that was opened and no more has none.
bool ofOpenFoam(const fs::path& path) {
  std::string head(1024, ' ');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), std::streamsize(head.size()));
  return file.gcount() == 0 || head.find("FoamFile") != std::string::npos;
}

} // namespace

bool wholeFile(const fs::path& path) {
  if (path.extension() == ".gz") {
    return true;
  }
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  constexpr std::streamoff kTail = 16;
  file.seekg(std::max<std::streamoff>(0, size - kTail));
  std::string tail(std::size_t(std::min(size, kTail)), ' ');
  file.read(tail.data(), std::streamsize(tail.size()));
  while (!tail.empty() && std::isspace(static_cast<unsigned char>(tail.back()))) {
    tail.pop_back();
  }
  return file && tail.size() >= 2 && tail.substr(tail.size() - 2) == "//";
}

void removeHalfWritten(const fs::path& folder, double start) {
  std::error_code gone;
  for (fs::directory_iterator entry(folder, gone), last; !gone && entry != last; entry.increment(gone)) {
    const std::optional<double> time = timeOf(entry->path().filename());
    if (!time || !(*time > start) || !entry->is_directory(gone)) {
      continue;
    }
    for (fs::recursive_directory_iterator it(entry->path(), gone), end; !gone && it != end; it.increment(gone)) {
      if (it->is_regular_file(gone) && !wholeFile(it->path()) && ofOpenFoam(it->path()) &&
          fs::remove(it->path(), gone)) {
        std::cerr << "annulusFoam: note: '" << it->path().string()
                  << "' is not whole, as an interrupted run leaves it: removed" << std::endl;
      }
    }
  }
}

} // namespace Foam
