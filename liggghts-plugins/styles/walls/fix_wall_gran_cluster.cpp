// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: set-up, lists, output and transport of history.
#include "styles/walls/fix_wall_gran_cluster.h"

#include "base/eigen_views.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/bodies/fix_sleep_cluster.h"
#include "styles/bodies/restart_version.h"
#include "styles/bodies/unread_properties.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <cstring>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

const RegisterFix<FixWallGranCluster> registered("wall/gran/cluster",
                                                 "walls for clusters and plain spheres: planes, cylinders, meshes");

} // namespace

FixWallGranCluster::FixWallGranCluster(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  delete[] style;
  style = new char[std::strlen(inner_style) + 1];
  std::strcpy(style, inner_style);

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fail("needs atoms with radius, mass and rotation: use 'atom_style granular'");
  try {
    arguments_ = read_wall_arguments({arg + 3, arg + narg});
    smallest_type_ = largest_type_ = arguments_.type;
    if (!arguments_.meshes.empty()) {
      if (arguments_.meshes.size() > contact::WallContactKey::kMaxMeshes)
        throw std::invalid_argument("n_meshes " + std::to_string(arguments_.meshes.size()) + " exceeds " +
                                    std::to_string(contact::WallContactKey::kMaxMeshes) +
                                    " meshes: share them out to more fixes");
      meshes_ = std::make_unique<WallMeshes>(lmp, arguments_.meshes);
      meshes_->find();
      smallest_type_ = meshes_->smallest_type();
      largest_type_ = meshes_->largest_type();
    }
    if (!arguments_.in_blocks) {
      stock_ = std::make_unique<StockContact>(lmp, true);
      stock_->choose(arguments_.names, arguments_.options);
      stock_->set_tangential(arguments_.synchronised, arguments_.friction);
    }
  } catch (const std::invalid_argument& problem) {
    fail(problem.what());
  }
  if (largest_type_ > atom->ntypes)
    fail("type " + std::to_string(largest_type_) + " exceeds the " + std::to_string(atom->ntypes) +
         " atom types of create_box: make room for the wall's material there");

  scalar_flag = 1;
  extscalar = 1;
  vector_flag = 1;
  size_vector = 6;
  extvector = 1;
  global_freq = 1;
  restart_peratom = 1;
  restart_global = 1;
  create_attribute = 1;
  time_depend = 0;

  block_ = std::make_unique<contact::ContactBlock>();
  group_of_.resize(contact::ContactBlock::capacity);
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixWallGranCluster::~FixWallGranCluster() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

void FixWallGranCluster::fail(const std::string& sentence) {
  error->all(FLERR, ("fix " + std::string(id) + " wall/gran/cluster: " + sentence).c_str());
  throw std::logic_error("unreachable: error->all ends the process");
}

int FixWallGranCluster::setmask() {
  return FixConst::PRE_NEIGHBOR | FixConst::POST_FORCE;
}

int FixWallGranCluster::min_type() {
  return smallest_type_;
}
int FixWallGranCluster::max_type() {
  return largest_type_;
}

void FixWallGranCluster::post_create() {
  just_created = 0; // else Modify::setup wipes the history that a restart file has brought
  if (meshes_)
    meshes_->create_neighbour_lists(groupbit);
}

void FixWallGranCluster::pre_delete(bool unfix) {
  if (unfix && meshes_)
    meshes_->delete_neighbour_lists();
}

void FixWallGranCluster::init() {
  if (std::strcmp(update->integrate_style, "verlet") != 0)
    fail("works with run_style verlet only, not '" + std::string(update->integrate_style) + "'");
  reach_ = 1;
  if (stock_) {
    stock_->connect();
    reach_ = stock_->reach();
    if (reach_ > 1 && meshes_)
      fail(
          "cohesion '" + stock_->names().cohesion +
          "' reaches across a gap and is offered at primitive walls alone; expected a primitive wall, or cohesion off");
  } else {
    model_ = contact::find_contact_model(arguments_.names.normal);
    materials_.connect(lmp, *model_, arguments_.tangential, "wall/gran/cluster");
  }
  if (arguments_.rolling)
    try {
      arguments_.rolling->init(lmp);
    } catch (const std::invalid_argument& problem) {
      fail(problem.what());
    }
  if (meshes_)
    try {
      meshes_->find();
    } catch (const std::invalid_argument& problem) {
      fail(problem.what());
    }
  bodies_ = FixClusterBodies::find(lmp);
  refuse_rolling_of_clusters_alone();
  all_records_ = &contact_records(lmp);
  sleep_ = stands_still() ? FixSleepCluster::find(lmp) : nullptr;
  if (bodies_)
    for (int id = 0; id < bodies_->shapes().size(); ++id)
      if (bodies_->shapes().surface(id).count > contact::WallContactKey::kMaxSubSpheres)
        fail("shape '" + bodies_->shapes()[id].name() + "' has more than " +
             std::to_string(contact::WallContactKey::kMaxSubSpheres) + " surface sub-spheres: use fewer");
  if (stock_ && bodies_)
    for (int id = 0; id < bodies_->shapes().size(); ++id)
      if (bodies_->shapes().surface(id).hull)
        fail("the rounded body '" + bodies_->shapes()[id].name() +
             "' has contacts of model hertz alone; expected model hertz, tangential history or off and cohesion off, "
             "or a "
             "cluster of spheres");
  near_list_stale_ = true;
}

/// A model that acts on plain spheres would do nothing in a scene that has none and awaits none.
void FixWallGranCluster::refuse_rolling_of_clusters_alone() {
  if (!arguments_.rolling || arguments_.rolling->for_clusters() || !bodies_ || bodies_->shapes().size() == 0)
    return;
  for (int f = 0; f < modify->nfix; ++f)
    if (std::strcmp(modify->fix[f]->style, "particletemplate/sphere") == 0)
      return;
  int spheres = 0;
  for (int i = 0; i < atom->nlocal && !spheres; ++i)
    spheres = is_plain_sphere(i);
  MPI_Allreduce(MPI_IN_PLACE, &spheres, 1, MPI_INT, MPI_MAX, world);
  if (!spheres)
    fail("rolling_friction '" + arguments_.rolling_model +
         "' acts on plain spheres, and the scene has clusters alone, which roll by their shape; expected "
         "rolling_friction off");
}

void FixWallGranCluster::setup(int vflag) {
  near_list_stale_ = true;
  name_unread_properties(lmp);
  post_force(vflag);
}

void FixWallGranCluster::pre_neighbor() {
  near_list_stale_ = true;
}

void FixWallGranCluster::rebuild_near_list() {
  near_.clear();
  if (meshes_) {
    meshes_->invert_neighbour_lists(groupbit, near_);
  } else {
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) &&
          arguments_.surface->distance(base::vector3(atom->x[i])) <= reach_ * atom->radius[i] + neighbor->skin)
        near_.push_back(i);
  }
  std::size_t next = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (next < near_.size() && near_[next] == i)
      ++next;
    else
      history_[i].clear();
  near_spheres_.clear();
  near_clusters_.clear();
  for (const int i : near_)
    (arguments_.surface && moves_like_sphere(i) ? near_spheres_ : near_clusters_).push_back(i);
  resting_.clear();
  asleep_.clear();
  near_list_stale_ = false;
}

void FixWallGranCluster::open_records() {
  records_ = all_records_->wanted(update->ntimestep) ? all_records_ : nullptr;
  if (records_ && sleep_)
    near_list_stale_ = true; // contacts of sleepers are written down, too
}

void FixWallGranCluster::post_force(int) {
  open_records();
  if (near_list_stale_)
    rebuild_near_list();
  local_sums_.fill(0.0);
  summed_at_ = -1;
  if (sleep_ && !records_)
    rest();
  near_forces();
}

double FixWallGranCluster::compute_vector(int n) {
  if (summed_at_ != update->ntimestep) {
    MPI_Allreduce(local_sums_.data(), global_sums_.data(), static_cast<int>(local_sums_.size()), MPI_DOUBLE, MPI_SUM,
                  world);
    summed_at_ = update->ntimestep;
  }
  return global_sums_[n];
}

double FixWallGranCluster::compute_scalar() {
  return compute_vector(6);
}

void FixWallGranCluster::grow_arrays(int nmax) {
  history_.grow(nmax);
}
void FixWallGranCluster::copy_arrays(int from, int to, int) {
  history_.move(from, to);
}
void FixWallGranCluster::set_arrays(int i) {
  history_[i].clear();
}
int FixWallGranCluster::pack_exchange(int i, double* buffer) {
  return history_.pack(i, buffer);
}
int FixWallGranCluster::unpack_exchange(int i, double* buffer) {
  return history_.unpack(i, buffer);
}

// Restart: the number of doubles comes first, as Atom::extra wants it.
int FixWallGranCluster::size_restart(int i) {
  return 1 + history_.packed_size(i);
}
int FixWallGranCluster::largest_record() const {
  return 1 + history_.largest();
}
// LIGGGHTS writes the first rank's value into the file, and whoever reads it has rows of this length.
int FixWallGranCluster::maxsize_restart() {
  int most = largest_record();
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, world);
  return most;
}
void FixWallGranCluster::write_restart(FILE* file) {
  if (comm->me != 0)
    return;
  const int size = sizeof(int), mark = restart_mark;
  fwrite(&size, sizeof(int), 1, file);
  fwrite(&mark, sizeof(int), 1, file);
}
void FixWallGranCluster::restart(char* state) {
  int mark = 0;
  std::memcpy(&mark, state, sizeof mark);
  if (const std::string problem = restart_problem(mark, "history"); !problem.empty())
    fail(problem);
}
int FixWallGranCluster::pack_restart(int i, double* buffer) {
  buffer[0] = size_restart(i);
  return 1 + history_.pack(i, buffer + 1);
}
void FixWallGranCluster::unpack_restart(int i, int nth) {
  const double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k)
    m += static_cast<int>(extra[m]);
  history_.unpack(i, extra + m + 1);
}

double FixWallGranCluster::memory_usage() {
  return history_.memory();
}

} // namespace eccentra::styles
