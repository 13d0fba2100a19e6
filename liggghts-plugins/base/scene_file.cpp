// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a scene into words, and words into entries.
#include "base/scene_file.h"

#include "base/refusal.h"

#include <algorithm>
#include <cctype>

namespace eccentra::base {
namespace {

class SceneText {
 public:
  SceneText(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  [[noreturn]] void refuse_here(const std::string& found, const std::string& expected) const {
    refuse("{}, line {}: '{}' is not {}; expected an entry such as 'length 0.3;'", file_, line_, found, expected);
  }

  /// The next word; "" at the end. Quotes, braces and semicolons are words of their own.
  std::string next() {
    pass_over_blanks();
    if (at_ == text_.size())
      return "";
    if (text_[at_] == '"')
      return quoted();
    if (std::string(";{}").find(text_[at_]) != std::string::npos)
      return std::string(1, text_[at_++]);
    const std::size_t begin = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])) &&
           std::string(";{}\"").find(text_[at_]) == std::string::npos)
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

 private:
  void pass_over_blanks() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_]))) {
        line_ += text_[at_++] == '\n';
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string::npos)
          refuse_here("/*", "closed by */");
        line_ += static_cast<int>(std::count(text_.begin() + at_, text_.begin() + end, '\n'));
        at_ = end + 2;
      } else {
        return;
      }
    }
  }

  std::string quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    const std::string words = text_.substr(at_ + 1, end == std::string::npos ? end : end - at_ - 1);
    if (end == std::string::npos || words.find('\n') != std::string::npos)
      refuse_here(words.substr(0, words.find('\n')), "closed by a quote");
    at_ = end + 1;
    return '"' + words + '"';
  }

  const std::string& text_;
  const std::string& file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

bool is_name(const std::string& word) {
  return !word.empty() && !std::isdigit(static_cast<unsigned char>(word[0])) &&
         std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

void pass_over_header(SceneText& scene) {
  if (scene.next() != "{")
    scene.refuse_here("FoamFile", "followed by { ... }");
  for (std::string word = scene.next(); word != "}"; word = scene.next())
    if (word.empty())
      scene.refuse_here("FoamFile", "closed by }");
}

} // namespace

std::vector<SceneEntry> read_scene(const std::string& text, const std::string& file) {
  SceneText scene(text, file);
  std::vector<SceneEntry> entries;
  for (std::string name = scene.next(); !name.empty(); name = scene.next()) {
    if (name == "FoamFile") {
      pass_over_header(scene);
      continue;
    }
    if (!is_name(name))
      scene.refuse_here(name, "a name of letters, digits and _");
    std::string value = scene.next();
    if (value.empty() || std::string("({[$#;}").find(value[0]) != std::string::npos)
      scene.refuse_here(value, "the value of '" + name + "'");
    if (const std::string end = scene.next(); end != ";")
      scene.refuse_here(end, "the semicolon after the value of '" + name + "'");
    if (std::any_of(entries.begin(), entries.end(), [&name](const SceneEntry& e) { return e.first == name; }))
      scene.refuse_here(name, "new: it stands above already");
    if (value[0] == '"')
      value = value.substr(1, value.size() - 2);
    entries.emplace_back(name, value);
  }
  return entries;
}

} // namespace eccentra::base
