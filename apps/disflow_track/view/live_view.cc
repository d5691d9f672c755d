// SPDX-License-Identifier: BSD-3-Clause
#include "view/live_view.h"

#include <algorithm>
#include <utility>

#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/quiet_thread.h"
#include "view/view_messages.h"
#include "view/view_texts.h"

namespace disflow::apps {
namespace {

/// Between two updates at least.
constexpr std::int64_t kInterval_ns = 100'000'000;
/// How much of the past a browser gets that comes later: a minute.
constexpr std::size_t kLogMessages = 600;

std::vector<std::string> NamesOf(std::span<ObjectChannel* const> channels) {
  std::vector<std::string> names;
  for (const ObjectChannel* const channel : channels) names.push_back(channel->name());
  return names;
}

posix::WebServerOptions WithMetrics(posix::WebServerOptions options, const RunMetrics& metrics) {
  options.metrics = [&metrics] { return metrics.Text(); };
  return options;
}

}  // namespace

LiveView::LiveView(posix::WebServerOptions options, std::span<const posix::WebAsset> page,
                   std::span<ObjectChannel* const> channels, const std::string& version)
    : board_(1 + ObjectView::kTopics * channels.size(), kLogMessages),
      metrics_(version, NamesOf(channels)),
      server_(WithMetrics(std::move(options), metrics_), page, board_,
              [this](auto command) { Obey(command); }) {
  for (ObjectChannel* const channel : channels) {
    const auto object = static_cast<int>(objects_.size());
    const std::size_t first_topic = 1 + ObjectView::kTopics * objects_.size();
    objects_.push_back(
        std::make_unique<ObjectView>(*channel, object, first_topic, signal_, board_, metrics_));
  }
  board_.Put(0, EncodeText(ViewMessage::kHello, 0, DescribeProgram(version, NamesOf(channels))));
}

LiveView::~LiveView() {
  if (!thread_.joinable()) return;
  stop_ = true;
  signal_.Raise();
  thread_.join();
}

hal::Fault LiveView::Start() {
  const hal::Fault fault = server_.Start();
  if (!fault.ok()) return fault;
  thread_ = posix::StartQuietThread([this] { Work(); });
  return {};
}

void LiveView::Work() {
  posix::MonotonicClock clock;
  while (!stop_) {
    const std::int64_t now_ns = clock.NowNs();
    const bool watched = server_.viewers() > 0;
    for (const auto& object : objects_) object->Update(watched, ended_, now_ns);
    server_.Notify();
    clock.SleepUntilNs(now_ns + kInterval_ns);
    // Without news the browsers still hear that the link stands.
    (void)signal_.WaitFor(kInterval_ns);
  }
}

void LiveView::Obey(std::span<const std::uint8_t> command) {
  static_assert(kViewLongCommandBytes == posix::WebServer::kLongCommandBytes);
  if (command[1] >= objects_.size()) return;
  const auto wanted = static_cast<ViewCommand>(command[0]);
  switch (wanted) {
    case ViewCommand::kReset:
      objects_[command[1]]->channel().RequestReset();
      return;
    case ViewCommand::kPause:
    case ViewCommand::kResume:
      // The objects share their frames.
      for (const auto& object : objects_) {
        object->channel().SetPaused(wanted == ViewCommand::kPause);
      }
      return;
    case ViewCommand::kChoose:
      if (const std::optional<ObjectChoice> choice = DecodeChoice(command))
        objects_[command[1]]->channel().Choose(*choice);
      return;
    case ViewCommand::kSet:
      if (const std::optional<ViewSetting> setting = DecodeSetting(command))
        (void)objects_[command[1]]->channel().settings().Set(setting->number, setting->value);
      // Whether or not it was: who asked sees what holds.
      objects_[command[1]]->ShowSettingsAgain();
      return;
  }
}

}  // namespace disflow::apps
