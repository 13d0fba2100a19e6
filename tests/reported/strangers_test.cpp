// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever comes to the address of the fluid side and is not the DEM side.
#include "link/socket/wire.h"
#include "reported/short_section.h"

#include <zmq.hpp>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <functional>
#include <thread>

using namespace eccentra::test;

namespace {

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
  for (int i = 0; i < 600; ++i) {
    if (::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0)
      return fd;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ADD_FAILURE() << "nobody listens at port " << port;
  return fd;
}

void raw(int port, const std::string& bytes) {
  const int fd = connect_to(port);
  if (!bytes.empty())
    (void)!write(fd, bytes.data(), bytes.size());
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  close(fd);
}

/// Completes ZeroMQ's handshake, says these messages and leaves.
void dealer(int port, const std::vector<eccentra::link::wire::Bytes>& messages) {
  zmq::context_t context;
  zmq::socket_t socket(context, zmq::socket_type::dealer);
  socket.set(zmq::sockopt::linger, 200);
  socket.set(zmq::sockopt::rcvtimeo, 200);
  socket.connect("tcp://127.0.0.1:" + std::to_string(port));
  for (const auto& message : messages)
    socket.send(zmq::buffer(message.data(), message.size()), zmq::send_flags::none);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  zmq::message_t answer;
  (void)socket.recv(answer, zmq::recv_flags::none);
}

eccentra::link::wire::Bytes bytes_of(const std::string& text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

} // namespace

namespace {

void turn_strangers_away(int ranks) {
  using namespace eccentra::link;
  const wire::Bytes hello = wire::encode_bare(wire::Kind::hello);
  wire::Bytes other_release = wire::encode(DemTerms());
  other_release[12] = std::byte(99);
  wire::Bytes cut = wire::encode(DemTerms());
  cut.resize(cut.size() - 8);
  DemTerms hostile;
  hostile.particles = -1;
  const std::string greeting =
      std::string("\xff") + std::string(8, '\0') + "\x7f\x03" + std::string(1, '\0') + "NULL" + std::string(48, '\0');
  const std::vector<std::pair<std::string, std::function<void(int)>>> strangers = {
      {"connects and leaves", [](int port) { raw(port, ""); }},
      {"speaks HTTP", [](int port) { raw(port, "GET / HTTP/1.1\r\n\r\n"); }},
      {"greets as ZeroMQ does and leaves", [&](int port) { raw(port, greeting); }},
      {"half a greeting", [&](int port) { raw(port, greeting.substr(0, 5)); }},
      {"handshake and no word", [](int port) { dealer(port, {}); }},
      {"handshake and noise", [](int port) { dealer(port, {bytes_of("let me in")}); }},
      {"hello and no more", [&](int port) { dealer(port, {hello}); }},
      {"hello twice and noise",
       [&](int port) {
         dealer(port, {hello, hello, bytes_of("let me in")});
       }},
      {"refuses before it was asked", [&](int port) { dealer(port, {wire::encode_refusal("go home")}); }},
      {"hello, then refuses",
       [&](int port) {
         dealer(port, {hello, wire::encode_refusal("go home")});
       }},
      {"says farewell", [](int port) { dealer(port, {wire::encode_bare(wire::Kind::farewell)}); }},
      {"speaks out of turn",
       [&](int port) {
         dealer(port, {hello, wire::encode_bare(wire::Kind::advance)});
       }},
      {"is of another release", [&](int port) { dealer(port, {other_release}); }},
      {"terms that are cut short",
       [&](int port) {
         dealer(port, {hello, cut});
       }},
      {"terms that cannot be", [&](int port) { dealer(port, {wire::encode(hostile)}); }},
      {"an empty message", [](int port) { dealer(port, {wire::Bytes()}); }},
  };
  const int port = 20000 + getpid() % 20000;
  const std::string address = "tcp://127.0.0.1:" + std::to_string(port);
  {
    Section section("stranger" + std::to_string(ranks));
    section.use_socket(address);
    section.mesh(ranks);
    auto fluid = std::async(std::launch::async, [&] { return section.solve(ranks); });
    for (const auto& [what, act] : strangers) {
      act(port);
      ASSERT_EQ(fluid.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout) << what << "\n"
                                                                                            << fluid.get().output;
    }
    // One that stays for as long as the run lasts.
    zmq::context_t context;
    zmq::socket_t stays(context, zmq::socket_type::dealer);
    stays.set(zmq::sockopt::linger, 0);
    stays.connect(address);
    stays.send(zmq::buffer(hello.data(), hello.size()), zmq::send_flags::none);
    const ProgramResult dem = section.particles(ranks);
    const ProgramResult served = fluid.get();
    EXPECT_EQ(dem.status, 0) << dem.output;
    EXPECT_EQ(served.status, 0) << served.output;
  }
}

} // namespace

TEST(Reported, stranger_on_tcp_on_two_ranks) {
  turn_strangers_away(2);
}

TEST(Reported, stranger_on_tcp) {
  using namespace eccentra::link;
  turn_strangers_away(1);
  const wire::Bytes hello = wire::encode_bare(wire::Kind::hello);
  const int port = 20000 + getpid() % 20000 + 1;
  const std::string address = "tcp://127.0.0.1:" + std::to_string(port);
  // Where nobody comes but strangers, the wait has an end.
  Section alone("alone");
  alone.use_socket(address);
  replace_in(alone.folder() / "constant/couplingProperties", "wait            60", "wait            2");
  alone.mesh();
  auto fluid = std::async(std::launch::async, [&] { return alone.solve(); });
  const int silent = connect_to(port);
  dealer(port, {hello, wire::encode_refusal("go home")});
  expect_refused(fluid.get(), {"did not come", "go home"}, "strangers alone");
  close(silent);
}
