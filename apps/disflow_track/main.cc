// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>

#include "input/sensor_choice.h"
#include "program/console.h"
#include "program/exit_status.h"
#include "program/out_of_memory.h"
#include "program/stop_signal.h"
#include "run/run.h"
#include "settings/options.h"
#include "settings/settings.h"
#include "version.h"

namespace disflow::apps {
namespace {

ExitStatus Print(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    throw Failure(kOutputFailed, "standard output cannot be written");
  }
  return kDone;
}

/// @param log Where messages go, as soon as it is known.
ExitStatus Main(int argc, char** argv, std::string& log) {
  bool exit_now = false;
  const Options options = ParseCommandLine(argc, argv, exit_now);
  if (exit_now) return kDone;
  if (options.print_version) return Print(VersionText());
  if (options.list_sensors) return Print(ListSensors());
  if (options.print_settings_table) return Print(FormatSettingsPage());
  if (options.print_config) return Print(FormatSettings(options.config));
  InstallStopSignals();
  log = options.log;
  return Run(options, {argc, argv});
}

}  // namespace
}  // namespace disflow::apps

int main(int argc, char** argv) {
  disflow::apps::EndWhenOutOfMemory();
  std::string log = "auto";
  try {
    return disflow::apps::Main(argc, argv, log);
  } catch (const disflow::apps::Failure& failure) {
    disflow::apps::Console(false, log).Say(failure.what(), disflow::apps::Severity::kError);
    return failure.status();
  } catch (const std::system_error& error) {
    // Of the standard library's, which says no more than "Resource temporarily unavailable".
    disflow::apps::Console(false, log)
        .Say(
            std::string("a thread cannot be started: ") + error.what() +
                "; allow more threads or memory (ulimit -u and -v, TasksMax= and MemoryMax= of the "
                "service)",
            disflow::apps::Severity::kError);
    return disflow::apps::kInputFailed;
  } catch (const std::exception& error) {
    disflow::apps::Console(false, log).Say(error.what(), disflow::apps::Severity::kError);
    return disflow::apps::kInputFailed;
  }
}
