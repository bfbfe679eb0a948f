#include "common/scan_file/obj_reader.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "common/scan_file/scan_builder.h"

namespace fitroom {
namespace {

constexpr size_t kMaxPolygonCorners = 65535;
constexpr std::string_view kReexport = "the file is damaged or cut short; export it again";

struct Corner {
  int32_t vertex = -1;
  int32_t texture = -1;  // -1 where the corner has none.
};

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

class ObjReader {
 public:
  ObjReader(const SourceText& source, const ReadScanLimits& limits)
      : source_(source), p_(source.begin()), end_(source.end()), builder_(source, limits) {}

  Result<RawScan> Read();

 private:
  Status CountLines();
  Status ReadLine();
  Status ReadVertex(const char* line);
  Status ReadTextureVertex(const char* line);
  Status ReadFace(const char* line);
  bool ReadCorner(Corner& corner);
  bool ReadIndex(int64_t seen, int64_t total, int32_t& index);
  Status AddPolygon(const char* line);
  Status OpenObject(const char* line, std::string name);
  void NoteCount(std::string_view remark);
  Status CheckCounts() const;
  Status SkipLine(const char* line, bool is_data);
  void SkipSeparators();

  const SourceText& source_;
  const char* p_;
  const char* end_;
  ScanBuilder builder_;
  ByteFinder line_ends_{source_.line_end()};
  int64_t vertex_total_ = 0;  // In the whole file: a face may name a vertex that comes later.
  int64_t texture_total_ = 0;
  int64_t face_count_ = 0;
  int64_t told_vertex_count_ = 0;  // By remarks at the head, as some exporters write them; 0 where there are none.
  int64_t told_face_count_ = 0;
  bool has_object_ = false;
  int32_t object_first_triangle_ = 0;
  std::vector<Corner> corners_;  // Of the current polygon.
};

Result<RawScan> ObjReader::Read() {
  FR_RETURN_IF_ERROR(CountLines());
  while ((p_ = SkipSpace(p_, end_)) < end_) FR_RETURN_IF_ERROR(ReadLine());
  if (has_object_) builder_.EndObject();
  FR_RETURN_IF_ERROR(CheckCounts());
  return builder_.Finish(ScanFormat::kObj);
}

// Notes "Vertices: 8" or "Faces: 12", the only counts that an OBJ may hold.
void ObjReader::NoteCount(std::string_view remark) {
  const auto count_behind = [&](std::string_view word) -> int64_t {
    if (!remark.starts_with(word)) return 0;
    return ParseInt(remark.data() + word.size(), remark.data() + remark.size()).value;
  };
  told_vertex_count_ = std::max(told_vertex_count_, count_behind("Vertices:"));
  told_face_count_ = std::max(told_face_count_, count_behind("Faces:"));
}

Status ObjReader::CheckCounts() const {
  if (builder_.vertex_count() >= told_vertex_count_ && face_count_ >= told_face_count_) return Status();
  return source_.ErrorAt(end_, "TRUNCATED_FILE",
                         "the head tells of " + std::to_string(told_vertex_count_) + " vertices and " +
                             std::to_string(told_face_count_) + " faces, but " +
                             std::to_string(builder_.vertex_count()) + " and " + std::to_string(face_count_) +
                             " are there: the file is cut short, export it again");
}

// Counts vertices and faces, so that the arrays are made once and in the right size.
Status ObjReader::CountLines() {
  int64_t face_total = 0;
  for (const char* p = p_; p < end_;) {
    p = SkipSpace(p, end_);
    if (end_ - p > 2 && *p == 'v' && IsBlank(p[1])) ++vertex_total_;
    if (end_ - p > 2 && *p == 'v' && p[1] == 't' && IsBlank(p[2])) ++texture_total_;
    if (end_ - p > 2 && *p == 'f') ++face_total;
    const void* line_end = std::memchr(p, source_.line_end(), static_cast<size_t>(end_ - p));
    p = line_end != nullptr ? static_cast<const char*>(line_end) : end_;
  }
  FR_RETURN_IF_ERROR(builder_.ReserveVertices(p_, vertex_total_));
  FR_RETURN_IF_ERROR(builder_.ReserveTextureVertices(p_, texture_total_));
  return builder_.ReserveTriangles(p_, face_total);
}

// Moves over blanks; a backslash before the end of a line continues it.
void ObjReader::SkipSeparators() {
  for (;;) {
    p_ = SkipBlanks(p_, end_);
    if (end_ - p_ < 2 || *p_ != '\\' || (p_[1] != '\n' && p_[1] != '\r')) return;
    p_ += end_ - p_ > 2 && p_[1] == '\r' && p_[2] == '\n' ? 3 : 2;
  }
}

// Moves to the end of the line. The last line of a file that was cut short has no end: for a line of data that is an
// error, since "12" may have been "123".
Status ObjReader::SkipLine(const char* line, bool is_data) {
  p_ = line_ends_.Find(p_, end_);
  if (p_ < end_ || !is_data) return Status();
  return source_.ErrorAt(line, "TRUNCATED_FILE",
                         "the last line has no end: the file is cut short, export it again (or end the line, if it is "
                         "whole)");
}

Status ObjReader::ReadLine() {
  const char* const line = p_;
  while (p_ < end_ && !IsSpace(*p_)) ++p_;
  const std::string_view word(line, static_cast<size_t>(p_ - line));
  if (word == "v") return ReadVertex(line);
  if (word == "vt") return ReadTextureVertex(line);
  if (word == "f" || word == "fo") return ReadFace(line);
  if (*line != '#' && !IsLetter(*line)) {
    return source_.ErrorAt(
        line, "MALFORMED_OBJ",
        "expected a line of an OBJ but found " + source_.QuoteAt(line) + "; " + std::string(kReexport));
  }
  const char* const rest = SkipBlanks(p_, end_);
  FR_RETURN_IF_ERROR(SkipLine(line, false));
  const char* rest_end = std::max(rest, p_);
  while (rest_end > rest && IsSpace(rest_end[-1])) --rest_end;
  const std::string_view text(rest, static_cast<size_t>(rest_end - rest));
  if (word == "vn") builder_.SetHasNormals();
  if (word == "o" || word == "g") return OpenObject(line, CleanText(text));
  if (*line == '#' && builder_.vertex_count() == 0 && !text.empty()) {
    builder_.AddComment(text);
    NoteCount(text);
  }
  return Status();
}

// Faces that follow belong to the new object. One that has no faces yet only changes its name: exporters write the
// object, its vertices, then its group.
Status ObjReader::OpenObject(const char* line, std::string name) {
  if (has_object_ && builder_.triangle_count() == object_first_triangle_) {
    builder_.RenameObject(std::move(name));
    return Status();
  }
  if (has_object_) builder_.EndObject();
  has_object_ = true;
  object_first_triangle_ = builder_.triangle_count();
  return builder_.BeginObject(line, std::move(name));
}

Status ObjReader::ReadVertex(const char* line) {
  if (!has_object_) FR_RETURN_IF_ERROR(OpenObject(line, ""));
  Eigen::Vector3d vertex;
  for (int axis = 0; axis < 3; ++axis) {
    SkipSeparators();
    const auto coordinate = ParseDouble(p_, end_);
    if (coordinate.next == nullptr || (coordinate.next < end_ && !IsSpace(*coordinate.next))) {
      return builder_.MalformedCoordinates(line);
    }
    vertex[axis] = coordinate.value;
    p_ = coordinate.next;
  }
  if (!IsUsableCoordinate(vertex)) return builder_.UnusableCoordinates(line);
  FR_RETURN_IF_ERROR(builder_.AppendVertices(line, 1));
  builder_.vertices()[builder_.vertex_count() - 1] = vertex;
  return SkipLine(line, true);  // A weight or a colour may follow.
}

Status ObjReader::ReadTextureVertex(const char* line) {
  SkipSeparators();
  const auto u = ParseDouble(p_, end_);
  if (u.next == nullptr) return builder_.MalformedCoordinates(line);
  p_ = u.next;
  SkipSeparators();
  const auto v = ParseDouble(p_, end_);  // A one-dimensional texture has none.
  const Eigen::Vector3d point(u.value, v.value, 0.0);
  if (!IsUsableCoordinate(point)) return builder_.UnusableCoordinates(line);
  FR_RETURN_IF_ERROR(builder_.AppendTextureVertices(line, 1));
  builder_.texture_vertices()[builder_.texture_vertex_count() - 1] = point.head<2>().cast<float>();
  return SkipLine(line, true);
}

// Reads an index from 1, or a negative one that counts back from the `seen` entries so far.
bool ObjReader::ReadIndex(int64_t seen, int64_t total, int32_t& index) {
  const auto number = ParseInt(p_, end_);
  if (number.next == nullptr || number.value == 0) return false;
  const int64_t from_zero = number.value > 0 ? number.value - 1 : seen + number.value;
  if (from_zero < 0 || from_zero >= total) return false;
  index = static_cast<int32_t>(from_zero);
  p_ = number.next;
  return true;
}

// Reads "v", "v/t", "v//n" or "v/t/n".
bool ObjReader::ReadCorner(Corner& corner) {
  if (!ReadIndex(builder_.vertex_count(), vertex_total_, corner.vertex)) return false;
  if (p_ == end_ || *p_ != '/') return true;
  ++p_;
  if (p_ < end_ && *p_ != '/' && !ReadIndex(builder_.texture_vertex_count(), texture_total_, corner.texture)) {
    return false;
  }
  if (p_ == end_ || *p_ != '/') return true;
  const auto normal = ParseInt(p_ + 1, end_);
  if (normal.next == nullptr) return false;
  p_ = normal.next;
  return true;
}

Status ObjReader::ReadFace(const char* line) {
  if (!has_object_) FR_RETURN_IF_ERROR(OpenObject(line, ""));
  corners_.clear();
  for (;;) {
    SkipSeparators();
    if (p_ == end_ || *p_ == '\n' || *p_ == '\r' || *p_ == '#') break;
    Corner corner;
    if (!ReadCorner(corner) || (p_ < end_ && !IsSpace(*p_))) {
      return source_.ErrorAt(line, "INDEX_OUT_OF_RANGE",
                             "a face needs numbers of vertices that are there, but found " + source_.QuoteAt(p_) +
                                 "; " + std::string(kReexport));
    }
    if (corners_.size() == kMaxPolygonCorners) break;
    corners_.push_back(corner);
  }
  FR_RETURN_IF_ERROR(SkipLine(line, true));
  return AddPolygon(line);
}

// Fans the polygon in corners_ from its first corner.
Status ObjReader::AddPolygon(const char* line) {
  if (corners_.size() < 3 || corners_.size() == kMaxPolygonCorners) {
    return source_.ErrorAt(line, "MALFORMED_FACE", "a face needs 3 to 65534 corners; " + std::string(kReexport));
  }
  ++face_count_;
  const int64_t first = builder_.triangle_count();
  const auto count = static_cast<int64_t>(corners_.size()) - 2;
  FR_RETURN_IF_ERROR(builder_.AppendTriangles(line, count));
  const bool is_textured =
      std::all_of(corners_.begin(), corners_.end(), [](const Corner& corner) { return corner.texture >= 0; });
  if (is_textured) FR_RETURN_IF_ERROR(builder_.AppendTextureTriangles(line, first, count));
  for (int64_t k = 0; k < count; ++k) {
    const Corner& a = corners_[0];
    const Corner& b = corners_[static_cast<size_t>(k + 1)];
    const Corner& c = corners_[static_cast<size_t>(k + 2)];
    builder_.triangles()[first + k] = Eigen::Vector3i(a.vertex, b.vertex, c.vertex);
    if (is_textured) builder_.texture_triangles()[first + k] = Eigen::Vector3i(a.texture, b.texture, c.texture);
  }
  return Status();
}

}  // namespace

Result<RawScan> ReadObj(const SourceText& source, const ReadScanLimits& limits) {
  return ObjReader(source, limits).Read();
}

}  // namespace fitroom
