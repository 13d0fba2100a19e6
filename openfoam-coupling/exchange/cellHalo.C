// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages without waiting in between.
#include "exchange/cellHalo.H"

#include "exchange/sharedPatches.H"

#include <algorithm>

namespace eccentra::exchange {

namespace {
/// Messages of nobody else in this program have it.
constexpr int kTag = 4711;
/// Doubles in one message: MPI libraries hand over short messages (4 kB with Open MPI, headers included) at once, while
/// a longer one goes on only when both sides are in a call, which they are not while they compute.
constexpr int kMessage = 480;
} // namespace

cellHalo::cellHalo(const Foam::fvMesh& mesh, const Foam::boolList& wanted) {
  const auto shared = sharedPatches(mesh);
  for (std::size_t rank = 0; rank < shared.size(); ++rank) {
    const auto begin = static_cast<Foam::label>(faces_.size());
    for (const Foam::label patchi : shared[rank]) {
      const Foam::polyPatch& patch = mesh.boundaryMesh()[patchi];
      for (Foam::label face = patch.start(); face < patch.start() + patch.size(); ++face)
        if (wanted[face - mesh.nInternalFaces()])
          faces_.push_back(face);
    }
    const auto count = static_cast<Foam::label>(faces_.size()) - begin;
    if (count > 0)
      neighbours_.push_back({static_cast<int>(rank), begin, count});
  }
  outgoing_.resize(faces_.size() * kWide);
  incoming_.resize(faces_.size() * kWide);
}

template <int width>
void cellHalo::send(const FieldBundle<width>& fields, const std::vector<Foam::label>& at, int used) {
  requests_.clear();
  const auto forMessages = [&](auto visit) {
    for (const Neighbour& other : neighbours_)
      for (int begin = other.begin * used, left = other.count * used; left > 0; begin += kMessage, left -= kMessage)
        visit(begin, std::min(left, kMessage), other.rank, &requests_.emplace_back());
  };
  forMessages([&](int begin, int count, int rank, MPI_Request* request) {
    MPI_Irecv(&incoming_[begin], count, MPI_DOUBLE, rank, kTag, MPI_COMM_WORLD, request);
  });
  double* out = outgoing_.data();
  for (const Foam::label place : at)
    for (int k = 0; k < used; ++k)
      *out++ = fields[place].at[k];
  forMessages([&](int begin, int count, int rank, MPI_Request* request) {
    MPI_Isend(&outgoing_[begin], count, MPI_DOUBLE, rank, kTag, MPI_COMM_WORLD, request);
  });
}

const double* cellHalo::values() {
  if (!requests_.empty())
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  return incoming_.data();
}

template void cellHalo::send(const FieldBundle<kNarrow>&, const std::vector<Foam::label>&, int);
template void cellHalo::send(const FieldBundle<kWide>&, const std::vector<Foam::label>&, int);

} // namespace eccentra::exchange
