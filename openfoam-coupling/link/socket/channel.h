// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// One connection between two programs that carries whole messages and notices when the other side is gone.
#pragma once

#include "link/socket/address.h"
#include "link/socket/wire.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace eccentra::link {

/// One end of the link. Waiting sleeps in the kernel. Not for several threads.
class Channel {
 public:
  enum class Side { dem, fluid }; ///< the fluid side binds the address, the DEM side connects to it

  /// Does not wait for the other side. Throws Refusal if the address cannot be used.
  Channel(Side side, const Address& address, const Timeout& patience);
  ~Channel();

  /// A message in one piece.
  class Message {
   public:
    Message();
    /// Room for `bytes`.
    explicit Message(std::size_t bytes);
    /// A copy of `bytes`.
    explicit Message(const wire::Bytes& bytes);
    ~Message();
    /// Takes the memory of another message.
    Message(Message&&) noexcept;
    /// The same.
    Message& operator=(Message&&) noexcept;
    /// Its contents, to be written.
    std::byte* data();
    /// Its contents, to be read; valid as long as the message.
    wire::View view() const;

   private:
    friend class Channel;
    struct Parts;
    std::unique_ptr<Parts> parts_;
  };

  /// Throws Refusal if the other side is gone.
  void send(Message message);
  /// The next message. Waits as long as the other side lives; throws Refusal if it does not come, goes, or refuses.
  /// While it waits it calls `look` several times a second, which may throw to end the wait. The fluid side
  /// where strangers can connect (TCP without keys), until settle(): whoever goes, refuses or speaks nonsense is
  /// forgotten, and the wait for the other side goes on.
  Message receive(const std::function<void()>& look = {});
  /// The fluid side: the one that was heard is the other side.
  void settle() noexcept;
  /// The fluid side, before settle(): the one that was heard is not the other side, and is told why. Throws Refusal
  /// with these words where no stranger can connect.
  void dismiss(const std::string& why);
  /// The sentence of a refusal that has come, or comes within this time; empty if none does.
  std::string last_words(double seconds);
  /// Tells the other side why this one goes no further, and closes.
  void refuse(const std::string& sentence) noexcept;
  /// Sends what is left and closes.
  void close() noexcept;

  /// That the fluid side has bound, of a TCP address.
  std::uint32_t port() const;
  /// Of the messages that have gone either way.
  std::uint64_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace eccentra::link
