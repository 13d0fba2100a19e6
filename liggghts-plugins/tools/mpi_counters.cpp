// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The calls of MPI that send or wait, counted and timed through MPI's own profiling interface: both solvers communicate
// in many places of their own. Only what a rank computes besides waiting tells whether the load is even, and only
// messages and bytes tell what another network would cost.
#include "link/communication.h"

#include <mpi.h>

namespace {

using eccentra::link::communication;

/// Adds its lifetime to what this rank has waited. Collective calls may be built on others: the outermost one counts.
class Waiting {
 public:
  Waiting() : begun_(depth_++ == 0 ? PMPI_Wtime() : 0) {}
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() {
    if (--depth_ == 0)
      communication().waited += PMPI_Wtime() - begun_;
  }
  static bool inside() { return depth_ > 0; }

 private:
  static int depth_;
  const double begun_;
};
int Waiting::depth_ = 0;

template <class Call, class... Arguments> int timed(Call call, Arguments... arguments) {
  const Waiting waiting;
  return call(arguments...);
}

/// [bytes]; a type that goes with no elements need not be one.
double size_of(double count, MPI_Datatype type) {
  int size = 0;
  return count > 0 && PMPI_Type_size(type, &size) == MPI_SUCCESS ? count * size : 0;
}

double size_of_comm(MPI_Comm comm) {
  int ranks = 0;
  PMPI_Comm_size(comm, &ranks);
  return ranks;
}

void count_message(int count, MPI_Datatype type) {
  if (Waiting::inside())
    return;
  communication().messages += 1;
  communication().bytes += size_of(count, type);
}

void count_operation(double count = 0, MPI_Datatype type = MPI_BYTE) {
  if (Waiting::inside())
    return;
  communication().operations += 1;
  communication().bytes += size_of(count, type);
}

/// Elements that this rank hands over where it names a count of its own, and the other arguments do not hold with
/// MPI_IN_PLACE.
double given(const void* out, double count) {
  return out == MPI_IN_PLACE ? 0 : count;
}

/// As above, with a count for each rank.
double given(const void* out, const int counts[], MPI_Comm comm) {
  if (out == MPI_IN_PLACE)
    return 0;
  double sum = 0;
  for (int rank = 0; rank < size_of_comm(comm); ++rank)
    sum += counts[rank];
  return sum;
}

/// True on the rank whose data go out to all.
bool is_root(int root, MPI_Comm comm) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank == root;
}

} // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name): the names are the MPI library's.
extern "C" {

int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  return timed(PMPI_Wait, request, status);
}
int MPI_Waitall(int count, MPI_Request requests[], MPI_Status statuses[]) {
  return timed(PMPI_Waitall, count, requests, statuses);
}
int MPI_Waitany(int count, MPI_Request requests[], int* index, MPI_Status* status) {
  return timed(PMPI_Waitany, count, requests, index, status);
}
int MPI_Probe(int source, int tag, MPI_Comm comm, MPI_Status* status) {
  return timed(PMPI_Probe, source, tag, comm, status);
}
int MPI_Recv(void* buffer, int count, MPI_Datatype type, int source, int tag, MPI_Comm comm, MPI_Status* status) {
  return timed(PMPI_Recv, buffer, count, type, source, tag, comm, status);
}
int MPI_Send(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_message(count, type);
  return timed(PMPI_Send, buffer, count, type, to, tag, comm);
}
int MPI_Isend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type);
  return PMPI_Isend(buffer, count, type, to, tag, comm, request);
}
int MPI_Irsend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type);
  return PMPI_Irsend(buffer, count, type, to, tag, comm, request);
}
int MPI_Issend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count_message(count, type);
  return PMPI_Issend(buffer, count, type, to, tag, comm, request);
}
int MPI_Rsend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_message(count, type);
  return timed(PMPI_Rsend, buffer, count, type, to, tag, comm);
}
int MPI_Ssend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_message(count, type);
  return timed(PMPI_Ssend, buffer, count, type, to, tag, comm);
}
int MPI_Bsend(const void* buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count_message(count, type);
  return timed(PMPI_Bsend, buffer, count, type, to, tag, comm);
}
int MPI_Sendrecv(const void* out, int out_count, MPI_Datatype out_type, int to, int out_tag, void* in, int in_count,
                 MPI_Datatype in_type, int from, int in_tag, MPI_Comm comm, MPI_Status* status) {
  count_message(out_count, out_type);
  return timed(PMPI_Sendrecv, out, out_count, out_type, to, out_tag, in, in_count, in_type, from, in_tag, comm, status);
}
int MPI_Barrier(MPI_Comm comm) {
  count_operation();
  return timed(PMPI_Barrier, comm);
}
int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  count_operation(is_root(root, comm) ? count : 0, type);
  return timed(PMPI_Bcast, buffer, count, type, root, comm);
}
int MPI_Reduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  count_operation(count, type);
  return timed(PMPI_Reduce, out, in, count, type, op, root, comm);
}
int MPI_Allreduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  count_operation(count, type);
  return timed(PMPI_Allreduce, out, in, count, type, op, comm);
}
int MPI_Scan(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  count_operation(count, type);
  return timed(PMPI_Scan, out, in, count, type, op, comm);
}
int MPI_Gather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
               int root, MPI_Comm comm) {
  count_operation(given(out, out_count), out_type);
  return timed(PMPI_Gather, out, out_count, out_type, in, in_count, in_type, root, comm);
}
int MPI_Gatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int in_counts[],
                const int begins[], MPI_Datatype in_type, int root, MPI_Comm comm) {
  count_operation(given(out, out_count), out_type);
  return timed(PMPI_Gatherv, out, out_count, out_type, in, in_counts, begins, in_type, root, comm);
}
int MPI_Scatter(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                int root, MPI_Comm comm) {
  count_operation(is_root(root, comm) ? size_of_comm(comm) * out_count : 0, out_type);
  return timed(PMPI_Scatter, out, out_count, out_type, in, in_count, in_type, root, comm);
}
int MPI_Scatterv(const void* out, const int out_counts[], const int begins[], MPI_Datatype out_type, void* in,
                 int in_count, MPI_Datatype in_type, int root, MPI_Comm comm) {
  count_operation(is_root(root, comm) ? given(out, out_counts, comm) : 0, out_type);
  return timed(PMPI_Scatterv, out, out_counts, begins, out_type, in, in_count, in_type, root, comm);
}
int MPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                  MPI_Comm comm) {
  count_operation(given(out, out_count), out_type);
  return timed(PMPI_Allgather, out, out_count, out_type, in, in_count, in_type, comm);
}
int MPI_Allgatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int in_counts[],
                   const int begins[], MPI_Datatype in_type, MPI_Comm comm) {
  count_operation(given(out, out_count), out_type);
  return timed(PMPI_Allgatherv, out, out_count, out_type, in, in_counts, begins, in_type, comm);
}
int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                 MPI_Comm comm) {
  count_operation(given(out, size_of_comm(comm) * out_count), out_type);
  return timed(PMPI_Alltoall, out, out_count, out_type, in, in_count, in_type, comm);
}
int MPI_Alltoallv(const void* out, const int out_counts[], const int out_begins[], MPI_Datatype out_type, void* in,
                  const int in_counts[], const int in_begins[], MPI_Datatype in_type, MPI_Comm comm) {
  count_operation(given(out, out_counts, comm), out_type);
  return timed(PMPI_Alltoallv, out, out_counts, out_begins, out_type, in, in_counts, in_begins, in_type, comm);
}
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
