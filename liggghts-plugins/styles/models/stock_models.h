// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// LIGGGHTS's contact models by name: its own classes, each with its own code over many contacts.
#pragma once

#include <mpi.h>

#include "contact_models.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace eccentra::styles {

namespace stock = LIGGGHTS::ContactModels;

/// A contact whose normal force is there.
struct BegunContact {
  stock::SurfacesIntersectData data{};
  stock::ForceData on_a, on_b;
  stock::ForceData friction_a, friction_b; ///< what the tangential model adds to them
  double elastic = 0;                      ///< normal force without its damper [N]
  double whole = 0;                        ///< normal force that waits while a model sees another one [N]
  double adhesion = 0;                     ///< what cohesion adds to it [N]
  bool touches = false;
  std::vector<double> still; ///< history that does not move on
};

/// Counts the values of history that the models ask for.
class StockHistory : public LIGGGHTS::IContactHistorySetup {
 public:
  int add_history_value(std::string name, std::string) override {
    if (name == "shearx")
      shear = size;
    return size++;
  }
  int size = 0, shear = -1;
};

/// Stands in for the contact model around the models.
class StockSurroundings : public stock::ContactModelBase {
 public:
  StockSurroundings(LAMMPS_NS::LAMMPS* lmp, bool wall) : ContactModelBase(lmp, wall) {}
  void tally_pp(double, int, int, int) override {}
  void tally_pw(double, int, int, int) override {}
};

/// A model of stock's, and its own code over contacts at once: a call through its base for each costs more than what
/// many models compute.
template <class Base> struct StockModel {
  std::unique_ptr<Base> model;
  void (*over)(Base& model, BegunContact* contacts, int n) = nullptr;
  Base& operator*() const { return *model; }
  Base* operator->() const { return model.get(); }
  void intersect(BegunContact* contacts, int n) const { over(*model, contacts, n); }
};

/// The model of that name. Throws std::invalid_argument with a sentence that lists the names there are.
StockModel<stock::NormalModelBase> stock_normal(const std::string& name, LAMMPS_NS::LAMMPS* lmp, StockHistory* history,
                                                StockSurroundings* around);
StockModel<stock::CohesionModelBase> stock_cohesion(const std::string& name, LAMMPS_NS::LAMMPS* lmp,
                                                    StockHistory* history, StockSurroundings* around);
StockModel<stock::TangentialModelBase> stock_tangential(const std::string& name, LAMMPS_NS::LAMMPS* lmp,
                                                        StockHistory* history, StockSurroundings* around);
StockModel<stock::RollingModelBase> stock_rolling(const std::string& name, LAMMPS_NS::LAMMPS* lmp,
                                                  StockHistory* history, StockSurroundings* around);

/// Of the models of `kind` (model, tangential, rolling_friction, cohesion) that LIGGGHTS as it is installed has.
std::set<std::string> stock_names(const std::string& kind);
/// Each after a comma.
std::string listed(const std::set<std::string>& names);

} // namespace eccentra::styles
