// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Addresses of this machine are taken, all others refused.
#include "link/socket/address.h"

#include "link/terms.h"

#include <gtest/gtest.h>

#include <limits>

using namespace eccentra::link;

TEST(Address, OfThisMachine) {
  EXPECT_EQ(endpoint_of("ipc:///run/link"), "ipc:///run/link");
  EXPECT_EQ(endpoint_of("link.socket"), "ipc://link.socket");
  EXPECT_EQ(endpoint_of("tcp://127.0.0.1:5555"), "tcp://127.0.0.1:5555");
  EXPECT_EQ(endpoint_of("tcp://127.9.8.7:1"), "tcp://127.9.8.7:1");
  EXPECT_EQ(endpoint_of("tcp://localhost:65535"), "tcp://127.0.0.1:65535");
  EXPECT_EQ(endpoint_of("tcp://[::1]:5555"), "tcp://[::1]:5555");
}

TEST(Address, ThatOtherMachinesReachIsRefused) {
  for (const char* arguments :
       {"tcp://0.0.0.0:5555", "tcp://*:5555", "tcp://192.168.0.1:5555", "tcp://127.0.0.1.example:5555",
        "tcp://[::]:5555", "tcp://128.0.0.1:5555", "tcp://127.0.0.256:5555", "tcp://eth0:5555"})
    EXPECT_THROW(endpoint_of(arguments), Refusal) << arguments;
}

TEST(Address, ThatOtherMachinesReachIsTakenWithKeys) {
  EXPECT_EQ(endpoint_of({"tcp://0.0.0.0:5555", "keys"}), "tcp://0.0.0.0:5555");
  EXPECT_EQ(endpoint_of({"tcp://*:5555", "keys"}), "tcp://*:5555");
  EXPECT_EQ(endpoint_of({"tcp://node-7.cluster:5555", "keys"}), "tcp://node-7.cluster:5555");
  EXPECT_THROW(endpoint_of({"tcp://a;b:5555", "keys"}), Refusal);
}

TEST(Address, ThatIsNoneIsRefused) {
  const std::string endless = "ipc:///" + std::string(200, 'x');
  for (const char* arguments :
       {"", "ipc://", "ipc://@hidden", "tcp://127.0.0.1", "tcp://127.0.0.1:", "tcp://127.0.0.1:0",
        "tcp://127.0.0.1:65536", "tcp://127.0.0.1:80x", "tcp://:5555", "pgm://x:1", endless.c_str()})
    EXPECT_THROW(endpoint_of(arguments), Refusal) << arguments;
}

TEST(Address, TimeoutIsPositive) {
  EXPECT_NO_THROW(check({5, 5}));
  EXPECT_THROW(check({0, 5}), Refusal);
  EXPECT_THROW(check({5, -1}), Refusal);
  EXPECT_THROW(check({std::numeric_limits<double>::quiet_NaN(), 5}), Refusal);
}
