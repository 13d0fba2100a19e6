// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the option reader takes for a number, and the sentence that each kind of bad value earns.
#include "base/option_reader.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

using eccentra::base::finite_number;
using eccentra::base::OptionReader;

namespace {

std::string sentence(const std::function<void(OptionReader&)>& read, std::vector<std::string> values) {
  values.insert(values.begin(), "every");
  OptionReader reader(values);
  reader.keyword();
  try {
    read(reader);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return "accepted";
}

} // namespace

TEST(OptionReader, NumbersAreWholeWords) {
  EXPECT_EQ(finite_number("2.5e-3"), 2.5e-3);
  EXPECT_EQ(finite_number("+3"), 3.);
  EXPECT_EQ(finite_number("-.5"), -.5);
  EXPECT_EQ(finite_number("1e-400"), 0.);
  for (const char* text : {"", "+", "-", "+-1", "1m", "1,5", "nan", "inf", "-inf", "1e400", " 1", "1 ", "0x10", "e"})
    EXPECT_FALSE(finite_number(text)) << text;
}

TEST(OptionReader, ValuesInsideTheirRangeAreTaken) {
  EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_EQ(r.count(1), 5); }, {"5"}), "accepted");
  EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_EQ(r.between(0, 1), .5); }, {"0.5"}), "accepted");
  EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_EQ(r.at_least(1), 1); }, {"1"}), "accepted");
  EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_EQ(r.choice({"a", "b"}), "b"); }, {"b"}), "accepted");
  for (const char* word : {"on", "yes"})
    EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_TRUE(r.on_off()); }, {word}), "accepted");
  for (const char* word : {"off", "no", "none"})
    EXPECT_EQ(sentence([](OptionReader& r) { EXPECT_FALSE(r.on_off()); }, {word}), "accepted");
}

TEST(OptionReader, EachRefusalNamesKeywordValueAndRemedy) {
  const std::function<void(OptionReader&)> reads[] = {
      [](OptionReader& r) { r.number(); },      [](OptionReader& r) { r.positive(); },
      [](OptionReader& r) { r.at_least(1); },   [](OptionReader& r) { r.between(0, 1); },
      [](OptionReader& r) { r.count(1); },      [](OptionReader& r) { r.on_off(); },
      [](OptionReader& r) { r.choice({"a"}); }, [](OptionReader& r) { r.expect("a"); },
  };
  for (const auto& read : reads) {
    const std::string bad = sentence(read, {"-x7"});
    for (const char* part : {"'every'", "'-x7'", "; expected "})
      EXPECT_NE(bad.find(part), std::string::npos) << bad;
    const std::string none = sentence(read, {});
    for (const char* part : {"'every'", "last word", "; expected "})
      EXPECT_NE(none.find(part), std::string::npos) << none;
  }
  for (const char* value : {"0", "2.5", "3e9", "-1"})
    EXPECT_NE(sentence(reads[4], {value}).find("'" + std::string(value) + "'"), std::string::npos) << value;
  EXPECT_NE(sentence(reads[1], {"0"}).find("'0'"), std::string::npos);
  EXPECT_NE(sentence(reads[3], {"1"}).find("'1'"), std::string::npos);
  EXPECT_NE(sentence([](OptionReader& r) { r.keyword("a wall"); }, {}).find("expected a wall"), std::string::npos);
  EXPECT_NE(sentence([](OptionReader& r) { r.unknown("a, b"); }, {}).find("expected one of a, b"), std::string::npos);
}
