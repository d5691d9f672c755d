// SPDX-License-Identifier: BSD-3-Clause
#include "links/choice_command.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace disflow::apps {

std::optional<ObjectChoice> ChoiceOf(const hal::mavlink::CommandLong& command) noexcept {
  const bool is_box = command.command == hal::mavlink::CommandLong::kCameraTrackRectangle;
  // Written so that NaN is no share.
  const auto is_share = [](float value) { return value >= 0.0F && value <= 1.0F; };
  const std::span shares = std::span(command.param).first(is_box ? 4 : 3);
  ObjectChoice choice;
  choice.kind = is_box ? ObjectChoice::Kind::kBox : ObjectChoice::Kind::kPixel;
  choice.u = shares[0];
  choice.v = shares[1];
  if (is_box) {
    choice.width = shares[2] - shares[0];
    choice.height = shares[3] - shares[1];
    if (!(choice.width > 0.0F && choice.height > 0.0F)) return std::nullopt;
  } else {
    // What a sender does not say is NaN.
    choice.reach = std::isnan(shares[2]) ? 0.0F : shares[2];
    if (!is_share(choice.reach)) return std::nullopt;
  }
  const std::span places = is_box ? shares : shares.first(2);
  if (!std::all_of(places.begin(), places.end(), is_share)) return std::nullopt;
  return choice;
}

}  // namespace disflow::apps
