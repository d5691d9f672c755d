// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

#include "program/console.h"
#include "run/run_part.h"

namespace disflow::apps {

/// Opens the next files of a run that rotates them, closes those that are full and removes old
/// ones, in a thread of its own: the tracking thread waits for no disk.
class PartMaker {
 public:
  /// @param named The options before NumberOutputs(). All outlive this object.
  /// @param queue Of all parts, see RunPart.
  PartMaker(const Options& named, const hal::SensorInfo& sensor, RecordingQueue* queue,
            Console& console);
  PartMaker(const PartMaker&) = delete;
  PartMaker& operator=(const PartMaker&) = delete;
  /// Closes what was retired.
  ~PartMaker();

  /// Asks for the next files, if nobody has yet.
  /// @param wait Until they are there or cannot be opened.
  /// @return Null: they are not there yet, or cannot be opened, which is said; it is tried again
  /// after some seconds.
  [[nodiscard]] std::unique_ptr<RunPart> Take(bool wait);
  /// Closes the files that are full. Only after Take() gave the next ones.
  void Retire(std::unique_ptr<RunPart> part);
  /// Waits until all that was retired is closed. @return false if something of it failed.
  [[nodiscard]] bool Finish();
  [[nodiscard]] int retired() const noexcept { return retired_count_; }

 private:
  void Work();
  void Open();
  void Close(std::unique_ptr<RunPart> part);
  void Fail(const std::string& message);

  const Options& named_;
  const hal::SensorInfo& sensor_;
  RecordingQueue* queue_;
  Console& console_;
  int retired_count_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  // Under the mutex.
  bool wanted_ = false;
  std::unique_ptr<RunPart> next_;
  std::unique_ptr<RunPart> full_;
  std::int64_t try_again_ns_ = 0;
  bool ending_ = false;

  // Of the thread.
  bool complete_ = true;
  bool failing_ = false;  ///< It has been said.
  std::thread thread_;
};

}  // namespace disflow::apps
