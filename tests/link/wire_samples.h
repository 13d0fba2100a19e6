// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One valid message of each kind, and a reader that treats any bytes as both sides do.
#pragma once

#include "link/socket/wire.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace eccentra::test {

constexpr unsigned kAsked = link::kVelocity | link::kFraction | link::kPressureGradient;
constexpr std::size_t kRows = 3;
constexpr std::int64_t kCouplingStep = 12;
constexpr std::uint32_t kRankConnection = 5;

/// Particles with values that tell rows and columns apart.
struct SomeParticles {
  double position[kRows][3], volume[kRows], impulse[kRows][3], drag[kRows], extent[kRows][link::kExtentDoubles];
  link::CellHint cell_hint[kRows];

  SomeParticles() {
    for (std::size_t i = 0; i < kRows; ++i) {
      for (int k = 0; k < 3; ++k) {
        position[i][k] = 100.0 * i + k;
        impulse[i][k] = -100.0 * i - k;
      }
      for (int k = 0; k < link::kExtentDoubles; ++k)
        extent[i][k] = 1000.0 * i + k;
      volume[i] = 1.5 + i;
      drag[i] = 0.25 * i;
      cell_hint[i] = {static_cast<std::int32_t>(i) - 1, static_cast<std::int32_t>(7 * i)};
    }
  }
  link::ParticleArrays arrays() { return {kRows, position, volume, impulse, drag, extent, cell_hint}; }
};

inline link::CouplingStep some_coupling_step() {
  link::CouplingStep coupling_step;
  coupling_step.needed = kAsked;
  coupling_step.elapsed = 2e-3;
  coupling_step.dem_seconds = 0.5;
  coupling_step.steps_done = 40;
  coupling_step.steps_total = 80;
  coupling_step.number = kCouplingStep;
  coupling_step.totals.particles = kRows;
  coupling_step.totals.volume_velocity[2] = 3.25;
  coupling_step.totals.fastest = 0.75;
  coupling_step.load = {4, 2, 0.25, 0.5, {0.125, 640, 3, 1536}};
  return coupling_step;
}

inline link::wire::Bytes coupling_step_message(bool extents) {
  using namespace link::wire;
  constexpr std::size_t head = kHeaderBytes + kCouplingStepBytes;
  Bytes message(head + kRows * particle_row_bytes(extents));
  write_coupling_step_head(message.data(), some_coupling_step(), kRows, extents);
  SomeParticles particles;
  pack_particles(particles.arrays(), extents, message.data() + head);
  return message;
}

inline link::wire::Bytes samples_message() {
  using namespace link::wire;
  constexpr std::size_t head = kHeaderBytes + kSamplesBytes;
  const Bytes coupling_step = coupling_step_message(true);
  link::CouplingStep unused;
  ParticlePoints particles_here;
  particles_here.load({decode_coupling_step({coupling_step.data(), coupling_step.size()}, true, unused)}, true, kAsked);
  const link::FluidSamples samples = particles_here.samples();
  for (std::size_t i = 0; i < kRows; ++i) {
    for (int k = 0; k < 3; ++k) {
      samples.velocity()[i][k] = 10.0 * i + k;
      samples.pressure_gradient()[i][k] = -10.0 * i - k;
    }
    samples.fraction()[i] = 0.5 + 0.1 * i;
  }
  Bytes message(head + kRows * samples_row_bytes(kAsked));
  write_samples_head(message.data(), kCouplingStep, kRows, kAsked);
  particles_here.pack_samples(0, kRows, message.data() + head);
  return message;
}

inline link::wire::Bytes rows_message(bool extents) {
  using namespace link::wire;
  constexpr std::size_t head = kHeaderBytes + kRowsBytes;
  Bytes message(head + kRows * particle_row_bytes(extents));
  write_rows_head(message.data(), {kRankConnection, kCouplingStep}, kRows, extents);
  SomeParticles particles;
  pack_particles(particles.arrays(), extents, message.data() + head);
  return message;
}

inline link::WallDescription some_walls() {
  link::WallDescription walls;
  walls.primitives.push_back(
      {"hole", "fix hole (cylinder)", link::PrimitiveWall::Form::cylinder, {1, 2, 3}, {0, 0, 1}, 0.5, {}, {0, 0, 5}});
  walls.primitives.emplace_back();
  walls.meshes.push_back({"lid", "mesh 'lid'", true, true, {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}, {}});
  walls.meshes.back().velocities = walls.meshes.back().corners;
  return walls;
}

/// Reads rows with or without extents, whichever fits.
template <class Decode> void use_rows(Decode&& decode) {
  using namespace link::wire;
  for (const bool extents : {false, true}) {
    try {
      const Rows rows = decode(extents);
      check_cell_hints(rows, extents, {8, 20});
      ParticlePoints particles_here;
      particles_here.load({rows, rows}, extents, kAsked);
      Bytes answer(rows.count * samples_row_bytes(kAsked));
      particles_here.pack_samples(rows.count, rows.count, answer.data());
      return;
    } catch (const link::Refusal&) {
      if (extents)
        throw;
    }
  }
}

inline std::vector<link::wire::Bytes> valid_messages() {
  using namespace link::wire;
  link::DemTerms dem;
  dem.time_step = 5e-5;
  dem.interval = 40;
  dem.needed = kAsked;
  link::FluidTerms fluid;
  fluid.offered = link::kAllQuantities;
  return {encode(dem),
          encode(fluid),
          encode_refusal("no"),
          coupling_step_message(false),
          coupling_step_message(true),
          samples_message(),
          rows_message(false),
          rows_message(true),
          encode_rank_connections({1, 2, kMaxRankConnections}),
          encode_no_rank_connections("several hosts"),
          encode_bare(Kind::run_ended),
          encode_bare(Kind::farewell),
          encode_bare(Kind::advance),
          encode_bare(Kind::hello),
          encode(some_walls()),
          encode_walls_compared("warning: no wall\nwarning: no patch\n"),
          encode(link::CheckpointMark{640, 7}),
          encode_checkpointed("/case/checkpoints/fluid-640.complete")};
}

/// Decodes a message as whoever receives it would, and uses all of what is accepted. True if it was accepted.
inline bool accepted(const std::byte* data, std::size_t size) {
  using namespace link::wire;
  const View message{data, size};
  try {
    switch (kind_of(message)) {
    case Kind::dem_terms: {
      const link::DemTerms terms = decode_dem_terms(message);
      (void)link::disagreement(terms, link::FluidTerms());
      break;
    }
    case Kind::fluid_terms: {
      const link::FluidTerms terms = decode_fluid_terms(message);
      (void)link::disagreement(link::DemTerms(), terms);
      break;
    }
    case Kind::refusal:
      (void)decode_refusal(message);
      break;
    case Kind::checkpoint:
      (void)decode_checkpoint(message);
      break;
    case Kind::walls:
      (void)decode_walls(message);
      break;
    case Kind::walls_compared:
      (void)decode_walls_compared(message);
      break;
    case Kind::checkpointed:
      (void)decode_checkpointed(message);
      break;
    case Kind::coupling_step:
      use_rows([&](bool extents) {
        link::CouplingStep coupling_step;
        return decode_coupling_step(message, extents, coupling_step);
      });
      break;
    case Kind::rows:
      use_rows([&](bool extents) { return decode_rows(message, extents, {kRankConnection, kCouplingStep}); });
      break;
    case Kind::rank_connections:
      (void)decode_rank_connections(message, 3);
      break;
    case Kind::no_rank_connections:
      (void)decode_no_rank_connections(message);
      break;
    case Kind::samples: {
      std::string news;
      const Rows rows = decode_samples(message, kCouplingStep, kRows, kAsked, &news);
      double velocity[kRows][3], fraction[kRows], gradient[kRows][3];
      link::CellHint cell_hints[kRows];
      link::FluidSamples samples;
      samples[link::kVelocity] = velocity[0];
      samples[link::kFraction] = fraction;
      samples[link::kPressureGradient] = gradient[0];
      unpack_samples(rows, kAsked, samples, cell_hints);
      break;
    }
    default:
      break;
    }
    return true;
  } catch (const link::Refusal&) {
    return false;
  }
}

} // namespace eccentra::test
