// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Serves a DEM job that runs apart.
#include "link/socket/fluid_server.h"

#include "link/ranks.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>
#include <utility>

namespace eccentra::link {
namespace {

/// Time in which the arguments of a rank that ended all others arrive [s].
constexpr double kLastWordsWithin = 0.2;
constexpr std::size_t kAnswerHead = wire::kHeaderBytes + wire::kSamplesBytes;

/// Who does not take its answer any more is noticed when its next message is due.
void send(Channel& channel, Channel::Message message) {
  try {
    channel.send(std::move(message));
  } catch (const Refusal&) {
    return;
  }
}

} // namespace

/// What rank 0 has received, without the rows; the same on every rank.
struct FluidServer::Command {
  wire::Kind kind = wire::Kind::farewell;
  std::size_t count = 0;
  DemTerms terms;
  CouplingStep coupling_step;
  CheckpointMark mark;
};

FluidServer::FluidServer(MPI_Comm ranks, const Address& address, const Timeout& patience, std::int32_t cells)
    : ranks_(ranks), address_(address), timeout_(patience) {
  cells_of_rank_.resize(size_of(ranks));
  MPI_Allgather(&cells, 1, MPI_INT32_T, cells_of_rank_.data(), 1, MPI_INT32_T, ranks);
  on_root(ranks_, [&] {
    channel_ = std::make_unique<Channel>(Channel::Side::fluid, address, patience);
    return wire::Bytes();
  });
}

FluidServer::~FluidServer() = default;

DemTerms FluidServer::first_terms() {
  for (;;) {
    message_ = channel_->receive();
    try {
      if (wire::kind_of(message_.view()) != wire::Kind::dem_terms)
        throw Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
      return wire::decode_dem_terms(message_.view());
    } catch (const Refusal& why) {
      // A stranger does not end the wait for the DEM side.
      channel_->dismiss(why.what());
    }
  }
}

wire::Bytes FluidServer::receive_command() {
  Command command;
  if (!agreed_) {
    command.kind = wire::Kind::dem_terms;
    command.terms = first_terms();
  } else {
    message_ = channel_->receive();
    command.kind = wire::kind_of(message_.view());
    decode_command(command);
  }
  wire::Bytes packed(sizeof command);
  std::memcpy(packed.data(), &command, sizeof command);
  return packed;
}

void FluidServer::decode_command(Command& command) {
  switch (command.kind) {
  case wire::Kind::dem_terms:
    command.terms = wire::decode_dem_terms(message_.view());
    return;
  case wire::Kind::walls:
    walls_ = wire::decode_walls(message_.view());
    return;
  case wire::Kind::checkpoint:
    command.mark = wire::decode_checkpoint(message_.view());
    return;
  case wire::Kind::run_ended:
  case wire::Kind::farewell:
    return;
  case wire::Kind::advance:
    if (overlap_)
      return;
    break;
  case wire::Kind::coupling_step: {
    const wire::Rows rows = wire::decode_coupling_step(message_.view(), extents_, command.coupling_step);
    wire::check_cell_hints(rows, extents_, cells_of_rank_);
    if (command.coupling_step.needed & ~offered_)
      throw Refusal(
          "the DEM side asks for fluid quantities that this solver does not offer: drop the effect that needs "
          "them from fix fluid/force");
    if (command.coupling_step.number != ++coupling_steps_)
      throw Refusal("the DEM side left out a coupling step: install the same release of Eccentra on both sides");
    command.count = rows.count;
    command.coupling_step.pack_seconds += transport_seconds_;
    return;
  }
  default:
    break;
  }
  throw Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
}

FluidServer::Command FluidServer::next_command() {
  static_assert(std::is_trivially_copyable_v<Command>, "ranks pass it on as bytes");
  wire::Bytes bytes;
  try {
    bytes = on_root(ranks_, [&] { return receive_command(); });
  } catch (const Refusal& refusal) {
    // A rank of DEM that ended all others may have said why on its own connection.
    const std::string why = refusal.what();
    if (by_rank_connections_)
      on_all(ranks_, [&](const Look&) {
        for (RankConnection& connection : rank_connections_)
          if (const std::string arguments = connection.channel->last_words(kLastWordsWithin); !arguments.empty())
            throw Refusal(arguments);
        return 0;
      });
    throw Refusal(why);
  }
  Command command;
  std::memcpy(&command, bytes.data(), sizeof command);
  return command;
}

void FluidServer::answer_terms(FluidPeer& fluid, const Command& command) {
  if (agreed_ && command.terms.rank_connections != rank_connections_asked_)
    throw Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
  const FluidTerms terms = fluid.agree(command.terms);
  offered_ = terms.offered;
  extents_ = command.terms.extents;
  overlap_ = command.terms.overlap;
  on_root(ranks_, [&] {
    channel_->settle();
    channel_->send(Channel::Message(wire::encode(terms)));
    return wire::Bytes();
  });
  if (!agreed_ && command.terms.rank_connections > 0)
    open_rank_connections(command.terms.rank_connections);
  rank_connections_asked_ = command.terms.rank_connections;
  agreed_ = true;
}

void FluidServer::open_rank_connections(std::uint32_t count) {
  const std::string why = why_no_rank_connections(ranks_, Channel::Side::fluid, address_, count);
  by_rank_connections_ = why.empty();
  const std::vector<std::uint32_t> numbers =
      by_rank_connections_ ? rank_connections_.bind(ranks_, address_, timeout_, count) : std::vector<std::uint32_t>();
  on_root(ranks_, [&] {
    channel_->send(Channel::Message(by_rank_connections_ ? wire::encode_rank_connections(numbers)
                                                         : wire::encode_no_rank_connections(why)));
    return wire::Bytes();
  });
  if (by_rank_connections_)
    rank_connections_.greet(ranks_, extents_);
}

std::vector<wire::Rows> FluidServer::rows_of_rank_connections(const Command& command) {
  std::vector<wire::Rows> parts;
  if (channel_)
    parts.push_back({command.count, message_.view().data + wire::kHeaderBytes + wire::kCouplingStepBytes});
  const std::vector<long long> counts = on_all(ranks_, [&](const Look& look) {
    for (RankConnection& connection : rank_connections_) {
      connection.message = connection.channel->receive(look);
      parts.push_back(
          wire::decode_rows(connection.message.view(), extents_, {connection.rank, command.coupling_step.number}));
      wire::check_cell_hints(parts.back(), extents_, cells_of_rank_);
    }
    return std::accumulate(parts.begin(), parts.end(), 0LL, [](long long sum, const wire::Rows& rows) {
      return sum + static_cast<long long>(rows.count);
    });
  });
  if (std::accumulate(counts.begin(), counts.end(), 0LL) != command.coupling_step.totals.particles)
    throw Refusal("the ranks of DEM have sent another number of particles than they speak of: install the same release "
                  "of Eccentra on both sides");
  return parts;
}

std::vector<wire::Rows> FluidServer::dealt_rows(const Command& command) {
  if (command.count != static_cast<std::size_t>(command.coupling_step.totals.particles))
    throw Refusal("the DEM side has sent another number of particles than it speaks of: install the same release of "
                  "Eccentra on both sides");
  const std::size_t row_bytes = wire::particle_row_bytes(extents_);
  const Shares shares = even_shares(ranks_, command.count);
  const int mine = shares.count[rank_of(ranks_)];
  if (!channel_)
    rows_.resize(mine * std::max(row_bytes, wire::samples_row_bytes(command.coupling_step.needed)));
  const std::byte* const all =
      channel_ ? message_.view().data + wire::kHeaderBytes + wire::kCouplingStepBytes : nullptr;
  scatter_rows(ranks_, all, shares, row_bytes, rows_.data(), mine);
  return {{static_cast<std::size_t>(mine), channel_ ? all : rows_.data()}};
}

Channel::Message FluidServer::answer(const Command& command, std::size_t count, int signal, const std::string& news) {
  const unsigned asked = command.coupling_step.needed;
  const std::size_t rows = count * wire::samples_row_bytes(asked);
  Channel::Message message(kAnswerHead + rows + news.size());
  wire::write_samples_head(message.data(), command.coupling_step.number, count, asked, signal, news.size());
  std::memcpy(message.data() + kAnswerHead + rows, news.data(), news.size());
  return message;
}

void FluidServer::answer_coupling_step(FluidPeer& fluid, const Command& command) {
  const double begun = MPI_Wtime();
  const std::vector<wire::Rows> parts = by_rank_connections_ ? rows_of_rank_connections(command) : dealt_rows(command);
  particlePoints_.load(parts, extents_, command.coupling_step.needed);
  const double ready = MPI_Wtime();

  StepAnswer said = fluid.couple(command.coupling_step, particlePoints_.particles(), particlePoints_.samples());
  said.news.resize(std::min(said.news.size(), wire::kMostText));
  const int signal = said.stop_signal;

  const double met = MPI_Wtime();
  Channel::Message of_root = channel_ ? answer(command, command.count, signal, said.news) : Channel::Message();
  std::byte* const to = channel_ ? of_root.data() + kAnswerHead : rows_.data();
  auto part = parts.begin();
  std::size_t first = 0;
  if (channel_ || !by_rank_connections_) {
    particlePoints_.pack_samples(0, part->count, to);
    first = part++->count;
  }
  if (!by_rank_connections_)
    gather_rows(ranks_, to, static_cast<int>(first), wire::samples_row_bytes(command.coupling_step.needed),
                even_shares(ranks_, command.count), to);
  for (const RankConnection& connection : rank_connections_) {
    Channel::Message message = answer(command, part->count, signal);
    particlePoints_.pack_samples(first, part->count, message.data() + kAnswerHead);
    first += part++->count;
    send(*connection.channel, std::move(message));
  }
  // Before sending: the DEM side begins at once, and may take this processor.
  transport_seconds_ = MPI_Wtime() - met + ready - begun;
  if (channel_)
    send(*channel_, std::move(of_root));
}

void FluidServer::answer_checkpoint(FluidPeer& fluid, const Command& command) {
  const std::string place = fluid.checkpoint(command.mark);
  on_root(ranks_, [&] {
    channel_->send(Channel::Message(wire::encode_checkpointed(place)));
    return wire::Bytes();
  });
}

void FluidServer::answer_walls(FluidPeer& fluid) {
  const std::string news = fluid.compare_walls(walls_);
  walls_ = {};
  on_root(ranks_, [&] {
    channel_->send(Channel::Message(wire::encode_walls_compared(news)));
    return wire::Bytes();
  });
}

void FluidServer::refuse(const std::string& sentence) noexcept {
  if (channel_)
    channel_->refuse(sentence);
  rank_connections_.refuse(sentence);
}

void FluidServer::serve(FluidPeer& fluid) {
  try {
    for (;;) {
      const Command command = next_command();
      if (command.kind == wire::Kind::farewell)
        return;
      if (command.kind == wire::Kind::dem_terms)
        answer_terms(fluid, command);
      else if (command.kind == wire::Kind::walls)
        answer_walls(fluid);
      else if (command.kind == wire::Kind::coupling_step)
        answer_coupling_step(fluid, command);
      else if (command.kind == wire::Kind::checkpoint)
        answer_checkpoint(fluid, command);
      else if (command.kind == wire::Kind::advance)
        fluid.advance();
      else
        fluid.run_ended();
    }
  } catch (const Refusal& refusal) {
    // Both sides print the same sentence.
    refuse(refusal.what());
    throw;
  } catch (const std::exception& problem) {
    refuse(std::string("the fluid side has stopped: ") + problem.what());
    throw;
  }
}

} // namespace eccentra::link
