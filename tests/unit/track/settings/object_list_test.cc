// SPDX-License-Identifier: BSD-3-Clause
#include "settings/object_list.h"

#include <gtest/gtest.h>

#include <array>

#include "disflow/hal/mavlink/telemetry.h"
#include "program/exit_status.h"
#include "refusal.h"

namespace disflow::apps {
namespace {

/// The objects of as many --object.
std::vector<ObjectOptions> Make(const std::vector<std::string>& texts,
                                const CommonObjectOptions& common = {}) {
  std::vector<ObjectTable> tables;
  for (const std::string& text : texts) tables.push_back(ParseObject(text, Config{}));
  return MakeObjects(tables, common, Config{});
}

std::string Refusal(const std::vector<std::string>& texts, const CommonObjectOptions& common = {}) {
  return RefusalOf([&] { (void)Make(texts, common); });
}

TEST(ObjectList, NothingNamed_IsOneObjectThatUsesTheMask) {
  CommonObjectOptions common;
  common.first_index = 4;
  common.files.csv = "run.csv";
  const std::vector<ObjectOptions> objects = MakeObjects({}, common, Config{});
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_TRUE(objects[0].uses_mask);
  EXPECT_EQ(objects[0].label, 0);
  EXPECT_EQ(objects[0].index, 4);
  EXPECT_EQ(objects[0].files.csv, "run.csv");
}

TEST(ObjectList, OneNamedObject_KeepsTheFilesNamesAndTheMask) {
  CommonObjectOptions common;
  common.files.csv = "run.csv";
  const std::vector<ObjectOptions> objects = Make({"name=box"}, common);
  EXPECT_EQ(objects[0].files.csv, "run.csv");
  EXPECT_TRUE(objects[0].uses_mask);
}

TEST(ObjectList, SeveralObjects_UseTheMaskOnlyWithALabel) {
  const std::vector<ObjectOptions> objects = Make({"name=a,label=1", "name=b"});
  EXPECT_TRUE(objects[0].uses_mask);
  EXPECT_FALSE(objects[1].uses_mask);
}

TEST(ObjectList, FilesOfSeveralObjects_BearTheirNames) {
  CommonObjectOptions common;
  common.files = {"out.d/run.csv", "run", "a.b.png", "flow/"};
  const std::vector<ObjectOptions> objects =
      Make({"name=a,label=1", "name=b,label=2,csv=own.csv"}, common);
  EXPECT_EQ(objects[0].files.csv, "out.d/run-a.csv");
  EXPECT_EQ(objects[0].files.mesh, "run-a");
  EXPECT_EQ(objects[0].files.mesh_picture, "a.b-a.png");
  EXPECT_EQ(objects[0].files.flow, "flow-a");
  EXPECT_EQ(objects[1].files.csv, "own.csv");
  EXPECT_EQ(objects[1].files.mesh, "run-b");
}

TEST(ObjectList, Indices_CountFromTheFirstUnlessGiven) {
  CommonObjectOptions common;
  common.first_index = 10;
  const std::vector<ObjectOptions> objects =
      Make({"name=a,label=1", "name=b,label=2,index=3", "name=c,label=3"}, common);
  EXPECT_EQ(objects[0].index, 10);
  EXPECT_EQ(objects[1].index, 3);
  EXPECT_EQ(objects[2].index, 12);
}

TEST(ObjectList, IndexBeyondTheLast_IsRefused) {
  CommonObjectOptions common;
  common.first_index = hal::mavlink::kMaxObjectIndex;
  EXPECT_EQ(Refusal({"name=a,label=1"}, common), "");
  EXPECT_NE(Refusal({"name=a,label=1", "name=b,label=2"}, common).find("index"), std::string::npos);
}

TEST(ObjectList, ObjectsThatCannotBeToldApart_AreRefused) {
  EXPECT_NE(Refusal({"name=a,label=1", "name=a,label=2"}), "");
  EXPECT_NE(Refusal({"name=a,label=1", "name=b,label=1"}), "");
  EXPECT_NE(Refusal({"name=a", "name=b"}), "");
  EXPECT_NE(Refusal({"name=a,seed=1:2", "name=b,seed=1:2"}), "");
  EXPECT_NE(Refusal({"name=a,label=1,index=1", "name=b,label=2,index=1"}), "");
  EXPECT_NE(Refusal({"name=a,label=1,index=1", "name=b,label=2"}), "") << "the second's own is 1";
  EXPECT_EQ(Refusal({"name=a,label=1", "name=b"}), "");
  EXPECT_EQ(Refusal({"name=a,seed=1:2", "name=b,seed=1:3"}), "");
  EXPECT_EQ(Refusal({"name=a,roi=0:0:5:5", "name=b,roi=5:0:5:5"}), "");
}

TEST(ObjectList, TooManyObjects_AreRefused) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < kMaxObjects; ++i) {
    texts.push_back("name=o" + std::to_string(i) + ",label=" + std::to_string(i + 1));
  }
  EXPECT_EQ(Refusal(texts), "");
  texts.push_back("name=more,label=9");
  EXPECT_NE(Refusal(texts), "");
}

TEST(ObjectList, NameThatIsNoWord_IsRefused) {
  for (const std::string& name :
       {std::string(), std::string("1a"), std::string("a b"), std::string("a/b"),
        std::string("../a"), std::string("a-b"), std::string("_a"), std::string("\xC3\xA4"),
        std::string(33, 'a'), std::string("a\n"), std::string("a\0b", 3)}) {
    EXPECT_NE(Refusal({"name=" + name}), "") << name;
  }
  for (const std::string& name : {std::string("a"), std::string("Z_9"), std::string(32, 'a')}) {
    EXPECT_EQ(Refusal({"name=" + name}), "") << name;
  }
}

TEST(ObjectList, TextWithoutSense_IsRefused) {
  for (const char* text : {"",
                           "box",
                           "=box",
                           "name",
                           "name=a,,label=1",
                           "name=a,",
                           "colour=red",
                           "label=1",
                           "name=a,label=0",
                           "name=a,label=256",
                           "name=a,label=-1",
                           "name=a,label=1.0",
                           "name=a,label= 1",
                           "name=a,label=99999999999999999999",
                           "name=a,label=",
                           "name=a,index=-1",
                           "name=a,index=43",
                           "name=a,seed=1",
                           "name=a,seed=1:2:3",
                           "name=a,seed=-1:2",
                           "name=a,seed=1:",
                           "name=a,seed=:",
                           "name=a,seed=16385:1",
                           "name=a,roi=1:2:3",
                           "name=a,roi=1:2:3:4:5",
                           "name=a,roi=a:b:c:d",
                           "name=a,csv="}) {
    EXPECT_NE(Refusal({text}), "") << text;
  }
}

TEST(ObjectList, SeedAndRegion_AreSettingsOfThisObjectAlone) {
  const std::vector<ObjectOptions> objects =
      Make({"name=a,seed=3:4,roi=5:6:7:8", "name=b,label=1"});
  const SegmenterConfig& a = objects[0].config.segmenter;
  EXPECT_EQ((std::array{a.seed_u_px, a.seed_v_px}), (std::array{3, 4}));
  EXPECT_EQ((std::array{a.roi_x_px, a.roi_y_px, a.roi_width_px, a.roi_height_px}),
            (std::array{5, 6, 7, 8}));
  EXPECT_EQ(objects[1].config.segmenter.seed_u_px, SegmenterConfig{}.seed_u_px);
}

}  // namespace
}  // namespace disflow::apps
