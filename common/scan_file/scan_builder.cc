#include "common/scan_file/scan_builder.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace fitroom {
namespace {

constexpr size_t kMaxCommentCount = 64;
constexpr int64_t kFixedMemory = int64_t{48} << 20;  // Beside twice the file's size (unit: byte).

// A vector that is full doubles: while it moves, the old and the new array exist. Appending to an empty one, as most
// files do, takes exactly what is asked.
template <typename T>
int64_t GrowthBytes(const std::vector<T>& values, int64_t count) {
  const auto size = static_cast<int64_t>(values.size());
  if (size + count <= static_cast<int64_t>(values.capacity())) return 0;
  return static_cast<int64_t>(sizeof(T)) * std::max(size + count, 2 * size);
}

template <typename T>
void Append(std::vector<T>& values, int64_t count, const T& value) {
  values.resize(values.size() + static_cast<size_t>(count), value);
}

}  // namespace

ScanBuilder::ScanBuilder(const SourceText& source, const ReadScanLimits& limits)
    : source_(source), limits_(limits), memory_left_(2 * static_cast<int64_t>(source.text().size()) + kFixedMemory) {}

Status ScanBuilder::Reserve(const char* position, int64_t bytes) {
  if (bytes > memory_left_) {
    return source_.TooMuchAt(position, "SCAN_TOO_LARGE",
                             "the file unfolds into more memory than its size allows; export a plain triangle mesh");
  }
  memory_left_ -= bytes;
  return Status();
}

Status ScanBuilder::BeginObject(const char* position, std::string name) {
  if (static_cast<int64_t>(scan_.objects.size()) >= limits_.max_object_count) {
    return source_.TooMuchAt(
        position, "TOO_MANY_OBJECTS",
        "more than " + std::to_string(limits_.max_object_count) + " objects; export the body alone, as one object");
  }
  ScanObject object;
  object.name = std::move(name);
  object.first_vertex = vertex_count();
  object.first_triangle = triangle_count();
  scan_.objects.push_back(std::move(object));
  return Status();
}

void ScanBuilder::EndObject() {
  ScanObject& object = scan_.objects.back();
  object.vertex_count = vertex_count() - object.first_vertex;
  object.triangle_count = triangle_count() - object.first_triangle;
}

Status ScanBuilder::AppendVertices(const char* position, int64_t count) {
  if (vertex_count() + count > limits_.max_vertex_count) {
    return source_.TooMuchAt(
        position, "TOO_MANY_VERTICES",
        "more than " + std::to_string(limits_.max_vertex_count) + " vertices; thin the scan out before exporting it");
  }
  FR_RETURN_IF_ERROR(Reserve(position, GrowthBytes(scan_.mesh.vertices, count)));
  const Eigen::Vector3d unset = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Append(scan_.mesh.vertices, count, unset);
  return Status();
}

Status ScanBuilder::AppendTriangles(const char* position, int64_t count) {
  if (triangle_count() + count > limits_.max_triangle_count) {
    return source_.TooMuchAt(position, "TOO_MANY_TRIANGLES",
                             "more than " + std::to_string(limits_.max_triangle_count) +
                                 " triangles; thin the scan out before exporting it");
  }
  FR_RETURN_IF_ERROR(Reserve(position, GrowthBytes(scan_.mesh.triangles, count)));
  const Eigen::Vector3i unset = Eigen::Vector3i::Constant(-1);
  Append(scan_.mesh.triangles, count, unset);
  return Status();
}

template <typename T>
Status ScanBuilder::ReserveIn(std::vector<T>& values, const char* position, int64_t count) {
  FR_RETURN_IF_ERROR(Reserve(position, GrowthBytes(values, count)));
  values.reserve(values.size() + static_cast<size_t>(count));
  return Status();
}

Status ScanBuilder::ReserveVertices(const char* position, int64_t count) {
  return ReserveIn(scan_.mesh.vertices, position, count);
}

Status ScanBuilder::ReserveTriangles(const char* position, int64_t count) {
  return ReserveIn(scan_.mesh.triangles, position, count);
}

Status ScanBuilder::ReserveTextureVertices(const char* position, int64_t count) {
  return ReserveIn(scan_.texture_coordinates, position, count);
}

Status ScanBuilder::AppendTextureVertices(const char* position, int64_t count) {
  if (texture_vertex_count() + count > 3 * limits_.max_triangle_count) {
    return source_.TooMuchAt(position, "TOO_MANY_VERTICES",
                             "too many texture vertices; thin the scan out before exporting it");
  }
  FR_RETURN_IF_ERROR(Reserve(position, GrowthBytes(scan_.texture_coordinates, count)));
  const Eigen::Vector2f unset = Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  Append(scan_.texture_coordinates, count, unset);
  return Status();
}

Status ScanBuilder::AppendTextureTriangles(const char* position, int64_t first_triangle, int64_t count) {
  const int64_t missing = first_triangle + count - static_cast<int64_t>(scan_.texture_triangles.size());
  if (missing <= 0) return Status();
  FR_RETURN_IF_ERROR(Reserve(position, GrowthBytes(scan_.texture_triangles, missing)));
  const Eigen::Vector3i unset = Eigen::Vector3i::Constant(-1);
  Append(scan_.texture_triangles, missing, unset);
  return Status();
}

void ScanBuilder::AddComment(std::string_view comment) {
  if (scan_.comments.size() < kMaxCommentCount) scan_.comments.push_back(CleanText(comment));
}

Status ScanBuilder::MalformedCoordinates(const char* position) const {
  const char* const text = SkipBlanks(position, source_.end());
  return source_.ErrorAt(text, "MALFORMED_NUMBER",
                         "expected coordinates with a decimal point but found " + source_.QuoteAt(text) +
                             "; the file is damaged or was written with a decimal comma: export it again");
}

Status ScanBuilder::UnusableCoordinates(const char* position) const {
  const char* const text = SkipBlanks(position, source_.end());
  return source_.ErrorAt(text, "COORDINATE_OUT_OF_RANGE",
                         "coordinates must be finite and at most 1e9 but are " + source_.QuoteAt(text) +
                             "; repair the scan and export it again");
}

Result<RawScan> ScanBuilder::Finish(ScanFormat format) {
  const TriangleMesh& mesh = scan_.mesh;
  const char* const end = source_.end();
  if (mesh.vertices.empty()) {
    return source_.ErrorAt(end, "NO_MESH", "the file holds no mesh; export the body as an editable mesh");
  }
  if (mesh.triangles.empty()) {
    return source_.ErrorAt(end, "NO_TRIANGLES",
                           "the file holds points but no triangles; mesh the scan, then export it");
  }
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!IsUsableCoordinate(vertex)) {
      return source_.ErrorAt(end, "COORDINATE_OUT_OF_RANGE",
                             "coordinates must be finite and at most 1e9; repair the scan and export it again");
    }
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    if (triangle.minCoeff() < 0 || triangle.maxCoeff() >= vertex_count()) {
      return source_.ErrorAt(end, "INDEX_OUT_OF_RANGE",
                             "a face names a vertex that is not there; the file is damaged: export it again");
    }
    const bool is_degenerate = triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (is_degenerate) ++scan_.degenerate_triangle_count;
  }
  if (scan_.degenerate_triangle_count == triangle_count()) {
    return source_.ErrorAt(end, "NO_TRIANGLES",
                           "every triangle names a vertex twice: there is no surface; export again");
  }
  if (!scan_.texture_triangles.empty()) {
    FR_RETURN_IF_ERROR(AppendTextureTriangles(end, 0, triangle_count()));
  }
  for (const Eigen::Vector3i& triangle : scan_.texture_triangles) {
    if (triangle.maxCoeff() >= texture_vertex_count()) {
      return source_.ErrorAt(end, "INDEX_OUT_OF_RANGE",
                             "a face names a texture vertex that is not there; the file is damaged: export it again");
    }
  }
  scan_.format = format;
  return std::move(scan_);
}

}  // namespace fitroom
