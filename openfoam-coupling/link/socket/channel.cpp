// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The connection on ZeroMQ: DEALER to ROUTER, their heartbeats, and the monitor, which tells when the other side has
// gone. The ROUTER hears everybody. Where strangers can connect (TCP without keys) it holds with the first whose terms
// it accepts: until then nobody who comes, says whatever, or leaves ends its wait. Elsewhere it holds with the first
// who speaks the protocol.
#include "link/socket/channel.h"

#include "link/socket/key_guard.h"
#include "link/socket/keys.h"

#include <zmq.hpp>

#include <malloc.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <thread>

namespace eccentra::link {
namespace {

using Clock = std::chrono::steady_clock;

/// Parts of the silence after which a sign of life is asked for, and for which it is then waited; together below 1.
constexpr double kAskAfter = 0.3;
constexpr double kAnswerWithin = 0.6;
/// Time that the last message of a closing side has to leave [ms].
constexpr int kLinger = 1000;
constexpr int kReconnect = 50; ///< [ms]
/// Time in which a connection to who is there is made [ms].
constexpr int kConnect = 200;
constexpr long kLook = 100; ///< from one look of a caller that waits to the next [ms]
constexpr int kNobody = -1;
const char* const kMonitor = "inproc://eccentra-link-monitor";

int milliseconds(double seconds) {
  return std::max(1, static_cast<int>(std::lround(1000 * seconds)));
}

/// Messages of megabytes come and go at every coupling step. Their memory stays with the process: handing it back to
/// the system and having it cleared again takes longer than sending.
void keep_memory() {
  constexpr int kMostMapped = 32 << 20; // the largest that the library accepts
  constexpr int kKept = 256 << 20;
  mallopt(M_MMAP_THRESHOLD, kMostMapped);
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_TOP_PAD, kMostMapped);
}

/// A path that another program listens on, or that is no socket, must not be taken from its owner.
void check_path(const std::string& address, const std::string& path) {
  struct stat status;
  if (lstat(path.c_str(), &status) != 0)
    return;
  if (!S_ISSOCK(status.st_mode))
    throw Refusal("address '" + address + "' is a file that is there already and no socket: take another path");
  sockaddr_un name = {};
  name.sun_family = AF_UNIX;
  std::strncpy(name.sun_path, path.c_str(), sizeof name.sun_path - 1);
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const bool used = probe >= 0 && ::connect(probe, reinterpret_cast<sockaddr*>(&name), sizeof name) == 0;
  if (probe >= 0)
    ::close(probe);
  if (used)
    throw Refusal("address '" + address + "' is in use by another program: end it or take another path");
}

} // namespace

struct Channel::Message::Parts {
  zmq::message_t zmq;
};

Channel::Message::Message() : parts_(std::make_unique<Parts>()) {}
Channel::Message::Message(std::size_t bytes) : parts_(new Parts{zmq::message_t(bytes)}) {}
Channel::Message::Message(const wire::Bytes& bytes) : parts_(new Parts{zmq::message_t(bytes.data(), bytes.size())}) {}
Channel::Message::~Message() = default;
Channel::Message::Message(Message&&) noexcept = default;
Channel::Message& Channel::Message::operator=(Message&&) noexcept = default;

std::byte* Channel::Message::data() {
  return static_cast<std::byte*>(parts_->zmq.data());
}

wire::View Channel::Message::view() const {
  return {static_cast<const std::byte*>(parts_->zmq.data()), parts_->zmq.size()};
}

struct Channel::State {
  Side side;
  std::string address;
  std::string keys; ///< folder
  int connection;   ///< as in Address
  Timeout patience;
  zmq::context_t context;
  std::unique_ptr<KeyGuard> guard; ///< of the fluid side with keys
  zmq::socket_t socket;
  zmq::socket_t monitor;
  Clock::time_point opened = Clock::now();
  std::string bound_path;             ///< of the Unix socket that is ours to remove
  std::set<int> connections;          ///< file descriptors
  int peer = kNobody;                 ///< the one that the other side speaks through
  std::string peer_name;              ///< the ROUTER's name for it
  std::map<std::string, int> greeted; ///< of the fluid side: who has said hello and no more, and through which
  std::string note;                   ///< of the fluid side: what became of who came last
  bool came = false;                  ///< somebody who speaks ZeroMQ is or was there
  bool heard = false;                 ///< the other side has sent a message
  bool settled = false;               ///< whoever is heard first is the other side
  bool gone = false;
  bool turned_away = false; ///< the other side does not take this one's keys, or has none
  std::uint64_t bytes = 0;  ///< of messages, both ways

  State(Side s, const Address& a, const Timeout& p)
      : side(s), address(a.arguments), keys(a.keys), connection(a.connection), patience(p),
        socket(context, s == Side::dem ? zmq::socket_type::dealer : zmq::socket_type::router),
        monitor(context, zmq::socket_type::pair), settled(s == Side::dem) {}

  const char* other() const { return side == Side::dem ? "the fluid side" : "the DEM side"; }

  void open() {
    check(patience);
    keep_memory();
    Address asked(address, keys);
    asked.connection = connection;
    const std::string endpoint = endpoint_of(asked);
    settled = side == Side::dem || endpoint[0] == 'i' || !keys.empty();
    if (connection >= 0)
      address = endpoint;
    use_keys();
    socket.set(zmq::sockopt::linger, kLinger);
    socket.set(zmq::sockopt::maxmsgsize, static_cast<int64_t>(wire::max_bytes()));
    socket.set(zmq::sockopt::heartbeat_ivl, milliseconds(kAskAfter * patience.silence));
    socket.set(zmq::sockopt::heartbeat_timeout, milliseconds(kAnswerWithin * patience.silence));
    socket.set(zmq::sockopt::handshake_ivl, milliseconds(patience.silence));
    socket.set(zmq::sockopt::reconnect_ivl, kReconnect);
    socket.set(zmq::sockopt::ipv6, endpoint.find('[') != std::string::npos);
    if (zmq_socket_monitor(socket.handle(), kMonitor,
                           ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_CONNECTED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                               ZMQ_EVENT_HANDSHAKE_FAILED_AUTH | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                               ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_DISCONNECTED) != 0)
      throw Refusal(std::string("the link cannot watch its connection: ") + zmq_strerror(zmq_errno()));
    monitor.connect(kMonitor);
    if (side == Side::dem) {
      socket.connect(endpoint);
      // Goes out when there is a connection.
      const wire::Bytes hello = wire::encode_bare(wire::Kind::hello);
      (void)socket.send(zmq::buffer(hello.data(), hello.size()), zmq::send_flags::dontwait);
      return;
    }
    socket.set(zmq::sockopt::router_mandatory, true);
    const bool unix_socket = endpoint[0] == 'i';
    if (unix_socket)
      check_path(address, endpoint.substr(std::strlen("ipc://")));
    // Whoever may not write to a Unix socket cannot connect to it.
    const mode_t usual = umask(S_IRWXG | S_IRWXO);
    try {
      socket.bind(endpoint);
    } catch (const zmq::error_t& problem) {
      umask(usual);
      throw Refusal("address '" + address + "' cannot be used (" + problem.what() + "): take another one");
    }
    umask(usual);
    if (unix_socket)
      bound_path = endpoint.substr(std::strlen("ipc://"));
  }

  /// Before the socket binds or connects.
  void use_keys() {
    if (keys.empty())
      return;
    const bool fluid = side == Side::fluid;
    const Keys known = read_keys(keys, fluid ? "fluid" : "dem", fluid ? "dem" : "fluid");
    socket.set(zmq::sockopt::curve_publickey, known.own_public);
    socket.set(zmq::sockopt::curve_secretkey, known.own_secret);
    if (fluid) {
      socket.set(zmq::sockopt::curve_server, true);
      guard = std::make_unique<KeyGuard>(context, known.peer_public);
    } else {
      socket.set(zmq::sockopt::curve_serverkey, known.peer_public);
    }
  }

  /// Takes in what the monitor has to say.
  void read_monitor() {
    zmq::message_t event, endpoint;
    while (monitor.recv(event, zmq::recv_flags::dontwait)) {
      (void)monitor.recv(endpoint, zmq::recv_flags::none);
      std::uint16_t what = 0;
      std::int32_t value = 0;
      std::memcpy(&what, event.data(), sizeof what);
      std::memcpy(&value, static_cast<const char*>(event.data()) + sizeof what, sizeof value);
      if (what == ZMQ_EVENT_ACCEPTED || what == ZMQ_EVENT_CONNECTED)
        connections.insert(value);
      else if (what == ZMQ_EVENT_HANDSHAKE_SUCCEEDED)
        came = true;
      else if (what == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH || what == ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL ||
               what == ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL)
        // The fluid side goes on waiting: it was a stranger. The DEM side has found the address that it was told.
        turned_away = turned_away || side == Side::dem;
      else if (what == ZMQ_EVENT_DISCONNECTED && connections.erase(value) > 0)
        leave(value);
    }
  }

  void leave(int connection) {
    if (!settled) {
      if (heard && connection == peer)
        forget("who came has gone before both sides had agreed");
      for (auto at = greeted.begin(); at != greeted.end();)
        if (at->second == connection) {
          at = greeted.erase(at);
          begin_anew("who came has gone before it stated its terms");
        } else {
          ++at;
        }
      return;
    }
    gone = gone || (heard ? connection == peer : came && connections.empty());
  }

  /// A side that leaves at once has not seen yet that the other one is there, and its last word needs a connection.
  void await_handshake() {
    const Clock::time_point begun = Clock::now();
    for (;;) {
      read_monitor();
      const int allowed = connections.empty() ? kConnect : kLinger;
      if (came || gone || turned_away || Clock::now() - begun >= std::chrono::milliseconds(allowed))
        return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  /// The other side may come again.
  void begin_anew(const std::string& why) {
    note = why;
    opened = Clock::now();
  }

  /// The one that was heard is not the other side.
  void forget(const std::string& why) {
    heard = false;
    peer = kNobody;
    peer_name.clear();
    begin_anew(why);
  }

  /// Whether there is a reason to wait without an end.
  bool is_awaited() const { return settled ? came : heard || !greeted.empty(); }

  /// False if the other side is not there.
  bool send(const std::string& to, zmq::message_t& message) {
    try {
      if (side == Side::fluid && !socket.send(zmq::buffer(to), zmq::send_flags::dontwait | zmq::send_flags::sndmore))
        return false;
      return bool(socket.send(message, zmq::send_flags::dontwait));
    } catch (const zmq::error_t&) {
      return false;
    }
  }

  void turn_away(const std::string& stranger, const std::string& sentence) {
    const wire::Bytes bytes = wire::encode_refusal(sentence);
    zmq::message_t message(bytes.data(), bytes.size());
    (void)send(stranger, message);
  }

  /// Takes the next message of the other side, if there is one.
  bool take(zmq::message_t& message) {
    for (zmq::message_t name; socket.recv(side == Side::fluid ? name : message, zmq::recv_flags::dontwait);) {
      // The parts of a message come together.
      int parts = 1;
      if (side == Side::fluid)
        (void)socket.recv(message, zmq::recv_flags::none);
      for (zmq::message_t rest; parts == 1 ? message.more() : rest.more(); ++parts)
        (void)socket.recv(rest, zmq::recv_flags::none);
      const wire::View view{static_cast<const std::byte*>(message.data()), message.size()};
      const bool ours = parts == 1 && wire::is_ours(view);
      const std::string from = side == Side::fluid ? name.to_string() : "";
      if (heard && from == peer_name) {
        if (ours)
          return true;
        const std::string why = "a message is not Eccentra's: check who uses the address";
        if (settled)
          throw Refusal(why);
        turn_away(from, why);
        forget(why);
        continue;
      }
      const int through = zmq_msg_get(message.handle(), ZMQ_SRCFD);
      if (!heard && ours && (side == Side::dem || listens_to(from, view, through))) {
        heard = true;
        peer_name = from;
        peer = through;
        return true;
      }
      if (heard || !ours)
        turn_away(from, "another run uses this address, or the message is not Eccentra's: take another address");
    }
    return false;
  }

  /// The fluid side, as long as nobody is heard: whether this is the first message of one who may be the other side.
  /// Whoever is not is turned away, and the wait goes on.
  bool listens_to(const std::string& from, const wire::View& view, int through) {
    // A connection that has closed may have left its number to this one.
    read_monitor();
    try {
      const wire::Kind kind = wire::kind_of(view);
      if (kind == wire::Kind::hello) {
        greeted[from] = through;
        return false;
      }
      if (!settled && kind == wire::Kind::refusal)
        throw Refusal(wire::decode_refusal(view));
      if (!settled && kind == wire::Kind::farewell)
        throw Refusal("who came has said farewell before it stated its terms");
    } catch (const Refusal& why) {
      if (settled)
        throw;
      greeted.erase(from);
      begin_anew(why.what());
      turn_away(from, why.what());
      return false;
    }
    greeted.erase(from);
    return true;
  }

  [[noreturn]] void lost() const {
    const std::string remedy =
        heard ? " (ended, killed, stopped or cut off): see what it printed"
              : " before it said anything: see what it printed, and whether another run uses this address";
    throw Refusal(std::string(other()) + " at '" + address + "' has gone" + remedy);
  }

  [[noreturn]] void barred() const {
    throw Refusal("the fluid side at '" + address + "' does not let this side in: " +
                  (keys.empty()
                       ? std::string("it has keys and this side has none, or it is no Eccentra; name their folder "
                                     "after the word keys")
                       : "it has no keys or others than those in '" + keys +
                             "'; give both sides a copy of one folder "
                             "made by eccentra-keys"));
  }

  [[noreturn]] void missing() const {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%g", patience.arrival);
    if (connection >= 0)
      throw Refusal(std::string(other()) + " did not come to '" + address +
                    "', which is for one of its ranks, within " + seconds +
                    " s: see what it printed, or let all rows travel over rank 0 (fix fluid/couple ... lanes no)" +
                    (note.empty() ? "" : " (who came last: " + note + ")"));
    throw Refusal(std::string(other()) + " did not come to '" + address + "' within " + seconds + " s: start " +
                  (side == Side::dem ? "annulusFoam with link socket and this address"
                                     : "the DEM script with fix fluid/couple link socket and this address") +
                  ", or give a longer wait" + (note.empty() ? "" : " (who came last: " + note + ")"));
  }
};

Channel::Channel(Side side, const Address& address, const Timeout& patience)
    : state_(std::make_unique<State>(side, address, patience)) {
  state_->open();
}

Channel::~Channel() {
  close();
}

void Channel::send(Message message) {
  State& s = *state_;
  s.read_monitor();
  s.bytes += message.view().size;
  if (s.gone || !s.send(s.peer_name, message.parts_->zmq))
    s.lost();
}

Channel::Message Channel::receive(const std::function<void()>& look) {
  State& s = *state_;
  Message message;
  s.read_monitor();
  for (;;) {
    if (s.take(message.parts_->zmq)) {
      try {
        if (wire::kind_of(message.view()) == wire::Kind::refusal)
          throw Refusal(wire::decode_refusal(message.view()));
      } catch (const Refusal& why) {
        if (s.settled)
          throw;
        dismiss(why.what());
        continue;
      }
      s.bytes += message.view().size;
      return message;
    }
    if (s.turned_away && !s.came)
      s.barred();
    if (s.gone)
      s.lost();
    long wait = -1;
    if (!s.is_awaited()) {
      const std::chrono::duration<double> since = Clock::now() - s.opened;
      if (since.count() >= s.patience.arrival)
        s.missing();
      wait = milliseconds(s.patience.arrival - since.count());
    }
    if (look) {
      look();
      wait = wait < 0 ? kLook : std::min(wait, kLook);
    }
    zmq_pollitem_t items[] = {{s.socket.handle(), 0, ZMQ_POLLIN, 0}, {s.monitor.handle(), 0, ZMQ_POLLIN, 0}};
    if (zmq_poll(items, 2, wait) < 0 && zmq_errno() != EINTR)
      throw Refusal(std::string("the link cannot wait: ") + zmq_strerror(zmq_errno()));
    // Before the next look for messages: what was sent before leaving is still received.
    s.read_monitor();
  }
}

void Channel::settle() noexcept {
  state_->settled = true;
}

void Channel::dismiss(const std::string& why) {
  State& s = *state_;
  if (s.settled)
    throw Refusal(why);
  s.turn_away(s.peer_name, why);
  s.forget(why);
}

std::string Channel::last_words(double seconds) {
  State& s = *state_;
  const Clock::time_point begun = Clock::now();
  for (zmq::message_t message;;) {
    while (s.take(message)) {
      const wire::View view{static_cast<const std::byte*>(message.data()), message.size()};
      if (wire::kind_of(view) == wire::Kind::refusal)
        return wire::decode_refusal(view);
    }
    if (std::chrono::duration<double>(Clock::now() - begun).count() >= seconds)
      return "";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

std::uint32_t Channel::port() const {
  const std::string bound = state_->socket.get(zmq::sockopt::last_endpoint);
  return static_cast<std::uint32_t>(std::strtoul(bound.c_str() + bound.rfind(':') + 1, nullptr, 10));
}

std::uint64_t Channel::bytes() const {
  return state_->bytes;
}

void Channel::refuse(const std::string& sentence) noexcept {
  try {
    if (state_->socket && !state_->gone) {
      if (state_->side == Side::dem)
        state_->await_handshake();
      send(Message(wire::encode_refusal(sentence)));
    }
  } catch (...) {
    // The other side has gone already; this side's own sentence is what counts.
  }
  close();
}

void Channel::close() noexcept {
  if (!state_->socket)
    return;
  // Nothing is left to be delivered to who is not there: a peer that is stopped would only keep this side waiting.
  if ((state_->side == Side::dem && !state_->came) || state_->gone)
    state_->socket.set(zmq::sockopt::linger, 0);
  state_->monitor.close();
  state_->socket.close();
  state_->guard.reset();
  state_->context.close();
  if (!state_->bound_path.empty())
    ::unlink(state_->bound_path.c_str());
}

} // namespace eccentra::link
