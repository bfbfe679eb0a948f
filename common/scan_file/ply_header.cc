#include "common/scan_file/ply_header.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <utility>

namespace fitroom {
namespace {

constexpr size_t kMaxElements = 64;
constexpr size_t kMaxProperties = 256;
constexpr size_t kMaxRemarks = 4096;
constexpr std::string_view kReexport = "the file is damaged or not a PLY of version 1.0; export it again";

std::optional<PlyType> ParseType(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {{
      {"char", PlyType::kInt8},
      {"int8", PlyType::kInt8},
      {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},
      {"short", PlyType::kInt16},
      {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16},
      {"uint16", PlyType::kUint16},
      {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},
      {"uint", PlyType::kUint32},
      {"uint32", PlyType::kUint32},
      {"float", PlyType::kFloat32},
      {"float32", PlyType::kFloat32},
      {"double", PlyType::kFloat64},
      {"float64", PlyType::kFloat64},
  }};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  return std::nullopt;
}

bool IsFloat(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

std::string_view NextWord(std::string_view& line) {
  size_t start = 0;
  while (start < line.size() && IsBlank(line[start])) ++start;
  size_t end = start;
  while (end < line.size() && !IsBlank(line[end])) ++end;
  const std::string_view word = line.substr(start, end - start);
  line.remove_prefix(end);
  return word;
}

std::string_view Trim(std::string_view text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

class HeaderReader {
 public:
  explicit HeaderReader(const SourceText& source) : source_(source), p_(source.begin()) {
    // The first line shows how lines end: a binary body may begin with any byte.
    const size_t end = source.text().find_first_of("\r\n");
    const std::string_view rest = end == std::string_view::npos ? "" : source.text().substr(end);
    line_end_ = rest.starts_with("\r\n") ? "\r\n" : (rest.starts_with("\r") ? "\r" : "\n");
  }

  Result<PlyHeader> Read() {
    bool has_format = false;
    for (line_start_ = p_; ReadLine(); line_start_ = p_) {
      std::string_view rest = line_;
      const std::string_view word = NextWord(rest);
      if (word == "end_header") return Finish(has_format);
      if (word == "format") {
        FR_RETURN_IF_ERROR(ReadFormat(rest));
        has_format = true;
      } else if (word == "element") {
        FR_RETURN_IF_ERROR(ReadElement(rest));
      } else if (word == "property") {
        FR_RETURN_IF_ERROR(ReadProperty(rest));
      } else if (word == "comment") {
        if (header_.comments.size() < kMaxRemarks) header_.comments.push_back(Trim(rest));
      } else if (word == "obj_info") {
        if (header_.object_infos.size() < kMaxRemarks) header_.object_infos.push_back(Trim(rest));
      } else if (line_start_ != source_.begin() && header_.comments.size() < kMaxRemarks) {
        header_.comments.push_back(Trim(line_));  // Some exporters forget the word "comment".
      }
    }
    return Malformed("the head has no end_header");
  }

 private:
  bool ReadLine() {
    if (p_ == source_.end()) return false;
    const std::string_view rest(p_, static_cast<size_t>(source_.end() - p_));
    const size_t end = rest.find(line_end_);
    if (end == std::string_view::npos) return false;
    line_ = rest.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);  // Line ends may be mixed.
    p_ += end + line_end_.size();
    return true;
  }

  Status Malformed(const std::string& what) const {
    return source_.ErrorAt(line_start_, "MALFORMED_PLY", what + "; " + std::string(kReexport));
  }

  Status ReadFormat(std::string_view rest) {
    const std::string_view name = NextWord(rest);
    if (name == "ascii") {
      header_.encoding = ScanEncoding::kText;
    } else if (name == "binary_little_endian") {
      header_.encoding = ScanEncoding::kBinaryLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.encoding = ScanEncoding::kBinaryBigEndian;
    } else {
      return Malformed("the format must be ascii, binary_little_endian or binary_big_endian");
    }
    return NextWord(rest) == "1.0" ? Status() : Malformed("the format's version is not 1.0");
  }

  Status ReadElement(std::string_view rest) {
    PlyElement element;
    element.name = NextWord(rest);
    element.position = line_start_;
    const std::string_view word = NextWord(rest);
    const auto count = ParseInt(word.data(), word.data() + word.size());
    const bool is_count = count.next != nullptr && count.next == word.data() + word.size() && count.value >= 0;
    if (!is_count) {
      return source_.ErrorAt(line_start_, "INVALID_COUNT",
                             "an element needs a count of rows, 0 or more; " + std::string(kReexport));
    }
    element.count = count.value;
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) return Malformed("an element is declared twice");
    }
    if (header_.elements.size() >= kMaxElements) return Malformed("too many elements");
    header_.elements.push_back(std::move(element));
    return Status();
  }

  Status ReadProperty(std::string_view rest) {
    if (header_.elements.empty()) return Malformed("a property must follow an element");
    PlyElement& element = header_.elements.back();
    if (element.properties.size() >= kMaxProperties) return Malformed("too many properties");
    PlyProperty property;
    std::string_view word = NextWord(rest);
    property.is_list = word == "list";
    if (property.is_list) {
      const std::optional<PlyType> count_type = ParseType(NextWord(rest));
      if (!count_type || IsFloat(*count_type)) return Malformed("a list's length must be of an integer type");
      property.count_type = *count_type;
      word = NextWord(rest);
    }
    const std::optional<PlyType> type = ParseType(word);
    property.name = NextWord(rest);
    if (!type || property.name.empty()) return Malformed("a property needs a known type and a name");
    property.type = *type;
    element.properties.push_back(property);
    return Status();
  }

  Result<PlyHeader> Finish(bool has_format) {
    if (!has_format) return Malformed("the head names no format");
    header_.body = p_;
    // Every row takes some bytes: what the body cannot hold is a lie, and nothing is allocated for it.
    int64_t left = source_.end() - p_;
    for (const PlyElement& element : header_.elements) {
      const int64_t row_size = element.MinRowSize(header_.encoding == ScanEncoding::kText);
      // The last row of a text needs no end of line.
      if (row_size > 0 && element.count > (left + 1) / row_size) {
        return source_.ErrorAt(element.position, "INVALID_COUNT",
                               "the element declares " + std::to_string(element.count) +
                                   " rows, more than the file holds: it is cut short or damaged; export it again");
      }
      left -= row_size * element.count;
    }
    return std::move(header_);
  }

  const SourceText& source_;
  const char* p_;
  const char* line_start_ = nullptr;
  std::string_view line_;
  std::string_view line_end_;
  PlyHeader header_;
};

}  // namespace

int64_t PlyTypeSize(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 1;
}

int PlyElement::FindProperty(std::initializer_list<std::string_view> names, bool is_list) const {
  for (size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    if (property.is_list == is_list && std::find(names.begin(), names.end(), property.name) != names.end()) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

int64_t PlyElement::MinRowSize(bool is_text) const {
  int64_t size = 0;
  for (const PlyProperty& property : properties) {
    size += is_text ? 2 : PlyTypeSize(property.is_list ? property.count_type : property.type);
  }
  return size;
}

Result<PlyHeader> ReadPlyHeader(const SourceText& source) { return HeaderReader(source).Read(); }

}  // namespace fitroom
