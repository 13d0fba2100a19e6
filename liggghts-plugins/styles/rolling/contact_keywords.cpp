// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Adds option arguments to the list that LIGGGHTS parses the arguments of a contact model with.
#include "styles/rolling/contact_keywords.h"

#include "base/option_reader.h"
#include "styles/entry/private_access.h"

#include "input.h"
#include "lammps.h"

#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>
#include <type_traits>

namespace eccentra::styles {
// Settings offers on/off, yes/no and numbers; its list of arguments has no other way in.
struct SettingsList {
  using type = std::map<std::string, Setting*> Settings::*;
};
template struct PrivateMember<SettingsList, &Settings::settings>;

namespace {

class OptionSetting : public Setting {
 public:
  OptionSetting(const std::string& model, const std::string& name, int& target,
                std::vector<std::pair<std::string, int>> options)
      : Setting(name, 1), model_(model), target_(target), options_(std::move(options)) {
    target_ = options_.front().second;
  }

  int parseArguments(char** args) override {
    if (name != args[0])
      return 0;
    std::string known;
    for (const auto& [word, value] : options_) {
      if (word == args[1]) {
        target_ = value;
        return 2;
      }
      known += (known.empty() ? "" : ", ") + word;
    }
    error_message = model_ + ": '" + name + " " + args[1] + "' is unknown: use one of " + known;
    return -1;
  }

  void print_value(FILE* out) override { std::fprintf(out, "%d", target_); }

 private:
  std::string model_;
  int& target_;
  std::vector<std::pair<std::string, int>> options_;
};

/// One value that OptionReader reads: a switch (bool) or a factor (double).
template <class Value> class ReadSetting : public Setting {
 public:
  ReadSetting(const std::string& model, const std::string& name, Value& target)
      : Setting(name, 1), model_(model), target_(target) {}

  int parseArguments(char** args) override {
    if (name != args[0])
      return 0;
    base::OptionReader reader({args[0], args[1]});
    reader.keyword();
    try {
      if constexpr (std::is_same_v<Value, bool>)
        target_ = reader.on_off();
      else
        target_ = reader.factor();
    } catch (const std::invalid_argument& problem) {
      error_message = model_ + ": " + problem.what();
      return -1;
    }
    return 2;
  }

  void print_value(FILE* out) override {
    if constexpr (std::is_same_v<Value, bool>)
      std::fprintf(out, "%s", target_ ? "on" : "off");
    else
      std::fprintf(out, "%g", target_);
  }

 private:
  std::string model_;
  Value& target_;
};

/// Reads the words of any family of shapes: they end where a keyword of the model begins, or the line of the script.
class ShapeSetting : public Setting {
 public:
  ShapeSetting(const LAMMPS_NS::LAMMPS& lmp, const std::map<std::string, Setting*>& keywords, const std::string& model,
               std::vector<std::string>& target)
      : Setting("shape", 2), lmp_(lmp), keywords_(keywords), model_(model), target_(target) {}

  int parseArguments(char** args) override {
    if (name != args[0])
      return 0;
    // Settings does not say where the arguments end; they are those of the present line of the script.
    char** const end = lmp_.input->arg + lmp_.input->narg;
    if (!std::less<>()(args, end) || std::less<>()(args, lmp_.input->arg)) {
      error_message = model_ + ": 'shape' does not come from the line of a script; expected pair_style in a script";
      return -1;
    }
    target_.clear();
    for (char** arg = args + 1; arg < end && !keywords_.count(*arg); ++arg)
      target_.emplace_back(*arg);
    if (target_.empty()) {
      error_message = model_ + ": nothing follows 'shape'; expected a shape, such as cube 64 or file NAME.clump";
      return -1;
    }
    return 1 + static_cast<int>(target_.size());
  }

  void print_value(FILE* out) override { std::fprintf(out, "%s", target_.empty() ? "none" : target_.front().c_str()); }

 private:
  const LAMMPS_NS::LAMMPS& lmp_;
  const std::map<std::string, Setting*>& keywords_;
  std::string model_;
  std::vector<std::string>& target_;
};

} // namespace

void register_shape_keywords(const LAMMPS_NS::LAMMPS& lmp, Settings& settings, const std::string& model,
                             std::vector<std::string>& target) {
  std::map<std::string, Setting*>& keywords = settings.*Published<SettingsList>::pointer;
  Setting*& entry = keywords["shape"];
  if (!entry)
    entry = new ShapeSetting(lmp, keywords, model, target);
}

void register_option(Settings& settings, const std::string& model, const std::string& name, int& target,
                     const std::vector<std::pair<std::string, int>>& options) {
  Setting*& entry = (settings.*Published<SettingsList>::pointer)[name];
  if (!entry)
    entry = new OptionSetting(model, name, target, options);
}

void register_switch(Settings& settings, const std::string& model, const std::string& name, bool& target) {
  Setting*& entry = (settings.*Published<SettingsList>::pointer)[name];
  if (!entry)
    entry = new ReadSetting(model, name, target);
}

void register_factor(Settings& settings, const std::string& model, const std::string& name, double& target) {
  Setting*& entry = (settings.*Published<SettingsList>::pointer)[name];
  if (!entry)
    entry = new ReadSetting(model, name, target);
}

} // namespace eccentra::styles
