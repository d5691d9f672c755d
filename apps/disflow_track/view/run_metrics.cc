// SPDX-License-Identifier: BSD-3-Clause
#include "view/run_metrics.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "disflow/geometry/covariance.h"
#include "program/counter_names.h"

namespace disflow::apps {
namespace {

constexpr double kSecondsPerNs = 1e-9;

/// Appends metrics of one text.
class MetricsWriter {
 public:
  /// @param type counter, gauge or histogram.
  void Begin(const std::string& name, const char* type, const std::string& help) {
    name_ = "disflow_" + name;
    text_ += "# HELP " + name_ + " " + help + "\n# TYPE " + name_ + " " + type + "\n";
  }
  /// @param labels As they stand between the braces; empty: none.
  void Add(const std::string& labels, double value, const char* suffix = "") {
    std::array<char, 32> number{};
    (void)std::snprintf(number.data(), number.size(), "%.15g", value);
    text_ +=
        name_ + suffix + (labels.empty() ? "" : "{" + labels + "}") + " " + number.data() + "\n";
  }
  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  std::string name_;
  std::string text_;
};

/// Names of objects are words; versions may hold anything.
std::string Label(const char* name, const std::string& value) {
  std::string text = std::string(name) + "=\"";
  for (const char c : value) {
    if (c == '\\' || c == '"') text += '\\';
    text += c == '\n' ? ' ' : c;
  }
  return text + "\"";
}

}  // namespace

RunMetrics::RunMetrics(std::string version, std::vector<std::string> objects)
    : version_(std::move(version)), objects_(objects.size()) {
  for (std::size_t i = 0; i < objects.size(); ++i) objects_[i].name = std::move(objects[i]);
}

void RunMetrics::Add(std::size_t object, const FrameResult& result) {
  const std::lock_guard lock(mutex_);
  Object& o = objects_[object];
  // The counter of an estimate starts again at 0 after 255.
  if (o.has_result) {
    o.restarts +=
        static_cast<std::uint8_t>(result.estimate.reset_counter - o.newest.estimate.reset_counter);
  }
  o.newest = result;
  o.has_result = true;
  const double seconds = kSecondsPerNs * static_cast<double>(result.total_ns);
  o.total_s += seconds;
  const auto bucket = std::lower_bound(kBuckets_s.begin(), kBuckets_s.end(), seconds);
  ++o.buckets[static_cast<std::size_t>(bucket - kBuckets_s.begin())];
}

void RunMetrics::SetLost(std::size_t object, std::uint32_t lost) {
  const std::lock_guard lock(mutex_);
  objects_[object].lost = lost;
}

std::string RunMetrics::Text() const {
  const std::lock_guard lock(mutex_);
  MetricsWriter writer;
  const auto of_each = [&](const char* name, const char* type, const std::string& help,
                           auto&& value) {
    writer.Begin(name, type, help);
    for (const Object& o : objects_) {
      if (o.has_result) writer.Add(Label("object", o.name), static_cast<double>(value(o)));
    }
  };
  writer.Begin("build_info", "gauge", "1; the program's version");
  writer.Add(Label("version", version_), 1.0);
  for (const auto& counter : kTrackerCounters) {
    of_each((std::string(counter.metric) + "_total").c_str(), "counter",
            std::string("Tracker: ") + counter.words,
            [&](const Object& o) { return o.newest.totals.*counter.member; });
  }
  for (const auto& counter : kSensorCounters) {
    writer.Begin(std::string("sensor_") + counter.metric + "_total", "counter",
                 std::string("Sensor: ") + counter.words);
    // All objects share it.
    if (!objects_.empty())
      writer.Add("", static_cast<double>(objects_.front().newest.sensor.*counter.member));
  }
  writer.Begin("recording_dropped_total", "counter",
               "Frames that the recording lacks because the disk did not keep up");
  if (!objects_.empty())
    writer.Add("", static_cast<double>(objects_.front().newest.recording_dropped));
  writer.Begin("state", "gauge", "1 for the state that the object is in");
  for (const Object& o : objects_) {
    if (!o.has_result) continue;
    for (int i = 0; i <= static_cast<int>(TrackingState::kRecovered); ++i) {
      const auto state = static_cast<TrackingState>(i);
      writer.Add(Label("object", o.name) + "," + Label("state", Name(state)),
                 o.newest.estimate.state == state ? 1.0 : 0.0);
    }
  }
  of_each("quality", "gauge", "0 is not usable, 100 is best",
          [](const Object& o) { return o.newest.estimate.quality; });
  of_each("position_std_meters", "gauge", "Largest standard deviation of the position",
          [](const Object& o) {
            return static_cast<double>(LargestPositionStd(o.newest.estimate.pose_covariance));
          });
  of_each("model_coarseness", "gauge",
          "How many times coarser than set the model is, so that the object fits into it",
          [](const Object& o) { return o.newest.model_coarseness; });
  of_each("restarts_total", "counter", "How often the object was begun anew",
          [](const Object& o) { return o.restarts; });
  of_each("results_not_seen_total", "counter", "Results that came too fast to be counted here",
          [](const Object& o) { return o.lost; });
  writer.Begin("frame_seconds", "histogram", "Time in the tracker per frame");
  for (const Object& o : objects_) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < kBuckets_s.size(); ++i) {
      std::array<char, 32> end{};
      (void)std::snprintf(end.data(), end.size(), "%g", kBuckets_s[i]);
      count += o.buckets[i];
      writer.Add(Label("object", o.name) + "," + Label("le", end.data()),
                 static_cast<double>(count), "_bucket");
    }
    count += o.buckets.back();
    writer.Add(Label("object", o.name) + ",le=\"+Inf\"", static_cast<double>(count), "_bucket");
    writer.Add(Label("object", o.name), o.total_s, "_sum");
    writer.Add(Label("object", o.name), static_cast<double>(count), "_count");
  }
  return writer.Take();
}

}  // namespace disflow::apps
