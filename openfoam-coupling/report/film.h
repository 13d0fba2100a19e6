// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as one moving picture.
#pragma once

#include <filesystem>
#include <vector>

namespace eccentra::report {

/// Puts PNG files of one size together to an animated PNG, which browsers show as a film that begins again; other
/// programs show its first picture. `seconds` from one picture to the next. Throws std::runtime_error with one sentence
/// if a file is no PNG, is of another size, or cannot be written.
void write_film(const std::vector<std::filesystem::path>& pictures, double seconds, const std::filesystem::path& file);

} // namespace eccentra::report
