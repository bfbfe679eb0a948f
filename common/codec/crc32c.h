#pragma once

#include <cstdint>
#include <string_view>

namespace fitroom {

// Extends a CRC-32C (Castagnoli, RFC 3720 appendix B.4) over more bytes: with crc = Crc32c(a), the result for b is
// Crc32c(ab). The machine's own instruction is used where it has one (SSE 4.2), told at run time.
uint32_t ExtendCrc32c(uint32_t crc, std::string_view bytes);

// Returns the CRC-32C of the bytes; 0 for none.
inline uint32_t Crc32c(std::string_view bytes) { return ExtendCrc32c(0, bytes); }

namespace internal {
// The two ways behind ExtendCrc32c(), for the test that holds one against the other.
uint32_t ExtendCrc32cByTable(uint32_t crc, std::string_view bytes);
uint32_t ExtendCrc32cByInstruction(uint32_t crc, std::string_view bytes);
bool HasCrc32cInstruction();
}  // namespace internal

}  // namespace fitroom
