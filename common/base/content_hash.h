#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fitroom {

// The BLAKE2b-256 hash of a file, image or mesh. Computed by common/codec; here it is only carried about.
struct ContentHash {
  std::array<uint8_t, 32> value{};

  std::string_view bytes() const { return {reinterpret_cast<const char*>(value.data()), value.size()}; }
  friend bool operator==(const ContentHash&, const ContentHash&) = default;
};

// Returns the hash of exactly 32 bytes, else nothing.
inline std::optional<ContentHash> ContentHashFromBytes(std::string_view bytes) {
  ContentHash hash;
  if (bytes.size() != hash.value.size()) return std::nullopt;
  std::copy(bytes.begin(), bytes.end(), hash.value.begin());
  return hash;
}

// Returns 64 lower-case hexadecimal digits.
inline std::string ToHex(const ContentHash& hash) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const uint8_t byte : hash.value) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace fitroom
