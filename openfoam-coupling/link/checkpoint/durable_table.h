// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A table of text rows on a disk that may be full for a while: no row is lost, and none is written in part.
#pragma once

#include <string>
#include <vector>

namespace eccentra::link {

/// A text table that survives a kill: a row is there as a whole or not at all.
class DurableTable {
 public:
  /// Begins a table, or continues an existing one (`goes_on`) after its rows with a first column up to `last`. A table
  /// with rows and another heading, or of a run that this one does not continue, is renamed. Throws Refusal if the file
  /// cannot be opened.
  DurableTable(std::string path, std::string heading, bool goes_on, double last);
  DurableTable(const DurableTable&) = delete;
  DurableTable& operator=(const DurableTable&) = delete;
  ~DurableTable();

  /// Adds a row without its end of line. Rows that cannot be written are kept in memory and tried again.
  void add(const std::string& row);
  /// Flushes the table to the disk.
  void sync();
  /// Rows in the file.
  long long rows() const { return rows_; }
  /// Rows that could not be written yet.
  const std::vector<std::string>& pending() const { return pending_; }
  /// The reason.
  const std::string& problem() const { return problem_; }
  /// Messages for the user, one sentence each. Empties the list.
  std::vector<std::string> take_messages();

 private:
  void open();
  bool write(const std::string& text);

  std::string path_;
  std::string heading_;
  int descriptor_ = -1;
  long long bytes_ = 0; ///< up to the end of the last whole row
  long long rows_ = 0;
  std::vector<std::string> pending_;
  std::vector<std::string> messages_;
  std::string problem_;
};

} // namespace eccentra::link
