// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of files with checksums that exist completely or not at all. Each side of a checkpoint consists of them.
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

/// A new folder of files. The files are written in `folder`.tmp; commit() flushes them to the disk, writes the manifest
/// and renames the folder. All members throw Refusal with one sentence if the disk cannot be written.
class DurableFolder {
 public:
  /// Makes the folder under a temporary name.
  explicit DurableFolder(std::string folder);
  DurableFolder(const DurableFolder&) = delete;
  DurableFolder& operator=(const DurableFolder&) = delete;
  /// Removes the files if they were not committed.
  ~DurableFolder();

  /// Writes one file and waits until it is on the disk.
  void add(const std::string& name, const void* data, std::size_t bytes);
  /// Writes the manifest, flushes the folder and renames it; an existing folder of that name is removed. Returns the
  /// checksum of the manifest.
  std::uint32_t commit(const CheckpointMark& mark, const Notes& notes = {});

 private:
  std::string folder_;
  std::string lines_;
  bool committed_ = false;
};

/// Contents of a manifest or record.
struct Manifest {
  CheckpointMark mark;        ///< the instant that both sides share
  Notes notes;                ///< further keys and values
  std::uint32_t checksum = 0; ///< of the manifest's own text

  /// The first note of that name, or an empty string.
  std::string note(const std::string& name) const;
};

/// The manifest of a committed folder if every file has its size and checksum. Else nothing, and `why` (may be null)
/// receives the reason in one sentence.
std::optional<Manifest> check_folder(const std::string& folder, std::string* why = nullptr);

/// Writes a single small file, which replaces an earlier one at once. Throws Refusal.
void write_record(const std::string& path, const CheckpointMark& mark, const Notes& notes);
/// The record, or nothing if there is none; `why` as in check_folder.
std::optional<Manifest> read_record(const std::string& path, std::string* why = nullptr);

/// Numbers N of the entries `prefix`N`suffix` in `folder`, largest first.
std::vector<std::int64_t> numbered_entries(const std::string& folder, const std::string& prefix,
                                           const std::string& suffix = "");

} // namespace eccentra::link
