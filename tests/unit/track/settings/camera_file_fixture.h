// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "refusal.h"
#include "scratch_folder.h"
#include "settings/camera_file.h"

namespace disflow::apps {

/// Camera files of one name, which says their format.
class CameraFileFixture : public test::ScratchFolderTest {
 protected:
  explicit CameraFileFixture(const char* name) : name_(name) {}

  [[nodiscard]] posix::CameraDescription Read(const std::string& text,
                                              bool rectified = false) const {
    test::WriteFile(Path(name_), text);
    return ReadCameraFile(Path(name_), rectified);
  }
  [[nodiscard]] std::string Refusal(const std::string& text, bool rectified = false) const {
    return RefusalOf([&] { (void)Read(text, rectified); });
  }

 private:
  const char* name_;
};

}  // namespace disflow::apps
