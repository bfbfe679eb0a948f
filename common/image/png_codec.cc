#include <png.h>

#include <cstring>
#include <string>

#include "common/base/check.h"
#include "common/image/codecs.h"
#include "common/image/encode.h"

// libpng's simplified interface is used throughout: it keeps its longjmp inside the library, so no C++ object of ours
// is ever jumped over, and it skips text and profile chunks instead of inflating them.
namespace fitroom {
namespace {

// Owns libpng's reader and frees it on every path.
class PngReader {
 public:
  PngReader() {
    std::memset(&image_, 0, sizeof image_);
    image_.version = PNG_IMAGE_VERSION;
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_image_free(&image_); }

  Status Begin(std::string_view bytes) {
    if (png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size()) == 0) return Error();
    // 16-bit samples without a gamma chunk are sRGB like all others, not linear light.
    image_.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    return {};
  }

  // Expands everything to 8 bits with 1, 3 or 4 channels.
  Status Finish(int channels, Image& image) {
    image_.format = channels == 1 ? PNG_FORMAT_GRAY : channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    const png_int_32 row_stride = 0;
    if (png_image_finish_read(&image_, nullptr, image.pixels.data(), row_stride, nullptr) == 0) return Error();
    return {};
  }

  int width() const { return static_cast<int>(image_.width); }
  int height() const { return static_cast<int>(image_.height); }
  int channels() const {
    if ((image_.format & PNG_FORMAT_FLAG_ALPHA) != 0) return 4;
    return (image_.format & PNG_FORMAT_FLAG_COLOR) != 0 ? 3 : 1;
  }

 private:
  Status Error() const {
    const std::string message = image_.message;
    if (message.find("read beyond end") != std::string::npos || message.find("Not enough") != std::string::npos) {
      return DataLoss("IMAGE_TRUNCATED", "the PNG file ends too early; send the whole file");
    }
    return InvalidArgument("IMAGE_CORRUPT", "the PNG file is damaged (" + message + "); save it again");
  }

  png_image image_;
};

}  // namespace

namespace codecs {

Result<ImageHeader> ReadPngHeader(std::string_view bytes) {
  // IHDR is the first chunk of every PNG: refusing by its sides costs nothing, before libpng looks at any other chunk.
  if (bytes.size() < 33) return DataLoss("IMAGE_TRUNCATED", "the PNG file ends in its header; send the whole file");
  PngReader reader;
  FR_RETURN_IF_ERROR(reader.Begin(bytes));
  ImageHeader header;
  header.format = ImageFormat::kPng;
  header.width = reader.width();
  header.height = reader.height();
  header.channels = reader.channels();
  return header;
}

Result<Image> DecodePng(std::string_view bytes, const ImageHeader& header) {
  PngReader reader;
  FR_RETURN_IF_ERROR(reader.Begin(bytes));
  Image image = MakeImage(header.width, header.height, header.channels);
  FR_RETURN_IF_ERROR(reader.Finish(header.channels, image));
  return image;
}

}  // namespace codecs

namespace {

struct PngSink {
  std::string bytes;
};

void AppendToSink(png_structp png, png_bytep data, png_size_t size) {
  static_cast<PngSink*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), size);
}
void FlushSink(png_structp) {}

// Writes all rows; the only frame that libpng's longjmp may leave, and it holds no C++ object.
bool WriteRows(png_structp png, png_infop png_info, const Image& image, PngSink* sink) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  const int colour = image.channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : image.channels == 3 ? PNG_COLOR_TYPE_RGB
                                           : PNG_COLOR_TYPE_RGB_ALPHA;
  png_set_write_fn(png, sink, AppendToSink, FlushSink);
  png_set_IHDR(png, png_info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8, colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 2);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, image.channels == 1 ? PNG_FILTER_NONE : PNG_FILTER_UP | PNG_FILTER_SUB);
  png_write_info(png, png_info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.at(0, y));
  png_write_end(png, png_info);
  return true;
}

}  // namespace

std::string EncodePng(const Image& image) {
  FR_CHECK(IsValid(image));
  PngSink sink;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  FR_CHECK(png != nullptr);
  png_infop png_info = png_create_info_struct(png);
  FR_CHECK(png_info != nullptr);
  const bool written = WriteRows(png, png_info, image, &sink);
  png_destroy_write_struct(&png, &png_info);
  FR_CHECK(written);  // A valid image and a sink in memory: only exhausted memory is left as a cause.
  return std::move(sink.bytes);
}

}  // namespace fitroom
