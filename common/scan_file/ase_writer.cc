#include "common/scan_file/ase_writer.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <Eigen/Geometry>

#include "common/base/check.h"

namespace fitroom {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

// Appends text and numbers as the exporter formats them.
class AseText {
 public:
  explicit AseText(size_t expected_size) { text_.reserve(expected_size); }

  AseText& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  AseText& operator<<(int64_t number) { return Number(number, 0); }
  // Right-aligned in `width`, as the exporter does with running numbers.
  AseText& Number(int64_t number, int width) {
    char digits[24];
    const char* const end = std::to_chars(digits, digits + sizeof(digits), number).ptr;
    for (auto size = end - digits; size < width; ++size) text_ += ' ';
    text_ += std::string_view(digits, end);
    return *this;
  }
  // Four decimals.
  AseText& Decimal(double value) {
    const int64_t units = std::llround(value * 1e4);
    const int64_t size = std::abs(units);
    if (units < 0) text_ += '-';
    Number(size / 10000, 0);
    const int64_t rest = size % 10000;
    const char decimals[5] = {'.', static_cast<char>('0' + rest / 1000), static_cast<char>('0' + rest / 100 % 10),
                              static_cast<char>('0' + rest / 10 % 10), static_cast<char>('0' + rest % 10)};
    text_.append(decimals, sizeof(decimals));
    return *this;
  }
  AseText& Point(const Eigen::Vector3d& point) {
    Decimal(point.x()) << "\t";
    Decimal(point.y()) << "\t";
    return Decimal(point.z()) << kLineEnd;
  }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

void WriteHead(const AseContent& content, AseText& text) {
  text << "*3DSMAX_ASCIIEXPORT\t200" << kLineEnd;
  if (!content.comment.empty()) text << "*COMMENT \"" << content.comment << "\"" << kLineEnd;
  text << "*SCENE {" << kLineEnd << "\t*SCENE_FILENAME \"" << content.scene_name << "\"" << kLineEnd
       << "\t*SCENE_FIRSTFRAME 0\r\n\t*SCENE_LASTFRAME 100\r\n\t*SCENE_FRAMESPEED 30\r\n"
       << "\t*SCENE_TICKSPERFRAME 160\r\n\t*SCENE_BACKGROUND_STATIC 0.0000\t0.0000\t0.0000\r\n"
       << "\t*SCENE_AMBIENT_STATIC 0.0431\t0.0431\t0.0431\r\n}\r\n";
  const bool has_texture = !content.texture_path.empty();
  text << "*MATERIAL_LIST {\r\n\t*MATERIAL_COUNT " << (has_texture ? "1" : "0") << kLineEnd;
  if (has_texture) {
    text << "\t*MATERIAL 0 {\r\n\t\t*MATERIAL_NAME \"skin\"\r\n\t\t*MATERIAL_CLASS \"Standard\"\r\n"
         << "\t\t*MATERIAL_AMBIENT 0.5882\t0.5882\t0.5882\r\n\t\t*MATERIAL_DIFFUSE 0.5882\t0.5882\t0.5882\r\n"
         << "\t\t*MATERIAL_SPECULAR 0.9000\t0.9000\t0.9000\r\n\t\t*MATERIAL_SHINE 0.1000\r\n"
         << "\t\t*MATERIAL_SHADING Blinn\r\n\t\t*MAP_DIFFUSE {\r\n\t\t\t*MAP_NAME \"Map #1\"\r\n"
         << "\t\t\t*MAP_CLASS \"Bitmap\"\r\n\t\t\t*MAP_SUBNO 1\r\n\t\t\t*MAP_AMOUNT 1.0000\r\n"
         << "\t\t\t*BITMAP \"" << content.texture_path << "\"\r\n\t\t\t*MAP_TYPE Screen\r\n\t\t}\r\n\t}\r\n";
  }
  text << "}\r\n";
}

void WriteFaces(const TriangleMesh& mesh, AseText& text) {
  text << "\t\t*MESH_FACE_LIST {\r\n";
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3i& triangle = mesh.triangles[i];
    text << "\t\t\t*MESH_FACE ";
    text.Number(static_cast<int64_t>(i), 4) << ":    A: ";
    text.Number(triangle[0], 4) << " B: ";
    text.Number(triangle[1], 4) << " C: ";
    text.Number(triangle[2], 4) << " AB:    1 BC:    1 CA:    1\t *MESH_SMOOTHING 1 \t*MESH_MTLID 0\r\n";
  }
  text << "\t\t}\r\n";
}

void WriteTexture(const AseContent& content, AseText& text) {
  text << "\t\t*MESH_NUMTVERTEX " << static_cast<int64_t>(content.texture_coordinates.size()) << kLineEnd;
  if (content.texture_coordinates.empty()) return;
  text << "\t\t*MESH_TVERTLIST {\r\n";
  for (size_t i = 0; i < content.texture_coordinates.size(); ++i) {
    const Eigen::Vector2d uv = content.texture_coordinates[i].cast<double>();
    text << "\t\t\t*MESH_TVERT " << static_cast<int64_t>(i) << "\t";
    text.Point(Eigen::Vector3d(uv.x(), uv.y(), 0.0));
  }
  text << "\t\t}\r\n\t\t*MESH_NUMTVFACES " << static_cast<int64_t>(content.texture_triangles.size())
       << "\r\n\t\t*MESH_TFACELIST {\r\n";
  for (size_t i = 0; i < content.texture_triangles.size(); ++i) {
    const Eigen::Vector3i& triangle = content.texture_triangles[i];
    text << "\t\t\t*MESH_TFACE " << static_cast<int64_t>(i) << "\t" << int64_t{triangle[0]} << "\t"
         << int64_t{triangle[1]} << "\t" << int64_t{triangle[2]} << kLineEnd;
  }
  text << "\t\t}\r\n";
}

void WriteNormals(const TriangleMesh& mesh, AseText& text) {
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(mesh);
  const auto vertex = [&](int index) -> const Eigen::Vector3d& { return mesh.vertices[static_cast<size_t>(index)]; };
  text << "\t\t*MESH_NORMALS {\r\n";
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3i& triangle = mesh.triangles[i];
    const Eigen::Vector3d ab = vertex(triangle[1]) - vertex(triangle[0]);
    const Eigen::Vector3d ac = vertex(triangle[2]) - vertex(triangle[0]);
    text << "\t\t\t*MESH_FACENORMAL " << static_cast<int64_t>(i) << "\t";
    text.Point(ab.cross(ac).stableNormalized());
    for (int corner = 0; corner < 3; ++corner) {
      text << "\t\t\t\t*MESH_VERTEXNORMAL " << int64_t{triangle[corner]} << "\t";
      text.Point(normals[static_cast<size_t>(triangle[corner])]);
    }
  }
  text << "\t\t}\r\n";
}

}  // namespace

std::string FormatAse(const TriangleMesh& mesh, const AseContent& content) {
  const bool has_texture = !content.texture_triangles.empty();
  FR_CHECK(!has_texture || content.texture_triangles.size() == mesh.triangles.size());
  AseText text(4096 + mesh.vertices.size() * 52 + content.texture_coordinates.size() * 44 +
               mesh.triangles.size() * (110 + (has_texture ? 46 : 0) + (content.has_normals ? 230 : 0)));
  WriteHead(content, text);
  text << "*GEOMOBJECT {\r\n\t*NODE_NAME \"" << content.object_name << "\"\r\n\t*NODE_TM {\r\n\t\t*NODE_NAME \""
       << content.object_name << "\"\r\n\t\t*TM_ROW0 1.0000\t0.0000\t0.0000\r\n\t\t*TM_ROW1 0.0000\t1.0000\t0.0000\r\n"
       << "\t\t*TM_ROW2 0.0000\t0.0000\t1.0000\r\n\t\t*TM_ROW3 0.0000\t0.0000\t0.0000\r\n\t}\r\n\t*MESH {\r\n"
       << "\t\t*TIMEVALUE 0\r\n\t\t*MESH_NUMVERTEX " << static_cast<int64_t>(mesh.vertices.size())
       << "\r\n\t\t*MESH_NUMFACES " << static_cast<int64_t>(mesh.triangles.size()) << "\r\n\t\t*MESH_VERTEX_LIST {\r\n";
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    FR_CHECK(mesh.vertices[i].cwiseAbs().maxCoeff() < 1e9);
    text << "\t\t\t*MESH_VERTEX ";
    text.Number(static_cast<int64_t>(i), 4) << "\t";
    text.Point(mesh.vertices[i]);
  }
  text << "\t\t}\r\n";
  WriteFaces(mesh, text);
  WriteTexture(content, text);
  text << "\t\t*MESH_NUMCVERTEX 0\r\n";
  if (content.has_normals) WriteNormals(mesh, text);
  text << "\t}\r\n\t*PROP_MOTIONBLUR 0\r\n\t*PROP_CASTSHADOW 1\r\n\t*PROP_RECVSHADOW 1\r\n";
  if (!content.texture_path.empty()) text << "\t*MATERIAL_REF 0\r\n";
  text << "}\r\n";
  return text.Take();
}

}  // namespace fitroom
