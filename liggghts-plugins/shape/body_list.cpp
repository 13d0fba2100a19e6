// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads lists of bodies.
#include "shape/body_list.h"

#include "base/option_reader.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace eccentra::shape {

namespace {

constexpr const char* expected = "expected x y z [w x y z of the orientation [vx vy vz [wx wy wz]]]";

ListedBody body_of(const std::vector<double>& n, int line, const std::string& where) {
  ListedBody body;
  body.line = line;
  std::copy_n(n.begin(), 3, body.place);
  if (n.size() >= 7) {
    const double length = std::sqrt(n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6]);
    constexpr double round_off = 1e-3; // as typed by hand
    if (std::fabs(length - 1) > round_off)
      throw std::invalid_argument(where + ": the orientation has length " + std::to_string(length) +
                                  "; expected a quaternion w x y z of length 1");
    for (int k = 0; k < 4; ++k)
      body.orientation[k] = n[3 + k] / length;
  }
  if (n.size() >= 10)
    std::copy_n(n.begin() + 7, 3, body.velocity);
  if (n.size() >= 13)
    std::copy_n(n.begin() + 10, 3, body.angular_velocity);
  return body;
}

} // namespace

std::vector<ListedBody> read_body_list(std::istream& in, const std::string& file) {
  std::vector<ListedBody> bodies;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const std::string where = file + ":" + std::to_string(line);
    text.resize(std::min(text.size(), text.find('#')));
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream arguments(text);
    std::vector<double> numbers;
    for (std::string word; arguments >> word;) {
      const std::optional<double> value = base::finite_number(word);
      if (!value)
        throw std::invalid_argument(where + ": '" + word + "' is not a finite number; " + expected);
      numbers.push_back(*value);
    }
    if (numbers.empty())
      continue;
    const std::size_t n = numbers.size();
    if (n != 3 && n != 7 && n != 10 && n != 13)
      throw std::invalid_argument(where + ": " + std::to_string(n) + " numbers are not 3, 7, 10 or 13; " + expected);
    bodies.push_back(body_of(numbers, line, where));
  }
  if (bodies.empty())
    throw std::invalid_argument(file + ": holds no body; " + expected + " on each line");
  return bodies;
}

} // namespace eccentra::shape
