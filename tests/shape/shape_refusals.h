// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences that refuse the arguments of a shape.
#pragma once

#include "shape/cluster_shape.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::test {

/// What make_shape() says, or "accepted".
inline std::string refusal(const std::vector<std::string>& arguments, double diameter) {
  try {
    std::size_t used = 0;
    shape::make_shape(arguments, 0, used, diameter);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

inline void expect_sentence(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in: " << text;
}

} // namespace eccentra::test
