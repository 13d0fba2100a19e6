// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The report as one page that needs no other file and no network.
#pragma once

#include "report/summary.h"

namespace eccentra::report {

/// HTML with the table, the numbers that the cases were computed with, and the pictures of `folder`, where they exist,
/// inside the text.
std::string html_page(const std::vector<Case>& cases, const std::vector<Summary>& summaries,
                      const std::filesystem::path& folder);

} // namespace eccentra::report
