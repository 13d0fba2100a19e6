// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Packs and unpacks touches.
#include "styles/pairs/fix_cluster_history.h"

#include "styles/bodies/restart_version.h"
#include "styles/entry/style_registry.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "modify.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {
const RegisterFix<FixClusterHistory> registered(FixClusterHistory::style_name,
                                                "history of cluster contacts (made by itself, never typed)");
// A record: how many touches, how many doubles in all they take, and those.
constexpr int head_words = 2, words_per_touch = 5;
} // namespace

FixClusterHistory::FixClusterHistory(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  restart_peratom = 1;
  restart_global = 1; // write_restart comes before the atoms are packed
  create_attribute = 1;
  scalar_flag = vector_flag = 1;
  size_vector = 1;
  extscalar = extvector = 1;
  global_freq = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixClusterHistory::~FixClusterHistory() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

FixClusterHistory* FixClusterHistory::find(LAMMPS* lmp) {
  return static_cast<FixClusterHistory*>(lmp->modify->find_fix_style_strict(style_name, 0));
}

FixClusterHistory& FixClusterHistory::require(LAMMPS* lmp) {
  if (FixClusterHistory* there = find(lmp))
    return *there;
  std::string arguments[] = {fix_id, "all", style_name};
  char* arg[] = {arguments[0].data(), arguments[1].data(), arguments[2].data()};
  lmp->modify->add_fix(3, arg);
  return *find(lmp);
}

void FixClusterHistory::post_create() {
  just_created = 0;
}

int FixClusterHistory::setmask() {
  return FixConst::PRE_EXCHANGE;
}

void FixClusterHistory::setup_pre_exchange() {
  pre_exchange();
}

void FixClusterHistory::pre_exchange() {
  if (hand_over)
    hand_over(false);
  // Room in the buffers of migration, for what walls keep as well.
  int most = largest_record();
  for (int n = 0; n < modify->nfix; ++n)
    if (std::strcmp(modify->fix[n]->style, FixWallGranCluster::inner_style) == 0)
      most += static_cast<FixWallGranCluster*>(modify->fix[n])->largest_record();
  comm->maxexchange_fix = std::max(comm->maxexchange_fix, most);
}

void FixClusterHistory::post_run() {
  if (hand_over)
    hand_over(false);
}

void FixClusterHistory::write_restart(FILE* fp) {
  if (hand_over)
    hand_over(true);
  if (comm->me != 0)
    return;
  const int size = sizeof(int), mark = restart_mark;
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(&mark, sizeof(int), 1, fp);
}

void FixClusterHistory::restart(char* buf) {
  int mark = 0;
  std::memcpy(&mark, buf, sizeof mark);
  if (const std::string problem = restart_problem(mark, "contacts of clusters"); !problem.empty())
    error->all(FLERR, problem.c_str());
}

void FixClusterHistory::grow_arrays(int nmax) {
  touches_.resize(nmax);
  more_.resize(nmax);
}

void FixClusterHistory::copy_arrays(int i, int j, int) {
  touches_[j] = touches_[i];
  more_[j] = more_[i];
}

void FixClusterHistory::set_arrays(int i) {
  touches_[i].clear();
  more_[i].clear();
}

int FixClusterHistory::pack_exchange(int i, double* buf) {
  int m = 0;
  buf[m++] = static_cast<double>(touches_[i].size());
  buf[m++] = static_cast<double>(words_per_touch * touches_[i].size() + more_[i].size());
  for (const Touch& touch : touches_[i]) {
    buf[m++] = touch.partner;
    buf[m++] = touch.id;
    for (double s : touch.displacement)
      buf[m++] = s;
  }
  for (const double value : more_[i])
    buf[m++] = value;
  return m;
}

int FixClusterHistory::unpack_exchange(int i, double* buf) {
  int m = 0;
  touches_[i].resize(static_cast<std::size_t>(buf[m++]));
  more_[i].resize(static_cast<std::size_t>(buf[m++]) - words_per_touch * touches_[i].size());
  for (Touch& touch : touches_[i]) {
    touch.partner = static_cast<int>(buf[m++]);
    touch.id = static_cast<int>(buf[m++]);
    for (double& s : touch.displacement)
      s = buf[m++];
  }
  for (double& value : more_[i])
    value = buf[m++];
  return m;
}

int FixClusterHistory::pack_restart(int i, double* buf) {
  buf[0] = size_restart(i);
  return 1 + pack_exchange(i, buf + 1);
}

void FixClusterHistory::unpack_restart(int i, int nth) {
  double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k)
    m += static_cast<int>(extra[m]);
  // The record's length, then the number of touches and of their doubles, which must fill it.
  const double count = extra[m] < 1 + head_words ? -1 : extra[m + 1], words = count < 0 ? -1 : extra[m + 2];
  if (count < 0 || words < words_per_touch * count || extra[m] != 1 + head_words + words ||
      (count == 0 ? words != 0 : std::fmod(words, count) != 0))
    error->one(FLERR, damaged_restart("contacts of clusters").c_str());
  unpack_exchange(i, extra + m + 1);
}

int FixClusterHistory::size_restart(int i) {
  return 1 + head_words + words_per_touch * static_cast<int>(touches_[i].size()) + static_cast<int>(more_[i].size());
}

int FixClusterHistory::largest_record() {
  int most = 1 + head_words;
  for (int i = 0; i < atom->nlocal; ++i)
    most = std::max(most, size_restart(i));
  return most;
}

// LIGGGHTS writes the first rank's value into the file, and whoever reads it has rows of this length.
int FixClusterHistory::maxsize_restart() {
  int most = largest_record();
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}

double FixClusterHistory::compute_scalar() {
  int all = 0;
  MPI_Allreduce(&contact_count, &all, 1, MPI_INT, MPI_SUM, world);
  return all;
}

double FixClusterHistory::compute_vector(int) {
  int all = 0;
  MPI_Allreduce(&near_pair_count, &all, 1, MPI_INT, MPI_SUM, world);
  return all;
}

double FixClusterHistory::memory_usage() {
  double bytes = static_cast<double>(touches_.capacity() * sizeof(decltype(touches_)::value_type));
  for (const auto& list : touches_)
    bytes += static_cast<double>(list.capacity() * sizeof(Touch));
  bytes += static_cast<double>(more_.capacity() * sizeof(decltype(more_)::value_type));
  for (const auto& list : more_)
    bytes += static_cast<double>(list.capacity() * sizeof(double));
  return bytes;
}

} // namespace eccentra::styles
