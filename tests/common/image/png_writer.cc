#include "tests/common/image/png_writer.h"

#include <png.h>

#include <cstdlib>
#include <vector>

namespace fitroom::testing {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 16;

struct Format {
  int depth;
  int colour;
  int interlace;
  int channels;  // Of the file.
  int expected_channels;
};

Format FormatOf(PngKind kind) {
  switch (kind) {
    case PngKind::kGrey1:
      return {1, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 1, 1};
    case PngKind::kGrey16:
      return {16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 1, 1};
    case PngKind::kRgb16:
      return {16, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, 3, 3};
    case PngKind::kPalette4:
      return {4, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, 1, 3};
    case PngKind::kPaletteWithAlpha:
      return {8, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, 1, 4};
    case PngKind::kRgbInterlaced:
      return {8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7, 3, 3};
    case PngKind::kGreyAlpha:
      return {8, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_INTERLACE_NONE, 2, 4};
  }
  std::abort();
}

// Sample `c` of pixel (x, y) in the file's own depth.
unsigned SampleOf(const Format& format, int x, int y, int c) {
  const unsigned value = static_cast<unsigned>(7 * x + 5 * y + 31 * c);
  return format.depth == 16 ? (value * 271u) & 0xFFFFu : value & ((1u << format.depth) - 1u);
}

png_color PaletteColour(unsigned index) {
  return {static_cast<png_byte>(index * 9u), static_cast<png_byte>(255u - index * 3u), static_cast<png_byte>(index)};
}
png_byte PaletteAlpha(unsigned index) { return static_cast<png_byte>(index * 13u); }

void FillExpected(const Format& format, int x, int y, uint8_t* out) {
  const unsigned first = SampleOf(format, x, y, 0);
  if (format.colour == PNG_COLOR_TYPE_PALETTE) {
    const png_color colour = PaletteColour(first);
    out[0] = colour.red, out[1] = colour.green, out[2] = colour.blue;
    if (format.expected_channels == 4) out[3] = PaletteAlpha(first);
    return;
  }
  const unsigned full = (1u << format.depth) - 1u;
  const auto to_eight = [&](unsigned sample) { return static_cast<uint8_t>((sample * 255u + full / 2) / full); };
  if (format.colour == PNG_COLOR_TYPE_GRAY_ALPHA) {
    out[0] = out[1] = out[2] = to_eight(first);
    out[3] = to_eight(SampleOf(format, x, y, 1));
    return;
  }
  for (int c = 0; c < format.expected_channels; ++c) out[c] = to_eight(SampleOf(format, x, y, c));
}

std::vector<png_byte> PackRow(const Format& format, int y) {
  std::vector<png_byte> row;
  unsigned bits = 0;
  int bit_count = 0;
  for (int x = 0; x < kWidth; ++x) {
    for (int c = 0; c < format.channels; ++c) {
      const unsigned sample = SampleOf(format, x, y, c);
      if (format.depth == 16) {
        row.push_back(static_cast<png_byte>(sample >> 8));
        row.push_back(static_cast<png_byte>(sample & 255u));
        continue;
      }
      bits = bits << format.depth | sample;
      bit_count += format.depth;
      if (bit_count == 8) {
        row.push_back(static_cast<png_byte>(bits));
        bits = 0;
        bit_count = 0;
      }
    }
  }
  return row;
}

void Append(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void AppendBigEndian(std::string& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255u);
}

void AppendChunk(std::string& bytes, const std::string& type, const std::string& content) {
  AppendBigEndian(bytes, static_cast<uint32_t>(content.size()));
  const std::string checked = type + content;
  uint32_t crc = 0xFFFFFFFFu;
  for (const char c : checked) {
    crc ^= static_cast<uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = (crc & 1u) != 0 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  bytes += checked;
  AppendBigEndian(bytes, ~crc);
}

}  // namespace

PngCase WritePngCase(PngKind kind) {
  const Format format = FormatOf(kind);
  PngCase result;
  result.expected = MakeImage(kWidth, kHeight, format.expected_channels);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop png_info = png_create_info_struct(png);
  png_set_write_fn(png, &result.bytes, Append, nullptr);
  png_set_IHDR(png, png_info, kWidth, kHeight, format.depth, format.colour, format.interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const unsigned palette_size = format.depth <= 8 ? 1u << format.depth : 0u;
  std::vector<png_color> palette;
  std::vector<png_byte> alphas;
  for (unsigned i = 0; i < palette_size; ++i) {
    palette.push_back(PaletteColour(i));
    alphas.push_back(PaletteAlpha(i));
  }
  if (format.colour == PNG_COLOR_TYPE_PALETTE)
    png_set_PLTE(png, png_info, palette.data(), static_cast<int>(palette_size));
  if (kind == PngKind::kPaletteWithAlpha) {
    png_set_tRNS(png, png_info, alphas.data(), static_cast<int>(palette_size), nullptr);
  }
  png_write_info(png, png_info);
  std::vector<std::vector<png_byte>> rows;
  for (int y = 0; y < kHeight; ++y) {
    rows.push_back(PackRow(format, y));
    for (int x = 0; x < kWidth; ++x) FillExpected(format, x, y, result.expected.at(x, y));
  }
  std::vector<png_bytep> row_pointers;
  for (std::vector<png_byte>& row : rows) row_pointers.push_back(row.data());
  png_write_image(png, row_pointers.data());
  png_write_end(png, png_info);
  png_destroy_write_struct(&png, &png_info);
  return result;
}

std::string PngHeaderOnly(uint32_t width, uint32_t height, int bit_depth, int colour_type) {
  std::string bytes("\x89PNG\r\n\x1a\n", 8);
  std::string header;
  AppendBigEndian(header, width);
  AppendBigEndian(header, height);
  header += static_cast<char>(bit_depth);
  header += static_cast<char>(colour_type);
  header += std::string(3, '\0');
  AppendChunk(bytes, "IHDR", header);
  AppendChunk(bytes, "IDAT", std::string("\x78\x9c\x03\x00", 4));
  return bytes;
}

}  // namespace fitroom::testing
