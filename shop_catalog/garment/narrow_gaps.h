#pragma once

#include <opencv2/core.hpp>

namespace fitroom::shop_catalog {

// Opens narrow gaps of background that a coverage image (CV_8U, 255 = garment) has closed: between legs that nearly
// touch, between a sleeve and the body. From where the gap is still seen, the background is followed into it by its
// colour, as long as that is nearer to the background's than to the garment's. `height` is the garment's (unit: pixel);
// a gap is followed into the mask for at most `max_depth` of it.
cv::Mat OpenNarrowGaps(const cv::Mat& rgb, const cv::Mat& coverage, double height, double max_depth);

}  // namespace fitroom::shop_catalog
