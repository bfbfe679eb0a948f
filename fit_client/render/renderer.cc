#include "fit_client/render/renderer.h"

#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "fit_client/render/drawables.h"
#include "fit_client/render/garment_surface.h"
#include "fit_client/render/gl_objects.h"
#include "fit_client/render/ground_shadow.h"
#include "fit_client/render/projection.h"
#include "fit_client/render/shaders.h"

namespace fitroom::render {
namespace {

constexpr int kMaxPictureSide = 4096;  // (unit: pixel)
constexpr double kLineWidth = 1.6;     // (unit: pixel)

Status CheckCameras(std::span<const Camera> cameras) {
  for (const Camera& camera : cameras) {
    if (camera.width <= 0 || camera.height <= 0 || camera.width > kMaxPictureSide || camera.height > kMaxPictureSide) {
      return InvalidArgument("BAD_PICTURE_SIZE", "a picture has 1 to 4096 pixels a side");
    }
    if (camera.samples_across < 1 || camera.samples_across > 2) {
      return InvalidArgument("BAD_PICTURE_SIZE", "a pixel is the mean of 1 or 2 samples each way");
    }
    if (camera.subject.isEmpty() || !camera.subject.sizes().allFinite() || camera.subject.sizes().maxCoeff() > 4.0 ||
        camera.subject.sizes().maxCoeff() <= 0.0) {
      return InvalidArgument("BAD_SUBJECT", "a picture shows something of up to 4 m");
    }
  }
  return Status();
}

// Returns a number that two different images do not share (FNV-1a over words of eight bytes).
uint64_t HashImage(const Image& image) {
  uint64_t hash = 1469598103934665603ULL ^ (static_cast<uint64_t>(image.width) << 32) ^
                  static_cast<uint64_t>(image.height * 8 + image.channels);
  size_t i = 0;
  for (; i + 8 <= image.pixels.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, image.pixels.data() + i, 8);
    hash = (hash ^ word) * 1099511628211ULL;
    hash ^= hash >> 29;
  }
  for (; i < image.pixels.size(); ++i) hash = (hash ^ image.pixels[i]) * 1099511628211ULL;
  return hash;
}

void SetMatrix(const GlProgram& program, const char* name, const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix4f values = matrix.cast<float>();
  glUniformMatrix4fv(program.Uniform(name), 1, GL_FALSE, values.data());
}

void SetColour(const GlProgram& program, const char* name, const Colour& colour) {
  glUniform3f(program.Uniform(name), colour.x(), colour.y(), colour.z());
}

// A garment in the renderer's memory.
struct GarmentDrawing {
  GlMesh mesh;
  int front_index_count = 0;
  float opacity = 1.0F;
  const GlTexture* textures[2] = {nullptr, nullptr};
  Colour panel_colours[2] = {Colour::Zero(), Colour::Zero()};
};

// A scene in the renderer's memory.
struct SceneDrawing {
  std::vector<GlMesh> body;    // None or one.
  std::vector<GlMesh> ground;  // None or one.
  std::vector<GlTexture> ground_darkness;
  std::vector<GarmentDrawing> garments;
};

}  // namespace

struct Renderer::Impl {
  GlContext context;  // First: everything below is destroyed before it.
  GlProgram backdrop, ground, body, cloth, line;
  GlTarget target;
  GLuint no_vertices = 0;                                                 // The backdrop has none of its own.
  std::vector<std::pair<uint64_t, std::unique_ptr<GlTexture>>> textures;  // By HashImage(), last used last.

  Status Start();
  const GlTexture* TextureOf(const Image* image);
  SceneDrawing Upload(const Scene& scene);
  void DrawGround(const SceneDrawing& drawing, const Projection& projection);
  void DrawBody(const SceneDrawing& drawing, const Projection& projection, double depth_bias);
  void DrawGarment(const GarmentDrawing& garment, const Projection& projection);
  void DrawLines(const Scene& scene, const Camera& camera);
};

Status Renderer::Impl::Start() {
  FR_RETURN_IF_ERROR(context.Start());
  FR_RETURN_IF_ERROR(backdrop.Link(shaders::kBackdropVertex, shaders::kBackdropFragment));
  FR_RETURN_IF_ERROR(ground.Link(shaders::kGroundVertex, shaders::kGroundFragment));
  FR_RETURN_IF_ERROR(body.Link(shaders::kBodyVertex, shaders::kBodyFragment));
  FR_RETURN_IF_ERROR(cloth.Link(shaders::kClothVertex, shaders::kClothFragment));
  FR_RETURN_IF_ERROR(line.Link(shaders::kLineVertex, shaders::kLineFragment));
  glGenVertexArrays(1, &no_vertices);
  return CheckGl("starting the renderer");
}

const GlTexture* Renderer::Impl::TextureOf(const Image* image) {
  if (image == nullptr) return nullptr;
  const uint64_t hash = HashImage(*image);
  for (const auto& [known, texture] : textures) {
    if (known == hash) return texture.get();
  }
  textures.emplace_back(hash, std::make_unique<GlTexture>(*image));
  return textures.back().second.get();
}

SceneDrawing Renderer::Impl::Upload(const Scene& scene) {
  const SceneRows rows = ComputeSceneRows(scene);
  SceneDrawing drawing;
  if (scene.body != nullptr) {
    drawing.body.emplace_back(std::vector<int>{3, 3, 1}, rows.body.rows, rows.body.indices);
    const GroundShadow shadow = ComputeGroundShadow(*scene.body);
    const float x0 = static_cast<float>(shadow.min_xz.x());
    const float z0 = static_cast<float>(shadow.min_xz.y());
    const float x1 = x0 + static_cast<float>(shadow.size_xz.x());
    const float z1 = z0 + static_cast<float>(shadow.size_xz.y());
    const float y = static_cast<float>(shadow.height);
    drawing.ground.emplace_back(std::vector<int>{3, 2},
                                std::vector<float>{x0, y, z0, 0, 0, x1, y, z0, 1, 0, x0, y, z1, 0, 1, x1, y, z1, 1, 1},
                                std::vector<uint32_t>{0, 2, 1, 1, 2, 3});
    drawing.ground_darkness.emplace_back(shadow.darkness);
  }
  if (textures.size() > 6) textures.clear();
  for (size_t i = 0; i < scene.garments.size(); ++i) {
    const GarmentShape& shape = scene.garments[i];
    const GarmentRows& garment = rows.garments[i];
    const Image* images[2] = {shape.front_texture,
                              shape.back_texture != nullptr ? shape.back_texture : shape.front_texture};
    GarmentDrawing item{GlMesh({3, 3, 2, 2}, garment.rows.rows, garment.rows.indices), garment.front_index_count,
                        shape.opacity};
    for (int panel = 0; panel < 2; ++panel) {
      item.textures[panel] = TextureOf(images[panel]);
      item.panel_colours[panel] = ComputePanelColour(*shape.cloth, panel, images[panel]);
    }
    drawing.garments.push_back(std::move(item));
  }
  return drawing;
}

void Renderer::Impl::DrawGround(const SceneDrawing& drawing, const Projection& projection) {
  if (drawing.ground.empty()) return;
  ground.Use();
  SetMatrix(ground, "clip_from_world", projection.clip_from_world());
  drawing.ground_darkness.front().Bind();
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  drawing.ground.front().Draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void Renderer::Impl::DrawBody(const SceneDrawing& drawing, const Projection& projection, double depth_bias) {
  if (drawing.body.empty()) return;
  body.Use();
  SetMatrix(body, "eye_from_world", projection.eye_from_world);
  SetMatrix(body, "clip_from_eye", projection.clip_from_eye);
  glUniform1f(body.Uniform("depth_bias"), static_cast<float>(depth_bias));
  drawing.body.front().Draw();
}

void Renderer::Impl::DrawGarment(const GarmentDrawing& garment, const Projection& projection) {
  cloth.Use();
  SetMatrix(cloth, "eye_from_world", projection.eye_from_world);
  SetMatrix(cloth, "clip_from_world", projection.clip_from_world());
  glUniform1f(cloth.Uniform("opacity"), garment.opacity);
  if (garment.opacity < 1.0F) {
    // Depth first: of a see-through garment only the nearest layer is mixed in, whatever the order of its triangles.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    garment.mesh.Draw();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
  }
  for (int panel = 0; panel < 2; ++panel) {
    glUniform1f(cloth.Uniform("textured"), garment.textures[panel] != nullptr ? 1.0F : 0.0F);
    SetColour(cloth, "plain_colour", garment.panel_colours[panel]);
    SetColour(cloth, "inside_colour", garment.panel_colours[panel]);
    if (garment.textures[panel] != nullptr) garment.textures[panel]->Bind();
    const int first = panel == 0 ? 0 : garment.front_index_count;
    const int count = (panel == 0 ? garment.front_index_count : garment.mesh.index_count()) - first;
    if (count > 0) garment.mesh.DrawRange(first, count);
  }
  glDisable(GL_BLEND);
}

void Renderer::Impl::DrawLines(const Scene& scene, const Camera& camera) {
  if (scene.lines.empty()) return;
  const VertexRows rows = ComputeLineRows(scene.lines, camera, kLineWidth);
  if (rows.indices.empty()) return;
  const GlMesh mesh({4, 3}, rows.rows, rows.indices);
  line.Use();
  // Once faintly through everything, once where nothing is in front.
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  glDisable(GL_DEPTH_TEST);
  glUniform1f(line.Uniform("opacity"), 0.30F);
  mesh.Draw();
  glEnable(GL_DEPTH_TEST);
  glUniform1f(line.Uniform("opacity"), 1.0F);
  mesh.Draw();
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::Create() {
  auto impl = std::make_unique<Impl>();
  FR_RETURN_IF_ERROR(impl->Start());
  return Renderer(std::move(impl));
}

Result<std::vector<Image>> Renderer::Draw(const Scene& scene, std::span<const Camera> cameras) {
  FR_RETURN_IF_ERROR(CheckScene(scene));
  FR_RETURN_IF_ERROR(CheckCameras(cameras));
  const SceneDrawing drawing = impl_->Upload(scene);
  FR_RETURN_IF_ERROR(CheckGl("handing the scene to the renderer"));
  std::vector<Image> pictures;
  for (const Camera& camera : cameras) {
    FR_RETURN_IF_ERROR(impl_->target.Begin(camera.width, camera.height, camera.samples_across));
    const Projection projection = ComputeProjection(camera);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glClear(GL_DEPTH_BUFFER_BIT);
    glBindVertexArray(impl_->no_vertices);
    impl_->backdrop.Use();
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    impl_->DrawGround(drawing, projection);
    impl_->DrawBody(drawing, projection, scene.body_depth_bias);
    for (const GarmentDrawing& garment : drawing.garments) impl_->DrawGarment(garment, projection);
    impl_->DrawLines(scene, camera);
    pictures.push_back(impl_->target.Read());
    FR_RETURN_IF_ERROR(CheckGl("drawing"));
  }
  return pictures;
}

}  // namespace fitroom::render
