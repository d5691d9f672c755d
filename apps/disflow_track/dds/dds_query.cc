// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_query.h"

#include <algorithm>
#include <limits>

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

}  // namespace

void DdsQueries::Receive(const DdsFrames& frames) {
  service_.requests.TakeAll(
      [this, &frames](const ros::QueryRequest& request) { Take(request, frames); });
}

void DdsQueries::Take(const ros::QueryRequest& request, const DdsFrames& frames) {
  Job job;
  job.header = request.header;
  const std::size_t count = request.points._length;
  if (count > kMaxPoints || jobs_.size() >= kMaxRequests) {
    Reply(job,
          count > kMaxPoints ? "too many points: at most 2000 fit into one request"
                             : "too many requests at once: ask again",
          0, frames);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const ros::Point& x = request.points._buffer[i];
    job.points_m.emplace_back(static_cast<float>(x.x), static_cast<float>(x.y),
                              static_cast<float>(x.z));
  }
  jobs_.push_back(std::move(job));
}

void DdsQueries::Answer(ModelSnapshot& snapshot, std::int64_t ros_ns, const DdsFrames& frames) {
  std::size_t left = kPointsPerTurn;
  while (asked_ > 0 && left > 0) {
    Job& job = jobs_.front();
    const bool has_model = snapshot.Query(Vec3::Zero()).status == Status::kOk;
    while (has_model && left > 0 && job.distance.size() < job.points_m.size()) {
      AnswerPoint(snapshot, job.points_m[job.distance.size()], job);
      --left;
    }
    if (has_model && job.distance.size() < job.points_m.size()) return;
    Reply(job, has_model ? "" : "there is no model yet", ros_ns, frames);
    jobs_.pop_front();
    --asked_;
  }
}

void DdsQueries::AnswerPoint(ModelSnapshot& snapshot, const Vec3& x_m, Job& job) noexcept {
  Expected<DistanceQuery> answer = snapshot.Query(x_m);
  if (!answer.ok()) {
    answer.value = {};
    answer.value.distance_m = std::numeric_limits<float>::quiet_NaN();
    answer.value.variance_m2 = std::numeric_limits<float>::infinity();
  }
  const Vec3& gradient = answer.value.gradient;
  job.distance.push_back(answer.value.distance_m);
  job.gradient.push_back({static_cast<double>(gradient.x()), static_cast<double>(gradient.y()),
                          static_cast<double>(gradient.z())});
  job.variance.push_back(answer.value.variance_m2);
  job.in_bounds.push_back(answer.value.in_bounds ? 1 : 0);
}

void DdsQueries::GiveUp(const DdsFrames& frames) {
  for (; asked_ > 0; --asked_) {
    Reply(jobs_.front(), "no frame came within a second", 0, frames);
    jobs_.pop_front();
  }
}

void DdsQueries::Reply(Job& job, const std::string& trouble, std::int64_t ros_ns,
                       const DdsFrames& frames) {
  ros::QueryResponse response{};
  response.header = job.header;
  response.success = trouble.empty();
  response.message = posix::Lend(trouble);
  response.model = RosHeader(ros_ns, frames.object);
  posix::Lend(job.distance, response.distance);
  posix::Lend(job.gradient, response.gradient);
  posix::Lend(job.variance, response.variance);
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  response.in_bounds._buffer = reinterpret_cast<bool*>(job.in_bounds.data());
  response.in_bounds._length = response.in_bounds._maximum =
      static_cast<std::uint32_t>(job.in_bounds.size());
  service_.Reply(response);
}

}  // namespace disflow::apps
