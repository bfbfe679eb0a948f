#include "common/image/decode.h"

#include <webp/encode.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "common/image/codecs.h"
#include "common/image/encode.h"
#include "tests/common/image/png_writer.h"

namespace fitroom {
namespace {

// A smooth picture in which every pixel differs from its mirror images, so that a wrong orientation shows.
Image MakeRamp(int width, int height, int channels) {
  Image image = MakeImage(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      uint8_t* pixel = image.at(x, y);
      for (int c = 0; c < channels; ++c) {
        pixel[c] = static_cast<uint8_t>(20 + 150 * x / width + (c == 1 ? 0 : 60 * y / height));
      }
    }
  }
  return image;
}

double MeanAbsoluteDifference(const Image& a, const Image& b) {
  if (a.pixels.size() != b.pixels.size()) return 1e9;
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
  return sum / static_cast<double>(a.pixels.size());
}

std::string WithExifOrientation(const std::string& jpeg, int orientation, bool big_endian) {
  std::string tiff = big_endian ? std::string("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19)
                                : std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18);
  tiff += static_cast<char>(orientation);
  tiff += std::string(big_endian ? 6 : 7, '\0');
  const std::string payload = std::string("Exif\0\0", 6) + tiff;
  const size_t length = payload.size() + 2;
  std::string segment("\xff\xe1", 2);
  segment += static_cast<char>(length >> 8);
  segment += static_cast<char>(length & 255);
  return jpeg.substr(0, 2) + segment + payload + jpeg.substr(2);
}

// The stored picture that a viewer shows as `upright` under this EXIF orientation, by the tag's definition: the name of
// the visual side at which the stored first row and first column lie.
Image StoredFor(const Image& upright, int orientation) {
  const bool swaps = orientation >= 5;
  Image stored = MakeImage(swaps ? upright.height : upright.width, swaps ? upright.width : upright.height, 3);
  for (int row = 0; row < stored.height; ++row) {
    for (int column = 0; column < stored.width; ++column) {
      int x = 0;
      int y = 0;
      const int right = upright.width - 1;
      const int bottom = upright.height - 1;
      switch (orientation) {
        case 1:
          x = column, y = row;
          break;  // first row: top, first column: left
        case 2:
          x = right - column, y = row;
          break;  // top, right
        case 3:
          x = right - column, y = bottom - row;
          break;  // bottom, right
        case 4:
          x = column, y = bottom - row;
          break;  // bottom, left
        case 5:
          x = row, y = column;
          break;  // left, top
        case 6:
          x = right - row, y = column;
          break;  // right, top
        case 7:
          x = right - row, y = bottom - column;
          break;  // right, bottom
        case 8:
          x = row, y = bottom - column;
          break;  // left, bottom
        default:
          break;
      }
      for (int c = 0; c < 3; ++c) stored.at(column, row)[c] = upright.at(x, y)[c];
    }
  }
  return stored;
}

TEST(DecodeImage, PngGivesBackEveryPixelThatWasEncoded) {
  for (const int channels : {1, 3, 4}) {
    const Image image = MakeRamp(37, 23, channels);
    const Result<Image> decoded = DecodeImage(EncodePng(image));
    ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
    EXPECT_EQ(decoded->channels, channels);
    EXPECT_EQ(decoded->pixels, image.pixels);
  }
}

TEST(DecodeImage, JpegIsWithinTheCodecsLossOfTheOriginal) {
  const Image image = MakeRamp(64, 48, 3);
  const Result<Image> decoded = DecodeImage(EncodeJpeg(image, 95));
  ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
  EXPECT_LT(MeanAbsoluteDifference(*decoded, image), 2.0);
  const Result<Image> grey = DecodeImage(EncodeJpeg(MakeRamp(64, 48, 1), 95));
  ASSERT_TRUE(grey.ok());
  EXPECT_EQ(grey->channels, 1);
}

TEST(DecodeImage, JpegIsTurnedUprightByItsExifOrientation) {
  const Image upright = MakeRamp(48, 32, 3);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool big_endian : {false, true}) {
      const std::string bytes =
          WithExifOrientation(EncodeJpeg(StoredFor(upright, orientation), 98), orientation, big_endian);
      const Result<Image> decoded = DecodeImage(bytes);
      ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
      EXPECT_EQ(decoded->width, 48) << orientation;
      EXPECT_LT(MeanAbsoluteDifference(*decoded, upright), 2.0) << "orientation " << orientation;
    }
  }
}

TEST(DecodeImage, WebpStillIsDecodedWithItsAlpha) {
  const Image image = MakeRamp(40, 30, 4);
  uint8_t* encoded = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(image.pixels.data(), 40, 30, 160, &encoded);
  const std::string bytes(reinterpret_cast<char*>(encoded), size);
  WebPFree(encoded);
  const Result<Image> decoded = DecodeImage(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status().ToString();
  EXPECT_EQ(decoded->channels, 4);
  EXPECT_EQ(decoded->pixels, image.pixels);
  for (size_t length = 0; length < bytes.size(); length += 7) EXPECT_FALSE(DecodeImage(bytes.substr(0, length)).ok());
}

TEST(DecodeImage, EveryPngDepthPaletteAndInterlacingBecomesEightBits) {
  using testing::PngKind;
  for (const PngKind kind : {PngKind::kGrey1, PngKind::kGrey16, PngKind::kRgb16, PngKind::kPalette4,
                             PngKind::kPaletteWithAlpha, PngKind::kRgbInterlaced, PngKind::kGreyAlpha}) {
    const testing::PngCase png = testing::WritePngCase(kind);
    const Result<Image> decoded = DecodeImage(png.bytes);
    ASSERT_TRUE(decoded.ok()) << static_cast<int>(kind) << decoded.status().ToString();
    EXPECT_EQ(decoded->channels, png.expected.channels) << static_cast<int>(kind);
    EXPECT_LE(MeanAbsoluteDifference(*decoded, png.expected), 0.5) << static_cast<int>(kind);
  }
}

TEST(DecodeImage, TruncatedFilesAreRefusedAtEveryLength) {
  const Image image = MakeRamp(60, 40, 3);
  for (const std::string& bytes : {EncodePng(image), EncodeJpeg(image)}) {
    for (size_t length = 0; length + 20 < bytes.size(); length += 11) {
      const Result<Image> decoded = DecodeImage(bytes.substr(0, length));
      ASSERT_FALSE(decoded.ok()) << length << " of " << bytes.size();
      EXPECT_TRUE(decoded.status().code() == StatusCode::kDataLoss ||
                  decoded.status().code() == StatusCode::kInvalidArgument);
    }
  }
}

TEST(DecodeImage, FlippedBytesNeverCrash) {
  const Image image = MakeRamp(60, 40, 3);
  for (const std::string& original : {EncodePng(image), EncodeJpeg(image)}) {
    for (size_t place = 0; place < original.size(); ++place) {
      std::string bytes = original;
      bytes[place] = static_cast<char>(bytes[place] ^ 0x5a);
      const Result<Image> decoded = DecodeImage(bytes, {.max_pixels = 1000 * 1000});
      EXPECT_TRUE(!decoded.ok() || IsValid(*decoded));
    }
  }
}

TEST(DecodeImage, BombsAreRefusedByTheirHeader) {
  // A PNG header of 30000 x 30000 one-bit pixels, and the start of image data.
  const Result<Image> png = DecodeImage(testing::PngHeaderOnly(30000, 30000, 1, 0));
  EXPECT_EQ(png.status().reason(), "IMAGE_TOO_LARGE");
  std::string jpeg = EncodeJpeg(MakeRamp(16, 16, 3));
  const size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  for (size_t i = 5; i < 9; ++i) jpeg[frame + i] = '\xff';
  EXPECT_FALSE(DecodeImage(jpeg).ok());
  EXPECT_EQ(DecodeImage(EncodePng(MakeRamp(9, 9, 1)), {.max_bytes = 20}).status().reason(), "IMAGE_FILE_TOO_LARGE");
  EXPECT_EQ(DecodeImage(EncodePng(MakeRamp(9, 9, 1)), {.min_side = 10}).status().reason(), "IMAGE_TOO_SMALL");
}

TEST(DecodeImage, OtherFilesAreNamedAsUnknown) {
  for (const std::string bytes : {"", "G", "GIF89a", "<svg/>", "RIFF....WAVE"}) {
    EXPECT_EQ(DecodeImage(bytes).status().reason(), "IMAGE_FORMAT_UNKNOWN") << bytes;
  }
}

TEST(ReadExifOrientation, DamagedBlocksMeanUpright) {
  const std::string good = WithExifOrientation(std::string(2, 'x'), 6, false).substr(6);
  ASSERT_EQ(codecs::ReadExifOrientation(good.substr(0, 32)), 6);
  for (size_t length = 0; length < 26; ++length) EXPECT_EQ(codecs::ReadExifOrientation(good.substr(0, length)), 1);
}

TEST(ConvertChannels, GreyOfWhiteIsWhiteAndOpaqueIsAdded) {
  Image white = MakeImage(2, 2, 3);
  white.pixels.assign(white.pixels.size(), 255);
  EXPECT_EQ(ConvertChannels(white, 1).pixels, std::vector<uint8_t>(4, 255));
  EXPECT_EQ(ConvertChannels(white, 4).pixels, std::vector<uint8_t>(16, 255));
}

}  // namespace
}  // namespace fitroom
