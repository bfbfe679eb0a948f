#include "common/codec/hash.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// `printf abc | b2sum -l 256`, and of no bytes (RFC 7693's algorithm with a digest of 32 bytes).
constexpr std::string_view kHashOfAbc = "bddd813c634239723171ef3fee98579b94964e3bb1cb3e427262c8c068d52319";
constexpr std::string_view kHashOfNothing = "0e5751c026e543b2e8ab2eb06099daa1d1e5df47778f7787faab45cdf12fe3a8";

TEST(Blake2b, HasThePublishedValues) {
  EXPECT_EQ(Blake2b("abc").ToHex(), kHashOfAbc);
  EXPECT_EQ(Blake2b("").ToHex(), kHashOfNothing);
}

TEST(Blake2b, IsTheSameHoweverTheBytesAreCut) {
  const std::string bytes(1000, 'x');
  for (size_t cut = 0; cut <= bytes.size(); cut += 37) {
    Blake2bHasher hasher;
    hasher.Update(std::string_view(bytes).substr(0, cut));
    Blake2bHasher moved = std::move(hasher);
    moved.Update(std::string_view(bytes).substr(cut));
    ASSERT_EQ(moved.Finish(), Blake2b(bytes)) << cut;
  }
}

TEST(Hash256, ComesBackFromHexAndBytes) {
  const Hash256 hash = Blake2b("abc");
  EXPECT_EQ(Hash256::FromHex(hash.ToHex()), hash);
  EXPECT_EQ(Hash256::FromHex("BDDD813C634239723171EF3FEE98579B94964E3BB1CB3E427262C8C068D52319"), hash);
  EXPECT_EQ(Hash256::FromBytes(hash.view()), hash);
  EXPECT_EQ(Hash256::FromHex(hash.ToHex() + "0"), std::nullopt);
  EXPECT_EQ(Hash256::FromHex(std::string(64, 'g')), std::nullopt);
  EXPECT_EQ(Hash256::FromBytes("short"), std::nullopt);
  EXPECT_EQ(ToHex(std::string("\x00\x7f\xff", 3)), "007fff");
}

}  // namespace
}  // namespace fitroom
