// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_lifecycle.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

// Of lifecycle_msgs.
constexpr std::uint8_t kActivate = 3;
constexpr std::uint8_t kDeactivate = 4;
constexpr std::uint8_t kInactive = 2;
constexpr std::uint8_t kActive = 3;

ros::LifecycleState StateOf(bool is_active) {
  static const std::string active = "active";
  static const std::string inactive = "inactive";
  return {is_active ? kActive : kInactive, posix::Lend(is_active ? active : inactive)};
}

ros::TransitionDescription TransitionFrom(bool is_active) {
  static const std::string activate = "activate";
  static const std::string deactivate = "deactivate";
  return {{is_active ? kDeactivate : kActivate, posix::Lend(is_active ? deactivate : activate)},
          StateOf(is_active),
          StateOf(!is_active)};
}

}  // namespace

DdsLifecycle::DdsLifecycle(const std::string& node_name, std::span<ObjectChannel* const> channels,
                           posix::RosNode& node)
    : channels_(channels.begin(), channels.end()) {
  const std::string prefix = node_name + "/";
  Require(node.Advertise(prefix + "transition_event", posix::RosQos::kReliable, events_));
  Require(node.Serve(prefix + "get_state", get_state_));
  Require(node.Serve(prefix + "change_state", change_state_));
  Require(node.Serve(prefix + "get_available_states", states_));
  Require(node.Serve(prefix + "get_available_transitions", transitions_));
}

/// Objects share their frames, so whoever pauses one pauses all.
bool DdsLifecycle::is_active() const noexcept {
  return std::none_of(channels_.begin(), channels_.end(),
                      [](const ObjectChannel* channel) { return channel->paused(); });
}

void DdsLifecycle::Turn() {
  get_state_.requests.TakeAll([this](const ros::GetStateRequest& request) {
    get_state_.Reply({request.header, StateOf(is_active())});
  });
  change_state_.requests.TakeAll([this](const ros::ChangeStateRequest& request) {
    change_state_.Reply({request.header, Change(request)});
    TellChange();  // each of several
  });
  states_.requests.TakeAll([this](const ros::GetAvailableStatesRequest& request) {
    std::vector<ros::LifecycleState> states = {StateOf(false), StateOf(true)};
    ros::GetAvailableStatesResponse response{};
    response.header = request.header;
    posix::Lend(states, response.available_states);
    states_.Reply(response);
  });
  transitions_.requests.TakeAll([this](const ros::GetAvailableTransitionsRequest& request) {
    std::vector<ros::TransitionDescription> transitions = {TransitionFrom(is_active())};
    ros::GetAvailableTransitionsResponse response{};
    response.header = request.header;
    posix::Lend(transitions, response.available_transitions);
    transitions_.Reply(response);
  });
  TellChange();
}

void DdsLifecycle::TellChange() {
  const bool active = is_active();
  if (active == std::exchange(told_active_, active)) return;
  const ros::TransitionDescription made = TransitionFrom(!active);
  // Whoever missed it asks.
  (void)events_.Publish(
      {static_cast<std::uint64_t>(dds_time()), made.transition, made.start_state, made.goal_state});
}

bool DdsLifecycle::Change(const ros::ChangeStateRequest& request) noexcept {
  // As rclcpp has it, a label is asked first.
  const std::string_view label = posix::TextOf(request.transition.label);
  std::uint8_t wanted = request.transition.id;
  if (label == "activate") wanted = kActivate;
  if (label == "deactivate") wanted = kDeactivate;
  const bool is_possible = wanted == (is_active() ? kDeactivate : kActivate);
  if (!is_possible) return false;
  for (ObjectChannel* const channel : channels_) channel->SetPaused(wanted == kDeactivate);
  return true;
}

}  // namespace disflow::apps
