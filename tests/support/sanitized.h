// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fewer repetitions under the address sanitizer, which makes code some ten times as slow.
#pragma once

namespace eccentra::test {

/// How often a test repeats one law over random cases: the release build all of them, the sanitized build the first
/// few.
constexpr int repetitions(int all, int sanitized) {
#ifdef __SANITIZE_ADDRESS__
  return all < sanitized ? all : sanitized;
#else
  static_cast<void>(sanitized);
  return all;
#endif
}

} // namespace eccentra::test
