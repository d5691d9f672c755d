// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "dds/dds_motion.h"
#include "disflow/posix/dds/ros_node.h"
#include "objects/model_snapshot.h"

namespace disflow::apps {

/// The service query_distance_field of one object. Requests wait for a copy of the model that is
/// younger than they are, and are then answered in pieces, so that no answer holds up the topics.
class DdsQueries {
 public:
  using Service = posix::RosService<posix::ros::QueryRequest, posix::ros::QueryResponse>;

  static constexpr std::size_t kMaxPoints =
      2000;  ///< Of one request: fits into a socket's default buffer.
  static constexpr std::size_t kMaxRequests = 16;  ///< At once.
  static constexpr std::size_t kPointsPerTurn = 1000;

  [[nodiscard]] Service& service() noexcept { return service_; }

  /// Takes what has come in; refuses at once what is too much.
  void Receive(const DdsFrames& frames);
  /// The same for one request.
  void Take(const posix::ros::QueryRequest& request, const DdsFrames& frames);
  /// @return true if a request waits that no copy was asked for yet.
  [[nodiscard]] bool NeedsSnapshot() const noexcept { return asked_ < jobs_.size(); }
  /// A copy was asked for: it will answer all requests that are here now.
  void SnapshotAsked() noexcept { asked_ = jobs_.size(); }
  /// @return true if requests wait for the copy that was asked for.
  [[nodiscard]] bool AwaitsSnapshot() const noexcept { return asked_ > 0; }
  /// Answers up to kPointsPerTurn points.
  void Answer(ModelSnapshot& snapshot, std::int64_t ros_ns, const DdsFrames& frames);
  /// No copy came for too long: nothing is being tracked.
  void GiveUp(const DdsFrames& frames);

 private:
  struct Job {
    disflow_dds_RequestHeader header;
    std::vector<Vec3> points_m;
    std::vector<float> distance;
    std::vector<posix::ros::Vector3> gradient;
    std::vector<float> variance;
    std::vector<std::uint8_t> in_bounds;
  };

  void AnswerPoint(ModelSnapshot& snapshot, const Vec3& x_m, Job& job) noexcept;
  void Reply(Job& job, const std::string& trouble, std::int64_t ros_ns, const DdsFrames& frames);

  Service service_;
  std::deque<Job> jobs_;
  std::size_t asked_ = 0;  ///< The first ones: the copy asked for is for them.
};

}  // namespace disflow::apps
