// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS's own spring models of rolling friction at our walls: its code, given the spin relative to the wall.
#include "base/option_reader.h"
#include "styles/rolling/wall_rolling.h"

#include <mpi.h>

#include "contact_models.h"

#include "force.h"
#include "lammps.h"
#include "settings.h"

#include <algorithm>
#include <memory>
#include <string>

namespace eccentra::styles {
namespace {

namespace stock = LIGGGHTS::ContactModels;

constexpr int kKept = 3; ///< values that WallRollingContact::memory has: the torque of the spring
constexpr int kMost = 8; ///< values that a model may ask for (luding: a second torque, for torsion, which is off)

/// Counts the values of history that a model asks for.
class History : public LIGGGHTS::IContactHistorySetup {
 public:
  int add_history_value(std::string, std::string) override { return size_++; }

 private:
  int size_ = 0;
};

/// Stands in for the contact model around a rolling model. Hertz has no adhesion: kc and fo, which luding reads, are 0.
class Surroundings : public stock::ContactModelBase {
 public:
  explicit Surroundings(LAMMPS_NS::LAMMPS* lmp) : ContactModelBase(lmp, true) {
    add_history_offset("kc_offset", kMost);
    add_history_offset("fo_offset", kMost);
  }
  void tally_pp(double, int, int, int) override {}
  void tally_pw(double, int, int, int) override {}
};

template <int Rolling> class StockWallRolling : public WallRolling {
 public:
  /// `option`: the one on/off word that may follow, or null.
  explicit StockWallRolling(const char* option) : option_(option) {}

  bool read_keyword(base::OptionReader& reader) override {
    if (!option_ || reader.peek() != option_)
      return false;
    reader.keyword();
    on_ = reader.on_off();
    return true;
  }

  void init(LAMMPS_NS::LAMMPS* lmp) override {
    History history;
    surroundings_ = std::make_unique<Surroundings>(lmp);
    model_ = std::make_unique<stock::RollingModel<Rolling>>(lmp, &history, surroundings_.get());
    Settings settings(lmp);
    model_->registerSettings(settings);
    std::string arguments[] = {option_ ? option_ : "", on_ ? "on" : "off"};
    char* arg[] = {arguments[0].data(), arguments[1].data()};
    settings.parseArguments(option_ ? 2 : 0, arg);
    model_->postSettings(&history, surroundings_.get());
    model_->connectToProperties(lmp->force->registry);
  }

  Eigen::Vector3d torque(const WallRollingContact& contact) override {
    double history[kMost + 1] = {};
    std::copy_n(contact.memory, kKept, history);
    stock::SurfacesIntersectData data{};
    data.is_wall = true;
    data.i = contact.atom;
    data.itype = contact.atom_type;
    data.jtype = contact.wall_type;
    data.radi = contact.lever;
    data.mi = data.meff = contact.mass;
    data.kn = contact.stiffness;
    data.kt = contact.tangential_stiffness;
    data.gamman = contact.normal_damping;
    data.gammat = contact.tangential_damping;
    data.Fn = contact.normal_force;
    data.deltan = contact.elastic_normal / contact.stiffness;
    // Stock scales the spin: lever of the contact point over the distance from the wall.
    const Eigen::Vector3d spin =
        contact.angular_velocity * ((contact.lever - 0.5 * data.deltan) / (contact.lever - data.deltan));
    data.wr1 = spin[0];
    data.wr2 = spin[1];
    data.wr3 = spin[2];
    for (int k = 0; k < 3; ++k)
      data.en[k] = contact.normal[k];
    data.computeflag = 1;
    data.shearupdate = contact.advance;
    data.contact_history = history;
    stock::ForceData on_particle;
    stock::ForceData on_wall;
    model_->surfacesIntersect(data, on_particle, on_wall);
    if (contact.advance)
      std::copy_n(history, kKept, contact.memory);
    return {on_particle.delta_torque[0], on_particle.delta_torque[1], on_particle.delta_torque[2]};
  }

 private:
  const char* option_;
  bool on_ = false;
  std::unique_ptr<Surroundings> surroundings_;
  std::unique_ptr<stock::RollingModel<Rolling>> model_;
};

template <int Rolling> WallRollingCreator creator(const char* option) {
  return [option] { return std::make_unique<StockWallRolling<Rolling>>(option); };
}

const RegisterWallRolling epsd("epsd", creator<stock::ROLLING_EPSD>("torsionTorque"));
const RegisterWallRolling epsd2("epsd2", creator<stock::ROLLING_EPSD2>("torsionTorque"));
const RegisterWallRolling epsd3("epsd3", creator<stock::ROLLING_EPSD3>("torsionTorque"));
const RegisterWallRolling luding("luding", creator<stock::ROLLING_LUDING>(nullptr));

} // namespace
} // namespace eccentra::styles
