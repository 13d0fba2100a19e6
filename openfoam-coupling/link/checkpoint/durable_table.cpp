// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// A row that went in part is cut off again before the next one is tried.
#include "link/checkpoint/durable_table.h"

#include "link/checkpoint/checkpoint_room.h"
#include "link/terms.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace eccentra::link {
namespace {

/// Of two times that are the same, printed in 13 digits.
constexpr double kSameTime = 1e-11;

} // namespace

DurableTable::DurableTable(std::string path, std::string heading, bool goes_on, double last)
    : path_(std::move(path)), heading_(std::move(heading)) {
  std::ifstream in(path_, std::ios::binary);
  std::string line;
  long long at = 0;
  long long rows = 0;
  bool same_heading = false;
  if (std::getline(in, line)) {
    same_heading = line == heading_ && !in.eof();
    at = bytes_ = static_cast<long long>(line.size()) + 1;
  }
  while (std::getline(in, line)) {
    ++rows;
    at += static_cast<long long>(line.size()) + 1;
    // What a crash has cut off comes again.
    if (in.eof())
      break;
    char* end = nullptr;
    const double time = std::strtod(line.c_str(), &end);
    if (end == line.c_str() || *end != ',' || time > last + kSameTime * std::max(1.0, std::abs(last)))
      continue;
    bytes_ = at;
    rows_ = rows;
  }
  in.close();
  const bool continues = goes_on && same_heading;
  if (rows > 0 && !continues)
    messages_.push_back("'" + path_ + "' of an earlier run is kept as '" + keep_beside(path_) + "'" +
                        (goes_on ? ", because its columns are others" : ""));
  if (!continues)
    rows_ = 0;
  if (goes_on && rows_ == 0)
    messages_.push_back("'" + path_ + "' has no row of the run that this one continues: it begins with this run's");
  if (!continues)
    bytes_ = 0;
  open();
  if (bytes_ > 0)
    return;
  add(heading_);
  rows_ -= 1;
}

DurableTable::~DurableTable() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

void DurableTable::open() {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0)
    throw Refusal("cannot open '" + path_ + "' (" + std::strerror(errno) + "): make room or correct its rights");
  if (ftruncate(descriptor_, bytes_) != 0)
    throw Refusal("cannot cut '" + path_ + "' (" + std::strerror(errno) + "): correct its rights");
}

bool DurableTable::write(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = pwrite(descriptor_, text.data() + done, text.size() - done,
                                 static_cast<off_t>(bytes_ + static_cast<long long>(done)));
    if (count < 0 && errno == EINTR)
      continue;
    if (count <= 0) {
      problem_ = std::strerror(count < 0 ? errno : ENOSPC);
      // A part of a row that stays is written over by the next attempt.
      (void)!ftruncate(descriptor_, bytes_);
      return false;
    }
    done += static_cast<std::size_t>(count);
  }
  bytes_ += static_cast<long long>(text.size());
  ++rows_;
  return true;
}

void DurableTable::add(const std::string& row) {
  const bool troubled = !pending_.empty();
  pending_.push_back(row);
  std::size_t done = 0;
  while (done < pending_.size() && write(pending_[done] + '\n'))
    ++done;
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(done));
  if (!troubled && !pending_.empty())
    messages_.push_back("warning: '" + path_ + "' takes no row (" + problem_ +
                        "): rows are kept in memory until there is room");
  if (troubled && pending_.empty())
    messages_.push_back("'" + path_ + "' takes rows again: none was lost");
}

void DurableTable::sync() {
  (void)fsync(descriptor_);
}

std::vector<std::string> DurableTable::take_messages() {
  std::vector<std::string> all;
  all.swap(messages_);
  return all;
}

} // namespace eccentra::link
