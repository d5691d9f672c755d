// SPDX-License-Identifier: BSD-3-Clause
#include "run/settings_watch.h"

#include <utility>

#include "disflow/config_fields.h"
#include "disflow/posix/monotonic_clock.h"
#include "disflow/posix/quiet_thread.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

/// Between two readings, however often the signal comes.
constexpr std::int64_t kLookEvery_ns = 200'000'000;
/// More are counted: a log line has an end.
constexpr std::size_t kMostSaid = 12;

std::string Join(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size() && i < kMostSaid; ++i)
    text += (i == 0 ? "" : ", ") + parts[i];
  if (parts.size() > kMostSaid)
    text += " and " + std::to_string(parts.size() - kMostSaid) + " more";
  return text;
}

/// The files that messages are about.
std::string Where(const Options& options) { return Join(options.settings_files) + ": "; }

}  // namespace

SettingsWatch::SettingsWatch(const CommandLine& command, const Options& options,
                             std::vector<ObjectChannel*> channels, Console& console)
    : command_(command), options_(options), channels_(std::move(channels)), console_(console) {
  if (options.settings_files.empty()) return;
  hangup_ = std::make_unique<HangupSignal>();
  thread_ = posix::StartQuietThread([this] { Work(); });
}

SettingsWatch::~SettingsWatch() {
  if (!thread_.joinable()) return;
  hangup_->End();
  thread_.join();
}

void SettingsWatch::Work() {
  posix::MonotonicClock clock;
  while (hangup_->Wait()) {
    try {
      ReadAgain();
    } catch (const Failure& failure) {
      console_.Say(std::string(failure.what()) + "; all settings stay as they are",
                   Severity::kError);
    }
    clock.SleepUntilNs(clock.NowNs() + kLookEvery_ns);
  }
}

void SettingsWatch::ReadAgain() {
  std::vector<Config> now;
  for (ObjectChannel* const channel : channels_) now.push_back(channel->settings().Now());
  const RereadSettings reread = ReadSettingsAgain(command_, options_, now);
  const std::string where = Where(options_);
  std::size_t changes = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) changes += Adopt(i, now[i], reread.wanted[i]);
  if (changes == 0) console_.Say(where + "read again, no setting of the tracker changes");
  if (reread.kept.empty()) return;
  console_.Say(
      where + "not changed while the program runs, only by a new start: " + Join(reread.kept),
      Severity::kWarning);
}

std::size_t SettingsWatch::Adopt(std::size_t object, const Config& before, const Config& wanted) {
  const std::vector<std::string> changes =
      DescribeChanges(before, AdjustedAtRunTime(before, wanted));
  if (changes.empty()) return 0;
  const std::string where = Where(options_);
  const std::string of = channels_.size() > 1 ? channels_[object]->name() + ": " : "";
  const ConfigIssue issue = channels_[object]->settings().Change([&](Config& config) {
    // What was changed elsewhere meanwhile stays.
    ApplyChanges(before, wanted, config);
  });
  // Each by itself is right, but not beside those that cannot change.
  if (issue.field != nullptr) {
    console_.Say(where + of + issue.field +
                     " does not fit the settings that stay as they are; nothing is changed",
                 Severity::kError);
    return 0;
  }
  console_.Say(where + of + "read again, now " + Join(changes), Severity::kNotice);
  return changes.size();
}

}  // namespace disflow::apps
