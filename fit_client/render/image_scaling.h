#pragma once

#include "common/image/image.h"

namespace fitroom::render {

// Returns the image at half its width and height (rounded down, at least 1), each pixel the mean of four.
Image HalveImage(const Image& image);

}  // namespace fitroom::render
