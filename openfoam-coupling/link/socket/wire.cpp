// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Encodes and decodes the messages of the socket link.
#include "link/socket/wire_records.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace eccentra::link::wire {
namespace {

static_assert(sizeof(double) == 8 && std::numeric_limits<double>::is_iec559, "numbers travel as IEEE 754 binary64");

constexpr char kMagic[8] = {'E', 'C', 'C', 'E', 'N', 'T', 'R', 'A'};
/// Reads differently on a machine of the other byte order.
constexpr std::uint32_t kByteOrder = 0x01020304;
constexpr std::size_t kParticleDoubles = 3 + 1 + 3 + 1;
constexpr std::size_t kVolumeAt = 3;
constexpr std::uint64_t kExponent = 0x7ff0000000000000; ///< of a binary64

void write_header(std::byte* message, Kind kind, std::size_t body) {
  Writer out(message);
  out.raw(kMagic, sizeof kMagic);
  out.plain(kByteOrder);
  out.plain(kProtocolVersion);
  out.plain(static_cast<std::uint32_t>(kind));
  out.plain(static_cast<std::uint32_t>(sizeof(double)));
  out.plain(static_cast<std::uint64_t>(body));
}

struct Header {
  std::uint32_t version;
  Kind kind;
};

Header read_header(Reader& in) {
  if (in.left() < kHeaderBytes)
    broken("is shorter than a header");
  char magic[sizeof kMagic];
  for (char& c : magic)
    c = in.take<char>();
  if (std::memcmp(magic, kMagic, sizeof kMagic) != 0)
    broken("does not begin with ECCENTRA");
  if (in.take<std::uint32_t>() != kByteOrder)
    throw Refusal("the other side's machine has another order of bytes: run both sides on machines of one kind");
  Header header;
  header.version = in.take<std::uint32_t>();
  const auto kind = in.take<std::uint32_t>();
  if (kind < static_cast<std::uint32_t>(Kind::dem_terms) || kind > static_cast<std::uint32_t>(kLastKind))
    broken("is of an unknown kind");
  header.kind = static_cast<Kind>(kind);
  if (in.take<std::uint32_t>() != sizeof(double))
    throw Refusal("the other side's numbers have another size: run both sides on machines of one kind");
  if (in.take<std::uint64_t>() != in.left())
    broken("does not have the length that it states");
  if (header.version != kProtocolVersion && header.kind != Kind::refusal)
    throw Refusal("this side speaks version " + std::to_string(kProtocolVersion) + " of the protocol and the other " +
                  std::to_string(header.version) + ": install the same release of Eccentra on both");
  return header;
}

Reader body_of(View message, Kind kind) {
  Reader in(message);
  if (read_header(in).kind != kind)
    broken("is not of the kind that is due");
  return in;
}

Bytes with_header(Kind kind, std::size_t body) {
  Bytes message(kHeaderBytes + body);
  write_header(message.data(), kind, body);
  return message;
}

constexpr std::size_t kDemTermsBytes = bytes_of<DemTerms>(dem_terms_fields);
constexpr std::size_t kFluidTermsBytes = bytes_of<FluidTerms>(fluid_terms_fields);
constexpr std::size_t kMarkBytes = bytes_of<CheckpointMark>(mark_fields);
static_assert(kCouplingStepBytes ==
              sizeof(std::uint64_t) + sizeof(std::uint32_t) + bytes_of<CouplingStep>(coupling_step_fields));
static_assert(kRowsBytes == sizeof(std::uint64_t) + sizeof(std::uint32_t) + sizeof(RowsMark::connection) +
                                sizeof(RowsMark::coupling_step));
/// Largest signal number of any system.
constexpr std::uint32_t kMostSignal = 64;

void check_finite(const std::byte* row, std::size_t doubles, std::size_t index, const char* what) {
  // By bits, so that the loop vectorises: all ones in the exponent is infinity or no number.
  std::uint64_t none = 0;
  for (std::size_t k = 0; k < doubles; ++k) {
    std::uint64_t bits;
    std::memcpy(&bits, row + sizeof bits * k, sizeof bits);
    none |= std::uint64_t((bits & kExponent) == kExponent);
  }
  if (none)
    throw Refusal(std::string("a value of ") + what + " " + std::to_string(index) +
                  " is no number: the run has blown up, reduce the time steps");
}

std::size_t checked_count(Reader& in) {
  const auto count = in.take<std::uint64_t>();
  if (count > kMostParticles)
    broken("speaks of more particles than the " + std::to_string(kMostParticles) + " that the link carries");
  return count;
}

/// What is printed on a terminal must not command it. `lines`: of several lines.
std::string printable(const char* from, std::size_t length, bool lines) {
  std::string text(from, length);
  for (char& c : text)
    if (!(lines && c == '\n') && (static_cast<unsigned char>(c) < ' ' || static_cast<unsigned char>(c) > '~'))
      c = '?';
  return text;
}

/// The rows of particles that are left in the message.
Rows particle_rows(const Reader& in, std::size_t count, bool extents) {
  const std::size_t row_bytes = particle_row_bytes(extents);
  if (in.left() != count * row_bytes)
    broken("does not hold the particles that it states");
  Rows rows;
  rows.count = count;
  rows.data = in.here();
  for (std::size_t i = 0; i < rows.count; ++i) {
    const std::byte* row = rows.data + i * row_bytes;
    check_finite(row, (row_bytes - sizeof(CellHint)) / sizeof(double), i, "particle row");
    double volume;
    std::memcpy(&volume, row + kVolumeAt * sizeof volume, sizeof volume);
    if (!(volume > 0))
      broken("holds a particle without volume");
  }
  return rows;
}

/// The word in front of rows that says whether they have extents.
void check_extents(Reader& in, bool extents) {
  bool with_extents = false;
  in.yes_or_no(with_extents);
  if (with_extents != extents)
    broken("has rows of another length than the terms said");
}

} // namespace

std::size_t particle_row_bytes(bool extents) {
  return sizeof(double) * (kParticleDoubles + (extents ? kExtentDoubles : 0)) + sizeof(CellHint);
}

std::size_t samples_row_bytes(unsigned quantities) {
  return sizeof(double) * columns_of_set(quantities) + sizeof(CellHint);
}

std::size_t max_bytes() {
  return kHeaderBytes + kCouplingStepBytes + kMostParticles * particle_row_bytes(true);
}

Bytes encode(const DemTerms& terms) {
  Bytes message = with_header(Kind::dem_terms, kDemTermsBytes);
  Writer out(message.data() + kHeaderBytes);
  dem_terms_fields(out, terms);
  return message;
}

DemTerms decode_dem_terms(View message) {
  Reader in = body_of(message, Kind::dem_terms);
  DemTerms terms;
  dem_terms_fields(in, terms);
  in.end();
  if (terms.particles < 0 || std::uint64_t(terms.particles) > kMostParticles)
    throw Refusal("the DEM side has " + std::to_string(terms.particles) +
                  " particles but link socket carries at most " + std::to_string(kMostParticles) + ": use link solver");
  if (terms.rank_connections > kMaxRankConnections)
    broken("asks for more lanes than there can be");
  return terms;
}

Bytes encode(const FluidTerms& terms) {
  Bytes message = with_header(Kind::fluid_terms, kFluidTermsBytes);
  Writer out(message.data() + kHeaderBytes);
  fluid_terms_fields(out, terms);
  return message;
}

FluidTerms decode_fluid_terms(View message) {
  Reader in = body_of(message, Kind::fluid_terms);
  FluidTerms terms;
  fluid_terms_fields(in, terms);
  in.end();
  return terms;
}

Bytes encode(const CheckpointMark& mark) {
  Bytes message = with_header(Kind::checkpoint, kMarkBytes);
  Writer out(message.data() + kHeaderBytes);
  mark_fields(out, mark);
  return message;
}

CheckpointMark decode_checkpoint(View message) {
  Reader in = body_of(message, Kind::checkpoint);
  CheckpointMark mark;
  mark_fields(in, mark);
  in.end();
  if (mark.step < 0)
    broken("speaks of a checkpoint before the beginning");
  return mark;
}

namespace {

Bytes encode_text(Kind kind, const std::string& text) {
  const std::size_t length = std::min(text.size(), kMostText);
  Bytes message = with_header(kind, length);
  Writer(message.data() + kHeaderBytes).raw(text.data(), length);
  return message;
}

std::string decode_text(View message, Kind kind, bool lines = false) {
  const Reader in = body_of(message, kind);
  if (in.left() > kMostText)
    broken("is longer than a sentence");
  return printable(reinterpret_cast<const char*>(in.here()), in.left(), lines);
}

} // namespace

Bytes encode_refusal(const std::string& sentence) {
  return encode_text(Kind::refusal, sentence);
}

std::string decode_refusal(View message) {
  return decode_text(message, Kind::refusal);
}

Bytes encode_checkpointed(const std::string& place) {
  return encode_text(Kind::checkpointed, place);
}

std::string decode_checkpointed(View message) {
  return decode_text(message, Kind::checkpointed);
}

Bytes encode_no_rank_connections(const std::string& why) {
  return encode_text(Kind::no_rank_connections, why);
}

std::string decode_no_rank_connections(View message) {
  return decode_text(message, Kind::no_rank_connections);
}

Bytes encode_walls_compared(const std::string& news) {
  return encode_text(Kind::walls_compared, news);
}

std::string decode_walls_compared(View message) {
  return decode_text(message, Kind::walls_compared, true);
}

Bytes encode(const WallDescription& walls) {
  Sizer sizer;
  walls_fields(sizer, walls);
  Bytes message = with_header(Kind::walls, sizer.bytes());
  Writer out(message.data() + kHeaderBytes);
  walls_fields(out, walls);
  return message;
}

WallDescription decode_walls(View message) {
  Reader in = body_of(message, Kind::walls);
  WallDescription walls;
  walls_fields(in, walls);
  in.end();
  return walls;
}

Bytes encode_rank_connections(const std::vector<std::uint32_t>& numbers) {
  Bytes message = with_header(Kind::rank_connections, sizeof(std::uint32_t) * numbers.size());
  Writer(message.data() + kHeaderBytes).raw(numbers.data(), sizeof(std::uint32_t) * numbers.size());
  return message;
}

std::vector<std::uint32_t> decode_rank_connections(View message, std::size_t asked) {
  Reader in = body_of(message, Kind::rank_connections);
  if (in.left() != sizeof(std::uint32_t) * asked)
    broken("names another number of lanes than was asked for");
  std::vector<std::uint32_t> numbers(asked);
  for (std::uint32_t& number : numbers) {
    in.plain(number);
    if (number < 1 || number > kMaxRankConnections)
      broken("names a lane that cannot exist");
  }
  return numbers;
}

Bytes encode_bare(Kind kind) {
  return with_header(kind, 0);
}

bool is_ours(View message) {
  return message.size >= kHeaderBytes && std::memcmp(message.data, kMagic, sizeof kMagic) == 0;
}

Kind kind_of(View message) {
  Reader in(message);
  const Kind kind = read_header(in).kind;
  if (kind == Kind::run_ended || kind == Kind::farewell || kind == Kind::advance || kind == Kind::hello)
    in.end();
  return kind;
}

void write_coupling_step_head(std::byte* message, const CouplingStep& coupling_step, std::size_t count, bool extents) {
  write_header(message, Kind::coupling_step, kCouplingStepBytes + count * particle_row_bytes(extents));
  Writer out(message + kHeaderBytes);
  out.plain(std::uint64_t(count));
  out.yes_or_no(extents);
  coupling_step_fields(out, coupling_step);
}

Rows decode_coupling_step(View message, bool extents, CouplingStep& coupling_step) {
  Reader in = body_of(message, Kind::coupling_step);
  const std::size_t count = checked_count(in);
  check_extents(in, extents);
  coupling_step_fields(in, coupling_step);
  const DemTotals& totals = coupling_step.totals;
  if (coupling_step.elapsed < 0 || totals.particles < 0 || std::uint64_t(totals.particles) > kMostParticles ||
      std::uint64_t(totals.particles) < count)
    broken("contradicts itself about time or particles");
  if (coupling_step.load.ranks < 1)
    broken("comes from no rank");
  return particle_rows(in, count, extents);
}

void write_rows_head(std::byte* message, const RowsMark& mark, std::size_t count, bool extents) {
  write_header(message, Kind::rows, kRowsBytes + count * particle_row_bytes(extents));
  Writer out(message + kHeaderBytes);
  out.plain(std::uint64_t(count));
  out.yes_or_no(extents);
  out.plain(mark.connection);
  out.plain(mark.coupling_step);
}

Rows decode_rows(View message, bool extents, const RowsMark& mark) {
  Reader in = body_of(message, Kind::rows);
  const std::size_t count = checked_count(in);
  check_extents(in, extents);
  if (in.take<std::uint32_t>() != mark.connection)
    broken("comes from another rank than its lane");
  if (in.take<std::int64_t>() != mark.coupling_step)
    broken("belongs to another coupling step");
  return particle_rows(in, count, extents);
}

void write_samples_head(std::byte* message, std::int64_t coupling_step, std::size_t count, unsigned quantities,
                        int stop_signal, std::size_t news) {
  write_header(message, Kind::samples, kSamplesBytes + count * samples_row_bytes(quantities) + news);
  Writer out(message + kHeaderBytes);
  out.plain(std::uint64_t(count));
  out.quantities(quantities);
  out.plain(std::uint32_t(stop_signal));
  out.plain(coupling_step);
}

Rows decode_samples(View message, std::int64_t coupling_step, std::size_t count, unsigned quantities,
                    std::string* news) {
  Reader in = body_of(message, Kind::samples);
  Rows rows;
  rows.count = checked_count(in);
  unsigned sent = 0;
  in.quantities(sent);
  const auto signal = in.take<std::uint32_t>();
  if (signal > kMostSignal)
    broken("names a signal that does not exist");
  rows.stop_signal = static_cast<int>(signal);
  if (in.take<std::int64_t>() != coupling_step || rows.count != count || sent != quantities)
    broken("answers another question than was asked");
  const std::size_t row_bytes = samples_row_bytes(quantities);
  if (in.left() < rows.count * row_bytes || in.left() > rows.count * row_bytes + kMostText)
    broken("does not hold the samples that it states");
  rows.data = in.here();
  if (news)
    *news = printable(reinterpret_cast<const char*>(rows.data + rows.count * row_bytes),
                      in.left() - rows.count * row_bytes, true);
  for (std::size_t i = 0; i < rows.count; ++i)
    check_finite(rows.data + i * row_bytes, (row_bytes - sizeof(CellHint)) / sizeof(double), i, "samples row");
  return rows;
}

void check_cell_hints(Rows rows, bool extents, const std::vector<std::int32_t>& cells_of_rank) {
  const std::size_t row_bytes = particle_row_bytes(extents);
  for (std::size_t i = 0; i < rows.count; ++i) {
    CellHint cell_hint;
    std::memcpy(&cell_hint, rows.data + (i + 1) * row_bytes - sizeof cell_hint, sizeof cell_hint);
    if (cell_hint.rank < 0)
      continue;
    if (std::size_t(cell_hint.rank) >= cells_of_rank.size() || cell_hint.cell < 0 ||
        cell_hint.cell >= cells_of_rank[cell_hint.rank])
      broken("holds a particle that was found in a cell that does not exist");
  }
}

void pack_particles(const ParticleArrays& particles, bool extents, std::byte* rows) {
  Writer out(rows);
  for (std::size_t i = 0; i < particles.count; ++i) {
    out.raw(particles.position[i], sizeof particles.position[i]);
    out.plain(particles.volume[i]);
    out.raw(particles.impulse[i], sizeof particles.impulse[i]);
    out.plain(particles.drag_coefficient[i]);
    if (extents)
      out.raw(particles.extent[i], sizeof particles.extent[i]);
    out.plain(particles.cell_hint[i]);
  }
}

void ParticlePoints::load(const std::vector<Rows>& parts, bool extents, unsigned quantities) {
  count_ = 0;
  for (const Rows& rows : parts)
    count_ += rows.count;
  quantities_ = quantities;
  extents_ = extents;
  position_.resize(3 * count_);
  volume_.resize(count_);
  impulse_.resize(3 * count_);
  drag_.resize(count_);
  extent_.resize(extents ? kExtentDoubles * count_ + 1 : 0);
  cell_hint_.resize(count_);
  const std::size_t row_bytes = particle_row_bytes(extents);
  std::size_t i = 0;
  for (const Rows& rows : parts) {
    for (std::size_t k = 0; k < rows.count; ++k, ++i) {
      const std::byte* from = rows.data + k * row_bytes;
      const auto take = [&from](void* to, std::size_t bytes) {
        std::memcpy(to, from, bytes);
        from += bytes;
      };
      take(&position_[3 * i], 3 * sizeof(double));
      take(&volume_[i], sizeof(double));
      take(&impulse_[3 * i], 3 * sizeof(double));
      take(&drag_[i], sizeof(double));
      if (extents)
        take(&extent_[kExtentDoubles * i], kExtentDoubles * sizeof(double));
      take(&cell_hint_[i], sizeof(CellHint));
      if (cell_hint_[i].rank < 0)
        cell_hint_[i] = CellHint{};
    }
  }
  // An array that is wanted has an address even without rows: collective calls tell by it what is asked for.
  for (const FlowQuantity& quantity : kFlowQuantities)
    if (quantities & quantity.bit)
      values_[quantity.bit].resize(std::max<std::size_t>(count_ * quantity.columns, 1));
}

ParticleArrays ParticlePoints::particles() {
  ParticleArrays arrays;
  arrays.count = count_;
  arrays.position = reinterpret_cast<const double(*)[3]>(position_.data());
  arrays.volume = volume_.data();
  arrays.impulse = reinterpret_cast<const double(*)[3]>(impulse_.data());
  arrays.drag_coefficient = drag_.data();
  if (extents_)
    arrays.extent = reinterpret_cast<const double(*)[kExtentDoubles]>(extent_.data());
  arrays.cell_hint = cell_hint_.data();
  return arrays;
}

FluidSamples ParticlePoints::samples() {
  FluidSamples samples;
  for (const FlowQuantity& quantity : kFlowQuantities)
    if (quantities_ & quantity.bit)
      samples[quantity.bit] = values_[quantity.bit].data();
  return samples;
}

void ParticlePoints::pack_samples(std::size_t first, std::size_t count, std::byte* rows) const {
  Writer out(rows);
  for (std::size_t i = first; i < first + count; ++i) {
    for (const FlowQuantity& quantity : kFlowQuantities)
      if (quantities_ & quantity.bit)
        out.raw(values_[quantity.bit].data() + i * quantity.columns, quantity.columns * sizeof(double));
    out.plain(cell_hint_[i]);
  }
}

void unpack_samples(Rows rows, unsigned quantities, const FluidSamples& samples, CellHint* cell_hints) {
  const std::byte* from = rows.data;
  for (std::size_t i = 0; i < rows.count; ++i) {
    for (const FlowQuantity& quantity : kFlowQuantities) {
      if (!(quantities & quantity.bit))
        continue;
      const std::size_t bytes = quantity.columns * sizeof(double);
      if (double* values = samples[quantity.bit])
        std::memcpy(values + i * quantity.columns, from, bytes);
      from += bytes;
    }
    std::memcpy(&cell_hints[i], from, sizeof(CellHint));
    from += sizeof(CellHint);
  }
}

} // namespace eccentra::link::wire
