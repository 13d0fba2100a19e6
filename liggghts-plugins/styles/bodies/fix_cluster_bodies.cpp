// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Per-body data of clusters as a LIGGGHTS fix.
#include "styles/bodies/fix_cluster_bodies.h"

#include "shape/rounded_record.h"
#include "styles/bodies/body_checks.h"
#include "styles/bodies/restart_version.h"
#include "styles/bodies/unread_properties.h"
#include "styles/entry/style_registry.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

const RegisterFix<FixClusterBodies> registered(FixClusterBodies::style_name,
                                               "orientation and shape of clusters (made by itself, never typed)");

/// Appends plain values to the bytes that a restart file keeps.
class ByteWriter {
 public:
  template <class T> void put(const T& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    data.insert(data.end(), bytes, bytes + sizeof(T));
  }
  std::vector<char> data;
};

/// Takes them out again in the same order, and never more than there are.
class ByteReader {
 public:
  ByteReader(const char* data, std::size_t size) : data_(data), left_(size) {}
  /// Zero from the first value on that is no longer there; good() tells.
  template <class T> T get() {
    T value = {};
    if (!take(sizeof(T)))
      return value;
    std::memcpy(&value, data_ - sizeof(T), sizeof(T));
    return value;
  }
  /// A count of things of `bytes` each; 0 where there cannot be as many.
  int count(std::size_t bytes) {
    const int count = get<int>();
    good_ = good_ && count >= 0 && static_cast<std::size_t>(count) <= left_ / bytes;
    return good_ ? count : 0;
  }
  bool good() const { return good_; }
  bool at_end() const { return good_ && left_ == 0; }

 private:
  bool take(std::size_t bytes) {
    good_ = good_ && bytes <= left_;
    if (good_) {
      data_ += bytes;
      left_ -= bytes;
    }
    return good_;
  }

  const char* data_;
  std::size_t left_;
  bool good_ = true;
};

} // namespace

FixClusterBodies::FixClusterBodies(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  restart_peratom = 1;
  restart_global = 1;
  create_attribute = 1;
  peratom_flag = 1;
  size_peratom_cols = columns;
  peratom_freq = 1;
  comm_forward = 5;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
  for (int i = 0; i < atom->nlocal; ++i)
    set_arrays(i);
}

FixClusterBodies::~FixClusterBodies() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(data_);
}

FixClusterBodies* FixClusterBodies::find(LAMMPS* lmp) {
  return static_cast<FixClusterBodies*>(lmp->modify->find_fix_style_strict(style_name, 0));
}

FixClusterBodies& FixClusterBodies::require(LAMMPS* lmp) {
  if (FixClusterBodies* there = find(lmp))
    return *there;
  std::string arguments[] = {fix_id, "all", style_name};
  char* arg[] = {arguments[0].data(), arguments[1].data(), arguments[2].data()};
  lmp->modify->add_fix(3, arg);
  return *find(lmp);
}

// Modify::setup wipes the per-atom data of a fix that it takes for new.
void FixClusterBodies::post_create() {
  just_created = 0;
}

int FixClusterBodies::setmask() {
  return FixConst::PRE_FORCE;
}

double FixClusterBodies::extra_radius(int i) const {
  return shape_id(i) == plain_sphere ? atom->radius[i] : 0;
}

Eigen::Vector3d FixClusterBodies::inertia(int i) const {
  const int s = shape_id(i);
  if (s != plain_sphere)
    return atom->rmass[i] * shapes_[s].inertia_per_mass();
  constexpr double solid_sphere = 0.4;
  return Eigen::Vector3d::Constant(solid_sphere * atom->rmass[i] * atom->radius[i] * atom->radius[i]);
}

void FixClusterBodies::make_body(int i, int shape_id, double density, const double* q) {
  const shape::ClusterShape& shape = shapes_[shape_id];
  atom->radius[i] = shape.bounding_radius();
  atom->rmass[i] = density * shape.volume();
  atom->density[i] = density;
  std::copy(q, q + 4, quaternion(i));
  contact::normalise(quaternion(i));
  data_[i][shape_column] = shape_id;
  contact::rotation_matrix(quaternion(i), rotation(i));
  momentum_from_omega(i);
  new_bodies_ = true;
}

void FixClusterBodies::momentum_from_omega(int i) {
  contact::angular_momentum(rotation(i), inertia(i).data(), atom->omega[i], angular_momentum(i));
}

void FixClusterBodies::omega_from_momentum(int i) {
  const int s = shape_id(i);
  if (s != plain_sphere && shapes_.free_rotation(s).spherical()) {
    const double rate = shapes_.free_rotation(s).world_rate() / atom->rmass[i];
    for (int k = 0; k < 3; ++k)
      atom->omega[i][k] = rate * angular_momentum(i)[k];
    return;
  }
  contact::angular_velocity(rotation(i), inertia(i).data(), angular_momentum(i), atom->omega[i]);
}

void FixClusterBodies::setup_pre_force(int) {
  last_forces_.compare_fixes(*lmp);
  stepped_ = false;
  name_unread_properties(lmp);
  all_round_ = true;
  for (int id = 0; id < shapes_.size(); ++id)
    all_round_ = all_round_ && shapes_.surface(id).single_at_centre;
  send_shapes_ = true;
  bring_to_ghosts();
  update_rotations(0, atom->nlocal + atom->nghost);
}

void FixClusterBodies::pre_force(int) {
  send_shapes_ = neighbor->ago == 0;
  if (send_shapes_ && new_bodies_) {
    check_new_bodies(lmp, *this);
    new_bodies_ = false;
  }
  if (send_shapes_ || !all_round_)
    bring_to_ghosts();
  // Others than nve/cluster may turn bodies when lists are made anew (insertion), but not in between.
  update_rotations(send_shapes_ ? 0 : atom->nlocal, atom->nlocal + atom->nghost);
}

void FixClusterBodies::post_run() {
  if (stepped_)
    last_forces_.keep(*lmp, *this);
  stepped_ = false;
}

void FixClusterBodies::bring_to_ghosts() {
  if (atom->nghost > 0 || comm->nprocs > 1)
    comm->forward_comm_fix(this);
}

void FixClusterBodies::update_rotations(int first, int last) {
  for (int i = first; i < last; ++i)
    if (first == 0 || !is_round(i))
      contact::rotation_matrix(data_[i], rotation(i));
}

void FixClusterBodies::grow_arrays(int nmax) {
  memory->grow(data_, nmax, static_cast<int>(columns), "cluster_bodies:data");
  array_atom = data_;
  rotation_.resize(9 * static_cast<std::size_t>(nmax), 0.);
  last_forces_.grow(nmax);
}

void FixClusterBodies::copy_arrays(int i, int j, int) {
  std::copy(data_[i], data_[i] + columns, data_[j]);
  std::copy(rotation(i), rotation(i) + 9, rotation(j));
  last_forces_.copy(i, j);
}

void FixClusterBodies::resume_forces() {
  stepped_ = true;
  last_forces_.put_back(*lmp, *this);
}

void FixClusterBodies::set_arrays(int i) {
  std::fill(data_[i], data_[i] + columns, 0.);
  data_[i][0] = 1;
  data_[i][shape_column] = plain_sphere;
  contact::rotation_matrix(data_[i], rotation(i));
  last_forces_.forget(i);
}

int FixClusterBodies::pack_exchange(int i, double* buf) {
  std::copy(data_[i], data_[i] + columns, buf);
  return columns + last_forces_.pack(i, buf + columns);
}

int FixClusterBodies::unpack_exchange(int i, double* buf) {
  std::copy(buf, buf + columns, data_[i]);
  contact::rotation_matrix(data_[i], rotation(i));
  return columns + last_forces_.unpack(i, buf + columns);
}

int FixClusterBodies::pack_restart(int i, double* buf) {
  buf[0] = size_restart(i);
  double* next = std::copy(data_[i], data_[i] + columns, buf + 1);
  if (last_forces_.pending()) {
    std::copy(last_forces_.row(i), last_forces_.row(i) + LastForces::kept_values, next);
    return size_restart(i);
  }
  next = std::copy(atom->f[i], atom->f[i] + 3, next);
  std::copy(atom->torque[i], atom->torque[i] + 3, next);
  return size_restart(i);
}

void FixClusterBodies::unpack_restart(int i, int nth) {
  const double* extra = atom->extra[i];
  int m = 0;
  for (int k = 0; k < nth; ++k)
    m += static_cast<int>(extra[m]);
  const double* record = extra + m + 1;
  const double shape = record[shape_column];
  if (extra[m] != size_restart(i) || !(shape >= plain_sphere && shape < shapes_.size()) || shape != std::floor(shape))
    error->one(FLERR, damaged_restart("clusters").c_str());
  std::copy(record, record + columns, data_[i]);
  contact::rotation_matrix(data_[i], rotation(i));
  if (last_forces_.pending())
    last_forces_.set(*lmp, *this, i, record + columns);
}

int FixClusterBodies::size_restart(int) {
  return 1 + columns + LastForces::kept_values;
}
int FixClusterBodies::maxsize_restart() {
  return 1 + columns + LastForces::kept_values;
}

void FixClusterBodies::write_restart(FILE* fp) {
  if (comm->me != 0)
    return;
  ByteWriter bytes;
  // Forces with which a run goes on; before the first run there are none.
  bytes.put(static_cast<char>(update->whichflag != 0 || last_forces_.pending()));
  bytes.put(shapes_.size());
  for (int id = 0; id < shapes_.size(); ++id) {
    const shape::ClusterShape& shape = shapes_[id];
    bytes.put(static_cast<int>(shape.name().size()));
    for (char c : shape.name())
      bytes.put(c);
    bytes.put(static_cast<int>(shape.spheres().size()));
    for (const shape::Sphere& s : shape.spheres())
      for (double value : {s.centre.x(), s.centre.y(), s.centre.z(), s.radius})
        bytes.put(value);
    bytes.put(shape.volume());
    bytes.put(shape.surface());
    for (int k = 0; k < 3; ++k)
      bytes.put(shape.inertia_per_mass()[k]);
    const std::vector<double> hull = shape.hull() ? shape::record_of(*shape.hull()) : std::vector<double>();
    bytes.put(static_cast<int>(hull.size()));
    for (const double value : hull)
      bytes.put(value);
  }
  const int head[] = {restart_mark, static_cast<int>(bytes.data.size()), ~static_cast<int>(bytes.data.size())};
  const int size = static_cast<int>(sizeof head + bytes.data.size());
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(head, sizeof(int), 3, fp);
  fwrite(bytes.data.data(), 1, bytes.data.size(), fp);
}

void FixClusterBodies::restart(char* buf) {
  int head[3] = {};
  std::memcpy(head, buf, sizeof(int)); // of another version, there may be no more
  if (const std::string problem = restart_problem(head[0], "clusters"); !problem.empty())
    error->all(FLERR, problem.c_str());
  std::memcpy(head, buf, sizeof head);
  if (head[1] < 0 || head[2] != ~head[1] || !read_shapes(buf + sizeof head, head[1]))
    error->all(FLERR, damaged_restart("clusters").c_str());
}

bool FixClusterBodies::read_shapes(const char* data, int size) {
  ByteReader bytes(data, size);
  const char within_run = bytes.get<char>();
  if (within_run != 0 && within_run != 1)
    return false;
  if (within_run)
    last_forces_.expect(atom->nmax);
  const int count = bytes.count(sizeof(int));
  for (int id = 0; id < count; ++id) {
    std::string name(bytes.count(1), ' ');
    for (char& c : name)
      c = bytes.get<char>();
    std::vector<shape::Sphere> spheres(bytes.count(4 * sizeof(double)));
    bool possible = !spheres.empty();
    for (shape::Sphere& s : spheres) {
      for (int k = 0; k < 3; ++k)
        s.centre[k] = bytes.get<double>();
      s.radius = bytes.get<double>();
      possible = possible && s.centre.allFinite() && std::isfinite(s.radius) && s.radius > 0;
    }
    shape::MassProperties properties;
    properties.volume = bytes.get<double>();
    properties.surface = bytes.get<double>();
    properties.centre.setZero();
    properties.inertia_per_mass.setZero();
    for (int k = 0; k < 3; ++k)
      properties.inertia_per_mass(k, k) = bytes.get<double>();
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    possible = possible && positive(properties.volume) && positive(properties.surface) &&
               properties.inertia_per_mass.diagonal().allFinite() &&
               properties.inertia_per_mass.diagonal().minCoeff() > 0;
    std::vector<double> hull(bytes.count(sizeof(double)));
    for (double& value : hull)
      value = bytes.get<double>();
    if (!bytes.good() || !possible)
      return false;
    if (hull.empty()) {
      shapes_.add(shape::ClusterShape(name, std::move(spheres), properties));
      continue;
    }
    try {
      shapes_.add(shape::ClusterShape(shape::hull_of_record(name, hull)));
    } catch (const std::invalid_argument&) {
      return false;
    }
  }
  return bytes.at_end();
}

int FixClusterBodies::pack_comm(int n, int* list, double* buf, int, int*) {
  int m = 0;
  for (int k = 0; k < n; ++k) {
    const double* d = data_[list[k]];
    for (int c = 0; c < 4; ++c)
      buf[m++] = d[c];
    if (send_shapes_)
      buf[m++] = d[shape_column];
  }
  return send_shapes_ ? 5 : 4;
}

void FixClusterBodies::unpack_comm(int n, int first, double* buf) {
  int m = 0;
  for (int i = first; i < first + n; ++i) {
    for (int c = 0; c < 4; ++c)
      data_[i][c] = buf[m++];
    if (send_shapes_)
      data_[i][shape_column] = buf[m++];
  }
}

double FixClusterBodies::memory_usage() {
  return static_cast<double>(atom->nmax) * (columns + 9) * sizeof(double);
}

} // namespace eccentra::styles
