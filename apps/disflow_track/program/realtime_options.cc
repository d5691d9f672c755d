// SPDX-License-Identifier: BSD-3-Clause
#include "program/realtime_options.h"

#include <string>

#include "disflow/posix/realtime.h"

namespace disflow::apps {
namespace {

constexpr int kHighestPriority = 99;

void Judge(const char* who, const hal::Fault& fault, Console& console) {
  if (!fault.ok())
    console.Say(std::string(who) + fault.message + "; the run goes on without it",
                Severity::kWarning);
}

void Apply(const char* who, int priority, const int* cpu, Console& console) {
  if (cpu != nullptr) Judge(who, posix::PinThisThread(*cpu), console);
  if (priority > 0) Judge(who, posix::SetThisThreadPriority(priority), console);
}

}  // namespace

void ApplyToTrackingThread(const RealtimeOptions& options, Console& console) {
  Apply("tracking thread: ", options.priority, options.cpus.empty() ? nullptr : &options.cpus[0],
        console);
}

void ApplyToWorkerThread(const RealtimeOptions& options, int worker, Console& console) {
  const std::size_t place = 2 + static_cast<std::size_t>(worker);
  Apply("tracking thread: ", options.priority,
        place < options.cpus.size() ? &options.cpus[place] : nullptr, console);
  if (options.lock_memory) posix::PrefaultStack();
}

void ApplyToCaptureThread(const RealtimeOptions& options, Console& console) {
  // It has little to do, and the newest frame is worth more than the one being tracked.
  const int priority = options.priority > 0 && options.priority < kHighestPriority
                           ? options.priority + 1
                           : options.priority;
  Apply("capture thread: ", priority, options.cpus.size() < 2 ? nullptr : &options.cpus[1],
        console);
  if (options.lock_memory) posix::PrefaultStack();
}

void LockProcessMemory(const RealtimeOptions& options, Console& console) {
  if (options.lock_memory) Judge("", posix::LockMemory(), console);
}

}  // namespace disflow::apps
