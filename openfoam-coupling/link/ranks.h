// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Broadcasts the result of the link from rank 0 to the other ranks of its side, which sleep while they wait.
#pragma once

#include "link/socket/wire.h"

#include <mpi.h>

#include <functional>
#include <vector>

namespace eccentra::link {

/// Waits for a request with short sleeps instead of spinning, because rank 0 may wait for minutes.
void wait_asleep(MPI_Request& request);

/// Number of this rank.
int rank_of(MPI_Comm ranks);
/// Number of ranks.
int size_of(MPI_Comm ranks);

/// Ends a wait when another rank of this side has failed.
using Look = std::function<void()>;
/// Runs `work` on every rank; it calls its Look several times a second while it waits for the other side. Returns the
/// result of each rank. An exception on one rank becomes the same Refusal on every rank: that of the lowest rank that
/// failed by itself. Collective.
std::vector<long long> on_all(MPI_Comm ranks, const std::function<long long(const Look&)>& work);

/// Runs `work` on rank 0, and broadcasts the result. A Refusal there becomes the same Refusal on every rank.
/// Collective.
wire::Bytes on_root(MPI_Comm ranks, const std::function<wire::Bytes()>& work);

/// Numbers of rows per rank, and where each rank's begin.
struct Shares {
  /// By rank.
  std::vector<int> count, begin;
  int total = 0; ///< rows of all ranks
};
/// Gathers the numbers on rank 0 (elsewhere the result is empty). Collective.
Shares gather_shares(MPI_Comm ranks, std::size_t count);
/// As even as possible; the same on every rank.
Shares even_shares(MPI_Comm ranks, std::size_t count);

/// Rows of `row_bytes` from all ranks to rank 0, or from it to all. `shares` and `all` count on rank 0 only, whose own
/// rows are at the beginning of `all` and stay there: its `mine` is not used. Collective.
void gather_rows(MPI_Comm ranks, const std::byte* mine, int count, std::size_t row_bytes, const Shares& shares,
                 std::byte* all);
/// The other of the two.
void scatter_rows(MPI_Comm ranks, const std::byte* all, const Shares& shares, std::size_t row_bytes, std::byte* mine,
                  int count);

} // namespace eccentra::link
