#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace fitroom {

// A BLAKE2b digest of 256 bits. Identifies content: equal bytes, equal hash.
struct Hash256 {
  std::array<uint8_t, 32> bytes{};

  friend bool operator==(const Hash256&, const Hash256&) = default;
  friend auto operator<=>(const Hash256&, const Hash256&) = default;
  std::string_view view() const { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
  // Returns 64 lower-case hexadecimal digits.
  std::string ToHex() const;
  // Parses 64 hexadecimal digits of either case; nothing else.
  static std::optional<Hash256> FromHex(std::string_view hex);
  // Takes 32 raw bytes; nothing of another size.
  static std::optional<Hash256> FromBytes(std::string_view bytes);
};

// Hashes bytes as they come. Not thread-safe; movable.
class Blake2bHasher {
 public:
  Blake2bHasher();
  Blake2bHasher(Blake2bHasher&& other) noexcept;
  Blake2bHasher& operator=(Blake2bHasher&& other) noexcept;
  ~Blake2bHasher();

  void Update(std::string_view bytes);
  // Returns the hash of all bytes so far. The hasher must not be used afterwards.
  Hash256 Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the BLAKE2b-256 hash of the bytes.
Hash256 Blake2b(std::string_view bytes);

// Returns two lower-case hexadecimal digits a byte.
std::string ToHex(std::string_view bytes);

}  // namespace fitroom
