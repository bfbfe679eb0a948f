#pragma once

#include <string_view>

#include "common/base/status.h"
#include "common/image/decode.h"
#include "common/image/image.h"

// The three decoders behind DecodeImage(); no other folder includes this. Each reads the header without touching
// pixels, and decodes only what a checked header has allowed.
namespace fitroom::codecs {

Result<ImageHeader> ReadJpegHeader(std::string_view bytes);
Result<ImageHeader> ReadPngHeader(std::string_view bytes);
Result<ImageHeader> ReadWebpHeader(std::string_view bytes);

Result<Image> DecodeJpeg(std::string_view bytes, const ImageHeader& header);
Result<Image> DecodePng(std::string_view bytes, const ImageHeader& header);
Result<Image> DecodeWebp(std::string_view bytes, const ImageHeader& header);

// Returns the EXIF orientation (1 to 8) in the payload of an APP1 segment; 1 if there is none or it is damaged.
int ReadExifOrientation(std::string_view app1_payload);

}  // namespace fitroom::codecs
