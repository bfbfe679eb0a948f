#include "common/codec/hash.h"

#include <algorithm>
#include <cstring>

#include <sodium.h>

#include "common/base/check.h"

namespace fitroom {
namespace {

// Returns the value of a hexadecimal digit, or -1.
int DigitValue(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

const unsigned char* Unsigned(std::string_view bytes) { return reinterpret_cast<const unsigned char*>(bytes.data()); }

// Chooses the fastest implementation once a process; libsodium may be used before, only slower.
void InitialiseSodium() {
  static const int result = sodium_init();
  FR_CHECK(result >= 0);
}

}  // namespace

std::string Hash256::ToHex() const { return fitroom::ToHex(view()); }

std::optional<Hash256> Hash256::FromHex(std::string_view hex) {
  Hash256 hash;
  if (hex.size() != 2 * hash.bytes.size()) return std::nullopt;
  for (size_t i = 0; i < hash.bytes.size(); ++i) {
    const int high = DigitValue(hex[2 * i]);
    const int low = DigitValue(hex[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    hash.bytes[i] = static_cast<uint8_t>(high * 16 + low);
  }
  return hash;
}

std::optional<Hash256> Hash256::FromBytes(std::string_view bytes) {
  Hash256 hash;
  if (bytes.size() != hash.bytes.size()) return std::nullopt;
  std::memcpy(hash.bytes.data(), bytes.data(), bytes.size());
  return hash;
}

struct Blake2bHasher::State {
  crypto_generichash_state blake2b;
};

Blake2bHasher::Blake2bHasher() : state_(std::make_unique<State>()) {
  InitialiseSodium();
  crypto_generichash_init(&state_->blake2b, nullptr, 0, Hash256().bytes.size());
}

Blake2bHasher::Blake2bHasher(Blake2bHasher&& other) noexcept = default;
Blake2bHasher& Blake2bHasher::operator=(Blake2bHasher&& other) noexcept = default;
Blake2bHasher::~Blake2bHasher() = default;

void Blake2bHasher::Update(std::string_view bytes) {
  FR_CHECK(state_ != nullptr);
  crypto_generichash_update(&state_->blake2b, Unsigned(bytes), bytes.size());
}

Hash256 Blake2bHasher::Finish() {
  FR_CHECK(state_ != nullptr);
  Hash256 hash;
  crypto_generichash_final(&state_->blake2b, hash.bytes.data(), hash.bytes.size());
  state_.reset();
  return hash;
}

Hash256 Blake2b(std::string_view bytes) {
  InitialiseSodium();
  Hash256 hash;
  crypto_generichash(hash.bytes.data(), hash.bytes.size(), Unsigned(bytes), bytes.size(), nullptr, 0);
  return hash;
}

std::string ToHex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    hex += kDigits[byte >> 4];
    hex += kDigits[byte & 15];
  }
  return hex;
}

}  // namespace fitroom
