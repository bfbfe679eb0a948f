#include "fit_client/render/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "common/image/encode.h"
#include "fit_client/render/garment_surface.h"
#include "fit_client/render/image_scaling.h"
#include "fit_client/render/label.h"
#include "fit_client/render/renderer.h"
#include "fit_client/render/run_both.h"

namespace fitroom::render {
namespace {

constexpr int kPictureWidth = 800;    // (unit: pixel)
constexpr int kPictureHeight = 1200;  // (unit: pixel)
// Stages are drawn at half the size: the last stage's are then the final pictures, halved.
constexpr int kStageWidth = kPictureWidth / 2;
constexpr int kStageHeight = kPictureHeight / 2;
// Close-ups show the garment and this much round it (unit: metre).
constexpr double kCloseMargin = 0.06;
constexpr int kCloseWidth = 800;   // (unit: pixel)
constexpr int kCloseHeight = 900;  // (unit: pixel)
constexpr float kMergingOpacity = 0.72F;

constexpr std::array<ViewDirection, 4> kFinalViews = {ViewDirection::kFront, ViewDirection::kSide, ViewDirection::kBack,
                                                      ViewDirection::kThreeQuarter};
constexpr std::array<ViewDirection, 3> kStageViews = {ViewDirection::kFront, ViewDirection::kSide,
                                                      ViewDirection::kBack};

constexpr std::array<ViewDirection, 2> kCloseViews = {ViewDirection::kFront, ViewDirection::kBack};

std::string ViewDescription(ViewDirection view) {
  switch (view) {
    case ViewDirection::kFront:
      return "front view";
    case ViewDirection::kSide:
      return "view from the left";
    case ViewDirection::kBack:
      return "back view";
    case ViewDirection::kThreeQuarter:
      return "three-quarter view";
  }
  return "";
}

Status CheckRequest(const FitPictureRequest& request) {
  const auto bad = [](const char* what) { return InvalidArgument("BAD_PICTURE_REQUEST", what); };
  if (request.body == nullptr || request.cloth == nullptr) return bad("pictures need a body and a cloth");
  if (request.stages.empty()) return bad("pictures need at least one stage");
  for (const StageShape& stage : request.stages) {
    if (stage.name.empty()) return bad("every stage needs a name");
    if (stage.positions.size() != request.cloth->panel_of_particle.size()) {
      return bad("every stage needs one position a particle");
    }
    for (const Eigen::Vector3d& position : stage.positions) {
      if (!position.allFinite()) return bad("a particle is nowhere (not a number)");
    }
  }
  for (const SeamPair& pair : request.cloth->seams) {
    const int count = static_cast<int>(request.cloth->panel_of_particle.size());
    if (std::min(pair.a, pair.b) < 0 || std::max(pair.a, pair.b) >= count) return bad("a seam names no particle");
  }
  return Status();
}

Scene MakeScene(const FitPictureRequest& request, const StageShape& stage) {
  Scene scene;
  scene.body = request.body;
  scene.garments = request.others;
  scene.garments.push_back({request.cloth, stage.positions, request.front_texture, request.back_texture});
  if (stage.draw_stitch_lines) {
    scene.lines = MakeStitchLines(*request.cloth, stage.positions);
    scene.garments.back().opacity = kMergingOpacity;
  }
  return scene;
}

// Everything that any stage shows, so that all pictures have one scale.
Eigen::AlignedBox3d ComputeSubject(const FitPictureRequest& request) {
  Eigen::AlignedBox3d subject = ComputeBounds(request.body->mesh);
  for (const GarmentShape& other : request.others) {
    for (const Eigen::Vector3d& position : other.positions) subject.extend(position);
  }
  for (const StageShape& stage : request.stages) {
    for (const Eigen::Vector3d& position : stage.positions) subject.extend(position);
  }
  return subject;
}

Eigen::AlignedBox3d ComputeGarmentSubject(const StageShape& stage) {
  Eigen::AlignedBox3d subject;
  for (const Eigen::Vector3d& position : stage.positions) subject.extend(position);
  subject.min().array() -= kCloseMargin;
  subject.max().array() += kCloseMargin;
  return subject;
}

template <size_t N>
std::vector<Camera> MakeCameras(const std::array<ViewDirection, N>& views, const Eigen::AlignedBox3d& subject,
                                int width, int height) {
  std::vector<Camera> cameras;
  for (const ViewDirection view : views) cameras.push_back({view, subject, width, height});
  return cameras;
}

// The pictures of one thread's share, with their PNGs.
struct DrawnPictures {
  Status status;
  std::vector<std::vector<Image>> images;  // A row a scene.
  std::vector<std::vector<std::string>> pngs;
};

// Draws and encodes each scene from all cameras on the calling thread.
DrawnPictures DrawShare(const std::vector<Scene>& scenes, const std::vector<Camera>& cameras) {
  DrawnPictures drawn;
  if (scenes.empty()) return drawn;
  Result<Renderer> renderer = Renderer::Create();
  if (!renderer.ok()) {
    drawn.status = renderer.status();
    return drawn;
  }
  for (const Scene& scene : scenes) {
    Result<std::vector<Image>> images = renderer->Draw(scene, cameras);
    if (!images.ok()) {
      drawn.status = images.status();
      return drawn;
    }
    std::vector<std::string> pngs;
    for (const Image& image : *images) pngs.push_back(EncodePng(image));
    drawn.images.push_back(*std::move(images));
    drawn.pngs.push_back(std::move(pngs));
  }
  return drawn;
}

void CopyInto(const Image& from, Image& to, int x, int y) {
  for (int row = 0; row < from.height; ++row) {
    std::memcpy(to.at(x, y + row), from.at(0, row), static_cast<size_t>(from.width) * 3);
  }
}

}  // namespace

std::vector<LineSegment> MakeStitchLines(const ClothMesh& cloth, const std::vector<Eigen::Vector3d>& positions) {
  constexpr double kSpacing = 0.02;  // (unit: metre)
  std::vector<LineSegment> lines;
  for (const SeamPair& pair : cloth.seams) {
    const Eigen::Vector3d& from = positions[static_cast<size_t>(pair.a)];
    const Eigen::Vector3d& to = positions[static_cast<size_t>(pair.b)];
    if ((from - to).norm() <= kWeldedGap) continue;
    // Pairs may come in any order, from several seams by turns.
    const bool is_crowded = std::any_of(
        lines.begin(), lines.end(), [&from](const LineSegment& line) { return (from - line.from).norm() < kSpacing; });
    if (is_crowded) continue;
    lines.push_back({from, to, Colour(0.86F, 0.13F, 0.16F)});
  }
  return lines;
}

Image ComposeSheet(const std::vector<std::vector<Image>>& rows, const std::vector<std::string>& row_labels,
                   const std::vector<std::string>& column_labels) {
  constexpr int kGap = 6;     // Between pictures (unit: pixel).
  constexpr int kHead = 46;   // Above the first row (unit: pixel).
  constexpr int kInset = 14;  // Of a row's label from its picture's corner (unit: pixel).
  FR_CHECK(!rows.empty() && !rows.front().empty());
  const Image& first = rows.front().front();
  const int columns = static_cast<int>(rows.front().size());
  const int width = columns * first.width + (columns - 1) * kGap;
  const int height = kHead + static_cast<int>(rows.size()) * (first.height + kGap) - kGap;
  Image sheet{width, height, 3,
              std::vector<uint8_t>(static_cast<size_t>(width) * static_cast<size_t>(height) * 3, 255)};
  const LabelStyle head;
  for (size_t c = 0; c < column_labels.size() && c < rows.front().size(); ++c) {
    const int left = static_cast<int>(c) * (first.width + kGap);
    const double x = left + 0.5 * (first.width - MeasureLabel(column_labels[c], head));
    DrawLabel(sheet, column_labels[c], x, 0.5 * (kHead - head.height), head);
  }
  LabelStyle small;
  small.height = 10.0;
  small.stroke_width = 1.3;
  for (size_t r = 0; r < rows.size(); ++r) {
    const int top = kHead + static_cast<int>(r) * (first.height + kGap);
    for (size_t c = 0; c < rows[r].size(); ++c) {
      FR_CHECK(rows[r][c].width == first.width && rows[r][c].height == first.height && rows[r][c].channels == 3);
      CopyInto(rows[r][c], sheet, static_cast<int>(c) * (first.width + kGap), top);
    }
    if (r < row_labels.size()) DrawLabel(sheet, row_labels[r], kInset, top + kInset, small);
  }
  return sheet;
}

Result<std::vector<NamedPicture>> DrawFitPictures(const FitPictureRequest& request) {
  FR_RETURN_IF_ERROR(CheckRequest(request));
  const Eigen::AlignedBox3d subject = ComputeSubject(request);
  std::vector<Camera> final_cameras = MakeCameras(kFinalViews, subject, kPictureWidth, kPictureHeight);
  const Eigen::AlignedBox3d garment = ComputeGarmentSubject(request.stages.back());
  for (const Camera& camera : MakeCameras(kCloseViews, garment, kCloseWidth, kCloseHeight)) {
    final_cameras.push_back(camera);
  }
  const std::vector<Camera> stage_cameras = MakeCameras(kStageViews, subject, kStageWidth, kStageHeight);
  std::vector<Scene> stage_scenes;
  for (const StageShape& stage : request.stages) stage_scenes.push_back(MakeScene(request, stage));
  const std::vector<Scene> final_scene = {stage_scenes.back()};
  stage_scenes.pop_back();

  DrawnPictures finals;
  DrawnPictures stages;
  FR_RETURN_IF_ERROR(RunBoth(
      request.thread_count, [&] { finals = DrawShare(final_scene, final_cameras); },
      [&] { stages = DrawShare(stage_scenes, stage_cameras); }));
  FR_RETURN_IF_ERROR(finals.status);
  FR_RETURN_IF_ERROR(stages.status);

  // The last stage is what the final pictures show.
  stages.images.emplace_back();
  stages.pngs.emplace_back();
  for (size_t v = 0; v < kStageViews.size(); ++v) {
    stages.images.back().push_back(HalveImage(finals.images.front()[v]));
    stages.pngs.back().push_back(EncodePng(stages.images.back().back()));
  }

  std::vector<NamedPicture> pictures;
  for (size_t v = 0; v < kFinalViews.size(); ++v) {
    pictures.push_back({std::string(ViewName(kFinalViews[v])) + ".png", ViewDescription(kFinalViews[v]),
                        std::move(finals.pngs.front()[v])});
  }
  for (size_t v = 0; v < kCloseViews.size(); ++v) {
    pictures.push_back({std::string(ViewName(kCloseViews[v])) + "_close.png",
                        ViewDescription(kCloseViews[v]) + ", close",
                        std::move(finals.pngs.front()[kFinalViews.size() + v])});
  }
  std::vector<std::vector<Image>> rows(kStageViews.size());
  std::vector<std::string> column_labels;
  for (size_t s = 0; s < request.stages.size(); ++s) {
    const StageShape& stage = request.stages[s];
    column_labels.push_back(stage.title.empty() ? stage.name : stage.title);
    for (size_t v = 0; v < kStageViews.size(); ++v) {
      pictures.push_back({"stage_" + stage.name + "_" + ViewName(kStageViews[v]) + ".png",
                          column_labels.back() + ", " + ViewDescription(kStageViews[v]), std::move(stages.pngs[s][v])});
      rows[v].push_back(std::move(stages.images[s][v]));
    }
  }
  pictures.push_back({"stages.png", "the stages of the process, from front, side and back",
                      EncodePng(ComposeSheet(rows, {"front", "side", "back"}, column_labels))});
  return pictures;
}

}  // namespace fitroom::render
