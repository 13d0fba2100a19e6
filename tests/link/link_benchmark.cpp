// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one coupling step over the socket link alone: the first ranks are the DEM side, the others a fluid that
// answers at once.
#include "link/socket/fluid_server.h"
#include "link/socket/socket_peer.h"
#include "link/socket/wire.h"
#include "link/start_mpi.h"

#include <mpi.h>

#include <sys/resource.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace eccentra;
using Rows = link::SocketPeer::Rows;

constexpr int kCouplingSteps = 200;
constexpr std::size_t kParticles = 30000;
constexpr unsigned kAsked = link::kVelocity | link::kFraction | link::kPressureGradient;

/// Answers with numbers that tell the particles apart.
class PromptFluid : public link::FluidPeer {
 public:
  link::FluidTerms agree(const link::DemTerms& dem) override {
    link::FluidTerms terms;
    terms.time_step = dem.time_step * dem.interval;
    terms.domain = dem.domain;
    terms.offered = dem.needed;
    return terms;
  }
  std::string compare_walls(const link::WallDescription&) override { return ""; }
  link::StepAnswer couple(const link::CouplingStep&, const link::ParticleArrays& particles,
                          const link::FluidSamples& samples) override {
    for (std::size_t i = 0; i < particles.count; ++i)
      samples.fraction()[i] = particles.position[i][0];
    return {};
  }
  void advance() override {}
  std::string checkpoint(const link::CheckpointMark&) override { return ""; }
  void run_ended() override {}
};

/// Of all threads of this process, the kernel's work for it included [s].
double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// Wall-clock times of the coupling steps [s], sorted; empty if an answer was wrong.
std::vector<double> times_of_coupling_steps(link::FluidPeer& fluid, std::size_t count, std::size_t total,
                                            bool extents) {
  std::vector<double> position(3 * count), volume(count, 1e-7), vector(3 * count), fraction(count), extent(9 * count);
  std::vector<link::CellHint> cell_hints(count);
  for (std::size_t i = 0; i < count; ++i)
    position[3 * i] = double(i) / double(count);
  using Vectors = double(*)[3];
  link::ParticleArrays particles;
  particles.count = count;
  particles.position = reinterpret_cast<Vectors>(position.data());
  particles.volume = volume.data();
  particles.impulse = reinterpret_cast<Vectors>(vector.data());
  particles.drag_coefficient = volume.data();
  particles.extent = extents ? reinterpret_cast<const double(*)[link::kExtentDoubles]>(extent.data()) : nullptr;
  particles.cell_hint = cell_hints.data();
  std::vector<double> velocity(3 * count), gradient(3 * count);
  link::FluidSamples samples;
  samples[link::kVelocity] = velocity.data();
  samples[link::kFraction] = fraction.data();
  samples[link::kPressureGradient] = gradient.data();
  link::DemTerms terms;
  terms.time_step = 1e-5;
  terms.interval = 100;
  terms.needed = kAsked;
  terms.extents = extents;
  for (double& high : terms.domain.high)
    high = 1;
  fluid.agree(terms);
  link::CouplingStep coupling_step;
  coupling_step.needed = kAsked;
  coupling_step.totals.particles = static_cast<std::int64_t>(total);
  std::vector<double> seconds;
  for (int n = 0; n < kCouplingSteps; ++n) {
    const double begun = MPI_Wtime();
    fluid.couple(coupling_step, particles, samples);
    seconds.push_back(MPI_Wtime() - begun);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (fraction[i] != position[3 * i])
      return {};
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

struct Words {
  long particles = static_cast<long>(kParticles), dem_ranks = 1;
};

/// Nothing where they make no sense.
std::optional<Words> read(int argc, char** argv) {
  Words arguments;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word != "--particles" && word != "--dem-ranks")
      return {};
    (word == "--particles" ? arguments.particles : arguments.dem_ranks) = std::strtol(argv[i + 1], nullptr, 10);
  }
  if (argc % 2 == 0 || arguments.particles < 1 || arguments.dem_ranks < 1)
    return {};
  return arguments;
}

/// One side's work; on rank 0 of DEM the sorted times.
std::vector<double> couple(bool dem, MPI_Comm side, const char* path, const Words& arguments, bool extents, Rows way) {
  if (!dem) {
    PromptFluid fluid;
    link::FluidServer(side, std::string(path), {}, 1).serve(fluid);
    return {};
  }
  int rank = 0;
  MPI_Comm_rank(side, &rank);
  const long begin = arguments.particles * rank / arguments.dem_ranks,
             end = arguments.particles * (rank + 1) / arguments.dem_ranks;
  link::SocketPeer fluid(side, std::string(path), {}, way);
  return times_of_coupling_steps(fluid, end - begin, arguments.particles, extents);
}

/// Prints what a coupling step takes. Returns 1 on rank 0 if an answer was wrong.
int measure(bool dem, MPI_Comm side, const Words& arguments, bool extents, Rows way) {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const bool rank_connections = arguments.dem_ranks > 1 && way == Rows::on_rank_connections;
  char path[64] = {};
  std::snprintf(path, sizeof path, "/tmp/eccentra-link-benchmark-%d-%d%d", int(getpid()), int(extents),
                int(rank_connections));
  MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
  const double begun = cpu_seconds();
  const std::vector<double> seconds = couple(dem, side, path, arguments, extents, way);
  const double mine = cpu_seconds() - begun;
  double all = 0;
  MPI_Reduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  if (rank != 0)
    return 0;
  if (seconds.empty())
    return 1;
  const double through_root = double(arguments.particles) / (rank_connections ? double(arguments.dem_ranks) : 1.0);
  const std::size_t there = link::wire::particle_row_bytes(extents), back = link::wire::samples_row_bytes(kAsked);
  std::printf(
      "%ld particles%s, %ld + %ld ranks, %s: median %.3f ms, fastest %.3f ms, slowest %.3f ms, %.0f ns a "
      "particle; processor time of all ranks %.3f ms; %zu + %zu bytes a particle, %.1f kB a coupling step from and to "
      "rank 0 of DEM\n",
      arguments.particles, extents ? " with extents" : "", arguments.dem_ranks, size - arguments.dem_ranks,
      rank_connections ? "on lanes" : "over rank 0", 1e3 * seconds[seconds.size() / 2], 1e3 * seconds.front(),
      1e3 * seconds.back(), 1e9 * seconds[seconds.size() / 2] / double(arguments.particles), 1e3 * all / kCouplingSteps,
      there, back, 1e-3 * through_root * double(there + back));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  eccentra::link::start_mpi(&argc, &argv);
  int rank = 0, size = 0, failed = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const std::optional<Words> arguments = read(argc, argv);
  if (!arguments || arguments->dem_ranks >= size) {
    std::fprintf(
        stderr, "usage: mpirun -np N link_benchmark [--particles COUNT] [--dem-ranks D]   (D < N; default 30000, 1)\n");
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  const bool dem = rank < arguments->dem_ranks;
  MPI_Comm side = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, dem, rank, &side);
  for (const bool extents : {false, true})
    for (const Rows way : {Rows::on_rank_connections, Rows::over_root})
      if (arguments->dem_ranks > 1 || way == Rows::on_rank_connections)
        failed += measure(dem, side, *arguments, extents, way);
  MPI_Comm_free(&side);
  MPI_Finalize();
  return failed;
}
