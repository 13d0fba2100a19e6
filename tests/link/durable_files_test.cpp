// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Folders are there in full or not at all; damage of any kind is seen; a disk that is full is told, and harms nothing.
#include "link/checkpoint/checkpoint_choice.h"
#include "link/checkpoint/checkpoint_room.h"
#include "link/checkpoint/durable_files.h"
#include "link/checkpoint/durable_table.h"

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

namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_F(DurableFiles, TableLosesNoRowToADiskThatIsFullForAWhile) {
  const std::string row(100, '7');
  DurableTable table("table.csv", "time,value", false, 0);
  table.add("0," + row);
  {
    const FullDisk disk(180);
    table.add("1," + row); // fits in part
    table.add("2," + row);
    EXPECT_EQ(table.pending().size(), 2u);
    EXPECT_EQ(table.take_messages().size(), 1u);
    EXPECT_EQ(text_of("table.csv"), "time,value\n0," + row + '\n');
  }
  table.add("3," + row);
  EXPECT_TRUE(table.pending().empty());
  EXPECT_EQ(table.rows(), 4);
  EXPECT_EQ(text_of("table.csv"), "time,value\n0," + row + "\n1," + row + "\n2," + row + "\n3," + row + '\n');
}

TEST_F(DurableFiles, TableGoesOnWithTheRowsOfItsRun) {
  const std::string rows = "time,value\n0,a\n0.1,b\n0.2,c\n";
  std::ofstream("table.csv") << rows << "0.3,d\n0.4,half a r";
  {
    DurableTable table("table.csv", "time,value", true, 0.2);
    EXPECT_EQ(table.rows(), 3);
    EXPECT_TRUE(table.take_messages().empty());
    table.add("0.3,D");
  }
  EXPECT_EQ(text_of("table.csv"), rows + "0.3,D\n");
  // Of a run that it does not continue, or with other columns: kept beside, never over what is there.
  DurableTable("table.csv", "time,value", false, 0).add("0,x");
  DurableTable("table.csv", "time,other", true, 1).add("0,y");
  EXPECT_EQ(text_of("table.csv.before-1"), rows + "0.3,D\n");
  EXPECT_EQ(text_of("table.csv.before-2"), "time,value\n0,x\n");
  EXPECT_EQ(text_of("table.csv"), "time,other\n0,y\n");
}

TEST_F(DurableFiles, WhatAnEarlierRunWroteIsKept) {
  const auto write_both = [](int step) {
    write_folder("checkpoints/" + std::to_string(step), {step, 5});
    fs::create_directories("checkpoints/fluid-" + std::to_string(step));
    write_record("checkpoints/fluid-" + std::to_string(step) + ".complete", {step, 5}, {});
  };
  write_both(320);
  write_both(640);
  fs::create_directories("checkpoints/backup");
  EXPECT_THROW(make_room_for_checkpoints(".", Side::dem, -1, false), Refusal);
  EXPECT_THROW(make_room_for_checkpoints(".", Side::fluid, -1, false), Refusal);
  EXPECT_EQ(make_room_for_checkpoints(".", Side::dem, 640, true), "");
  EXPECT_NE(make_room_for_checkpoints(".", Side::dem, 320, false), "");
  for (const char* moved : {"640/manifest", "fluid-640", "fluid-640.complete"}) {
    EXPECT_TRUE(fs::exists(fs::path("checkpoints.before-1") / moved)) << moved;
    EXPECT_FALSE(fs::exists(fs::path("checkpoints") / moved)) << moved;
  }
  mark_finished(".");
  EXPECT_NE(make_room_for_checkpoints(".", Side::dem, -1, false), "");
  EXPECT_TRUE(fs::exists("checkpoints.before-2/320/manifest"));
  EXPECT_TRUE(fs::exists("checkpoints/backup"));
  EXPECT_FALSE(fs::exists("checkpoints/finished"));
  EXPECT_EQ(make_room_for_checkpoints(".", Side::dem, -1, false), "");
}
