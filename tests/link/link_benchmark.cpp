// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Time of one meeting over the socket link alone: rank 0 is the DEM side, rank 1 a fluid that answers at once.
#include "link/fluid_server.h"
#include "link/socket_peer.h"
#include "link/wire.h"

#include <mpi.h>

#include <sys/resource.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace eccentra;

constexpr int kMeetings = 200;
constexpr std::size_t kParticles = 30000;
constexpr unsigned kAsked = fluid::kVelocity | fluid::kFraction | fluid::kPressureGradient;

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
  int meet(const link::Meeting&, const link::ParticleArrays& particles, const fluid::FluidSamples& samples) override {
    for (std::size_t i = 0; i < particles.count; ++i)
      samples.fraction[i] = particles.position[i][0];
    return 0;
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

/// Wall-clock times of the meetings [s], sorted; empty if an answer was wrong.
std::vector<double> times_of_meetings(link::FluidPeer& fluid, std::size_t count, bool extents) {
  std::vector<double> position(3 * count), volume(count, 1e-7), vector(3 * count), fraction(count), extent(9 * count);
  std::vector<link::Ticket> tickets(count);
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
  particles.ticket = tickets.data();
  std::vector<double> velocity(3 * count), gradient(3 * count);
  fluid::FluidSamples samples;
  samples.velocity = reinterpret_cast<Vectors>(velocity.data());
  samples.fraction = fraction.data();
  samples.pressure_gradient = reinterpret_cast<Vectors>(gradient.data());
  link::DemTerms terms;
  terms.time_step = 1e-5;
  terms.interval = 100;
  terms.needed = kAsked;
  terms.extents = extents;
  for (double& high : terms.domain.high)
    high = 1;
  fluid.agree(terms);
  link::Meeting meeting;
  meeting.needed = kAsked;
  meeting.totals.particles = static_cast<std::int64_t>(count);
  std::vector<double> seconds;
  for (int n = 0; n < kMeetings; ++n) {
    const double begun = MPI_Wtime();
    fluid.meet(meeting, particles, samples);
    seconds.push_back(MPI_Wtime() - begun);
  }
  for (std::size_t i = 0; i < count; ++i)
    if (fraction[i] != position[3 * i])
      return {};
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

} // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0, size = 0, failed = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const long count = argc > 1 ? std::strtol(argv[1], nullptr, 10) : static_cast<long>(kParticles);
  if (size != 2 || count < 1) {
    std::fprintf(stderr, "usage: mpirun -np 2 link_benchmark [PARTICLES]\n");
    MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  }
  for (const bool extents : {false, true}) {
    char path[64] = {};
    std::snprintf(path, sizeof path, "/tmp/eccentra-link-benchmark-%d-%d", int(getpid()), int(extents));
    MPI_Bcast(path, sizeof path, MPI_CHAR, 0, MPI_COMM_WORLD);
    const double begun = cpu_seconds();
    if (rank == 1) {
      PromptFluid fluid;
      link::FluidServer(MPI_COMM_SELF, path, {}, 1).serve(fluid);
      const double used = cpu_seconds() - begun;
      MPI_Send(&used, 1, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD);
      continue;
    }
    std::vector<double> seconds;
    {
      link::SocketPeer fluid(MPI_COMM_SELF, path, {});
      seconds = times_of_meetings(fluid, count, extents);
    }
    const double mine = cpu_seconds() - begun;
    double others = 0;
    MPI_Recv(&others, 1, MPI_DOUBLE, 1, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    failed += seconds.empty();
    if (!seconds.empty())
      std::printf("%ld particles%s, %zu + %zu bytes each: median %.3f ms, fastest %.3f ms, slowest %.3f ms; "
                  "processor time of both sides %.3f ms\n",
                  count, extents ? " with extents" : "", link::wire::particle_row_bytes(extents),
                  link::wire::samples_row_bytes(kAsked), 1e3 * seconds[seconds.size() / 2], 1e3 * seconds.front(),
                  1e3 * seconds.back(), 1e3 * (mine + others) / kMeetings);
  }
  MPI_Finalize();
  return failed;
}
