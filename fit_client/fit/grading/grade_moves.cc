#include "fit_client/fit/grading/grade_moves.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/base/check.h"

namespace fitroom::grading {
namespace {

// A shoulder seam shorter than this has no slope to keep (unit: metre).
constexpr double kLeastShoulder = 0.01;

const Eigen::Vector2d& At(const PanelPattern& panel, const std::string& name) {
  const Eigen::Vector2d* point = FindPatternPoint(panel, name);
  FR_CHECK(point != nullptr);
  return *point;
}

double Of(const MeasureMap& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? 0.0 : found->second;
}

double Ratio(const MeasureMap& measures, const Increments& increments, const std::string& name) {
  const double measured = Of(measures, name);
  return measured > 0.0 ? std::max(0.1, 1.0 + Of(increments, name) / measured) : 1.0;
}

// From a to b, counter-clockwise positive (unit: radian).
double AngleBetween(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// The names of the cardinal points of one side of a top.
struct TopNames {
  std::string neck, neck_shoulder, tip, sleeve_top, sleeve_bottom, underarm, waist, hip, hem;
};

TopNames NamesOf(GarmentKind kind, bool left) {
  const std::string end = left ? "_L" : "_R";
  TopNames names{left ? "P2" : "P1", left ? "e1" : "e5", left ? "e3" : "e7", left ? "e4" : "e8", "sleeve_bottom" + end,
                 "underarm" + end,   "waist" + end,      "hip" + end,        "hem" + end};
  if (kind == GarmentKind::kOnePiece || kind == GarmentKind::kSleevedOnePiece) {
    names.tip = left ? "e2" : "e6";
    names.sleeve_top = "sleeve_top" + end;
  }
  return names;
}

// The sleeve's end once it is moved.
struct SleeveEnd {
  Eigen::Vector2d top, bottom;
};

// The step of a section's outline that leaves its corner: to the next sample, and how many there are to `other`.
struct Departure {
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  double count = 1.0;
};

Departure Leaving(const PanelPattern& panel, const std::string& section_name, const std::string& corner,
                  const std::string& other) {
  const OutlineSection* section = FindSection(panel, section_name);
  FR_CHECK(section != nullptr && section->points.size() >= 2);
  const bool first = section->knots.front().name == corner;
  const std::vector<Eigen::Vector2d>& points = section->points;
  int from = 0, to = 0;
  for (const SectionKnot& knot : section->knots) {
    if (knot.name == corner) from = knot.index;
    if (knot.name == other) to = knot.index;
  }
  const Eigen::Vector2d next = first ? points[1] : points[points.size() - 2];
  return {next - points[static_cast<size_t>(from)], std::max(1.0, std::abs(static_cast<double>(to - from)))};
}

// Turns a sleeve's end outwards about the shoulder tip until its underside leaves the side seam at 6 degrees, or at the
// photographed angle if that is less: a chest that grows faster than the shoulder pushes the underarm out beneath the
// sleeve. How a sleeve lies is no measure. `underside` is the first step from the underarm, `side` that of the moved
// side seam.
SleeveEnd MakeRoom(const SleeveEnd& end, const Eigen::Vector2d& tip, const Eigen::Vector2d& bottom_before,
                   const Eigen::Vector2d& underarm_move, const Departure& underside, const Eigen::Vector2d& side_before,
                   const Eigen::Vector2d& side_after, bool left) {
  constexpr double kLeastRoom = 0.105, kMostTurn = 0.7;  // (unit: radian)
  const double sign = left ? 1.0 : -1.0;
  const double least = std::min(kLeastRoom, sign * AngleBetween(side_before, underside.step));
  const auto turned = [&](double angle) {
    const Eigen::Rotation2Dd turn(sign * angle);
    return SleeveEnd{tip + turn * (end.top - tip), tip + turn * (end.bottom - tip)};
  };
  const auto room = [&](const SleeveEnd& tried) {
    const Eigen::Vector2d step = underside.step + (tried.bottom - bottom_before - underarm_move) / underside.count;
    return sign * AngleBetween(side_after, step);
  };
  if (room(end) >= least) return end;
  double low = 0.0, high = kMostTurn;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (room(turned(middle)) < least ? low : high) = middle;
  }
  return turned(high);
}

// One side of a top. Widths move half of their increment outwards; the shoulder keeps its slope; the armhole's depth
// grows half as fast as the chest (Aldrich, "Metric pattern cutting", size charts: 0.5 to 0.6 cm a size of 4 to 4.5
// cm), half as the length; waist and hip keep their share of the way from underarm to hem; the sleeve keeps its
// direction.
void MoveTopSide(const GarmentPattern& pattern, const MeasureMap& measures, const Increments& add, bool left,
                 GradeMoves& moves) {
  const PanelPattern& front = pattern.front;
  const TopNames names = NamesOf(pattern.kind, left);
  const double outwards = left ? 0.5 : -0.5;
  const auto half = [&](const char* name) { return outwards * Of(add, name); };
  const Eigen::Vector2d neck_move(half("neck_width"), 0.0);
  moves.shared[names.neck] = neck_move;
  moves.shared[names.neck_shoulder] = neck_move;

  const Eigen::Vector2d& neck = At(front, names.neck);
  const Eigen::Vector2d& tip = At(front, names.tip);
  const double seam = std::abs(tip.x() - neck.x());
  const double seam_growth = 0.5 * (Of(add, "shoulder_width") - Of(add, "neck_width"));
  const double slope = seam > kLeastShoulder ? (tip.y() - neck.y()) / seam : 0.0;
  const Eigen::Vector2d tip_move(half("shoulder_width"), slope * seam_growth);
  moves.shared[names.tip] = tip_move;

  const Eigen::Vector2d& underarm = At(front, names.underarm);
  const double length_add = 0.5 * (Of(add, "front_length") + Of(add, "back_length"));
  const double length_ratio = std::sqrt(Ratio(measures, add, "front_length") * Ratio(measures, add, "back_length"));
  const double depth_ratio = std::sqrt(Ratio(measures, add, "chest_width") * length_ratio);
  const Eigen::Vector2d underarm_move(half("chest_width"),
                                      tip_move.y() - (depth_ratio - 1.0) * (tip.y() - underarm.y()));
  moves.shared[names.underarm] = underarm_move;
  const double hem_y = At(front, names.hem).y();
  const auto drop = [&](const std::string& name) {
    const double share = (underarm.y() - At(front, name).y()) / (underarm.y() - hem_y);
    return (1.0 - share) * underarm_move.y() - share * length_add;
  };
  moves.shared[names.waist] = {half("waist_width"), drop(names.waist)};
  moves.shared[names.hip] = {half("hip_width"), drop(names.hip)};
  moves.shared[names.hem] = {half("hem_width"), -length_add};
  if (!HasSleeves(pattern.kind)) return;

  const Eigen::Vector2d& top = At(front, names.sleeve_top);
  const Eigen::Vector2d& bottom = At(front, names.sleeve_bottom);
  const Eigen::Vector2d top_move = tip_move + Of(add, "sleeve_length") * (top - tip).normalized();
  const Eigen::Vector2d bottom_move = top_move + Of(add, "sleeve_opening") * (bottom - top).normalized();
  const std::string end_name = left ? "_L" : "_R";
  const Departure side = Leaving(front, "side" + end_name, names.underarm, names.waist);
  const Eigen::Vector2d side_after = side.step + (moves.shared[names.waist] - underarm_move) / side.count;
  const SleeveEnd end = MakeRoom({top + top_move, bottom + bottom_move}, tip + tip_move, bottom, underarm_move,
                                 Leaving(front, "underside" + end_name, names.underarm, names.sleeve_bottom), side.step,
                                 side_after, left);
  moves.shared[names.sleeve_top] = end.top - top;
  moves.shared[names.sleeve_bottom] = end.bottom - bottom;
}

GradeMoves TopMoves(const GarmentPattern& pattern, const MeasureMap& measures, const Increments& add) {
  GradeMoves moves;
  for (const bool left : {true, false}) MoveTopSide(pattern, measures, add, left, moves);
  const double neck_ratio = Ratio(measures, add, "neck_width");
  for (const bool is_front : {true, false}) {
    const PanelPattern& panel = is_front ? pattern.front : pattern.back;
    auto& own = is_front ? moves.front_only : moves.back_only;
    const double depth = 0.5 * (At(panel, "P1").y() + At(panel, "P2").y()) - At(panel, "neck_drop").y();
    own["neck_drop"] = {0.0, -(neck_ratio - 1.0) * depth};
    own["hem_centre"] = {0.0, -Of(add, is_front ? "front_length" : "back_length")};
  }
  return moves;
}

GradeMoves SkirtMoves(const GarmentPattern& pattern, const MeasureMap& measures, const Increments& add) {
  GradeMoves moves;
  const double length_ratio = Ratio(measures, add, "length");
  for (const bool left : {true, false}) {
    const double outwards = left ? 0.5 : -0.5;
    const std::string waist = left ? "e1" : "e3", hem = left ? "e2" : "e4", hip = left ? "hip_L" : "hip_R";
    // The hip's depth below the waist follows hip and length alike, as an armhole does chest and length.
    const double depth_ratio = std::sqrt(Ratio(measures, add, "hip_width") * length_ratio);
    const double hip_depth = At(pattern.front, waist).y() - At(pattern.front, hip).y();
    moves.shared[waist] = {outwards * Of(add, "waist_width"), 0.0};
    moves.shared[hip] = {outwards * Of(add, "hip_width"), -(depth_ratio - 1.0) * hip_depth};
    moves.shared[hem] = {outwards * Of(add, "hem_width"), -Of(add, "length")};
  }
  moves.shared["waist_centre"] = {0.0, 0.0};
  moves.shared["hem_centre"] = {0.0, -Of(add, "length")};
  return moves;
}

// The crotch stays on the centre line. The leg's middle moves outwards by half of what the thigh gains, so that the
// crease stays straight; knee and hem widen about it, along their own directions.
void MoveLeg(const PanelPattern& front, const Increments& add, bool left, GradeMoves& moves) {
  const std::string end = left ? "_L" : "_R";
  const double outwards = left ? 1.0 : -1.0;
  const double crotch_drop = -Of(add, "crotch_depth");
  const double hem_drop = -Of(add, "length");
  const double crotch_y = At(front, "crotch").y();
  const double hem_y = At(front, left ? "e2" : "e4").y();
  const Eigen::Vector2d middle(0.5 * outwards * Of(add, "thigh_width"), 0.0);
  moves.shared["crotch_level" + end] = {outwards * Of(add, "thigh_width"), crotch_drop};
  const auto widen = [&](const std::string& outer, const std::string& inner, double increment) {
    const Eigen::Vector2d across = (At(front, outer) - At(front, inner)).normalized();
    const double y = 0.5 * (At(front, outer).y() + At(front, inner).y());
    const double share = (crotch_y - y) / (crotch_y - hem_y);
    const Eigen::Vector2d base = middle + Eigen::Vector2d(0.0, (1.0 - share) * crotch_drop + share * hem_drop);
    moves.shared[outer] = base + 0.5 * increment * across;
    moves.shared[inner] = base - 0.5 * increment * across;
  };
  widen("thigh_outer" + end, "thigh_inner" + end, Of(add, "thigh_width"));
  widen("knee_outer" + end, "knee_inner" + end, Of(add, "knee_width"));
  widen(left ? "e2" : "e4", "hem_inner" + end, Of(add, "hem_width"));
}

GradeMoves TrouserMoves(const GarmentPattern& pattern, const Increments& add) {
  GradeMoves moves;
  const PanelPattern& front = pattern.front;
  const double crotch_y = At(front, "crotch").y();
  for (const bool left : {true, false}) {
    const double outwards = left ? 0.5 : -0.5;
    const std::string waist = left ? "e1" : "e3", hip = left ? "hip_L" : "hip_R";
    const double waist_y = At(front, waist).y();
    const double share = (waist_y - At(front, hip).y()) / (waist_y - crotch_y);
    moves.shared[waist] = {outwards * Of(add, "waist_width"), 0.0};
    moves.shared[hip] = {outwards * Of(add, "hip_width"), -share * Of(add, "crotch_depth")};
    MoveLeg(front, add, left, moves);
  }
  moves.shared["crotch"] = {0.0, -Of(add, "crotch_depth")};
  moves.shared["waist_centre"] = {0.0, 0.0};
  return moves;
}

}  // namespace

GradeMoves MovesFor(const GarmentPattern& pattern, const MeasureMap& measures, const Increments& increments) {
  if (!IsBottom(pattern.kind)) return TopMoves(pattern, measures, increments);
  if (pattern.kind == GarmentKind::kSkirt) return SkirtMoves(pattern, measures, increments);
  return TrouserMoves(pattern, increments);
}

}  // namespace fitroom::grading
