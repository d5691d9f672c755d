// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "disflow/posix/dds/ros_messages.h"
#include "file_in_memory.h"

namespace disflow::fuzz {

/// Another participant's end of a DDS topic, who sends what bytes he likes. They are in the readers
/// of this process when the call returns, taken apart by Cyclone DDS as if they had come over the
/// network.
class RawWriter {
 public:
  /// @param topic Of DDS.
  template <class Message>
  static RawWriter Of(dds_entity_t participant, const std::string& topic) {
    const dds_entity_t entity = TopicOf<Message>(participant, topic);
    // Listeners of every kind take what such a writer has.
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t writer = dds_create_writer(participant, entity, qos, nullptr);
    dds_delete_qos(qos);
    const dds_entity_t reader = dds_create_reader(participant, entity, nullptr, nullptr);
    Require(writer > 0 && reader > 0);
    // Only a message knows how Cyclone DDS names its type to itself.
    const Message none{};
    Require(dds_write(writer, &none) == DDS_RETCODE_OK);
    ddsi_serdata* message = nullptr;
    dds_sample_info_t info;
    Require(dds_takecdr(reader, &message, 1, &info, DDS_ANY_STATE) == 1);
    Require(dds_delete(reader) == DDS_RETCODE_OK);
    return RawWriter(writer, message);
  }

  template <class Message>
  static dds_entity_t TopicOf(dds_entity_t participant, const std::string& topic) {
    const dds_entity_t entity = dds_create_topic(participant, &posix::DescriptorOf<Message>(),
                                                 topic.c_str(), nullptr, nullptr);
    Require(entity > 0);
    return entity;
  }

  /// A message as it should be.
  template <class Message>
  void Send(const Message& message) const {
    Require(dds_write(writer_, &message) == DDS_RETCODE_OK);
  }
  /// @return false if Cyclone DDS refused the bytes.
  bool Write(bool is_big_endian, const std::vector<std::uint8_t>& body) const {
    std::vector<std::uint8_t> bytes = {0, static_cast<std::uint8_t>(is_big_endian ? 0 : 1), 0, 0};
    bytes.insert(bytes.end(), body.begin(), body.end());
    const ddsrt_iovec_t piece = {bytes.data(), bytes.size()};
    ddsi_serdata* const message =
        ddsi_serdata_from_ser_iov(model_->type, SDK_DATA, 1, &piece, bytes.size());
    if (message == nullptr) return false;
    message->timestamp = model_->timestamp;
    Require(dds_writecdr(writer_, message) == DDS_RETCODE_OK);
    return true;
  }

 private:
  RawWriter(dds_entity_t writer, ddsi_serdata* model)
      : writer_(writer), model_(model, [](ddsi_serdata* last) { ddsi_serdata_unref(last); }) {}

  dds_entity_t writer_;
  std::shared_ptr<ddsi_serdata> model_;  ///< A message of the same type.
};

}  // namespace disflow::fuzz
