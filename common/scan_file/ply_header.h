#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/status.h"
#include "common/scan_file/scan_file.h"
#include "common/scan_file/source_text.h"

namespace fitroom {

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

// Returns the size of a value in a binary file (unit: byte).
int64_t PlyTypeSize(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::kFloat32;  // Of the value, or of a list's entries.
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // Of a list's length.
};

struct PlyElement {
  std::string_view name;
  int64_t count = 0;  // As declared: not to be believed.
  const char* position = nullptr;
  std::vector<PlyProperty> properties;

  // Returns the index of the first property of one of these names, or -1.
  int FindProperty(std::initializer_list<std::string_view> names, bool is_list) const;
  // Returns the fewest bytes that a row takes.
  int64_t MinRowSize(bool is_text) const;
};

// The head of a PLY file. Names borrow from the file's text.
struct PlyHeader {
  ScanEncoding encoding = ScanEncoding::kText;
  std::vector<PlyElement> elements;
  std::vector<std::string_view> comments;
  std::vector<std::string_view> object_infos;
  const char* body = nullptr;  // The first byte behind the head.
};

// Reads the head. INVALID_ARGUMENT where it breaks the format or declares more than the file can hold.
Result<PlyHeader> ReadPlyHeader(const SourceText& source);

}  // namespace fitroom
