#include "shop_catalog/garment/kind_templates.h"

#include <array>
#include <limits>

namespace fitroom::shop_catalog {
namespace {

using Corners = std::vector<CornerModel>;
using Pieces = std::vector<PieceModel>;

// Neck ends turn gently: they are looked for further along, over a shorter arm.
constexpr CornerModel Neck(Expected turn_deg, Expected across, Expected down) {
  return {turn_deg, across, down, 0.03, 0.025, 35.0};
}

// All numbers are tuned by hand on proportions of real garments; what lies outside is refused rather than guessed.
//
// From fitted to boxy, sleeves level to 60 degrees down.
std::vector<CornerTemplate> TShirts() {
  return {FromBottom("sleeves out",
                     {{{85, 35}, {-0.33, 0.09}, {0.98, 0.04}},
                      {{-80, 40}, {-0.33, 0.09}, {0.38, 0.09}},
                      {{80, 35}, {-0.47, 0.13}, {0.38, 0.13}},
                      {{85, 35}, {-0.55, 0.13}, {0.24, 0.12}},
                      Neck({55, 18}, {-0.13, 0.09}, {0.03, 0.05})},
                     {{{-90, 14}, {0.60, 0.12}, {1.03, 0.08}},
                      {{145, 30}, {0.17, 0.09}, {1.08, 0.25}},
                      {{-115, 28}, {0.20, 0.07}, {1.02, 0.08}},
                      {{-27, 14}, {0.45, 0.12}, {1.03, 0.07}}},
                     {{0, 10}, {0.26, 0.06}, {1.06, 0.25}})};
}

// Sleeves along the sides, or stretched out.
std::vector<CornerTemplate> LongSleeves() {
  return {FromBottom("sleeves down",
                     {{{85, 35}, {-0.34, 0.09}, {0.97, 0.05}},
                      {{-130, 45}, {-0.33, 0.08}, {0.36, 0.10}},
                      {{80, 35}, {-0.53, 0.16}, {0.86, 0.14}},
                      {{85, 35}, {-0.65, 0.16}, {0.80, 0.14}},
                      Neck({50, 25}, {-0.13, 0.08}, {0.04, 0.05})},
                     {{{-90, 14}, {0.60, 0.12}, {1.03, 0.08}},
                      {{105, 22}, {0.54, 0.14}, {1.06, 0.15}},
                      {{-150, 40}, {0.15, 0.06}, {1.03, 0.10}},
                      {{-58, 16}, {0.92, 0.16}, {1.08, 0.08}}},
                     {{0, 10}, {0.26, 0.07}, {1.10, 0.3}}),
          FromBottom("sleeves out",
                     {{{85, 35}, {-0.34, 0.09}, {0.97, 0.05}},
                      {{-90, 45}, {-0.33, 0.08}, {0.36, 0.10}},
                      {{80, 35}, {-0.86, 0.18}, {0.52, 0.18}},
                      {{85, 35}, {-0.93, 0.18}, {0.40, 0.18}},
                      Neck({50, 25}, {-0.13, 0.08}, {0.04, 0.05})},
                     {{{-90, 14}, {0.60, 0.12}, {1.03, 0.08}},
                      {{155, 25}, {0.56, 0.14}, {1.06, 0.15}},
                      {{-115, 30}, {0.15, 0.06}, {1.03, 0.10}},
                      {{-27, 16}, {0.90, 0.18}, {1.06, 0.08}}},
                     {{0, 10}, {0.26, 0.07}, {1.10, 0.3}})};
}

// Fitted to flared, thigh to ankle length.
std::vector<CornerTemplate> SleevelessDresses() {
  return {FromBottom("wide straps",
                     {{{85, 30}, {-0.32, 0.12}, {0.96, 0.05}},
                      {{40, 40}, {-0.23, 0.06}, {0.25, 0.07}},
                      {{80, 30}, {-0.17, 0.05}, {0.03, 0.04}, 0.025, 0.025, 60.0},
                      Neck({75, 30}, {-0.09, 0.04}, {0.02, 0.03})},
                     {{{-84, 14}, {0.72, 0.08}, {1.05, 0.06}},
                      {{-75, 14}, {0.22, 0.06}, {1.08, 0.10}},
                      {{-15, 22}, {0.09, 0.05}, {1.02, 0.06}}},
                     {{0, 10}, {0.19, 0.07}, {1.25, 0.45}}),
          // Cut straight: the side hardly turns under the arm.
          FromBottom("straight",
                     {{{85, 30}, {-0.26, 0.07}, {0.97, 0.04}},
                      {{12, 25}, {-0.19, 0.05}, {0.30, 0.08}},
                      {{75, 30}, {-0.18, 0.05}, {0.02, 0.03}, 0.025, 0.025, 60.0},
                      Neck({70, 35}, {-0.13, 0.04}, {0.01, 0.02})},
                     {{{-88, 10}, {0.68, 0.09}, {1.03, 0.05}},
                      {{-88, 12}, {0.28, 0.08}, {1.04, 0.06}},
                      {{-20, 22}, {0.06, 0.04}, {1.02, 0.06}}},
                     {{0, 10}, {0.26, 0.07}, {1.08, 0.2}})};
}

std::vector<CornerTemplate> SleevedDresses() {
  return {FromBottom("short sleeves",
                     {{{85, 30}, {-0.34, 0.12}, {0.96, 0.05}},
                      {{-75, 45}, {-0.22, 0.06}, {0.25, 0.07}},
                      {{85, 35}, {-0.30, 0.09}, {0.26, 0.08}},
                      {{85, 35}, {-0.37, 0.09}, {0.17, 0.08}},
                      Neck({55, 25}, {-0.10, 0.04}, {0.02, 0.03})},
                     {{{-84, 14}, {0.72, 0.08}, {1.05, 0.06}},
                      {{155, 35}, {0.09, 0.06}, {1.08, 0.25}},
                      {{-120, 30}, {0.13, 0.05}, {1.03, 0.08}},
                      {{-32, 16}, {0.30, 0.09}, {1.05, 0.07}}},
                     {{0, 10}, {0.20, 0.06}, {1.15, 0.35}}),
          FromBottom("long sleeves",
                     {{{85, 30}, {-0.34, 0.12}, {0.96, 0.05}},
                      {{-120, 45}, {-0.22, 0.06}, {0.25, 0.07}},
                      {{85, 35}, {-0.42, 0.14}, {0.56, 0.12}},
                      {{85, 35}, {-0.50, 0.14}, {0.52, 0.12}},
                      Neck({55, 25}, {-0.10, 0.04}, {0.02, 0.03})},
                     {{{-84, 14}, {0.72, 0.08}, {1.05, 0.06}},
                      {{115, 25}, {0.38, 0.12}, {1.06, 0.2}},
                      {{-145, 40}, {0.11, 0.05}, {1.03, 0.10}},
                      {{-52, 18}, {0.62, 0.14}, {1.08, 0.08}}},
                     {{0, 10}, {0.20, 0.06}, {1.15, 0.35}})};
}

// Short and long, straight and flared. The upper corners are wider than square where the skirt flares from the waist.
std::vector<CornerTemplate> Skirts() {
  const CornerModel waist_short = {{75, 25}, {-0.36, 0.12}, {0.02, 0.04}};
  const CornerModel waist_long = {{75, 25}, {-0.20, 0.07}, {0.02, 0.03}};
  return {FromTop("short", {{{85, 25}, {-0.58, 0.18}, {0.95, 0.06}}, waist_short},
                  {{{-76, 14}, {0.93, 0.10}, {1.02, 0.04}}}, {{180, 12}, {1.16, 0.36}, {1.04, 0.06}}),
          FromTop("long", {{{85, 25}, {-0.38, 0.14}, {0.96, 0.05}}, waist_long},
                  {{{-80, 10}, {0.95, 0.07}, {1.02, 0.04}}}, {{180, 12}, {0.76, 0.28}, {1.04, 0.06}})};
}

// The crotch is a notch; how sharp depends on how near to each other the legs lie.
std::vector<CornerTemplate> Pants() {
  const PieceModel outseam = {{-86, 10}, {0.97, 0.06}, {1.04, 0.05}};
  return {FromTop("legs apart",
                  {{{-140, 35}, {0.0, 0.05}, {0.34, 0.08}},
                   {{90, 30}, {-0.11, 0.09}, {0.98, 0.04}},
                   {{85, 30}, {-0.30, 0.11}, {0.97, 0.04}},
                   {{80, 28}, {-0.19, 0.05}, {0.02, 0.03}}},
                  {{{100, 10}, {0.66, 0.09}, {1.03, 0.05}}, {{180, 22}, {0.18, 0.08}, {1.03, 0.08}}, outseam}),
          FromTop("narrow legs, wide apart",
                  {{{-110, 40}, {0.0, 0.05}, {0.36, 0.08}},
                   {{90, 32}, {-0.20, 0.07}, {0.98, 0.04}},
                   {{85, 32}, {-0.31, 0.09}, {0.97, 0.04}},
                   {{75, 30}, {-0.16, 0.05}, {0.02, 0.04}}},
                  {{{107, 9}, {0.66, 0.09}, {1.03, 0.05}},
                   {{178, 22}, {0.12, 0.05}, {1.03, 0.08}},
                   {{-81, 9}, {0.97, 0.06}, {1.04, 0.05}}})};
}

std::vector<CornerTemplate> Shorts() {
  return {FromTop("legs apart",
                  {{{-110, 50}, {0.0, 0.08}, {0.66, 0.14}, 0.04, 0.05, 60.0},
                   {{90, 32}, {-0.13, 0.09}, {0.97, 0.06}},
                   {{85, 30}, {-0.62, 0.16}, {0.90, 0.08}},
                   {{75, 28}, {-0.42, 0.10}, {0.03, 0.05}}},
                  {{{108, 20}, {0.36, 0.16}, {1.05, 0.12}},
                   {{-172, 16}, {0.50, 0.14}, {1.03, 0.06}},
                   {{-78, 12}, {0.90, 0.10}, {1.03, 0.05}}})};
}

}  // namespace

const std::vector<CornerTemplate>& TemplatesOf(GarmentKind kind) {
  static const std::array<std::vector<CornerTemplate>, kGarmentKindCount> kTemplates = {
      TShirts(), LongSleeves(), SleevelessDresses(), Skirts(), Pants(), Shorts(), SleevedDresses()};
  return kTemplates[static_cast<size_t>(kind)];
}

double KindCost(const Polygon& outline, GarmentKind kind) {
  double best = std::numeric_limits<double>::infinity();
  for (const CornerTemplate& candidate : TemplatesOf(kind)) best = std::min(best, MatchCost(outline, candidate));
  return best;
}

}  // namespace fitroom::shop_catalog
