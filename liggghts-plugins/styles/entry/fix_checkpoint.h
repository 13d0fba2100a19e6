// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Fix style checkpoint/state, which `resumable` and fix fluid/couple add: what LIGGGHTS's restart file lacks for going
// on with the same digits, and the checkpoints of scripts without a fluid.
#pragma once

#include "link/terms.h"
#include "styles/entry/dem_checkpoint.h"

#include "fix.h"

#include <cstdint>
#include <string>
#include <vector>

namespace eccentra::styles {

class FixCheckpoint : public LAMMPS_NS::Fix {
 public:
  FixCheckpoint(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);
  ~FixCheckpoint() override;

  /// The script's one, or null.
  static FixCheckpoint* find(LAMMPS_NS::LAMMPS* lmp);
  /// Adds it unless it is there. `every`: steps; 0: by the clock.
  static void add(LAMMPS_NS::LAMMPS* lmp, std::int64_t every);

  /// Between the two, a restart file is half of a checkpoint.
  void begin_checkpoint() { writing_ = true; }
  void end_checkpoint() { writing_ = false; }
  /// Before a run writes anything: what earlier runs have written is not lost.
  void make_room();

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void end_of_step() override;

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

 private:
  /// Force and torque with which a run goes on; then the step at which fix insert/stream lets the body go, or 0.
  struct Resumed {
    double values[7];
  };
  [[noreturn]] void refuse(const std::string& text);
  bool resuming() const { return resumed_step_ >= 0; }
  void restore();

  std::int64_t every_ = 0; ///< steps; 0: by the clock
  std::int64_t grid_;      ///< steps; at its multiples neighbours are listed anew, and a checkpoint may be written
  bool alone_ = false;     ///< no fix fluid/couple writes checkpoints
  bool writing_ = false;
  int stop_ = 0;     ///< signal
  bool due_ = false; ///< at the end of the present step
  CheckpointClock clock_;
  std::int64_t resumed_step_ = -1;
  double resumed_time_step_ = 0;
  std::string states_;           ///< of random number generators of this rank, while resuming
  std::vector<Resumed> resumed_; ///< per atom, while resuming
};

} // namespace eccentra::styles
