// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "settings/options.h"

namespace disflow::apps {

/// The command line, which is read again with its settings file.
struct CommandLine {
  int argc = 0;
  char** argv = nullptr;
};

/// What settings files say that were read again while the program runs.
struct RereadSettings {
  std::vector<Config> wanted;  ///< One per object.
  /// What differs and holds only from the next start on: options of [run], objects, settings.
  std::vector<std::string> kept;
};

/// Reads the settings files of a run again. What neither they nor the command line mention is as it
/// is now, so that a file of which a part is missing takes nothing away. A file that does not end
/// with a line is taken for one that is just being written.
/// @param running The options that the run began with.
/// @param now The settings that its objects have now, in the order of Options::objects.
/// @throws Failure kWrongUsage naming file, line and what is wrong.
[[nodiscard]] RereadSettings ReadSettingsAgain(const CommandLine& command, const Options& running,
                                               std::span<const Config> now);

/// Gives `config` what differs between `before` and `after`, and nothing else.
void ApplyChanges(const Config& before, const Config& after, Config& config);

/// What a change amounts to, for people: "registration.iterations = 10 (was 8)", a text for each.
[[nodiscard]] std::vector<std::string> DescribeChanges(const Config& before, const Config& after);

}  // namespace disflow::apps
