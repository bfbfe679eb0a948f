#pragma once

#include <memory>
#include <string>

#include "common/base/status.h"
#include "common/image/image.h"

namespace fitroom {

// Writes an animated WebP (lossy, played for ever) frame by frame; only one frame and its predecessor are held. The
// same frames give the same bytes. Not thread-safe.
class AnimationWriter {
 public:
  struct Options {
    int width = 0;          // Of every frame (unit: pixel); 1 to 4096.
    int height = 0;         // (unit: pixel)
    float quality = 60.0F;  // libwebp's, 0 to 100.
  };

  // INVALID_ARGUMENT [BAD_ANIMATION] for a size out of range.
  static Result<AnimationWriter> Create(const Options& options);

  AnimationWriter(AnimationWriter&&) noexcept;
  AnimationWriter& operator=(AnimationWriter&&) noexcept;
  ~AnimationWriter();

  // Adds a frame that is shown for `duration_ms` (at least 1). INVALID_ARGUMENT [BAD_ANIMATION] where the image's size
  // is not that of the options; RESOURCE_EXHAUSTED where libwebp runs out of memory.
  Status Add(const Image& frame, int duration_ms);
  // Returns the file's bytes; nothing can be added any more. INVALID_ARGUMENT [BAD_ANIMATION] without a frame.
  Result<std::string> Finish();

 private:
  struct Impl;
  explicit AnimationWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fitroom
