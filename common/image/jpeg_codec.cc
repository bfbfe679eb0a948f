#include <cstdio>  // jpeglib.h needs FILE and size_t declared before it.

#include <jpeglib.h>

#include <jerror.h>

#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <string>

#include "common/base/check.h"
#include "common/image/codecs.h"
#include "common/image/encode.h"

namespace fitroom {
namespace {

// A progressive file may hold thousands of scans over all pixels; real ones hold about ten.
constexpr int kMaxScans = 100;

// libjpeg's state with an error handler that jumps back instead of ending the process. Everything here is plain data:
// a longjmp skips no destructor.
struct JpegSession {
  jpeg_decompress_struct decoder;
  jpeg_error_mgr errors;
  jpeg_progress_mgr progress;
  jmp_buf on_error;
  char message[JMSG_LENGTH_MAX];
  bool truncated;
};

JpegSession* SessionOf(j_common_ptr common) { return static_cast<JpegSession*>(common->client_data); }

[[noreturn]] void FailHard(j_common_ptr common) {
  JpegSession* session = SessionOf(common);
  (*common->err->format_message)(common, session->message);
  std::longjmp(session->on_error, 1);
}

// libjpeg only warns where data is missing or cannot be decoded, and paints the rest grey; here that is an error.
void OnMessage(j_common_ptr common, int level) {
  if (level >= 0) return;  // Trace.
  const int code = common->err->msg_code;
  if (code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR) return;  // Harmless.
  SessionOf(common)->truncated = code == JWRN_JPEG_EOF;
  FailHard(common);
}

void OnProgress(j_common_ptr common) {
  JpegSession* session = SessionOf(common);
  if (session->decoder.input_scan_number <= kMaxScans) return;
  std::strcpy(session->message, "too many progressive scans");
  std::longjmp(session->on_error, 1);
}

// Owns a session; frees libjpeg's memory on every path.
class JpegReader {
 public:
  JpegReader() : session_(new JpegSession) {
    std::memset(session_, 0, sizeof *session_);
    session_->decoder.err = jpeg_std_error(&session_->errors);
    session_->decoder.client_data = session_;
    session_->errors.error_exit = FailHard;
    session_->errors.emit_message = OnMessage;
    session_->errors.output_message = [](j_common_ptr) {};
    session_->progress.progress_monitor = OnProgress;
    if (setjmp(session_->on_error) == 0) {
      jpeg_create_decompress(&session_->decoder);
      session_->decoder.progress = &session_->progress;
      created_ = true;
    }
  }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;
  ~JpegReader() {
    jpeg_destroy_decompress(&session_->decoder);
    delete session_;
  }

  JpegSession* session() { return session_; }

  Status Error() const {
    if (session_->truncated) return DataLoss("IMAGE_TRUNCATED", "the JPEG file ends too early; send the whole file");
    return InvalidArgument("IMAGE_CORRUPT",
                           std::string("the JPEG file is damaged (") + session_->message + "); save it again");
  }

  bool created() const { return created_; }

 private:
  JpegSession* session_;
  bool created_ = false;
};

// The next two hold no C++ object with a destructor: libjpeg may jump out of them.
bool ReadHeaderRaw(JpegSession* session, const unsigned char* data, size_t size) {
  if (setjmp(session->on_error) != 0) return false;
  jpeg_mem_src(&session->decoder, data, static_cast<unsigned long>(size));
  jpeg_save_markers(&session->decoder, JPEG_APP0 + 1, 0xFFFF);
  jpeg_read_header(&session->decoder, TRUE);
  return true;
}

bool DecodeRaw(JpegSession* session, uint8_t* pixels, size_t row_size) {
  if (setjmp(session->on_error) != 0) return false;
  jpeg_decompress_struct* decoder = &session->decoder;
  switch (decoder->jpeg_color_space) {
    case JCS_GRAYSCALE:
      decoder->out_color_space = JCS_GRAYSCALE;
      break;
    case JCS_CMYK:
    case JCS_YCCK:
      decoder->out_color_space = JCS_CMYK;
      break;
    default:
      decoder->out_color_space = JCS_RGB;
  }
  jpeg_start_decompress(decoder);
  while (decoder->output_scanline < decoder->output_height) {
    JSAMPROW row = pixels + static_cast<size_t>(decoder->output_scanline) * row_size;
    jpeg_read_scanlines(decoder, &row, 1);
  }
  jpeg_finish_decompress(decoder);
  return true;
}

int OrientationOf(const jpeg_decompress_struct& decoder) {
  for (jpeg_saved_marker_ptr marker = decoder.marker_list; marker != nullptr; marker = marker->next) {
    const int orientation =
        codecs::ReadExifOrientation(std::string_view(reinterpret_cast<const char*>(marker->data), marker->data_length));
    if (orientation != 1) return orientation;
  }
  return 1;
}

// Adobe writes CMYK inverted, so 255 is "no ink": RGB is then ink times key.
Image RgbFromCmyk(const std::vector<uint8_t>& cmyk, int width, int height, bool inverted) {
  Image image = MakeImage(width, height, 3);
  for (size_t i = 0; i < image.pixels.size() / 3; ++i) {
    const unsigned key = inverted ? cmyk[4 * i + 3] : 255u - cmyk[4 * i + 3];
    for (size_t c = 0; c < 3; ++c) {
      const unsigned ink = inverted ? cmyk[4 * i + c] : 255u - cmyk[4 * i + c];
      image.pixels[3 * i + c] = static_cast<uint8_t>(ink * key / 255u);
    }
  }
  return image;
}

// Turns the stored image upright. EXIF orientation k says where the stored first row and column are to be shown.
Image ApplyOrientation(Image stored, int orientation) {
  if (orientation == 1) return stored;
  const bool swaps_sides = orientation >= 5;
  const int width = swaps_sides ? stored.height : stored.width;
  const int height = swaps_sides ? stored.width : stored.height;
  Image upright = MakeImage(width, height, stored.channels);
  const int last_x = stored.width - 1;
  const int last_y = stored.height - 1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int from_x = swaps_sides ? y : x;
      int from_y = swaps_sides ? x : y;
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) from_x = last_x - from_x;
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) from_y = last_y - from_y;
      std::memcpy(upright.at(x, y), stored.at(from_x, from_y), static_cast<size_t>(stored.channels));
    }
  }
  return upright;
}

Result<ImageHeader> ReadHeader(JpegReader& reader, std::string_view bytes) {
  JpegSession* session = reader.session();
  if (!reader.created() ||
      !ReadHeaderRaw(session, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) {
    return reader.Error();
  }
  ImageHeader header;
  header.format = ImageFormat::kJpeg;
  header.orientation = OrientationOf(session->decoder);
  header.width = static_cast<int>(session->decoder.image_width);
  header.height = static_cast<int>(session->decoder.image_height);
  if (header.orientation >= 5) std::swap(header.width, header.height);
  header.channels = session->decoder.jpeg_color_space == JCS_GRAYSCALE ? 1 : 3;
  return header;
}

}  // namespace

namespace codecs {

Result<ImageHeader> ReadJpegHeader(std::string_view bytes) {
  JpegReader reader;
  return ReadHeader(reader, bytes);
}

Result<Image> DecodeJpeg(std::string_view bytes, const ImageHeader& checked_header) {
  JpegReader reader;
  FR_ASSIGN_OR_RETURN(const ImageHeader header, ReadHeader(reader, bytes));
  FR_CHECK(header.width == checked_header.width && header.height == checked_header.height);
  JpegSession* session = reader.session();
  const int stored_width = static_cast<int>(session->decoder.image_width);
  const int stored_height = static_cast<int>(session->decoder.image_height);
  const bool cmyk = session->decoder.jpeg_color_space == JCS_CMYK || session->decoder.jpeg_color_space == JCS_YCCK;
  if (cmyk) {
    const size_t row_size = static_cast<size_t>(stored_width) * 4;
    std::vector<uint8_t> inks(row_size * static_cast<size_t>(stored_height));
    if (!DecodeRaw(session, inks.data(), row_size)) return reader.Error();
    const bool inverted = session->decoder.saw_Adobe_marker != 0;
    return ApplyOrientation(RgbFromCmyk(inks, stored_width, stored_height, inverted), header.orientation);
  }
  Image stored = MakeImage(stored_width, stored_height, header.channels);
  const size_t row_size = static_cast<size_t>(stored_width) * static_cast<size_t>(header.channels);
  if (!DecodeRaw(session, stored.pixels.data(), row_size)) return reader.Error();
  return ApplyOrientation(std::move(stored), header.orientation);
}

}  // namespace codecs

std::string EncodeJpeg(const Image& image, int quality) {
  FR_CHECK(IsValid(image));
  FR_CHECK(quality >= 1 && quality <= 100);
  if (image.channels == 4) return EncodeJpeg(ConvertChannels(image, 3), quality);
  jpeg_compress_struct encoder;
  jpeg_error_mgr errors;
  // The standard handler ends the process: with a valid image and a sink in memory only exhausted memory gets there.
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &buffer, &size);
  encoder.image_width = static_cast<JDIMENSION>(image.width);
  encoder.image_height = static_cast<JDIMENSION>(image.height);
  encoder.input_components = image.channels;
  encoder.in_color_space = image.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, quality, TRUE);
  jpeg_start_compress(&encoder, TRUE);
  while (encoder.next_scanline < encoder.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(image.at(0, static_cast<int>(encoder.next_scanline)));
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  jpeg_destroy_compress(&encoder);
  std::string bytes(reinterpret_cast<const char*>(buffer), size);
  std::free(buffer);
  return bytes;
}

}  // namespace fitroom
