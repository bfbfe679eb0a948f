#include "common/codec/crc32c.h"

#include <string>

#include <gtest/gtest.h>

namespace fitroom {
namespace {

// RFC 3720, appendix B.4, and the check value of the CRC catalogue.
TEST(Crc32c, HasThePublishedValues) {
  EXPECT_EQ(Crc32c(""), 0U);
  EXPECT_EQ(Crc32c("123456789"), 0xE3069283U);
  EXPECT_EQ(Crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(Crc32c(std::string(32, '\xFF')), 0x62A8AB43U);
  std::string ascending, descending;
  for (char c = 0; c < 32; ++c) ascending += c;
  for (char c = 31; c >= 0; --c) descending += c;
  EXPECT_EQ(Crc32c(ascending), 0x46DD794EU);
  EXPECT_EQ(Crc32c(descending), 0x113FDB5CU);
}

TEST(Crc32c, IsTheSameHoweverTheBytesAreCut) {
  std::string bytes;
  for (unsigned i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 2654435761U >> 24);
  for (size_t cut = 0; cut <= bytes.size(); ++cut) {
    const uint32_t first = Crc32c(std::string_view(bytes).substr(0, cut));
    ASSERT_EQ(ExtendCrc32c(first, std::string_view(bytes).substr(cut)), Crc32c(bytes)) << cut;
  }
}

TEST(Crc32c, TableAndInstructionAgree) {
  if (!internal::HasCrc32cInstruction()) GTEST_SKIP() << "this machine has no SSE 4.2";
  std::string bytes;
  for (unsigned i = 0; i < 300; ++i) {
    ASSERT_EQ(internal::ExtendCrc32cByTable(i, bytes), internal::ExtendCrc32cByInstruction(i, bytes)) << i;
    bytes += static_cast<char>(i * 2654435761U >> 24);
  }
}

}  // namespace
}  // namespace fitroom
