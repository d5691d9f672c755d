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

struct BadUri {
  const char* name;
  const char* text;
};

void PrintTo(const BadUri& uri, std::ostream* stream) { *stream << uri.name; }

class MalformedUri : public testing::TestWithParam<BadUri> {};

TEST_P(MalformedUri, IsRefusedAndNothingIsChanged) {
  Uri uri{.scheme = "kept", .path = "kept", .query = {}};
  const hal::Fault fault = ParseUri(GetParam().text, uri);
  EXPECT_EQ(fault.status, Status::kInvalidUri);
  EXPECT_STRNE(fault.message, "");
  EXPECT_EQ(uri.scheme, "kept");
  EXPECT_EQ(uri.path, "kept");
}

INSTANTIATE_TEST_SUITE_P(All, MalformedUri,
                         testing::Values(BadUri{"Empty", ""}, BadUri{"ColonAlone", ":"},
                                         BadUri{"NoColon", "sim"}, BadUri{"NoPath", "sim:"},
                                         BadUri{"NoScheme", ":box"},
                                         BadUri{"QueryInPlaceOfPath", "sim:?a=b"},
                                         BadUri{"QueryFirst", "?a:b"},
                                         BadUri{"OptionWithoutValue", "sim:box?motion"},
                                         BadUri{"ValueWithoutOption", "sim:box?=fast"},
                                         BadUri{"OptionTwice", "sim:box?a=1&a=2"},
                                         BadUri{"EmptyOption", "sim:box?a=1&&b=2"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace disflow::host
