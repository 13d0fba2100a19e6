// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers from text, the same in every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace eccentra::shape {

/// The number that the whole `word` represents, or nothing. Fortran's exponent D counts as E; nan and inf are numbers.
inline std::optional<double> decimal(std::string word) {
  if (!word.empty() && word[0] == '+')
    word.erase(0, 1);
  for (char& c : word)
    if (c == 'd' || c == 'D' || c == 'E')
      c = 'e';
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || word[0] == '+' || end != word.data() + word.size())
    return std::nullopt;
  if (problem == std::errc::result_out_of_range) // from_chars does not tell overflow from underflow
    return word.find("e-") != std::string::npos ? 0.0 : HUGE_VAL;
  if (problem != std::errc())
    return std::nullopt;
  return value;
}

} // namespace eccentra::shape
