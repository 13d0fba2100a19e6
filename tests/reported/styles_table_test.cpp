// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The table of stock styles names all that LIGGGHTS has, and its page in docs is the table.
#include "reported/throwing_session.h"
#include "styles/bodies/stock_styles.h"
#include "support/read_file.h"
#include "support/run_program.h"

#include "force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace eccentra;
using namespace eccentra::test;
using styles::StockKind;
using styles::StockStyle;

namespace {

/// One row for all names of which the same is said: first what is refused, then what is made right, then what acts.
std::string table_of(StockKind kind, const std::string& title) {
  const char* const verdicts[] = {"acts", "made right", "refused"};
  std::vector<std::pair<std::string, std::string>> rows[3][2]; // names, and the other columns
  for (const StockStyle& style : styles::stock_styles())
    if (style.kind == kind) {
      const int verdict = static_cast<int>(style.verdict), group = style.reach == styles::StockReach::group;
      const std::string name = "`" + std::string(style.name) + "`", rest = std::string(" | ") + verdicts[verdict] +
                                                                           (group ? " (its group)" : "") + " | " +
                                                                           style.reason + " | " + style.remedy + " |\n";
      auto& same = rows[verdict][group];
      const auto found = std::find_if(same.begin(), same.end(), [&](const auto& row) { return row.second == rest; });
      if (found == same.end())
        same.emplace_back(name, rest);
      else
        found->first += ", " + name;
    }
  std::string text = "\n## " + title + "\n| names | with clusters | because it | instead |\n|---|---|---|---|\n";
  for (int verdict = 2; verdict >= 0; --verdict)
    for (const auto& part : rows[verdict])
      for (const auto& [names, rest] : part)
        text += "| " + names + rest;
  return text;
}

} // namespace

TEST(Reported, stock_styles_are_all_in_the_table) {
  Session session("");
  std::set<std::string> ours;
  for (const styles::StyleRecord& record : styles::style_records())
    ours.insert(record.kind + " " + record.name);
  std::map<StockKind, std::set<std::string>> live;
  const auto add = [&](StockKind kind, const std::string& name) {
    // Some of ours stand in for stock's, under their names.
    if (!ours.count(std::string(styles::kind_name(kind)) + " " + name) || styles::find_stock_style(kind, name))
      live[kind].insert(name);
  };
  for (const std::string& name : styles::registered_fixes(&session.lammps()))
    add(StockKind::fix, name);
  for (const std::string& name : styles::registered_computes(&session.lammps()))
    add(StockKind::compute, name);
  for (const auto& entry : *session.lammps().force->pair_map)
    add(StockKind::pair_style, entry.first);
  // The rest are no maps; LIGGGHTS itself lists them.
  const std::string listed = run_program({"liggghts", "-h"}).output;
  const std::pair<const char*, StockKind> sections[] = {{"Atom styles:", StockKind::atom_style},
                                                        {"Integrate styles:", StockKind::run_style},
                                                        {"Region styles:", StockKind::region},
                                                        {"Dump styles:", StockKind::dump}};
  for (const auto& [title, kind] : sections) {
    const std::size_t at = listed.find(title);
    ASSERT_NE(at, std::string::npos) << title << listed;
    std::istringstream words(
        listed.substr(at + std::string(title).size(), listed.find("* ", at) - at - std::string(title).size()));
    for (std::string name; words >> name;)
      add(kind, name);
  }
  for (const auto& [kind, names] : live) {
    EXPECT_GT(names.size(), 1u) << styles::kind_name(kind);
    for (const std::string& name : names)
      EXPECT_NE(styles::find_stock_style(kind, name), nullptr) << styles::kind_name(kind) << " " << name;
    for (const StockStyle& style : styles::stock_styles())
      if (style.kind == kind) {
        EXPECT_TRUE(names.count(style.name)) << "LIGGGHTS has no " << styles::kind_name(kind) << " " << style.name;
      }
  }
}

TEST(Reported, commands_are_all_in_the_table) {
  Session session("");
  std::set<std::string> live;
  for (const std::string& name : styles::registered_commands(&session.lammps()))
    live.insert(name);
  for (const styles::StyleRecord& record : styles::style_records())
    if (record.command)
      live.erase(record.name);
  // Those that are no entries of the map are members of Input, under their names or nearly so.
  const std::map<std::string, std::string> renamed = {{"ifthenelse", "if"},
                                                      {"next_command", "next"},
                                                      {"variable_command", "variable"},
                                                      {"group_command", "group"},
                                                      {"neighbor_command", "neighbor"}};
  const std::string header = contents("/usr/include/liggghts/input.h");
  const std::regex member(R"(\n *void ([a-z_]+)\(\);)");
  const std::size_t first = header.find("void clear();");
  ASSERT_NE(first, std::string::npos);
  const std::string members = "\n" + header.substr(first);
  for (std::sregex_iterator found(members.begin(), members.end(), member), end; found != end; ++found) {
    const std::string name = (*found)[1];
    live.insert(renamed.count(name) ? renamed.at(name) : name);
  }
  EXPECT_GT(live.size(), 80u);
  for (const std::string& name : live)
    EXPECT_NE(styles::find_stock_style(StockKind::command, name), nullptr) << name;
  for (const StockStyle& style : styles::stock_styles())
    if (style.kind == StockKind::command) {
      EXPECT_TRUE(live.count(style.name)) << "LIGGGHTS has no command " << style.name;
    }
}

TEST(Reported, page_of_stock_styles) {
  const std::string page = required_environment("ECCENTRA_SOURCE") + "/docs/clusters-and-stock-styles.md";
  const std::string text = contents(page),
                    mark = "<!-- The tables below are those of the library; a test compares them. -->\n";
  std::string tables;
  const std::pair<StockKind, const char*> titles[] = {{StockKind::fix, "Fixes"},
                                                      {StockKind::compute, "Computes"},
                                                      {StockKind::pair_style, "Pair styles"},
                                                      {StockKind::dump, "Dumps"},
                                                      {StockKind::command, "Commands"},
                                                      {StockKind::set, "Words of set"},
                                                      {StockKind::thermo, "Thermo columns"},
                                                      {StockKind::region, "Regions"},
                                                      {StockKind::atom_style, "Atom styles"},
                                                      {StockKind::run_style, "Run styles"},
                                                      {StockKind::min_style, "Minimiser styles"}};
  for (const auto& [kind, title] : titles)
    tables += table_of(kind, title);
  const std::size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos) << page;
  if (std::getenv("ECCENTRA_WRITE_PAGE"))
    write_file(page, text.substr(0, at + mark.size()) + tables);
  EXPECT_EQ(contents(page).substr(at + mark.size()), tables)
      << "write it anew with ECCENTRA_WRITE_PAGE=1 in the environment of this test";
}
