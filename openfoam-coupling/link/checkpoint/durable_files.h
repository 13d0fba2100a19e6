// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of files that are there in full or not at all, with checksums; what each side of a checkpoint is made of.
#pragma once

#include "link/terms.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace eccentra::link {

/// Further facts of a manifest: a word and the rest of its line (no line breaks).
using Notes = std::vector<std::pair<std::string, std::string>>;

/// A new folder of files. They gather in `folder`.tmp; commit() brings them to the disk, writes the manifest and
/// renames. All members throw Refusal with one sentence where the disk does not take what it is given.
class DurableFolder {
 public:
  explicit DurableFolder(std::string folder);
  DurableFolder(const DurableFolder&) = delete;
  DurableFolder& operator=(const DurableFolder&) = delete;
  /// Removes what was not committed.
  ~DurableFolder();

  /// Writes one file and waits until it is on the disk.
  void add(const std::string& name, const void* data, std::size_t bytes);
  /// Writes the manifest, the folder itself, and gives it its name; a folder of that name goes. Returns the checksum of
  /// the manifest.
  std::uint32_t commit(const CheckpointMark& mark, const Notes& notes = {});

 private:
  std::string folder_;
  std::string lines_;
  bool committed_ = false;
};

/// What a manifest or record says.
struct Manifest {
  CheckpointMark mark;
  Notes notes;
  std::uint32_t checksum = 0; ///< of the manifest's own text

  /// The first note of that name, or an empty string.
  std::string note(const std::string& name) const;
};

/// The manifest of a committed folder if every file is there with its size and checksum; else nothing, and in `why`
/// (may be null) what is wrong in one sentence.
std::optional<Manifest> check_folder(const std::string& folder, std::string* why = nullptr);

/// A single small file, replaced in one go. Throws Refusal.
void write_record(const std::string& path, const CheckpointMark& mark, const Notes& notes);
std::optional<Manifest> read_record(const std::string& path, std::string* why = nullptr);

/// Numbers N of the entries `prefix`N`suffix` in `folder`, largest first.
std::vector<std::int64_t> numbered_entries(const std::string& folder, const std::string& prefix,
                                           const std::string& suffix = "");

} // namespace eccentra::link
