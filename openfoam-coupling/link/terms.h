// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What the two solvers state before they exchange anything, and the rules by which they refuse each other.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace eccentra::link {

/// Raised whenever the layout or the meaning of anything that crosses the link changes.
constexpr std::uint32_t kProtocolVersion = 7;

/// A box aligned with the axes [m] and the directions in which it repeats.
struct Extents {
  double low[3] = {0, 0, 0};                ///< [m]
  double high[3] = {0, 0, 0};               ///< [m]
  bool periodic[3] = {false, false, false}; ///< it repeats along the axis
};

/// A Herschel-Bulkley law as a user states it: tau = yield_stress + consistency rate^index [Pa, Pa s^n, -].
struct FlowCurve {
  double yield_stress = 0.0; ///< [Pa]
  double consistency = 0.0;  ///< 0: this side has no such law to compare
  double index = 0.0;        ///< [-]
};

/// Names one instant of a coupled run: both sides' checkpoints of it bear the same mark.
struct CheckpointMark {
  std::int64_t step = -1; ///< of DEM; negative: none
  std::uint64_t id = 0;   ///< differs between runs that reach the same step
};

/// The DEM side's statement.
struct DemTerms {
  std::uint32_t protocol = kProtocolVersion; ///< must be the same on both sides
  double length_unit = 1.0;                  ///< metres in one unit of length of the script (`units si`: 1)
  double time_step = 0.0;                    ///< of DEM [s]
  std::int64_t interval = 0;                 ///< DEM steps from one coupling step to the next
  std::int64_t particles = 0;                ///< in the whole domain, now
  Extents domain;                            ///< of the simulation box
  unsigned needed = 0;           ///< link::Quantity bits that the closures ask for at the beginning of the run
  bool overlap = false;          ///< the fluid takes its step while DEM runs the same interval
  bool extents = false;          ///< particles come with their extent (clusters), not with their volume alone
  double fluid_density = 0.0;    ///< that the closures were told [kg/m3]; 0: none was
  FlowCurve rheology;            ///< that the closures were told
  double gravity[3] = {0, 0, 0}; ///< that acts on the particles [m/s2]
  CheckpointMark resumes;        ///< the checkpoint that this run goes on from, if any
  std::uint32_t rank_connections =
      0; ///< asked for by the socket link: one for each rank but the first (link/rank connections.h)
};

/// The fluid side's statement.
struct FluidTerms {
  std::uint32_t protocol = kProtocolVersion; ///< must be the same on both sides
  double length_unit = 1.0;                  ///< metres in one unit of length of the mesh
  double time_step = 0.0;                    ///< of one coupling step: what the flow advances by [s]
  Extents domain;                            ///< bounding box of the mesh
  unsigned offered = 0;                      ///< link::Quantity bits that it can compute
  double fluid_density = 0.0;                ///< [kg/m3]
  FlowCurve rheology;                        ///< without the regularisation, which is the solver's own
  bool has_gravity = false;                  ///< constant/g exists; the flow itself needs none
  double gravity[3] = {0, 0, 0};             ///< [m/s2]
  std::uint64_t layout = 0; ///< names the mesh and its division among ranks: cell hint hold for one layout
};

/// One of the two sides, or what lies between them, cannot go on; what() is the one sentence for the user.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The sentence that says why the two cannot work together, or an empty string if they can.
std::string disagreement(const DemTerms& dem, const FluidTerms& fluid);

} // namespace eccentra::link
