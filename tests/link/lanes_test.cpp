// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Each rank's particles travel on a connection of their own, whatever the numbers of ranks; where there is none all
// travel over rank 0 with the same result; a rank connection that fails ends all ranks of a side with one sentence. Run
// on five ranks.
#include "link/lane_sides.h"
#include "link/socket/keys.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace eccentra;
using namespace eccentra::test;
namespace fs = std::filesystem;
using link::wire::Kind;

constexpr int kCouplingSteps = 3;
/// Until a fault is noticed [s], and how fast it is where a connection closes.
constexpr double kNotice = 5.0, kAtOnce = 2.0;
/// That a fluid side bears where somebody does not come [s].
constexpr double kSilence = 2.0;

/// Particles of a rank of DEM: none on the second.
std::size_t count_of(int rank) {
  return rank == 1 ? 0 : 40 + 7 * rank;
}

std::size_t bytes_of_coupling_step(bool root, std::size_t count) {
  using namespace link::wire;
  return 2 * kHeaderBytes + (root ? kCouplingStepBytes : kRowsBytes) + kSamplesBytes +
         count * (particle_row_bytes(false) + samples_row_bytes(kAsked));
}

using Rows = link::SocketPeer::Rows;

/// Meets several times, and checks what comes back and how much has travelled. Returns why all went over rank 0.
std::string run_particles(MPI_Comm ranks, const link::Address& address, Rows rows) {
  const int rank = link::rank_of(ranks);
  Flock flock(count_of(rank), rank);
  std::size_t all = 0;
  for (int r = 0; r < link::size_of(ranks); ++r)
    all += count_of(r);
  link::SocketPeer peer(ranks, address, {}, rows);
  const bool twice_agreed = peer.agree(some_terms()).offered == peer.agree(some_terms()).offered;
  EXPECT_TRUE(twice_agreed);
  link::CouplingStep coupling_step;
  coupling_step.needed = kAsked;
  coupling_step.totals.particles = static_cast<std::int64_t>(all);
  const bool rank_connections = peer.why_over_root().empty();
  for (int n = 0; n < kCouplingSteps; ++n) {
    const std::uint64_t before = peer.bytes();
    EXPECT_EQ(peer.couple(coupling_step, flock.arrays(), flock.samples()).stop_signal, 15);
    if (rank_connections)
      EXPECT_EQ(peer.bytes() - before, bytes_of_coupling_step(rank == 0, count_of(rank))) << "of rank " << rank;
    else
      EXPECT_EQ(peer.bytes() - before, rank == 0 ? bytes_of_coupling_step(true, all) : 0) << "of rank " << rank;
    EXPECT_EQ(flock.velocity, flock.position);
    for (const double heard_of : flock.fraction)
      EXPECT_EQ(heard_of, double(all));
    for (const link::CellHint& cell_hint : flock.cell_hint)
      EXPECT_GE(cell_hint.rank, 0);
    flock.velocity.assign(flock.velocity.size(), 0);
  }
  return peer.why_over_root();
}

/// Both sides; on ranks of DEM why all went over rank 0.
std::string run_both(int dem_ranks, int fluid_ranks, const link::Address& address,
                     Rows rows = Rows::on_rank_connections) {
  const Sides sides(dem_ranks, fluid_ranks);
  if (sides.role == Sides::dem)
    return run_particles(sides.comm, address, rows);
  if (sides.role == Sides::fluid) {
    EchoFluid fluid(sides.comm);
    link::FluidServer(sides.comm, address, {}, 1).serve(fluid);
  }
  return "";
}

/// The sentence with which `work` ends, which must be the same on all `ranks`; empty if it does not end so.
std::string refusal_of(MPI_Comm ranks, double within, const std::function<void()>& work) {
  std::string text;
  const auto begun = std::chrono::steady_clock::now();
  try {
    work();
    ADD_FAILURE() << "accepted";
  } catch (const std::exception& refusal) {
    text = refusal.what();
  }
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), within) << text;
  char first[4096] = {};
  text.copy(first, sizeof first - 1);
  MPI_Bcast(first, sizeof first, MPI_CHAR, 0, ranks);
  EXPECT_EQ(text, first) << "not one sentence";
  return text;
}

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "said: " << text;
}

/// What a fluid of two ranks says to a DEM side that does `work`.
void expect_of_fluid(const std::string& name, const std::function<void(LoneDem&)>& work, double within,
                     const std::string& part) {
  const std::string path = place(name);
  {
    const Sides sides(1, 2);
    if (sides.role == Sides::dem) {
      LoneDem dem(path);
      work(dem);
      // The same is told to this side.
      const std::string text = refusal_of(sides.comm, within, [&] { dem.main.receive(); });
      expect_part(text, part);
    } else if (sides.role == Sides::fluid) {
      EchoFluid fluid(sides.comm);
      link::FluidServer server(sides.comm, path, {kSilence, kNotice}, 1);
      expect_part(refusal_of(sides.comm, within + kNotice, [&] { server.serve(fluid); }), part);
    }
  }
  EXPECT_EQ(sockets_at(path), 0);
}

/// What two ranks of DEM say to a fluid side that does `work`.
void expect_of_dem(const std::string& name, const std::function<void(LoneFluid&)>& work, const std::string& part) {
  const std::string path = place(name);
  {
    const Sides sides(2, 1);
    if (sides.role == Sides::fluid) {
      LoneFluid fluid(path);
      work(fluid);
      MPI_Barrier(MPI_COMM_WORLD);
    } else {
      if (sides.role == Sides::dem) {
        link::SocketPeer peer(sides.comm, path, {});
        peer.agree(some_terms());
        link::CouplingStep coupling_step;
        coupling_step.needed = kAsked;
        Flock none(0, 0);
        expect_part(refusal_of(sides.comm, kAtOnce, [&] { peer.couple(coupling_step, none.arrays(), none.samples()); }),
                    part);
        // Nothing is left to talk on.
        EXPECT_THROW(peer.couple(coupling_step, none.arrays(), none.samples()), link::Refusal);
      }
      MPI_Barrier(MPI_COMM_WORLD);
    }
  }
  EXPECT_EQ(sockets_at(path), 0);
}

} // namespace

TEST(RankConnections, BytesOfARankAreThoseOfItsOwnParticles) {
  const std::pair<int, int> ranks[] = {{1, 2}, {2, 1}, {3, 2}, {2, 3}, {4, 1}};
  for (const auto& [dem, fluid] : ranks) {
    const std::string path = place("counts");
    EXPECT_EQ(run_both(dem, fluid, path), "") << dem << " and " << fluid << " ranks";
    EXPECT_EQ(sockets_at(path), 0);
  }
}

TEST(RankConnections, OverRootTheSameArrives) {
  const std::string path = place("root");
  const std::string why = run_both(3, 2, path, Rows::over_root);
  if (world_rank() < 3) {
    EXPECT_EQ(why, "the script says lanes no");
  }
}

TEST(RankConnections, PathThatLeavesNoRoomForThemDoesWithout) {
  std::string path = place("long");
  path += std::string(107 - path.size(), 'x');
  const std::string why = run_both(3, 2, path);
  if (world_rank() < 3)
    expect_part(why, "too long");
}

TEST(RankConnections, FluidThatHasNoRoomForThemSaysSo) {
  // The same place by a longer name.
  std::string path = place("alias");
  const fs::path folder = fs::path(path).parent_path();
  std::string detour = folder.string();
  while (detour.size() + 2 + path.size() - folder.string().size() <= 107)
    detour += "/.";
  detour += path.substr(folder.string().size());
  if (detour.size() == 106)
    detour.insert(folder.string().size(), "/");
  const Sides sides(2, 2);
  if (sides.role == Sides::dem) {
    expect_part(run_particles(sides.comm, path, Rows::on_rank_connections), "too long");
  } else if (sides.role == Sides::fluid) {
    EchoFluid fluid(sides.comm);
    link::FluidServer(sides.comm, detour, {}, 1).serve(fluid);
  }
}

TEST(RankConnections, ComeOverTcpWithKeysToo) {
  const std::string keys = place("keys");
  const int port = 23600 + getpid() % 300;
  int shared = port;
  MPI_Bcast(&shared, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (world_rank() == 0)
    link::make_keys(keys);
  MPI_Barrier(MPI_COMM_WORLD);
  for (const std::string& folder : {std::string(), keys})
    EXPECT_EQ(run_both(3, 2, {"tcp://127.0.0.1:" + std::to_string(shared++), folder}), "");
  if (world_rank() == 0)
    fs::remove_all(keys);
}

TEST(RankConnections, FluidThatFailsTellsAllRanksOneSentence) {
  const std::string path = place("boiled");
  {
    const Sides sides(3, 2);
    if (sides.role == Sides::dem) {
      link::SocketPeer peer(sides.comm, path, {});
      peer.agree(some_terms());
      link::CouplingStep coupling_step;
      coupling_step.needed = kAsked;
      Flock none(0, 0);
      expect_part(refusal_of(sides.comm, kAtOnce, [&] { peer.couple(coupling_step, none.arrays(), none.samples()); }),
                  "the mud has boiled");
    } else {
      EchoFluid fluid(sides.comm);
      fluid.fails = true;
      link::FluidServer server(sides.comm, path, {}, 1);
      expect_part(refusal_of(sides.comm, kNotice, [&] { server.serve(fluid); }), "the mud has boiled");
    }
  }
  EXPECT_EQ(sockets_at(path), 0);
}

TEST(RankConnections, RankThatNeverComesIsMissed) {
  expect_of_fluid(
      "absent", [](LoneDem&) {}, kNotice, "which is for one of its ranks");
}

TEST(RankConnections, RankThatGoesEndsTheWaitsOfAll) {
  expect_of_fluid(
      "goes",
      [](LoneDem& dem) {
        dem.begin();
        dem.say_coupling_step(0, 2);
        dem.connection.reset();
      },
      kAtOnce, "has gone");
}

TEST(RankConnections, RowsOfAnotherCouplingStepAreRefused) {
  expect_of_fluid(
      "other-step",
      [](LoneDem& dem) {
        dem.come();
        dem.say_coupling_step(0);
        dem.say_rows(2);
      },
      kAtOnce, "another coupling step");
}

TEST(RankConnections, RowsOfAnotherRankAreRefused) {
  expect_of_fluid(
      "rank",
      [](LoneDem& dem) {
        dem.come();
        dem.say_coupling_step(0);
        dem.say_rows(1, 2);
      },
      kAtOnce, "another rank");
}

TEST(RankConnections, ParticlesThatAreMissingAreNoticed) {
  expect_of_fluid(
      "missing",
      [](LoneDem& dem) {
        dem.come();
        dem.say_coupling_step(1);
        dem.say_rows(1);
      },
      kAtOnce, "another number of particles");
}

// The stranger hears it at the fluid side's next look, which the coupling step brings.
TEST(RankConnections, StrangersAreTurnedAwayAndNonsenseIsRefused) {
  expect_of_fluid(
      "stranger",
      [](LoneDem& dem) {
        dem.begin();
        dem.say_coupling_step(0, 2);
        link::Channel stranger(link::Channel::Side::dem, link::Address(link::Address(dem.path), 1), {});
        stranger.send(link::Channel::Message(link::wire::encode_bare(Kind::farewell)));
        try {
          stranger.receive();
          ADD_FAILURE() << "a stranger was heard";
        } catch (const link::Refusal& refusal) {
          expect_part(refusal.what(), "another run uses this address");
        }
        dem.connection->send(link::Channel::Message(link::wire::encode_bare(Kind::farewell)));
      },
      kAtOnce, "not of the kind that is due");
}

TEST(RankConnections, FluidThatDropsOneEndsAllRanks) {
  expect_of_dem(
      "drops", [](LoneFluid& fluid) { fluid.connection.reset(); }, "has gone");
}

TEST(RankConnections, FluidThatAnswersOnOneOnlyAndGoes) {
  expect_of_dem(
      "half",
      [](LoneFluid& fluid) {
        LoneFluid::answer(*fluid.connection, 1);
        fluid.main.close();
      },
      "has gone");
}

TEST(RankConnections, AnswerToAnotherCouplingStepIsRefused) {
  expect_of_dem(
      "answer",
      [](LoneFluid& fluid) {
        LoneFluid::answer(fluid.main, 1);
        LoneFluid::answer(*fluid.connection, 2);
      },
      "another question");
}
