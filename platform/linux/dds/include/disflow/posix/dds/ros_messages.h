// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros2.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// The generated messages under short names, and how they point into memory of their owner: a
/// message that is written owns nothing.

namespace disflow::posix {

namespace ros {
using Header = std_msgs_msg_dds__Header_;
using Time = builtin_interfaces_msg_dds__Time_;
using Point = geometry_msgs_msg_dds__Point_;
using PointStamped = geometry_msgs_msg_dds__PointStamped_;
using Vector3 = geometry_msgs_msg_dds__Vector3_;
using Quaternion = geometry_msgs_msg_dds__Quaternion_;
using Pose = geometry_msgs_msg_dds__Pose_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using TransformStamped = geometry_msgs_msg_dds__TransformStamped_;
using PoseWithCovarianceStamped = geometry_msgs_msg_dds__PoseWithCovarianceStamped_;
using TwistWithCovarianceStamped = geometry_msgs_msg_dds__TwistWithCovarianceStamped_;
using Odometry = nav_msgs_msg_dds__Odometry_;
using Path = nav_msgs_msg_dds__Path_;
using TFMessage = tf2_msgs_msg_dds__TFMessage_;
using KeyValue = diagnostic_msgs_msg_dds__KeyValue_;
using DiagnosticStatus = diagnostic_msgs_msg_dds__DiagnosticStatus_;
using DiagnosticArray = diagnostic_msgs_msg_dds__DiagnosticArray_;
using PointField = sensor_msgs_msg_dds__PointField_;
using PointCloud2 = sensor_msgs_msg_dds__PointCloud2_;
using Image = sensor_msgs_msg_dds__Image_;
using CompressedImage = sensor_msgs_msg_dds__CompressedImage_;
using CameraInfo = sensor_msgs_msg_dds__CameraInfo_;
using ColorRGBA = std_msgs_msg_dds__ColorRGBA_;
using Marker = visualization_msgs_msg_dds__Marker_;
using TriggerRequest = std_srvs_srv_dds__Trigger_Request_;
using TriggerResponse = std_srvs_srv_dds__Trigger_Response_;
using ChooseRequest = disflow_msgs_srv_dds__ChooseObject_Request_;
using ChooseResponse = disflow_msgs_srv_dds__ChooseObject_Response_;
using QueryRequest = disflow_msgs_srv_dds__QueryDistanceField_Request_;
using QueryResponse = disflow_msgs_srv_dds__QueryDistanceField_Response_;
using ParameterValue = rcl_interfaces_msg_dds__ParameterValue_;
using Parameter = rcl_interfaces_msg_dds__Parameter_;
using SetParametersResult = rcl_interfaces_msg_dds__SetParametersResult_;
using ParameterDescriptor = rcl_interfaces_msg_dds__ParameterDescriptor_;
using FloatingPointRange = rcl_interfaces_msg_dds__FloatingPointRange_;
using IntegerRange = rcl_interfaces_msg_dds__IntegerRange_;
using ParameterEvent = rcl_interfaces_msg_dds__ParameterEvent_;
using GetParametersRequest = rcl_interfaces_srv_dds__GetParameters_Request_;
using GetParametersResponse = rcl_interfaces_srv_dds__GetParameters_Response_;
using GetParameterTypesRequest = rcl_interfaces_srv_dds__GetParameterTypes_Request_;
using GetParameterTypesResponse = rcl_interfaces_srv_dds__GetParameterTypes_Response_;
using DescribeParametersRequest = rcl_interfaces_srv_dds__DescribeParameters_Request_;
using DescribeParametersResponse = rcl_interfaces_srv_dds__DescribeParameters_Response_;
using ListParametersRequest = rcl_interfaces_srv_dds__ListParameters_Request_;
using ListParametersResponse = rcl_interfaces_srv_dds__ListParameters_Response_;
using SetParametersRequest = rcl_interfaces_srv_dds__SetParameters_Request_;
using SetParametersResponse = rcl_interfaces_srv_dds__SetParameters_Response_;
using SetParametersAtomicallyRequest = rcl_interfaces_srv_dds__SetParametersAtomically_Request_;
using SetParametersAtomicallyResponse = rcl_interfaces_srv_dds__SetParametersAtomically_Response_;
using LifecycleState = lifecycle_msgs_msg_dds__State_;
using TransitionDescription = lifecycle_msgs_msg_dds__TransitionDescription_;
using TransitionEvent = lifecycle_msgs_msg_dds__TransitionEvent_;
using GetStateRequest = lifecycle_msgs_srv_dds__GetState_Request_;
using GetStateResponse = lifecycle_msgs_srv_dds__GetState_Response_;
using ChangeStateRequest = lifecycle_msgs_srv_dds__ChangeState_Request_;
using ChangeStateResponse = lifecycle_msgs_srv_dds__ChangeState_Response_;
using GetAvailableStatesRequest = lifecycle_msgs_srv_dds__GetAvailableStates_Request_;
using GetAvailableStatesResponse = lifecycle_msgs_srv_dds__GetAvailableStates_Response_;
using GetAvailableTransitionsRequest = lifecycle_msgs_srv_dds__GetAvailableTransitions_Request_;
using GetAvailableTransitionsResponse = lifecycle_msgs_srv_dds__GetAvailableTransitions_Response_;
}  // namespace ros

/// What Cyclone DDS has to know of a message that is sent or received as such.
template <class Message>
[[nodiscard]] const dds_topic_descriptor_t& DescriptorOf() noexcept;

// clang-format off
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::PoseWithCovarianceStamped>() noexcept { return geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::TwistWithCovarianceStamped>() noexcept { return geometry_msgs_msg_dds__TwistWithCovarianceStamped__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::Odometry>() noexcept { return nav_msgs_msg_dds__Odometry__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::Path>() noexcept { return nav_msgs_msg_dds__Path__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::TFMessage>() noexcept { return tf2_msgs_msg_dds__TFMessage__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::DiagnosticArray>() noexcept { return diagnostic_msgs_msg_dds__DiagnosticArray__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::PointCloud2>() noexcept { return sensor_msgs_msg_dds__PointCloud2__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::Image>() noexcept { return sensor_msgs_msg_dds__Image__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::CompressedImage>() noexcept { return sensor_msgs_msg_dds__CompressedImage__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::CameraInfo>() noexcept { return sensor_msgs_msg_dds__CameraInfo__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::Marker>() noexcept { return visualization_msgs_msg_dds__Marker__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::TriggerRequest>() noexcept { return std_srvs_srv_dds__Trigger_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::TriggerResponse>() noexcept { return std_srvs_srv_dds__Trigger_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::PointStamped>() noexcept { return geometry_msgs_msg_dds__PointStamped__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ChooseRequest>() noexcept { return disflow_msgs_srv_dds__ChooseObject_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ChooseResponse>() noexcept { return disflow_msgs_srv_dds__ChooseObject_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::QueryRequest>() noexcept { return disflow_msgs_srv_dds__QueryDistanceField_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::QueryResponse>() noexcept { return disflow_msgs_srv_dds__QueryDistanceField_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ParameterEvent>() noexcept { return rcl_interfaces_msg_dds__ParameterEvent__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetParametersRequest>() noexcept { return rcl_interfaces_srv_dds__GetParameters_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetParametersResponse>() noexcept { return rcl_interfaces_srv_dds__GetParameters_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetParameterTypesRequest>() noexcept { return rcl_interfaces_srv_dds__GetParameterTypes_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetParameterTypesResponse>() noexcept { return rcl_interfaces_srv_dds__GetParameterTypes_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::DescribeParametersRequest>() noexcept { return rcl_interfaces_srv_dds__DescribeParameters_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::DescribeParametersResponse>() noexcept { return rcl_interfaces_srv_dds__DescribeParameters_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ListParametersRequest>() noexcept { return rcl_interfaces_srv_dds__ListParameters_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ListParametersResponse>() noexcept { return rcl_interfaces_srv_dds__ListParameters_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::SetParametersRequest>() noexcept { return rcl_interfaces_srv_dds__SetParameters_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::SetParametersResponse>() noexcept { return rcl_interfaces_srv_dds__SetParameters_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::SetParametersAtomicallyRequest>() noexcept { return rcl_interfaces_srv_dds__SetParametersAtomically_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::SetParametersAtomicallyResponse>() noexcept { return rcl_interfaces_srv_dds__SetParametersAtomically_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::TransitionEvent>() noexcept { return lifecycle_msgs_msg_dds__TransitionEvent__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetStateRequest>() noexcept { return lifecycle_msgs_srv_dds__GetState_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetStateResponse>() noexcept { return lifecycle_msgs_srv_dds__GetState_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ChangeStateRequest>() noexcept { return lifecycle_msgs_srv_dds__ChangeState_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::ChangeStateResponse>() noexcept { return lifecycle_msgs_srv_dds__ChangeState_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetAvailableStatesRequest>() noexcept { return lifecycle_msgs_srv_dds__GetAvailableStates_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetAvailableStatesResponse>() noexcept { return lifecycle_msgs_srv_dds__GetAvailableStates_Response__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetAvailableTransitionsRequest>() noexcept { return lifecycle_msgs_srv_dds__GetAvailableTransitions_Request__desc; }
template <> inline const dds_topic_descriptor_t& DescriptorOf<ros::GetAvailableTransitionsResponse>() noexcept { return lifecycle_msgs_srv_dds__GetAvailableTransitions_Response__desc; }
// clang-format on

/// The text as a message points to it. Nobody writes through it: Cyclone DDS's structures are for
/// both directions.
[[nodiscard]] inline char* Lend(const std::string& text) noexcept {
  return const_cast<char*>(text.c_str());
}

/// @param ros_ns Since 1970, not negative.
[[nodiscard]] inline ros::Time RosTime(std::int64_t ros_ns) noexcept {
  return {static_cast<std::int32_t>(ros_ns / 1'000'000'000),
          static_cast<std::uint32_t>(ros_ns % 1'000'000'000)};
}
[[nodiscard]] inline std::int64_t RosNanoseconds(const ros::Time& time) noexcept {
  return std::int64_t{time.sec} * 1'000'000'000 + std::int64_t{time.nanosec};
}

/// A text of a message that was received; a writer may have left it out.
[[nodiscard]] inline std::string_view TextOf(const char* text) noexcept {
  return text == nullptr ? std::string_view() : std::string_view(text);
}

/// The elements as a message's sequence points to them.
template <class Sequence, class Element>
void Lend(std::vector<Element>& elements, Sequence& sequence) noexcept {
  sequence._buffer = elements.data();
  sequence._length = static_cast<std::uint32_t>(elements.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

}  // namespace disflow::posix
