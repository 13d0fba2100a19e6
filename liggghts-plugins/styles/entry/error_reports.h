// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// An error that LIGGGHTS raises on one rank reaches the terminal, the log and the other side of the link before the
// process ends: LIGGGHTS writes it to the screen of that rank, which may be a file or nothing at all.
#pragma once

#include <functional>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace eccentra::styles {

/// Notes the log's name on every rank and sees to it that nothing of the log is lost when the process ends early, by an
/// error, a crash or an exception. Collective; once per script file.
void watch_errors(LAMMPS_NS::LAMMPS* lmp);

/// Names the program that hosts LIGGGHTS, for the sentence on its terminal.
void name_hosting_program(const std::string& program);

/// True if an error of LIGGGHTS has been written to the terminal by this process.
bool error_was_shown();

/// While one of these lives, its function gets the sentence of an error before the process ends, on the rank that
/// raises it (an error of all ranks: on rank 0).
class LastWords {
 public:
  explicit LastWords(std::function<void(const std::string&)> hear);
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
  ~LastWords();

 private:
  std::function<void(const std::string&)> hear_;
  friend void tell_last_words(const std::string& sentence);
};

} // namespace eccentra::styles
