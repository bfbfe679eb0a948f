#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "common/image/image.h"

namespace fitroom::render {

// How a label is written. Letters are as high as `height`, 0.8 of it apart.
struct LabelStyle {
  double height = 14.0;       // Of a capital (unit: pixel).
  double stroke_width = 1.8;  // (unit: pixel)
  std::array<uint8_t, 3> colour = {60, 62, 66};
};

// Returns how wide a label is (unit: pixel).
double MeasureLabel(std::string_view text, const LabelStyle& style = {});

// Writes `text` in strokes of our own: capitals, digits and . - / : ( ) % + . Small letters are written as capitals,
// anything else as a space. (x, y) is the top left corner of the first letter; what falls outside is left out.
void DrawLabel(Image& image, std::string_view text, double x, double y, const LabelStyle& style = {});

}  // namespace fitroom::render
