// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two sides of a socket link in one MPI job, and sides of one process that pretend to be one rank of several.
#pragma once

#include "link/ranks.h"
#include "link/socket/fluid_server.h"
#include "link/socket/socket_peer.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <unistd.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace eccentra::test {

constexpr unsigned kAsked = link::kVelocity | link::kFraction;

inline int world_rank() {
  return link::rank_of(MPI_COMM_WORLD);
}

/// The same on every rank; the path of a Unix socket below it is free.
inline std::string place(const std::string& name) {
  int id = getpid();
  MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
  return (std::filesystem::temp_directory_path() / ("eccentra-lanes-" + std::to_string(id) + "-" + name)).string();
}

/// What is there of `path` and of names that begin with it.
inline int sockets_at(const std::string& path) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(path).parent_path()))
    count += entry.path().string().compare(0, path.size(), path) == 0;
  return count;
}

/// Tells each particle its own place, and a number that is the same for all: of those that it was told of.
class EchoFluid : public link::FluidPeer {
 public:
  explicit EchoFluid(MPI_Comm ranks) : ranks_(ranks) {}
  link::FluidTerms agree(const link::DemTerms& dem) override {
    link::FluidTerms terms;
    terms.time_step = dem.time_step * double(dem.interval);
    terms.domain = dem.domain;
    terms.offered = kAsked;
    return terms;
  }
  std::string compare_walls(const link::WallDescription&) override { return ""; }
  link::StepAnswer couple(const link::CouplingStep&, const link::ParticleArrays& particles,
                          const link::FluidSamples& samples) override {
    long long all = 0;
    const auto own = static_cast<long long>(particles.count);
    MPI_Allreduce(&own, &all, 1, MPI_LONG_LONG, MPI_SUM, ranks_);
    for (std::size_t i = 0; i < particles.count; ++i) {
      for (int k = 0; k < 3; ++k)
        samples.velocity()[i][k] = particles.position[i][k];
      samples.fraction()[i] = double(all);
      particles.cell_hint[i] = {link::rank_of(ranks_), 0};
    }
    if (fails)
      throw std::runtime_error("the mud has boiled");
    return {15, ""};
  }
  void advance() override {}
  std::string checkpoint(const link::CheckpointMark&) override { return ""; }
  void run_ended() override {}
  bool fails = false;

 private:
  MPI_Comm ranks_;
};

inline link::DemTerms some_terms() {
  link::DemTerms terms;
  terms.time_step = 1e-5;
  terms.interval = 100;
  terms.needed = kAsked;
  for (double& high : terms.domain.high)
    high = 1;
  return terms;
}

/// A rank's particles.
struct Flock {
  std::vector<double> position, volume, impulse, velocity, fraction;
  std::vector<link::CellHint> cell_hint;
  using Vectors = double (*)[3];

  Flock(std::size_t count, int rank)
      : position(3 * count), volume(count, 1e-7), impulse(3 * count), velocity(3 * count), fraction(count),
        cell_hint(count) {
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] = rank + 1e-3 * double(i);
  }
  link::ParticleArrays arrays() {
    return {volume.size(),   reinterpret_cast<Vectors>(position.data()),
            volume.data(),   reinterpret_cast<Vectors>(impulse.data()),
            volume.data(),   nullptr,
            cell_hint.data()};
  }
  link::FluidSamples samples() {
    link::FluidSamples samples;
    samples[link::kVelocity] = velocity.data();
    samples[link::kFraction] = fraction.data();
    return samples;
  }
};

/// The first ranks are DEM, the next the fluid, the others have nothing to do.
struct Sides {
  enum Role { dem, fluid, none } role;
  MPI_Comm comm = MPI_COMM_NULL;

  Sides(int dem_ranks, int fluid_ranks)
      : role(world_rank() < dem_ranks                 ? dem
             : world_rank() < dem_ranks + fluid_ranks ? fluid
                                                      : none) {
    MPI_Comm_split(MPI_COMM_WORLD, role, world_rank(), &comm);
  }
  Sides(const Sides&) = delete;
  Sides& operator=(const Sides&) = delete;
  ~Sides() {
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Comm_free(&comm);
  }
};

/// A DEM side of one process that says it is the first of two ranks.
struct LoneDem {
  link::Channel main;
  std::string path;
  std::unique_ptr<link::Channel> connection;

  explicit LoneDem(const std::string& place) : main(link::Channel::Side::dem, place, {}), path(place) {
    link::DemTerms terms = some_terms();
    terms.rank_connections = 1;
    main.send(link::Channel::Message(link::wire::encode(terms)));
    main.receive();
    EXPECT_EQ(link::wire::kind_of(main.receive().view()), link::wire::Kind::rank_connections);
  }
  void come() {
    connection = std::make_unique<link::Channel>(link::Channel::Side::dem, link::Address(link::Address(path), 1),
                                                 link::Timeout());
    say_rows(0);
  }
  void say_rows(std::int64_t coupling_step, std::uint32_t rank = 1) const {
    link::Channel::Message rows(link::wire::kHeaderBytes + link::wire::kRowsBytes);
    link::wire::write_rows_head(rows.data(), {rank, coupling_step}, 0, false);
    connection->send(std::move(rows));
  }
  /// Comes, and couples once.
  void begin() {
    come();
    say_coupling_step(0);
    say_rows(1);
    main.receive();
    connection->receive();
  }
  void say_coupling_step(std::int64_t particles, std::int64_t number = 1) {
    link::CouplingStep coupling_step;
    coupling_step.needed = kAsked;
    coupling_step.number = number;
    coupling_step.totals.particles = particles;
    link::Channel::Message head(link::wire::kHeaderBytes + link::wire::kCouplingStepBytes);
    link::wire::write_coupling_step_head(head.data(), coupling_step, 0, false);
    main.send(std::move(head));
  }
};

/// A fluid side of one process, to two ranks of DEM.
struct LoneFluid {
  link::Channel main;
  std::unique_ptr<link::Channel> connection;

  explicit LoneFluid(const std::string& path) : main(link::Channel::Side::fluid, path, {}) {
    const link::DemTerms dem = link::wire::decode_dem_terms(main.receive().view());
    EXPECT_EQ(dem.rank_connections, 1u);
    link::FluidTerms terms;
    terms.time_step = dem.time_step * double(dem.interval);
    terms.domain = dem.domain;
    terms.offered = kAsked;
    connection = std::make_unique<link::Channel>(link::Channel::Side::fluid, link::Address(link::Address(path), 1),
                                                 link::Timeout());
    main.send(link::Channel::Message(link::wire::encode(terms)));
    main.send(link::Channel::Message(link::wire::encode_rank_connections({1})));
    connection->receive();
    EXPECT_EQ(link::wire::kind_of(main.receive().view()), link::wire::Kind::coupling_step);
    EXPECT_EQ(link::wire::kind_of(connection->receive().view()), link::wire::Kind::rows);
  }
  static void answer(link::Channel& channel, std::int64_t coupling_step) {
    link::Channel::Message samples(link::wire::kHeaderBytes + link::wire::kSamplesBytes);
    link::wire::write_samples_head(samples.data(), coupling_step, 0, kAsked);
    channel.send(std::move(samples));
  }
};

} // namespace eccentra::test
