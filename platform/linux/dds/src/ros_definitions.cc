// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/ros_cdr.h"

/// @file
/// Definitions of messages as ROS 2 has them since Humble, without their comments: every type that
/// is used follows behind a line of its name.

// clang-format off
#define DISFLOW_TYPE(name) \
  "================================================================================\n" \
  "MSG: " name "\n"
#define DISFLOW_HEADER \
  DISFLOW_TYPE("std_msgs/Header") "builtin_interfaces/Time stamp\nstring frame_id\n" \
  DISFLOW_TYPE("builtin_interfaces/Time") "int32 sec\nuint32 nanosec\n"
#define DISFLOW_VECTOR3 DISFLOW_TYPE("geometry_msgs/Vector3") "float64 x\nfloat64 y\nfloat64 z\n"
#define DISFLOW_QUATERNION \
  DISFLOW_TYPE("geometry_msgs/Quaternion") "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"
// clang-format on

namespace disflow::posix {

// clang-format off
template <>
RosType RosTypeOf<ros::Image>() noexcept {
  return {"sensor_msgs/msg/Image",
          "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\n"
          "uint8 is_bigendian\nuint32 step\nuint8[] data\n"
          DISFLOW_HEADER};
}

template <>
RosType RosTypeOf<ros::CameraInfo>() noexcept {
  return {"sensor_msgs/msg/CameraInfo",
          "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
          "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\n"
          "uint32 binning_x\nuint32 binning_y\nsensor_msgs/RegionOfInterest roi\n"
          DISFLOW_TYPE("sensor_msgs/RegionOfInterest")
          "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"
          DISFLOW_HEADER};
}

template <>
RosType RosTypeOf<ros::Odometry>() noexcept {
  return {"nav_msgs/msg/Odometry",
          "std_msgs/Header header\nstring child_frame_id\n"
          "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n"
          DISFLOW_TYPE("geometry_msgs/PoseWithCovariance")
          "geometry_msgs/Pose pose\nfloat64[36] covariance\n"
          DISFLOW_TYPE("geometry_msgs/Pose")
          "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
          DISFLOW_TYPE("geometry_msgs/Point") "float64 x\nfloat64 y\nfloat64 z\n"
          DISFLOW_TYPE("geometry_msgs/TwistWithCovariance")
          "geometry_msgs/Twist twist\nfloat64[36] covariance\n"
          DISFLOW_TYPE("geometry_msgs/Twist")
          "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"
          DISFLOW_VECTOR3 DISFLOW_QUATERNION DISFLOW_HEADER};
}

template <>
RosType RosTypeOf<ros::TFMessage>() noexcept {
  return {"tf2_msgs/msg/TFMessage",
          "geometry_msgs/TransformStamped[] transforms\n"
          DISFLOW_TYPE("geometry_msgs/TransformStamped")
          "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"
          DISFLOW_TYPE("geometry_msgs/Transform")
          "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"
          DISFLOW_VECTOR3 DISFLOW_QUATERNION DISFLOW_HEADER};
}

template <>
RosType RosTypeOf<ros::PointCloud2>() noexcept {
  return {"sensor_msgs/msg/PointCloud2",
          "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
          "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"
          DISFLOW_TYPE("sensor_msgs/PointField")
          "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\n"
          "uint8 INT32=5\nuint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\n"
          "string name\nuint32 offset\nuint8 datatype\nuint32 count\n"
          DISFLOW_HEADER};
}

template <>
RosType RosTypeOf<ros::DiagnosticArray>() noexcept {
  return {"diagnostic_msgs/msg/DiagnosticArray",
          "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"
          DISFLOW_TYPE("diagnostic_msgs/DiagnosticStatus")
          "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
          "byte level\nstring name\nstring message\nstring hardware_id\n"
          "diagnostic_msgs/KeyValue[] values\n"
          DISFLOW_TYPE("diagnostic_msgs/KeyValue") "string key\nstring value\n"
          DISFLOW_HEADER};
}
// clang-format on

}  // namespace disflow::posix
