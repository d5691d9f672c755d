// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/calib3d.hpp>

#include "semi_global_matcher.h"

extern "C" void disflow_match_semi_globally(const disflow::host::SemiGlobalSettings* settings,
                                            const std::uint8_t* left, const std::uint8_t* right,
                                            int width_px, int height_px,
                                            std::int16_t* disparity_16ths) {
  static_assert(disflow::host::kDisparitySteps == cv::StereoMatcher::DISP_SCALE);
  const auto matcher = cv::StereoSGBM::create(
      settings->min_disparity, settings->num_disparities, settings->block_size, settings->p1,
      settings->p2, settings->disp12_max_diff, settings->pre_filter_cap, settings->uniqueness_ratio,
      settings->speckle_window_size, settings->speckle_range, cv::StereoSGBM::MODE_SGBM);
  // OpenCV has no images of constant pixels; it does not write to these.
  const cv::Mat left_image(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(left));
  const cv::Mat right_image(height_px, width_px, CV_8U, const_cast<std::uint8_t*>(right));
  cv::Mat disparity(height_px, width_px, CV_16S, disparity_16ths);
  matcher->compute(left_image, right_image, disparity);
}
