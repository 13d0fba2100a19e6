// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Particles cross from the ranks of DEM to the ranks of the mesh.
#include "exchange/particlePoints.H"

#include "boundBox.H"
#include "mathematicalConstants.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eccentra::exchange {
namespace {

/// A point further behind a wall than this, in units of the cube root of the cell's volume, is searched for next time.
constexpr double kTrustedDepth = 1.0;
constexpr int kNotEntering = -1;
/// Particles between the one whose walk begins and the one whose cell is fetched from memory meanwhile.
constexpr std::size_t kAhead = 6;

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

particlePoints::particlePoints(const Foam::fvMesh& mesh)
    : mesh_(mesh), walk_(mesh), boxes_(Foam::Pstream::nProcs()),
      rank_(Foam::Pstream::parRun() ? Foam::Pstream::myProcNo() : 0), outgoing_(boxes_.size()) {
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

void particlePoints::searchAll(const link::ParticleArrays& particles) {
  std::vector<std::vector<Query>> queries(boxes_.size());
  searched_ = 0;
  for (std::size_t row = 0; row < particles.count; ++row) {
    if (particles.cell_hint[row].rank >= 0)
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
        particles.cell_hint[finding.row] = {static_cast<int>(r), finding.cell};
      }
    }
}

void particlePoints::invite(const link::ParticleArrays& particles, VoidFraction method, double width) {
  searchAll(particles);
  astray_ = 0;
  here_.clear();
  here_.reserve(particles.count);
  std::vector<DepositionPoint> points;
  for (std::size_t row = 0; row < particles.count; ++row) {
    walk_.prefetch(particles.cell_hint[std::min(row + kAhead, particles.count - 1)].cell);
    depositionPoints(method, particles.volume[row], particles.extent ? particles.extent[row] : nullptr, width, points);
    const bool centreOnly = points.size() == 1;
    if (!centreOnly)
      points.push_back({{0, 0, 0}, 0.0});
    const double* x = particles.position[row];
    const double* impulse = particles.impulse[row];
    const double radius = std::cbrt(particles.volume[row] * (0.75 / Foam::constant::mathematical::pi));
    const link::CellHint cell_hint = particles.cell_hint[row];
    for (const DepositionPoint& point : points) {
      // Made where it stays in most cases.
      ParticlePoint& particlePoint = here_.emplace_back();
      const double weight = point.weight;
      for (int k = 0; k < 3; ++k) {
        particlePoint.at.position[k] = x[k] + point.offset[k];
        particlePoint.impulse[k] = weight * impulse[k];
      }
      particlePoint.at.cell = cell_hint.cell;
      particlePoint.volume = weight * particles.volume[row];
      particlePoint.drag = weight * particles.drag_coefficient[row];
      particlePoint.weight = weight;
      particlePoint.row = static_cast<int>(row);
      particlePoint.homeRank = rank_;
      particlePoint.radius = static_cast<float>(radius);
      particlePoint.centre = centreOnly || weight == 0.0;
      if (cell_hint.rank != rank_) {
        outgoing_[cell_hint.rank].push_back({particlePoint, kNotEntering, 0});
        here_.pop_back();
      } else
        receive(walk_.walk(particlePoint.at));
    }
  }
  if (Foam::Pstream::parRun())
    settle();
}

void particlePoints::receive(const WalkEnd& end) {
  ParticlePoint& particlePoint = here_.back();
  if (end.found) {
    particlePoint.outside = end.outside > kTrustedDepth * walk_.cellSize(particlePoint.at.cell);
    particlePoint.astray =
        particlePoint.centre && end.outside > kBehindWall * particlePoint.radius && isAstray(particlePoint);
    astray_ += particlePoint.astray;
  } else {
    outgoing_[end.nextRank].push_back({particlePoint, end.nextPatch, end.nextFace});
    here_.pop_back();
  }
}

bool particlePoints::isAstray(const ParticlePoint& particlePoint) const {
  if (depths_.empty())
    return false;
  double depth = 0;
  const AllowedDepth& allowed = depths_[walk_.deepestPatch(particlePoint.at, depth)];
  // Where the domain bends back a walk may end beside a wall and yet short of its point.
  return depth > allowed.fixed + allowed.perRadius * particlePoint.radius && !walk_.holds(particlePoint.at);
}

std::vector<Outlier> particlePoints::outside() const {
  std::vector<Outlier> all;
  for (const ParticlePoint& particlePoint : here_) {
    if (!particlePoint.astray)
      continue;
    Outlier one;
    std::copy_n(particlePoint.at.position, 3, one.position.begin());
    one.patch = walk_.deepestPatch(particlePoint.at, one.depth);
    all.push_back(one);
  }
  return all;
}

void particlePoints::settle() {
  for (;;) {
    int travelling = 0;
    for (const auto& list : outgoing_)
      travelling |= !list.empty();
    MPI_Allreduce(MPI_IN_PLACE, &travelling, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (!travelling)
      return;
    const Arrivals<MigratedParticle> arrived = send(outgoing_);
    for (auto& list : outgoing_)
      list.clear();
    for (std::size_t from = 0; from < boxes_.size(); ++from)
      for (int i = arrived.begin[from]; i < arrived.begin[from + 1]; ++i) {
        const MigratedParticle& migratedParticle = arrived.rows[i];
        ParticlePoint& particlePoint = here_.emplace_back(migratedParticle.particlePoint);
        receive(migratedParticle.enterPatch == kNotEntering
                    ? walk_.walk(particlePoint.at)
                    : walk_.enter(particlePoint.at, static_cast<int>(from), migratedParticle.enterPatch,
                                  migratedParticle.enterFace));
      }
  }
}

} // namespace eccentra::exchange
