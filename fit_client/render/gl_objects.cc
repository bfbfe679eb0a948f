#include "fit_client/render/gl_objects.h"

#include <algorithm>
#include <array>

#include "fit_client/render/image_scaling.h"

#if defined(__SANITIZE_ADDRESS__)
// OSMesa keeps about 200 bytes a context for good (its list of buffers has no end). Not ours to free, and not to be
// reported by the leak sanitizer, which asks this function by its name.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace fitroom::render {
namespace {

Status Failed(const std::string& message) { return Internal("RENDERER_FAILED", message); }

Result<GLuint> Compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled != 0) return shader;
  std::array<char, 1024> log = {};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
  glDeleteShader(shader);
  return Failed(std::string("a shader does not compile: ") + log.data());
}

}  // namespace

GlContext::~GlContext() {
  if (context_ != nullptr) OSMesaDestroyContext(context_);
}

Status GlContext::Start() {
  const std::array<int, 11> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          3,
                                          0};
  context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  constexpr int kUnusedSide = 16;
  unused_pixels_.resize(static_cast<size_t>(kUnusedSide) * kUnusedSide * 4);
  if (context_ == nullptr ||
      OSMesaMakeCurrent(context_, unused_pixels_.data(), GL_UNSIGNED_BYTE, kUnusedSide, kUnusedSide) == GL_FALSE) {
    return Unavailable("NO_RENDERER", "the software renderer (OSMesa, OpenGL 3.3) does not start; install libosmesa6");
  }
  return Status();
}

Status CheckGl(const char* step) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return Status();
  while (glGetError() != GL_NO_ERROR) {
  }
  if (error == GL_OUT_OF_MEMORY) {
    return ResourceExhausted("OUT_OF_MEMORY", std::string("the renderer ran out of memory: ") + step);
  }
  return Failed(std::string(step) + ": OpenGL error " + std::to_string(error));
}

Status GlProgram::Link(const char* vertex_source, const char* fragment_source) {
  FR_ASSIGN_OR_RETURN(const GLuint vertex, Compile(GL_VERTEX_SHADER, vertex_source));
  Result<GLuint> fragment = Compile(GL_FRAGMENT_SHADER, fragment_source);
  if (!fragment.ok()) {
    glDeleteShader(vertex);
    return fragment.status();
  }
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, *fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(*fragment);
  GLint linked = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (linked != 0) return Status();
  std::array<char, 1024> log = {};
  glGetProgramInfoLog(program_, static_cast<GLsizei>(log.size() - 1), nullptr, log.data());
  return Failed(std::string("the shaders do not fit each other: ") + log.data());
}

GlMesh::GlMesh(const std::vector<int>& attribute_sizes, const std::vector<float>& vertices,
               const std::vector<uint32_t>& indices)
    : index_count_(static_cast<int>(indices.size())) {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)), indices.data(),
               GL_STATIC_DRAW);
  int stride = 0;
  for (const int size : attribute_sizes) stride += size;
  size_t offset = 0;
  for (size_t i = 0; i < attribute_sizes.size(); ++i) {
    glEnableVertexAttribArray(static_cast<GLuint>(i));
    glVertexAttribPointer(static_cast<GLuint>(i), attribute_sizes[i], GL_FLOAT, GL_FALSE,
                          stride * static_cast<GLsizei>(sizeof(float)),
                          reinterpret_cast<const void*>(offset));  // NOLINT: an offset, as OpenGL has it.
    offset += static_cast<size_t>(attribute_sizes[i]) * sizeof(float);
  }
}

GlMesh::~GlMesh() {
  glDeleteBuffers(1, &indices_);
  glDeleteBuffers(1, &vertices_);
  glDeleteVertexArrays(1, &array_);
}

void GlMesh::DrawRange(int first, int count) const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(static_cast<size_t>(first) * sizeof(uint32_t)));  // NOLINT
}

GlTexture::GlTexture(const Image& image, int max_side) {
  Image halved;
  const Image* source = &image;
  while (std::max(source->width, source->height) > max_side) {
    halved = HalveImage(*source);
    source = &halved;
  }
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLenum format = source->channels == 1 ? GL_RED : source->channels == 3 ? GL_RGB : GL_RGBA;
  glTexImage2D(GL_TEXTURE_2D, 0, source->channels == 1 ? GL_R8 : GL_RGBA8, source->width, source->height, 0, format,
               GL_UNSIGNED_BYTE, source->pixels.data());
  if (source->channels == 1) {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_G, GL_RED);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glGenerateMipmap(GL_TEXTURE_2D);
}

void GlTarget::Release() {
  const std::array<GLuint, 2> buffers = {colour_, depth_};
  if (frame_ != 0) glDeleteFramebuffers(1, &frame_);
  if (colour_ != 0) glDeleteRenderbuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  frame_ = colour_ = depth_ = 0;
}

Status GlTarget::Begin(int width, int height, int samples_across) {
  if (width != width_ || height != height_ || samples_across != samples_across_ || frame_ == 0) {
    Release();
    width_ = width;
    height_ = height;
    samples_across_ = samples_across;
    glGenFramebuffers(1, &frame_);
    glGenRenderbuffers(1, &colour_);
    glGenRenderbuffers(1, &depth_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindRenderbuffer(GL_RENDERBUFFER, colour_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, samples_across * width, samples_across * height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, samples_across * width, samples_across * height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    FR_RETURN_IF_ERROR(CheckGl("making the picture's buffers"));
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      return ResourceExhausted("OUT_OF_MEMORY", "the renderer cannot make a picture of this size");
    }
  }
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, samples_across * width, samples_across * height);
  return CheckGl("beginning a picture");
}

Image GlTarget::Read() const {
  const size_t width = static_cast<size_t>(width_);
  const size_t across = static_cast<size_t>(samples_across_);
  const size_t row_size = width * across * 4;
  const int sample_count = samples_across_ * samples_across_;
  // In strips, for the sake of memory: a whole picture's samples take 16 bytes a pixel.
  constexpr int kStrip = 32;  // (unit: pixel of the picture)
  std::vector<uint8_t> samples(row_size * across * kStrip);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  Image image = MakeImage(width_, height_, 3);
  for (int first = 0; first < height_; first += kStrip) {
    const int count = std::min(kStrip, height_ - first);
    glReadPixels(0, samples_across_ * first, samples_across_ * width_, samples_across_ * count, GL_RGBA,
                 GL_UNSIGNED_BYTE, samples.data());
    for (int row = 0; row < count; ++row) {
      const uint8_t* from = samples.data() + static_cast<size_t>(row) * across * row_size;
      // OpenGL's first row is the lowest.
      uint8_t* to = image.at(0, height_ - 1 - first - row);
      for (size_t x = 0; x < width; ++x, from += across * 4, to += 3) {
        for (size_t c = 0; c < 3; ++c) {
          int sum = sample_count / 2;
          for (size_t sample_row = 0; sample_row < across; ++sample_row) {
            for (size_t sample = 0; sample < across; ++sample) sum += from[sample_row * row_size + sample * 4 + c];
          }
          to[c] = static_cast<uint8_t>(sum / sample_count);
        }
      }
    }
  }
  return image;
}

}  // namespace fitroom::render
