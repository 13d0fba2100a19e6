// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The DEM side of the socket link.
#include "link/socket_peer.h"

#include "link/ranks.h"

#include <cstring>

namespace eccentra::link {

SocketPeer::SocketPeer(MPI_Comm ranks, const Address& address, const Patience& patience) : ranks_(ranks) {
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
  if (channel_)
    channel_->refuse("the DEM side has stopped: " + why);
  channel_.reset();
}

template <class Work> wire::Bytes SocketPeer::on_root_or_leave(Work&& work) {
  try {
    return on_root(ranks_, [&] {
      if (!channel_)
        throw Refusal("the link has been closed after an error");
      return work();
    });
  } catch (const Refusal& refusal) {
    leave(refusal.what());
    throw;
  }
}

FluidTerms SocketPeer::agree(const DemTerms& dem) {
  extents_ = dem.extents;
  const wire::Bytes reply = on_root_or_leave([&] {
    channel_->send(Channel::Message(wire::encode(dem)));
    const Channel::Message message = channel_->receive();
    const FluidTerms fluid = wire::decode_fluid_terms(message.view());
    if (const std::string text = disagreement(dem, fluid); !text.empty())
      throw Refusal(text);
    return wire::Bytes(message.view().data, message.view().data + message.view().size);
  });
  return wire::decode_fluid_terms({reply.data(), reply.size()});
}

int SocketPeer::meet(const Meeting& meeting, const ParticleArrays& particles, const fluid::FluidSamples& samples) {
  const double begun = MPI_Wtime();
  const std::size_t row_bytes = wire::particle_row_bytes(extents_);
  const std::size_t answer_bytes = wire::samples_row_bytes(meeting.needed);
  const Shares shares = gather_shares(ranks_, particles.count);
  constexpr std::size_t head = wire::kHeaderBytes + wire::kMeetingBytes;
  on_root_or_leave([&] {
    if (static_cast<std::uint64_t>(meeting.totals.particles) > wire::kMostParticles)
      throw Refusal("there are more particles than the " + std::to_string(wire::kMostParticles) +
                    " that link socket carries: use link solver");
    return wire::Bytes();
  });
  // Rank 0's rows go where they are sent from, and are read where they were received.
  Channel::Message message(channel_ ? head + shares.total * row_bytes : 0);
  if (!channel_)
    rows_.resize(particles.count * std::max(row_bytes, answer_bytes));
  std::byte* const all = channel_ ? message.data() + head : nullptr;
  std::byte* const mine = channel_ ? all : rows_.data();
  wire::pack_particles(particles, extents_, mine);
  gather_rows(ranks_, mine, static_cast<int>(particles.count), row_bytes, shares, all);
  double answered = begun, asked = begun;
  wire::Rows answer;
  const wire::Bytes signal = on_root_or_leave([&] {
    Meeting told = meeting;
    told.pack_seconds += transport_seconds_;
    wire::write_meeting_head(message.data(), told, shares.total, extents_);
    // Before sending: the other side begins at once, and may take this processor.
    asked = MPI_Wtime();
    channel_->send(std::move(message));
    message = channel_->receive();
    answered = MPI_Wtime();
    answer = wire::decode_samples(message.view(), shares.total, meeting.needed);
    return wire::Bytes(1, std::byte(answer.stop_signal));
  });
  scatter_rows(ranks_, answer.data, shares, answer_bytes, rows_.data(), static_cast<int>(particles.count));
  wire::unpack_samples({particles.count, channel_ ? answer.data : rows_.data()}, meeting.needed, samples,
                       particles.ticket);
  transport_seconds_ = MPI_Wtime() - begun - (answered - asked);
  return std::to_integer<int>(signal.at(0));
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
