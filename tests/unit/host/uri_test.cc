// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/uri.h"

#include <gtest/gtest.h>

namespace disflow::host {
namespace {

TEST(ParseUri, SchemePathAndQuery_AreTakenApart) {
  Uri uri;
  const hal::Fault fault = ParseUri("sim:obj:/a/b.obj?motion=fast&seed=3&empty=", uri);
  ASSERT_TRUE(fault.ok()) << fault.message;
  EXPECT_EQ(uri.scheme, "sim");
  EXPECT_EQ(uri.path, "obj:/a/b.obj");
  const std::vector<std::pair<std::string, std::string>> expected{
      {"motion", "fast"}, {"seed", "3"}, {"empty", ""}};
  EXPECT_EQ(uri.query, expected);
}

TEST(ParseUri, WithoutQuery_HasNone) {
  Uri uri;
  ASSERT_TRUE(ParseUri("replay:/data/a b", uri).ok());
  EXPECT_EQ(uri.path, "/data/a b");
  EXPECT_TRUE(uri.query.empty());
}

class MalformedUri : public testing::TestWithParam<const char*> {};

TEST_P(MalformedUri, IsRefusedAndNothingIsChanged) {
  Uri uri{.scheme = "kept", .path = "kept", .query = {}};
  const hal::Fault fault = ParseUri(GetParam(), uri);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_STRNE(fault.message, "");
  EXPECT_EQ(uri.scheme, "kept");
  EXPECT_EQ(uri.path, "kept");
}

INSTANTIATE_TEST_SUITE_P(All, MalformedUri,
                         testing::Values("", ":", "sim", "sim:", ":box", "sim:?a=b", "?a:b",
                                         "sim:box?motion", "sim:box?=fast", "sim:box?a=1&a=2",
                                         "sim:box?a=1&&b=2"));

}  // namespace
}  // namespace disflow::host
