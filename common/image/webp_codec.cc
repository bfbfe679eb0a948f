#include <webp/decode.h>

#include <string>

#include "common/image/codecs.h"

namespace fitroom::codecs {
namespace {

const uint8_t* Data(std::string_view bytes) { return reinterpret_cast<const uint8_t*>(bytes.data()); }

Status WebpError(VP8StatusCode code) {
  if (code == VP8_STATUS_NOT_ENOUGH_DATA) {
    return DataLoss("IMAGE_TRUNCATED", "the WebP file ends too early; send the whole file");
  }
  return InvalidArgument("IMAGE_CORRUPT", "the WebP file is damaged (libwebp status " +
                                              std::to_string(static_cast<int>(code)) + "); save it again");
}

}  // namespace

Result<ImageHeader> ReadWebpHeader(std::string_view bytes) {
  WebPBitstreamFeatures features;
  const VP8StatusCode code = WebPGetFeatures(Data(bytes), bytes.size(), &features);
  if (code != VP8_STATUS_OK) return WebpError(code);
  if (features.has_animation != 0) {
    return InvalidArgument("IMAGE_ANIMATED", "the WebP file is an animation; give one still photograph");
  }
  ImageHeader header;
  header.format = ImageFormat::kWebp;
  header.width = features.width;
  header.height = features.height;
  header.channels = features.has_alpha != 0 ? 4 : 3;
  return header;
}

Result<Image> DecodeWebp(std::string_view bytes, const ImageHeader& header) {
  WebPDecoderConfig config;
  if (WebPInitDecoderConfig(&config) == 0)
    return Internal("WEBP_VERSION_MISMATCH", "libwebp does not match its header");
  Image image = MakeImage(header.width, header.height, header.channels);
  config.output.colorspace = header.channels == 4 ? MODE_RGBA : MODE_RGB;
  config.output.is_external_memory = 1;
  config.output.u.RGBA.rgba = image.pixels.data();
  config.output.u.RGBA.stride = header.width * header.channels;
  config.output.u.RGBA.size = image.pixels.size();
  const VP8StatusCode code = WebPDecode(Data(bytes), bytes.size(), &config);
  WebPFreeDecBuffer(&config.output);
  if (code != VP8_STATUS_OK) return WebpError(code);
  return image;
}

}  // namespace fitroom::codecs
