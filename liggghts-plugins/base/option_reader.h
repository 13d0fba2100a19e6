// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the arguments of a command in order, and refuses invalid ones in one sentence.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace eccentra::base {

/// The finite number that the whole text represents, in any locale; nothing for any other text (nan, inf, "1m").
std::optional<double> finite_number(const std::string& text);

/// on, yes: true; off, no, none: false; nothing for any other text.
std::optional<bool> switch_value(const std::string& text);

/// A value belongs to the keyword that was read last. Functions that read throw std::invalid_argument (base/refusal.h)
/// with a sentence that names keyword, value and expectation, also if the arguments end too early.
class OptionReader {
 public:
  /// Takes the arguments after those that the command has read itself.
  explicit OptionReader(std::vector<std::string> arguments) : arguments_(std::move(arguments)) {}

  /// True if an argument is left.
  bool more() const { return at_ < arguments_.size(); }
  /// Number of arguments that have been read.
  std::size_t at() const { return at_; }
  /// The next argument, which stays unread. Requires more().
  const std::string& peek() const { return arguments_[at_]; }
  /// True if the next argument is a number.
  bool at_number() const { return more() && finite_number(peek()).has_value(); }

  /// Reads a keyword, which later refusals name. Requires more().
  const std::string& keyword() { return keyword_ = arguments_[at_++]; }
  /// The same; refuses a line that ends here. `expected` describes the keyword, as in "a primitive wall".
  const std::string& keyword(const std::string& expected) { return keyword_ = value(expected); }
  /// Refuses the keyword that was read last; `known` lists the valid ones.
  [[noreturn]] void unknown(const std::string& known) const;

  /// Reads one value; `expected` describes it for a refusal, as in "a file name".
  const std::string& value(const std::string& expected);
  /// Reads this keyword and no other.
  void expect(const std::string& word);
  /// A finite number; `expected` describes it for a refusal.
  double number(const std::string& expected = "a finite number");
  /// A number greater than 0; `name` says what it stands for, with its unit.
  double positive(const std::string& name = "");
  /// A number of at least `low`.
  double at_least(double low, const std::string& name = "");
  /// A number with low < value < high.
  double between(double low, double high, const std::string& name = "");
  /// A whole number of at least `low`.
  int count(int low, const std::string& unit = "");
  /// A value that switch_value() knows.
  bool on_off();
  /// A factor of at least 0, or a value that switch_value() knows: on is 1, off is 0.
  double factor();
  /// One of `names`.
  const std::string& choice(std::initializer_list<const char*> names);

 private:
  std::vector<std::string> arguments_;
  std::size_t at_ = 0;
  std::string keyword_;
};

} // namespace eccentra::base
