#include "fit_client/fit/paper/dress_as_printed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "fit_client/fit/stages/panel_outline.h"

namespace fitroom::paper {
namespace {

constexpr int kFront = 0;
constexpr int kBack = 1;

std::optional<int> FindNamed(const ClothMesh& cloth, std::string_view name) {
  for (const NamedParticle& named : cloth.named_particles) {
    if (named.name == name) return named.particle;
  }
  return std::nullopt;
}

bool IsBottom(const ClothMesh& cloth) {
  return !FindNamed(cloth, "front/P1").has_value() && FindNamed(cloth, "front/waist_centre").has_value();
}

Result<Eigen::Vector3d> PlaceOf(const Body& body, BodyLandmark landmark) {
  if (body.landmarks[landmark].confidence <= 0.0) {
    return FailedPrecondition("LANDMARK_MISSING", "the scan has no " + std::string(LandmarkName(landmark)) +
                                                      ", which a bottom is pulled up to; mark it by hand");
  }
  return body.landmarks[landmark].position;
}

// The closed top edge: front from its centre to the left, back from left to right, front from the right to its centre.
Result<std::vector<int>> TopEdge(const PanelOutline& front, const PanelOutline& back, int centre) {
  FR_ASSIGN_OR_RETURN(const std::vector<int> front_edge, front.Section("e3", "e1"));
  FR_ASSIGN_OR_RETURN(const std::vector<int> back_edge, back.Section("e1", "e3"));
  const auto middle = std::find(front_edge.begin(), front_edge.end(), centre);
  if (middle == front_edge.end()) {
    return InvalidArgument("PANEL_OUTLINE", "the front's waist centre does not lie on its top edge, between e1 and e3");
  }
  std::vector<int> edge(middle, front_edge.end());
  edge.insert(edge.end(), back_edge.begin(), back_edge.end());
  edge.insert(edge.end(), front_edge.begin(), middle);
  return edge;
}

}  // namespace

std::vector<int> ShoulderVertices(const ClothMesh& cloth, const Body& body,
                                  std::span<const Eigen::Vector3d> positions) {
  std::vector<int> vertices;
  for (const NamedParticle& named : cloth.named_particles) {
    const std::string name = named.name.substr(named.name.find('/') + 1);
    if (name.size() != 2 || name[0] != 'e') continue;
    const double x = positions[static_cast<size_t>(named.particle)].x();
    const BodyLandmark acromion = x > 0.0 ? BodyLandmark::kAcromionLeft : BodyLandmark::kAcromionRight;
    if (std::abs(x) <= std::abs(body.landmarks[acromion].position.x())) vertices.push_back(named.particle);
  }
  return vertices;
}

Result<PaperBottom> FindPaperBottom(const ClothMesh& cloth, const Body& body) {
  FR_ASSIGN_OR_RETURN(const PanelOutline front, PanelOutline::Trace(cloth, kFront));
  FR_ASSIGN_OR_RETURN(const PanelOutline back, PanelOutline::Trace(cloth, kBack));
  const std::optional<int> centre = FindNamed(cloth, "front/waist_centre");
  if (!centre.has_value()) return NotFound("POINT_MISSING", "the front panel has no waist centre");
  PaperBottom bottom;
  FR_ASSIGN_OR_RETURN(bottom.top_edge, TopEdge(front, back, *centre));
  FR_ASSIGN_OR_RETURN(bottom.outseams[0], front.Section("e1", "e2"));
  FR_ASSIGN_OR_RETURN(bottom.outseams[1], front.Section("e3", "e4"));
  for (const char* name : {"front/crotch", "back/crotch"}) {
    if (const std::optional<int> crotch = FindNamed(cloth, name)) bottom.crotch.push_back(*crotch);
  }
  const bool is_skirt = bottom.crotch.empty();
  if (is_skirt) bottom.crotch.push_back(*centre);
  FR_ASSIGN_OR_RETURN(bottom.groin, PlaceOf(body, is_skirt ? BodyLandmark::kWaistFront : BodyLandmark::kCrotch));
  return bottom;
}

Result<DressedAsPrinted> DressAsPrinted(const ClothMesh& cloth, const Body& body, const TriangleMesh& collider,
                                        std::span<const Eigen::Vector3d> start, const PaperOptions& options,
                                        Executor& executor,
                                        const std::function<void(PaperStage stage, int step)>& progress) {
  if (start.size() != cloth.rest_positions.size()) {
    return InvalidArgument("START_SIZE_MISMATCH", "there must be one start position a vertex of the cloth");
  }
  PaperOptions run_options = options;
  run_options.motion.frame = PaperFrame::YUp();
  if (IsBottom(cloth)) {
    FR_ASSIGN_OR_RETURN(run_options.bottom, FindPaperBottom(cloth, body));
  } else {
    run_options.shoulder_vertices = ShoulderVertices(cloth, body, start);
  }
  DressedAsPrinted dressed;
  std::vector<std::vector<Eigen::Vector3d>> on_the_way;
  const PaperObserver observer = [&](const PaperSnapshot& snapshot) {
    const auto keep = [&](std::vector<Eigen::Vector3d>& picture) {
      picture.assign(snapshot.positions.begin(), snapshot.positions.end());
    };
    if (snapshot.stage == PaperStage::kStart) keep(dressed.start);
    if (snapshot.stage == PaperStage::kMerging) keep(on_the_way.emplace_back());
    if (snapshot.stage == PaperStage::kStitched) keep(dressed.stitched);
    if (snapshot.stage == PaperStage::kBelted) keep(dressed.pulled_up);
    if (progress) progress(snapshot.stage, snapshot.step);
  };
  FR_ASSIGN_OR_RETURN(PaperResult result, PaperDrape(cloth, start, collider, run_options, executor, observer));
  dressed.merging = on_the_way.empty() ? dressed.start : on_the_way[on_the_way.size() / 2];
  dressed.final = std::move(result.positions);
  dressed.report = std::move(result.report);
  dressed.paper = result.paper;
  return dressed;
}

}  // namespace fitroom::paper
