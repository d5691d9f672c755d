// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/mavlink/disflow_messages.h"
#include "disflow/hal/mavlink/standard_messages.h"
#include "disflow/hal/mavlink/target_messages.h"

/// @file
/// The MAVLink messages that DisFlow speaks, field by field. docs/wire-format.md explains their
/// meaning and frames; docs/disflow.xml defines the private ones, DISFLOW_….
///
/// Every message lists its fields once, in wire order (base fields by falling size, then
/// extensions); payload size, checksum seed, encoder and decoder are all derived from that list.

namespace disflow::hal::mavlink {

template <class... Messages>
struct MessageList {};

/// Every message that there is: no other is recognised by FrameDecoder or taken by EncodeFrame()
/// and DecodePayload(), so that one that is left out here does not compile.
using KnownMessages = MessageList<Heartbeat, Odometry, DisflowStatus, DisflowReady, DisflowTiming,
                                  DisflowQuery, DisflowField, CommandLong, CommandAck, SystemTime,
                                  TimeSyncMessage, LandingTarget, FollowTarget, GpsGlobalOrigin>;

}  // namespace disflow::hal::mavlink
