#include "common/codec/zstd.h"

#include <algorithm>
#include <memory>

#include <zstd.h>

namespace fitroom {
namespace {

// Allocation failure of a context is the only way these are null: as fatal as std::bad_alloc.
struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
struct FreeDecompressor {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

Status Damaged(std::string_view what) {
  return InvalidArgument("ZSTD_DAMAGED",
                         "the zstd frame is damaged or cut short (" + std::string(what) + "); pack or send it again");
}

Status TooLarge(std::string_view what) {
  return ResourceExhausted("ZSTD_TOO_LARGE", "the zstd frame unpacks to more than is accepted: " + std::string(what));
}

// Returns how many bytes may have been unpacked after `consumed` packed ones. A small frame may unpack to 1 MiB at any
// ratio.
size_t SizeLimit(size_t consumed, const ZstdLimits& limits) {
  const double by_ratio = std::max(limits.max_ratio * static_cast<double>(consumed), 1048576.0);
  return by_ratio >= static_cast<double>(limits.max_size) ? limits.max_size : static_cast<size_t>(by_ratio);
}

}  // namespace

bool IsZstd(std::string_view bytes) { return bytes.starts_with("\x28\xB5\x2F\xFD"); }

std::string ZstdCompress(std::string_view bytes, int level) {
  const std::unique_ptr<ZSTD_CCtx, FreeCompressor> context(ZSTD_createCCtx());
  FR_CHECK(context != nullptr);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, std::clamp(level, 1, 19));
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size());
  FR_CHECK(!ZSTD_isError(size));  // Cannot happen with a buffer of compressBound() bytes.
  packed.resize(size);
  packed.shrink_to_fit();
  return packed;
}

Result<std::string> ZstdDecompress(std::string_view bytes, const ZstdLimits& limits) {
  if (!IsZstd(bytes)) return InvalidArgument("ZSTD_DAMAGED", "not a zstd frame");
  const unsigned long long declared = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (declared == ZSTD_CONTENTSIZE_ERROR) return Damaged("its header cannot be read");
  const bool is_declared = declared != ZSTD_CONTENTSIZE_UNKNOWN;
  if (is_declared && declared > limits.max_size) {
    return TooLarge(std::to_string(declared) + " bytes are declared, " + std::to_string(limits.max_size) +
                    " are the limit");
  }

  const std::unique_ptr<ZSTD_DCtx, FreeDecompressor> context(ZSTD_createDCtx());
  FR_CHECK(context != nullptr);
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, limits.max_window_log);
  const size_t most = is_declared ? static_cast<size_t>(declared) : limits.max_size;
  std::string unpacked;
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  for (;;) {
    // A declared size is allocated in steps too, so that a lie costs no more than twice what really unpacks.
    const size_t filled = unpacked.size();
    const size_t room = std::min(most - filled, std::max<size_t>(filled, size_t{1} << 20));
    unpacked.resize(filled + room);
    ZSTD_outBuffer out{unpacked.data() + filled, room, 0};
    const size_t pending = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(pending)) return Damaged(ZSTD_getErrorName(pending));
    unpacked.resize(filled + out.pos);
    if (unpacked.size() > SizeLimit(in.pos, limits)) {
      return TooLarge("more than " + std::to_string(SizeLimit(in.pos, limits)) + " bytes from " +
                      std::to_string(in.pos));
    }
    if (pending == 0) break;
    if (unpacked.size() == most && out.pos == 0) {
      return is_declared ? Damaged("it holds more than it declares")
                         : TooLarge("more than " + std::to_string(limits.max_size) + " bytes");
    }
    if (in.pos == in.size && out.pos < out.size) return Damaged("it ends too early");
  }
  if (in.pos != in.size) return Damaged("bytes follow its end");
  return unpacked;
}

}  // namespace fitroom
