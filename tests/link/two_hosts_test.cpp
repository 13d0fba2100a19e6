// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// The two jobs on two hosts, over TCP with keys: two network namespaces and a cable between them, which is then cut.
#include "coupled/checkpoint_scene.h"
#include "link/socket/keys.h"
#include "link/two_jobs.h"

#include <gtest/gtest.h>

#include <iostream>

namespace {

using namespace eccentra::test;
namespace fs = std::filesystem;

int shell(const std::string& arguments) {
  return std::system((arguments + " >/dev/null 2>&1").c_str());
}

/// Two namespaces, 10.213.7.1 and 10.213.7.2, joined by a pair of virtual devices.
class TwoHosts {
 public:
  TwoHosts() : id_(std::to_string(getpid())) {
    there_ = shell("ip netns add " + host(0)) == 0 && shell("ip netns add " + host(1)) == 0 &&
             shell("ip link add " + device(0) + " netns " + host(0) + " type veth peer name " + device(1) + " netns " +
                   host(1)) == 0;
    for (const int k : {0, 1}) {
      const std::string in = "ip -n " + host(k);
      there_ = there_ && shell(in + " addr add 10.213.7." + std::to_string(k + 1) + "/24 dev " + device(k)) == 0 &&
               shell(in + " link set lo up") == 0 && shell(in + " link set " + device(k) + " up") == 0;
    }
  }
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;
  ~TwoHosts() {
    for (const int k : {0, 1})
      shell("ip netns del " + host(k));
  }
  bool there() const { return there_; }
  void cut() const { EXPECT_EQ(shell("ip -n " + host(1) + " link set " + device(1) + " down"), 0); }
  /// The arguments that run a program on host k; on this one if there are no namespaces.
  std::vector<std::string> on(int k, std::vector<std::string> arguments) const {
    if (there_) {
      const std::vector<std::string> enter = {"ip", "netns", "exec", host(k)};
      arguments.insert(arguments.begin(), enter.begin(), enter.end());
    }
    return arguments;
  }

 private:
  std::string host(int k) const { return "ecc" + id_ + (k ? "b" : "a"); }
  std::string device(int k) const { return "ecc" + id_ + (k ? "d" : "c"); }
  std::string id_;
  bool there_ = false;
};

} // namespace

TEST(TwoHosts, MeetOverTcpWithKeysAndNoticeACutCable) {
  const TwoHosts hosts;
  if (!hosts.there())
    std::cout << "NOT TESTED: two network namespaces (this kernel or user may not make them); loopback instead\n";
  RecordProperty("hosts", hosts.there() ? "two network namespaces" : "loopback only");
  const std::string address = std::string("tcp://") + (hosts.there() ? "10.213.7.1" : "127.0.0.1") + ":23517";
  BoxCase box = stirred_box("socket " + address + " every 40 checkpoint 8 wait 60 keys keys", 4000000, false);
  box.coupling += "link socket; address \"" + address + "\"; keys \"keys\"; wait 60; wait 0.01;";
  // The mesh; the run itself ends at once, as its keys are not there yet.
  const std::string folder = run(box, "two_hosts").folder;
  replace_in(folder + "/constant/couplingProperties", "wait 0.01;", "");
  eccentra::link::make_keys(folder + "/keys");
  BackgroundJob fluid(folder, hosts.on(0, command("annulusFoam", {}, 1)), "log.fluid");
  // Of two ranks: the second one has a rank connection of its own, with a port that nobody has named.
  BackgroundJob particles(folder, hosts.on(1, command("eccentra-dem", {"-in", "in.dem", "-log", "none"}, 2)),
                          "log.dem");
  EXPECT_TRUE(fluid.says("t 0.1 s", kStart)) << fluid.text() << particles.text();
  EXPECT_EQ(particles.text().find("travel over rank 0"), std::string::npos) << particles.text();
  if (!hosts.there())
    return;
  hosts.cut();
  for (const BackgroundJob* job : {&fluid, &particles})
    EXPECT_TRUE(job->says("has gone", kNotice)) << job->text();
  EXPECT_GT(fluid.wait(kNotice), 0);
  EXPECT_GT(particles.wait(kNotice), 0);
}
