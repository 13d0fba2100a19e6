// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles cross from the ranks of DEM to the ranks of the mesh.
#include "guests.H"

#include "boundBox.H"

#include <cmath>
#include <limits>

namespace eccentra::exchange {
namespace {

/// A point further behind a wall than this, in units of the cube root of the cell's volume, is searched for next time.
constexpr double kTrustedDepth = 1.0;
constexpr int kNotEntering = -1;

struct Query {
  double position[3];
  int row;
};
struct Finding {
  int row;
  int cell;
  double distanceSqr;
};

bool contains(const std::array<double, 6>& box, const double* x) {
  for (int k = 0; k < 3; ++k)
    if (x[k] < box[k] || x[k] > box[3 + k])
      return false;
  return true;
}

} // namespace

guests::guests(const Foam::fvMesh& mesh) : mesh_(mesh), walk_(mesh), boxes_(Foam::Pstream::nProcs()) {
  const Foam::boundBox box(mesh.points(), false);
  std::array<double, 6> mine;
  for (int k = 0; k < 3; ++k) {
    mine[k] = mesh.nCells() ? box.min()[k] : std::numeric_limits<double>::max();
    mine[3 + k] = mesh.nCells() ? box.max()[k] : -std::numeric_limits<double>::max();
  }
  boxes_[0] = mine;
  if (Foam::Pstream::parRun())
    MPI_Allgather(mine.data(), 6, MPI_DOUBLE, boxes_[0].data(), 6, MPI_DOUBLE, MPI_COMM_WORLD);
}

void guests::searchAll(const link::ParticleArrays& particles) {
  std::vector<std::vector<Query>> queries(boxes_.size());
  searched_ = 0;
  for (std::size_t row = 0; row < particles.count; ++row) {
    if (particles.ticket[row].rank >= 0)
      continue;
    ++searched_;
    const double* x = particles.position[row];
    const Query query{{x[0], x[1], x[2]}, static_cast<int>(row)};
    bool asked = false;
    for (std::size_t r = 0; r < boxes_.size(); ++r)
      if (contains(boxes_[r], x)) {
        queries[r].push_back(query);
        asked = true;
      }
    // Outside all boxes (a particle that bulges out of the mesh): whoever has the nearest cell.
    for (std::size_t r = 0; r < boxes_.size() && !asked; ++r)
      queries[r].push_back(query);
  }
  long anyone = static_cast<long>(searched_);
  if (Foam::Pstream::parRun())
    MPI_Allreduce(MPI_IN_PLACE, &anyone, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  if (anyone == 0)
    return;
  const Arrivals<Query> asked = send(queries);
  std::vector<std::vector<Finding>> findings(boxes_.size());
  for (std::size_t r = 0; r < boxes_.size(); ++r)
    for (int i = asked.begin[r]; i < asked.begin[r + 1]; ++i) {
      const Query& query = asked.rows[i];
      Finding finding{query.row, -1, 0};
      finding.cell = walk_.nearestCell({query.position[0], query.position[1], query.position[2]}, finding.distanceSqr);
      findings[r].push_back(finding);
    }
  const Arrivals<Finding> found = send(findings);
  std::vector<double> nearest(particles.count, std::numeric_limits<double>::max());
  for (std::size_t r = 0; r < boxes_.size(); ++r)
    for (int i = found.begin[r]; i < found.begin[r + 1]; ++i) {
      const Finding& finding = found.rows[i];
      if (finding.cell >= 0 && finding.distanceSqr < nearest[finding.row]) {
        nearest[finding.row] = finding.distanceSqr;
        particles.ticket[finding.row] = {static_cast<int>(r), finding.cell};
      }
    }
}

void guests::invite(const link::ParticleArrays& particles, VoidFraction method, double width) {
  searchAll(particles);
  std::vector<std::vector<Guest>> outgoing(boxes_.size());
  std::vector<DepositionPoint> points;
  if (outgoing.size() == 1)
    outgoing[0].reserve(particles.count);
  for (std::size_t row = 0; row < particles.count; ++row) {
    depositionPoints(method, particles.volume[row], particles.extent ? particles.extent[row] : nullptr, width, points);
    const bool centreOnly = points.size() == 1;
    if (!centreOnly)
      points.push_back({{0, 0, 0}, 0.0});
    const double* x = particles.position[row];
    const link::Ticket ticket = particles.ticket[row];
    for (const DepositionPoint& point : points) {
      Guest guest{};
      for (int k = 0; k < 3; ++k) {
        guest.at.position[k] = x[k] + point.offset[k];
        guest.impulse[k] = point.weight * particles.impulse[row][k];
      }
      guest.at.cell = ticket.cell;
      guest.volume = point.weight * particles.volume[row];
      guest.drag = point.weight * particles.drag_coefficient[row];
      guest.weight = point.weight;
      guest.row = static_cast<int>(row);
      guest.homeRank = Foam::Pstream::parRun() ? Foam::Pstream::myProcNo() : 0;
      guest.centre = centreOnly || point.weight == 0.0;
      guest.enterPatch = kNotEntering;
      outgoing[ticket.rank].push_back(guest);
    }
  }
  settle(outgoing);
}

void guests::settle(std::vector<std::vector<Guest>>& outgoing) {
  here_.clear();
  for (;;) {
    const Arrivals<Guest> arrived = send(outgoing);
    here_.reserve(here_.size() + arrived.rows.size());
    for (auto& list : outgoing)
      list.clear();
    int travelling = 0;
    for (std::size_t from = 0; from < boxes_.size(); ++from)
      for (int i = arrived.begin[from]; i < arrived.begin[from + 1]; ++i) {
        Guest guest = arrived.rows[i];
        const WalkEnd end = guest.enterPatch == kNotEntering
                                ? walk_.walk(guest.at)
                                : walk_.enter(guest.at, static_cast<int>(from), guest.enterPatch, guest.enterFace);
        if (end.found) {
          guest.outside = end.outside > kTrustedDepth * walk_.cellSize(guest.at.cell);
          here_.push_back(guest);
        } else {
          guest.enterPatch = end.nextPatch;
          guest.enterFace = end.nextFace;
          outgoing[end.nextRank].push_back(guest);
          travelling = 1;
        }
      }
    if (Foam::Pstream::parRun())
      MPI_Allreduce(MPI_IN_PLACE, &travelling, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (!travelling)
      return;
  }
}

void guests::stampTickets(link::Ticket* tickets) const {
  answer(
      2, 0,
      [](const Guest& guest, double* values) {
        if (guest.centre) {
          values[0] = guest.outside ? -1 : (Foam::Pstream::parRun() ? Foam::Pstream::myProcNo() : 0);
          values[1] = guest.at.cell;
        }
      },
      [tickets](int row, const double* centre, const double*) {
        if (centre)
          tickets[row] = {static_cast<int>(centre[0]), static_cast<int>(centre[1])};
      });
}

} // namespace eccentra::exchange
