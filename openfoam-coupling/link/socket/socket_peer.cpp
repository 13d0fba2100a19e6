// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The DEM side of the socket link.
#include "link/socket/socket_peer.h"

#include "link/ranks.h"

#include <algorithm>

namespace eccentra::link {
namespace {
/// One number tells all ranks the stop signal and the length of the news.
constexpr long long kNewsFrom = 256;
} // namespace

SocketPeer::SocketPeer(MPI_Comm ranks, const Address& address, const Timeout& patience, Rows rows)
    : ranks_(ranks), address_(address), timeout_(patience) {
  rank_connections_asked_ = static_cast<std::uint32_t>(size_of(ranks)) - 1;
  if (rank_connections_asked_ > 0 && rows == Rows::over_root)
    why_over_root_ = "the script says lanes no";
  on_root(ranks_, [&] {
    channel_ = std::make_unique<Channel>(Channel::Side::dem, address, patience);
    return wire::Bytes();
  });
}

SocketPeer::~SocketPeer() {
  if (!channel_)
    return;
  try {
    channel_->send(Channel::Message(wire::encode_bare(wire::Kind::farewell)));
  } catch (...) {
    // The fluid side has gone; nobody is left to be told.
  }
}

void SocketPeer::leave(const std::string& why) noexcept {
  const std::string sentence = "the DEM side has stopped: " + why;
  if (channel_)
    channel_->refuse(sentence);
  channel_.reset();
  rank_connections_.refuse(sentence);
  left_ = true;
}

std::uint64_t SocketPeer::bytes() {
  std::uint64_t sum = channel_ ? channel_->bytes() : 0;
  for (const RankConnection& connection : rank_connections_)
    sum += connection.channel->bytes();
  return sum;
}

template <class Work> auto SocketPeer::or_leave(Work&& work) -> decltype(work()) {
  if (left_)
    throw Refusal("the link has been closed after an error");
  try {
    return work();
  } catch (const Refusal& refusal) {
    leave(refusal.what());
    throw;
  }
}

template <class Work> wire::Bytes SocketPeer::on_root_or_leave(Work&& work) {
  return or_leave([&] { return on_root(ranks_, work); });
}

FluidTerms SocketPeer::agree(const DemTerms& dem) {
  DemTerms applied = dem;
  if (!settled_ && rank_connections_asked_ > 0 && why_over_root_.empty())
    why_over_root_ = why_no_rank_connections(ranks_, Channel::Side::dem, address_, rank_connections_asked_);
  if (!settled_ && !why_over_root_.empty())
    rank_connections_asked_ = 0;
  applied.rank_connections = rank_connections_asked_;
  extents_ = dem.extents;
  const wire::Bytes reply = on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode(applied)));
    const Channel::Message message = channel_->receive();
    const FluidTerms fluid = wire::decode_fluid_terms(message.view());
    if (const std::string text = disagreement(applied, fluid); !text.empty())
      throw Refusal(text);
    return wire::Bytes(message.view().data, message.view().data + message.view().size);
  });
  if (!settled_ && applied.rank_connections > 0)
    open_rank_connections(applied.rank_connections);
  settled_ = true;
  return wire::decode_fluid_terms({reply.data(), reply.size()});
}

void SocketPeer::open_rank_connections(std::uint32_t count) {
  const wire::Bytes reply = on_root_or_leave([&] {
    const Channel::Message message = channel_->receive();
    if (wire::kind_of(message.view()) != wire::Kind::no_rank_connections)
      wire::decode_rank_connections(message.view(), count);
    return wire::Bytes(message.view().data, message.view().data + message.view().size);
  });
  const wire::View message{reply.data(), reply.size()};
  by_rank_connections_ = wire::kind_of(message) == wire::Kind::rank_connections;
  if (by_rank_connections_)
    or_leave([&] {
      rank_connections_.connect(ranks_, address_, timeout_, wire::decode_rank_connections(message, count), extents_);
    });
  else
    why_over_root_ = wire::decode_no_rank_connections(message);
}

StepAnswer SocketPeer::couple(const CouplingStep& coupling_step, const ParticleArrays& particles,
                              const link::FluidSamples& samples) {
  const double begun = MPI_Wtime();
  const std::size_t row_bytes = wire::particle_row_bytes(extents_);
  const std::size_t answer_bytes = wire::samples_row_bytes(coupling_step.needed);
  CouplingStep applied = coupling_step;
  applied.pack_seconds += transport_seconds_;
  applied.number = ++coupling_steps_;
  // The totals are the same on every rank.
  or_leave([&] {
    if (static_cast<std::uint64_t>(coupling_step.totals.particles) > wire::kMostParticles)
      throw Refusal("there are more particles than the " + std::to_string(wire::kMostParticles) +
                    " that link socket carries: use link solver");
  });
  const Shares shares = by_rank_connections_ ? Shares() : gather_shares(ranks_, particles.count);
  // Rows go where they are sent from, and samples are read where they were received.
  Channel* const way = channel_               ? channel_.get()
                       : by_rank_connections_ ? rank_connections_.begin()->channel.get()
                                              : nullptr;
  const std::size_t head = wire::kHeaderBytes + (channel_ ? wire::kCouplingStepBytes : wire::kRowsBytes);
  const std::size_t count = by_rank_connections_ ? particles.count : shares.total;
  Channel::Message message(way ? head + count * row_bytes : 0);
  if (!way)
    rows_.resize(particles.count * std::max(row_bytes, answer_bytes));
  std::byte* const mine = way ? message.data() + head : rows_.data();
  wire::pack_particles(particles, extents_, mine);
  if (!by_rank_connections_)
    gather_rows(ranks_, mine, static_cast<int>(particles.count), row_bytes, shares, mine);
  double answered = begun, asked = begun;
  wire::Rows answer;
  StepAnswer all;
  const auto exchange = [&](const Look& look) {
    if (!way)
      return 0LL;
    if (channel_)
      wire::write_coupling_step_head(message.data(), applied, count, extents_);
    else
      wire::write_rows_head(message.data(), {rank_connections_.begin()->rank, applied.number}, count, extents_);
    // Before sending: the other side begins at once, and may take this processor.
    asked = MPI_Wtime();
    way->send(std::move(message));
    message = way->receive(look);
    answered = MPI_Wtime();
    answer = wire::decode_samples(message.view(), applied.number, count, coupling_step.needed, &all.news);
    return answer.stop_signal + kNewsFrom * static_cast<long long>(all.news.size());
  };
  const std::vector<long long> answers = or_leave([&] { return on_all(ranks_, exchange); });
  if (!by_rank_connections_)
    scatter_rows(ranks_, answer.data, shares, answer_bytes, rows_.data(), static_cast<int>(particles.count));
  wire::unpack_samples({particles.count, way ? answer.data : rows_.data()}, coupling_step.needed, samples,
                       particles.cell_hint);
  transport_seconds_ = MPI_Wtime() - begun - (answered - asked);
  all.stop_signal = static_cast<int>(answers.front() % kNewsFrom);
  all.news.resize(answers.front() / kNewsFrom);
  if (!all.news.empty())
    MPI_Bcast(all.news.data(), static_cast<int>(all.news.size()), MPI_CHAR, 0, ranks_);
  return all;
}

std::string SocketPeer::compare_walls(const WallDescription& walls) {
  const wire::Bytes news = on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode(walls)));
    const Channel::Message message = channel_->receive();
    const std::string text = wire::decode_walls_compared(message.view());
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return wire::Bytes(bytes, bytes + text.size());
  });
  return {reinterpret_cast<const char*>(news.data()), news.size()};
}

void SocketPeer::advance() {
  on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode_bare(wire::Kind::advance)));
    return wire::Bytes();
  });
}

std::string SocketPeer::checkpoint(const CheckpointMark& mark) {
  const wire::Bytes place = on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode(mark)));
    const Channel::Message message = channel_->receive();
    const std::string text = wire::decode_checkpointed(message.view());
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    return wire::Bytes(bytes, bytes + text.size());
  });
  return {reinterpret_cast<const char*>(place.data()), place.size()};
}

void SocketPeer::run_ended() {
  on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode_bare(wire::Kind::run_ended)));
    return wire::Bytes();
  });
}

} // namespace eccentra::link
