// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The messages of the socket link as bytes: layout, bounds, and a decoder that trusts nothing. No sockets, no MPI.
// The layout is documented in docs/link.md.
#pragma once

#include "link/fluid_peer.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace eccentra::link::wire {

/// Kinds of messages, by the number in their header.
enum class Kind : std::uint32_t {
  dem_terms = 1,            ///< DEM to fluid: DemTerms
  fluid_terms = 2,          ///< fluid to DEM: FluidTerms
  refusal = 3,              ///< either way: one sentence; the sender goes on no longer. Readable in every version
  coupling_step = 4,        ///< DEM to fluid: CouplingStep and one row per particle
  samples = 5,              ///< fluid to DEM: one row per particle, in the order received
  run_ended = 6,            ///< DEM to fluid: this run of the script has ended as intended
  farewell = 7,             ///< DEM to fluid: the script has ended as intended
  checkpoint = 8,           ///< DEM to fluid: write the state of the last coupling step under this mark
  checkpointed = 9,         ///< fluid to DEM: it is on the disk, and where
  advance = 10,             ///< DEM to fluid, with overlap: DEM begins an interval, and so shall the fluid
  rank_connections = 11,    ///< fluid to DEM, after the terms: where the rank connections are that those asked for
  no_rank_connections = 12, ///< fluid to DEM instead: why there are none, in one sentence; all rows travel over rank 0
  rows = 13,  ///< DEM to fluid, on a rank connection: the particles of one rank, whose coupling step comes from rank 0
  hello = 14, ///< DEM to fluid, first on every connection: who comes speaks this protocol
  walls = 15, ///< DEM to fluid, after the terms: WallDescription
  walls_compared = 16 ///< fluid to DEM: they are those of the mesh, and what the user should know
};
constexpr Kind kLastKind = Kind::walls_compared;

/// Bytes before the body of every message.
constexpr std::size_t kHeaderBytes = 32;
/// Bytes between the header and the rows of a coupling step.
constexpr std::size_t kCouplingStepBytes = 272;
/// Bytes between the header and the rows of the samples.
constexpr std::size_t kSamplesBytes = 24;
/// Bytes between the header and the rows of a rank.
constexpr std::size_t kRowsBytes = 24;
/// Numbers of rank connections are those of ports, or of ranks.
constexpr std::uint32_t kMaxRankConnections = 65535;
/// No message speaks of more particles; rows stay below what MPI counts in one call.
constexpr std::uint64_t kMostParticles = 10'000'000;
/// Longest sentence of a refusal.
constexpr std::size_t kMostText = 2048;
/// Walls of a script, the bytes of a wall's name, and the triangles of all meshes.
constexpr std::uint64_t kMostWalls = 10'000, kMostName = 256, kMostTriangles = 5'000'000;

/// Bytes of one particle to the fluid: position, volume, impulse, drag coefficient, [extent,] cell hint.
std::size_t particle_row_bytes(bool extents);
/// Bytes of one particle's samples: the quantities asked for in the order of their bits, cell hint.
std::size_t samples_row_bytes(unsigned quantities);
/// No message of this protocol is longer.
std::size_t max_bytes();

/// A message as received; not owned.
struct View {
  const std::byte* data = nullptr; ///< first byte
  std::size_t size = 0;            ///< bytes
};

/// A message that is written.
using Bytes = std::vector<std::byte>;

// All encoders return header and body; those with rows write what precedes the rows of a message that the caller holds.
Bytes encode(const DemTerms& terms);                 ///< Kind::dem_terms
Bytes encode(const FluidTerms& terms);               ///< Kind::fluid_terms
Bytes encode_refusal(const std::string& sentence);   ///< one sentence for the user of the other side
Bytes encode(const CheckpointMark& mark);            ///< a checkpoint is due
Bytes encode_checkpointed(const std::string& place); ///< it is written at `place`
Bytes encode_bare(Kind kind);                        ///< run_ended, farewell, advance or hello
Bytes encode_rank_connections(const std::vector<std::uint32_t>& numbers); ///< of the ports or paths
Bytes encode_no_rank_connections(const std::string& why);                 ///< one clause for the message
Bytes encode(const WallDescription& walls);                               ///< of the DEM side
Bytes encode_walls_compared(const std::string& news);                     ///< sentences, one a line
/// `message` has room for kHeaderBytes + kCouplingStepBytes; `count` rows follow them.
void write_coupling_step_head(std::byte* message, const CouplingStep& coupling_step, std::size_t count, bool extents);
/// Says whose rows of which coupling step these are.
struct RowsMark {
  std::uint32_t connection = 0;   ///< rank of DEM
  std::int64_t coupling_step = 0; ///< its number
};
/// `message` has room for kHeaderBytes + kRowsBytes; `count` rows follow them.
void write_rows_head(std::byte* message, const RowsMark& mark, std::size_t count, bool extents);
/// `message` has room for kHeaderBytes + kSamplesBytes; `count` rows follow them. `stop_signal`: the one that asks the
/// fluid side to stop, or 0. `news` bytes of text follow the rows.
void write_samples_head(std::byte* message, std::int64_t coupling_step, std::size_t count, unsigned quantities,
                        int stop_signal = 0, std::size_t news = 0);

/// Rows of a message, still in it.
struct Rows {
  std::size_t count = 0;           ///< rows
  const std::byte* data = nullptr; ///< the first one
  int stop_signal = 0;             ///< of samples: 0 to 64
};

// The decoders throw Refusal with one sentence unless every size is what is there and every number is finite; none
// allocates more than the message's own size.
/// True if it begins as a message of this protocol does, of whatever version.
bool is_ours(View message);
/// Checks the header, too: magic, byte order, sizes of numbers, version (of all but a refusal), length of the body.
Kind kind_of(View message);
DemTerms decode_dem_terms(View message);        ///< as encoded
FluidTerms decode_fluid_terms(View message);    ///< as encoded
std::string decode_refusal(View message);       ///< the sentence
CheckpointMark decode_checkpoint(View message); ///< the mark
std::string decode_checkpointed(View message);  ///< the place
/// `asked`: the number of rank connections that the terms asked for.
std::vector<std::uint32_t> decode_rank_connections(View message, std::size_t asked);
std::string decode_no_rank_connections(View message); ///< the clause
WallDescription decode_walls(View message);           ///< as encoded
std::string decode_walls_compared(View message);      ///< the sentences
/// `extents` as the DEM side's terms said. Volumes are positive. With rank connections the rows are some of the
/// particles.
Rows decode_coupling_step(View message, bool extents, CouplingStep& coupling_step);
/// `mark` as it must be.
Rows decode_rows(View message, bool extents, const RowsMark& mark);
/// `coupling step`, `count` and `quantities` as the coupling step asked for.
/// `news`, if not null, becomes the text behind the rows.
Rows decode_samples(View message, std::int64_t coupling_step, std::size_t count, unsigned quantities,
                    std::string* news = nullptr);
/// Throws Refusal unless each cell hint is blank or names a rank that is there and one of its cells.
void check_cell_hints(Rows rows, bool extents, const std::vector<std::int32_t>& cells_of_rank);

/// Writes all rows of `particles` to `rows`.
void pack_particles(const ParticleArrays& particles, bool extents, std::byte* rows);

/// Particles unpacked from rows, with room for their samples. Keeps its memory from one coupling step to the next.
class ParticlePoints {
 public:
  /// The rows of all `parts`, one after the other.
  void load(const std::vector<Rows>& parts, bool extents, unsigned quantities);
  /// Arrays over the particles, valid until the next load().
  ParticleArrays particles();
  /// Arrays of the quantities asked for, null for the others, also where there is no particle.
  FluidSamples samples();
  /// Writes samples and cell hint of `count` particles from `first` on to `rows`.
  void pack_samples(std::size_t first, std::size_t count, std::byte* rows) const;

 private:
  std::size_t count_ = 0;
  unsigned quantities_ = 0;
  bool extents_ = false;
  std::vector<double> position_, volume_, impulse_, drag_, extent_;
  std::vector<CellHint> cell_hint_;
  PerQuantity<std::vector<double>> values_; ///< of those asked for
};

/// Puts samples and cell hint where the DEM side wants them; a quantity whose array is null is passed over.
void unpack_samples(Rows rows, unsigned quantities, const FluidSamples& samples, CellHint* cell_hints);

} // namespace eccentra::link::wire
