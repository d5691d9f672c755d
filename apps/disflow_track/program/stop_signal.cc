// SPDX-License-Identifier: BSD-3-Clause
#include "program/stop_signal.h"

#include <unistd.h>

#include <csignal>

namespace disflow::apps {
namespace {

constexpr int kExitBySignal = 128;  // the shells' convention

volatile std::sig_atomic_t stop_requested = 0;

extern "C" void OnStopSignal(int signal_number) {
  if (stop_requested != 0) _exit(kExitBySignal + signal_number);
  stop_requested = 1;
}

}  // namespace

void InstallStopSignals() noexcept {
  struct sigaction action {};
  action.sa_handler = OnStopSignal;
  action.sa_flags = SA_RESTART;  // files are read and written to the end of the record
  (void)::sigaction(SIGINT, &action, nullptr);
  (void)::sigaction(SIGTERM, &action, nullptr);
  (void)::sigaction(SIGHUP, &action, nullptr);
  (void)std::signal(SIGPIPE, SIG_IGN);
  (void)std::signal(SIGXFSZ, SIG_IGN);
}

bool StopRequested() noexcept { return stop_requested != 0; }

}  // namespace disflow::apps
