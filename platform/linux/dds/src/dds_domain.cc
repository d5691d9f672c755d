// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/dds/dds_domain.h"

#include <arpa/inet.h>
#include <sys/mman.h>

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

std::string_view WithoutLineFeed(std::string_view text) noexcept {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  return text;
}

void KeepMessage(void* kept, const dds_log_data_t* data) {
  const std::string_view text = WithoutLineFeed({data->message, data->size});
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
  // Its security plugins end their lines with nothing.
  const std::string_view text = WithoutLineFeed({data->message, data->size});
  std::fprintf(stderr, "Cyclone DDS: %.*s\n", static_cast<int>(text.size()), text.data());
  if (before == 1) std::fputs("Cyclone DDS: what it has to say further is left out\n", stderr);
}

/// Cyclone DDS ends the program without a word when it gets no memory.
hal::Fault CheckMemory(const DdsNetwork& network) {
  // Stacks and heaps of its threads; address space, of which it uses a small part.
  constexpr std::size_t kNeeded_bytes = std::size_t{192} << 20U;
  void* const room =
      ::mmap(nullptr, kNeeded_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room != MAP_FAILED) {
    (void)::munmap(room, kNeeded_bytes);
    return {};
  }
  return hal::MakeFault(Status::kIoError,
                        "dds: domain %u cannot be opened: the %zu MB of address space that Cyclone "
                        "DDS needs are not there; allow more (ulimit -v)",
                        static_cast<unsigned>(network.domain), kNeeded_bytes >> 20U);
}

}  // namespace

hal::Fault OpenDomain(const DdsNetwork& network, DdsEntity& domain) {
  const hal::Fault fault = CheckMemory(network);
  if (!fault.ok()) return fault;
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
