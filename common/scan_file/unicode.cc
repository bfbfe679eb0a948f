#include "common/scan_file/unicode.h"

#include <cstdint>

namespace fitroom {
namespace {

void AppendUtf8(char32_t c, std::string& text) {
  const auto put = [&](char32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6));
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | (c >> 18));
    put(0x80 | ((c >> 12) & 0x3F));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

}  // namespace

TextEncoding DetectTextEncoding(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return TextEncoding::kUtf8WithMark;
  if (bytes.size() < 2) return TextEncoding::kBytes;
  const auto first = static_cast<unsigned char>(bytes[0]);
  const auto second = static_cast<unsigned char>(bytes[1]);
  if (first == 0xFF && second == 0xFE) return TextEncoding::kUtf16LittleEndian;
  if (first == 0xFE && second == 0xFF) return TextEncoding::kUtf16BigEndian;
  const auto is_ascii = [](unsigned char c) { return c >= 0x20 && c < 0x7F; };
  if (is_ascii(first) && second == 0) return TextEncoding::kUtf16LittleEndian;
  if (first == 0 && is_ascii(second)) return TextEncoding::kUtf16BigEndian;
  return TextEncoding::kBytes;
}

Result<std::string> Utf16ToUtf8(std::string_view bytes, TextEncoding encoding) {
  if (bytes.size() % 2 != 0) {
    return InvalidArgument("ODD_UTF16", "UTF-16 text of an odd number of bytes is cut short; export it again");
  }
  const size_t high = encoding == TextEncoding::kUtf16LittleEndian ? 1 : 0;
  const auto unit = [&](size_t i) {
    const auto byte = [&](size_t at) { return static_cast<char32_t>(static_cast<unsigned char>(bytes[at])); };
    return byte(i + high) << 8 | byte(i + 1 - high);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  size_t i = !bytes.empty() && unit(0) == 0xFEFF ? 2 : 0;
  for (; i < bytes.size(); i += 2) {
    char32_t c = unit(i);
    if (c >= 0xD800 && c <= 0xDFFF) {
      const char32_t low = c < 0xDC00 && i + 2 < bytes.size() ? unit(i + 2) : 0;
      if (low >= 0xDC00 && low <= 0xDFFF) {
        c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
        i += 2;
      } else {
        c = 0xFFFD;
      }
    }
    AppendUtf8(c, text);
  }
  return text;
}

}  // namespace fitroom
