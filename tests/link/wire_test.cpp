// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages arrive as they were sent; broken and hostile ones are refused with a sentence before anything is made of
// them.
#include "link/wire_samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace {

using namespace eccentra::link;
using namespace eccentra::test;
using wire::Bytes;
using wire::View;

constexpr int kMutations = 200000;
constexpr std::size_t kKindAt = 16, kVersionAt = 12, kOrderAt = 8, kDoubleSizeAt = 20, kLengthAt = 24;

View view(const Bytes& message) {
  return {message.data(), message.size()};
}

template <class Value> Bytes with(Bytes message, std::size_t at, Value value) {
  std::memcpy(message.data() + at, &value, sizeof value);
  return message;
}

template <class Work> void expect_refusal(Work&& work, const std::string& part) {
  try {
    work();
    ADD_FAILURE() << "accepted; expected: " << part;
  } catch (const Refusal& refusal) {
    const std::string text = refusal.what();
    EXPECT_NE(text.find(part), std::string::npos) << "said: " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

} // namespace

TEST(Wire, TermsArriveAsSent) {
  DemTerms dem;
  dem.time_step = 7.8125e-5;
  dem.interval = 64;
  dem.particles = 1212;
  dem.needed = kAsked;
  dem.extents = true;
  dem.overlap = true;
  dem.fluid_density = 1030;
  dem.gravity[1] = -9.81;
  dem.rheology = {1, 0.28, 0.65};
  dem.domain.low[2] = -0.5;
  dem.domain.high[0] = 0.25;
  dem.domain.periodic[2] = true;
  dem.resumes = {640, 0x8000000000000001};
  dem.rank_connections = 7;
  const DemTerms got = wire::decode_dem_terms(view(wire::encode(dem)));
  EXPECT_EQ(got.time_step, dem.time_step);
  EXPECT_EQ(got.interval, 64);
  EXPECT_EQ(got.resumes.step, 640);
  EXPECT_EQ(got.resumes.id, 0x8000000000000001u);
  EXPECT_EQ(got.particles, 1212);
  EXPECT_EQ(got.rank_connections, 7u);
  EXPECT_EQ(got.needed, kAsked);
  EXPECT_TRUE(got.extents);
  EXPECT_TRUE(got.overlap);
  EXPECT_EQ(got.fluid_density, 1030);
  EXPECT_EQ(got.gravity[1], -9.81);
  EXPECT_EQ(got.rheology.yield_stress, 1);
  EXPECT_EQ(got.rheology.consistency, 0.28);
  EXPECT_EQ(got.rheology.index, 0.65);
  EXPECT_EQ(got.domain.low[2], -0.5);
  EXPECT_EQ(got.domain.high[0], 0.25);
  EXPECT_TRUE(got.domain.periodic[2]);
  EXPECT_FALSE(got.domain.periodic[0]);

  FluidTerms fluid;
  fluid.time_step = 5e-3;
  fluid.offered = eccentra::link::kAllQuantities;
  fluid.fluid_density = 1000;
  fluid.domain.high[1] = 2;
  fluid.rheology = {2, 0.5, 0.8};
  fluid.has_gravity = true;
  fluid.gravity[2] = -9.8;
  fluid.layout = 99;
  const FluidTerms back = wire::decode_fluid_terms(view(wire::encode(fluid)));
  EXPECT_EQ(back.time_step, 5e-3);
  EXPECT_EQ(back.layout, 99u);
  EXPECT_EQ(back.offered, eccentra::link::kAllQuantities);
  EXPECT_EQ(back.fluid_density, 1000);
  EXPECT_EQ(back.domain.high[1], 2);
  EXPECT_EQ(back.rheology.yield_stress, 2);
  EXPECT_EQ(back.rheology.consistency, 0.5);
  EXPECT_EQ(back.rheology.index, 0.8);
  EXPECT_TRUE(back.has_gravity);
  EXPECT_EQ(back.gravity[2], -9.8);
}

TEST(Wire, CouplingStepArrivesAsSent) {
  for (const bool extents : {false, true}) {
    const Bytes message = coupling_step_message(extents);
    CouplingStep coupling_step;
    const wire::Rows rows = wire::decode_coupling_step(view(message), extents, coupling_step);
    EXPECT_EQ(coupling_step.needed, kAsked);
    EXPECT_EQ(coupling_step.elapsed, 2e-3);
    EXPECT_EQ(coupling_step.steps_total, 80);
    EXPECT_EQ(coupling_step.totals.volume_velocity[2], 3.25);
    EXPECT_EQ(coupling_step.totals.fastest, 0.75);
    EXPECT_EQ(coupling_step.number, kCouplingStep);
    EXPECT_EQ(coupling_step.load.ranks, 4);
    EXPECT_EQ(coupling_step.load.max_particles, 2);
    EXPECT_EQ(coupling_step.load.mean_seconds, 0.25);
    EXPECT_EQ(coupling_step.load.max_seconds, 0.5);
    EXPECT_EQ(coupling_step.load.between.waited, 0.125);
    EXPECT_EQ(coupling_step.load.between.messages, 640);
    EXPECT_EQ(coupling_step.load.between.operations, 3);
    EXPECT_EQ(coupling_step.load.between.bytes, 1536);
    wire::ParticlePoints particles_here;
    particles_here.load({rows}, extents, kAsked);
    const ParticleArrays got = particles_here.particles();
    SomeParticles sent;
    ASSERT_EQ(got.count, kRows);
    EXPECT_EQ(got.extent != nullptr, extents);
    for (std::size_t i = 0; i < kRows; ++i) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(got.position[i][k], sent.position[i][k]);
        EXPECT_EQ(got.impulse[i][k], sent.impulse[i][k]);
      }
      for (int k = 0; extents && k < kExtentDoubles; ++k)
        EXPECT_EQ(got.extent[i][k], sent.extent[i][k]);
      EXPECT_EQ(got.volume[i], sent.volume[i]);
      EXPECT_EQ(got.drag_coefficient[i], sent.drag[i]);
      EXPECT_EQ(got.cell_hint[i].rank, sent.cell_hint[i].rank);
      if (sent.cell_hint[i].rank >= 0) {
        EXPECT_EQ(got.cell_hint[i].cell, sent.cell_hint[i].cell);
      }
    }
  }
}

TEST(Wire, SamplesArriveAsSentAndOnlyWhatIsAskedForTravels) {
  const Bytes message = samples_message();
  EXPECT_EQ(message.size(), wire::kHeaderBytes + wire::kSamplesBytes + kRows * (7 * 8 + 8));
  const wire::Rows rows = wire::decode_samples(view(message), kCouplingStep, kRows, kAsked);
  double velocity[kRows][3], fraction[kRows];
  CellHint cell_hints[kRows];
  eccentra::link::FluidSamples samples;
  samples[eccentra::link::kVelocity] = velocity[0];
  samples[eccentra::link::kFraction] = fraction; // the gradient is not wanted after all
  wire::unpack_samples(rows, kAsked, samples, cell_hints);
  for (std::size_t i = 0; i < kRows; ++i) {
    EXPECT_EQ(velocity[i][2], 10.0 * i + 2);
    EXPECT_EQ(fraction[i], 0.5 + 0.1 * i);
    EXPECT_EQ(cell_hints[i].rank, static_cast<int>(i) - 1);
  }
}

TEST(Wire, ArraysThatAreAskedForExistWithoutParticles) {
  wire::ParticlePoints particles_here;
  particles_here.load({}, true, kAsked);
  EXPECT_NE(particles_here.samples().velocity(), nullptr);
  EXPECT_NE(particles_here.particles().extent, nullptr);
  EXPECT_EQ(particles_here.samples().vorticity(), nullptr);
}

TEST(Wire, HeadersThatDoNotFitAreRefused) {
  const Bytes message = coupling_step_message(false);
  const auto read = [](const Bytes& bytes) { return [&bytes] { wire::kind_of(view(bytes)); }; };
  expect_refusal(read(Bytes()), "shorter than a header");
  expect_refusal(read(with(message, 0, 'X')), "does not begin with ECCENTRA");
  expect_refusal(read(with(message, kOrderAt, std::uint32_t(0x04030201))), "order of bytes");
  expect_refusal(read(with(message, kVersionAt, kProtocolVersion + 1)), "install the same release");
  expect_refusal(read(with(message, kKindAt, std::uint32_t(99))), "unknown kind");
  expect_refusal(read(with(message, kDoubleSizeAt, std::uint32_t(4))), "another size");
  expect_refusal(read(with(message, kLengthAt, ~std::uint64_t(0))), "length that it states");
}

TEST(Wire, RefusalsOfOtherVersionsAreReadableAndHarmless) {
  const Bytes message = with(wire::encode_refusal("other\nrelease\x1b[2J"), kVersionAt, kProtocolVersion + 1);
  EXPECT_EQ(wire::kind_of(view(message)), wire::Kind::refusal);
  EXPECT_EQ(wire::decode_refusal(view(message)), "other?release?[2J");
  EXPECT_EQ(wire::decode_refusal(view(wire::encode_refusal(std::string(1 << 20, 'x')))).size(), wire::kMostText);
}

TEST(Wire, EveryTruncationIsRefused) {
  for (const Bytes& message : valid_messages()) {
    ASSERT_TRUE(accepted(message.data(), message.size()));
    for (std::size_t size = 0; size < message.size(); ++size) {
      const Bytes cut(message.begin(), message.begin() + size); // its own block: a sanitizer sees any read beyond it
      EXPECT_FALSE(accepted(cut.data(), cut.size()));
      if (size < wire::kHeaderBytes)
        continue;
      // And with a header that states the shorter length; a text may have any.
      const Bytes honest = with(cut, kLengthAt, std::uint64_t(size - wire::kHeaderBytes));
      const wire::Kind kind = wire::kind_of(view(message));
      if (kind != wire::Kind::refusal && kind != wire::Kind::checkpointed && kind != wire::Kind::no_rank_connections &&
          kind != wire::Kind::walls_compared) {
        EXPECT_FALSE(accepted(honest.data(), honest.size()));
      }
    }
  }
}

TEST(Wire, CheckpointsAndSignalsArriveAsSent) {
  EXPECT_EQ(wire::decode_checkpoint(view(wire::encode(CheckpointMark{640, 7}))).id, 7u);
  EXPECT_EQ(wire::decode_checkpointed(view(wire::encode_checkpointed("/a\nb"))), "/a?b");
  expect_refusal([&] { wire::decode_checkpoint(view(wire::encode(CheckpointMark{-1, 7}))); }, "before the beginning");
  Bytes samples = samples_message();
  wire::write_samples_head(samples.data(), kCouplingStep, kRows, kAsked, 15);
  EXPECT_EQ(wire::decode_samples(view(samples), kCouplingStep, kRows, kAsked).stop_signal, 15);
  wire::write_samples_head(samples.data(), kCouplingStep, kRows, kAsked, 1000);
  expect_refusal([&] { wire::decode_samples(view(samples), kCouplingStep, kRows, kAsked); },
                 "signal that does not exist");
}

TEST(Wire, LanesArriveAsSentAndOthersAreRefused) {
  const std::vector<std::uint32_t> numbers = {3, wire::kMaxRankConnections};
  const Bytes message = wire::encode_rank_connections(numbers);
  EXPECT_EQ(wire::decode_rank_connections(view(message), 2), numbers);
  expect_refusal([&] { wire::decode_rank_connections(view(message), 3); }, "another number of lanes");
  expect_refusal([&] { wire::decode_rank_connections(view(wire::encode_rank_connections({0})), 1); }, "cannot exist");
  expect_refusal(
      [&] { wire::decode_rank_connections(view(wire::encode_rank_connections({wire::kMaxRankConnections + 1})), 1); },
      "cannot exist");
  EXPECT_EQ(wire::decode_no_rank_connections(view(wire::encode_no_rank_connections("several\nhosts"))),
            "several?hosts");
  DemTerms dem;
  dem.rank_connections = wire::kMaxRankConnections + 1;
  expect_refusal([&] { wire::decode_dem_terms(view(wire::encode(dem))); }, "more lanes than there can be");
}

TEST(Wire, WallsAndNewsArriveAsSent) {
  const WallDescription sent = some_walls();
  const WallDescription got = wire::decode_walls(view(wire::encode(sent)));
  ASSERT_EQ(got.primitives.size(), 2u);
  EXPECT_EQ(got.primitives[0].id, "hole");
  EXPECT_EQ(got.primitives[0].name, "fix hole (cylinder)");
  EXPECT_EQ(got.primitives[0].form, PrimitiveWall::Form::cylinder);
  EXPECT_EQ(got.primitives[0].point, sent.primitives[0].point);
  EXPECT_EQ(got.primitives[0].radius, 0.5);
  EXPECT_EQ(got.primitives[0].angular_velocity[2], 5);
  ASSERT_EQ(got.meshes.size(), 1u);
  EXPECT_TRUE(got.meshes[0].moves);
  EXPECT_EQ(got.meshes[0].corners, sent.meshes[0].corners);
  EXPECT_EQ(got.meshes[0].velocities, sent.meshes[0].velocities);
  expect_refusal([&] { wire::decode_walls(view(with(wire::encode(sent), wire::kHeaderBytes, ~std::uint64_t(0)))); },
                 "does not hold what it states");
  EXPECT_EQ(wire::decode_walls_compared(view(wire::encode_walls_compared("a\nb\x1b"))), "a\nb?");

  const std::string text = "warning: gone\n";
  Bytes samples = samples_message();
  const std::size_t rows = samples.size();
  samples.resize(rows + text.size());
  wire::write_samples_head(samples.data(), kCouplingStep, kRows, kAsked, 0, text.size());
  std::memcpy(samples.data() + rows, text.data(), text.size());
  std::string news;
  EXPECT_EQ(wire::decode_samples(view(samples), kCouplingStep, kRows, kAsked, &news).count, kRows);
  EXPECT_EQ(news, text);
}

TEST(Wire, RowsOfAnotherRankOrCouplingStepAreRefused) {
  const Bytes message = rows_message(true);
  EXPECT_EQ(wire::decode_rows(view(message), true, {kRankConnection, kCouplingStep}).count, kRows);
  expect_refusal([&] { wire::decode_rows(view(message), true, {kRankConnection + 1, kCouplingStep}); }, "another rank");
  expect_refusal(
      [&] {
        wire::decode_rows(view(message), true, {kRankConnection, kCouplingStep + 1});
      },
      "another coupling step");
  expect_refusal(
      [&] {
        wire::decode_rows(view(message), false, {kRankConnection, kCouplingStep});
      },
      "another length than the terms");
  expect_refusal([&] { wire::decode_samples(view(samples_message()), kCouplingStep + 1, kRows, kAsked); },
                 "another question");
  for (const std::uint64_t count : {std::uint64_t(4), wire::kMostParticles, ~std::uint64_t(0)}) {
    const Bytes more = with(message, wire::kHeaderBytes, count);
    EXPECT_THROW(wire::decode_rows(view(more), true, {kRankConnection, kCouplingStep}), Refusal) << count;
  }
}

TEST(Wire, CountsThatAreNotThereAreRefusedBeforeAnythingIsAllocated) {
  CouplingStep coupling_step;
  for (const std::uint64_t count : {std::uint64_t(4), wire::kMostParticles, wire::kMostParticles + 1, ~std::uint64_t(0),
                                    ~std::uint64_t(0) / wire::particle_row_bytes(false) + 1}) {
    const Bytes message = with(coupling_step_message(false), wire::kHeaderBytes, count);
    EXPECT_THROW(wire::decode_coupling_step(view(message), false, coupling_step), Refusal) << count;
  }
  const Bytes more = with(samples_message(), wire::kHeaderBytes, std::uint64_t(kRows + 1));
  expect_refusal([&] { wire::decode_samples(view(more), kCouplingStep, kRows, kAsked); }, "another question");
}

TEST(Wire, NumbersThatAreNoneAreRefused) {
  constexpr std::size_t rows = wire::kHeaderBytes + wire::kCouplingStepBytes;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CouplingStep coupling_step;
  const Bytes position = with(coupling_step_message(false), rows, nan);
  expect_refusal([&] { wire::decode_coupling_step(view(position), false, coupling_step); },
                 "particle row 0 is no number");
  const Bytes volume = with(coupling_step_message(false), rows + 24, 0.0);
  expect_refusal([&] { wire::decode_coupling_step(view(volume), false, coupling_step); }, "without volume");
  const Bytes sample = with(samples_message(), wire::kHeaderBytes + wire::kSamplesBytes, nan);
  expect_refusal([&] { wire::decode_samples(view(sample), kCouplingStep, kRows, kAsked); },
                 "samples row 0 is no number");
}

TEST(Wire, HintsOfCellsThatDoNotExistAreRefused) {
  CouplingStep coupling_step;
  const Bytes message = coupling_step_message(false);
  const wire::Rows rows =
      wire::decode_coupling_step(view(message), false, coupling_step); // cell hint: none, (0, 7), (1, 14)
  EXPECT_NO_THROW(wire::check_cell_hints(rows, false, {8, 15}));
  EXPECT_THROW(wire::check_cell_hints(rows, false, {7, 15}), Refusal);
  EXPECT_THROW(wire::check_cell_hints(rows, false, {8, 14}), Refusal);
  EXPECT_THROW(wire::check_cell_hints(rows, false, {8}), Refusal);
}

// Bytes changed at random, in lengths and counts above all: refused or harmless, never a crash.
TEST(Wire, RandomMutationsDoNoHarm) {
  const std::vector<Bytes> valid = valid_messages();
  std::mt19937_64 random(20240607);
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  int refused = 0;
  for (int n = 0; n < kMutations; ++n) {
    Bytes message = valid[below(valid.size())];
    const std::size_t changes = 1 + below(4);
    for (std::size_t c = 0; c < changes && !message.empty(); ++c) {
      switch (below(5)) {
      case 0:
        message[below(message.size())] ^= std::byte(1u << below(8));
        break;
      case 1:
        message[below(message.size())] = std::byte(random());
        break;
      case 2:
        message.resize(below(message.size() + 1));
        break;
      case 3:
        message.resize(message.size() + below(64), std::byte(random()));
        break;
      default: { // a word of the header or of what follows it
        const std::uint64_t arguments[] = {0, 1, 3, 7, 1u << 31, ~std::uint64_t(0), wire::kMostParticles, random()};
        const std::size_t at = 4 * below(20);
        if (at + 8 <= message.size())
          message = with(message, at, arguments[below(std::size(arguments))]);
      }
      }
    }
    // Half of them with an honest length, so that what lies behind the header is reached.
    if (message.size() >= wire::kHeaderBytes && below(2))
      message = with(message, kLengthAt, std::uint64_t(message.size() - wire::kHeaderBytes));
    message.shrink_to_fit();
    refused += !accepted(message.data(), message.size());
  }
  EXPECT_GT(refused, kMutations / 2);
  EXPECT_LT(refused, kMutations);
}
