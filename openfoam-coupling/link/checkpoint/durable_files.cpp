// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Writes in the order file, sync, manifest, sync, rename, sync: a crash at any moment leaves the old or the new.
#include "link/checkpoint/durable_files.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace eccentra::link {
namespace {

namespace fs = std::filesystem;

/// Rises with every change of what the files of either side hold or mean. 3: random numbers, and the fluid's mesh and
/// steps.
constexpr const char* kFirstLine = "eccentra checkpoint 4";
constexpr const char* kManifest = "manifest";
/// Longest piece that zlib and write() take at once.
constexpr std::size_t kPiece = std::size_t(1) << 30;

[[noreturn]] void cannot(const std::string& what, const std::string& path, int reason) {
  throw Refusal("cannot " + what + " '" + path + "' (" + std::strerror(reason) +
                "): make room or choose another folder; checkpoints written before stay as they are");
}

std::uint32_t checksum(const void* data, std::size_t bytes) {
  uLong sum = crc32(0, nullptr, 0);
  const auto* at = static_cast<const Bytef*>(data);
  for (std::size_t left = bytes; left > 0;) {
    const std::size_t piece = std::min(left, kPiece);
    sum = crc32(sum, at, static_cast<uInt>(piece));
    at += piece;
    left -= piece;
  }
  return static_cast<std::uint32_t>(sum);
}

std::string hex(std::uint64_t value) {
  char text[32];
  std::snprintf(text, sizeof text, "%" PRIx64, value);
  return text;
}

class File {
 public:
  File(const std::string& path, int flags) : path_(path), descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0)
      cannot("open", path_, errno);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0)
      ::close(descriptor_);
  }
  void write(const void* data, std::size_t bytes) {
    for (const char* at = static_cast<const char*>(data); bytes > 0;) {
      const ssize_t done = ::write(descriptor_, at, std::min(bytes, kPiece));
      if (done < 0 && errno == EINTR)
        continue;
      if (done <= 0)
        cannot("write", path_, done < 0 ? errno : ENOSPC);
      at += done;
      bytes -= static_cast<std::size_t>(done);
    }
  }
  void sync() {
    // Some file systems cannot sync folders, and say so by EINVAL.
    if (::fsync(descriptor_) != 0 && errno != EINVAL)
      cannot("bring to the disk", path_, errno);
  }
  void close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    if (::close(descriptor) != 0)
      cannot("close", path_, errno);
  }

 private:
  std::string path_;
  int descriptor_;
};

void write_file(const std::string& path, const void* data, std::size_t bytes) {
  File file(path, O_WRONLY | O_CREAT | O_TRUNC);
  file.write(data, bytes);
  file.sync();
  file.close();
}

void sync_folder(const fs::path& folder) {
  File(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY).sync();
}

std::optional<std::string> read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    return {};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string head(const CheckpointMark& mark) {
  return std::string(kFirstLine) + "\nstep " + std::to_string(mark.step) + "\nid " + hex(mark.id) + '\n';
}

/// The last line is the checksum of all before it.
std::string sealed(const std::string& lines) {
  return lines + "seal " + hex(checksum(lines.data(), lines.size())) + '\n';
}

std::string lines_of(const Notes& notes) {
  std::string lines;
  for (const auto& [name, value] : notes)
    lines += name + ' ' + value + '\n';
  return lines;
}

std::optional<Manifest> parse(const std::string& path, std::string& why) {
  const std::optional<std::string> text = read_file(path);
  if (!text) {
    why = "'" + path + "' is not there";
    return {};
  }
  const auto seal = text->rfind("seal ");
  if (seal == std::string::npos || *text != sealed(text->substr(0, seal))) {
    why = "'" + path + "' is damaged or was written in part";
    return {};
  }
  Manifest manifest;
  manifest.checksum = checksum(text->data(), text->size());
  std::istringstream lines(text->substr(0, seal));
  std::string line;
  if (!std::getline(lines, line) || line != kFirstLine) {
    why = "'" + path + "' was written by another version of this software ('" + line.substr(0, 60) + "', not '" +
          kFirstLine + "'): go on with that version, or begin anew";
    return {};
  }
  while (std::getline(lines, line)) {
    const auto space = line.find(' ');
    const std::string name = line.substr(0, space);
    const std::string value = space == std::string::npos ? "" : line.substr(space + 1);
    if (name == "step")
      manifest.mark.step = std::strtoll(value.c_str(), nullptr, 10);
    else if (name == "id")
      manifest.mark.id = std::strtoull(value.c_str(), nullptr, 16);
    else
      manifest.notes.emplace_back(name, value);
  }
  return manifest;
}

/// `what`: "SIZE CHECKSUM NAME".
bool intact(const std::string& folder, const std::string& what, std::string& why) {
  std::istringstream arguments(what);
  std::size_t bytes = 0;
  std::string sum, name;
  arguments >> bytes >> sum >> std::ws;
  std::getline(arguments, name);
  const std::string path = folder + '/' + name;
  const std::optional<std::string> contents = read_file(path);
  if (!contents)
    why = "'" + path + "' is not there";
  else if (contents->size() != bytes)
    why = "'" + path + "' has " + std::to_string(contents->size()) + " bytes instead of " + std::to_string(bytes);
  else if (hex(checksum(contents->data(), contents->size())) != sum)
    why = "'" + path + "' is damaged (its checksum is another one)";
  else
    return true;
  return false;
}

} // namespace

DurableFolder::DurableFolder(std::string folder) : folder_(std::move(folder)) {
  std::error_code problem;
  fs::remove_all(folder_ + ".tmp", problem);
  fs::create_directories(folder_ + ".tmp", problem);
  if (problem)
    cannot("make the folder", folder_ + ".tmp", problem.value());
}

DurableFolder::~DurableFolder() {
  std::error_code ignored;
  if (!committed_)
    fs::remove_all(folder_ + ".tmp", ignored);
}

void DurableFolder::add(const std::string& name, const void* data, std::size_t bytes) {
  write_file(folder_ + ".tmp/" + name, data, bytes);
  lines_ += "file " + std::to_string(bytes) + ' ' + hex(checksum(data, bytes)) + ' ' + name + '\n';
}

std::uint32_t DurableFolder::commit(const CheckpointMark& mark, const Notes& notes) {
  const std::string temporary = folder_ + ".tmp";
  const std::string text = sealed(head(mark) + lines_of(notes) + lines_);
  write_file(temporary + '/' + kManifest, text.data(), text.size());
  sync_folder(temporary);
  std::error_code problem;
  fs::remove_all(folder_, problem);
  if (std::rename(temporary.c_str(), folder_.c_str()) != 0)
    cannot("rename", temporary, errno);
  committed_ = true;
  sync_folder(fs::path(folder_).parent_path());
  return checksum(text.data(), text.size());
}

std::string Manifest::note(const std::string& name) const {
  for (const auto& [key, value] : notes)
    if (key == name)
      return value;
  return "";
}

std::optional<Manifest> check_folder(const std::string& folder, std::string* why) {
  std::string reason;
  std::optional<Manifest> manifest = parse(folder + '/' + kManifest, reason);
  if (manifest)
    for (const auto& [name, value] : manifest->notes)
      if (name == "file" && !intact(folder, value, reason)) {
        manifest.reset();
        break;
      }
  if (why)
    *why = reason;
  return manifest;
}

void write_record(const std::string& path, const CheckpointMark& mark, const Notes& notes) {
  const std::string text = sealed(head(mark) + lines_of(notes));
  const std::string temporary = path + ".tmp";
  write_file(temporary, text.data(), text.size());
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
    cannot("rename", temporary, errno);
  sync_folder(fs::path(path).parent_path());
}

std::optional<Manifest> read_record(const std::string& path, std::string* why) {
  std::string reason;
  std::optional<Manifest> record = parse(path, reason);
  if (why)
    *why = reason;
  return record;
}

std::vector<std::int64_t> numbered_entries(const std::string& folder, const std::string& prefix,
                                           const std::string& suffix) {
  std::vector<std::int64_t> numbers;
  std::error_code problem;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
    const std::string name = entry.path().filename();
    if (name.size() <= prefix.size() + suffix.size() || name.compare(0, prefix.size(), prefix) != 0 ||
        name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0)
      continue;
    const std::string digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    if (digits.find_first_not_of("0123456789") == std::string::npos)
      numbers.push_back(std::strtoll(digits.c_str(), nullptr, 10));
  }
  std::sort(numbers.rbegin(), numbers.rend());
  return numbers;
}

} // namespace eccentra::link
