#include "fit_client/render/glb_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/image/encode.h"
#include "fit_client/render/garment_surface.h"
#include "fit_client/render/image_scaling.h"

namespace fitroom::render {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "glTF is little endian, and so is every machine we run on");

// glTF's numbers for things.
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;
constexpr uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

constexpr int kMaxTextureSide = 2048;  // (unit: pixel)
constexpr int kJpegQuality = 88;
constexpr int kLeastBodyTriangles = 20000;

using Rows2 = std::vector<std::array<float, 2>>;
using Rows3 = std::vector<std::array<float, 3>>;

// Builds the JSON and the binary part of a file side by side.
class GlbBuilder {
 public:
  Json& json() { return json_; }

  // Appends bytes at a multiple of four and returns the number of their view. `target` 0: none.
  int AddView(const void* bytes, size_t size, int target) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    binary_.append(static_cast<const char*>(bytes), size);
    return Append("bufferViews", std::move(view));
  }

  // Adds floats, N a vertex; with their bounds where glTF asks for them.
  template <size_t N>
  int AddVertices(const std::vector<std::array<float, N>>& rows, bool with_bounds) {
    const int view = AddView(rows.data(), rows.size() * sizeof(rows[0]), kArrayBuffer);
    Json accessor = {
        {"bufferView", view}, {"componentType", kFloat}, {"count", rows.size()}, {"type", N == 2 ? "VEC2" : "VEC3"}};
    if (with_bounds) {
      std::array<float, N> low = rows.front();
      std::array<float, N> high = rows.front();
      for (const std::array<float, N>& row : rows) {
        for (size_t i = 0; i < N; ++i) {
          low[i] = std::min(low[i], row[i]);
          high[i] = std::max(high[i], row[i]);
        }
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    return Append("accessors", std::move(accessor));
  }

  // Adds triangle corners, in two bytes each where that suffices.
  int AddIndices(const std::vector<uint32_t>& indices, size_t vertex_count) {
    // 65535 is the restart mark.
    if (vertex_count >= 65535) {
      const int view = AddView(indices.data(), indices.size() * sizeof(uint32_t), kElementArrayBuffer);
      return AddIndexAccessor(view, kUnsignedInt, indices.size());
    }
    const std::vector<uint16_t> narrow(indices.begin(), indices.end());
    const int view = AddView(narrow.data(), narrow.size() * sizeof(uint16_t), kElementArrayBuffer);
    return AddIndexAccessor(view, kUnsignedShort, indices.size());
  }

  // Adds a photograph and a cloth material that wears it; once an image.
  int AddClothMaterial(const Image* texture, const Colour& plain_colour, const std::string& name) {
    Json pbr = {{"metallicFactor", 0.0}, {"roughnessFactor", 0.92}};
    if (texture != nullptr) {
      pbr["baseColorTexture"] = {{"index", AddTexture(texture)}};
    } else {
      pbr["baseColorFactor"] = LinearFactor(plain_colour);
    }
    return Append("materials", {{"name", name}, {"pbrMetallicRoughness", std::move(pbr)}, {"doubleSided", true}});
  }
  int AddBodyMaterial() {
    const Json pbr = {{"baseColorFactor", LinearFactor(Colour(0.800F, 0.705F, 0.640F))},
                      {"metallicFactor", 0.0},
                      {"roughnessFactor", 0.75}};
    return Append("materials", {{"name", "body"}, {"pbrMetallicRoughness", pbr}});
  }

  // Adds a node with a mesh of these primitives.
  void AddNode(const std::string& name, Json primitives) {
    const int mesh = Append("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
    nodes_.push_back(Append("nodes", {{"name", name}, {"mesh", mesh}}));
  }

  // Returns the file.
  std::string Finish(const std::string& title) {
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json_["buffers"] = Json::array({Json{{"byteLength", binary_.size()}}});
    json_["scenes"] = Json::array({Json{{"name", title}, {"nodes", nodes_}}});
    json_["scene"] = 0;
    std::string text = json_.dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string file;
    const auto put = [&file](uint32_t value) { file.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    put(kGlbMagic);
    put(kGlbVersion);
    put(static_cast<uint32_t>(12 + 8 + text.size() + 8 + binary_.size()));
    put(static_cast<uint32_t>(text.size()));
    put(kJsonChunk);
    file += text;
    put(static_cast<uint32_t>(binary_.size()));
    put(kBinaryChunk);
    file += binary_;
    return file;
  }

 private:
  int Append(const char* list, Json item) {
    json_[list].push_back(std::move(item));
    return static_cast<int>(json_[list].size()) - 1;
  }
  int AddIndexAccessor(int view, int component, size_t count) {
    return Append("accessors",
                  {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", "SCALAR"}});
  }
  // glTF's factors are linear light; `colour` is sRGB.
  static Json LinearFactor(const Colour& colour) {
    Json factor = Json::array();
    for (const float value : colour) factor.push_back(std::pow(static_cast<double>(value), 2.2));
    factor.push_back(1.0);
    return factor;
  }
  int AddTexture(const Image* image) {
    const auto [known, is_new] = textures_.try_emplace(image, 0);
    if (!is_new) return known->second;
    Image halved;
    const Image* source = image;
    while (std::max(source->width, source->height) > kMaxTextureSide) {
      halved = HalveImage(*source);
      source = &halved;
    }
    const std::string jpeg = EncodeJpeg(*source, kJpegQuality);
    const int view = AddView(jpeg.data(), jpeg.size(), 0);
    const int image_index = Append("images", {{"bufferView", view}, {"mimeType", "image/jpeg"}});
    if (!json_.contains("samplers")) {
      Append("samplers", {{"magFilter", kLinear},
                          {"minFilter", kLinearMipmapLinear},
                          {"wrapS", kClampToEdge},
                          {"wrapT", kClampToEdge}});
    }
    known->second = Append("textures", {{"sampler", 0}, {"source", image_index}});
    return known->second;
  }

  Json json_ = {{"asset", {{"version", "2.0"}, {"generator", "fitroom"}}}};
  std::string binary_;
  Json nodes_ = Json::array();
  std::map<const Image*, int> textures_;
};

std::array<float, 3> ToFloats(const Eigen::Vector3d& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

// A normal of zero length, as at a vertex of no area, is no normal to glTF.
std::array<float, 3> ToNormal(const Eigen::Vector3d& normal) {
  return normal.squaredNorm() > 0.25 ? ToFloats(normal.normalized()) : std::array<float, 3>{0.0F, 1.0F, 0.0F};
}

void AddBody(GlbBuilder& builder, const DisplayBody& body) {
  Rows3 positions, normals;
  for (const Eigen::Vector3d& vertex : body.mesh.vertices) positions.push_back(ToFloats(vertex));
  for (const Eigen::Vector3d& normal : body.normals) normals.push_back(ToNormal(normal));
  std::vector<uint32_t> indices;
  for (const Eigen::Vector3i& t : body.mesh.triangles) {
    for (const int corner : t) indices.push_back(static_cast<uint32_t>(corner));
  }
  Json primitive;
  primitive["attributes"] = {{"POSITION", builder.AddVertices(positions, true)},
                             {"NORMAL", builder.AddVertices(normals, false)}};
  primitive["indices"] = builder.AddIndices(indices, positions.size());
  primitive["material"] = builder.AddBodyMaterial();
  builder.AddNode("body", Json::array({primitive}));
}

// One panel as a primitive with vertices of its own.
Json PanelPrimitive(GlbBuilder& builder, const GarmentShape& garment, const std::vector<Eigen::Vector3d>& all_normals,
                    int panel) {
  const ClothMesh& cloth = *garment.cloth;
  std::vector<int> vertex_of_particle(garment.positions.size(), -1);
  Rows3 positions, normals;
  Rows2 places;
  std::vector<uint32_t> indices;
  for (const Eigen::Vector3i& t : cloth.triangles) {
    if (cloth.panel_of_particle[static_cast<size_t>(t[0])] != panel) continue;
    for (const int corner : t) {
      const size_t particle = static_cast<size_t>(corner);
      if (vertex_of_particle[particle] < 0) {
        vertex_of_particle[particle] = static_cast<int>(positions.size());
        positions.push_back(ToFloats(garment.positions[particle]));
        normals.push_back(ToNormal(all_normals[particle]));
        places.push_back({static_cast<float>(cloth.texture_coordinates[particle].x()),
                          static_cast<float>(cloth.texture_coordinates[particle].y())});
      }
      indices.push_back(static_cast<uint32_t>(vertex_of_particle[particle]));
    }
  }
  if (indices.empty()) return Json();
  const Image* texture = panel == 1 && garment.back_texture != nullptr ? garment.back_texture : garment.front_texture;
  Json primitive;
  primitive["attributes"] = {{"POSITION", builder.AddVertices(positions, true)},
                             {"NORMAL", builder.AddVertices(normals, false)},
                             {"TEXCOORD_0", builder.AddVertices(places, false)}};
  primitive["indices"] = builder.AddIndices(indices, positions.size());
  primitive["material"] = builder.AddClothMaterial(texture, ComputePanelColour(cloth, panel, texture),
                                                   panel == 0 ? "cloth front" : "cloth back");
  return primitive;
}

void AddGarment(GlbBuilder& builder, const GarmentShape& garment, const std::string& name) {
  const std::vector<Eigen::Vector3d> normals = ComputeGarmentNormals(*garment.cloth, garment.positions);
  Json primitives = Json::array();
  for (const int panel : {0, 1}) {
    Json primitive = PanelPrimitive(builder, garment, normals, panel);
    if (!primitive.is_null()) primitives.push_back(std::move(primitive));
  }
  builder.AddNode(name, std::move(primitives));
}

}  // namespace

Result<std::string> WriteGlb(const Scene& scene, const std::string& title) {
  FR_RETURN_IF_ERROR(CheckScene(scene));
  int garment_triangles = 0;
  for (const GarmentShape& garment : scene.garments) {
    garment_triangles += static_cast<int>(garment.cloth->triangles.size());
  }
  const bool has_body = scene.body != nullptr && !scene.body->mesh.triangles.empty();
  if (!has_body && scene.garments.empty()) return InvalidArgument("EMPTY_SCENE", "there is nothing to write as GLB");
  GlbBuilder builder;
  if (has_body) {
    const int budget = std::max(kLeastBodyTriangles, kGlbTriangleLimit - garment_triangles);
    if (static_cast<int>(scene.body->mesh.triangles.size()) > budget) {
      AddBody(builder, PrepareBody(scene.body->mesh, budget));
    } else {
      AddBody(builder, *scene.body);
    }
  }
  for (size_t i = 0; i < scene.garments.size(); ++i) {
    AddGarment(builder, scene.garments[i], i == 0 ? "garment" : "garment " + std::to_string(i + 1));
  }
  return builder.Finish(title);
}

}  // namespace fitroom::render
