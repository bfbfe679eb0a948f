#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/base/status.h"
#include "common/image/image.h"
#include "fit_client/render/scene.h"

namespace fitroom::render {

// Draws scenes without a screen. Owns one off-screen OpenGL context, which belongs to the thread that made the object:
// create, use and destroy a Renderer on one thread; use several for several threads. The same scene gives the same
// bytes on the same machine.
class Renderer {
 public:
  // UNAVAILABLE [NO_RENDERER] where the software renderer cannot be started.
  static Result<Renderer> Create();

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // Returns one RGB picture a camera. INVALID_ARGUMENT for a scene whose parts do not fit each other (counts, indices,
  // non-finite positions) or a picture that is empty or larger than 4096 pixels a side; RESOURCE_EXHAUSTED where
  // the renderer runs out of memory.
  Result<std::vector<Image>> Draw(const Scene& scene, std::span<const Camera> cameras);

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fitroom::render
