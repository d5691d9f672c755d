// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings_reread.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "disflow/config_fields.h"
#include "program/exit_status.h"
#include "refusal.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

constexpr const char* kRun = "[run]\nsensor = \"sim:box\"\n";

class SettingsRereadTest : public test::ScratchFolderTest {
 protected:
  /// As a run begins with this file and these arguments.
  void Start(const std::string& file, std::vector<std::string> arguments = {}) {
    test::WriteFile(Path("run.toml"), file);
    words_ = {"disflow_track", "--config", Path("run.toml")};
    words_.insert(words_.end(), arguments.begin(), arguments.end());
    pointers_.clear();
    for (std::string& word : words_) pointers_.push_back(word.data());
    command_ = {static_cast<int>(pointers_.size()), pointers_.data()};
    bool exit_now = false;
    options_ = ParseCommandLine(command_.argc, command_.argv, exit_now);
    now_.clear();
    for (const ObjectOptions& object : options_.objects) now_.push_back(object.config);
  }
  RereadSettings Reread(const std::string& file) {
    test::WriteFile(Path("run.toml"), file);
    return ReadSettingsAgain(command_, options_, now_);
  }

  std::vector<std::string> words_;
  std::vector<char*> pointers_;
  CommandLine command_;
  Options options_;
  std::vector<Config> now_;
};

TEST_F(SettingsRereadTest, SettingThatDiffers_IsWantedAndDescribed) {
  Start(std::string(kRun) + "[registration]\niterations = 9\n");
  const RereadSettings reread = Reread(std::string(kRun) + "[registration]\niterations = 12\n");
  EXPECT_EQ(reread.wanted.at(0).registration.iterations, 12);
  EXPECT_TRUE(reread.kept.empty());
  EXPECT_EQ(DescribeChanges(now_[0], reread.wanted[0]),
            std::vector<std::string>{"registration.iterations = 12 (was 9)"});
}

TEST_F(SettingsRereadTest, WhatTheFileNoLongerMentions_StaysAsItIs) {
  Start(std::string(kRun) + "[registration]\niterations = 9\n[monitor]\nmin_samples = 70\n");
  now_[0].twist.linear_jerk_psd = 3.0F;  // as the page has set it
  const RereadSettings reread = Reread(std::string(kRun) + "[monitor]\nmin_samples = 80\n");
  EXPECT_EQ(reread.wanted.at(0).registration.iterations, 9);
  EXPECT_EQ(reread.wanted.at(0).monitor.min_samples, 80);
  EXPECT_EQ(reread.wanted.at(0).twist.linear_jerk_psd, 3.0F);
}

TEST_F(SettingsRereadTest, WhatMayNotChangeAtRunTime_IsNamed) {
  Start("[run]\nsensor = \"sim:box\"\nlink = [\"udp://127.0.0.1:1\"]\nseed = [1, 2]\n");
  const RereadSettings reread = Reread(
      "[run]\nsensor = \"sim:can\"\nrate = \"live\"\nseed = [5, 2]\nrange = [0.2, 1.5]\n"
      "[field]\ncell_size_m = 0.05\n");
  const std::vector<std::string> kept = {"--link", "--sensor", "--rate", "segmenter.seed_u_px",
                                         "field.cell_size_m"};
  EXPECT_EQ(std::set(reread.kept.begin(), reread.kept.end()), std::set(kept.begin(), kept.end()));
  // The short form of settings that may.
  EXPECT_EQ(reread.wanted.at(0).segmenter.max_range_m, 1.5F);
  EXPECT_EQ(AdjustedAtRunTime(now_[0], reread.wanted[0]).field.cell_size_m,
            Config{}.field.cell_size_m);
}

TEST_F(SettingsRereadTest, WhatWasTyped_WinsAsItDidAtTheStart) {
  Start(kRun, {"--set", "registration.iterations=5"});
  const RereadSettings reread = Reread(std::string(kRun) + "[registration]\niterations = 12\n");
  EXPECT_EQ(reread.wanted.at(0).registration.iterations, 5);
}

TEST_F(SettingsRereadTest, EveryObject_GetsItsOwn) {
  const std::string objects =
      "[[object]]\nname = \"box\"\nlabel = 1\n[[object]]\nname = \"can\"\nlabel = 2\n";
  Start(std::string(kRun) + objects);
  RereadSettings reread = Reread(std::string(kRun) + "[registration]\niterations = 7\n" + objects +
                                 "registration.iterations = 9\n");
  EXPECT_EQ(reread.wanted.at(0).registration.iterations, 7);
  EXPECT_EQ(reread.wanted.at(1).registration.iterations, 9);
  EXPECT_TRUE(reread.kept.empty());
  reread = Reread(std::string(kRun) + objects + "[[object]]\nname = \"mug\"\nlabel = 3\n");
  EXPECT_EQ(reread.kept, std::vector<std::string>{"[[object]]"});
  EXPECT_TRUE(DescribeChanges(now_[0], reread.wanted[0]).empty());
}

TEST_F(SettingsRereadTest, FileThatIsWrongOrHalfWritten_IsRefusedWithItsPlace) {
  const std::string good = std::string(kRun) + "[registration]\niterations = 12\n";
  Start(kRun);
  const auto refusal = [this](const std::string& file) {
    return RefusalOf([&] { (void)Reread(file); });
  };
  EXPECT_NE(refusal("").find("run.toml: is empty"), std::string::npos);
  EXPECT_NE(refusal(std::string(kRun) + "[registration]\niterations = 1").find("line break"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(kRun) + "[registration]\niterations = 99\n").find("run.toml:4"),
            std::string::npos);
  EXPECT_NE(refusal("\xff\n").find("run.toml"), std::string::npos);
  std::filesystem::remove(Path("run.toml"));
  EXPECT_NE(RefusalOf([&] { (void)ReadSettingsAgain(command_, options_, now_); }).find("run.toml"),
            std::string::npos);
  // Cut anywhere, it is refused or says nothing that the whole does not say.
  for (std::size_t length = 0; length < good.size(); ++length) {
    try {
      const Config wanted = Reread(good.substr(0, length)).wanted.at(0);
      EXPECT_TRUE(DescribeChanges(now_[0], wanted).empty()) << good.substr(0, length);
    } catch (const Failure&) {
    }
  }
}

}  // namespace
}  // namespace disflow::apps
