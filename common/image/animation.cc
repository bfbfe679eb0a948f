#include "common/image/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <utility>

namespace fitroom {
namespace {

constexpr int kLargestSide = 4096;  // (unit: pixel)

Status Bad(const std::string& what) {
  return InvalidArgument("BAD_ANIMATION", "an animation cannot be written: " + what);
}

struct EncoderDeleter {
  void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
};

}  // namespace

struct AnimationWriter::Impl {
  Options options;
  WebPConfig config = {};
  std::unique_ptr<WebPAnimEncoder, EncoderDeleter> encoder;
  int time_ms = 0;
  int frame_count = 0;
};

AnimationWriter::AnimationWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
AnimationWriter::AnimationWriter(AnimationWriter&&) noexcept = default;
AnimationWriter& AnimationWriter::operator=(AnimationWriter&&) noexcept = default;
AnimationWriter::~AnimationWriter() = default;

Result<AnimationWriter> AnimationWriter::Create(const Options& options) {
  if (options.width < 1 || options.height < 1 || options.width > kLargestSide || options.height > kLargestSide) {
    return Bad("frames of " + std::to_string(options.width) + " x " + std::to_string(options.height) + " pixels");
  }
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  WebPAnimEncoderOptions encoder_options;
  if (WebPAnimEncoderOptionsInit(&encoder_options) == 0 || WebPConfigInit(&impl->config) == 0) {
    return Internal("WEBP_VERSION_MISMATCH", "libwebp does not match its header");
  }
  encoder_options.allow_mixed = 0;
  encoder_options.minimize_size = 0;
  impl->config.quality = options.quality;
  impl->config.method = 1;  // A third of the default's time, a tenth more bytes.
  impl->encoder.reset(WebPAnimEncoderNew(options.width, options.height, &encoder_options));
  if (impl->encoder == nullptr) return ResourceExhausted("OUT_OF_MEMORY", "no memory for an animation");
  return AnimationWriter(std::move(impl));
}

Status AnimationWriter::Add(const Image& frame, int duration_ms) {
  if (!IsValid(frame) || frame.width != impl_->options.width || frame.height != impl_->options.height) {
    return Bad("a frame has another size than the animation");
  }
  if (duration_ms < 1) return Bad("a frame is not shown at all");
  const Image rgb = frame.channels == 3 ? Image() : ConvertChannels(frame, 3);
  const Image& source = frame.channels == 3 ? frame : rgb;
  WebPPicture picture;
  if (WebPPictureInit(&picture) == 0) return Internal("WEBP_VERSION_MISMATCH", "libwebp does not match its header");
  picture.use_argb = 1;
  picture.width = source.width;
  picture.height = source.height;
  const bool is_added = WebPPictureImportRGB(&picture, source.pixels.data(), source.width * 3) != 0 &&
                        WebPAnimEncoderAdd(impl_->encoder.get(), &picture, impl_->time_ms, &impl_->config) != 0;
  WebPPictureFree(&picture);
  if (!is_added) {
    return ResourceExhausted("ANIMATION_FAILED", std::string("libwebp cannot add a frame: ") +
                                                     WebPAnimEncoderGetError(impl_->encoder.get()));
  }
  impl_->time_ms += duration_ms;
  ++impl_->frame_count;
  return Status();
}

Result<std::string> AnimationWriter::Finish() {
  if (impl_->frame_count == 0) return Bad("it has no frame");
  WebPData data;
  WebPDataInit(&data);
  const bool is_done = WebPAnimEncoderAdd(impl_->encoder.get(), nullptr, impl_->time_ms, nullptr) != 0 &&
                       WebPAnimEncoderAssemble(impl_->encoder.get(), &data) != 0;
  std::string bytes;
  if (is_done) bytes.assign(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  if (!is_done) {
    return ResourceExhausted("ANIMATION_FAILED", std::string("libwebp cannot write the animation: ") +
                                                     WebPAnimEncoderGetError(impl_->encoder.get()));
  }
  return bytes;
}

}  // namespace fitroom
