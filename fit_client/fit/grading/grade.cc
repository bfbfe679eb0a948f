#include "fit_client/fit/grading/grade.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fit_client/fit/grading/grade_measures.h"
#include "fit_client/fit/grading/grade_moves.h"
#include "fit_client/fit/grading/grade_targets.h"
#include "fit_client/fit/panels/polyline.h"

namespace fitroom {
namespace {

using grading::GradeTargets;
using grading::Increments;
using grading::MeasureMap;

constexpr int kMostRounds = 30;
constexpr double kExact = 1e-9;             // (unit: metre)
constexpr double kMostResidual = 0.002;     // Of a given measure (unit: metre).
constexpr double kMostHiddenGap = 0.03;     // Between a stated rise and crotch depth (unit: metre).
constexpr double kLeastSectionShare = 0.2;  // A section keeps this much of its length.

std::string Millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f mm", std::abs(metres) * 1000.0);
  return text;
}

// NaN for a measure that the outline lost on the way.
double ValueOf(const MeasureMap& measures, const std::string& name) {
  const auto found = measures.find(name);
  return found == measures.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

// Corrects the increments by what is missing until nothing is: the measures depend on them almost one to one, so that
// each round leaves a small part of the error.
GarmentPattern MeetTargets(const GarmentPattern& photographed, const MeasureMap& measured, const GradeTargets& goal) {
  Increments increments;
  for (const grading::GradeDriver& driver : goal.drivers) {
    increments[driver.increment] = driver.sign * (goal.targets.at(driver.measure) - ValueOf(measured, driver.measure));
  }
  // A crotch that is driven by the inseam sinks with the hem as well.
  if (increments.contains("crotch_depth") && goal.drivers.end()[-2].sign < 0) {
    increments["crotch_depth"] += increments["length"];
  }
  GarmentPattern graded = photographed;
  for (int round = 0; round < kMostRounds; ++round) {
    graded = grading::ApplyMoves(photographed, grading::MovesFor(photographed, measured, increments));
    const MeasureMap now = grading::MeasureByName(graded);
    double worst = 0.0;
    for (const grading::GradeDriver& driver : goal.drivers) {
      const double missing = goal.targets.at(driver.measure) - ValueOf(now, driver.measure);
      if (!std::isfinite(missing)) return graded;
      worst = std::max(worst, std::abs(missing));
      increments[driver.increment] += driver.sign * missing;
    }
    if (!(worst > kExact)) break;
  }
  return graded;
}

std::vector<GradedMeasure> Account(const GarmentPattern& photographed, const GarmentPattern& graded,
                                   const MeasureMap& measured, const GradeTargets& goal) {
  const MeasureMap now = grading::MeasureByName(graded);
  std::vector<GradedMeasure> measures;
  for (const std::string& name : MeasureNames(photographed.kind)) {
    const auto found = measured.find(name);
    if (found == measured.end()) continue;
    GradedMeasure measure;
    measure.name = name;
    measure.photographed = found->second;
    measure.target = goal.targets.at(name);
    measure.graded = ValueOf(now, name);
    measure.given = std::find(goal.given.begin(), goal.given.end(), name) != goal.given.end();
    measure.hidden = grading::IsHiddenByFolding(photographed.kind, name);
    measures.push_back(std::move(measure));
  }
  return measures;
}

Status CheckResiduals(const GarmentSize& to, const std::vector<GradedMeasure>& measures) {
  const GradedMeasure* worst = nullptr;
  for (const GradedMeasure& measure : measures) {
    if (!measure.given) continue;
    const double allowed = measure.hidden ? kMostHiddenGap : kMostResidual;
    if (std::abs(measure.residual()) <= allowed) continue;
    if (worst == nullptr || std::abs(measure.residual()) > std::abs(worst->residual())) worst = &measure;
  }
  if (worst == nullptr) return {};
  return InvalidArgument("CHART_CONTRADICTORY", "size " + to.name + ": " + worst->name + " would end " +
                                                    Millimetres(worst->residual()) +
                                                    " off, because the other measures leave no room for it; correct "
                                                    "it, or leave it out of the size chart");
}

Status CheckPanel(const GarmentSize& to, const PanelPattern& before, const PanelPattern& after) {
  const auto refuse = [&](const std::string& what) {
    return InvalidArgument("CHART_INVERTS_OUTLINE", "size " + to.name + ": " + what +
                                                        "; its widths and lengths do not go together, correct the "
                                                        "size chart");
  };
  for (size_t s = 0; s < after.sections.size(); ++s) {
    for (const Eigen::Vector2d& p : after.sections[s].points) {
      if (!p.allFinite()) return refuse(after.sections[s].name + " could not be drawn");
    }
    const double length_before = panels::ChainLength(before.sections[s].points);
    const double length_after = panels::ChainLength(after.sections[s].points);
    if (length_after < kLeastSectionShare * length_before) {
      return refuse(after.sections[s].name + " would shrink from " + Millimetres(length_before) + " to " +
                    Millimetres(length_after));
    }
  }
  const std::vector<Eigen::Vector2d> outline = JoinedPoints(after);
  if (panels::SignedArea(outline) <= 0.0 || !panels::IsSimplePolygon(outline)) {
    return refuse("the outline would cross itself");
  }
  return {};
}

}  // namespace

Result<GradedPattern> GradePatternInDetail(const GarmentPattern& photographed, const GarmentSize& from,
                                           const GarmentSize& to) {
  const MeasureMap measured = grading::MeasureByName(photographed);
  FR_ASSIGN_OR_RETURN(const GradeTargets goal, grading::FindGradeTargets(photographed.kind, measured, from, to));
  GradedPattern result;
  result.pattern = MeetTargets(photographed, measured, goal);
  result.measures = Account(photographed, result.pattern, measured, goal);
  FR_RETURN_IF_ERROR(CheckPanel(to, photographed.front, result.pattern.front).At("front"));
  FR_RETURN_IF_ERROR(CheckPanel(to, photographed.back, result.pattern.back).At("back"));
  FR_RETURN_IF_ERROR(CheckResiduals(to, result.measures));
  return result;
}

Result<GarmentPattern> GradePattern(const GarmentPattern& photographed, const GarmentSize& from,
                                    const GarmentSize& to) {
  FR_ASSIGN_OR_RETURN(GradedPattern graded, GradePatternInDetail(photographed, from, to));
  return std::move(graded.pattern);
}

}  // namespace fitroom
