// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style fluid/force: the closures that the script asks for, applied to every particle at every DEM step.
#pragma once

#include "closures/eddy_interaction.h"
#include "closures/effect.h"
#include "closures/effect_screen.h"
#include "closures/fluid_options.h"
#include "link/flow_quantities.h"
#include "styles/fluid/atom_arrays.h"
#include "styles/fluid/particle_geometry.h"

#include <mpi.h>

#include "fix.h"
#include "lmptype.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace eccentra::styles {

/// Forces act after all others of a step (pre_final_integrate), wherever the fix stands in the script, because drag is
/// implicit against them. Whoever samples the flow (fix fluid/uniform, fix fluid/couple) announces itself in init(),
/// fills samples() before the first step of a run (at the latest in its setup()), and then whenever it likes.
class FixFluidForce : public LAMMPS_NS::Fix {
 public:
  FixFluidForce(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixFluidForce() override;

  /// The scene's instance, or null where there is none.
  static FixFluidForce* find(LAMMPS_NS::LAMMPS* lmp);

  /// Quantities that the effects which are on read: bits of Quantity. With a screen this may change between steps; read
  /// it at every coupling step with the fluid.
  unsigned needs() const { return needs_; }
  /// Where to put them: rows are local atoms; null where a quantity is not needed. Pointers hold until atoms migrate.
  link::FluidSamples samples();
  /// What the particles received since the last reset. A momentum balance with the velocities that pre_final_integrate
  /// and end_of_step see is exact up to the half half step that the integrator still owes.
  link::FluidReaction reaction();
  void reset_reaction();
  /// Of that, what local atom i has in its velocity Atom::v by now: without the half half step that the integrator owes
  /// [N s].
  std::array<double, 3> received(int i);
  /// The next run goes on exactly where the run that wrote the restart file was: its first half half step is in Atom::f
  /// already. Call before that run's setup().
  void carry_on() { carries_on_ = true; }
  /// The fix that fills samples(), by id; a second one is an error at set-up.
  void announce_source(const std::string& fix_id);

  /// True if this effect acts now: drag, shear_lift, rotational_lift, drag_torque, pressure_gradient, viscous_stress,
  /// buoyancy.
  bool acts(const std::string& effect) const;

  const closures::Rheology& rheology() const { return options_.rheology; }
  double rho_f() const { return options_.rheology.density; }
  /// Volume of local atom i [m3]: of the union of a cluster's spheres, not of its bounding sphere.
  double particle_volume(int i) const { return geometry_.volume(i); }
  /// Diameter of the sphere of equal volume [m].
  double equivalent_diameter(int i) const { return geometry_.diameter(i); }

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int vflag) override;
  void post_run() override;
  void pre_initial_integrate() override;
  void pre_final_integrate() override;

  void grow_arrays(int rows) override;
  void copy_arrays(int from, int to, int delflag) override;
  void set_arrays(int i) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int row, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int row, int nth) override;
  int size_restart(int row) override;
  int maxsize_restart() override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  double memory_usage() override;
  /// Sums of force over all particles [N], x y z of: drag, shear_lift, rotational_lift, pressure_gradient,
  /// viscous_stress, buoyancy; then of drag_torque, strain_torque
  /// and pitching_torque [N m]. 0 for what is off.
  double compute_vector(int n) override;

 private:
  /// Arrays of samples have the places of their quantities. The numbers stand in restart files.
  enum ArrayId : unsigned { kImpulse = 8, kCoefficient = 9, kLast = 10, kEddies = 11 };
  static_assert(link::kFlowQuantityCount <= kImpulse, "samples have numbers below those of the other arrays");
  link::FluidSamples sample_arrays();
  closures::HalfStep make_half_step(double interval);
  /// Where the flow is turbulent for the particles: ages their eddies by `interval` [s], and lets the closures see the
  /// velocity with the fluctuation.
  void see_eddies(closures::HalfStep& half_step, double interval);
  /// Quantities that the effects of this set read, `on` by their numbers.
  unsigned quantities_of(const std::vector<bool>& on) const;
  /// Sets which effects act, and the quantities and arrays that they need.
  void switch_effects(const std::vector<bool>& on);
  void declare_arrays();
  /// Forces over `interval` [s]; eddies age by `ageing` [s].
  void apply(double interval, double ageing);
  void follow_screen();
  void prepare_measurement();
  std::vector<double> nanoseconds_per_visit();
  void report_effects();
  void report_ranges();
  void report_eddies(const closures::HalfStep& half_step);
  void report_cost();
  void print(const std::string& text);

  closures::FluidOptions options_;
  closures::EffectList effects_; ///< all that may act
  std::vector<bool> acting_;     ///< which of them do
  std::vector<double> seconds_;  ///< spent in each since the last report
  double visits_ = 0.0;          ///< particles times steps since then
  double run_began_ = 0.0;
  LAMMPS_NS::bigint first_of_run_ = 0;
  std::unique_ptr<closures::EffectScreen> screen_;
  bool measurement_due_ = false; ///< it begins when the flow has been sampled for all effects
  bool awaits_samples_ = false;
  ParticleGeometry geometry_;
  AtomArrays arrays_;
  std::unique_ptr<closures::EddyInteraction> eddies_; ///< null without turbulent_dispersion
  std::vector<double> seen_;                          ///< velocity with the fluctuation; scratch
  double eddy_seconds_ = 0.0;                         ///< spent on it since the last report
  std::vector<double*> rows_;                         ///< array_atom: last force of each atom
  std::vector<std::string> sources_;
  unsigned needs_ = 0;
  double elapsed_ = 0.0;
  double pending_ = 0.0; ///< time of the last half step that the integrator has not applied yet [s]
  bool first_step_ = true;
  bool carries_on_ = false;
  bool reported_ = false;
  bool range_warned_ = false;
};

} // namespace eccentra::styles
