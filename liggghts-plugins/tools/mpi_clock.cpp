// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The calls of MPI that wait for other ranks, timed through MPI's own profiling interface: both solvers wait in many
// places of their own, and only what a rank computes besides tells whether the load is even.
#include "link/waiting.h"

#include <mpi.h>

namespace {

/// Adds its lifetime to what this rank has waited. Collective calls may be built on others: the outermost one counts.
class Waiting {
 public:
  Waiting() : begun_(depth_++ == 0 ? PMPI_Wtime() : 0) {}
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
  ~Waiting() {
    if (--depth_ == 0)
      eccentra::link::waiting_seconds() += PMPI_Wtime() - begun_;
  }

 private:
  static int depth_;
  const double begun_;
};
int Waiting::depth_ = 0;

template <class Call, class... Arguments> int timed(Call call, Arguments... arguments) {
  const Waiting waiting;
  return call(arguments...);
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
  return timed(PMPI_Send, buffer, count, type, to, tag, comm);
}
int MPI_Sendrecv(const void* out, int out_count, MPI_Datatype out_type, int to, int out_tag, void* in, int in_count,
                 MPI_Datatype in_type, int from, int in_tag, MPI_Comm comm, MPI_Status* status) {
  return timed(PMPI_Sendrecv, out, out_count, out_type, to, out_tag, in, in_count, in_type, from, in_tag, comm, status);
}
int MPI_Barrier(MPI_Comm comm) {
  return timed(PMPI_Barrier, comm);
}
int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  return timed(PMPI_Bcast, buffer, count, type, root, comm);
}
int MPI_Reduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm) {
  return timed(PMPI_Reduce, out, in, count, type, op, root, comm);
}
int MPI_Allreduce(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  return timed(PMPI_Allreduce, out, in, count, type, op, comm);
}
int MPI_Scan(const void* out, void* in, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  return timed(PMPI_Scan, out, in, count, type, op, comm);
}
int MPI_Gather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
               int root, MPI_Comm comm) {
  return timed(PMPI_Gather, out, out_count, out_type, in, in_count, in_type, root, comm);
}
int MPI_Gatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int in_counts[],
                const int begins[], MPI_Datatype in_type, int root, MPI_Comm comm) {
  return timed(PMPI_Gatherv, out, out_count, out_type, in, in_counts, begins, in_type, root, comm);
}
int MPI_Scatter(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                int root, MPI_Comm comm) {
  return timed(PMPI_Scatter, out, out_count, out_type, in, in_count, in_type, root, comm);
}
int MPI_Scatterv(const void* out, const int out_counts[], const int begins[], MPI_Datatype out_type, void* in,
                 int in_count, MPI_Datatype in_type, int root, MPI_Comm comm) {
  return timed(PMPI_Scatterv, out, out_counts, begins, out_type, in, in_count, in_type, root, comm);
}
int MPI_Allgather(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                  MPI_Comm comm) {
  return timed(PMPI_Allgather, out, out_count, out_type, in, in_count, in_type, comm);
}
int MPI_Allgatherv(const void* out, int out_count, MPI_Datatype out_type, void* in, const int in_counts[],
                   const int begins[], MPI_Datatype in_type, MPI_Comm comm) {
  return timed(PMPI_Allgatherv, out, out_count, out_type, in, in_counts, begins, in_type, comm);
}
int MPI_Alltoall(const void* out, int out_count, MPI_Datatype out_type, void* in, int in_count, MPI_Datatype in_type,
                 MPI_Comm comm) {
  return timed(PMPI_Alltoall, out, out_count, out_type, in, in_count, in_type, comm);
}
int MPI_Alltoallv(const void* out, const int out_counts[], const int out_begins[], MPI_Datatype out_type, void* in,
                  const int in_counts[], const int in_begins[], MPI_Datatype in_type, MPI_Comm comm) {
  return timed(PMPI_Alltoallv, out, out_counts, out_begins, out_type, in, in_counts, in_begins, in_type, comm);
}
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)
