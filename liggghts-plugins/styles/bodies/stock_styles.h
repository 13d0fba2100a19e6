// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What each style and command of stock LIGGGHTS 3.8.0 does with a body that is a cluster: the table behind the refusals
// and behind docs/clusters-and-stock-styles.md.
#pragma once

#include <string>
#include <vector>

namespace eccentra::styles {

/// Where LIGGGHTS looks the name up: the word of the script, or the first word of a `set` pair or of a thermo column.
enum class StockKind { fix, compute, pair_style, dump, region, command, set, thermo, atom_style, run_style, min_style };

enum class StockVerdict {
  acts,       ///< reads of a body only what is right for any shape
  made_right, ///< would take a body for its bounding sphere, or lose its orientation; corrected by Eccentra
  refused     ///< stops the script in one sentence where bodies are in reach
};

/// Which bodies a style reaches.
enum class StockReach {
  scene, ///< all, whatever group it was given
  group  ///< those of its group
};

struct StockStyle {
  StockKind kind;
  const char* name;
  StockVerdict verdict;
  const char* reason;      ///< a clause: what it reads of a body, or what it does wrong with it
  const char* remedy = ""; ///< of refused styles: an imperative sentence without its full stop
  StockReach reach = StockReach::scene;
};

const std::vector<StockStyle>& stock_styles();

/// The row of a style, or null where the table has none (styles of Eccentra and of other libraries).
const StockStyle* find_stock_style(StockKind kind, const std::string& name);

/// The word of the script for a kind: "fix", "pair_style", ...
const char* kind_name(StockKind kind);

/// The sentence with which a refused style stops the script; `who` names it as the script does ("fix heat").
std::string refusal(const StockStyle& style, const std::string& who);

} // namespace eccentra::styles
