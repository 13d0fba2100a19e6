// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Who waits for the other side sleeps: processor time of both sides of the socket link, two ranks each, while the other
// one takes its time. Run on four ranks.
#include "link/socket/fluid_server.h"
#include "link/socket/socket_peer.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace eccentra;

constexpr int kDemRanks = 2;
constexpr auto kPause = std::chrono::milliseconds(700);
constexpr int kCouplingSteps = 3;
/// Part of the wait that may be spent awake.
constexpr double kAwake = 0.1;

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/// A fluid that sleeps over each step, too, and then has nothing to say.
class SlowFluid : public link::FluidPeer {
 public:
  link::FluidTerms agree(const link::DemTerms& dem) override {
    link::FluidTerms terms;
    terms.time_step = dem.time_step * double(dem.interval);
    terms.domain = dem.domain;
    return terms;
  }
  std::string compare_walls(const link::WallDescription&) override { return ""; }
  link::StepAnswer couple(const link::CouplingStep&, const link::ParticleArrays&, const link::FluidSamples&) override {
    std::this_thread::sleep_for(kPause);
    return {};
  }
  void advance() override {}
  std::string checkpoint(const link::CheckpointMark&) override { return ""; }
  void run_ended() override {}
};

void run_particles(MPI_Comm ranks, const std::string& address) {
  link::SocketPeer fluid(ranks, address, {});
  link::DemTerms terms;
  terms.time_step = 1e-5;
  terms.interval = 100;
  for (double& high : terms.domain.high)
    high = 1;
  fluid.agree(terms);
  for (int n = 0; n < kCouplingSteps; ++n) {
    std::this_thread::sleep_for(kPause);
    fluid.couple({}, {}, {});
  }
}

} // namespace

TEST(Waiting, CostsNoProcessorTime) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  char address[108] = {};
  std::snprintf(address, sizeof address, "%s/eccentra-waiting-%d", std::filesystem::temp_directory_path().c_str(),
                int(getpid()));
  MPI_Bcast(address, sizeof address, MPI_CHAR, 0, MPI_COMM_WORLD);
  const bool dem = rank < kDemRanks;
  MPI_Comm side = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, dem, rank, &side);
  const double cpu = cpu_seconds(), begun = MPI_Wtime();
  if (dem) {
    run_particles(side, address);
  } else {
    SlowFluid fluid;
    link::FluidServer(side, std::string(address), {}, 1).serve(fluid);
  }
  const double wall = MPI_Wtime() - begun;
  EXPECT_LT(cpu_seconds() - cpu, kAwake * wall) << "of " << wall << " s, rank " << rank;
  EXPECT_GT(wall, kCouplingSteps * std::chrono::duration<double>(kPause).count());
  MPI_Comm_free(&side);
}
