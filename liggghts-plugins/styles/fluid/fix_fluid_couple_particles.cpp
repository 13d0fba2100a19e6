// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Says which particles have come or gone, or lie where the fluid side says, and prints what that side has to say.
#include "styles/fluid/fix_fluid_couple.h"

#include "styles/entry/host_terminal.h"

#include <mpi.h>

#include "atom.h"
#include "comm.h"
#include "lammps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace eccentra::styles {

namespace {

/// The same list on all ranks, of what each has.
template <class Value> std::vector<Value> all_of(const std::vector<Value>& mine, MPI_Datatype type, MPI_Comm world) {
  int size = 1, count = static_cast<int>(mine.size());
  MPI_Comm_size(world, &size);
  std::vector<int> counts(size), begins(size);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int r = 1; r < size; ++r)
    begins[r] = begins[r - 1] + counts[r - 1];
  std::vector<Value> all(begins.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), begins.data(), type, world);
  return all;
}

/// Who is in `some` and not in `others`: "2 particles WHAT: particle 7 WHERE (x y z) m, ..."; empty if nobody is.
/// Collective.
std::string missing(const PackedParticles& some, const PackedParticles& others, const std::string& what,
                    const std::string& where, MPI_Comm world) {
  constexpr std::size_t kNamed = 5;
  // Who has only changed rank is present elsewhere: all tags come together.
  std::vector<int> known = all_of(others.tags, MPI_INT, world);
  std::sort(known.begin(), known.end());
  std::vector<double> rows; // tag and place
  for (std::size_t i = 0; i < some.tags.size(); ++i)
    if (!std::binary_search(known.begin(), known.end(), some.tags[i])) {
      rows.push_back(some.tags[i]);
      rows.insert(rows.end(), some.position.begin() + 3 * i, some.position.begin() + 3 * i + 3);
    }
  rows = all_of(rows, MPI_DOUBLE, world);
  const std::size_t found = rows.size() / 4;
  if (found == 0)
    return "";
  std::string text = std::to_string(found) + (found > 1 ? " particles have " : " particle has ") + what + ":";
  char one[160];
  for (std::size_t i = 0; i < std::min(found, kNamed); ++i) {
    const double* const row = rows.data() + 4 * i;
    std::snprintf(one, sizeof one, "%s particle %d%s (%.6g %.6g %.6g) m", i ? "," : "", int(row[0]), where.c_str(),
                  row[1], row[2], row[3]);
    text += one;
  }
  return text + (found > kNamed ? ", ..." : "");
}

} // namespace

void FixFluidCouple::announce(const std::string& news) const {
  if (news.empty())
    return;
  const std::string text = with_ids(news);
  if (comm->me != 0)
    return;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = "fix fluid/couple '" + std::string(id) + "': " + text.substr(begin, end - begin) + "\n";
    for (FILE* out : {screen, logfile, host_terminal()})
      if (out)
        std::fputs(line.c_str(), out);
    std::fflush(stdout);
    begin = end + 1;
  }
}

std::string FixFluidCouple::with_ids(std::string text) const {
  const std::string mark = link::kParticleAt;
  for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += mark.size()) {
    double x[3];
    if (std::sscanf(text.c_str() + at + mark.size(), "%lf %lf %lf", &x[0], &x[1], &x[2]) != 3)
      continue;
    struct {
      double distance = std::numeric_limits<double>::max();
      int tag = 0;
    } nearest;
    for (int i = 0; i < atom->nlocal && std::size_t(i) < packed_.tags.size(); ++i) {
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        sum += std::pow(packed_.position[3 * std::size_t(i) + k] - x[k], 2);
      if (sum < nearest.distance)
        nearest = {sum, packed_.tags[i]};
    }
    MPI_Allreduce(MPI_IN_PLACE, &nearest, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
    text.insert(at + std::strlen("particle "), std::to_string(nearest.tag) + " ");
  }
  return text;
}

std::string FixFluidCouple::departures(const link::DemTotals& now) {
  const std::int64_t staying = now.particles - now.inserted;
  const bool any = staying_ > staying;
  staying_ = staying;
  return any && !told_of_departure_
             ? missing(before_, packed_, "left the simulation box since the last coupling step", ", last at", world)
             : "";
}

std::string FixFluidCouple::changes() const {
  // With overlap the fluid advances with the particles of the coupling step before.
  const PackedParticles& past = overlap_ ? earlier_ : before_;
  const std::string since = overlap_ ? " since the last coupling step but one" : " since the last coupling step";
  if (all_of(past.tags, MPI_INT, world).empty())
    return "";
  const std::string left = missing(past, packed_, "left the simulation box" + since, ", last at", world);
  const std::string come = missing(packed_, past, "come into the simulation box" + since, " at", world);
  return left + (left.empty() || come.empty() ? "" : "; ") + come;
}

} // namespace eccentra::styles
