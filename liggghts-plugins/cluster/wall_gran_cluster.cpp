// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix wall/gran/cluster: lists, forces, output and transport of history.
#include "cluster/wall_gran_cluster.h"

#include "cluster/bodies.h"
#include "cluster/impact_mass.h"
#include "cluster/restart_version.h"
#include "cluster/shared_contacts.h"
#include "cluster/sleep_cluster.h"
#include "cluster/wall_gaps.h"
#include "host/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "property_registry.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace eccentra::cluster {

using namespace LAMMPS_NS;

namespace {

const host::RegisterFix<FixWallGranCluster> record("wall/gran/cluster",
                                                   "walls for clusters and plain spheres: planes, cylinders, meshes");

Eigen::Vector3d vector3(const double* v) {
  return {v[0], v[1], v[2]};
}

Eigen::Matrix3d row_major(const double* m) {
  return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(m);
}

void add(double* sum, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k)
    sum[k] += v[k];
}

} // namespace

FixWallGranCluster::FixWallGranCluster(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  delete[] style;
  style = new char[std::strlen(inner_style) + 1];
  std::strcpy(style, inner_style);

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fail("needs atoms with radius, mass and rotation: use 'atom_style granular'");
  try {
    words_ = read_wall_words({arg + 3, arg + narg});
    smallest_type_ = largest_type_ = words_.type;
    if (!words_.meshes.empty()) {
      if (words_.meshes.size() > WallContactKey::kMaxMeshes)
        throw std::invalid_argument("n_meshes " + std::to_string(words_.meshes.size()) + " exceeds " +
                                    std::to_string(WallContactKey::kMaxMeshes) +
                                    " meshes: share them out to more fixes");
      meshes_ = std::make_unique<WallMeshes>(lmp, words_.meshes);
      meshes_->find();
      smallest_type_ = meshes_->smallest_type();
      largest_type_ = meshes_->largest_type();
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

  block_ = std::make_unique<ContactBlock>();
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
    try {
      words_.rolling->init(lmp);
    } catch (const std::invalid_argument& problem) {
      fail(problem.what());
    }
  if (meshes_)
    try {
      meshes_->find();
    } catch (const std::invalid_argument& problem) {
      fail(problem.what());
    }
  bodies_ = FixBodies::find(lmp);
  sleep_ = stands_still() ? FixSleepCluster::find(lmp) : nullptr;
  if (bodies_)
    for (int id = 0; id < bodies_->shapes().size(); ++id)
      if (bodies_->shapes().surface(id).count > WallContactKey::kMaxSubSpheres)
        fail("shape '" + bodies_->shapes()[id].name() + "' has more than " +
             std::to_string(WallContactKey::kMaxSubSpheres) + " surface sub-spheres: use fewer");
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
  if (meshes_) {
    meshes_->invert_neighbour_lists(groupbit, near_);
  } else {
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) &&
          words_.surface->distance(vector3(atom->x[i])) <= atom->radius[i] + neighbor->skin)
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
    (words_.surface && moves_like_sphere(i) ? near_spheres_ : near_clusters_).push_back(i);
  resting_.clear();
  asleep_.clear();
  near_list_stale_ = false;
}

bool FixWallGranCluster::is_plain_sphere(int i) const {
  return !bodies_ || bodies_->shape_id(i) == FixBodies::plain_sphere;
}

// Rolling models act on plain spheres alone.
bool FixWallGranCluster::moves_like_sphere(int i) const {
  return is_plain_sphere(i) || (!words_.rolling && bodies_->is_round(i));
}

void FixWallGranCluster::find_touches(int i) {
  if (meshes_)
    collect_mesh(i);
  else
    collect_primitive(i);
}

void FixWallGranCluster::collect(int i) {
  const std::size_t first = touches_.size();
  find_touches(i);
  if (touches_.size() == first) {
    history_[i].clear();
    return;
  }
  renew_history(i, first);
  if (words_.shared)
    share_damping(i, first);
}

void FixWallGranCluster::renew_history(int i, std::size_t first) {
  WallHistory::Entries& entries = history_[i];
  // As a rule the contacts are those of the last step.
  bool same = entries.size() == touches_.size() - first;
  for (std::size_t m = first; same && m < touches_.size(); ++m)
    same = entries[m - first].key == touches_[m].key;
  if (!same) {
    next_history_.clear();
    for (std::size_t m = first; m < touches_.size(); ++m)
      next_history_.push_back(old_entry(i, touches_[m]));
    entries.swap(next_history_);
  }
  for (std::size_t m = first; m < touches_.size(); ++m)
    touches_[m].history = &entries[m - first];
}

// On a plane, or with one contact, all weights of SharedStiffness and ImpactMass are 1: the same formulas, much
// shorter.
template <class Stiffness>
bool FixWallGranCluster::share_damping_of_one_normal(int i, std::size_t first, const Stiffness& stiffness) {
  const Eigen::Vector3d n = touches_[first].normal;
  for (std::size_t m = first + 1; m < touches_.size(); ++m)
    if (touches_[m].normal != n)
      return false;
  double sum = 0, force = 0, work = 0;
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();
  for (std::size_t m = first; m < touches_.size(); ++m) {
    const WallTouch& touch = touches_[m];
    const double s = stiffness(touch);
    sum += s;
    force += s * touch.overlap;
    work += s * touch.overlap * touch.overlap;
    arm += s * touch.lever;
  }
  double lever = 1;
  if (!is_plain_sphere(i)) {
    const Eigen::Vector3d turn = row_major(bodies_->rotation(i)).transpose() * (arm / sum).cross(n);
    const Eigen::Vector3d& inertia = bodies_->shapes()[bodies_->shape_id(i)].inertia_per_mass();
    lever = 1 / std::sqrt(1 + turn.cwiseAbs2().dot(inertia.cwiseInverse()));
  }
  const double common = touches_.size() > first + 1 ? force / sum / std::sqrt(work) : 0;
  for (std::size_t m = first; m < touches_.size(); ++m)
    touches_[m].share = (common > 0 ? std::min(1., common * std::sqrt(stiffness(touches_[m]))) : 1) * lever;
  return true;
}

void FixWallGranCluster::share_damping(int i, std::size_t first) {
  if (touches_.size() == first)
    return;
  const bool plain = is_plain_sphere(i);
  if (plain && touches_.size() == first + 1)
    return;
  // Within one fix the particle's material is one; walls of several materials weigh by their modulus.
  const auto stiffness = [&](const WallTouch& touch) {
    return youngs_[atom->type[i]][touch.wall_type] * std::sqrt(touch.radius * touch.overlap);
  };
  if (share_damping_of_one_normal(i, first, stiffness))
    return;
  SharedStiffness all;
  ImpactMass impact;
  for (std::size_t m = first; m < touches_.size(); ++m) {
    const Eigen::Vector3d& n = touches_[m].normal;
    all.add(stiffness(touches_[m]), touches_[m].overlap, n.x(), n.y(), n.z());
    impact.add(stiffness(touches_[m]), n, touches_[m].lever);
  }
  Eigen::Matrix3d inverse_inertia = Eigen::Matrix3d::Zero(); // per unit mass; spheres are always hit in the centre
  if (!plain) {
    const Eigen::Matrix3d rotation = row_major(bodies_->rotation(i));
    inverse_inertia = rotation *
                      bodies_->shapes()[bodies_->shape_id(i)].inertia_per_mass().cwiseInverse().asDiagonal() *
                      rotation.transpose();
  }
  for (std::size_t m = first; m < touches_.size(); ++m) {
    const Eigen::Vector3d& n = touches_[m].normal;
    touches_[m].share =
        all.damping_share(stiffness(touches_[m]), n.x(), n.y(), n.z()) * std::sqrt(impact.ratio(n, inverse_inertia));
  }
}

void FixWallGranCluster::collect_primitive(int i) {
  const WallSurface& surface = *words_.surface;
  const Eigen::Vector3d x = vector3(atom->x[i]);
  const auto touch = [&](int sub, const Eigen::Vector3d& arm, double radius, const WallPoint& point) {
    const double overlap = radius - point.distance;
    const Eigen::Vector3d to_wall = arm - point.distance * point.normal;
    touches_.push_back({i, nullptr, WallContactKey(sub, 0, 0), point.normal,
                        arm - (radius - 0.5 * overlap) * point.normal, to_wall, surface.velocity_at(x + to_wall),
                        surface.angular_velocity(), overlap, radius, 1.0, words_.type, -1});
  };
  if (is_plain_sphere(i)) {
    const WallPoint point = surface.nearest(x);
    if (point.distance < atom->radius[i])
      touch(0, Eigen::Vector3d::Zero(), atom->radius[i], point);
    return;
  }
  if (surface.distance(x) >= atom->radius[i]) // of the bounding sphere
    return;
  const SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
  const Eigen::Matrix3d rotation = row_major(bodies_->rotation(i));
  gaps_.resize(spheres.count);
  wall_gaps(surface, x, rotation, spheres, gaps_.data());
  for (int k = 0; k < spheres.count; ++k)
    if (gaps_[k] < 0.0) {
      const Eigen::Vector3d arm = rotation * Eigen::Vector3d(spheres.x[k], spheres.y[k], spheres.z[k]);
      touch(k, arm, spheres.r[k], surface.nearest(x + arm));
    }
}

void FixWallGranCluster::collect_mesh(int i) {
  const Eigen::Vector3d x = vector3(atom->x[i]);
  if (is_plain_sphere(i)) {
    meshes_->for_each_near(i, [&](int mesh, int triangle) {
      meshes_->touch(mesh, triangle, i, 0, x, Eigen::Vector3d::Zero(), atom->radius[i], touches_);
    });
    return;
  }
  const SurfaceSpheres& spheres = bodies_->shapes().surface(bodies_->shape_id(i));
  const Eigen::Matrix3d rotation = row_major(bodies_->rotation(i));
  gaps_.resize(spheres.count);
  meshes_->for_each_near(i, [&](int mesh, int triangle) {
    const WallSurface plane = meshes_->plane(mesh, triangle);
    if (plane.distance(x) >= atom->radius[i]) // of the bounding sphere
      return;
    wall_gaps(plane, x, rotation, spheres, gaps_.data());
    for (int k = 0; k < spheres.count; ++k)
      if (gaps_[k] < 0.0)
        meshes_->touch(mesh, triangle, i, k, x, rotation * Eigen::Vector3d(spheres.x[k], spheres.y[k], spheres.z[k]),
                       spheres.r[k], touches_);
  });
}

WallHistoryEntry FixWallGranCluster::old_entry(int i, const WallTouch& touch) const {
  const WallHistory::Entries& entries = history_[i];
  for (const WallHistoryEntry& old : entries)
    if (old.key == touch.key)
      return old;
  if (meshes_)
    for (const WallHistoryEntry& old : entries)
      if (old.key.sub() == touch.key.sub() && old.key.mesh() == touch.key.mesh() &&
          meshes_->coplanar(touch.key.mesh(), old.key.triangle(), touch.key.triangle()))
        return {touch.key, old.shear, old.rolling};
  return {touch.key, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

// The wall is body B of the contact law: its velocity is that at the contact point, so its spin adds nothing.
void FixWallGranCluster::fill(int m, const WallTouch& touch) {
  ContactBlock& block = *block_;
  const int i = touch.atom;
  const int type = atom->type[i];
  const Eigen::Vector3d to_centre = touch.lever + (touch.radius - 0.5 * touch.overlap) * touch.normal;
  const Eigen::Vector3d& shear = touch.history->shear;
  for (int k = 0; k < 3; ++k) {
    block.normal[k][m] = touch.normal[k];
    block.arm[k][m] = to_centre[k];
    block.velocity[k][m] = atom->v[i][k] - touch.wall_velocity[k];
    block.spin[k][m] = atom->omega[i][k];
    block.history[k][m] = shear[k];
  }
  block.radius_a[m] = touch.radius;
  block.overlap[m] = touch.overlap;
  block.contact_radius[m] = std::sqrt(touch.radius * touch.overlap);
  block.mass[m] = atom->rmass[i];
  block.youngs[m] = youngs_[type][touch.wall_type];
  block.shear_modulus[m] = shear_[type][touch.wall_type];
  block.damping[m] = -damping_[type][touch.wall_type];
  block.friction[m] = friction_[type][touch.wall_type];
  block.share[m] = touch.share;
}

Eigen::Vector3d FixWallGranCluster::rolling_torque(int m, int i, int wall_type, const Eigen::Vector3d& wall_spin,
                                                   WallHistoryEntry& entry) {
  const ContactBlock& block = *block_;
  const Eigen::Vector3d normal(block.normal[0][m], block.normal[1][m], block.normal[2][m]);
  const Eigen::Vector3d force(block.force[0][m], block.force[1][m], block.force[2][m]);
  const double kn = 4. / 3. * block.youngs[m] * block.contact_radius[m];
  const double kt = 8 * block.shear_modulus[m] * block.contact_radius[m];
  // Dashpots as contact_forces has them.
  const bool stock = words_.damping == DampingLaw::stock;
  const double factor = (stock ? 2 * std::sqrt(5. / 6.) : 2.) * block.damping[m] * block.share[m];
  const double gamma_n = factor * std::sqrt((stock ? 1.5 : 1.) * kn * block.mass[m]);
  const double gamma_t = factor * std::sqrt((stock ? 1. : 2. / 7.) * kt * block.mass[m]);
  return words_.rolling->torque({i, atom->type[i], wall_type, block.mass[m], kn, kn * block.overlap[m],
                                 block.radius_a[m], normal, vector3(atom->omega[i]) - wall_spin, wall_spin,
                                 entry.rolling.data(), !update->setupflag, force.dot(normal), kt, gamma_n,
                                 words_.tangential_damping ? gamma_t : 0.0});
}

void FixWallGranCluster::scatter(int m, const WallTouch& touch) {
  const ContactBlock& block = *block_;
  const int i = touch.atom;
  const auto row = [m](const ContactBlock::Row* rows) { return Eigen::Vector3d(rows[0][m], rows[1][m], rows[2][m]); };
  touch.history->shear = row(block.history);
  const Eigen::Vector3d force = row(block.force);
  Eigen::Vector3d torque = row(block.torque);
  if (words_.rolling && is_plain_sphere(i))
    torque += rolling_torque(m, i, touch.wall_type, touch.wall_omega, *touch.history);
  add(atom->f[i], force);
  add(atom->torque[i], torque);
  Eigen::Vector3d from_reference = vector3(atom->x[i]);
  if (words_.surface)
    from_reference -= words_.surface->reference();
  add(&local_sums_[0], -force);
  add(&local_sums_[3], -(from_reference.cross(force) + torque));
  local_sums_[6] += 1.0;
  if (meshes_)
    meshes_->report(touch, force);
}

void FixWallGranCluster::evaluate(int n, bool advance) {
  // Whole vectors, so that rounding does not depend on a contact's place; what is left from before does no harm there.
  constexpr int width = 8;
  const int padded = (n + width - 1) / width * width;
  const auto forces = [&](auto contact_forces_of_choice) {
    contact_forces_of_choice(*block_, padded, update->dt, advance);
  };
  if (words_.damping == DampingLaw::stock && words_.tangential_damping)
    forces(contact_forces<DampingLaw::stock, true, ContactBlock>);
  else if (words_.damping == DampingLaw::stock)
    forces(contact_forces<DampingLaw::stock, false, ContactBlock>);
  else if (words_.tangential_damping)
    forces(contact_forces<DampingLaw::paper, true, ContactBlock>);
  else
    forces(contact_forces<DampingLaw::paper, false, ContactBlock>);
}

void FixWallGranCluster::add_forces() {
  const bool advance = !update->setupflag;
  const int all = static_cast<int>(touches_.size());
  for (int first = 0; first < all; first += ContactBlock::capacity) {
    const int n = std::min(all - first, static_cast<int>(ContactBlock::capacity));
    for (int m = 0; m < n; ++m)
      fill(m, touches_[first + m]);
    evaluate(n, advance);
    for (int m = 0; m < n; ++m)
      scatter(m, touches_[first + m]);
  }
  touches_.clear();
}

void FixWallGranCluster::post_force(int) {
  if (near_list_stale_)
    rebuild_near_list();
  local_sums_.fill(0.0);
  summed_at_ = -1;
  if (sleep_)
    rest();
  near_forces();
}

void FixWallGranCluster::near_forces() {
  if (!near_spheres_.empty())
    sphere_forces();
  touches_.clear();
  if (words_.surface && !near_clusters_.empty())
    cluster_forces();
  else
    for (const int i : near_clusters_) {
      collect(i);
      if (touches_.size() >= kBatch)
        add_forces();
    }
  add_forces();
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

} // namespace eccentra::cluster
