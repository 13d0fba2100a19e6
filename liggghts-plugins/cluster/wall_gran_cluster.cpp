// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: lists, forces, output and transport of history.
#include "cluster/wall_gran_cluster.h"

#include "host/style_registry.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "property_registry.h"
#include "update.h"

#include <cstring>
#include <stdexcept>

namespace eccentra::cluster {

using namespace LAMMPS_NS;

namespace {

const host::RegisterFix<FixWallGranCluster> record("wall/gran/cluster",
                                                   "walls for clusters and plain spheres: planes, cylinders, meshes");

// Stock styles look walls up by the prefix "wall/gran" and cast what they find to their own class: under this name they
// do not find us.
constexpr const char* kInnerStyle = "cluster/wall/gran";

Eigen::Vector3d vector3(const double* v) {
  return {v[0], v[1], v[2]};
}

void add(double* sum, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k)
    sum[k] += v[k];
}

} // namespace

FixWallGranCluster::FixWallGranCluster(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  delete[] style;
  style = new char[std::strlen(kInnerStyle) + 1];
  std::strcpy(style, kInnerStyle);

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fail("needs atoms with radius, mass and rotation: use 'atom_style granular'");
  try {
    words_ = read_wall_words({arg + 3, arg + narg});
  } catch (const std::invalid_argument& problem) {
    fail(problem.what());
  }
  if (words_.surface && words_.type > atom->ntypes)
    fail("type " + std::to_string(words_.type) + " exceeds the " + std::to_string(atom->ntypes) +
         " atom types of create_box: give the wall's material there");

  scalar_flag = 1;
  extscalar = 1;
  vector_flag = 1;
  size_vector = 6;
  extvector = 1;
  global_freq = 1;
  restart_peratom = 1;
  create_attribute = 1;
  time_depend = 0;

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
  return words_.type;
}
int FixWallGranCluster::max_type() {
  return words_.type;
}

void FixWallGranCluster::init() {
  if (std::strcmp(update->integrate_style, "verlet") != 0)
    fail("works with run_style verlet only, not '" + std::string(update->integrate_style) + "'");
  const char* caller = "wall/gran/cluster";
  PropertyRegistry& registry = force->registry;
  registry.registerProperty("Yeff", &MODEL_PARAMS::createYeff);
  registry.registerProperty("Geff", &MODEL_PARAMS::createGeff);
  registry.registerProperty("betaeff", &MODEL_PARAMS::createBetaEff);
  registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
  registry.connect("Yeff", youngs_, caller);
  registry.connect("Geff", shear_, caller);
  registry.connect("betaeff", damping_, caller);
  registry.connect("coeffFrict", friction_, caller);
  if (words_.rolling)
    words_.rolling->init(lmp);
  near_list_stale_ = true;
}

void FixWallGranCluster::setup(int vflag) {
  near_list_stale_ = true;
  post_force(vflag);
}

void FixWallGranCluster::pre_neighbor() {
  near_list_stale_ = true;
}

void FixWallGranCluster::rebuild_near_list() {
  near_.clear();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit))
      continue;
    if (words_.surface->distance(vector3(atom->x[i])) <= atom->radius[i] + neighbor->skin)
      near_.push_back(i);
    else
      history_[i].clear();
  }
  near_list_stale_ = false;
}

void FixWallGranCluster::collect(int i) {
  contacts_.clear();
  const WallSurface& surface = *words_.surface;
  const Eigen::Vector3d x = vector3(atom->x[i]);
  const double radius = atom->radius[i];
  const WallPoint point = surface.nearest(x);
  if (point.distance >= radius)
    return;
  const double overlap = radius - point.distance;
  contacts_.push_back({WallContactKey(0, 0, 0), point.normal, -(radius - 0.5 * overlap) * point.normal,
                       surface.velocity_at(x - point.distance * point.normal), surface.angular_velocity(), overlap,
                       radius, 1.0, words_.type});
}

WallMaterial FixWallGranCluster::material(int particle_type, int wall_type) const {
  return {youngs_[particle_type][wall_type], shear_[particle_type][wall_type], damping_[particle_type][wall_type],
          friction_[particle_type][wall_type]};
}

void FixWallGranCluster::add_forces(int i) {
  const bool update_history = !update->setupflag;
  const Eigen::Vector3d velocity = vector3(atom->v[i]);
  const Eigen::Vector3d omega = vector3(atom->omega[i]);
  const Eigen::Vector3d from_reference =
      vector3(atom->x[i]) - (words_.surface ? words_.surface->reference() : Eigen::Vector3d::Zero());
  const int type = atom->type[i];
  WallHistory::Entries& old_history = history_[i];
  next_history_.clear();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (const Contact& c : contacts_) {
    WallHistoryEntry entry{c.key, Eigen::Vector3d::Zero()};
    for (const WallHistoryEntry& old : old_history)
      if (old.key == c.key) {
        entry.shear = old.shear;
        break;
      }
    const WallContact contact{
        c.normal, velocity + omega.cross(c.lever) - c.wall_velocity, c.overlap, c.radius, atom->rmass[i], c.share};
    const WallForce result = hertz_mindlin_wall(material(type, c.wall_type), contact, update->dt, update_history,
                                                words_.limit_force, words_.tangential_damping, entry.shear);
    next_history_.push_back(entry);
    force += result.force;
    Eigen::Vector3d moment = c.lever.cross(result.force);
    if (words_.rolling)
      moment += words_.rolling->torque(
          {i, type, c.wall_type, result.elastic_normal, c.radius, c.normal, omega - c.wall_omega});
    torque += moment;
  }
  old_history.swap(next_history_);
  add(atom->f[i], force);
  add(atom->torque[i], torque);
  add(&local_sums_[0], -force);
  add(&local_sums_[3], -(from_reference.cross(force) + torque));
  local_sums_[6] += static_cast<double>(contacts_.size());
}

void FixWallGranCluster::post_force(int) {
  if (near_list_stale_)
    rebuild_near_list();
  local_sums_.fill(0.0);
  summed_at_ = -1;
  for (const int i : near_) {
    collect(i);
    if (!contacts_.empty())
      add_forces(i);
    else
      history_[i].clear();
  }
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
int FixWallGranCluster::maxsize_restart() {
  return 1 + history_.largest();
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

} // namespace eccentra::cluster
