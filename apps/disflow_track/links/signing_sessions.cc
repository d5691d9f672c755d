// SPDX-License-Identifier: BSD-3-Clause
#include "links/signing_sessions.h"

#include <algorithm>
#include <utility>

#include "disflow/hal/secret.h"
#include "disflow/posix/signing_key_file.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

using hal::mavlink::kSigningMinute;
using hal::mavlink::SigningKey;
using hal::mavlink::SigningSession;
using hal::mavlink::SigningTime;

/// Well within the minute that the specification asks for.
constexpr SigningTime kKeepEvery = kSigningMinute / 6;

}  // namespace

SigningSessions::~SigningSessions() {
  for (Entry& entry : entries_) Keep(entry);
}

SigningSession& SigningSessions::Open(const std::string& key_file) {
  SigningKey key{};
  Require(posix::ReadSigningKey(key_file, key), kWrongUsage);
  const auto same = std::find_if(entries_.begin(), entries_.end(),
                                 [&key](const Entry& entry) { return entry.session.HasKey(key); });
  SigningSession& session = same != entries_.end() ? same->session : Add(key, key_file).session;
  hal::Wipe(key);
  return session;
}

SigningSessions::Entry& SigningSessions::Add(const SigningKey& key, const std::string& key_file) {
  const std::string time_path = key_file + ".time";
  posix::SigningTimeFile time_file;
  const hal::Fault fault = time_file.Open(time_path);
  const SigningTime now = posix::SigningTimeNow();
  const SigningTime kept = time_file.Load();
  if (!fault.ok()) {
    console_.Say(std::string(fault.message) +
                 "; after a restart signatures are newer only if the system's clock is right");
  }
  // Clocks of peers may be a little ahead.
  if (kept > now + kSigningMinute) {
    console_.Say(time_path + ": the system's clock is " +
                 std::to_string((kept - now) / kSigningMinute) +
                 " min behind the last signature; signing goes on from there");
  }
  Entry& entry = entries_.emplace_back(key, std::max(now, kept), own_system_id_);
  entry.time_path = time_path;
  entry.time_file = std::move(time_file);
  entry.is_kept = fault.ok();
  Keep(entry);
  return entry;
}

void SigningSessions::Advance() noexcept {
  if (entries_.empty()) return;
  const SigningTime now = posix::SigningTimeNow();
  for (Entry& entry : entries_) {
    entry.session.AdvanceTo(now);
    if (entry.session.time() - entry.kept >= kKeepEvery) Keep(entry);
  }
}

void SigningSessions::Keep(Entry& entry) noexcept {
  if (!entry.is_kept) return;
  entry.kept = entry.session.time();
  if (entry.time_file.Save(entry.kept)) return;
  entry.is_kept = false;
  console_.Say(entry.time_path + ": cannot keep the signing time; is the disk full?");
}

}  // namespace disflow::apps
