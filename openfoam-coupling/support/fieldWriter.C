// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// OpenFOAM does not see what the disk refuses when a file is closed: the end of each file tells.
#include "support/fieldWriter.H"

#include "support/halfWritten.H"
#include "support/inputError.H"

#include <filesystem>
#include <iostream>
#include <map>
#include <vector>

namespace Foam {

namespace {

namespace fs = std::filesystem;
using Written = std::map<fs::path, fs::file_time_type>;

Written filesIn(const fs::path& folder) {
  Written files;
  std::error_code gone;
  for (fs::recursive_directory_iterator it(folder, gone), end; !gone && it != end; it.increment(gone)) {
    if (it->is_regular_file(gone)) {
      files[it->path()] = it->last_write_time(gone);
    }
  }
  return files;
}

/// The files that are new or changed since.
std::vector<fs::path> changed(const fs::path& folder, const Written& before) {
  std::vector<fs::path> files;
  for (const auto& [path, when] : filesIn(folder)) {
    const auto found = before.find(path);
    if (found == before.end() || found->second != when) {
      files.push_back(path);
    }
  }
  return files;
}

void removeAll(const std::vector<fs::path>& files, const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : files) {
    fs::remove(file, ignored);
  }
  // Empty folders, the inner ones first; a folder with files of others stays.
  std::vector<fs::path> folders{folder};
  for (fs::recursive_directory_iterator it(folder, ignored), end; !ignored && it != end; it.increment(ignored)) {
    if (it->is_directory(ignored)) {
      folders.push_back(it->path());
    }
  }
  for (auto it = folders.rbegin(); it != folders.rend(); ++it) {
    if (fs::is_empty(*it, ignored)) {
      fs::remove(*it, ignored);
    }
  }
}

/// While it lives, the fields of a registry and of those in it that a name is left out of are not written.
class heldBack {
 public:
  heldBack(const objectRegistry& all, const std::function<bool(const word&)>& leftOut) { add(all, leftOut); }
  ~heldBack() {
    for (regIOobject* const object : objects_) {
      object->writeOpt() = IOobject::AUTO_WRITE;
    }
  }
  heldBack(const heldBack&) = delete;
  heldBack& operator=(const heldBack&) = delete;

 private:
  void add(const objectRegistry& registry, const std::function<bool(const word&)>& leftOut) {
    for (const word& name : registry.names<regIOobject>()) {
      auto& object = registry.lookupObjectRef<regIOobject>(name);
      if (const auto* inner = dynamic_cast<const objectRegistry*>(&object)) {
        if (inner != &registry) { // OpenFOAM's Time is one of its own objects
          add(*inner, leftOut);
        }
      } else if (object.writeOpt() == IOobject::AUTO_WRITE && leftOut(name)) {
        object.writeOpt() = IOobject::NO_WRITE;
        objects_.push_back(&object);
      }
    }
  }

  std::vector<regIOobject*> objects_;
};

} // namespace

// OpenFOAM writes the state of its function objects into the folder of a time after the fields.
void fieldWriter::clearLost() {
  if (!lostFolder_.empty()) {
    std::error_code ignored;
    fs::remove_all(lostFolder_, ignored);
    lostFolder_.clear();
  }
}

void fieldWriter::write() {
  clearLost();
  if (time_.writeTime()) {
    attempt();
  }
}

void fieldWriter::attempt() {
  const fs::path folder(std::string(time_.timePath()));
  const Written before = filesIn(folder);
  std::string problem;
  const heldBack held(time_, leftOut_);
  try {
    if (!time_.writeNow()) {
      problem = "a file could not be written";
    }
  } catch (const error& failure) {
    problem = failure.message();
  }
  const std::vector<fs::path> files = changed(folder, before);
  for (const fs::path& file : files) {
    if (problem.empty() && !wholeFile(file)) {
      problem = file.string() + " could not be written to its end";
    }
  }
  lastFailed_ = returnReduce(!problem.empty(), orOp<bool>());
  if (!lastFailed_) {
    return;
  }
  removeAll(files, folder);
  if (before.empty()) {
    lostFolder_ = folder.string();
  }
  ++lost_;
  std::error_code unknown;
  const fs::space_info space = fs::space(std::string(time_.path()), unknown);
  // A reserve of the file system counts as full.
  constexpr std::uintmax_t kFull = 1 << 20;
  reason_ = !unknown && space.available < kFull ? "No space left on device" : problem;
  for (char& c : reason_) {
    c = c == '\n' ? ' ' : c;
  }
  if (Pstream::master()) {
    std::cerr << "annulusFoam: warning: the fields of t = " << time_.timeName() << " s were not written to "
              << folder.string() << " (" << reason_
              << "): what was half written is removed, the run goes on; free space on the disk" << std::endl;
  }
}

void fieldWriter::finish() {
  clearLost();
  if (lastFailed_) {
    throw inputError("the fields of the last time, " + time_.timeName() + " s, are not there (" + reason_ +
                     "): free space on the disk and run again");
  }
  if (lost_ > 0) {
    Info << "the fields of " << lost_ << " time(s) were not written: the disk was full" << endl;
  }
}

} // namespace Foam
