#include "common/codec/zstd.h"

#include <string>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

std::string SampleText() {
  std::string text;
  for (int i = 0; i < 20000; ++i)
    text += "*MESH_VERTEX " + std::to_string(i) + "\t" + std::to_string(i * i % 977) + "\n";
  return text;
}

TEST(Zstd, GivesBackTheBytes) {
  for (const std::string& text : {std::string(), std::string("a"), SampleText()}) {
    const std::string packed = ZstdCompress(text);
    EXPECT_TRUE(IsZstd(packed));
    const Result<std::string> unpacked = ZstdDecompress(packed);
    ASSERT_TRUE(unpacked.ok()) << unpacked.status().ToString();
    EXPECT_EQ(*unpacked, text);
  }
  EXPECT_LT(ZstdCompress(SampleText()).size(), SampleText().size() / 3);
}

// A bomb of 64 MiB of zeros packs to some 2 KB; it is stopped by its ratio.
TEST(Zstd, RefusesBombs) {
  const std::string bomb = ZstdCompress(std::string(size_t{64} << 20, '\0'), 19);
  ASSERT_LT(bomb.size(), 16384U);
  EXPECT_EQ(ZstdDecompress(bomb).status().reason(), "ZSTD_TOO_LARGE");
  ZstdLimits limits;
  limits.max_ratio = 1e9;
  limits.max_size = size_t{64} << 20;
  EXPECT_TRUE(ZstdDecompress(bomb, limits).ok());
  --limits.max_size;
  EXPECT_EQ(ZstdDecompress(bomb, limits).status().code(), StatusCode::kResourceExhausted);
}

TEST(Zstd, RefusesEveryTruncationAndTrailingBytes) {
  const std::string packed = ZstdCompress(SampleText());
  for (size_t size = 0; size < packed.size(); size += size < 64 ? 1 : 997) {
    EXPECT_EQ(ZstdDecompress(packed.substr(0, size)).status().reason(), "ZSTD_DAMAGED") << size;
  }
  EXPECT_EQ(ZstdDecompress(packed + '\0').status().reason(), "ZSTD_DAMAGED");
  EXPECT_EQ(ZstdDecompress(packed + packed).status().reason(), "ZSTD_DAMAGED");
}

// The frame's checksum finds what the format itself does not.
TEST(Zstd, FindsEveryFlippedBit) {
  const std::string text = SampleText().substr(0, 3000);
  const std::string packed = ZstdCompress(text);
  for (size_t bit = 0; bit < 8 * packed.size(); ++bit) {
    std::string flipped = packed;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    const Result<std::string> unpacked = ZstdDecompress(flipped);
    // A flip in the head may only concern how it is written; the bytes are right then.
    ASSERT_TRUE(!unpacked.ok() || *unpacked == text) << bit;
  }
}

}  // namespace
}  // namespace fitroom
