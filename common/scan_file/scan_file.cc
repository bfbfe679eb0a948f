#include "common/scan_file/scan_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "common/base/file.h"
#include "common/codec/zstd.h"
#include "common/scan_file/ase_reader.h"
#include "common/scan_file/obj_reader.h"
#include "common/scan_file/ply_reader.h"
#include "common/scan_file/source_text.h"
#include "common/scan_file/unicode.h"

namespace fitroom {
namespace {

constexpr std::string_view kAccepted = "a scan is an ASE (3ds Max ASCII export), PLY or OBJ file";

// Says whether the first line that is no comment begins with a word of OBJ.
bool LooksLikeObj(std::string_view text) {
  static constexpr std::array<std::string_view, 14> kWords = {"v", "vt", "vn",     "vp",     "f", "o",   "g",
                                                              "s", "l",  "mtllib", "usemtl", "p", "deg", "cstype"};
  const char* p = text.data();
  const char* const end = p + std::min<size_t>(text.size(), 1 << 16);
  while ((p = SkipSpace(p, end)) < end) {
    const char* const word = p;
    while (p < end && !IsSpace(*p)) ++p;
    if (*word != '#') return std::find(kWords.begin(), kWords.end(), std::string_view(word, p)) != kWords.end();
    while (p < end && *p != '\n' && *p != '\r') ++p;
  }
  return false;
}

std::optional<ScanFormat> DetectFormat(std::string_view text) {
  if (text.size() > 3 && text.starts_with("ply") && IsSpace(text[3])) return ScanFormat::kPly;
  const char* const start = SkipSpace(text.data(), text.data() + text.size());
  const std::string_view rest = text.substr(static_cast<size_t>(start - text.data()));
  if (rest.size() > 1 && rest[0] == '*' && rest[1] >= 'A' && rest[1] <= 'Z') return ScanFormat::kAse;
  if (rest.size() > 1 && rest[0] == '*' && IsDigit(rest[1])) return ScanFormat::kAse;
  if (LooksLikeObj(text)) return ScanFormat::kObj;
  return std::nullopt;
}

Status UnknownFormat(std::string_view text, std::string_view file_name) {
  std::string what = "unknown format: ";
  if (text.starts_with("\x89PNG") || text.starts_with("\xFF\xD8\xFF")) what = "this is a picture: ";
  if (text.starts_with("PK\x03\x04")) what = "this is a ZIP archive, unpack it first: ";
  if (text.starts_with("\x1F\x8B")) what = "this is packed with gzip, unpack it first: ";
  if (text.starts_with("solid ")) what = "this looks like STL, which is not read: ";
  return InvalidArgument("UNKNOWN_FORMAT", std::string(file_name) + ":1: " + what + std::string(kAccepted));
}

Result<RawScan> ReadText(std::string_view text, std::string_view file_name, const ReadScanLimits& limits) {
  const std::optional<ScanFormat> format = DetectFormat(text);
  if (!format) return UnknownFormat(text, file_name);
  const SourceText source(text, file_name);
  switch (*format) {
    case ScanFormat::kAse:
      return ReadAse(source, limits);
    case ScanFormat::kPly:
      return ReadPly(source, limits);
    case ScanFormat::kObj:
      return ReadObj(source, limits);
  }
  return UnknownFormat(text, file_name);
}

Result<RawScan> ReadUnpacked(std::string_view bytes, std::string_view file_name, const ReadScanLimits& limits) {
  if (bytes.empty()) {
    return InvalidArgument("EMPTY_FILE", std::string(file_name) + ":1: the file is empty; " + std::string(kAccepted));
  }
  if (bytes.size() > limits.max_file_size) {
    return ResourceExhausted("FILE_TOO_LARGE", std::string(file_name) + " has " + std::to_string(bytes.size()) +
                                                   " bytes; at most " + std::to_string(limits.max_file_size) +
                                                   " are read: thin the scan out before exporting it");
  }
  const TextEncoding encoding = DetectTextEncoding(bytes);
  if (encoding == TextEncoding::kBytes) return ReadText(bytes, file_name, limits);
  if (encoding == TextEncoding::kUtf8WithMark) return ReadText(bytes.substr(3), file_name, limits);
  const Result<std::string> text = Utf16ToUtf8(bytes, encoding);
  if (!text.ok()) return text.status().At(file_name);
  Result<RawScan> scan = ReadText(*text, file_name, limits);
  if (scan.ok() && scan->encoding == ScanEncoding::kText) {
    scan->encoding =
        encoding == TextEncoding::kUtf16LittleEndian ? ScanEncoding::kUtf16LittleEndian : ScanEncoding::kUtf16BigEndian;
  }
  return scan;
}

}  // namespace

std::string_view ScanFormatName(ScanFormat format) {
  switch (format) {
    case ScanFormat::kAse:
      return "ASE";
    case ScanFormat::kPly:
      return "PLY";
    case ScanFormat::kObj:
      return "OBJ";
  }
  return "unknown";
}

std::string_view ScanEncodingName(ScanEncoding encoding) {
  switch (encoding) {
    case ScanEncoding::kText:
      return "text";
    case ScanEncoding::kUtf16LittleEndian:
      return "UTF-16 little endian";
    case ScanEncoding::kUtf16BigEndian:
      return "UTF-16 big endian";
    case ScanEncoding::kBinaryLittleEndian:
      return "binary little endian";
    case ScanEncoding::kBinaryBigEndian:
      return "binary big endian";
  }
  return "unknown";
}

Result<RawScan> ReadScan(std::string_view bytes, std::string_view file_name, const ReadScanLimits& limits) {
  if (!IsZstd(bytes)) return ReadUnpacked(bytes, file_name, limits);
  ZstdLimits zstd_limits;
  zstd_limits.max_size = limits.max_file_size;
  zstd_limits.max_ratio = limits.max_compression_ratio;
  const Result<std::string> unpacked = ZstdDecompress(bytes, zstd_limits);
  if (!unpacked.ok()) return unpacked.status().At(file_name);
  Result<RawScan> scan = ReadUnpacked(*unpacked, file_name, limits);
  if (scan.ok()) scan->is_compressed = true;
  return scan;
}

Result<RawScan> ReadScanFile(const std::filesystem::path& path, const ReadScanLimits& limits) {
  FR_ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(path));
  return ReadScan(file.text(), path.filename().string(), limits);
}

}  // namespace fitroom
