// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// fix timestep/limit: sums stiffness over all contacts of each body, reports, and stops a run whose step is too large.
#include "styles/pairs/fix_timestep_limit.h"

#include "base/eigen_views.h"
#include "base/option_reader.h"
#include "contact/feature_search.h"
#include "contact/manifold.h"
#include "styles/bodies/fix_cluster_bodies.h"
#include "styles/entry/host_terminal.h"
#include "styles/entry/style_registry.h"
#include "styles/pairs/pair_gran_cluster.h"
#include "styles/walls/fix_wall_gran_cluster.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neigh_list.h"
#include "pair.h"
#include "update.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace eccentra::styles {

using namespace LAMMPS_NS;

namespace {

const RegisterFix<FixTimestepLimit> registered("timestep/limit",
                                               "largest stable time step from contacts, mass and inertia");

// A limit that has moved by less than this is not worth another line in the log.
constexpr double kReportChange = 0.1;
constexpr double kNever = std::numeric_limits<double>::infinity();

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

} // namespace

FixTimestepLimit::FixTimestepLimit(LAMMPS* lmp, int narg, char** arg) : Fix(lmp, narg, arg) {
  nevery = 1000;
  try {
    base::OptionReader reader({arg + 3, arg + narg});
    while (reader.more()) {
      const std::string& word = reader.keyword();
      if (word == "safety")
        safety_ = reader.positive();
      else if (word == "speed")
        speed_ = reader.positive();
      else if (word == "every")
        nevery = reader.count(1, "steps");
      else if (word == "enforce")
        enforce_ = reader.on_off();
      else
        reader.unknown("safety, every, enforce, speed");
    }
  } catch (const std::invalid_argument& problem) {
    fail(problem.what());
  }
  scalar_flag = 1;
  vector_flag = 1;
  size_vector = 7;
  global_freq = 1;
  extscalar = 0;
  extvector = 0;
  limit_ = {kNever, 0, -1, 0};
}

void FixTimestepLimit::fail(const std::string& sentence) {
  error->all(FLERR, ("fix " + std::string(id) + " timestep/limit: " + sentence).c_str());
  throw std::logic_error("unreachable: error->all ends the process");
}

int FixTimestepLimit::setmask() {
  return FixConst::END_OF_STEP;
}

void FixTimestepLimit::init() {
  if (!force->pair || std::strncmp(force->pair_style, "gran", 4) != 0)
    fail("knows Hertz contacts of pair styles gran and gran/cluster only, not '" +
         std::string(force->pair ? force->pair_style : "none") + "'");
  if (modify->n_fixes_style("multisphere") > 0)
    fail("knows spheres and the bodies of nve/cluster, not those of stock fix multisphere: leave one of the two fixes "
         "out");
  const char* caller = "timestep/limit";
  const auto* pair = dynamic_cast<const PairGranCluster*>(force->pair);
  stock_ = pair ? pair->stock() : nullptr;
  model_ = stock_ ? nullptr : contact::find_contact_model(pair ? pair->arguments().names.normal : "hertz");
  damping_ = pair ? pair->arguments().damping_choice() : contact::DampingChoice();
  if (model_)
    materials_.connect(lmp, *model_, false, caller);
  bodies_ = FixClusterBodies::find(lmp);
  pair_shares_ = pair && pair->arguments().sharing == ContactSharing::shared;
}

void FixTimestepLimit::setup(int) {
  evaluate();
}

void FixTimestepLimit::end_of_step() {
  evaluate();
}

Eigen::Matrix3d FixTimestepLimit::inertia(int i) const {
  if (bodies_ && bodies_->shape_id(i) != FixClusterBodies::plain_sphere) {
    const Eigen::Matrix3d r = base::row_major(bodies_->rotation(i));
    return r * bodies_->inertia(i).asDiagonal() * r.transpose();
  }
  constexpr double solid_sphere = 0.4;
  return solid_sphere * atom->rmass[i] * atom->radius[i] * atom->radius[i] * Eigen::Matrix3d::Identity();
}

void FixTimestepLimit::add_pair(int i, int j, std::vector<contact::BodyStiffness>& bodies) {
  static const contact::SurfaceSpheres plain;
  const auto spheres_of = [&](int k) -> const contact::SurfaceSpheres& {
    return bodies_ ? bodies_->shapes().surface(bodies_->shape_id(k)) : plain;
  };
  const auto extra_of = [&](int k) { return bodies_ ? bodies_->extra_radius(k) : atom->radius[k]; };
  const auto rotation_of = [&](int k) -> Eigen::Matrix3d {
    if (!bodies_)
      return Eigen::Matrix3d::Identity();
    return base::row_major(bodies_->rotation(k));
  };
  const Eigen::Vector3d apart = base::vector3(atom->x[j]) - base::vector3(atom->x[i]);
  if (apart.norm() >= atom->radius[i] + atom->radius[j])
    return;
  const contact::SurfaceSpheres& a = spheres_of(i);
  const contact::SurfaceSpheres& b = spheres_of(j);
  const Eigen::Matrix3d ra = rotation_of(i);
  const Eigen::Matrix3d rb = rotation_of(j);
  const double mass = atom->rmass[i] * atom->rmass[j] / (atom->rmass[i] + atom->rmass[j]);
  touching_.clear();
  if (a.hull || b.hull) {
    contact::PosedCore posed_a, posed_b;
    posed_a.pose(a.core, ra);
    posed_b.pose(b.core, rb);
    const contact::BodyPair pair{{&posed_a, extra_of(i)}, {&posed_b, extra_of(j)}, apart};
    contact::FeatureSearch search;
    search.search(pair, 0);
    contact::Manifolds manifolds;
    manifolds.add(pair, search.found().data(), static_cast<int>(search.found().size()));
    manifolds.evaluate();
    for (const contact::Contact& c : manifolds.contacts()) {
      if (c.elastic)
        continue;
      const double radius_a = contact::hertz_radius(a, extra_of(i), c.radius_a),
                   radius_b = contact::hertz_radius(b, extra_of(j), c.reach - c.radius_a);
      const double contact_radius = c.weight * std::sqrt(radius_a * radius_b / (radius_a + radius_b) * c.overlap());
      touching_.push_back({c.normal, c.contact_point(), c.overlap(), contact_radius, radius_a, radius_b});
    }
  }
  for (int p = 0; p < a.count && !a.hull && !b.hull; ++p) {
    const double radius_a = a.r[p] + extra_of(i);
    const Eigen::Vector3d arm_a = ra * Eigen::Vector3d(a.x[p], a.y[p], a.z[p]);
    if ((apart - arm_a).norm() >= radius_a + atom->radius[j])
      continue;
    for (int q = 0; q < b.count; ++q) {
      const double radius_b = b.r[q] + extra_of(j);
      const Eigen::Vector3d arm_b = rb * Eigen::Vector3d(b.x[q], b.y[q], b.z[q]);
      const Eigen::Vector3d line = apart + arm_b - arm_a;
      const double distance = line.norm();
      const double overlap = radius_a + radius_b - distance;
      if (overlap <= 0 || distance == 0)
        continue;
      const Eigen::Vector3d n = line / distance;
      const double radius = radius_a * radius_b / (radius_a + radius_b);
      touching_.push_back(
          {-n, arm_a + (radius_a - 0.5 * overlap) * n, overlap, std::sqrt(radius * overlap), radius_a, radius_b});
    }
  }
  if (touching_.empty())
    return;
  const int count = static_cast<int>(touching_.size());
  block_.reserve(count);
  for (int m = 0; m < count; ++m) {
    const Touching& t = touching_[m];
    for (int k = 0; k < 3; ++k) {
      block_.normal[k][m] = t.n[k];
      block_.arm[k][m] = t.arm[k];
    }
    block_.radius_a[m] = 0.5 * t.overlap; // the arm is that of the contact point
    block_.overlap[m] = t.overlap;
    block_.contact_radius[m] = t.contact_radius;
    block_.mass[m] = mass;
  }
  if (stock_)
    for (int m = 0; m < count; ++m)
      stock_stiffness(m, atom->type[i], atom->type[j], touching_[m].radius_a, touching_[m].radius_b);
  else
    materials_.fill(block_, 0, count, atom->type[i], atom->type[j]);
  if (!stock_)
    model_->stiffness(block_, contact::whole_vectors(count), damping_);
  if (pair_shares_) {
    set_impact(i, j, apart);
    group_of_.assign(count, 0);
    shares_.apply(
        block_, count, group_of_.data(), 1,
        [count](int) {
          return contact::ContactGroup{0, count};
        },
        impact_);
  }
  constexpr double kBothMove = 2;
  for (int m = 0; m < count; ++m) {
    const contact::ContactStiffness contact = contact::stiffness_of(block_, m, exponent());
    const Touching& t = touching_[m];
    if (i < atom->nlocal)
      bodies[i].add(contact, t.n, t.arm, kBothMove);
    if (j < atom->nlocal)
      bodies[j].add(contact, t.n, t.arm - apart, kBothMove);
  }
}

double FixTimestepLimit::exponent() const {
  return stock_ ? stock_->exponent() : model_->exponent;
}

/// Contact m of the block by LIGGGHTS's own normal model, at first loading.
void FixTimestepLimit::stock_stiffness(int m, int type, int other, double radius_a, double radius_b) {
  StockSubContact s = {};
  s.type_a = type;
  s.type_b = other;
  s.radius_a = radius_a;
  s.radius_b = radius_b;
  s.separation[0] = radius_a + radius_b - block_.overlap[m];
  s.mass = block_.mass[m];
  s.mass_a = s.mass_b = 2 * s.mass;
  no_history_.assign(stock_->history_size() + 1, 0.);
  s.history = no_history_.data();
  stock_->stiffness(s);
  block_.kn[m] = s.kn;
  block_.kt[m] = s.kt;
  block_.gamma_n[m] = s.gamma_n;
  block_.gamma_t[m] = s.gamma_t;
}

void FixTimestepLimit::set_impact(int i, int j, const Eigen::Vector3d& apart) {
  for (int k = 0; k < 3; ++k)
    impact_.offset[k][0] = apart[k];
  impact_.ease_a[0] = atom->rmass[j];
  impact_.ease_b[0] = atom->rmass[i];
  const auto set = [this](contact::ImpactRows::Row* rows, int body) {
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    if (bodies_ && !bodies_->is_round(body))
      inverse = atom->rmass[body] * inertia(body).inverse();
    const double six[6] = {inverse(0, 0), inverse(1, 1), inverse(2, 2), inverse(0, 1), inverse(0, 2), inverse(1, 2)};
    for (int k = 0; k < 6; ++k)
      rows[k][0] = six[k];
  };
  set(impact_.inverse_a, i);
  set(impact_.inverse_b, j);
}

void FixTimestepLimit::add_body_contacts(std::vector<contact::BodyStiffness>& bodies) {
  const NeighList* list = force->pair->list;
  if (!list)
    return;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    for (int k = 0; k < list->numneigh[i]; ++k)
      add_pair(i, list->firstneigh[i][k] & NEIGHMASK, bodies);
  }
}

void FixTimestepLimit::add_wall_contacts(std::vector<contact::BodyStiffness>& bodies) {
  constexpr double kWallRests = 1;
  for (int f = 0; f < modify->nfix; ++f) {
    auto* wall = dynamic_cast<FixWallGranCluster*>(modify->fix[f]);
    if (!wall)
      continue;
    wall->for_each_stiffness([&](const contact::WallTouch& touch, const contact::ContactStiffness& contact) {
      bodies[touch.atom].add(contact, touch.normal, touch.lever, kWallRests);
    });
  }
}

FixTimestepLimit::Limit FixTimestepLimit::limit_of_contacts() {
  std::vector<contact::BodyStiffness> bodies(atom->nlocal);
  add_body_contacts(bodies);
  add_wall_contacts(bodies);
  Limit limit{kNever, 0, -1, 0};
  for (int i = 0; i < atom->nlocal; ++i) {
    const double step = bodies[i].critical_step(atom->rmass[i], inertia(i));
    if (step < limit.step)
      limit = {step, atom->tag[i], bodies_ ? bodies_->shape_id(i) : -1, bodies[i].contacts()};
  }
  return limit;
}

/// At the largest overlap of an impact, on one contact of this effective radius.
contact::ContactStiffness FixTimestepLimit::stiffness_of_impact(int type, double radius, double mass, double speed) {
  block_.reserve(1);
  block_.mass[0] = mass;
  if (!stock_)
    materials_.fill(block_, 0, 1, type, type);
  const auto evaluate_at = [&](double overlap) {
    block_.overlap[0] = overlap;
    block_.contact_radius[0] = std::sqrt(radius * overlap);
    if (stock_)
      stock_stiffness(0, type, type, 2 * radius, 2 * radius);
    else
      model_->stiffness(block_, contact::contact_width, damping_);
  };
  const double some = 1e-3 * radius;
  evaluate_at(some);
  evaluate_at(contact::impact_overlap(exponent(), block_.kn[0], some, mass, speed));
  return contact::stiffness_of(block_, 0, exponent());
}

/// The stiffest moment of a central impact of two like bodies, one contact at the smallest sub-sphere, at the largest
/// relative speed that the scene has (or that the user expects).
FixTimestepLimit::Limit FixTimestepLimit::limit_of_impacts() {
  // max(v) and max(-v): their sum is the range of velocities.
  double extreme[6] = {-kNever, -kNever, -kNever, -kNever, -kNever, -kNever};
  double fastest = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    for (int k = 0; k < 3; ++k) {
      extreme[k] = std::max(extreme[k], atom->v[i][k]);
      extreme[3 + k] = std::max(extreme[3 + k], -atom->v[i][k]);
    }
    fastest = std::max(fastest, base::vector3(atom->v[i]).norm());
  }
  MPI_Allreduce(MPI_IN_PLACE, extreme, 6, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  double speed = std::max(speed_, fastest); // walls at rest are hit as fast as bodies move
  if (atom->natoms > 0)
    speed = std::max(speed,
                     Eigen::Vector3d(extreme[0] + extreme[3], extreme[1] + extreme[4], extreme[2] + extreme[5]).norm());
  Limit limit{kNever, 0, -1, 0};
  if (speed <= 0)
    return limit;
  for (int i = 0; i < atom->nlocal; ++i) {
    const int shape = bodies_ ? bodies_->shape_id(i) : -1;
    double radius = atom->radius[i];
    if (shape >= 0) {
      const contact::SurfaceSpheres& surface = bodies_->shapes().surface(shape);
      radius = contact::hertz_radius(surface, 0, surface.smallest_radius);
    }
    const int type = atom->type[i];
    // Two like bodies: half the mass, half the radius. The stiffness grows with the 1/5 power of the speed only.
    const double mass = atom->rmass[i] / 2;
    const contact::ContactStiffness contact = stiffness_of_impact(type, radius / 2, mass, speed);
    const double w = std::sqrt(contact.normal / mass);
    const double z = contact.normal_damping / (2 * mass * w);
    const double step = 2 / w * (std::sqrt(1 + z * z) - z);
    if (step < limit.step)
      limit = {step, 0, shape, 1};
  }
  return limit;
}

void FixTimestepLimit::evaluate() {
  const Limit contacts = limit_of_contacts();
  const Limit impacts = limit_of_impacts();
  const Limit mine = impacts.step < contacts.step ? impacts : contacts;
  struct {
    double step;
    int rank;
  } least{mine.step, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
  limit_ = mine;
  MPI_Bcast(&limit_, sizeof limit_, MPI_BYTE, least.rank, world);
  if (update->dt / limit_.step > worst_) {
    worst_ = update->dt / limit_.step;
    worst_at_ = update->ntimestep;
    worst_of_ = describe(limit_);
  }
  report(limit_);
}

std::string FixTimestepLimit::describe(const Limit& limit) const {
  const std::string shape = limit.shape >= 0 ? bodies_->shapes()[limit.shape].name() : "sphere";
  if (limit.tag == 0)
    return "an impact of " + shape + " to come";
  return "body " + std::to_string(limit.tag) + ", " + shape + ", " + std::to_string(limit.contacts) + " contacts";
}

void FixTimestepLimit::report(const Limit& limit) {
  if (limit.step == kNever)
    return;
  const double step = update->dt;
  const bool over = step > safety_ * limit.step;
  const std::string facts = "critical step " + short_number(limit.step) + " s (" + describe(limit) + "); time step " +
                            short_number(step) + " s is " + short_number(step / limit.step) + " of it, safety " +
                            short_number(safety_) + " allows " + short_number(safety_ * limit.step) + " s";
  if (over && enforce_)
    fail(facts + ": reduce timestep, reduce youngsModulus or raise safety");
  if (std::abs(limit.step - reported_) < kReportChange * reported_)
    return;
  reported_ = limit.step;
  say(std::string(over ? "WARNING: " : "") + "fix " + id + " timestep/limit at step " +
          std::to_string(update->ntimestep) + ": " + facts,
      over);
}

void FixTimestepLimit::post_run() {
  if (worst_ == said_worst_) // at first 0: nothing has touched or moved
    return;
  said_worst_ = worst_;
  say("fix " + std::string(id) + " timestep/limit: the time step was at most " + short_number(worst_) +
          " of the critical step (at step " + std::to_string(worst_at_) + ": " + worst_of_ + "); safety allows " +
          short_number(safety_) + (worst_ > safety_ ? ", WARNING: exceeded" : ""),
      true);
}

void FixTimestepLimit::say(const std::string& line, bool to_host) const {
  if (comm->me != 0)
    return;
  for (FILE* file : {screen, logfile, to_host ? host_terminal() : nullptr})
    if (file) {
      std::fputs((line + "\n").c_str(), file);
      std::fflush(file);
    }
}

double FixTimestepLimit::compute_scalar() {
  return limit_.step;
}

double FixTimestepLimit::compute_vector(int n) {
  switch (n) {
  case 0:
    return limit_.step;
  case 1:
    return update->dt / limit_.step;
  case 2:
    return safety_ * limit_.step;
  case 3:
    return limit_.tag;
  case 4:
    return limit_.contacts;
  case 5:
    return worst_;
  default:
    return static_cast<double>(worst_at_);
  }
}

} // namespace eccentra::styles
