// SPDX-License-Identifier: BSD-3-Clause
#include "settings/settings_text.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "settings/refusal.h"

namespace disflow::apps {

std::string ReadSettingsText(const std::string& file) {
  constexpr std::size_t kMaxBytes = 1 << 18;
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  // One more, to see that there are more.
  std::string text(kMaxBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof() && stream.fail())
    Refuse(file + ": ", std::string("cannot be read: ") + std::strerror(errno));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kMaxBytes)
    Refuse(file + ": ", "is longer than the " + std::to_string(kMaxBytes) + " bytes of settings");
  return text;
}

}  // namespace disflow::apps
