#include "shop_catalog/garment/fork_draft.h"

namespace fitroom::shop_catalog {
namespace {

using Eigen::Vector2d;

// The hip line lies at two thirds of the crotch depth; the curve begins 45 % of that distance below it.
constexpr double kCurveStart = 2.0 / 3.0 * 0.45;
constexpr double kRoundness = 0.6;  // Length of the cubic's handles, part of its box.

}  // namespace

std::optional<ForkRule> ForkRuleFromName(std::string_view name) {
  if (name == "close") return ForkRule::kClose;
  if (name == "trouser") return ForkRule::kTrouser;
  if (name == "classic") return ForkRule::kClassic;
  return std::nullopt;
}

FlatCurve CrotchCurve(double depth, double extension) {
  const double start = depth * (1.0 - kCurveStart);
  FlatCurve curve = {Vector2d(0.0, 0.0)};
  AppendLine(curve, Vector2d(0.0, start));
  AppendCurve(curve, Vector2d(0.0, start + kRoundness * (depth - start)),
              Vector2d(-(1.0 - kRoundness) * extension, depth), Vector2d(-extension, depth));
  return curve;
}

ForkDraft DraftFork(double hip_width, double crotch_depth, ForkRule rule) {
  const double hip = 2.0 * hip_width;
  ForkDraft draft;
  draft.front_extension = hip / 16.0;
  draft.back_extension = hip / 16.0;
  if (rule == ForkRule::kTrouser) draft.back_extension = hip / 10.0;
  if (rule == ForkRule::kClassic) {
    draft.front_extension += 0.5;
    draft.back_extension = 0.25 * (hip / 12.0 + 1.5) + 1.5 * draft.front_extension;
  }
  draft.front_rise = CurveLength(CrotchCurve(crotch_depth, draft.front_extension));
  draft.back_rise = CurveLength(CrotchCurve(crotch_depth, draft.back_extension));
  draft.thigh_width = 0.5 * (hip_width + draft.front_extension + draft.back_extension);
  return draft;
}

}  // namespace fitroom::shop_catalog
