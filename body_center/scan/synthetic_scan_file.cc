#include "body_center/scan/synthetic_scan_file.h"

#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <vector>

#include "common/base/file.h"
#include "common/image/encode.h"
#include "common/scan_file/ase_writer.h"

namespace fitroom::body_center {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as it lies in memory");

constexpr int kJpegQuality = 88;

// Appends one short formatted line.
void Append(std::string& text, const char* format, ...) {
  std::array<char, 160> line;
  va_list arguments;
  va_start(arguments, format);
  const int size = std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  text.append(line.data(), static_cast<size_t>(size));
}

template <typename T>
void AppendBytes(std::string& bytes, const T& value) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

std::string PlyBytes(const TriangleMesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment fitroom synthetic body; metres, y up, facing +z\n";
  Append(bytes, "element vertex %zu\n", mesh.vertices.size());
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) Append(bytes, "property float %s\n", name);
  Append(bytes, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(mesh);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) AppendBytes(bytes, static_cast<float>(mesh.vertices[i][k]));
    for (int k = 0; k < 3; ++k) AppendBytes(bytes, static_cast<float>(normals[i][k]));
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    AppendBytes(bytes, uint8_t{3});
    for (int k = 0; k < 3; ++k) AppendBytes(bytes, static_cast<int32_t>(triangle[k]));
  }
  return bytes;
}

// Turns the body as 3ds Max stands it: centimetres, z up, facing -y.
std::string AseText(const SyntheticScan& scan, const std::string& name, const std::string& texture_file) {
  TriangleMesh mesh;
  mesh.triangles = scan.mesh.triangles;
  mesh.vertices.reserve(scan.mesh.vertices.size());
  for (const Eigen::Vector3d& v : scan.mesh.vertices)
    mesh.vertices.emplace_back(100 * v.x(), -100 * v.z(), 100 * v.y());
  AseContent content;
  content.scene_name = name + ".max";
  content.object_name = name;
  content.comment = "fitroom synthetic body; units cm, z up, facing -y";
  content.texture_path = texture_file;
  content.texture_coordinates = scan.texture.coordinates;
  content.texture_triangles = scan.texture.triangles;
  return FormatAse(mesh, content);
}

std::string ObjText(const SyntheticScan& scan, const std::string& material_file) {
  std::string text = "# fitroom synthetic body; metres, y up, facing +z\n";
  text += "mtllib " + material_file + "\no body\n";
  for (const Eigen::Vector3d& v : scan.mesh.vertices) Append(text, "v %.6f %.6f %.6f\n", v.x(), v.y(), v.z());
  for (const Eigen::Vector2f& t : scan.texture.coordinates) Append(text, "vt %.5f %.5f\n", t.x(), t.y());
  for (const Eigen::Vector3d& n : ComputeVertexNormals(scan.mesh))
    Append(text, "vn %.4f %.4f %.4f\n", n.x(), n.y(), n.z());
  text += "usemtl skin\n";
  for (size_t i = 0; i < scan.mesh.triangles.size(); ++i) {
    const Eigen::Vector3i v = scan.mesh.triangles[i] + Eigen::Vector3i::Ones();
    const Eigen::Vector3i t = scan.texture.triangles[i] + Eigen::Vector3i::Ones();
    Append(text, "f %d/%d/%d %d/%d/%d %d/%d/%d\n", v[0], t[0], v[0], v[1], t[1], v[1], v[2], t[2], v[2]);
  }
  return text;
}

}  // namespace

Status WriteSyntheticScan(const SyntheticScan& scan, SyntheticScanFormat format, const std::filesystem::path& path) {
  if (format == SyntheticScanFormat::kPly) return WriteFileAtomically(path, PlyBytes(scan.mesh));
  const std::string texture_file = path.stem().string() + "_skin.jpg";
  FR_RETURN_IF_ERROR(
      WriteFileAtomically(path.parent_path() / texture_file, EncodeJpeg(scan.texture.image, kJpegQuality)));
  if (format == SyntheticScanFormat::kAse) {
    return WriteFileAtomically(path, AseText(scan, path.stem().string(), texture_file));
  }
  const std::string material_file = path.stem().string() + ".mtl";
  FR_RETURN_IF_ERROR(
      WriteFileAtomically(path.parent_path() / material_file, "newmtl skin\nKd 1 1 1\nmap_Kd " + texture_file + "\n"));
  return WriteFileAtomically(path, ObjText(scan, material_file));
}

}  // namespace fitroom::body_center
