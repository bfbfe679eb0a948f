#include "common/scan_file/ply_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/scan_file/ply_header.h"
#include "common/scan_file/range_grid.h"
#include "common/scan_file/scan_builder.h"

namespace fitroom {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kReexport = "the file is damaged or cut short; export it again";
constexpr int64_t kMaxPolygonCorners = 65535;

// Hands out the values of an ascii body, which are words between white space. NaN with `ok` unset where there is none.
class TextValues {
 public:
  TextValues(const char* p, const char* end) : p_(p), end_(end) {}

  double Read(PlyType) {
    p_ = SkipSpace(p_, end_);
    const auto number = ParseDouble(p_, end_);
    if (number.next == nullptr || (number.next < end_ && !IsSpace(*number.next))) {
      ok_ = false;
      return std::numeric_limits<double>::quiet_NaN();
    }
    p_ = number.next;
    return number.value;
  }
  void Skip(PlyType type, int64_t count) {
    for (int64_t i = 0; i < count && ok_; ++i) Read(type);
  }
  bool ok() const { return ok_; }
  const char* position() const { return p_; }
  const char* EndOfData() const { return SkipSpace(p_, end_); }

 private:
  const char* p_;
  const char* end_;
  bool ok_ = true;
};

// Hands out the values of a binary body; the machine itself is little endian.
template <bool kBigEndian>
class BinaryValues {
 public:
  BinaryValues(const char* p, const char* end) : p_(p), end_(end) {}

  double Read(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return Take<int8_t>();
      case PlyType::kUint8:
        return Take<uint8_t>();
      case PlyType::kInt16:
        return Take<int16_t>();
      case PlyType::kUint16:
        return Take<uint16_t>();
      case PlyType::kInt32:
        return Take<int32_t>();
      case PlyType::kUint32:
        return Take<uint32_t>();
      case PlyType::kFloat32:
        return static_cast<double>(Take<float>());
      case PlyType::kFloat64:
        return Take<double>();
    }
    return 0.0;
  }
  void Skip(PlyType type, int64_t count) {
    if (count > (end_ - p_) / PlyTypeSize(type)) {
      ok_ = false;
      return;
    }
    p_ += count * PlyTypeSize(type);
  }
  bool ok() const { return ok_; }
  const char* position() const { return p_; }
  // A line end behind the last row is let pass.
  const char* EndOfData() const { return end_ - p_ <= 2 ? SkipSpace(p_, end_) : p_; }

 private:
  template <typename T>
  T Take() {
    if (end_ - p_ < static_cast<int64_t>(sizeof(T))) {
      ok_ = false;
      return 0;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, p_, sizeof(T));
    if constexpr (kBigEndian) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    p_ += sizeof(T);
    return value;
  }

  const char* p_;
  const char* end_;
  bool ok_ = true;
};

template <typename Values>
class PlyBodyReader {
 public:
  PlyBodyReader(const SourceText& source, const PlyHeader& header, const ReadScanLimits& limits)
      : source_(source), header_(header), values_(header.body, source.end()), builder_(source, limits) {}

  Result<RawScan> Read() {
    builder_.SetEncoding(header_.encoding);
    for (const std::string_view comment : header_.comments) builder_.AddComment(comment);
    for (const std::string_view info : header_.object_infos) builder_.AddComment(info);
    NoteTexturePath();
    FR_RETURN_IF_ERROR(builder_.BeginObject(header_.body, ""));
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") {
        FR_RETURN_IF_ERROR(ReadVertices(element));
      } else if (element.name == "face") {
        FR_RETURN_IF_ERROR(ReadFaces(element));
      } else if (element.name == "tristrips") {
        FR_RETURN_IF_ERROR(ReadStrips(element));
      } else if (element.name == "range_grid") {
        FR_RETURN_IF_ERROR(ReadGrid(element));
      } else {
        FR_RETURN_IF_ERROR(SkipElement(element));
      }
    }
    const char* const rest = values_.EndOfData();
    if (rest != source_.end()) {
      return source_.ErrorAt(rest, "TRAILING_DATA",
                             "the file goes on behind the last declared row; " + std::string(kReexport));
    }
    FR_RETURN_IF_ERROR(TriangulateGrid());
    FR_RETURN_IF_ERROR(UseVertexTexture());
    builder_.EndObject();
    return builder_.Finish(ScanFormat::kPly);
  }

 private:
  Status CutShort(const char* row) const {
    return source_.ErrorAt(row, "MALFORMED_PLY", "a row cannot be read from here: " + std::string(kReexport));
  }

  // MeshLab names the texture in a comment.
  void NoteTexturePath() {
    constexpr std::string_view kTextureFile = "TextureFile ";
    for (const std::string_view comment : header_.comments) {
      if (comment.starts_with(kTextureFile)) return builder_.SetTexturePath(comment.substr(kTextureFile.size()));
    }
  }

  // Reads a list's length; -1 where it is none.
  int64_t ReadLength(const PlyProperty& property) {
    const double length = values_.Read(property.count_type);
    if (!values_.ok() || !(length >= 0.0 && length <= 4294967295.0) || length != std::floor(length)) return -1;
    return static_cast<int64_t>(length);
  }

  // Reads a vertex index, -1 where it is not one of the vertices (if those are known yet) or no index at all.
  int32_t ReadIndex(PlyType type) {
    const double index = values_.Read(type);
    const double limit = has_vertices_ ? builder_.vertex_count() : std::numeric_limits<int32_t>::max();
    if (!values_.ok() || !(index >= 0.0 && index < limit) || index != std::floor(index)) return -1;
    return static_cast<int32_t>(index);
  }

  bool SkipProperty(const PlyProperty& property) {
    if (!property.is_list) {
      values_.Skip(property.type, 1);
    } else {
      const int64_t length = ReadLength(property);
      if (length < 0) return false;
      values_.Skip(property.type, length);
    }
    return values_.ok();
  }

  Status SkipElement(const PlyElement& element) {
    if (element.properties.empty()) return Status();  // Rows without bytes, however many.
    for (int64_t row = 0; row < element.count; ++row) {
      const char* const start = values_.position();
      for (const PlyProperty& property : element.properties) {
        if (!SkipProperty(property)) return CutShort(start);
      }
    }
    return Status();
  }

  Status ReadVertices(const PlyElement& element);
  Status ReadFaces(const PlyElement& element);
  Status AddPolygon(const char* row);
  Status ReadStrips(const PlyElement& element);
  Status AddStrip(const char* row, const PlyProperty& property);
  Status ReadGrid(const PlyElement& element);
  Status ReadGridSize(const PlyElement& element);
  Status TriangulateGrid();
  Status UseVertexTexture();
  Status BadIndex(const char* row) const {
    return source_.ErrorAt(row, "INDEX_OUT_OF_RANGE",
                           "a face of this row names a vertex that is not there; " + std::string(kReexport));
  }

  const SourceText& source_;
  const PlyHeader& header_;
  Values values_;
  ScanBuilder builder_;
  bool has_vertices_ = false;
  bool has_vertex_texture_ = false;
  RangeGrid grid_;
  std::vector<int32_t> corners_;           // Of the current polygon.
  std::vector<float> corner_coordinates_;  // u and v of each of its corners, where given.
};

template <typename Values>
Status PlyBodyReader<Values>::ReadVertices(const PlyElement& element) {
  const int x = element.FindProperty({"x"}, false);
  const int y = element.FindProperty({"y"}, false);
  const int z = element.FindProperty({"z"}, false);
  if (x < 0 || y < 0 || z < 0) {
    return source_.ErrorAt(element.position, "MALFORMED_PLY",
                           "the vertices need the properties x, y and z; export it again");
  }
  const int u = element.FindProperty({"s", "u", "texture_u"}, false);
  const int v = element.FindProperty({"t", "v", "texture_v"}, false);
  has_vertex_texture_ = u >= 0 && v >= 0;
  if (element.FindProperty({"nx"}, false) >= 0) builder_.SetHasNormals();
  FR_RETURN_IF_ERROR(builder_.AppendVertices(element.position, element.count));
  if (has_vertex_texture_) FR_RETURN_IF_ERROR(builder_.AppendTextureVertices(element.position, element.count));
  for (int64_t row = 0; row < element.count; ++row) {
    const char* const start = values_.position();
    Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
    Eigen::Vector2d texture = Eigen::Vector2d::Zero();
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const PlyProperty& property = element.properties[static_cast<size_t>(i)];
      if (property.is_list) {
        if (!SkipProperty(property)) return CutShort(start);
        continue;
      }
      const double value = values_.Read(property.type);
      if (i == x) vertex.x() = value;
      if (i == y) vertex.y() = value;
      if (i == z) vertex.z() = value;
      if (i == u) texture.x() = value;
      if (i == v) texture.y() = value;
    }
    if (!values_.ok()) return CutShort(start);
    if (!IsUsableCoordinate(vertex)) {
      return source_.ErrorAt(start, "COORDINATE_OUT_OF_RANGE",
                             "coordinates of vertex " + std::to_string(row) +
                                 " must be finite and at most 1e9; repair the scan and export it again");
    }
    builder_.vertices()[row] = vertex;
    if (has_vertex_texture_) {
      const bool is_usable = IsUsableCoordinate(Eigen::Vector3d(texture.x(), texture.y(), 0.0));
      builder_.texture_vertices()[row] = is_usable ? texture.cast<float>().eval() : Eigen::Vector2f::Zero().eval();
    }
  }
  has_vertices_ = true;
  return Status();
}

template <typename Values>
Status PlyBodyReader<Values>::ReadFaces(const PlyElement& element) {
  const int indices = element.FindProperty({"vertex_indices", "vertex_index"}, true);
  const int texture = element.FindProperty({"texcoord"}, true);
  if (indices < 0) return SkipElement(element);
  FR_RETURN_IF_ERROR(builder_.ReserveTriangles(
      element.position, std::min(element.count, static_cast<int64_t>(source_.end() - values_.position()) / 4)));
  for (int64_t row = 0; row < element.count; ++row) {
    const char* const start = values_.position();
    corners_.clear();
    corner_coordinates_.clear();
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const PlyProperty& property = element.properties[static_cast<size_t>(i)];
      if (i != indices && i != texture) {
        if (!SkipProperty(property)) return CutShort(start);
        continue;
      }
      const int64_t length = ReadLength(property);
      if (length < 0 || length > 2 * kMaxPolygonCorners) return CutShort(start);
      for (int64_t k = 0; k < length; ++k) {
        if (i == texture) {
          corner_coordinates_.push_back(static_cast<float>(values_.Read(property.type)));
        } else {
          corners_.push_back(ReadIndex(property.type));
        }
        if (!values_.ok()) return CutShort(start);
        if (i == indices && corners_.back() < 0) return BadIndex(start);
      }
    }
    FR_RETURN_IF_ERROR(AddPolygon(start));
  }
  return Status();
}

// Fans the polygon in corners_ from its first corner.
template <typename Values>
Status PlyBodyReader<Values>::AddPolygon(const char* row) {
  const auto corner_count = static_cast<int64_t>(corners_.size());
  if (corner_count < 3 || corner_count > kMaxPolygonCorners) {
    return source_.ErrorAt(row, "MALFORMED_FACE", "a face needs 3 to 65535 corners; " + std::string(kReexport));
  }
  const int64_t first = builder_.triangle_count();
  FR_RETURN_IF_ERROR(builder_.AppendTriangles(row, corner_count - 2));
  for (int64_t k = 0; k + 2 < corner_count; ++k) {
    const auto at = [&](int64_t i) { return corners_[static_cast<size_t>(i)]; };
    builder_.triangles()[first + k] = Eigen::Vector3i(at(0), at(k + 1), at(k + 2));
  }
  if (static_cast<int64_t>(corner_coordinates_.size()) != 2 * corner_count) return Status();
  const int32_t base = builder_.texture_vertex_count();
  FR_RETURN_IF_ERROR(builder_.AppendTextureVertices(row, corner_count));
  FR_RETURN_IF_ERROR(builder_.AppendTextureTriangles(row, first, corner_count - 2));
  for (int64_t i = 0; i < corner_count; ++i) {
    const float u = corner_coordinates_[static_cast<size_t>(2 * i)];
    const float v = corner_coordinates_[static_cast<size_t>(2 * i + 1)];
    const bool is_usable = std::abs(u) <= 1e9F && std::abs(v) <= 1e9F;
    builder_.texture_vertices()[base + i] = is_usable ? Eigen::Vector2f(u, v) : Eigen::Vector2f(0.0F, 0.0F);
  }
  for (int32_t k = 0; k + 2 < corner_count; ++k) {
    builder_.texture_triangles()[first + k] = Eigen::Vector3i(base, base + k + 1, base + k + 2);
  }
  return Status();
}

template <typename Values>
Status PlyBodyReader<Values>::ReadStrips(const PlyElement& element) {
  const int indices = element.FindProperty({"vertex_indices", "vertex_index"}, true);
  if (indices < 0) return SkipElement(element);
  for (int64_t row = 0; row < element.count; ++row) {
    const char* const start = values_.position();
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const PlyProperty& property = element.properties[static_cast<size_t>(i)];
      if (i == indices) {
        FR_RETURN_IF_ERROR(AddStrip(start, property));
      } else if (!SkipProperty(property)) {
        return CutShort(start);
      }
    }
  }
  return Status();
}

// Reads strips of triangles, which -1 separates. Every other triangle is turned round; those that name a vertex twice
// only steer the strip and are left out.
template <typename Values>
Status PlyBodyReader<Values>::AddStrip(const char* row, const PlyProperty& property) {
  const int64_t length = ReadLength(property);
  if (length < 0) return CutShort(row);
  int32_t a = -1, b = -1;
  bool is_odd = false;
  for (int64_t k = 0; k < length; ++k) {
    const char* const start = values_.position();
    const double value = values_.Read(property.type);
    if (!values_.ok()) return CutShort(start);
    if (value == -1.0) {
      a = b = -1;
      is_odd = false;
      continue;
    }
    const double limit = has_vertices_ ? builder_.vertex_count() : std::numeric_limits<int32_t>::max();
    if (!(value >= 0.0 && value < limit) || value != std::floor(value)) return BadIndex(start);
    const auto c = static_cast<int32_t>(value);
    if (a >= 0 && a != b && b != c && c != a) {
      FR_RETURN_IF_ERROR(builder_.AppendTriangles(start, 1));
      builder_.triangles()[builder_.triangle_count() - 1] =
          is_odd ? Eigen::Vector3i(b, a, c) : Eigen::Vector3i(a, b, c);
    }
    if (a >= 0) is_odd = !is_odd;
    a = b;
    b = c;
  }
  return Status();
}

// Reads "num_cols" and "num_rows" from the obj_info lines.
template <typename Values>
Status PlyBodyReader<Values>::ReadGridSize(const PlyElement& element) {
  const auto read = [&](std::string_view key) -> int64_t {
    for (const std::string_view info : header_.object_infos) {
      if (!info.starts_with(key)) continue;
      return ParseInt(info.data() + key.size(), info.data() + info.size()).value;
    }
    return 0;
  };
  grid_.column_count = read("num_cols ");
  grid_.row_count = read("num_rows ");
  const bool fits = grid_.column_count > 0 && grid_.row_count > 0 && grid_.column_count <= element.count &&
                    grid_.row_count <= element.count && grid_.column_count * grid_.row_count == element.count;
  if (fits) return Status();
  return source_.ErrorAt(element.position, "COUNT_MISMATCH",
                         "the range grid must have num_cols times num_rows places; " + std::string(kReexport));
}

template <typename Values>
Status PlyBodyReader<Values>::ReadGrid(const PlyElement& element) {
  const int indices = element.FindProperty({"vertex_indices", "vertex_index"}, true);
  if (indices < 0) return SkipElement(element);
  FR_RETURN_IF_ERROR(ReadGridSize(element));
  FR_RETURN_IF_ERROR(builder_.ReserveScratch(element.position, element.count * 4));
  grid_.vertex.assign(static_cast<size_t>(element.count), -1);
  for (int64_t row = 0; row < element.count; ++row) {
    const char* const start = values_.position();
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const PlyProperty& property = element.properties[static_cast<size_t>(i)];
      if (i != indices) {
        if (!SkipProperty(property)) return CutShort(start);
        continue;
      }
      const int64_t length = ReadLength(property);
      if (length < 0 || length > 1) return CutShort(start);
      if (length == 0) continue;
      const int32_t index = ReadIndex(property.type);
      if (!values_.ok()) return CutShort(start);
      if (index < 0) return BadIndex(start);
      grid_.vertex[static_cast<size_t>(row)] = index;
    }
  }
  return Status();
}

template <typename Values>
Status PlyBodyReader<Values>::TriangulateGrid() {
  if (grid_.vertex.empty()) return Status();
  for (const int32_t index : grid_.vertex) {
    if (index >= builder_.vertex_count()) return BadIndex(header_.body);
  }
  const RangeGridTriangulator triangulator(grid_, builder_.vertices());
  const int64_t first = builder_.triangle_count();
  FR_RETURN_IF_ERROR(builder_.AppendTriangles(header_.body, triangulator.CountTriangles()));
  triangulator.Write(builder_.triangles() + first);
  return Status();
}

// Texture coordinates that belong to vertices have the triangles' own indices.
template <typename Values>
Status PlyBodyReader<Values>::UseVertexTexture() {
  if (!has_vertex_texture_ || builder_.has_texture_triangles()) return Status();
  FR_RETURN_IF_ERROR(builder_.AppendTextureTriangles(header_.body, 0, builder_.triangle_count()));
  std::copy(builder_.triangles(), builder_.triangles() + builder_.triangle_count(), builder_.texture_triangles());
  return Status();
}

}  // namespace

Result<RawScan> ReadPly(const SourceText& text_source, const ReadScanLimits& limits) {
  SourceText source = text_source;
  FR_ASSIGN_OR_RETURN(const PlyHeader header, ReadPlyHeader(source));
  switch (header.encoding) {
    case ScanEncoding::kBinaryLittleEndian:
      source.SetBinaryFrom(header.body);
      return PlyBodyReader<BinaryValues<false>>(source, header, limits).Read();
    case ScanEncoding::kBinaryBigEndian:
      source.SetBinaryFrom(header.body);
      return PlyBodyReader<BinaryValues<true>>(source, header, limits).Read();
    default:
      return PlyBodyReader<TextValues>(source, header, limits).Read();
  }
}

}  // namespace fitroom
