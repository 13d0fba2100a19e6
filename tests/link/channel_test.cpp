// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Messages cross; strangers at the address neither join nor disturb; an address is not taken from its owner.
#include "link/socket/channel.h"
#include "link/socket/keys.h"

#include <gtest/gtest.h>
#include <zmq.hpp>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
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
  for (const Side side : {Side::dem, Side::fluid}) {
    const std::string place = path("leave");
    auto fluid = std::make_unique<Channel>(Side::fluid, place, Timeout());
    auto dem = std::make_unique<Channel>(Side::dem, place, Timeout());
    // Both have heard the other.
    send_kind(*dem, wire::Kind::run_ended);
    fluid->receive();
    fluid->settle();
    send_kind(*fluid, wire::Kind::run_ended);
    dem->receive();
    (side == Side::dem ? dem : fluid).reset();
    Channel& left = *(side == Side::dem ? fluid : dem);
    const auto begun = std::chrono::steady_clock::now();
    const auto give_up = [&begun] {
      if (std::chrono::steady_clock::now() - begun > std::chrono::seconds(5))
        throw Refusal("not noticed");
    };
    expect_refusal([&] { left.receive(give_up); }, "has gone");
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(1));
  }
}

TEST(Channel, LastWordOfASideThatHasJustComeArrives) {
  for (int turn = 0; turn < 20; ++turn) {
    const std::string place = path("just_come");
    Channel fluid(Side::fluid, place, {5.0, 5.0});
    Channel(Side::dem, place, {}).refuse("the script is wrong");
    expect_refusal([&] { fluid.receive(); }, "the script is wrong");
  }
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

namespace {

/// Sits between two Unix sockets, passes everything on and keeps it. For one connection.
class Eavesdropper {
 public:
  Eavesdropper(const std::string& from, const std::string& to) : from_(from), to_(to) {
    sockaddr_un name = {};
    name.sun_family = AF_UNIX;
    std::strncpy(name.sun_path, from.c_str(), sizeof name.sun_path - 1);
    listener_ = ::socket(AF_UNIX, SOCK_STREAM, 0);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&name), sizeof name), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    thread_ = std::thread([this] { pass_on(); });
  }
  ~Eavesdropper() { unlink(from_.c_str()); }
  /// All that was said, when the connection has ended.
  std::string heard() {
    if (thread_.joinable())
      thread_.join();
    return heard_;
  }

 private:
  void pass_on() {
    const int ends[2] = {accept(listener_, nullptr, nullptr), plain_connection(to_)};
    for (bool open = true; open;) {
      pollfd items[2] = {{ends[0], POLLIN, 0}, {ends[1], POLLIN, 0}};
      poll(items, 2, -1);
      for (int k = 0; k < 2; ++k) {
        char bytes[4096];
        if (!items[k].revents)
          continue;
        const ssize_t count = read(ends[k], bytes, sizeof bytes);
        open = open && count > 0 && write(ends[1 - k], bytes, count) == count;
        heard_.append(bytes, count > 0 ? count : 0);
      }
    }
    for (const int end : {ends[0], ends[1], listener_})
      close(end);
  }
  std::string from_, to_, heard_;
  int listener_ = -1;
  std::thread thread_;
};

/// What somebody between the two sides can read of one message.
std::string read_along(const std::string& name, const std::string& keys) {
  const std::string real = path(name), tapped = path(name + "-tap");
  Channel fluid(Side::fluid, {real, keys}, {});
  Eavesdropper ear(tapped, real);
  {
    Channel dem(Side::dem, {tapped, keys}, {});
    send_kind(dem, wire::Kind::run_ended);
    fluid.receive();
    fluid.settle();
    dem.send(Channel::Message(wire::encode_refusal("the secret recipe")));
    expect_refusal([&] { fluid.receive(); }, "the secret recipe");
  }
  fluid.close();
  return ear.heard();
}

std::string keys(const std::string& name) {
  const std::string folder = path(name);
  std::filesystem::remove_all(folder);
  make_keys(folder);
  return folder;
}

} // namespace

TEST(Keys, WhoListensReadsNothing) {
  EXPECT_NE(read_along("plain", "").find("the secret recipe"), std::string::npos) << "the ear itself is deaf";
  const std::string heard = read_along("curve", keys("keys-ear"));
  EXPECT_GT(heard.size(), 200u);
  EXPECT_EQ(heard.find("the secret recipe"), std::string::npos);
  EXPECT_EQ(heard.find("ECCENTRA"), std::string::npos);
}

TEST(Keys, StrangersDoNotJoin) {
  const std::string place = path("strangers"), ours = keys("keys-ours"), others = keys("keys-others");
  // One who knows the fluid's open half, but has a key of his own.
  const std::string mixed = keys("keys-mixed");
  std::filesystem::copy_file(ours + "/fluid.public", mixed + "/fluid.public",
                             std::filesystem::copy_options::overwrite_existing);
  Channel fluid(Side::fluid, {place, ours}, {});
  std::thread listening([&] { EXPECT_EQ(wire::kind_of(fluid.receive().view()), wire::Kind::run_ended); });
  for (const std::string& stranger : {std::string(), others, mixed}) {
    Channel dem(Side::dem, {place, stranger}, {5.0, 1.0});
    send_kind(dem, wire::Kind::farewell);
    expect_refusal([&] { dem.receive(); }, stranger == others ? "the fluid side" : "does not let this side in");
  }
  Channel dem(Side::dem, {place, ours}, {});
  send_kind(dem, wire::Kind::run_ended);
  listening.join();
}

TEST(Keys, AreRefusedWhereTheyAreNoneOrOpenToOthers) {
  const std::string folder = keys("keys-bad");
  expect_refusal([&] { make_keys(folder); }, "cannot make the key file");
  chmod((folder + "/dem.secret").c_str(), 0644);
  expect_refusal([&] { read_keys(folder, "dem", "fluid"); }, "others may read");
  chmod((folder + "/dem.secret").c_str(), 0600);
  EXPECT_EQ(read_keys(folder, "dem", "fluid").own_secret.size(), 40u);
  std::ofstream(folder + "/fluid.public") << "no key";
  expect_refusal([&] { read_keys(folder, "dem", "fluid"); }, "holds no key");
  expect_refusal([&] { Channel(Side::dem, {"tcp://10.0.0.1:5555", path("no-keys-here")}, {}); }, "cannot be read");
}
