// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Refusal of invalid input in one sentence that names the keyword, its value and the remedy.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace eccentra::base {

/// Throws std::invalid_argument. The sentence has the form `what: 'value' is not ...; expected ...`. A
/// caller that knows the file or the fix adds its name in front.
template <class... Values> [[noreturn]] void refuse(fmt::format_string<Values...> sentence, Values&&... values) {
  throw std::invalid_argument(fmt::format(sentence, std::forward<Values>(values)...));
}

} // namespace eccentra::base
