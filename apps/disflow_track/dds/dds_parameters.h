// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "dds/parameter_table.h"
#include "disflow/posix/dds/ros_node.h"

namespace disflow::apps {

/// The settings of all objects as the node's parameters: the services that `ros2 param` calls, and
/// /parameter_events, where every change is told, whoever made it.
class DdsParameters {
 public:
  /// @param node_name With its namespace.
  /// @throws Failure kOutputFailed.
  DdsParameters(const std::string& node_name, std::span<ObjectChannel* const> channels,
                posix::RosNode& node);

  /// Answers what was asked, tells what has changed.
  void Turn();

 private:
  template <class Request, class Response>
  using Service = posix::RosService<Request, Response>;

  void ServeReading();
  void ServeSetting();
  void List(const posix::ros::ListParametersRequest& request);
  void Describe(const posix::ros::DescribeParametersRequest& request);
  void TellChanges();

  const std::string node_;
  ParameterTable table_;
  Service<posix::ros::GetParametersRequest, posix::ros::GetParametersResponse> get_;
  Service<posix::ros::GetParameterTypesRequest, posix::ros::GetParameterTypesResponse> types_;
  Service<posix::ros::DescribeParametersRequest, posix::ros::DescribeParametersResponse> describe_;
  Service<posix::ros::ListParametersRequest, posix::ros::ListParametersResponse> list_;
  Service<posix::ros::SetParametersRequest, posix::ros::SetParametersResponse> set_;
  Service<posix::ros::SetParametersAtomicallyRequest, posix::ros::SetParametersAtomicallyResponse>
      set_atomically_;
  posix::RosPublisher<posix::ros::ParameterEvent> events_;
};

}  // namespace disflow::apps
