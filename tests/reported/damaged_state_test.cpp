// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Restart files that are damaged, and bodies that something changed where no command shows it: found and named.
#include "reported/one_body_scene.h"
#include "reported/throwing_session.h"
#include "styles/bodies/restart_seal.h"
#include "support/read_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <regex>
#include <string>

using namespace eccentra;
using namespace eccentra::test;

namespace {

const std::string go_on =
    "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\nunits si\n"
    "read_restart now.restart\n" +
    material + contacts + moved + "run 10\n";

} // namespace

TEST(Reported, damaged_restart_file) {
  ASSERT_EQ(run_script(scene_with_one_body() + "write_restart now.restart\nwrite_restart part%.restart\n").status, 0);
  const std::string whole = contents("now.restart");
  ASSERT_EQ(run_script(go_on).status, 0);
  // Any byte, and any end.
  for (std::size_t n = 0; n < 20; ++n) {
    const std::size_t at = (whole.size() - 1) * n / 19;
    std::string damaged = whole;
    damaged[at] ^= 0x41;
    write_here("now.restart", damaged);
    std::string sentence;
    sentence = styles::seal_problem("now.restart");
    EXPECT_FALSE(sentence.empty()) << "byte " << at << " of " << whole.size();
  }
  for (const std::size_t end : {whole.size() - 1, whole.size() - 32, whole.size() - 100}) {
    write_here("now.restart", whole.substr(0, end));
    EXPECT_EQ(styles::seal_problem("now.restart"), "is cut short");
  }
  expect_refused(run_script(go_on), {"read_restart", "'now.restart'", "cut short", "earlier"});
  std::string part = contents("part0.restart");
  part[part.size() / 2] ^= 1;
  write_here("part0.restart", part);
  const std::string go_on_parts = std::regex_replace(go_on, std::regex("now"), "part%");
  expect_refused(run_script(go_on_parts), {"read_restart", "'part0.restart'", "damaged"});

  // What a seal cannot show, as it was made for it: each four bytes of the shapes' record, with values that are no
  // counts.
  const std::size_t name = whole.find("cube 8");
  ASSERT_NE(name, std::string::npos);
  int refused = 0;
  for (const std::size_t at : {name - 4, name - 8, name - 12, name + 6}) {
    for (const unsigned value : {0x7fffffffu, 0xffffffffu, 0x00010000u}) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + at, &value, sizeof value);
      write_here("now.restart", damaged);
      ASSERT_TRUE(styles::seal_restart_file("now.restart"));
      const ProgramResult result = run_script(go_on);
      EXPECT_EQ(result.signal, 0);
      expect_refused(result, {"clusters", "damaged", "earlier"});
      ++refused;
    }
  }
  EXPECT_EQ(refused, 12);
}

TEST(Reported, restart_without_clusters) {
  ASSERT_EQ(run_script(scene_with_one_body() + "write_restart now.restart\n").status, 0);
  const std::string stock = std::regex_replace(go_on, std::regex("gran/cluster"), "gran");
  expect_refused(run_script(std::regex_replace(stock, std::regex("nve/cluster"), "nve/sphere")),
                 {"read_restart", "clusters", "pair_style gran/cluster"});
}

TEST(Reported, changed_behind_our_back) {
  // Whatever changes radius, mass or ids where no command can be caught.
  Session session(scene_with_one_body());
  session.atom().radius[0] *= 0.9;
  std::string sentence = session.refusal("run 1");
  EXPECT_EQ(sentence.find("atom 1 (cluster 'cube 8'): radius"), 0u) << sentence;
  Session heavy(scene_with_one_body());
  heavy.atom().rmass[0] *= 1.1;
  sentence = heavy.refusal("run 1");
  EXPECT_EQ(sentence.find("atom 1 (cluster 'cube 8'): mass"), 0u) << sentence;
  Session exchanged(bed() + settle);
  exchanged.run("run 0");
  int* tag = exchanged.atom().tag;
  for (int i = 0; i < exchanged.atom().nlocal; ++i)
    tag[i] = tag[i] == 1 ? 1 : 2 + (tag[i] + 3) % 12; // the plain sphere keeps its id
  sentence = exchanged.refusal("run 1");
  EXPECT_NE(sentence.find("is not kept by that atom"), std::string::npos) << sentence;
}
