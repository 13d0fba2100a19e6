// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Serves a DEM job that runs apart.
#include "link/fluid_server.h"

#include "link/ranks.h"

#include <cstring>
#include <type_traits>

namespace eccentra::link {

/// What rank 0 has received, without the rows; the same on every rank.
struct FluidServer::Command {
  wire::Kind kind = wire::Kind::farewell;
  std::size_t count = 0;
  DemTerms terms;
  Meeting meeting;
  CheckpointMark mark;
};

FluidServer::FluidServer(MPI_Comm ranks, const Address& address, const Patience& patience, std::int32_t cells)
    : ranks_(ranks) {
  int rank = 0, size = 1;
  MPI_Comm_rank(ranks, &rank);
  MPI_Comm_size(ranks, &size);
  cells_of_rank_.resize(rank == 0 ? size : 0);
  MPI_Gather(&cells, 1, MPI_INT32_T, cells_of_rank_.data(), 1, MPI_INT32_T, 0, ranks);
  on_root(ranks_, [&] {
    channel_ = std::make_unique<Channel>(Channel::Side::fluid, address, patience);
    return wire::Bytes();
  });
}

FluidServer::~FluidServer() = default;

FluidServer::Command FluidServer::next_command() {
  static_assert(std::is_trivially_copyable_v<Command>, "ranks pass it on as bytes");
  const wire::Bytes bytes = on_root(ranks_, [&] {
    message_ = channel_->receive();
    Command command;
    command.kind = wire::kind_of(message_.view());
    if (command.kind == wire::Kind::dem_terms) {
      command.terms = wire::decode_dem_terms(message_.view());
    } else if (command.kind == wire::Kind::meeting && agreed_) {
      const wire::Rows rows = wire::decode_meeting(message_.view(), extents_, command.meeting);
      wire::check_tickets(rows, extents_, cells_of_rank_);
      if (command.meeting.needed & ~offered_)
        throw Refusal(
            "the DEM side asks for fluid quantities that this solver does not offer: drop the effect that needs "
            "them from fix fluid/force");
      command.count = rows.count;
      command.meeting.pack_seconds += transport_seconds_;
    } else if (command.kind == wire::Kind::checkpoint && agreed_) {
      command.mark = wire::decode_checkpoint(message_.view());
    } else if (command.kind != wire::Kind::run_ended && command.kind != wire::Kind::farewell &&
               !(command.kind == wire::Kind::advance && agreed_ && overlap_)) {
      throw Refusal("the DEM side spoke out of turn: install the same release of Eccentra on both sides");
    }
    wire::Bytes packed(sizeof command);
    std::memcpy(packed.data(), &command, sizeof command);
    return packed;
  });
  Command command;
  std::memcpy(&command, bytes.data(), sizeof command);
  return command;
}

void FluidServer::answer_terms(FluidPeer& fluid, const Command& command) {
  const FluidTerms terms = fluid.agree(command.terms);
  offered_ = terms.offered;
  extents_ = command.terms.extents;
  overlap_ = command.terms.overlap;
  agreed_ = true;
  on_root(ranks_, [&] {
    channel_->send(Channel::Message(wire::encode(terms)));
    return wire::Bytes();
  });
}

void FluidServer::answer_meeting(FluidPeer& fluid, const Command& command) {
  const double begun = MPI_Wtime();
  const std::size_t row_bytes = wire::particle_row_bytes(extents_);
  const std::size_t answer_bytes = wire::samples_row_bytes(command.meeting.needed);
  const Shares shares = even_shares(ranks_, command.count);
  int rank = 0;
  MPI_Comm_rank(ranks_, &rank);
  const std::size_t mine = shares.count[rank];
  if (!channel_)
    rows_.resize(mine * std::max(row_bytes, answer_bytes));
  const std::byte* const all = channel_ ? message_.view().data + wire::kHeaderBytes + wire::kMeetingBytes : nullptr;
  scatter_rows(ranks_, all, shares, row_bytes, rows_.data(), static_cast<int>(mine));
  guests_.load({mine, channel_ ? all : rows_.data()}, extents_, command.meeting.needed);
  const double ready = MPI_Wtime();

  const int signal = fluid.meet(command.meeting, guests_.particles(), guests_.samples());

  const double met = MPI_Wtime();
  constexpr std::size_t head = wire::kHeaderBytes + wire::kSamplesBytes;
  Channel::Message answer(channel_ ? head + command.count * answer_bytes : 0);
  std::byte* const answers = channel_ ? answer.data() + head : nullptr;
  guests_.pack_samples(channel_ ? answers : rows_.data());
  gather_rows(ranks_, rows_.data(), static_cast<int>(mine), answer_bytes, shares, answers);
  on_root(ranks_, [&] {
    wire::write_samples_head(answer.data(), command.count, command.meeting.needed, signal);
    // Before sending: the DEM side begins at once, and may take this processor.
    transport_seconds_ = MPI_Wtime() - met + ready - begun;
    channel_->send(std::move(answer));
    return wire::Bytes();
  });
}

void FluidServer::answer_checkpoint(FluidPeer& fluid, const Command& command) {
  const std::string place = fluid.checkpoint(command.mark);
  on_root(ranks_, [&] {
    channel_->send(Channel::Message(wire::encode_checkpointed(place)));
    return wire::Bytes();
  });
}

void FluidServer::serve(FluidPeer& fluid) {
  try {
    for (;;) {
      const Command command = next_command();
      if (command.kind == wire::Kind::farewell)
        return;
      if (command.kind == wire::Kind::dem_terms)
        answer_terms(fluid, command);
      else if (command.kind == wire::Kind::meeting)
        answer_meeting(fluid, command);
      else if (command.kind == wire::Kind::checkpoint)
        answer_checkpoint(fluid, command);
      else if (command.kind == wire::Kind::advance)
        fluid.advance();
      else
        fluid.run_ended();
    }
  } catch (const Refusal& refusal) {
    // Both sides print the same sentence.
    if (channel_)
      channel_->refuse(refusal.what());
    throw;
  } catch (const std::exception& problem) {
    if (channel_)
      channel_->refuse(std::string("the fluid side has stopped: ") + problem.what());
    throw;
  }
}

} // namespace eccentra::link
