#include "fit_client/render/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/image/animation.h"
#include "fit_client/render/label.h"
#include "fit_client/render/pictures.h"
#include "fit_client/render/renderer.h"
#include "fit_client/render/run_both.h"

namespace fitroom::render {
namespace {

constexpr int kWidth = 640;   // (unit: pixel)
constexpr int kHeight = 960;  // (unit: pixel)
constexpr int kMostFrames = 60;
constexpr float kMergingOpacity = 0.8F;
// Between two keys the cloth goes straight, through the bust if need be: the body stands back (unit: metre).
constexpr double kStandBack = 0.035;

Status CheckRequest(const FilmRequest& request) {
  const auto bad = [](const char* what) { return InvalidArgument("BAD_FILM_REQUEST", what); };
  if (request.body == nullptr || request.cloth == nullptr) return bad("a film needs a body and a cloth");
  if (request.keys.empty()) return bad("a film needs at least one key");
  if (request.frame_count < 1 || request.frame_count > kMostFrames) return bad("a film has 1 to 60 frames");
  double last = -1.0;
  for (const FilmKey& key : request.keys) {
    if (!(key.seconds > last) || key.seconds > 60.0) return bad("a film's keys must follow each other within a minute");
    last = key.seconds;
    if (key.positions.size() != request.cloth->panel_of_particle.size())
      return bad("a film needs one position a particle");
  }
  return Status();
}

// The last key at or before a moment.
const FilmKey& KeyAt(const std::vector<FilmKey>& keys, double seconds) {
  const FilmKey* found = &keys.front();
  for (const FilmKey& key : keys) {
    if (key.seconds <= seconds + 1e-9) found = &key;
  }
  return *found;
}

double FrameTime(const FilmRequest& request, int frame) {
  const double begin = request.keys.front().seconds;
  const double end = request.keys.back().seconds;
  return request.frame_count == 1 ? end : begin + (end - begin) * frame / (request.frame_count - 1);
}

Eigen::AlignedBox3d SubjectOf(const FilmRequest& request) {
  Eigen::AlignedBox3d subject = ComputeBounds(request.body->mesh);
  for (const FilmKey& key : request.keys) {
    for (const Eigen::Vector3d& position : key.positions) {
      if (position.allFinite()) subject.extend(position);
    }
  }
  return subject;
}

Scene SceneAt(const FilmRequest& request, double seconds) {
  Scene scene;
  scene.body = request.body;
  const bool is_at_end = seconds >= request.keys.back().seconds - 1e-9;
  if (!is_at_end) scene.body_depth_bias = kStandBack;
  scene.garments = request.others;
  scene.garments.push_back(
      {request.cloth, FilmPositions(request.keys, seconds), request.front_texture, request.back_texture});
  if (KeyAt(request.keys, seconds).draw_stitch_lines) {
    scene.lines = MakeStitchLines(*request.cloth, scene.garments.back().positions);
    if (!scene.lines.empty()) scene.garments.back().opacity = kMergingOpacity;
  }
  return scene;
}

// Every second frame, from `first`.
struct Share {
  Status status;
  std::vector<Image> frames;
};

Share DrawShare(const FilmRequest& request, const Camera& camera, int first) {
  Share share;
  if (first >= request.frame_count) return share;
  Result<Renderer> renderer = Renderer::Create();
  if (!renderer.ok()) {
    share.status = renderer.status();
    return share;
  }
  LabelStyle style;
  style.height = 18.0;
  style.stroke_width = 2.2;
  for (int frame = first; frame < request.frame_count; frame += 2) {
    const double seconds = FrameTime(request, frame);
    Result<std::vector<Image>> pictures = renderer->Draw(SceneAt(request, seconds), {&camera, 1});
    if (!pictures.ok()) {
      share.status = pictures.status();
      return share;
    }
    DrawLabel(pictures->front(), KeyAt(request.keys, seconds).caption, 24, 24, style);
    share.frames.push_back(std::move(pictures->front()));
  }
  return share;
}

}  // namespace

std::vector<Eigen::Vector3d> FilmPositions(const std::vector<FilmKey>& keys, double seconds) {
  if (keys.empty()) return {};
  const FilmKey& from = KeyAt(keys, seconds);
  const size_t next = static_cast<size_t>(&from - keys.data()) + 1;
  if (next == keys.size() || seconds <= from.seconds) return from.positions;
  const FilmKey& to = keys[next];
  const double t = (seconds - from.seconds) / (to.seconds - from.seconds);
  std::vector<Eigen::Vector3d> positions(from.positions.size());
  for (size_t i = 0; i < positions.size(); ++i) positions[i] = (1.0 - t) * from.positions[i] + t * to.positions[i];
  return positions;
}

Result<std::string> DrawDressingFilm(const FilmRequest& request) {
  FR_RETURN_IF_ERROR(CheckRequest(request));
  Camera camera{request.view, SubjectOf(request), kWidth, kHeight};
  camera.samples_across = 1;
  std::array<Share, 2> shares;
  FR_RETURN_IF_ERROR(RunBoth(
      request.thread_count, [&] { shares[0] = DrawShare(request, camera, 0); },
      [&] { shares[1] = DrawShare(request, camera, 1); }));
  FR_RETURN_IF_ERROR(shares[0].status);
  FR_RETURN_IF_ERROR(shares[1].status);
  FR_ASSIGN_OR_RETURN(AnimationWriter writer, AnimationWriter::Create({kWidth, kHeight}));
  const double length = request.keys.back().seconds - request.keys.front().seconds;
  const int step_ms =
      std::max(20, static_cast<int>(std::lround(1000.0 * length / std::max(1, request.frame_count - 1))));
  for (int frame = 0; frame < request.frame_count; ++frame) {
    const bool is_last = frame + 1 == request.frame_count;
    FR_RETURN_IF_ERROR(writer.Add(shares[static_cast<size_t>(frame % 2)].frames[static_cast<size_t>(frame / 2)],
                                  is_last ? std::max(1, request.hold_ms) : step_ms));
  }
  return writer.Finish();
}

}  // namespace fitroom::render
