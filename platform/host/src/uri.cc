// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/uri.h"

#include <algorithm>

namespace disflow::host {
namespace {

hal::Fault ParseQuery(std::string_view text, Uri& uri) {
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const std::size_t equals = item.find('=');
    if (equals == 0 || equals == std::string_view::npos) {
      return hal::MakeFault(Status::kInvalidUri, "'%.*s' is not key=value",
                            static_cast<int>(item.size()), item.data());
    }
    const std::string key(item.substr(0, equals));
    const auto same_key = [&key](const auto& entry) { return entry.first == key; };
    if (std::any_of(uri.query.begin(), uri.query.end(), same_key)) {
      return hal::MakeFault(Status::kInvalidUri, "%s is given twice", key.c_str());
    }
    uri.query.emplace_back(key, item.substr(equals + 1));
  }
  return {};
}

}  // namespace

hal::Fault ParseUri(std::string_view text, Uri& uri) {
  const std::size_t colon = text.find(':');
  const std::size_t question = std::min(text.find('?'), text.size());
  if (colon == 0 || colon >= question || colon + 1 == question) {
    return hal::MakeFault(Status::kInvalidUri,
                          "'%.*s' is no sensor address; scheme:path?key=value is needed, e.g. "
                          "sim:bottle?motion=fast",
                          static_cast<int>(text.size()), text.data());
  }
  Uri parsed;
  parsed.scheme = text.substr(0, colon);
  parsed.path = text.substr(colon + 1, question - colon - 1);
  if (question < text.size()) {
    const hal::Fault fault = ParseQuery(text.substr(question + 1), parsed);
    if (!fault.ok()) return fault;
  }
  uri = std::move(parsed);
  return {};
}

}  // namespace disflow::host
