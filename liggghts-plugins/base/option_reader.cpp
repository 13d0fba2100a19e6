// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Values of a command's keywords, and the sentences that refuse them.
#include "base/option_reader.h"

#include "base/refusal.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace eccentra::base {

std::optional<double> finite_number(const std::string& text) {
  const char* first = text.data();
  const char* const last = first + text.size();
  if (first != last && *first == '+')
    ++first;
  double value = 0;
  const auto [end, problem] = std::from_chars(first, last, value);
  // A number below the range of double is 0 for all that it is used for.
  if (problem == std::errc::result_out_of_range && end == last && text.find("e-") != std::string::npos)
    return 0.;
  if (problem != std::errc() || end != last || !std::isfinite(value) || (first != text.data() && *first == '-'))
    return std::nullopt;
  return value;
}

std::optional<bool> switch_value(const std::string& text) {
  if (text == "on" || text == "yes")
    return true;
  if (text == "off" || text == "no" || text == "none")
    return false;
  return std::nullopt;
}

void OptionReader::unknown(const std::string& known) const {
  refuse("unknown keyword '{}'; expected one of {}", keyword_, known);
}

const std::string& OptionReader::value(const std::string& expected) {
  if (arguments_.empty())
    refuse("the line ends too early; expected {}", expected);
  if (!more() && at_ > 0 && arguments_[at_ - 1] != keyword_)
    refuse("keyword '{}': the line ends after '{}'; expected {}", keyword_, arguments_[at_ - 1], expected);
  if (!more())
    refuse("keyword '{}' is the last word; expected {} after it", keyword_, expected);
  return arguments_[at_++];
}

void OptionReader::expect(const std::string& word) {
  if (const std::string& text = value("'" + word + "'"); text != word)
    refuse("keyword '{}': '{}' is not '{}'; expected {} there", keyword_, text, word, word);
  keyword_ = word;
}

double OptionReader::number(const std::string& expected) {
  const std::string& text = value(expected);
  const std::optional<double> read = finite_number(text);
  if (!read)
    refuse("keyword '{}': '{}' is not a finite number; expected {}", keyword_, text, expected);
  return *read;
}

namespace {
std::string named(const std::string& text, const std::string& name) {
  return name.empty() ? text : text + " for " + name;
}
} // namespace

double OptionReader::positive(const std::string& name) {
  const std::string expected = named("a number greater than 0", name);
  const double read = number(expected);
  if (!(read > 0))
    refuse("keyword '{}': '{}' is not greater than 0; expected {}", keyword_, arguments_[at_ - 1], expected);
  return read;
}

double OptionReader::at_least(double low, const std::string& name) {
  const std::string expected = named(fmt::format("a number of at least {}", low), name);
  const double read = number(expected);
  if (!(read >= low))
    refuse("keyword '{}': '{}' is less than {}; expected {}", keyword_, arguments_[at_ - 1], low, expected);
  return read;
}

double OptionReader::between(double low, double high, const std::string& name) {
  const std::string expected = named(fmt::format("a number between {} and {}", low, high), name);
  const double read = number(expected);
  if (!(read > low && read < high))
    refuse("keyword '{}': '{}' is not between {} and {}; expected {}", keyword_, arguments_[at_ - 1], low, high,
           expected);
  return read;
}

int OptionReader::count(int low, const std::string& unit) {
  const std::string expected = fmt::format("a whole number{}{} of at least {}", unit.empty() ? "" : " of ", unit, low);
  const double read = number(expected);
  if (read != std::floor(read) || read < low || read > std::numeric_limits<int>::max())
    refuse("keyword '{}': '{}' is not whole, too small or too large; expected {}", keyword_, arguments_[at_ - 1],
           expected);
  return static_cast<int>(read);
}

bool OptionReader::on_off() {
  const std::string& text = value("on or off");
  const std::optional<bool> read = switch_value(text);
  if (!read)
    refuse("keyword '{}': '{}' is neither on nor off; expected on or off", keyword_, text);
  return *read;
}

double OptionReader::factor() {
  if (at_number())
    return at_least(0, "or on or off");
  const std::string& text = value("on, off or a factor");
  const std::optional<bool> read = switch_value(text);
  if (!read)
    refuse("keyword '{}': '{}' is neither on nor off nor a number; expected on, off or a factor of at least 0",
           keyword_, text);
  return *read ? 1 : 0;
}

const std::string& OptionReader::choice(std::initializer_list<const char*> names) {
  std::string expected;
  for (const char* name : names)
    expected += (expected.empty() ? "" : names.size() == 2 ? " or " : ", ") + std::string(name);
  const std::string& text = value(expected);
  for (const char* name : names)
    if (text == name)
      return text;
  refuse("keyword '{}': '{}' is unknown; expected {}", keyword_, text, expected);
}

} // namespace eccentra::base
