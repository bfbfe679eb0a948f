#include "common/image/decode.h"

#include <string>

#include "common/base/check.h"
#include "common/image/codecs.h"

namespace fitroom {
namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kJpegSignature("\xff\xd8\xff", 3);

Result<ImageFormat> DetectFormat(std::string_view bytes) {
  if (bytes.starts_with(kPngSignature)) return ImageFormat::kPng;
  if (bytes.starts_with(kJpegSignature)) return ImageFormat::kJpeg;
  if (bytes.size() >= 12 && bytes.starts_with("RIFF") && bytes.substr(8, 4) == "WEBP") return ImageFormat::kWebp;
  return InvalidArgument("IMAGE_FORMAT_UNKNOWN",
                         "the file is not a JPEG, PNG or WebP image; convert it to one of these");
}

Result<ImageHeader> ReadHeaderOf(ImageFormat format, std::string_view bytes) {
  switch (format) {
    case ImageFormat::kJpeg:
      return codecs::ReadJpegHeader(bytes);
    case ImageFormat::kPng:
      return codecs::ReadPngHeader(bytes);
    case ImageFormat::kWebp:
      return codecs::ReadWebpHeader(bytes);
  }
  return Internal("IMAGE_FORMAT_UNHANDLED", "no reader for this image format");
}

std::string SizeText(const ImageHeader& header) {
  return std::to_string(header.width) + " x " + std::to_string(header.height);
}

}  // namespace

std::string_view ImageFormatExtension(ImageFormat format) {
  switch (format) {
    case ImageFormat::kJpeg:
      return "jpg";
    case ImageFormat::kPng:
      return "png";
    case ImageFormat::kWebp:
      return "webp";
  }
  return "";
}

Result<ImageHeader> ReadImageHeader(std::string_view bytes, const ImageLimits& limits) {
  if (bytes.size() > limits.max_bytes) {
    return ResourceExhausted("IMAGE_FILE_TOO_LARGE", "the image file has " + std::to_string(bytes.size()) +
                                                         " bytes, allowed are " + std::to_string(limits.max_bytes) +
                                                         "; save it smaller");
  }
  FR_ASSIGN_OR_RETURN(const ImageFormat format, DetectFormat(bytes));
  FR_ASSIGN_OR_RETURN(const ImageHeader header, ReadHeaderOf(format, bytes));
  if (header.width <= 0 || header.height <= 0) {
    return InvalidArgument("IMAGE_CORRUPT", "the image's header says " + SizeText(header) + " pixels");
  }
  if (static_cast<int64_t>(header.width) * header.height > limits.max_pixels) {
    return ResourceExhausted("IMAGE_TOO_LARGE", "the image has " + SizeText(header) + " pixels, allowed are " +
                                                    std::to_string(limits.max_pixels) + "; scale it down");
  }
  if (header.width < limits.min_side || header.height < limits.min_side) {
    return InvalidArgument("IMAGE_TOO_SMALL", "the image has " + SizeText(header) + " pixels, at least " +
                                                  std::to_string(limits.min_side) +
                                                  " a side are needed; give a larger photograph");
  }
  return header;
}

Result<Image> DecodeImage(std::string_view bytes, const ImageLimits& limits) {
  FR_ASSIGN_OR_RETURN(const ImageHeader header, ReadImageHeader(bytes, limits));
  Result<Image> image = Internal("IMAGE_FORMAT_UNHANDLED", "no decoder for this image format");
  switch (header.format) {
    case ImageFormat::kJpeg:
      image = codecs::DecodeJpeg(bytes, header);
      break;
    case ImageFormat::kPng:
      image = codecs::DecodePng(bytes, header);
      break;
    case ImageFormat::kWebp:
      image = codecs::DecodeWebp(bytes, header);
      break;
  }
  if (image.ok()) FR_CHECK(IsValid(*image) && image->width == header.width && image->height == header.height);
  return image;
}

}  // namespace fitroom
