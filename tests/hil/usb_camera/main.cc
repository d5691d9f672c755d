// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A USB depth camera that is a program: uvcvideo on top of vhci_hcd sees a real device.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "usb_camera.h"

namespace {

volatile std::sig_atomic_t stop_requested = 0;

struct Arguments {
  disflow::hil::CameraModelOptions model;
  disflow::hil::FaultPlan faults;
  std::string frames;
  int count = 0;  ///< 0 = all.
  std::string played_file;
};

int Run(const Arguments& arguments) {
  const auto bytes = std::filesystem::file_size(arguments.frames);
  const int all = static_cast<int>(bytes / arguments.model.image_bytes());
  const int count = arguments.count > 0 ? std::min(arguments.count, all) : all;
  disflow::hil::UsbCamera camera(arguments.model, arguments.faults,
                                 std::ifstream(arguments.frames, std::ios::binary), count);
  camera.Attach();
  bool said = false;
  while (stop_requested == 0) {
    camera.Step();
    if (said || !camera.finished()) continue;
    said = true;
    std::ofstream(arguments.played_file) << camera.played() << '\n';
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  std::vector<std::string> faults;
  CLI::App app("A USB depth camera that plays raw images; wants root and the module vhci_hcd.");
  app.add_option("FRAMES", arguments.frames, "Raw images, one after the other")->required();
  app.add_option("--count", arguments.count, "Images to play [all]");
  app.add_option("--format", arguments.model.format, "Z16, INZI, Y16, Y12 or YUYV");
  app.add_option("--width", arguments.model.width_px);
  app.add_option("--height", arguments.model.height_px);
  app.add_option("--fps", arguments.model.rate_hz);
  app.add_option("--serial", arguments.model.serial);
  app.add_option("--vendor", arguments.model.vendor_id);
  app.add_option("--product", arguments.model.product_id);
  app.add_option("--attach", arguments.model.attach_file, "vhci_hcd's file of that name");
  app.add_option("--fault", faults, "FRAME:error, short, garbage, stall=MS or detach=MS");
  app.add_option("--played", arguments.played_file, "File to write when all has been sent");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& fault : faults) {
    if (!disflow::hil::AddFault(fault, arguments.faults)) {
      std::fprintf(stderr, "usb_camera: '%s' is no fault\n", fault.c_str());
      return 2;
    }
  }
  if (!disflow::hil::KnowsFormat(arguments.model.format)) {
    std::fprintf(stderr, "usb_camera: unknown format %s\n", arguments.model.format.c_str());
    return 2;
  }
  const auto stop = [](int) { stop_requested = 1; };
  (void)std::signal(SIGTERM, stop);
  (void)std::signal(SIGINT, stop);
  try {
    return Run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usb_camera: %s\n", error.what());
    return 1;
  }
}
