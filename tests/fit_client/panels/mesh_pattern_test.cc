#include "fit_client/fit/panels/mesh_pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fit_client/fit/panels/polyline.h"
#include "fit_client/fit/panels/reconcile.h"
#include "fit_client/fit/panels/topology.h"
#include "tests/fit_client/panels/drawn_tshirt.h"

namespace fitroom {
namespace {

using testing::DrawGarment;
using testing::DrawnTShirt;

Garment CrumpledGarment() {
  return DrawGarment(
      DrawnTShirt(), {.tilt_deg = 5, .pixels_per_metre = 900, .sway = 0.004, .crumple = 0.001, .sleeve_turn_deg = 6},
      {.tilt_deg = -3, .pixels_per_metre = 1100, .sway = -0.003, .crumple = 0.001, .sleeve_turn_deg = -4});
}

GarmentPattern CrumpledPattern() {
  Result<GarmentPattern> pattern = ReconcileViews(CrumpledGarment());
  if (!pattern.ok()) throw std::runtime_error(pattern.status().ToString());
  return std::move(pattern).value();
}

struct Quality {
  double least_angle_deg = 180.0;
  double shortest_edge = std::numeric_limits<double>::infinity();
  double longest_edge = 0.0;
};

Quality QualityOf(const ClothMesh& mesh) {
  Quality quality;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = mesh.rest_positions[static_cast<size_t>(t[k])];
      const Eigen::Vector3d& b = mesh.rest_positions[static_cast<size_t>(t[(k + 1) % 3])];
      const Eigen::Vector3d& c = mesh.rest_positions[static_cast<size_t>(t[(k + 2) % 3])];
      quality.shortest_edge = std::min(quality.shortest_edge, (b - a).norm());
      quality.longest_edge = std::max(quality.longest_edge, (b - a).norm());
      const double cosine = (b - a).normalized().dot((c - a).normalized());
      quality.least_angle_deg = std::min(quality.least_angle_deg, std::acos(cosine) * 180.0 / M_PI);
    }
  }
  return quality;
}

class MeshPatternAtPitch : public ::testing::TestWithParam<double> {
 protected:
  // Cut once for all tests of a pitch.
  struct Cut {
    GarmentPattern pattern;
    ClothMesh mesh;
  };
  static const Cut& CutAt(double pitch) {
    static std::map<double, Cut> cuts;
    const auto found = cuts.find(pitch);
    if (found != cuts.end()) return found->second;
    Cut cut{CrumpledPattern(), {}};
    Result<ClothMesh> mesh = MeshPattern(cut.pattern, pitch);
    if (!mesh.ok()) throw std::runtime_error(mesh.status().ToString());
    cut.mesh = std::move(mesh).value();
    return cuts.emplace(pitch, std::move(cut)).first->second;
  }

  const GarmentPattern& pattern_ = CutAt(GetParam()).pattern;
  const ClothMesh& mesh_ = CutAt(GetParam()).mesh;
};

class MeshPatternAtEveryPitch : public MeshPatternAtPitch {};

TEST_P(MeshPatternAtEveryPitch, IsASphereWithFourHolesOnceSewn) {
  const ClothTopology topology = ComputeWeldedTopology(mesh_);
  EXPECT_EQ(topology.euler_characteristic(), -2);
  EXPECT_EQ(topology.boundary_loop_count, 4);
  EXPECT_EQ(topology.component_count, 1);
  EXPECT_TRUE(topology.is_manifold);
}

TEST_P(MeshPatternAtEveryPitch, HasNoSliversAndEdgesOfAboutThePitch) {
  const Quality quality = QualityOf(mesh_);
  EXPECT_GE(quality.least_angle_deg, 25.0);
  EXPECT_GE(quality.shortest_edge, 0.55 * GetParam());
  EXPECT_LE(quality.longest_edge, 1.6 * GetParam());
}

TEST_P(MeshPatternAtPitch, SewsParticlesThatLieOnOnePlace) {
  std::set<int> front, back;
  for (const SeamPair& pair : mesh_.seams) {
    EXPECT_EQ(mesh_.panel_of_particle[static_cast<size_t>(pair.a)], 0);
    EXPECT_EQ(mesh_.panel_of_particle[static_cast<size_t>(pair.b)], 1);
    EXPECT_EQ(mesh_.rest_positions[static_cast<size_t>(pair.a)], mesh_.rest_positions[static_cast<size_t>(pair.b)]);
    EXPECT_TRUE(front.insert(pair.a).second) << "sewn twice";
    EXPECT_TRUE(back.insert(pair.b).second) << "sewn twice";
  }
  // Two shoulders with sleeve, two undersides, two sides: their length at one pair a pitch.
  double length = 0.0;
  for (const OutlineSection& section : pattern_.front.sections) {
    if (section.kind != SectionKind::kSeam) continue;
    for (size_t i = 1; i < section.points.size(); ++i) length += (section.points[i] - section.points[i - 1]).norm();
  }
  EXPECT_NEAR(static_cast<double>(mesh_.seams.size()), length / GetParam(), 0.06 * length / GetParam() + 6.0);
}

TEST_P(MeshPatternAtPitch, CutsExactlyThePanels) {
  // Boundary edges lie on the outline; with positive areas that sum up to the outline's, nothing is lost or doubled.
  for (int side = 0; side < 2; ++side) {
    const PanelPattern& panel = side == 0 ? pattern_.front : pattern_.back;
    const double sense = side == 0 ? 1.0 : -1.0;  // Counter-clockwise from +z; from -z on the back.
    double area = 0.0;
    for (const Eigen::Vector3i& t : mesh_.triangles) {
      if (mesh_.panel_of_particle[static_cast<size_t>(t[0])] != side) continue;
      const Eigen::Vector3d& a = mesh_.rest_positions[static_cast<size_t>(t[0])];
      const Eigen::Vector3d u = mesh_.rest_positions[static_cast<size_t>(t[1])] - a;
      const Eigen::Vector3d v = mesh_.rest_positions[static_cast<size_t>(t[2])] - a;
      EXPECT_GT(sense * u.cross(v).z(), 0.0);
      area += 0.5 * sense * u.cross(v).z();
    }
    // Chords of a pitch cut about pitch^2 / 12 of turning off the outline's area a unit of angle: here at most 15 rad.
    EXPECT_NEAR(area, panels::SignedArea(JoinedPoints(panel)), 2.0 * GetParam() * GetParam());
  }
}

TEST_P(MeshPatternAtPitch, PutsParticlesOnThePointsAndShowsTheirPixels) {
  const Garment garment = CrumpledGarment();
  std::map<std::string, int> named;
  for (const NamedParticle& particle : mesh_.named_particles) {
    EXPECT_TRUE(named.emplace(particle.name, particle.particle).second) << particle.name;
  }
  EXPECT_EQ(named.size(), 44u);
  const std::set<std::string> corners = {"P1",         "P2",         "e4",    "e8",    "sleeve_bottom_L",
                                         "underarm_L", "underarm_R", "hem_L", "hem_R", "sleeve_bottom_R"};
  for (const std::string& name : OutlinePointNames(GarmentKind::kTShirt)) {
    for (const auto& [prefix, panel, view] :
         {std::tuple("front/", &pattern_.front, &garment.front), std::tuple("back/", &pattern_.back, &*garment.back)}) {
      ASSERT_TRUE(named.contains(prefix + name));
      const size_t particle = static_cast<size_t>(named[prefix + name]);
      const double distance = (mesh_.rest_positions[particle].head<2>() - *FindPatternPoint(*panel, name)).norm();
      if (!corners.contains(name)) {
        EXPECT_LE(distance, 0.8 * GetParam()) << prefix << name;
        continue;
      }
      EXPECT_LT(distance, 1e-12) << prefix << name;
      const Eigen::Vector2d pixel =
          (mesh_.texture_coordinates[particle].array() * Eigen::Array2d(view->image_width, view->image_height))
              .matrix();
      EXPECT_NEAR((pixel - FindPoint(*view, name)->pixel).norm(), 0.0, 1e-6) << prefix << name;
    }
  }
}

TEST_P(MeshPatternAtPitch, ShowsOnlyTheGarment) {
  const Garment garment = CrumpledGarment();
  for (size_t i = 0; i < mesh_.rest_positions.size(); ++i) {
    const GarmentView& view = mesh_.panel_of_particle[i] == 0 ? garment.front : *garment.back;
    const Eigen::Vector2d pixel =
        (mesh_.texture_coordinates[i].array() * Eigen::Array2d(view.image_width, view.image_height)).matrix();
    if (panels::PolygonContains(view.outline, pixel)) continue;
    panels::Polyline closed = view.outline;
    closed.push_back(closed.front());
    EXPECT_LT(panels::DistanceToChain(pixel, closed), 2.0) << "particle " << i;
  }
}

TEST_P(MeshPatternAtPitch, KeepsNeighboursCloseInMemory) {
  const double row = 0.9 / GetParam();  // About the longest row.
  for (const Eigen::Vector3i& t : mesh_.triangles) EXPECT_LT(t.maxCoeff() - t.minCoeff(), 3.0 * row);
}

TEST_P(MeshPatternAtPitch, WeighsSleevesSmoothlyFromZeroToOne) {
  ASSERT_EQ(mesh_.left_sleeve_weights.size(), mesh_.rest_positions.size());
  ASSERT_EQ(mesh_.right_sleeve_weights.size(), mesh_.rest_positions.size());
  const double tip = FindPatternPoint(pattern_.front, "e3")->x();
  for (size_t i = 0; i < mesh_.rest_positions.size(); ++i) {
    const Eigen::Vector3d& p = mesh_.rest_positions[i];
    const double left = mesh_.left_sleeve_weights[i], right = mesh_.right_sleeve_weights[i];
    EXPECT_TRUE(left >= 0.0 && left <= 1.0 && right >= 0.0 && right <= 1.0);
    if (std::abs(p.x()) < tip - 0.04 || p.y() < -0.40) {
      EXPECT_EQ(left + right, 0.0) << p.transpose();  // Torso.
    }
    if (p.x() > tip + 0.08) {
      EXPECT_EQ(left, 1.0) << p.transpose();
      EXPECT_EQ(right, 0.0) << p.transpose();
    }
    if (p.x() < -tip - 0.08) {
      EXPECT_EQ(right, 1.0) << p.transpose();
    }
  }
  // A smoothstep over 6 cm rises by at most 1.5 / 6 cm.
  for (const Eigen::Vector3i& t : mesh_.triangles) {
    for (int k = 0; k < 3; ++k) {
      const size_t a = static_cast<size_t>(t[k]), b = static_cast<size_t>(t[(k + 1) % 3]);
      const double length = (mesh_.rest_positions[a] - mesh_.rest_positions[b]).norm();
      EXPECT_LE(std::abs(mesh_.left_sleeve_weights[a] - mesh_.left_sleeve_weights[b]), 25.0 * length + 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pitches, MeshPatternAtEveryPitch, ::testing::Values(0.02, 0.01, 0.005));
INSTANTIATE_TEST_SUITE_P(Pitches, MeshPatternAtPitch, ::testing::Values(0.02, 0.01));

TEST(MeshPattern, NeverTurnsATriangleOfTheTextureOver) {
  // Far more bend, crumple and turned sleeves than a shop would photograph: the plain warp folds at the underarms.
  const Garment garment =
      DrawGarment(DrawnTShirt(), {.tilt_deg = 5, .sway = 0.01, .crumple = 0.003, .sleeve_turn_deg = 12},
                  {.tilt_deg = -4, .pixels_per_metre = 600, .sway = -0.01, .crumple = 0.003, .sleeve_turn_deg = -12});
  const Result<GarmentPattern> pattern = ReconcileViews(garment);
  ASSERT_TRUE(pattern.ok()) << pattern.status().ToString();
  for (double pitch : {0.02, 0.01, 0.007}) {
    const Result<ClothMesh> mesh = MeshPattern(*pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << mesh.status().ToString();
    for (const Eigen::Vector3i& t : mesh->triangles) {
      const auto at = [&](int k) { return mesh->texture_coordinates[static_cast<size_t>(t[k])]; };
      const Eigen::Vector2d u = at(1) - at(0), v = at(2) - at(0);
      // Texture rows run down, so counter-clockwise from outside is clockwise, that is negative, on both panels.
      EXPECT_LT(u.x() * v.y() - u.y() * v.x(), 0.0)
          << "pitch " << pitch << " at " << mesh->rest_positions[static_cast<size_t>(t[0])].transpose();
    }
  }
}

TEST(MeshPattern, GivesTheSameBytesEachTime) {
  const GarmentPattern pattern = CrumpledPattern();
  const Result<ClothMesh> first = MeshPattern(pattern, 0.01), second = MeshPattern(pattern, 0.01);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->rest_positions, second->rest_positions);
  EXPECT_EQ(first->triangles, second->triangles);
  EXPECT_EQ(first->texture_coordinates, second->texture_coordinates);
}

// Round sleeves and underarms edges are short at any pitch, elsewhere as long as the pitch; seams stay paired to the
// bit.
TEST(MeshPattern, IsFineWhereItIsTightAndCoarseElsewhere) {
  const GarmentPattern pattern = CrumpledPattern();
  constexpr double kTight = 0.0125;
  for (const double pitch : {0.02, 0.04}) {
    const ClothMesh mesh = MeshPattern(pattern, pitch, kTight).value();
    EXPECT_EQ(ComputeEulerCharacteristic(mesh), -2);
    EXPECT_GT(QualityOf(mesh).least_angle_deg, 20.0) << pitch;
    EXPECT_LT(QualityOf(mesh).longest_edge, 1.65 * pitch);
    EXPECT_GT(QualityOf(mesh).longest_edge, 0.9 * pitch);
    for (const SeamPair& seam : mesh.seams) {
      EXPECT_EQ(mesh.rest_positions[static_cast<size_t>(seam.a)], mesh.rest_positions[static_cast<size_t>(seam.b)]);
    }
    const Eigen::Vector2d& underarm = *FindPatternPoint(pattern.front, "underarm_L");
    int near_count = 0;
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const Eigen::Vector3d& a = mesh.rest_positions[static_cast<size_t>(t[0])];
      const Eigen::Vector3d& b = mesh.rest_positions[static_cast<size_t>(t[1])];
      const double sleeve = mesh.left_sleeve_weights[static_cast<size_t>(t[0])];
      if (sleeve < 1.0 && (a.head<2>() - underarm).norm() > 0.1) continue;
      ++near_count;
      EXPECT_LT((b - a).norm(), 1.65 * kTight) << pitch << " at " << a.transpose();
    }
    EXPECT_GT(near_count, 100);
    EXPECT_LT(mesh.rest_positions.size(), MeshPattern(pattern, kTight)->rest_positions.size());
  }
  // Where no edge is longer anyway nothing changes, to the last bit.
  const ClothMesh plain = MeshPattern(pattern, 0.01).value();
  const ClothMesh same = MeshPattern(pattern, 0.01, kTight).value();
  EXPECT_EQ(plain.rest_positions, same.rest_positions);
  EXPECT_EQ(plain.triangles, same.triangles);
}

TEST(MeshPattern, CutsEveryPitchInItsRangeAndRefusesOthers) {
  const GarmentPattern pattern = CrumpledPattern();
  for (double pitch : {0.05, 0.033, 0.017, 0.0075}) {
    const Result<ClothMesh> mesh = MeshPattern(pattern, pitch);
    ASSERT_TRUE(mesh.ok()) << pitch << ": " << mesh.status().ToString();
    EXPECT_EQ(ComputeEulerCharacteristic(*mesh), -2) << pitch;
  }
  for (double pitch : {0.0, -0.01, 1e-9, 0.2, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(MeshPattern(pattern, pitch).status().reason(), "PITCH_OUT_OF_RANGE") << pitch;
  }
}

}  // namespace
}  // namespace fitroom
