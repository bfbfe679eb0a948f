#include <cstddef>
#include <cstdint>

#include "common/image/codecs.h"

namespace fitroom::codecs {
namespace {

constexpr std::string_view kExifPrefix("Exif\0\0", 6);
constexpr uint16_t kOrientationTag = 0x0112;
constexpr size_t kEntrySize = 12;  // Of one directory entry (unit: byte).

// Reads numbers of a TIFF block in either byte order; 0 where the block is too short.
struct TiffBlock {
  std::string_view bytes;
  bool big_endian = false;

  uint32_t Byte(size_t offset) const {
    return offset < bytes.size() ? static_cast<uint8_t>(bytes[offset]) : uint32_t{0};
  }
  uint16_t U16(size_t offset) const {
    const uint32_t first = Byte(offset);
    const uint32_t second = Byte(offset + 1);
    return static_cast<uint16_t>(big_endian ? first << 8 | second : second << 8 | first);
  }
  uint32_t U32(size_t offset) const {
    const uint32_t first = U16(offset);
    const uint32_t second = U16(offset + 2);
    return big_endian ? first << 16 | second : second << 16 | first;
  }
};

}  // namespace

int ReadExifOrientation(std::string_view app1_payload) {
  if (!app1_payload.starts_with(kExifPrefix)) return 1;
  TiffBlock tiff{app1_payload.substr(kExifPrefix.size())};
  if (tiff.bytes.starts_with("MM")) {
    tiff.big_endian = true;
  } else if (!tiff.bytes.starts_with("II")) {
    return 1;
  }
  if (tiff.U16(2) != 42) return 1;
  const size_t directory = tiff.U32(4);
  if (directory + 2 > tiff.bytes.size()) return 1;
  const size_t entry_count = tiff.U16(directory);
  for (size_t i = 0; i < entry_count; ++i) {
    const size_t entry = directory + 2 + i * kEntrySize;
    if (entry + kEntrySize > tiff.bytes.size()) return 1;
    if (tiff.U16(entry) != kOrientationTag) continue;
    const int orientation = tiff.U16(entry + 8);
    return orientation >= 1 && orientation <= 8 ? orientation : 1;
  }
  return 1;
}

}  // namespace fitroom::codecs
