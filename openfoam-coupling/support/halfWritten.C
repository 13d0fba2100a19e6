// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Every file that OpenFOAM writes ends with a line of stars between slashes.
#include "support/halfWritten.H"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <string>

namespace Foam {

namespace {

namespace fs = std::filesystem;

bool isTime(const std::string& name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) &&
         name.find_first_not_of("0123456789.e+-") == std::string::npos;
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

void removeHalfWritten(const fs::path& folder) {
  std::error_code gone;
  for (fs::directory_iterator time(folder, gone), last; !gone && time != last; time.increment(gone)) {
    if (!isTime(time->path().filename()) || !time->is_directory(gone)) {
      continue;
    }
    for (fs::recursive_directory_iterator it(time->path(), gone), end; !gone && it != end; it.increment(gone)) {
      if (it->is_regular_file(gone) && !wholeFile(it->path()) && ofOpenFoam(it->path()) &&
          fs::remove(it->path(), gone)) {
        std::cerr << "annulusFoam: note: '" << it->path().string()
                  << "' is not whole, as an interrupted run leaves it: removed" << std::endl;
      }
    }
  }
}

} // namespace Foam
