// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Hands LIGGGHTS's models one sub-contact after the other.
#include "styles/models/stock_contact.h"

#include "base/refusal.h"
#include "contact/contact_models.h"
#include "styles/models/stock_models.h"

#include <mpi.h>

#include "atom.h"
#include "contact_models.h"
#include "error.h"
#include "fix_property_atom.h"
#include "force.h"
#include "global_properties.h"
#include "lammps.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "settings.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace eccentra::styles {

struct StockContact::Models {
  Models(LAMMPS_NS::LAMMPS* lmp, bool wall) : around(lmp, wall) {}

  StockHistory history;
  StockSurroundings around;
  using Surface = stock::SurfaceModel<stock::SURFACE_DEFAULT>;
  std::unique_ptr<Surface> surface;
  StockModel<stock::NormalModelBase> normal;
  StockModel<stock::CohesionModelBase> cohesion;
  StockModel<stock::TangentialModelBase> tangential;
  StockModel<stock::RollingModelBase> rolling;
  std::vector<BegunContact> begun = std::vector<BegunContact>(1);
  BegunContact aside; ///< for stiffness alone
  std::vector<double> scratch;
  std::vector<double*> rows; ///< of VelocitiesOfSides
  int flags = 0;
  LAMMPS_NS::FixPropertyAtom *liquid_flux = nullptr, *liquid = nullptr; ///< of a model of liquid bridges

  /// Calls visit for each model in LIGGGHTS's own order.
  template <class Visit> void each(Visit visit) {
    visit(*surface);
    visit(*normal);
    visit(*cohesion);
    visit(*tangential);
    visit(*rolling);
  }
};

StockContact::StockContact(LAMMPS_NS::LAMMPS* lmp, bool wall) : lmp_(lmp), wall_(wall) {}
StockContact::~StockContact() = default;

std::string StockContact::read_name(base::OptionReader& reader, const std::string& kind) {
  std::set<std::string> names = stock_names(kind);
  if (kind == "model")
    for (const contact::ContactModel& model : contact::contact_models())
      names.insert(model.name);
  std::string name = reader.value("one of " + listed(names));
  if (!names.count(name))
    base::refuse("{}: '{}' is not offered; expected one of {}", kind, name, listed(names));
  return name;
}

std::string StockContact::known(const std::string& kind) {
  return listed(stock_names(kind));
}

void StockContact::choose(const StockModelNames& names, const std::vector<std::string>& options) {
  models_ = std::make_unique<Models>(lmp_, wall_);
  names_ = names;
  Models& m = *models_;
  m.surface = std::make_unique<Models::Surface>(lmp_, &m.history, &m.around);
  m.normal = stock_normal(names.normal, lmp_, &m.history, &m.around);
  // What luding's models read beside a normal model without adhesion: 0.
  if (m.around.get_history_offset("kc_offset") < 0 && (names.tangential == "tan_luding" || names.rolling == "luding")) {
    m.around.add_history_offset("kc_offset", m.history.add_history_value("kc", "1"));
    m.around.add_history_offset("fo_offset", m.history.add_history_value("fo", "1"));
  }
  m.cohesion = stock_cohesion(names.cohesion, lmp_, &m.history, &m.around);
  m.tangential = stock_tangential(names.tangential, lmp_, &m.history, &m.around);
  m.rolling = stock_rolling(names.rolling, lmp_, &m.history, &m.around);
  Settings settings(lmp_);
  m.each([&](auto& model) { model.registerSettings(settings); });
  for (std::size_t k = 0; k + 1 < options.size(); k += 2)
    viscous_ = viscous_ || (options[k] == "viscous" && base::switch_value(options[k + 1]).value_or(false));
  std::vector<std::string> words = options;
  std::vector<char*> arg;
  for (std::string& word : words)
    arg.push_back(word.data());
  if (!settings.parseArguments(static_cast<int>(arg.size()), arg.data()))
    throw std::invalid_argument(
        settings.error_message + "; known are the words of this style's page and the options of model " + names.normal +
        ", tangential " + names.tangential + ", rolling_friction " + names.rolling + " and cohesion " + names.cohesion);
  m.each([&](auto& model) { model.postSettings(&m.history, &m.around); });
  m.scratch.resize(m.history.size + 1);
  shear_ = m.history.shear;
}

int StockContact::history_size() const {
  return models_->history.size;
}

void StockContact::connect() {
  Models& m = *models_;
  // What a model reaches beyond touch it tells the neighbour list alone.
  const double before = lmp_->neighbor->contactDistanceFactor;
  lmp_->neighbor->contactDistanceFactor = 1;
  m.each([&](auto& model) { model.connectToProperties(lmp_->force->registry); });
  reach_ = names_.cohesion == "off" ? 1 : lmp_->neighbor->contactDistanceFactor;
  lmp_->neighbor->contactDistanceFactor = std::max(before, lmp_->neighbor->contactDistanceFactor);
  if (names_.tangential != "off") {
    PropertyRegistry& registry = lmp_->force->registry;
    registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    registry.connect("coeffFrict", friction_, "gran/cluster");
  }
  const auto liquid_property = [this](const char* name) {
    return static_cast<LAMMPS_NS::FixPropertyAtom*>(
        lmp_->modify->find_fix_property(name, "property/atom", "scalar", 0, 0, "gran/cluster", false));
  };
  if (reach_ > 1) {
    m.liquid_flux = liquid_property("liquidFlux");
    m.liquid = liquid_property("surfaceLiquidContent");
  }
}

void StockContact::begin_step() {
  if (models_->liquid)
    models_->liquid->do_forward_comm();
}

double StockContact::exponent() const {
  return models_->normal->stressStrainExponent();
}

namespace {

/// What stock's loop over pairs (pair_gran_base.h) and walls (fix_wall_gran_base.h) hands over.
void fill(stock::SurfacesIntersectData& data, StockSubContact& c, bool wall) {
  data.is_wall = wall;
  data.i = c.a;
  data.j = c.b;
  data.itype = c.type_a;
  data.jtype = c.type_b;
  data.radi = c.radius_a;
  data.radj = c.radius_b;
  data.radsum = c.radius_a + c.radius_b;
  std::copy_n(c.separation, 3, data.delta);
  data.rsq = c.separation[0] * c.separation[0] + c.separation[1] * c.separation[1] + c.separation[2] * c.separation[2];
  data.v_i = c.velocity_a;
  data.v_j = c.velocity_b;
  data.omega_i = c.omega_a;
  data.omega_j = c.omega_b;
  data.mi = c.mass_a;
  data.mj = c.mass_b;
  data.meff = c.mass;
  data.area_ratio = 1;
  data.computeflag = 1;
  data.shearupdate = c.advance;
  data.r = std::sqrt(data.rsq);
  data.rinv = 1 / data.r;
  for (int k = 0; k < 3; ++k)
    data.en[k] = data.delta[k] * data.rinv;
  data.deltan = data.radsum - data.r;
}

} // namespace

void StockContact::stiffness(StockSubContact& c) {
  Models& m = *models_;
  BegunContact& at = m.aside;
  fill(at.data, c, wall_);
  std::copy_n(c.history, m.history.size, m.scratch.data());
  at.data.contact_history = m.scratch.data();
  at.data.contact_flags = &m.flags;
  at.data.shearupdate = 0;
  at.on_a.reset();
  at.on_b.reset();
  at.data.kn = at.data.kt = at.data.gamman = at.data.gammat = 0;
  m.surface->surfacesIntersect(at.data, at.on_a, at.on_b);
  m.normal->surfacesIntersect(at.data, at.on_a, at.on_b);
  c.kn = at.data.kn;
  c.kt = at.data.kt;
  c.gamma_n = at.data.gamman;
  c.gamma_t = at.data.gammat;
}

/// The normal force of the last evaluation without its damper. Where `limitForce` has cut it off at 0 the damper does
/// not tell: the model is asked again, without a velocity.
double StockContact::elastic_force(const BegunContact& at, const StockSubContact& c) {
  const double damper = at.data.gamman * at.data.vn;
  if (at.data.Fn != 0 || damper == 0)
    return at.data.Fn + damper;
  if (viscous_)
    return at.data.kn * at.data.deltan; // of hooke, which divides by the velocity then
  Models& m = *models_;
  BegunContact& still = m.aside;
  still.data = at.data;
  std::copy_n(c.history, m.history.size, m.scratch.data());
  still.data.contact_history = m.scratch.data();
  still.data.shearupdate = 0;
  still.data.vn = 0;
  still.on_a.reset();
  still.on_b.reset();
  m.normal->surfacesIntersect(still.data, still.on_a, still.on_b);
  return still.data.Fn;
}

/// Leaves the contact its share of the dampers.
void StockContact::keep_share(BegunContact& at, double share) {
  stock::SurfacesIntersectData& data = at.data;
  const bool cut_off = data.Fn == 0;
  double normal = at.elastic - share * data.gamman * data.vn;
  if (cut_off && normal < 0)
    normal = 0;
  const double more = normal - data.Fn;
  for (int k = 0; k < 3; ++k) {
    at.on_a.delta_F[k] += more * data.en[k];
    at.on_b.delta_F[k] -= more * data.en[k];
  }
  data.Fn = normal;
  data.gamman *= share;
  data.gammat *= share;
}

/// Slip of the contact point in the middle of the step instead of what the velocities, which belong there, give at its
/// end (contact_forces has the same).
void StockContact::synchronise(BegunContact& at, const StockSubContact& c) {
  stock::SurfacesIntersectData& data = at.data;
  using Eigen::Vector3d;
  const Eigen::Map<const Vector3d> va(c.velocity_a), vb(c.velocity_b), wa(c.omega_a), wb(c.omega_b), arm_a(c.arm_a),
      arm_b(c.arm_b), n(data.en);
  const double half = 0.5 * c.step;
  const Vector3d approach = va - vb;
  const Vector3d normal = wall_ ? Vector3d(n) : Vector3d(n - half * data.rinv * (approach - approach.dot(n) * n));
  Vector3d slip = va - half * wa.cross(wa.cross(arm_a)) - vb - data.cri * wa.cross(normal);
  if (!wall_)
    slip += half * wb.cross(wb.cross(arm_b)) - data.crj * wb.cross(normal);
  slip -= slip.dot(normal) * normal;
  data.vtr1 = slip[0];
  data.vtr2 = slip[1];
  data.vtr3 = slip[2];
}

/// Stock's tangential model under the bound that was chosen.
void StockContact::tangential(const StockSubContact* contacts, int n) {
  Models& m = *models_;
  const bool elastic = bound_ == contact::FrictionBound::elastic && friction_;
  for (int k = 0; k < n; ++k) {
    BegunContact& at = m.begun[k];
    at.friction_a.reset();
    at.friction_b.reset();
    at.whole = at.data.Fn;
    if (elastic)
      at.data.Fn = at.elastic + at.adhesion; // without the damper
  }
  m.tangential.intersect(m.begun.data(), n);
  for (int k = 0; k < n; ++k) {
    BegunContact& at = m.begun[k];
    if (!at.touches)
      continue;
    double cut = 1;
    if (elastic) {
      const double* f = at.friction_a.delta_F;
      const double cap = friction_[contacts[k].type_a][contacts[k].type_b] * std::fabs(at.data.Fn);
      const double square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
      if (square > cap * cap)
        cut = cap / std::sqrt(square);
    }
    for (int d = 0; d < 3; ++d) {
      at.on_a.delta_F[d] += cut * at.friction_a.delta_F[d];
      at.on_b.delta_F[d] += cut * at.friction_b.delta_F[d];
      at.on_a.delta_torque[d] += cut * at.friction_a.delta_torque[d];
      at.on_b.delta_torque[d] += cut * at.friction_b.delta_torque[d];
    }
    at.data.Fn = at.whole;
  }
}

namespace {

/// While it lives, the array of velocities has those of a sub-contact's two sides in the rows that stand for them:
/// easo/capillary/viscous takes them from there, where those of the bodies' centres are, and of a wall nothing.
class VelocitiesOfSides {
 public:
  VelocitiesOfSides(LAMMPS_NS::Atom& atom, std::vector<double*>& rows, const StockSubContact& c)
      : atom_(atom), before_(atom.v) {
    const int before_first = atom.ntypes + 1; // a wall is minus its type
    const std::size_t length = before_first + static_cast<std::size_t>(std::max({c.a, c.b, atom.nmax})) + 1;
    if (rows.size() < length)
      rows.resize(length);
    std::copy_n(c.velocity_a, 3, a_);
    std::copy_n(c.velocity_b, 3, b_);
    rows[before_first + c.a] = a_;
    rows[before_first + c.b] = b_;
    atom_.v = rows.data() + before_first;
  }
  ~VelocitiesOfSides() { atom_.v = before_; }
  VelocitiesOfSides(const VelocitiesOfSides&) = delete;
  VelocitiesOfSides& operator=(const VelocitiesOfSides&) = delete;

 private:
  LAMMPS_NS::Atom& atom_;
  double** before_;
  double a_[3], b_[3];
};

} // namespace

/// Sub-spheres that do not touch. Liquid that a bridge moves is counted per volume of a sub-sphere, of which a body has
/// more than one, and for bodies of this rank alone: that of a ghost is counted by its own.
void StockContact::close(BegunContact& at, const StockSubContact& c) {
  Models& m = *models_;
  const VelocitiesOfSides in_place(*lmp_->atom, m.rows, c);
  double* flux = m.liquid_flux ? m.liquid_flux->vector_atom : nullptr;
  const double before_a = flux ? flux[c.a] : 0, before_b = flux && !wall_ ? flux[c.b] : 0;
  m.each([&](auto& model) { model.surfacesClose(at.data, at.on_a, at.on_b); });
  const auto count = [&](int i, double before, double radius, double volume) {
    constexpr double ball = 4. / 3. * M_PI;
    if (!c.advance || i >= lmp_->atom->nlocal)
      flux[i] = before;
    else if (volume > 0)
      flux[i] = before + (flux[i] - before) * ball * radius * radius * radius / volume;
  };
  if (flux)
    count(c.a, before_a, c.radius_a, c.volume_a);
  if (flux && !wall_)
    count(c.b, before_b, c.radius_b, c.volume_b);
}

void StockContact::begin(StockSubContact* contacts, int n) {
  Models& m = *models_;
  if (static_cast<std::size_t>(n) > m.begun.size())
    m.begun.resize(n + contact::ContactBlock::capacity);
  for (int k = 0; k < n; ++k) {
    StockSubContact& c = contacts[k];
    BegunContact& at = m.begun[k];
    stock::SurfacesIntersectData& data = at.data;
    fill(data, c, wall_);
    data.contact_history = c.history;
    if (!c.advance) { // some models move their history on all the same
      at.still.assign(c.history, c.history + m.history.size);
      at.still.push_back(0);
      data.contact_history = at.still.data();
    }
    data.contact_flags = wall_ ? nullptr : &m.flags;
    at.on_a.reset();
    at.on_b.reset();
    data.kn = data.kt = data.gamman = data.gammat = 0;
    data.Fn = data.Ft = 0;
    c.touches = at.touches = data.rsq < data.radsum * data.radsum;
    if (c.touches) {
      m.surface->Models::Surface::surfacesIntersect(data, at.on_a, at.on_b);
      if (synchronised_ && c.advance)
        synchronise(at, c);
    }
  }
  m.normal.intersect(m.begun.data(), n);
  for (int k = 0; k < n; ++k) {
    StockSubContact& c = contacts[k];
    const stock::SurfacesIntersectData& data = m.begun[k].data;
    std::copy_n(data.en, 3, c.normal);
    c.overlap = c.radius_a + c.radius_b - data.r;
    c.kn = data.kn;
    c.kt = data.kt;
    c.gamma_n = data.gamman;
    c.gamma_t = data.gammat;
  }
}

/// Stock's rolling model with the radii that were chosen.
void StockContact::rolling(const StockSubContact* contacts, int n) {
  if (names_.rolling == "off")
    return;
  Models& m = *models_;
  for (int k = 0; k < n; ++k) {
    const StockSubContact& c = contacts[k];
    stock::SurfacesIntersectData& data = m.begun[k].data;
    if (c.share != 1) { // dampers of rolling go with the root of the inertia
      data.mi *= c.share * c.share;
      data.mj *= c.share * c.share;
    }
    if (rolling_radius_ == RollingRadius::body && c.touches) {
      const auto distance = [](const double* arm, double reach, const double* normal) {
        const double x = arm[0] + reach * normal[0], y = arm[1] + reach * normal[1], z = arm[2] + reach * normal[2];
        return std::sqrt(x * x + y * y + z * z);
      };
      data.radi = distance(c.arm_a, -data.cri, data.en);
      if (!wall_)
        data.radj = distance(c.arm_b, data.crj, data.en);
    }
  }
  m.rolling.intersect(m.begun.data(), n);
}

/// Stock's cohesion, and what it adds to the normal force.
void StockContact::cohesion(int n) {
  if (names_.cohesion == "off")
    return;
  Models& m = *models_;
  for (int k = 0; k < n; ++k)
    m.begun[k].whole = m.begun[k].data.Fn;
  m.cohesion.intersect(m.begun.data(), n);
  for (int k = 0; k < n; ++k)
    m.begun[k].adhesion = m.begun[k].data.Fn - m.begun[k].whole;
}

void StockContact::finish(StockSubContact* contacts, int n) {
  Models& m = *models_;
  for (int k = 0; k < n; ++k) {
    const StockSubContact& c = contacts[k];
    BegunContact& at = m.begun[k];
    if (!at.touches)
      continue;
    if (c.share != 1 || bound_ == contact::FrictionBound::elastic)
      at.elastic = elastic_force(at, c);
    if (c.share != 1)
      keep_share(at, c.share);
  }
  cohesion(n);
  tangential(contacts, n);
  rolling(contacts, n);
  for (int k = 0; k < n; ++k) {
    StockSubContact& c = contacts[k];
    BegunContact& at = m.begun[k];
    c.acts = true;
    if (at.touches) {
      m.cohesion->endSurfacesIntersect(at.data, at.on_a, at.on_b);
    } else {
      at.data.has_force_update = false;
      close(at, c);
      c.acts = at.data.has_force_update;
    }
    c.gamma_n = at.data.gamman;
    c.gamma_t = at.data.gammat;
    for (int d = 0; d < 3; ++d) {
      c.force[d] = c.acts ? at.on_a.delta_F[d] : 0;
      c.torque_a[d] = c.acts ? at.on_a.delta_torque[d] : 0;
      c.torque_b[d] = c.acts ? at.on_b.delta_torque[d] : 0;
    }
    if (!std::isfinite(c.force[0] + c.force[1] + c.force[2]))
      lmp_->error->one(FLERR, ("model " + names_.normal + ", cohesion " + names_.cohesion +
                               ": the force of a contact is not a number; expected a smaller time step or less "
                               "adhesion (surfaceEnergy, pullOffForce)")
                                  .c_str());
  }
}

} // namespace eccentra::styles
