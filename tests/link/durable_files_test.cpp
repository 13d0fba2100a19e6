// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folders are there in full or not at all; damage of any kind is seen; a disk that is full is told, and harms nothing.
#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/durable_files.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace eccentra::link;
namespace fs = std::filesystem;

const std::string kContents(5000, 'x');

void write_folder(const std::string& folder, const CheckpointMark& mark, const Notes& notes = {}) {
  DurableFolder files(folder);
  files.add("a file", kContents.data(), kContents.size());
  files.add("empty", nullptr, 0);
  files.commit(mark, notes);
}

void expect_damaged(const std::string& folder, const std::string& part) {
  std::string why;
  EXPECT_FALSE(check_folder(folder, &why));
  EXPECT_NE(why.find(part), std::string::npos) << why;
}

class DurableFiles : public testing::Test {
 protected:
  DurableFiles() : start_(fs::current_path()) {
    fs::remove_all("durable");
    fs::create_directories("durable");
    fs::current_path("durable");
  }
  ~DurableFiles() override { fs::current_path(start_); }

 private:
  fs::path start_;
};

/// No file of this process grows beyond this while it lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

} // namespace

TEST_F(DurableFiles, WhatIsWrittenIsFoundWhole) {
  write_folder("640", {640, 77}, {{"fluid", "/some where/else"}});
  const auto manifest = check_folder("640");
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->mark.step, 640);
  EXPECT_EQ(manifest->mark.id, 77u);
  EXPECT_EQ(manifest->note("fluid"), "/some where/else");
  EXPECT_FALSE(fs::exists("640.tmp"));
}

TEST_F(DurableFiles, DamageIsSeen) {
  write_folder("a", {1, 1});
  fs::resize_file("a/a file", 4999);
  expect_damaged("a", "has 4999 bytes instead of 5000");
  write_folder("b", {1, 1});
  std::fstream("b/a file", std::ios::in | std::ios::out).seekp(2500).put('y');
  expect_damaged("b", "checksum");
  write_folder("c", {1, 1});
  fs::remove("c/empty");
  expect_damaged("c", "is not there");
  write_folder("d", {1, 1});
  std::fstream("d/manifest", std::ios::in | std::ios::out).seekp(30).put('9');
  expect_damaged("d", "damaged or was written in part");
  expect_damaged("never", "is not there");
}

TEST_F(DurableFiles, AnotherVersionIsNamed) {
  fs::create_directories("old");
  std::ofstream("old/manifest") << "eccentra checkpoint 1\nstep 6400\nid 1f\nseal 346a1784\n";
  expect_damaged("old", "'old/manifest' was written by another version of this software ('eccentra checkpoint 1', not");
}

TEST_F(DurableFiles, WhatIsNotCommittedIsNotThere) {
  {
    DurableFolder files("640");
    files.add("a file", kContents.data(), kContents.size());
  }
  EXPECT_FALSE(fs::exists("640"));
  EXPECT_FALSE(fs::exists("640.tmp"));
}

TEST_F(DurableFiles, FullDiskIsToldAndTheOldOneStays) {
  write_folder("640", {640, 1});
  {
    const FullDisk disk(3000);
    try {
      write_folder("640", {640, 2});
      ADD_FAILURE() << "written onto a full disk";
    } catch (const Refusal& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("cannot write"), std::string::npos) << refusal.what();
    }
  }
  const auto manifest = check_folder("640");
  ASSERT_TRUE(manifest);
  EXPECT_EQ(manifest->mark.id, 1u);
}

TEST_F(DurableFiles, NewestWholeOneIsChosen) {
  for (const int step : {80, 9, 640})
    write_folder(std::string(kCheckpoints) + '/' + std::to_string(step), {step, 5});
  fs::create_directories(std::string(kCheckpoints) + "/900");      // a crash before the manifest
  fs::create_directories(std::string(kCheckpoints) + "/1000.tmp"); // and one before the rename
  const auto any = [](const Manifest&, std::string&) { return true; };
  const CheckpointChoice choice = newest_checkpoint(any);
  EXPECT_EQ(choice.mark.step, 640);
  EXPECT_EQ(choice.restart_file, "checkpoints/640/dem.restart");
  EXPECT_EQ(choice.passed_over.size(), 1u);
  const auto older = [](const Manifest& dem, std::string& why) {
    why = "the fluid's part is gone";
    return dem.mark.step < 100;
  };
  EXPECT_EQ(newest_checkpoint(older).mark.step, 80);
  const auto none = [](const Manifest&, std::string&) { return false; };
  EXPECT_EQ(newest_checkpoint(none).mark.step, -1);
  EXPECT_EQ(newest_checkpoint(none).restart_file, "none");
}

TEST_F(DurableFiles, RecordOfTheOtherSideIsFollowed) {
  write_folder("checkpoints/fluid-640/rank0", {640, 5});
  const auto part = check_folder("checkpoints/fluid-640/rank0");
  ASSERT_TRUE(part);
  const std::string record = fs::absolute("checkpoints/fluid-640.complete");
  write_record(record, {640, 5}, {{"ranks", "1"}, {"rank", std::to_string(part->checksum)}});
  Manifest dem;
  dem.mark = {640, 5};
  dem.notes = {{"fluid", record}};
  std::string why;
  EXPECT_TRUE(fluid_record_is_whole(dem, why)) << why;
  dem.mark.id = 6;
  EXPECT_FALSE(fluid_record_is_whole(dem, why));
  dem.mark.id = 5;
  fs::resize_file("checkpoints/fluid-640/rank0/a file", 1);
  EXPECT_FALSE(fluid_record_is_whole(dem, why));
  EXPECT_NE(why.find("has 1 bytes"), std::string::npos) << why;
  dem.notes = {{"fluid", "/no/such/folder/on/this/machine/fluid-640.complete"}};
  EXPECT_TRUE(fluid_record_is_whole(dem, why));
}
