#include "common/scan_file/ase_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "common/scan_file/scan_builder.h"

namespace fitroom {
namespace {

constexpr std::string_view kReexport = "the file is damaged or cut short; export it again";

// What one *MESH block declared and what of it was read.
struct MeshProgress {
  const char* start = nullptr;  // Where the block begins, for messages.
  std::optional<int64_t> vertex_count, triangle_count, texture_vertex_count, texture_triangle_count;
  int64_t read_vertices = 0, read_triangles = 0, read_texture_vertices = 0, read_texture_triangles = 0;
  int32_t first_vertex = 0, first_triangle = 0, first_texture_vertex = 0;
};

bool StartsWith(const char* position, const char* end, std::string_view word) {
  return static_cast<size_t>(end - position) > word.size() && std::memcmp(position, word.data(), word.size()) == 0 &&
         IsSpace(position[word.size()]);
}

// A recursive-descent reader without recursion: nesting that is not read is skipped by counting braces.
class AseReader {
 public:
  AseReader(const SourceText& source, const ReadScanLimits& limits)
      : source_(source), p_(source.begin()), end_(source.end()), builder_(source, limits) {
    // Some exporters end a text with NUL or Control-Z.
    while (end_ > p_ && (end_[-1] == '\0' || end_[-1] == '\x1A')) --end_;
  }

  Result<RawScan> Read() {
    FR_RETURN_IF_ERROR(ReadTopLevel());
    return builder_.Finish(ScanFormat::kAse);
  }

 private:
  Status ReadTopLevel();
  Status ReadGeomObject();
  Status ReadMesh();
  Status ReadMeshKeyword(std::string_view keyword, MeshProgress& mesh);
  Status FinishMesh(const MeshProgress& mesh) const;
  Status MisplacedList(std::string_view list, std::string_view count) const;
  Status ReadCount(std::string_view what, int64_t min_entry_size, std::optional<int64_t>& count);
  template <typename ReadEntry>
  Status ReadList(std::string_view entry_keyword, const ReadEntry& read_entry);
  Status ReadVertexList(MeshProgress& mesh);
  Status ReadFaceList(MeshProgress& mesh);
  Status ReadTextureVertexList(MeshProgress& mesh);
  Status ReadTextureFaceList(MeshProgress& mesh);

  int64_t ReadIndex(std::string_view what, int64_t count);
  bool SkipLabel(char letter);
  void SkipLine();
  // Says whether a number was read and a word ends behind it: "1,5" and "1.2.3" are no numbers.
  bool EndsWord(const char* next) const { return next != nullptr && (next == end_ || IsSpace(*next) || *next == '}'); }
  bool Fail(Status status);
  bool FailTwice(const char* position, std::string_view what, int64_t index);
  void ReadMaterials();

  std::string_view ReadKeyword();
  std::string_view ReadQuoted();
  Status SkipValue();
  Status SkipBlock();
  Status EnterBlock();
  bool AtBlockEnd();
  Status ErrorHere(std::string reason, std::string_view message) const {
    return source_.ErrorAt(p_, std::move(reason), message);
  }
  Status UnexpectedHere() const;

  const SourceText& source_;
  const char* p_;
  const char* end_;
  ScanBuilder builder_;
  bool has_materials_ = false;
  Status failure_;  // Why the last entry of a list could not be read.
  ByteFinder open_{'{'}, close_{'}'}, quote_{'"'}, line_end_{source_.line_end()};
};

// Reads the keyword behind '*', on which the cursor stands.
std::string_view AseReader::ReadKeyword() {
  const char* start = ++p_;
  while (p_ < end_ && ((*p_ >= 'A' && *p_ <= 'Z') || *p_ == '_' || IsDigit(*p_) || (*p_ >= 'a' && *p_ <= 'z'))) ++p_;
  return {start, static_cast<size_t>(p_ - start)};
}

// Reads "text" on the current line; empty, with nothing consumed, where there is none.
std::string_view AseReader::ReadQuoted() {
  const char* start = SkipBlanks(p_, end_);
  if (start == end_ || *start != '"') return {};
  ++start;
  const char* line_end = line_end_.Find(start, end_);
  const char* close = quote_.Find(start, end_);
  if (close >= line_end) return {};
  p_ = close + 1;
  return {start, static_cast<size_t>(close - start)};
}

// Skips what belongs to a keyword that is not read: the rest of its line up to the next keyword or closing brace, and
// the block that opens there.
Status AseReader::SkipValue() {
  while (p_ < end_) {
    const char c = *p_;
    if (c == source_.line_end() || c == '}') return Status();
    if (c == '*' && IsBlank(p_[-1])) return Status();
    ++p_;
    if (c == '{') return SkipBlock();
    if (c == '"') {
      const char* close = quote_.Find(p_, end_);
      if (close < line_end_.Find(p_, end_)) p_ = close + 1;
    }
  }
  return Status();
}

// Skips to behind the brace that closes the block whose opening brace lies before the cursor. Braces in quotes on one
// line do not count.
Status AseReader::SkipBlock() {
  const char* const start = p_;
  int64_t depth = 1;
  while (depth > 0) {
    const char* close = close_.Find(p_, end_);
    const char* open = open_.Find(p_, end_);
    const char* quote = quote_.Find(p_, end_);
    const char* next = std::min({close, open, quote});
    if (next == end_) {
      return source_.ErrorAt(start, "UNBALANCED_BLOCK", "this block is never closed: " + std::string(kReexport));
    }
    p_ = next + 1;
    if (next == open) ++depth;
    if (next == close) --depth;
    if (next == quote) {
      const char* line_end = line_end_.Find(p_, end_);
      const char* closing_quote = quote_.Find(p_, end_);
      p_ = closing_quote < line_end ? closing_quote + 1 : line_end;
    }
  }
  return Status();
}

// Moves behind the '{' that must follow.
Status AseReader::EnterBlock() {
  p_ = SkipSpace(p_, end_);
  if (p_ == end_ || *p_ != '{') {
    return ErrorHere("MALFORMED_ASE", "expected '{' but found " + source_.QuoteAt(p_) + "; " + std::string(kReexport));
  }
  ++p_;
  return Status();
}

// Moves over blanks and says whether the current block ends here, moving behind its brace.
bool AseReader::AtBlockEnd() {
  p_ = SkipSpace(p_, end_);
  if (p_ == end_ || *p_ != '}') return false;
  ++p_;
  return true;
}

Status AseReader::UnexpectedHere() const {
  if (p_ == end_) {
    return ErrorHere("UNBALANCED_BLOCK", "the file ends inside a block: it is cut short; export it again");
  }
  return ErrorHere("MALFORMED_ASE",
                   "expected a keyword but found " + source_.QuoteAt(p_) + "; " + std::string(kReexport));
}

Status AseReader::ReadTopLevel() {
  int64_t group_depth = 0;
  const char* group_start = p_;
  while ((p_ = SkipSpace(p_, end_)) < end_) {
    if (*p_ == '}' && group_depth > 0) {
      ++p_;
      --group_depth;
      continue;
    }
    if (*p_ == '}') return ErrorHere("UNBALANCED_BLOCK", "'}' closes no block; " + std::string(kReexport));
    if (*p_ != '*') return UnexpectedHere();
    const char* const start = p_;
    const std::string_view keyword = ReadKeyword();
    if (keyword == "GEOMOBJECT") {
      FR_RETURN_IF_ERROR(ReadGeomObject());
    } else if (keyword == "GROUP") {
      ReadQuoted();
      p_ = std::min(open_.Find(p_, end_), line_end_.Find(p_, end_));  // A name may hold a quote itself.
      FR_RETURN_IF_ERROR(EnterBlock());
      if (group_depth++ == 0) group_start = start;
    } else if (keyword == "MATERIAL_LIST") {
      if (!has_materials_) ReadMaterials();
      has_materials_ = true;
      FR_RETURN_IF_ERROR(SkipValue());
    } else if (keyword == "COMMENT") {
      if (const std::string_view comment = ReadQuoted(); !comment.empty()) builder_.AddComment(comment);
      FR_RETURN_IF_ERROR(SkipValue());
    } else {
      FR_RETURN_IF_ERROR(SkipValue());
    }
  }
  if (group_depth > 0) {
    return source_.ErrorAt(group_start, "UNBALANCED_BLOCK", "this group is never closed: " + std::string(kReexport));
  }
  return Status();
}

// Notes the first bitmap of the material list, the diffuse one if a map says so. Does not move the cursor.
void AseReader::ReadMaterials() {
  // A material list is a few kilobytes; a bitmap named beyond the first MiB is not looked for.
  const std::string_view list(p_, std::min<size_t>(static_cast<size_t>(end_ - p_), size_t{1} << 20));
  const size_t list_end = std::min(list.find("*GEOMOBJECT"), list.size());
  size_t map = list.find("*MAP_DIFFUSE");
  if (map >= list_end) map = 0;
  constexpr std::string_view kBitmap = "*BITMAP \"";
  const size_t bitmap = list.find(kBitmap, map);
  if (bitmap >= list_end) return;
  const std::string_view rest = list.substr(bitmap + kBitmap.size());
  const size_t length = rest.find_first_of("\"\r\n");
  if (length != std::string_view::npos && rest[length] == '"') builder_.SetTexturePath(rest.substr(0, length));
}

Status AseReader::ReadGeomObject() {
  FR_RETURN_IF_ERROR(EnterBlock());
  const char* const start = p_;
  std::string name;
  bool has_mesh = false;
  while (!AtBlockEnd()) {
    if (p_ == end_) {
      return source_.ErrorAt(start, "UNBALANCED_BLOCK", "this GEOMOBJECT is never closed: " + std::string(kReexport));
    }
    if (*p_ != '*') return UnexpectedHere();
    const std::string_view keyword = ReadKeyword();
    if (keyword == "NODE_NAME" && name.empty()) {
      name = CleanText(ReadQuoted());
      FR_RETURN_IF_ERROR(SkipValue());  // A name may hold a quote itself.
    } else if (keyword == "MESH" && !has_mesh) {
      has_mesh = true;
      FR_RETURN_IF_ERROR(builder_.BeginObject(p_, name));
      FR_RETURN_IF_ERROR(ReadMesh());
      builder_.EndObject();
    } else {
      FR_RETURN_IF_ERROR(SkipValue());
    }
  }
  return Status();
}

Status AseReader::ReadMesh() {
  FR_RETURN_IF_ERROR(EnterBlock());
  MeshProgress mesh;
  mesh.start = p_;
  mesh.first_vertex = builder_.vertex_count();
  mesh.first_triangle = builder_.triangle_count();
  mesh.first_texture_vertex = builder_.texture_vertex_count();
  while (!AtBlockEnd()) {
    if (p_ == end_ || *p_ != '*') return UnexpectedHere();
    const std::string_view keyword = ReadKeyword();
    FR_RETURN_IF_ERROR(ReadMeshKeyword(keyword, mesh));
  }
  return FinishMesh(mesh);
}

Status AseReader::ReadMeshKeyword(std::string_view keyword, MeshProgress& mesh) {
  // The smallest entries: "*MESH_VERTEX 0 0 0 0", "*MESH_FACE 0:A:0B:0C:0", "*MESH_TVERT 0 0 0", "*MESH_TFACE 0 0 0 0".
  if (keyword == "MESH_NUMVERTEX") return ReadCount("vertices", 20, mesh.vertex_count);
  if (keyword == "MESH_NUMFACES") return ReadCount("faces", 22, mesh.triangle_count);
  if (keyword == "MESH_NUMTVERTEX") return ReadCount("texture vertices", 17, mesh.texture_vertex_count);
  if (keyword == "MESH_NUMTVFACES") return ReadCount("texture faces", 19, mesh.texture_triangle_count);
  if (keyword == "MESH_VERTEX_LIST") return ReadVertexList(mesh);
  if (keyword == "MESH_FACE_LIST") return ReadFaceList(mesh);
  if (keyword == "MESH_TVERTLIST") return ReadTextureVertexList(mesh);
  if (keyword == "MESH_TFACELIST") return ReadTextureFaceList(mesh);
  if (keyword == "MESH_NORMALS") builder_.SetHasNormals();
  return SkipValue();
}

// Reads a declared count. Every entry takes some bytes, so a count that the rest of the file cannot hold is a lie and
// nothing is allocated for it.
Status AseReader::ReadCount(std::string_view what, int64_t min_entry_size, std::optional<int64_t>& count) {
  const auto number = ParseInt(p_, end_);
  if (number.next == nullptr || number.value < 0 || (number.next < end_ && !IsSpace(*number.next))) {
    return ErrorHere("INVALID_COUNT", "expected the number of " + std::string(what) + " but found " +
                                          source_.QuoteAt(SkipBlanks(p_, end_)) + "; " + std::string(kReexport));
  }
  if (count.has_value()) {
    return ErrorHere("DUPLICATE_COUNT", "the number of " + std::string(what) + " is declared twice; export it again");
  }
  if (number.value > (end_ - p_) / min_entry_size + 1) {
    return ErrorHere("INVALID_COUNT", std::to_string(number.value) + " " + std::string(what) +
                                          " are declared, more than the rest of the file can hold; " +
                                          std::string(kReexport));
  }
  p_ = number.next;
  count = number.value;
  return Status();
}

// Reads the entries of a list block. read_entry() gets the cursor behind the entry's keyword and says whether it went
// well; if not, failure_ tells why. (A Status an entry would cost as much as the parsing.)
template <typename ReadEntry>
Status AseReader::ReadList(std::string_view entry_keyword, const ReadEntry& read_entry) {
  FR_RETURN_IF_ERROR(EnterBlock());
  const char* const start = p_;
  while (!AtBlockEnd()) {
    if (p_ == end_) {
      return source_.ErrorAt(start, "UNBALANCED_BLOCK", "this list is never closed: " + std::string(kReexport));
    }
    if (*p_ != '*') return UnexpectedHere();
    if (StartsWith(p_ + 1, end_, entry_keyword)) {
      p_ += 1 + entry_keyword.size();
      if (!read_entry()) return failure_;
    } else {
      ReadKeyword();
      FR_RETURN_IF_ERROR(SkipValue());
    }
  }
  return Status();
}

bool AseReader::Fail(Status status) {
  failure_ = std::move(status);
  return false;
}

// Reads an integer in [0, count), or returns -1 with failure_ set. `what` names it in messages.
int64_t AseReader::ReadIndex(std::string_view what, int64_t count) {
  const auto index = ParseInt(p_, end_);
  if (index.next != nullptr && index.value >= 0 && index.value < count) {
    p_ = index.next;
    return index.value;
  }
  const std::string found = source_.QuoteAt(SkipBlanks(p_, end_));
  if (index.next == nullptr) {
    Fail(ErrorHere("MALFORMED_NUMBER", "expected a number of a " + std::string(what) + " but found " + found + "; " +
                                           std::string(kReexport)));
  } else {
    Fail(ErrorHere("INDEX_OUT_OF_RANGE", std::string(what) + " " + std::to_string(index.value) + " is not one of the " +
                                             std::to_string(count) + " declared; " + std::string(kReexport)));
  }
  return -1;
}

// Moves behind `letter` and a colon, both after blanks; false if they do not follow.
bool AseReader::SkipLabel(char letter) {
  const char* p = SkipBlanks(p_, end_);
  if (letter != '\0') {
    if (p == end_ || *p != letter) return false;
    p = SkipBlanks(p + 1, end_);
  }
  if (p == end_ || *p != ':') return false;
  p_ = p + 1;
  return true;
}

// Moves to the end of the line, or to a closing brace before it.
void AseReader::SkipLine() { p_ = std::min(line_end_.Find(p_, end_), close_.Find(p_, end_)); }

bool AseReader::FailTwice(const char* position, std::string_view what, int64_t index) {
  return Fail(
      source_.ErrorAt(position, "DUPLICATE_INDEX",
                      std::string(what) + " " + std::to_string(index) + " is given twice; " + std::string(kReexport)));
}

Status AseReader::ReadVertexList(MeshProgress& mesh) {
  if (!mesh.vertex_count || mesh.read_vertices > 0) return MisplacedList("vertex list", "MESH_NUMVERTEX");
  const int64_t count = *mesh.vertex_count;
  FR_RETURN_IF_ERROR(builder_.AppendVertices(p_, count));
  Eigen::Vector3d* const vertices = builder_.vertices() + mesh.first_vertex;
  return ReadList("MESH_VERTEX", [&] {
    const int64_t index = ReadIndex("vertex", count);
    if (index < 0) return false;
    const char* const start = p_;
    Eigen::Vector3d vertex;
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = ParseDouble(p_, end_);
      if (!EndsWord(coordinate.next)) return Fail(builder_.MalformedCoordinates(start));
      vertex[axis] = coordinate.value;
      p_ = coordinate.next;
    }
    if (!IsUsableCoordinate(vertex)) return Fail(builder_.UnusableCoordinates(start));
    if (!std::isnan(vertices[index].x())) return FailTwice(start, "vertex", index);
    vertices[index] = vertex;
    ++mesh.read_vertices;
    SkipLine();
    return true;
  });
}

Status AseReader::ReadFaceList(MeshProgress& mesh) {
  if (!mesh.triangle_count || mesh.read_triangles > 0) return MisplacedList("face list", "MESH_NUMFACES");
  if (!mesh.vertex_count) return MisplacedList("face list", "MESH_NUMVERTEX");
  const int64_t count = *mesh.triangle_count;
  FR_RETURN_IF_ERROR(builder_.AppendTriangles(p_, count));
  Eigen::Vector3i* const triangles = builder_.triangles() + mesh.first_triangle;
  return ReadList("MESH_FACE", [&] {
    const char* const start = p_;
    const int64_t index = ReadIndex("face", count);
    if (index < 0) return false;
    bool well_formed = SkipLabel('\0');
    Eigen::Vector3i triangle;
    for (int corner = 0; corner < 3 && well_formed; ++corner) {
      well_formed = SkipLabel(static_cast<char>('A' + corner));
      if (!well_formed) break;
      const int64_t vertex = ReadIndex("vertex", *mesh.vertex_count);
      if (vertex < 0) return false;
      triangle[corner] = mesh.first_vertex + static_cast<int32_t>(vertex);
    }
    if (!well_formed) {
      return Fail(source_.ErrorAt(start, "MALFORMED_ASE",
                                  "expected \"*MESH_FACE number: A: a B: b C: c\"; " + std::string(kReexport)));
    }
    if (triangles[index].x() >= 0) return FailTwice(start, "face", index);
    triangles[index] = triangle;
    ++mesh.read_triangles;
    SkipLine();
    return true;
  });
}

Status AseReader::ReadTextureVertexList(MeshProgress& mesh) {
  if (!mesh.texture_vertex_count || mesh.read_texture_vertices > 0) {
    return MisplacedList("texture vertex list", "MESH_NUMTVERTEX");
  }
  const int64_t count = *mesh.texture_vertex_count;
  FR_RETURN_IF_ERROR(builder_.AppendTextureVertices(p_, count));
  Eigen::Vector2f* const coordinates = builder_.texture_vertices() + mesh.first_texture_vertex;
  return ReadList("MESH_TVERT", [&] {
    const int64_t index = ReadIndex("texture vertex", count);
    if (index < 0) return false;
    const char* const start = p_;
    const auto u = ParseDouble(p_, end_);
    const auto v = EndsWord(u.next) ? ParseDouble(u.next, end_) : ParsedNumber<double>();
    if (!EndsWord(v.next)) return Fail(builder_.MalformedCoordinates(start));
    if (!IsUsableCoordinate(Eigen::Vector3d(u.value, v.value, 0))) return Fail(builder_.UnusableCoordinates(start));
    if (!std::isnan(coordinates[index].x())) return FailTwice(start, "texture vertex", index);
    coordinates[index] = Eigen::Vector2f(static_cast<float>(u.value), static_cast<float>(v.value));
    ++mesh.read_texture_vertices;
    p_ = v.next;
    SkipLine();
    return true;
  });
}

Status AseReader::ReadTextureFaceList(MeshProgress& mesh) {
  if (!mesh.texture_triangle_count || mesh.read_texture_triangles > 0) {
    return MisplacedList("texture face list", "MESH_NUMTVFACES");
  }
  if (!mesh.texture_vertex_count) return MisplacedList("texture face list", "MESH_NUMTVERTEX");
  const int64_t count = *mesh.texture_triangle_count;
  if (!mesh.triangle_count || mesh.read_triangles == 0 || count != *mesh.triangle_count) {
    return ErrorHere("COUNT_MISMATCH", "texture faces must follow the faces and be as many; " + std::string(kReexport));
  }
  FR_RETURN_IF_ERROR(builder_.AppendTextureTriangles(p_, mesh.first_triangle, count));
  Eigen::Vector3i* const triangles = builder_.texture_triangles() + mesh.first_triangle;
  return ReadList("MESH_TFACE", [&] {
    const char* const start = p_;
    const int64_t index = ReadIndex("texture face", count);
    if (index < 0) return false;
    Eigen::Vector3i triangle;
    for (int corner = 0; corner < 3; ++corner) {
      const int64_t vertex = ReadIndex("texture vertex", *mesh.texture_vertex_count);
      if (vertex < 0) return false;
      triangle[corner] = mesh.first_texture_vertex + static_cast<int32_t>(vertex);
    }
    if (triangles[index].x() >= 0) return FailTwice(start, "texture face", index);
    triangles[index] = triangle;
    ++mesh.read_texture_triangles;
    SkipLine();
    return true;
  });
}

Status AseReader::MisplacedList(std::string_view list, std::string_view count) const {
  return ErrorHere("MALFORMED_ASE", "the " + std::string(list) + " must come once and after " + std::string(count) +
                                        "; " + std::string(kReexport));
}

// Checks that every list held as many entries as were declared.
Status AseReader::FinishMesh(const MeshProgress& mesh) const {
  const auto check = [&](std::string_view what, const std::optional<int64_t>& declared, int64_t read) -> Status {
    if (declared.value_or(0) == read) return Status();
    return source_.ErrorAt(mesh.start, "COUNT_MISMATCH",
                           std::to_string(declared.value_or(0)) + " " + std::string(what) + " are declared but " +
                               std::to_string(read) + " are there; " + std::string(kReexport));
  };
  FR_RETURN_IF_ERROR(check("vertices", mesh.vertex_count, mesh.read_vertices));
  FR_RETURN_IF_ERROR(check("faces", mesh.triangle_count, mesh.read_triangles));
  FR_RETURN_IF_ERROR(check("texture vertices", mesh.texture_vertex_count, mesh.read_texture_vertices));
  return check("texture faces", mesh.texture_triangle_count, mesh.read_texture_triangles);
}

}  // namespace

Result<RawScan> ReadAse(const SourceText& source, const ReadScanLimits& limits) {
  return AseReader(source, limits).Read();
}

}  // namespace fitroom
