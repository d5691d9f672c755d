// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/dds_domain.h"

#include <arpa/inet.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <string_view>

namespace disflow::posix {
namespace {

bool IsAddress(const std::string& text) noexcept {
  in6_addr any;
  return inet_pton(AF_INET, text.c_str(), &any) == 1 ||
         inet_pton(AF_INET6, text.c_str(), &any) == 1;
}

/// Cyclone DDS's configuration for what was asked for; later parts win over earlier ones.
std::string Configuration(const DdsNetwork& network) {
  std::string text;
  if (const char* const given = std::getenv("CYCLONEDDS_URI"); given != nullptr) text = given;
  if (network.interface.empty() && network.peers.empty()) return text;
  if (!text.empty()) text += ',';
  text += "<CycloneDDS><Domain>";
  if (!network.interface.empty()) {
    const char* const kind = IsAddress(network.interface) ? "address" : "name";
    text.append("<General><Interfaces><NetworkInterface ")
        .append(kind)
        .append("=\"")
        .append(network.interface)
        .append("\"/></Interfaces></General>");
  }
  if (!network.peers.empty()) {
    // The peers can guess the port of a numbered participant.
    text += "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers>";
    for (const std::string& peer : network.peers) text += "<Peer address=\"" + peer + "\"/>";
    text += "</Peers></Discovery>";
  }
  return text + "</Domain></CycloneDDS>";
}

/// What Cyclone DDS would have logged; the threads of another domain may speak at the same time.
struct LastWords {
  std::mutex mutex;
  std::string text;
};

void KeepMessage(void* kept, const dds_log_data_t* data) {
  std::string_view text(data->message, data->size);
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  auto& words = *static_cast<LastWords*>(kept);
  const std::lock_guard lock(words.mutex);
  words.text.assign(text);
}

/// Cyclone DDS logs every message that it cannot read: whoever sends many must not fill the log.
void SayTheFirst(void*, const dds_log_data_t* data) {
  constexpr int kMost = 20;
  static std::atomic<int> left = kMost;
  const int before = left.load() > 0 ? left.fetch_sub(1) : 0;
  if (before <= 0) return;
  std::fprintf(stderr, "%.*s", static_cast<int>(data->size), data->message);
  if (before == 1) std::fputs("Cyclone DDS: what it has to say further is left out\n", stderr);
}

}  // namespace

hal::Fault OpenDomain(const DdsNetwork& network, DdsEntity& domain) {
  LastWords reason;
  dds_set_log_sink(KeepMessage, &reason);
  const dds_entity_t handle = dds_create_domain(network.domain, Configuration(network).c_str());
  dds_set_log_sink(SayTheFirst, nullptr);
  if (handle < 0) {
    return hal::MakeFault(Status::kIoError, "dds: domain %u cannot be opened: %s",
                          static_cast<unsigned>(network.domain),
                          reason.text.empty() ? dds_strretcode(handle) : reason.text.c_str());
  }
  domain = DdsEntity(handle);
  return {};
}

}  // namespace disflow::posix
