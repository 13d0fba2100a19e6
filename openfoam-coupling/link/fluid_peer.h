// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The fluid as the DEM side sees it, whatever carries the data. No LIGGGHTS types, no OpenFOAM types.
#pragma once

#include "link/communication.h"
#include "link/flow_quantities.h"
#include "link/terms.h"
#include "link/walls.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace eccentra::link {

/// What the fluid side stores with a particle from one coupling step to the next (where it was found); it travels with
/// the particle between the ranks of DEM and means nothing to DEM. Negative: not found yet.
struct CellHint {
  std::int32_t rank = -1; ///< of the fluid side
  std::int32_t cell = -1; ///< of that rank
};

/// Doubles of a particle's extent: three vectors, see ParticleArrays.
constexpr int kExtentDoubles = 9;

/// This rank's particles, one row each. World frame, SI; positions inside the periodic box.
struct ParticleArrays {
  std::size_t count = 0;                    ///< rows
  const double (*position)[3] = nullptr;    ///< of the centres of mass [m]
  const double* volume = nullptr;           ///< of the solid [m3]
  const double (*impulse)[3] = nullptr;     ///< that the fluid gave since the last coupling step: drag and lifts [N s]
  const double* drag_coefficient = nullptr; ///< integral of beta dt since the last coupling step [kg]
  /// Null where all particles are spheres. Else vectors e_1 e_2 e_3: six points at +-e_k, each with a sixth of the
  /// volume, have the second moments of the body: e_k = sqrt(3 M_kk / V) along principal axis k.
  const double (*extent)[kExtentDoubles] = nullptr;
  CellHint* cell_hint = nullptr; ///< in and out
};

/// Sums over all particles of all ranks, for the balances. World frame, SI.
struct DemTotals {
  std::int64_t particles = 0;            ///< in the scene now
  std::int64_t inserted = 0;             ///< by the insertion fixes that the script has at present
  double inserted_mass = 0;              ///< [kg]
  double volume = 0;                     ///< [m3]
  double mass = 0;                       ///< [kg]
  double impulse[3] = {0, 0, 0};         ///< sum of ParticleArrays::impulse [N s]
  double momentum[3] = {0, 0, 0};        ///< sum m v [kg m/s], with the half half step that the integrator still owes
  double volume_position[3] = {0, 0, 0}; ///< sum V x [m4]
  double volume_velocity[3] = {0, 0, 0}; ///< sum V v [m4/s]
  double fastest = 0;                    ///< largest |v| [m/s]
};

/// How evenly the ranks of DEM were loaded since the last coupling step.
struct DemLoad {
  std::int64_t ranks = 1;         ///< of DEM
  std::int64_t max_particles = 0; ///< of any rank
  double mean_seconds = 0;        ///< that a rank computed, without waiting for others; mean over the ranks [s]
  double max_seconds = 0;         ///< of any rank [s]
  Communication between;          ///< mean over the ranks
};

/// One coupling step.
struct CouplingStep {
  unsigned needed = 0;          ///< link::Quantity bits asked for now: a screen drops some, and asks again
  double elapsed = 0;           ///< DEM time since the last coupling step [s]; 0 at the first: nothing advances
  double dem_seconds = 0;       ///< wall-clock time that this rank's DEM took since the last coupling step [s]
  double pack_seconds = 0;      ///< and of packing and unpacking at the last coupling step [s]
  std::int64_t steps_done = 0;  ///< DEM steps of the present run
  std::int64_t steps_total = 0; ///< its length
  std::int64_t number = 0;      ///< counted by the socket link, from 1: what belongs together
  DemTotals totals;             ///< since the run began
  DemLoad load;                 ///< since the last coupling step
};

/// What the fluid side writes before the place of a particle: "particle at (x y z)"; the DEM side puts the id into it.
constexpr const char* kParticleAt = "particle at (";
/// In a refusal of the fluid side whose cause are particles that come or go; the DEM side says which in front of it.
constexpr const char* kVolumeChanged = "the particles do not keep their volume: ";

/// What the fluid side says at a coupling step besides the samples; the same on every rank.
struct StepAnswer {
  int stop_signal = 0; ///< that asks the fluid side to stop, or 0
  std::string news;    ///< sentences for the user, one a line; empty in most cases
};

/// The fluid. All calls are collective over the ranks of DEM, and may throw Refusal (on every rank alike).
class FluidPeer {
 public:
  virtual ~FluidPeer() = default;
  /// States the DEM side's terms and returns the fluid side's; throws Refusal if they disagree.
  virtual FluidTerms agree(const DemTerms& dem) = 0;
  /// States the walls of the DEM script (on rank 0; nothing is read on the others). Returns sentences for the user, one
  /// a line, about walls that one of the two sides has alone; throws Refusal where a wall is another one than that of
  /// the mesh.
  virtual std::string compare_walls(const WallDescription& walls) = 0;
  /// Hands over the particles, advances the flow by `coupling step.elapsed`, and fills the arrays of `samples` (rows as
  /// in `particles`); those that `coupling step.needed` does not name are null.
  virtual StepAnswer couple(const CouplingStep& coupling_step, const ParticleArrays& particles,
                            const FluidSamples& samples) = 0;
  /// With DemTerms::overlap, after a coupling step: DEM begins an interval, and so does the flow, with the particles
  /// and impulses of that coupling step; couple() then only exchanges. Returns at once where the fluid is another job.
  virtual void advance() = 0;
  /// Writes the fluid's state of the last coupling step such that it is on the disk on return, and returns where (for
  /// the user's eyes). The DEM side writes its own after that: a checkpoint of DEM's has one of the fluid's.
  virtual std::string checkpoint(const CheckpointMark& mark) = 0;
  /// The present run of DEM has ended as intended.
  virtual void run_ended() = 0;
};

/// The fluid solver that hosts DEM in this process (link `solver`), or null. Set by that solver.
FluidPeer*& hosting_solver();

} // namespace eccentra::link
