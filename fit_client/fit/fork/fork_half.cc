#include "fit_client/fit/fork/fork_half.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "fit_client/fit/panels/view_samples.h"

namespace fitroom::fork {
namespace {

// A mirrored picture reaches at most this far across the leg (share of its width).
constexpr double kMostReach = 0.6;

const OutlineSection& SectionOf(const PanelPattern& panel, const std::string& name) {
  const OutlineSection* section = FindSection(panel, name);
  FR_CHECK(section != nullptr);
  return *section;
}

// The section seen in a mirror at x = 0, running the other way round.
OutlineSection TurnedOver(const OutlineSection& section) {
  OutlineSection turned = section;
  turned.points = panels::Mirrored(section.points);
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  std::reverse(turned.knots.begin(), turned.knots.end());
  for (SectionKnot& knot : turned.knots) knot.index = static_cast<int>(section.points.size()) - 1 - knot.index;
  return turned;
}

// The part of the waist from its wearer's left end to its middle.
OutlineSection HalfWaist(const OutlineSection& waist) {
  const auto middle = std::find_if(waist.knots.begin(), waist.knots.end(),
                                   [](const SectionKnot& knot) { return knot.name == "waist_centre"; });
  FR_CHECK(middle != waist.knots.end());
  OutlineSection half = waist;
  half.points.resize(static_cast<size_t>(middle->index) + 1);
  half.pixels.resize(half.points.size());
  half.knots.assign(waist.knots.begin(), middle + 1);
  return half;
}

}  // namespace

HalfPanel TakeHalf(const PanelPattern& panel, bool left) {
  const std::string end = left ? "_L" : "_R";
  const auto taken = [&](const std::string& name) {
    const OutlineSection& section = SectionOf(panel, name + end);
    return left ? section : TurnedOver(section);
  };
  const OutlineSection& waist = SectionOf(panel, "waist");
  HalfPanel half{HalfWaist(left ? waist : TurnedOver(waist)), taken("inseam"), taken("leg_hem"), taken("outseam")};
  half.waist.name = "waist" + end;
  return half;
}

PanelPattern PieceOf(const PanelPattern& panel, bool left, std::vector<OutlineSection> sections) {
  PanelPattern piece{panel.side, panel.image_width, panel.image_height, std::move(sections)};
  if (left) return piece;
  for (OutlineSection& section : piece.sections) section = TurnedOver(section);
  // The waist stays first.
  std::reverse(piece.sections.begin() + 1, piece.sections.end());
  return piece;
}

double AcrossAt(const panels::Polyline& chain, double height) {
  const bool down = chain.front().y() > chain.back().y();
  std::vector<double> fall;
  for (const Eigen::Vector2d& p : chain) {
    const double along = down ? -p.y() : p.y();
    fall.push_back(fall.empty() ? along : std::max(along, fall.back()));
  }
  return panels::InterpolateChain(chain, fall, down ? -height : height).x();
}

ForkTexture::ForkTexture(const PanelPattern& panel, const HalfPanel& half, bool left)
    : warp_(panel),
      waist_(half.waist.points),
      inseam_(half.inseam.points),
      outseam_(half.outseam.points),
      sign_(left ? 1.0 : -1.0) {}

Eigen::Vector2d ForkTexture::PixelAt(const Eigen::Vector2d& point) const {
  Eigen::Vector2d shown = point;
  std::vector<double> across;  // From e1 inwards.
  for (const Eigen::Vector2d& p : waist_) across.push_back(across.empty() ? -p.x() : std::max(-p.x(), across.back()));
  const double top = panels::InterpolateChain(waist_, across, -std::max(point.x(), waist_.back().x())).y();
  shown.y() = std::max(std::min(shown.y(), 2.0 * top - shown.y()), inseam_.back().y());
  const double inner = AcrossAt(inseam_, shown.y());
  if (shown.x() < inner) {
    const double reach = kMostReach * (AcrossAt(outseam_, shown.y()) - inner);
    shown.x() = inner + std::min(inner - shown.x(), std::max(reach, 0.0));
  }
  return warp_.PixelAt({sign_ * shown.x(), shown.y()});
}

}  // namespace fitroom::fork
