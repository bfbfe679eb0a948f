#pragma once

// OpenGL as the software renderer offers it, and owners of what it hands out. Private to fit_client/render.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
// After osmesa.h, which brings gl.h.
#include <GL/glext.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "common/base/status.h"
#include "common/image/image.h"

namespace fitroom::render {

// An off-screen OpenGL 3.3 context, current on the thread that made it. Everything else in this file needs one.
class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  ~GlContext();

  // UNAVAILABLE [NO_RENDERER] where the software renderer cannot be started.
  Status Start();

 private:
  OSMesaContext context_ = nullptr;
  std::vector<unsigned char> unused_pixels_;  // OSMesa wants a buffer; we draw in our own.
};

// Says what went wrong since the last call: OK, RESOURCE_EXHAUSTED [OUT_OF_MEMORY] or INTERNAL [RENDERER_FAILED].
Status CheckGl(const char* step);

// A linked vertex and fragment shader.
class GlProgram {
 public:
  GlProgram() = default;
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;
  ~GlProgram() { glDeleteProgram(program_); }

  // INTERNAL [RENDERER_FAILED] with the compiler's message: a shader of ours is wrong.
  Status Link(const char* vertex_source, const char* fragment_source);

  void Use() const { glUseProgram(program_); }
  GLint Uniform(const char* name) const { return glGetUniformLocation(program_, name); }

 private:
  GLuint program_ = 0;
};

// Vertices and triangle corners in the renderer's memory. A vertex is a row of floats; `Attribute` lists how many of
// them each shader input takes, in the order of the input's location.
class GlMesh {
 public:
  GlMesh(const std::vector<int>& attribute_sizes, const std::vector<float>& vertices,
         const std::vector<uint32_t>& indices);
  GlMesh(GlMesh&& other) noexcept
      : array_(std::exchange(other.array_, 0)),
        vertices_(std::exchange(other.vertices_, 0)),
        indices_(std::exchange(other.indices_, 0)),
        index_count_(other.index_count_) {}
  GlMesh& operator=(GlMesh&&) = delete;
  ~GlMesh();

  int index_count() const { return index_count_; }
  // Draws the triangles whose corners are indices [first, first + count).
  void DrawRange(int first, int count) const;
  void Draw() const { DrawRange(0, index_count_); }

 private:
  GLuint array_ = 0;
  GLuint vertices_ = 0;
  GLuint indices_ = 0;
  int index_count_ = 0;
};

// A two-dimensional texture with mipmaps, clamped at its edges.
class GlTexture {
 public:
  // Larger images are halved until both sides are at most `max_side` (unit: pixel). Alpha is ignored.
  explicit GlTexture(const Image& image, int max_side = 2048);
  GlTexture(GlTexture&& other) noexcept : texture_(std::exchange(other.texture_, 0)) {}
  GlTexture& operator=(GlTexture&&) = delete;
  ~GlTexture() { glDeleteTextures(1, &texture_); }

  void Bind() const { glBindTexture(GL_TEXTURE_2D, texture_); }

 private:
  GLuint texture_ = 0;
};

// Where pictures are drawn: at a multiple of the width and height, averaged when read. (The renderer's own
// multisampling was tried: its outlines stay jagged, and its shaders take longer to compile.)
class GlTarget {
 public:
  GlTarget() = default;
  GlTarget(const GlTarget&) = delete;
  GlTarget& operator=(const GlTarget&) = delete;
  ~GlTarget() { Release(); }

  // Makes the target this large (unit: pixel of the picture), with so many samples a pixel each way, and the current
  // one. RESOURCE_EXHAUSTED where the renderer refuses.
  Status Begin(int width, int height, int samples_across);
  // Returns what was drawn.
  Image Read() const;

 private:
  void Release();
  int width_ = 0;
  int height_ = 0;
  int samples_across_ = 0;
  GLuint frame_ = 0, colour_ = 0, depth_ = 0;
};

}  // namespace fitroom::render
