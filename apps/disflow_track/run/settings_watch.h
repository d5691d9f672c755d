// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <thread>
#include <vector>

#include "objects/object_channel.h"
#include "program/console.h"
#include "program/hangup_signal.h"
#include "settings/settings_reread.h"

namespace disflow::apps {

/// Reads the settings file of a run again when SIGHUP says so, in a thread of its own, and hands
/// the settings that may change at run time to the objects. What else differs is said and stays as
/// it is; a file that is wrong changes nothing. Without a settings file it does nothing, and SIGHUP
/// ends the run.
class SettingsWatch {
 public:
  /// @param command, options, channels, console Outlive the watch.
  SettingsWatch(const CommandLine& command, const Options& options,
                std::vector<ObjectChannel*> channels, Console& console);
  SettingsWatch(const SettingsWatch&) = delete;
  SettingsWatch& operator=(const SettingsWatch&) = delete;
  ~SettingsWatch();

 private:
  void Work();
  void ReadAgain();
  /// @return How many settings changed.
  std::size_t Adopt(std::size_t object, const Config& before, const Config& wanted);

  const CommandLine& command_;
  const Options& options_;
  std::vector<ObjectChannel*> channels_;
  Console& console_;
  std::unique_ptr<HangupSignal> hangup_;  ///< Null: no file.
  std::thread thread_;
};

}  // namespace disflow::apps
