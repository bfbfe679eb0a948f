#include "common/garment/validate.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "common/garment/polygon.h"

namespace fitroom {
namespace {

// Points may lie this far from the outline, as a part of the garment's height: hand-made annotations are not exact.
constexpr double kMaxOffOutline = 0.03;
// Points may pass each other on the outline by this part of its length (neck end and shoulder at the neck nearly meet).
constexpr double kOrderSlack = 0.004;

Status Invalid(std::string reason, std::string message) {
  return InvalidArgument(std::move(reason), std::move(message));
}

bool IsFinite(const Eigen::Vector2d& v) { return std::isfinite(v.x()) && std::isfinite(v.y()); }

bool IsInside(const Eigen::Vector2d& v, const GarmentView& view) {
  return IsFinite(v) && v.x() >= 0 && v.y() >= 0 && v.x() <= view.image_width && v.y() <= view.image_height;
}

Eigen::Vector2d At(const GarmentView& view, std::string_view name) { return FindPoint(view, name)->pixel; }

Status CheckFileNames(const GarmentView& view) {
  for (const std::string& name : {view.photo_file, view.mask_file, view.texture_file}) {
    if (!IsPlainFileName(name)) {
      return Invalid("GARMENT_FILE_NAME",
                     "\"" + name.substr(0, 40) + "\" is not a plain file name; use letters, digits, '.', '-' and '_'");
    }
  }
  return {};
}

Status CheckOutline(const GarmentView& view) {
  const size_t count = view.outline.size();
  if (count < 8 || count > static_cast<size_t>(kMaxOutlinePoints)) {
    return Invalid("OUTLINE_SIZE", "the outline has " + std::to_string(count) + " points, 8 to " +
                                       std::to_string(kMaxOutlinePoints) + " are allowed");
  }
  for (size_t i = 0; i < count; ++i) {
    if (!IsInside(view.outline[i], view)) {
      return Invalid("POINT_OUTSIDE_IMAGE", "outline point " + std::to_string(i) + " lies outside the image");
    }
  }
  if (SignedArea(view.outline) <= 0) {
    return Invalid("OUTLINE_DIRECTION", "the outline runs anticlockwise on the screen; reverse it");
  }
  if (const std::optional<Crossing> crossing = FindCrossing(view.outline)) {
    return Invalid("OUTLINE_NOT_SIMPLE", "the outline crosses itself (edges " + std::to_string(crossing->first_edge) +
                                             " and " + std::to_string(crossing->second_edge) + ")");
  }
  return {};
}

// Two pairs of points tell up from down: the upper end of a garment and its lower one.
struct Uprights {
  const char* upper_left;
  const char* upper_right;
  const char* lower_left;
  const char* lower_right;
};
constexpr Uprights kNeckAndHem = {"P2", "P1", "hem_L", "hem_R"};
constexpr Uprights kWaistAndHem = {"e1", "e3", "e2", "e4"};

// On a front photograph the wearer's left lies on the image's right. Right is taken across the garment, from the hem up
// to the neck or waist, so that a tilted garment is not mistaken for a swapped one.
Status CheckSides(GarmentKind kind, const GarmentView& view) {
  const Uprights& ends = IsBottom(kind) ? kWaistAndHem : kNeckAndHem;
  const Eigen::Vector2d top = 0.5 * (At(view, ends.upper_left) + At(view, ends.upper_right));
  const Eigen::Vector2d hem = 0.5 * (At(view, ends.lower_left) + At(view, ends.lower_right));
  const Eigen::Vector2d up = top - hem;
  if (up.norm() < 1.0) {
    return Invalid("POINT_OUT_OF_ORDER", std::string(ends.upper_left) + ", " + ends.upper_right + ", " +
                                             ends.lower_left + " and " + ends.lower_right +
                                             ": the upper end lies on the hem");
  }
  Eigen::Vector2d toward_left(-up.y(), up.x());
  if (view.side == GarmentSide::kBack) toward_left = -toward_left;
  for (const std::string& name : OutlinePointNames(kind)) {
    const std::string twin = TwinPointName(kind, name);
    if (twin == name || !IsLeftPoint(kind, name)) continue;
    if ((At(view, name) - At(view, twin)).dot(toward_left) <= 0) {
      return Invalid("POINTS_SWAPPED", name + " and " + twin +
                                           " are on each other's side; left and right are the wearer's: on a front "
                                           "photograph the wearer's left is on the image's right");
    }
  }
  return {};
}

Status CheckOrder(GarmentKind kind, const GarmentView& view) {
  const double perimeter = Perimeter(view.outline);
  double top = view.outline[0].y();
  double bottom = top;
  for (const Eigen::Vector2d& point : view.outline) {
    top = std::min(top, point.y());
    bottom = std::max(bottom, point.y());
  }
  const std::vector<std::string> order = OutlineOrder(kind, view.side);
  double start = 0.0;
  double previous = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    const OutlinePlace place = NearestPlace(view.outline, At(view, order[i]));
    if (place.distance > kMaxOffOutline * (bottom - top)) {
      return Invalid("POINT_OFF_OUTLINE", order[i] + " lies " + std::to_string(std::lround(place.distance)) +
                                              " pixels from the outline; move it onto the garment's edge");
    }
    if (i == 0) start = place.arc_length;
    double along = place.arc_length - start;
    if (along < 0) along += perimeter;
    if (along > perimeter * (1.0 - kOrderSlack)) along -= perimeter;  // Just before the start.
    if (along < previous - kOrderSlack * perimeter) {
      return Invalid("POINT_OUT_OF_ORDER", order[i] + " comes before " + order[i - 1] +
                                               " on the way round the outline; check these two points");
    }
    previous = std::max(previous, along);
  }
  return {};
}

bool IsGarmentId(const std::string& id) {
  return !id.empty() && id.size() <= 63 && std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

}  // namespace

bool IsPlainFileName(std::string_view name) {
  if (name.empty() || name.size() > 100 || name.front() == '.') return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c < 128 && std::isalnum(c) != 0) || c == '.' || c == '-' || c == '_';
  });
}

const std::vector<std::string>& ViewPointNames(GarmentKind kind, GarmentSide side) {
  return side == GarmentSide::kSideFolded ? SideFoldedPointNames() : OutlinePointNames(kind);
}

std::string DescribeView(GarmentKind kind, GarmentSide side) {
  return side == GarmentSide::kSideFolded ? "a side-folded photograph" : "a " + std::string(GarmentKindName(kind));
}

Status ValidatePoints(GarmentKind kind, const GarmentView& view) {
  const std::vector<std::string>& names = ViewPointNames(kind, view.side);
  for (const OutlinePoint& point : view.points) {
    if (std::find(names.begin(), names.end(), point.name) == names.end()) {
      return Invalid("POINT_UNKNOWN",
                     "\"" + point.name.substr(0, 40) + "\" is not a point of " + DescribeView(kind, view.side));
    }
    if (!IsInside(point.pixel, view)) return Invalid("POINT_OUTSIDE_IMAGE", point.name + " lies outside the image");
    if (!(point.confidence >= 0.0 && point.confidence <= 1.0)) {
      return Invalid("POINT_CONFIDENCE", point.name + " has a confidence that is not between 0 and 1");
    }
  }
  for (const std::string& name : names) {
    if (FindPoint(view, name) == nullptr) return Invalid("POINT_MISSING", name + " is missing; give all points");
  }
  for (size_t i = 0; i < names.size(); ++i) {
    if (view.points.size() != names.size() || view.points[i].name != names[i]) {
      return Invalid("POINT_OUT_OF_ORDER", names[i] + " is not at its place in the list, or a point is given twice");
    }
  }
  // Of a side-folded view the way round the outline alone tells left from right.
  return view.side == GarmentSide::kSideFolded ? Status() : CheckSides(kind, view);
}

Status ValidateView(GarmentKind kind, const GarmentView& view) {
  FR_RETURN_IF_ERROR(CheckFileNames(view));
  if (view.image_width < 1 || view.image_height < 1 || view.image_width > kMaxGarmentImageSide ||
      view.image_height > kMaxGarmentImageSide) {
    return Invalid("IMAGE_SIZE", "the image's sides must be 1 to " + std::to_string(kMaxGarmentImageSide) + " pixels");
  }
  if (!(view.metre_per_pixel > 1e-6 && view.metre_per_pixel < 1.0)) {
    return Invalid("METRE_PER_PIXEL", "the scale must lie between 0.001 and 1000 millimetres a pixel");
  }
  FR_RETURN_IF_ERROR(ValidatePoints(kind, view));
  FR_RETURN_IF_ERROR(CheckOutline(view));
  return CheckOrder(kind, view);
}

Status ValidateGarment(const Garment& garment) {
  if (!IsGarmentId(garment.id)) {
    return Invalid("GARMENT_ID", "the id must be 1 to 63 of the characters a-z, 0-9 and '-'");
  }
  if (garment.title.size() > 200) return Invalid("GARMENT_TITLE", "the title is longer than 200 bytes");
  if (!(garment.length >= kMinGarmentLength && garment.length <= kMaxGarmentLength)) {
    return Invalid("GARMENT_LENGTH", "the length must be 20 to 200 cm");
  }
  FR_RETURN_IF_ERROR(ValidateFabric(garment.fabric));
  FR_RETURN_IF_ERROR(ValidateMeasures(garment.kind, garment.measures));
  if (garment.chart != SizeChart{}) {
    FR_RETURN_IF_ERROR(ValidateSizeChart(garment.kind, garment.chart));
    FR_RETURN_IF_ERROR(CheckChartAgainstPhotographs(garment));
  }
  if (garment.front.side != GarmentSide::kFront || (garment.back && garment.back->side != GarmentSide::kBack)) {
    return Invalid("POINTS_SWAPPED", "front and back view are exchanged");
  }
  FR_RETURN_IF_ERROR(ValidateView(garment.kind, garment.front).At("front"));
  if (garment.back) FR_RETURN_IF_ERROR(ValidateView(garment.kind, *garment.back).At("back"));
  if (!garment.side_folded) return {};
  if (!HasLegs(garment.kind) || garment.side_folded->side != GarmentSide::kSideFolded) {
    return Invalid("SIDE_FOLDED_KIND", "a side-folded photograph belongs to pants and shorts alone; leave it out");
  }
  return ValidateView(garment.kind, *garment.side_folded).At("side_folded");
}

}  // namespace fitroom
