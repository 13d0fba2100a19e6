// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// What this rank has sent to other ranks through MPI, and the time that it has waited for them; the rest of its
// wall-clock time is computing.
#pragma once

namespace eccentra::link {

/// Counted by liggghts-plugins/tools/mpi_counters.cpp, which is loaded before the MPI library in eccentra-dem and
/// annulusFoam. In other programs all are 0.
struct Communication {
  double waited = 0;     ///< wall-clock time in calls of MPI that wait [s]
  double messages = 0;   ///< sent to one rank
  double operations = 0; ///< of all ranks, in which this one took part: sums, gatherings, barriers
  double bytes = 0;      ///< of the messages, and of what was handed to the operations

  /// Number by number.
  Communication& operator+=(const Communication& more) {
    waited += more.waited;
    messages += more.messages;
    operations += more.operations;
    bytes += more.bytes;
    return *this;
  }
  /// What was counted since `less` was.
  Communication operator-(const Communication& less) const {
    return {waited - less.waited, messages - less.messages, operations - less.operations, bytes - less.bytes};
  }
};

/// Of this process since its start; no number ever decreases.
Communication& communication();

} // namespace eccentra::link
