#include "fit_client/render/glb_writer.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/base/file.h"
#include "common/image/decode.h"
#include "tests/fit_client/render/dressed_capsule.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::render {
namespace {

using Json = nlohmann::json;

uint32_t WordAt(const std::string& bytes, size_t offset) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

// A GLB taken apart by the rules of the specification, without the writer's help.
struct Glb {
  Json json;
  std::string binary;

  explicit Glb(const std::string& file) {
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(WordAt(file, 4), 2U);
    EXPECT_EQ(WordAt(file, 8), file.size());
    const size_t json_size = WordAt(file, 12);
    EXPECT_EQ(file.substr(16, 4), "JSON");
    EXPECT_EQ(json_size % 4, 0U);
    json = Json::parse(file.substr(20, json_size));
    const size_t binary_size = WordAt(file, 20 + json_size);
    EXPECT_EQ(file.substr(24 + json_size, 3), "BIN");
    EXPECT_EQ(28 + json_size + binary_size, file.size());
    binary = file.substr(28 + json_size);
  }

  std::vector<float> Floats(int accessor) const {
    const Json& a = json["accessors"][static_cast<size_t>(accessor)];
    const size_t width = a["type"] == "VEC3" ? 3 : 2;
    const Json& view = json["bufferViews"][a["bufferView"].get<size_t>()];
    std::vector<float> values(a["count"].get<size_t>() * width);
    std::memcpy(values.data(), binary.data() + view["byteOffset"].get<size_t>(), values.size() * sizeof(float));
    return values;
  }
  int TriangleCount() const {
    int count = 0;
    for (const Json& mesh : json["meshes"]) {
      for (const Json& primitive : mesh["primitives"]) {
        count += json["accessors"][primitive["indices"].get<size_t>()]["count"].get<int>() / 3;
      }
    }
    return count;
  }
};

class GlbWriterTest : public ::testing::Test {
 protected:
  Scene MakeScene() const {
    Scene scene;
    scene.body = &capsule_.body;
    scene.garments.push_back({&capsule_.cloth, capsule_.positions, &front_, &back_});
    return scene;
  }
  const DressedCapsule capsule_ = MakeDressedCapsule();
  const Image front_ = MakeHalvedImage({220, 20, 20}, {20, 200, 20});
  const Image back_ = MakeHalvedImage({20, 20, 220}, {210, 210, 20});
};

TEST_F(GlbWriterTest, HoldsBodyAndGarmentInMetresUpright) {
  const Result<std::string> file = WriteGlb(MakeScene(), "a shirt");
  ASSERT_TRUE(file.ok()) << file.status().ToString();
  const Glb glb(*file);
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["nodes"][0]["name"], "body");
  EXPECT_EQ(glb.json["nodes"][1]["name"], "garment");
  EXPECT_EQ(glb.TriangleCount(),
            static_cast<int>(capsule_.body.mesh.triangles.size() + capsule_.cloth.triangles.size()));
  const Json& body = glb.json["meshes"][0]["primitives"][0];
  const Json& bounds = glb.json["accessors"][body["attributes"]["POSITION"].get<size_t>()];
  EXPECT_NEAR(bounds["max"][1].get<double>(), 1.7, 1e-6);
  EXPECT_NEAR(bounds["min"][1].get<double>(), 0.0, 1e-6);
  // The front panel is before the body: +Z is the front.
  const Json& front = glb.json["meshes"][1]["primitives"][0];
  const std::vector<float> positions = glb.Floats(front["attributes"]["POSITION"].get<int>());
  for (size_t i = 2; i < positions.size(); i += 3) EXPECT_GE(positions[i], -1e-6F);
  for (const Json& mesh : glb.json["meshes"]) {
    for (const Json& primitive : mesh["primitives"]) {
      const std::vector<float> normals = glb.Floats(primitive["attributes"]["NORMAL"].get<int>());
      for (size_t i = 0; i < normals.size(); i += 3) {
        EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1.0F, 1e-5F);
      }
    }
  }
}

TEST_F(GlbWriterTest, EachPanelWearsItsPhotograph) {
  const Glb glb(*WriteGlb(MakeScene(), "a shirt"));
  ASSERT_EQ(glb.json["images"].size(), 2U);
  const auto first_pixel = [&](size_t panel) {
    const Json& primitive = glb.json["meshes"][1]["primitives"][panel];
    const Json& material = glb.json["materials"][primitive["material"].get<size_t>()];
    const size_t texture = material["pbrMetallicRoughness"]["baseColorTexture"]["index"].get<size_t>();
    const Json& image = glb.json["images"][glb.json["textures"][texture]["source"].get<size_t>()];
    EXPECT_EQ(image["mimeType"], "image/jpeg");
    const Json& view = glb.json["bufferViews"][image["bufferView"].get<size_t>()];
    const Result<Image> decoded =
        DecodeImage(glb.binary.substr(view["byteOffset"].get<size_t>(), view["byteLength"].get<size_t>()));
    EXPECT_TRUE(decoded.ok());
    return std::vector<int>(decoded->at(4, 4), decoded->at(4, 4) + 3);
  };
  EXPECT_GT(first_pixel(0)[0], 180);  // Red: the front photograph's left half.
  EXPECT_GT(first_pixel(1)[2], 180);  // Blue: the back's.
}

TEST_F(GlbWriterTest, StaysUnderTheTriangleLimitOfTheTrade) {
  Scene scene = MakeScene();
  DisplayBody fine;
  constexpr int kSide = 250;  // A bumpy sheet of 125,000 triangles.
  for (int y = 0; y <= kSide; ++y) {
    for (int x = 0; x <= kSide; ++x) {
      fine.mesh.vertices.emplace_back(0.002 * x, 0.002 * y, 1e-4 * std::sin(0.3 * x) * std::sin(0.3 * y));
      fine.normals.push_back(Eigen::Vector3d::UnitZ());
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x;
      fine.mesh.triangles.emplace_back(a, a + 1, a + kSide + 2);
      fine.mesh.triangles.emplace_back(a, a + kSide + 2, a + kSide + 1);
    }
  }
  scene.body = &fine;
  const Result<std::string> file = WriteGlb(scene, "fine");
  ASSERT_TRUE(file.ok());
  EXPECT_LE(Glb(*file).TriangleCount(), kGlbTriangleLimit);
  EXPECT_LE(file->size(), 5000000U);
}

TEST_F(GlbWriterTest, TheSameSceneGivesTheSameBytesAndBadOnesAreRefused) {
  EXPECT_TRUE(*WriteGlb(MakeScene(), "a") == *WriteGlb(MakeScene(), "a"));
  EXPECT_EQ(WriteGlb(Scene(), "a").status().reason(), "EMPTY_SCENE");
  Scene bad = MakeScene();
  bad.garments[0].positions[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(WriteGlb(bad, "a").status().reason(), "BAD_GARMENT_SHAPE");
  EXPECT_TRUE(WriteGlb(MakeScene(), "title \xFF\"\n").ok());
}

// The judge that is not ours. deploy/packages --npm installs it; deploy/test requires it.
TEST_F(GlbWriterTest, PassesTheKhronosValidator) {
  const std::filesystem::path folder = GLTF_VALIDATOR_DIR;
  const bool is_here = std::filesystem::exists(folder / "node_modules" / "gltf-validator") &&
                       std::system("node --version >/dev/null 2>&1") == 0;
  if (!is_here) {
    ASSERT_EQ(std::getenv("FITROOM_REQUIRE_NPM"), nullptr) << "run deploy/packages --npm";
    GTEST_SKIP() << "node or gltf-validator is not installed; run deploy/packages --npm";
  }
  const testing::TemporaryFolder temporary;
  Scene plain = MakeScene();
  plain.garments[0].front_texture = plain.garments[0].back_texture = nullptr;
  for (const Scene& scene : {MakeScene(), plain}) {
    const std::filesystem::path file = temporary.path() / "scene.glb";
    ASSERT_TRUE(WriteFileAtomically(file, *WriteGlb(scene, "a shirt")).ok());
    const std::string command =
        "node '" + (folder / "validate.js").string() + "' '" + file.string() + "' >'" + file.string() + ".txt' 2>&1";
    const int exit_code = std::system(command.c_str());
    EXPECT_EQ(exit_code, 0) << *ReadFile(file.string() + ".txt", 1000000);
  }
}

}  // namespace
}  // namespace fitroom::render
