// SPDX-License-Identifier: BSD-3-Clause
#include "request.h"

#include <gtest/gtest.h>

namespace disflow::posix {
namespace {

const AccessRules kRules = {"correct-horse", true};

Request OwnPage() {
  Request request;
  request.is_get = true;
  request.host = "localhost:8080";
  request.origin = "http://localhost:8080";
  request.cookie_token = kRules.token;
  return request;
}

TEST(RequestTest, OwnPageWithTheToken_IsAllowed) {
  EXPECT_EQ(Judge(OwnPage(), kRules), Verdict::kAllowed);
}

TEST(RequestTest, NoOriginAtAll_IsAllowed) {
  Request request = OwnPage();
  request.origin.reset();
  EXPECT_EQ(Judge(request, kRules), Verdict::kAllowed);
}

TEST(RequestTest, ProgramWithTheTokenInItsHeader_IsAllowed) {
  Request request = OwnPage();
  request.origin.reset();
  request.cookie_token.clear();
  EXPECT_EQ(Judge(request, kRules), Verdict::kNoToken);
  request.bearer_token = kRules.token;
  EXPECT_EQ(Judge(request, kRules), Verdict::kAllowed);
  request.bearer_token += "x";
  EXPECT_EQ(Judge(request, kRules), Verdict::kNoToken);
}

TEST(RequestTest, OriginOfNothing_IsNotNoOrigin) {
  Request request = OwnPage();
  request.origin = "";
  EXPECT_EQ(Judge(request, kRules), Verdict::kForbidden);
}

TEST(RequestTest, HeaderThatDidNotFit_IsRefusedWhateverTheRest) {
  Request request = OwnPage();
  request.origin.reset();
  request.is_whole = false;
  EXPECT_EQ(Judge(request, kRules), Verdict::kBadRequest);
}

TEST(RequestTest, OriginThatOnlyBeginsOrEndsLikeTheHost_IsForbidden) {
  for (const char* origin : {"localhost:8080", "http://localhost:80801", "http://localhost:808",
                             "http://localhost:8080/", "http://localhost:8080.example.org",
                             "http://example.org/://localhost:8080", "null", "://"}) {
    Request request = OwnPage();
    request.origin = origin;
    EXPECT_EQ(Judge(request, kRules), Verdict::kForbidden) << origin;
  }
}

}  // namespace
}  // namespace disflow::posix
