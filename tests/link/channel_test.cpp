// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages cross; strangers at the address neither join nor disturb; an address is not taken from its owner.
#include "link/channel.h"

#include <gtest/gtest.h>
#include <zmq.hpp>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

namespace {

using namespace eccentra::link;
using Side = Channel::Side;

std::string path(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("eccentra-channel-" + std::to_string(getpid()) + "-" + name))
      .string();
}

void send_kind(Channel& channel, wire::Kind kind) {
  channel.send(Channel::Message(wire::encode_bare(kind)));
}

template <class Work> void expect_refusal(Work&& work, const std::string& part) {
  try {
    work();
    ADD_FAILURE() << "accepted; expected: " << part;
  } catch (const Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(part), std::string::npos) << "said: " << refusal.what();
  }
}

/// Connects to a Unix socket without ZeroMQ.
int plain_connection(const std::string& to) {
  sockaddr_un name = {};
  name.sun_family = AF_UNIX;
  std::strncpy(name.sun_path, to.c_str(), sizeof name.sun_path - 1);
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&name), sizeof name), 0);
  return fd;
}

} // namespace

TEST(Channel, MessagesCrossWhoeverComesFirst) {
  for (const bool fluid_first : {true, false}) {
    const std::string place = path(fluid_first ? "fluid_first" : "dem_first");
    std::thread other([&] {
      Channel fluid(Side::fluid, place, {});
      EXPECT_EQ(wire::kind_of(fluid.receive().view()), wire::Kind::run_ended);
      fluid.refuse("enough");
    });
    if (fluid_first)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    Channel dem(Side::dem, place, {});
    send_kind(dem, wire::Kind::run_ended);
    expect_refusal([&] { dem.receive(); }, "enough");
    other.join();
  }
}

TEST(Channel, SocketIsOpenToItsOwnerOnlyAndGoesWithIt) {
  const std::string place = path("mode");
  struct stat status;
  {
    const Channel fluid(Side::fluid, place, {});
    ASSERT_EQ(stat(place.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & (S_IRWXG | S_IRWXO), 0u);
  }
  EXPECT_NE(stat(place.c_str(), &status), 0);
}

TEST(Channel, SidesThatLeaveAreNoticedAtOnce) {
  const std::string place = path("leave");
  Channel fluid(Side::fluid, place, {});
  {
    Channel dem(Side::dem, place, {});
    send_kind(dem, wire::Kind::run_ended);
    fluid.receive();
  }
  const auto begun = std::chrono::steady_clock::now();
  expect_refusal([&] { fluid.receive(); }, "has gone");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(1));
}

TEST(Channel, MissingSideIsNoticedWhenTheWaitIsOver) {
  Channel dem(Side::dem, path("missing"), {5.0, 0.2});
  send_kind(dem, wire::Kind::run_ended);
  const auto begun = std::chrono::steady_clock::now();
  expect_refusal([&] { dem.receive(); }, "within 0.2 s");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(1));
}

TEST(Channel, NoiseAtTheAddressDoesNotKeepTheSidesApart) {
  const std::string place = path("noise");
  Channel fluid(Side::fluid, place, {});
  const int stranger = plain_connection(place);
  ASSERT_EQ(write(stranger, "GET / HTTP/1.1\r\n\r\n", 18), 18);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  Channel dem(Side::dem, place, {});
  send_kind(dem, wire::Kind::run_ended);
  EXPECT_EQ(wire::kind_of(fluid.receive().view()), wire::Kind::run_ended);
  close(stranger);
}

TEST(Channel, SecondComerIsTurnedAwayAndDoesNotDisturb) {
  const std::string place = path("second");
  Channel fluid(Side::fluid, place, {}), dem(Side::dem, place, {});
  send_kind(dem, wire::Kind::run_ended);
  fluid.receive();
  wire::Kind heard = wire::Kind::refusal;
  std::thread listening([&] { heard = wire::kind_of(fluid.receive().view()); });
  {
    Channel stranger(Side::dem, place, {});
    send_kind(stranger, wire::Kind::farewell);
    expect_refusal([&] { stranger.receive(); }, "another run uses this address");
  }
  send_kind(dem, wire::Kind::run_ended);
  listening.join();
  EXPECT_EQ(heard, wire::Kind::run_ended);
}

TEST(Channel, StrangersAreTurnedAwayAndDoNotKeepTheSidesApart) {
  for (const bool parts : {false, true}) {
    const std::string place = path(parts ? "parts" : "words");
    Channel fluid(Side::fluid, place, {});
    wire::Kind heard = wire::Kind::refusal;
    std::thread listening([&] { heard = wire::kind_of(fluid.receive().view()); });
    zmq::context_t context;
    zmq::socket_t stranger(context, zmq::socket_type::dealer);
    stranger.set(zmq::sockopt::linger, 0);
    stranger.set(zmq::sockopt::rcvtimeo, 10000);
    stranger.connect("ipc://" + place);
    stranger.send(zmq::str_buffer("let me in"), parts ? zmq::send_flags::sndmore : zmq::send_flags::none);
    if (parts)
      stranger.send(zmq::str_buffer("please"), zmq::send_flags::none);
    zmq::message_t answer;
    EXPECT_TRUE(stranger.recv(answer, zmq::recv_flags::none));
    EXPECT_TRUE(wire::is_ours({static_cast<const std::byte*>(answer.data()), answer.size()}));
    Channel dem(Side::dem, place, {});
    send_kind(dem, wire::Kind::run_ended);
    listening.join();
    EXPECT_EQ(heard, wire::Kind::run_ended);
  }
}

TEST(Channel, PathOfAnotherProgramOrFileIsNotTaken) {
  const std::string used = path("used");
  const Channel first(Side::fluid, used, {});
  expect_refusal([&] { Channel(Side::fluid, used, {}); }, "in use by another program");
  const std::string file = path("file");
  std::ofstream(file) << "kept";
  expect_refusal([&] { Channel(Side::fluid, file, {}); }, "a file that is there already");
  std::string text;
  std::ifstream(file) >> text;
  EXPECT_EQ(text, "kept");
  std::filesystem::remove(file);
}
