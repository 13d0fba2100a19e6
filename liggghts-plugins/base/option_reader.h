// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of a command one after the other; what it cannot read it refuses in one sentence.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::base {

/// The finite number that the whole text stands for, whatever the locale; nothing for any other text (nan, inf, "1m").
std::optional<double> finite_number(const std::string& text);

/// Every value is read under the keyword that was read last; a refusal (base/refusal.h) names keyword, value and what
/// is expected instead.
class OptionReader {
 public:
  explicit OptionReader(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {}

  bool more() const { return at_ < arguments_.size(); }
  /// How many arguments have been read.
  std::size_t at() const { return at_; }
  /// The next argument without reading it; there must be one.
  const std::string& peek() const { return arguments_[at_]; }
  /// True if the next argument is a number.
  bool at_number() const { return more() && finite_number(peek()).has_value(); }

  /// Reads a keyword, which later refusals name.
  const std::string& keyword() { return keyword_ = arguments_[at_++]; }
  /// Refuses the keyword that was read last: `known` are those that there are.
  [[noreturn]] void unknown(const std::string& known) const;

  /// Reads one value; `expected` says what it should be, as in "a file name".
  const std::string& value(const std::string& expected);
  double number(const std::string& expected = "a finite number");
  double positive(const std::string& name = "");
  double at_least(double low, const std::string& name = "");
  /// low < value < high.
  double between(double low, double high, const std::string& name = "");
  /// A whole number of at least `low`.
  int count(int low, const std::string& unit = "");
  /// on, yes: true; off, no, none: false.
  bool on_off();
  /// One of the names.
  const std::string& choice(std::initializer_list<const char*> names);

 private:
  std::vector<std::string> arguments_;
  std::size_t at_ = 0;
  std::string keyword_;
};

} // namespace eccentra::base
