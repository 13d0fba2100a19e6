// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Plain values in a message: three ways over one description of a record's fields (wire_records.h).
#pragma once

#include "link/socket/wire.h"

#include <cmath>
#include <cstring>
#include <string>

namespace eccentra::link::wire {

/// Refuses a message of the other side; `what` completes the sentence.
[[noreturn]] inline void broken(const std::string& what) {
  throw Refusal("a message of the other side " + what +
                ": it is broken or not Eccentra's, check who uses the address and install the same release on both "
                "sides");
}

/// Counts the bytes that a record has in a message.
class Sizer {
 public:
  /// Sum so far.
  constexpr std::size_t bytes() const { return bytes_; }
  /// A value as it lies in memory.
  template <class Value> constexpr void plain(const Value&) { bytes_ += sizeof(Value); }
  /// A finite number.
  constexpr void number(const double&) { bytes_ += sizeof(double); }
  /// A truth value, as four bytes.
  constexpr void yes_or_no(const bool&) { bytes_ += sizeof(std::uint32_t); }
  /// A set of fluid quantities.
  constexpr void quantities(const unsigned&) { bytes_ += sizeof(std::uint32_t); }
  /// Four bytes that keep the alignment.
  constexpr void unused() { bytes_ += sizeof(std::uint32_t); }

 private:
  std::size_t bytes_ = 0;
};

/// Appends plain values.
class Writer {
 public:
  /// Writes to memory that has room for all that follows.
  explicit Writer(std::byte* to) : to_(to) {}
  /// A value as it lies in memory.
  template <class Value> void plain(Value value) { raw(&value, sizeof value); }
  /// A finite number.
  void number(double value) { plain(value); }
  /// A truth value, as four bytes.
  void yes_or_no(bool value) { plain(std::uint32_t(value)); }
  /// A set of fluid quantities.
  void quantities(unsigned bits) { plain(std::uint32_t(bits)); }
  /// Four bytes that keep the alignment.
  void unused() { plain(std::uint32_t(0)); }
  /// `bytes` as they are.
  void raw(const void* from, std::size_t bytes) {
    if (bytes > 0)
      std::memcpy(to_, from, bytes);
    to_ += bytes;
  }

 private:
  std::byte* to_;
};

/// Takes plain values off what is left; never beyond it.
class Reader {
 public:
  /// Reads `view`, which must outlive the reader.
  explicit Reader(View view) : view_(view) {}
  /// Bytes that are left.
  std::size_t left() const { return view_.size; }
  /// The next byte.
  const std::byte* here() const { return view_.data; }
  /// A value as it lies in memory. All that read throw Refusal where the message is too short or the value is
  /// impossible.
  template <class Value> void plain(Value& value) {
    if (view_.size < sizeof(Value))
      broken("ends too early");
    std::memcpy(&value, view_.data, sizeof value);
    view_.data += sizeof value;
    view_.size -= sizeof value;
  }
  /// The same, returned.
  template <class Value> Value take() {
    Value value;
    plain(value);
    return value;
  }
  /// A finite number.
  void number(double& value) {
    plain(value);
    if (!std::isfinite(value))
      broken("holds a value that is no number");
  }
  /// A truth value.
  void yes_or_no(bool& value) {
    const auto word = take<std::uint32_t>();
    if (word > 1)
      broken("holds neither yes nor no where one of them belongs");
    value = word == 1;
  }
  /// A set of fluid quantities that all exist.
  void quantities(unsigned& bits) {
    bits = take<std::uint32_t>();
    if (bits & ~kAllQuantities)
      broken("names fluid quantities that do not exist");
  }
  /// Skips four bytes.
  void unused() { take<std::uint32_t>(); }
  /// Refuses bytes that are left.
  void end() const {
    if (view_.size != 0)
      broken("is longer than its contents");
  }

 private:
  View view_;
};

} // namespace eccentra::link::wire
