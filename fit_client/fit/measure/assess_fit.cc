#include "fit_client/fit/measure/assess_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "common/base/check.h"
#include "common/body/polygon.h"
#include "common/body/tape_girths.h"
#include "fit_client/fit/measure/body_gap.h"
#include "fit_client/fit/measure/cloth_strain.h"
#include "fit_client/fit/measure/contact_pressure.h"
#include "fit_client/fit/measure/garment_line.h"
#include "fit_client/fit/measure/way_round_body.h"

namespace fitroom {
namespace {

constexpr double kBelowCrotch = 0.015;  // Where the thigh of trousers is measured (unit: metre).
constexpr double kBelowTopEdge = 0.01;  // The cloth of a bottom's waist lies round this, below its edge (unit: metre).
constexpr double kAboveHem = 0.01;      // (unit: metre)
constexpr double kAboveAnkle = 0.03;    // From the ankle bone to where a leg is narrowest (unit: metre).
constexpr double kHemReach = 0.03;      // A garment that ends so near below a place is measured above it (unit: metre),
constexpr double kHemStep = 0.0025;     // at the first of these steps where its line is whole (unit: metre).
constexpr double kBodyOffset = 0.003;   // Cloth that lies on the body is this far from it (unit: metre).
constexpr double kBeltOffset = 0.001;   // And a belt so much farther (unit: metre).
constexpr double kZoneHalfHeight = 0.04;  // Of the cloth that counts as a zone's (unit: metre).
constexpr double kBelowArmpit = 0.05;     // Where the upper arm is measured, along the arm (unit: metre).
constexpr double kSleeveReach = 0.2;      // Of the cut round the arm (unit: metre).
constexpr double kArmholeReach = 0.08;    // A sleeve that begins lower is measured so much lower (unit: metre).

// A zone's line on the flat garment, where it has one.
struct ZoneLine {
  ZoneFit fit;
  bool has_line = false;
  LineHeights heights = {0.0, 0.0};
};

class Assessor {
 public:
  explicit Assessor(const AssessInput& input)
      : input_(input),
        cloth_(*input.cloth),
        positions_(*input.positions),
        body_(*input.body),
        way_round_(*input.body, input.layers),
        strains_(ComputeStrain(cloth_, positions_)) {}

  FitAssessment Run() {
    FitAssessment result;
    MakeMaps(result.maps);
    for (const FitZone zone : ZonesOf(input_.kind)) {
      ZoneLine line = MeasureZone(zone);
      line.fit.zone = zone;
      line.fit.provenance = ZoneProvenance(input_.kind, zone, input_.measures);
      if (line.fit.measured) AddCloth(line, result.maps);
      result.zones.push_back(std::move(line.fit));
    }
    return result;
  }

 private:
  void MakeMaps(FitMaps& maps) {
    for (const TriangleStrain& strain : strains_) maps.strain.push_back(strain.largest);
    // The cloth was draped softer than a stiff fabric is, and its tension is that of the drape.
    Fabric draped = *input_.fabric;
    draped.stretch_stiffness = DrapeMaterial(draped).stretch_stiffness;
    contact_pressures_ = ContactForcePressure(cloth_, positions_, draped, input_.gravity);
    maps.pressure = LaplacePressure(cloth_, positions_, strains_, draped.stretch_stiffness);
    maps.gap = MeasureGaps(body_.mesh, positions_);
    for (const TriangleMesh* layer : input_.layers) {
      const std::vector<double> gaps = MeasureGaps(*layer, positions_);
      for (size_t i = 0; i < std::min(gaps.size(), maps.gap.size()); ++i) maps.gap[i] = std::min(maps.gap[i], gaps[i]);
    }
    is_touching_.assign(positions_.size(), true);
    for (size_t i = 0; i < maps.gap.size(); ++i) is_touching_[i] = maps.gap[i] < kContactGap;
    laplace_pressures_ = maps.pressure;
    for (size_t i = 0; i < positions_.size(); ++i) {
      maps.pressure[i] = is_touching_[i] ? std::max(0.0, maps.pressure[i]) : 0.0;
    }
  }

  const TapeGirths& tape() const { return way_round_.tape(); }

  // Lowest (or highest) flat height of the named points on a panel; nothing where the panel has none of them.
  std::optional<double> PointHeight(size_t panel, std::initializer_list<std::string_view> names, bool lowest) const {
    const std::string_view prefix = panel == 0 ? "front/" : "back/";
    std::optional<double> found;
    for (const NamedParticle& named : cloth_.named_particles) {
      if (!named.name.starts_with(prefix)) continue;
      const std::string_view name = std::string_view(named.name).substr(prefix.size());
      if (std::find(names.begin(), names.end(), name) == names.end()) continue;
      const double y = cloth_.rest_positions[static_cast<size_t>(named.particle)].y();
      found = !found ? y : lowest ? std::min(*found, y) : std::max(*found, y);
    }
    return found;
  }

  // The lines `away` below (or, negative, above) the named points of both panels.
  std::optional<LineHeights> LineAtPoints(std::initializer_list<std::string_view> names, bool lowest,
                                          double away) const {
    const std::optional<double> front = PointHeight(0, names, lowest);
    const std::optional<double> back = PointHeight(1, names, lowest);
    if (!front || !back) return std::nullopt;
    return LineHeights{*front - away, *back - away};
  }

  ZoneLine MeasureZone(FitZone zone) {
    switch (zone) {
      case FitZone::kBust:
        return AtBodyHeight(body_.measurements.bust, "bust",
                            LineAtPoints({"underarm_L", "underarm_R"}, /*lowest=*/true, kChestBelowUnderarm));
      case FitZone::kWaist:
        return IsBottom(input_.kind) ? MeasureTopEdge() : AtBodyHeight(body_.measurements.waist, "waist", {});
      case FitZone::kHip:
        return AtBodyHeight(body_.measurements.hip, "hip", {});
      case FitZone::kShoulder:
        return MeasureShoulder();
      case FitZone::kUpperArm:
        return MeasureUpperArm();
      case FitZone::kThigh:
      case FitZone::kKnee:
        return MeasureLeg(zone);
      case FitZone::kHem:
        return MeasureHem();
    }
    return {};
  }

  // The garment's line at the body's height of a girth, or at `highest` where the body's is above it: a top is open to
  // its sleeves over the underarms.
  ZoneLine AtBodyHeight(const GirthMeasurement& girth, const std::string& name,
                        const std::optional<LineHeights>& highest) {
    ZoneLine zone;
    zone.fit.body_girth = girth.girth;
    zone.fit.height = girth.height;
    if (!(girth.girth > 0.0)) {
      zone.fit.note = "the scan gave no " + name + " girth";
      return zone;
    }
    std::optional<LineHeights> heights = FindWholeLineAt(girth.height);
    if (highest) {
      if (!heights) heights = highest;
      for (const size_t panel : {0U, 1U}) (*heights)[panel] = std::min((*heights)[panel], (*highest)[panel]);
    }
    if (!heights) {
      zone.fit.note = "the garment does not reach round the " + name;
      return zone;
    }
    TakeLine(*heights, /*leg_count=*/1, name, zone);
    return zone;
  }

  // The line at a height of the worn garment, or a little higher where the hem passes through.
  std::optional<LineHeights> FindWholeLineAt(double height) const {
    for (double above = 0.0; above < kHemReach; above += kHemStep) {
      const std::optional<LineHeights> heights = FindLineAt(cloth_, positions_, height + above);
      if (heights && MeasureLine(cloth_, positions_, *heights).is_closed) return heights;
    }
    return std::nullopt;
  }

  // What body and layers ask of a line, half by half.
  void AddWayRoundBody(const GarmentLine& line, ZoneFit& fit) const {
    const std::vector<Eigen::Vector2d> under = way_round_.OutlineAt(line.height);
    if (!input_.layers.empty() && !under.empty()) fit.layered_girth = TapeLength(under);
    if (!line.is_closed) return;
    for (const size_t panel : {0U, 1U}) {
      const LineHalf& half = line.halves[panel];
      const double taut = way_round_.TautLengthOf(half, /*is_front=*/panel == 0, kBodyOffset);
      fit.least_worn_girth += std::max(half.flat_length, taut);
    }
  }

  void TakeLine(const LineHeights& heights, int leg_count, const std::string& name, ZoneLine& zone) {
    const GarmentLine line = MeasureLine(cloth_, positions_, heights);
    if (!line.found) {
      zone.fit.note = "the garment has no " + name + " line";
      return;
    }
    zone.heights = heights;
    zone.has_line = true;
    zone.fit.measured = zone.fit.body_girth > 0.0;
    zone.fit.garment_girth = line.flat_girth / leg_count;
    zone.fit.worn_girth = line.worn_girth / leg_count;
    zone.fit.height = line.height;
    if (leg_count == 1) AddWayRoundBody(line, zone.fit);
    if (!zone.fit.measured) zone.fit.note = "the scan gave no girth at the garment's " + name;
  }

  // A bottom's waist: its upper edge, against the body where that edge came to lie.
  ZoneLine MeasureTopEdge() {
    ZoneLine zone;
    const std::optional<LineHeights> heights =
        LineAtPoints({"e1", "e3", "waist_centre"}, /*lowest=*/true, kBelowTopEdge);
    if (!heights) {
      zone.fit.note = "the garment's waist is not known";
      return zone;
    }
    std::vector<int> edge;
    for (const std::string_view name :
         {"front/e1", "front/e3", "front/waist_centre", "back/e1", "back/e3", "back/waist_centre"}) {
      edge.push_back(FindParticle(name));
    }
    const GarmentLine line = MeasureOpening(cloth_, positions_, edge);
    zone.fit.body_girth = body_.measurements.waist.girth;
    // Where a waistband lies below the waist the body is wider; far below, the garment was not put on at all.
    if (line.found && line.height > body_.measurements.hip.height) {
      zone.fit.body_girth = tape().TrunkAt(line.height).value_or(zone.fit.body_girth);
    }
    TakeLine(*heights, 1, "waist", zone);
    if (line.found && zone.has_line) {
      zone.fit.garment_girth = line.flat_girth;
      zone.fit.worn_girth = line.worn_girth;
      zone.fit.height = line.height;
      // The belt lies on the body and gathers or stretches the edge to its own length.
      zone.fit.is_belted = true;
      zone.fit.least_worn_girth =
          TapeLength(way_round_.OutlineAt(line.height)) + 2.0 * std::numbers::pi * (kBodyOffset + kBeltOffset);
    }
    return zone;
  }

  ZoneLine MeasureShoulder() {
    ZoneLine zone;
    // The shoulder tips are e3 and e7 of tops with sleeves, e2 and e6 of one-pieces.
    const bool is_top = input_.kind == GarmentKind::kTShirt || input_.kind == GarmentKind::kLongSleeve;
    const int left = FindParticle(is_top ? "front/e3" : "front/e2");
    const int right = FindParticle(is_top ? "front/e7" : "front/e6");
    zone.fit.body_girth = tape().ShoulderBreadth().value_or(0.0);
    if (left < 0 || right < 0 || !(zone.fit.body_girth > 0.0)) {
      zone.fit.note = "the shoulders of body or garment are not known";
      return zone;
    }
    const auto l = static_cast<size_t>(left);
    const auto r = static_cast<size_t>(right);
    zone.fit.measured = true;
    zone.fit.garment_girth = (cloth_.rest_positions[l] - cloth_.rest_positions[r]).norm();
    zone.fit.worn_girth = (positions_[l] - positions_[r]).norm();
    zone.fit.height = 0.5 * (positions_[l].y() + positions_[r].y());
    return zone;
  }

  // The line round a sleeve there, or a little farther down the arm where the armhole passes through.
  GarmentLine FindWholeSleeve(const Eigen::Vector3d& origin, const Eigen::Vector3d& along, bool left) const {
    const auto at = [&](double down) {
      return MeasureSleeve(cloth_, positions_, origin + down * along, along, kSleeveReach, left);
    };
    for (double down = 0.0; down < kArmholeReach; down += kHemStep) {
      const GarmentLine line = at(down);
      if (line.found && line.is_closed) return line;
    }
    return at(0.0);
  }

  ZoneLine MeasureUpperArm() {
    ZoneLine zone;
    const std::optional<GirthMeasurement> girth = tape().UpperArm(kBelowArmpit);
    if (!girth) {
      zone.fit.note = "the scan gave no upper arm girth";
      return zone;
    }
    zone.fit.body_girth = girth->girth;
    zone.fit.height = girth->height;
    int count = 0;
    for (const bool left : {true, false}) {
      const LimbAxis& arm = left ? body_.arm_left : body_.arm_right;
      const LandmarkEstimate& armpit = body_.landmarks[left ? BodyLandmark::kArmpitLeft : BodyLandmark::kArmpitRight];
      const Eigen::Vector3d along = arm.joint - arm.root;
      if (armpit.confidence == 0.0 || along.norm() < 0.05) continue;
      const Eigen::Vector3d unit = along.normalized();
      const Eigen::Vector3d origin = arm.root + (unit.dot(armpit.position - arm.root) + kBelowArmpit) * unit;
      const GarmentLine line = FindWholeSleeve(origin, unit, left);
      if (!line.found) continue;
      zone.fit.garment_girth += line.flat_girth;
      zone.fit.worn_girth += line.worn_girth;
      ++count;
    }
    if (count == 0) {
      zone.fit.note = "the sleeves end above it";
      return zone;
    }
    zone.fit.garment_girth /= count;
    zone.fit.worn_girth /= count;
    zone.fit.measured = true;
    return zone;
  }

  ZoneLine MeasureLeg(FitZone which) {
    ZoneLine zone;
    const bool is_thigh = which == FitZone::kThigh;
    const std::string name(FitZoneWords(which));
    const std::optional<GirthMeasurement> girth = is_thigh ? tape().Thigh() : tape().Knee();
    if (girth) zone.fit.body_girth = girth->girth;
    const std::optional<LineHeights> heights =
        is_thigh ? LineAtPoints({"crotch"}, /*lowest=*/true, kBelowCrotch)
                 : LineAtPoints({"knee_outer_L", "knee_outer_R", "knee_inner_L", "knee_inner_R"}, true, 0.0);
    if (!heights) {
      zone.fit.note = "the garment's " + name + " is not known";
      return zone;
    }
    TakeLine(*heights, /*leg_count=*/2, name, zone);
    return zone;
  }

  ZoneLine MeasureHem() {
    ZoneLine zone;
    const bool has_legs = HasLegs(input_.kind);
    const std::optional<LineHeights> heights =
        has_legs ? LineAtPoints({"e2", "e4", "hem_inner_L", "hem_inner_R"}, /*lowest=*/false, -kAboveHem)
        : input_.kind == GarmentKind::kSkirt ? LineAtPoints({"e2", "e4"}, /*lowest=*/false, -kAboveHem)
                                             : LineAtPoints({"hem_L", "hem_R"}, /*lowest=*/false, -kAboveHem);
    if (!heights) {
      zone.fit.note = "the garment's hem is not known";
      return zone;
    }
    const GarmentLine line = MeasureLine(cloth_, positions_, *heights);
    if (line.found) {
      const std::optional<double> body =
          has_legs ? tape().LegAt(std::max(line.height, LowestOfLeg())) : tape().TrunkAt(line.height);
      zone.fit.body_girth = body.value_or(0.0);
    }
    TakeLine(*heights, has_legs ? 2 : 1, "hem", zone);
    return zone;
  }

  // Above the ankles: what hangs lower lies on the foot, whose section is no girth of the leg. 0 where they are
  // unknown.
  double LowestOfLeg() const {
    double lowest = 0.0;
    for (const BodyLandmark landmark : {BodyLandmark::kAnkleLeft, BodyLandmark::kAnkleRight}) {
      if (body_.landmarks[landmark].confidence <= 0.0) continue;
      lowest = std::max(lowest, body_.landmarks[landmark].position.y() + kAboveAnkle);
    }
    return lowest;
  }

  int FindParticle(std::string_view name) const {
    for (const NamedParticle& named : cloth_.named_particles) {
      if (named.name == name) return named.particle;
    }
    return -1;
  }

  // Says whether a triangle is of a zone's cloth: within some centimetres of its line, the sleeve for the upper arm,
  // what is above the bust line for the shoulder.
  bool IsOfZone(const ZoneLine& zone, const Eigen::Vector3i& t) const {
    const double sleeve = std::max(SleevePart(cloth_, t, true), SleevePart(cloth_, t, false));
    if (zone.fit.zone == FitZone::kUpperArm) return sleeve > 0.5;
    if (sleeve > 0.5) return false;
    const auto corner = static_cast<size_t>(t[0]);
    if (zone.fit.zone == FitZone::kShoulder) return positions_[corner].y() > zone.fit.height - kZoneHalfHeight;
    if (!zone.has_line) return false;
    const double line = zone.heights[cloth_.panel_of_particle[corner] == 0 ? 0U : 1U];
    return std::abs(cloth_.rest_positions[corner].y() - line) < kZoneHalfHeight;
  }

  // Where the body is wider than the garment it forces the strain upon the cloth, however stiff that is: what a stiff
  // fabric presses there beyond the drape's softer cloth, T / r on a body as round as its girth (unit: Pa).
  double ImposedPressure(const ZoneFit& fit) const {
    const double missing = input_.fabric->stretch_stiffness - DrapeMaterial(*input_.fabric).stretch_stiffness;
    if (fit.zone == FitZone::kShoulder || !(fit.body_girth > 0.0)) return 0.0;
    return missing * fit.needed_strain() * 2.0 * std::numbers::pi / fit.body_girth;
  }

  void AddCloth(ZoneLine& zone, const FitMaps& maps) const {
    std::vector<std::pair<double, double>> strain_and_area;
    double area = 0.0;
    double touching_area = 0.0;
    double cosine = 0.0;
    double sine = 0.0;
    ZoneFit& fit = zone.fit;
    for (size_t index = 0; index < strains_.size(); ++index) {
      const TriangleStrain& strain = strains_[index];
      if (!(strain.rest_area > 0.0) || !IsOfZone(zone, cloth_.triangles[index])) continue;
      strain_and_area.emplace_back(strain.largest, strain.rest_area);
      area += strain.rest_area;
      fit.strain_mean += strain.rest_area * strain.largest;
      fit.strain_max = std::max(fit.strain_max, strain.largest);
      // Directions have no sign: the mean is of twice the angle, weighted by how much it stretches.
      const double weight = strain.rest_area * std::max(0.0, strain.largest);
      cosine += weight * std::cos(2.0 * strain.rest_angle);
      sine += weight * std::sin(2.0 * strain.rest_angle);
      for (const int corner : cloth_.triangles[index]) {
        const auto i = static_cast<size_t>(corner);
        const double third = strain.rest_area / 3.0;
        if (!maps.gap.empty()) fit.gap_mean += third * maps.gap[i];
        if (!is_touching_[i]) continue;
        touching_area += third;
        fit.laplace_pressure += third * laplace_pressures_[i];
        fit.contact_pressure += third * contact_pressures_[i];
      }
    }
    if (!(area > 0.0)) return;
    fit.has_strain = true;
    fit.strain_mean /= area;
    fit.gap_mean /= area;
    fit.strain_angle = 0.5 * std::atan2(sine, cosine);
    fit.contact_share = touching_area / area;
    if (touching_area > 0.0) {
      // Single particles push and pull by turns; their mean is what presses.
      const double imposed = ImposedPressure(fit);
      fit.laplace_pressure = imposed + std::max(0.0, fit.laplace_pressure / touching_area);
      fit.contact_pressure = imposed + std::max(0.0, fit.contact_pressure / touching_area);
    }
    std::sort(strain_and_area.begin(), strain_and_area.end());
    double below = 0.0;
    for (const auto& [strain, part] : strain_and_area) {
      below += part;
      fit.strain_p95 = strain;
      if (below >= 0.95 * area) break;
    }
  }

  const AssessInput& input_;
  const ClothMesh& cloth_;
  const std::vector<Eigen::Vector3d>& positions_;
  const Body& body_;
  const WayRoundBody way_round_;  // And round what is worn below.
  const std::vector<TriangleStrain> strains_;
  std::vector<double> laplace_pressures_;
  std::vector<double> contact_pressures_;
  std::vector<bool> is_touching_;
};

}  // namespace

FitAssessment AssessFit(const AssessInput& input) {
  FR_CHECK(input.cloth != nullptr && input.positions != nullptr && input.body != nullptr && input.fabric != nullptr);
  FR_CHECK(input.positions->size() == input.cloth->rest_positions.size());
  return Assessor(input).Run();
}

}  // namespace fitroom
