#pragma once

#include <cstdint>
#include <string>

#include "common/image/image.h"

// PNG files of kinds that EncodePng() never writes, made with libpng's full interface.
namespace fitroom::testing {

enum class PngKind { kGrey1, kGrey16, kRgb16, kPalette4, kPaletteWithAlpha, kRgbInterlaced, kGreyAlpha };

struct PngCase {
  std::string bytes;
  Image expected;  // What a decoder to 8 bits must give.
};

PngCase WritePngCase(PngKind kind);

// A valid signature, IHDR of that size and an IDAT of a few bytes; nothing else.
std::string PngHeaderOnly(uint32_t width, uint32_t height, int bit_depth, int colour_type);

}  // namespace fitroom::testing
