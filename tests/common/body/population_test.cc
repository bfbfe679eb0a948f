#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/body/analyse_scan.h"
#include "tests/common/body/population.h"
#include "tests/support/test_data.h"

namespace fitroom {
namespace {

// Errors of one quantity over many bodies (unit: millimetre), with the names of the bodies.
using Errors = std::vector<std::pair<double, std::string>>;

double Mean(const Errors& errors) {
  double sum = 0.0;
  for (const auto& [error, id] : errors) sum += error;
  return errors.empty() ? 1e9 : sum / static_cast<double>(errors.size());
}

double PartWithin(const Errors& errors, double limit) {
  if (errors.empty()) return 0.0;
  const auto good = std::count_if(errors.begin(), errors.end(), [limit](const auto& e) { return e.first <= limit; });
  return static_cast<double>(good) / static_cast<double>(errors.size());
}

// Compares one analysed body with the truth, in the file's frame.
void AddErrors(const std::string& id, const BodyAnalysis& analysis, const testing::BodyTruth& truth,
               std::map<std::string, Errors>& errors) {
  const Similarity file_from_canonical = analysis.canonical_from_file.Inverse();
  const auto add = [&](const std::string& name, const Eigen::Vector3d& canonical, const std::string& true_name) {
    const Eigen::Vector3d difference = file_from_canonical * canonical - truth.landmarks.at(true_name);
    errors[name].emplace_back(10.0 * difference.norm(), id);
    if (name == "crotch") errors["crotch height"].emplace_back(10.0 * std::abs(difference.y()), id);
  };
  for (int i = 0; i < kBodyLandmarkCount; ++i) {
    const auto landmark = static_cast<BodyLandmark>(i);
    const LandmarkEstimate& estimate = analysis.body.landmarks[landmark];
    const std::string name(LandmarkName(landmark));
    if (estimate.confidence <= 0.0) {
      errors[name].emplace_back(1e9, id);
    } else {
      add(name, estimate.position, name);
    }
  }
  const auto add_limb = [&](const LimbAxis& axis, const std::array<const char*, 3>& joints, const std::string& side) {
    const std::array<Eigen::Vector3d, 3> points = {axis.root, axis.joint, axis.end};
    for (size_t i = 0; i < 3; ++i) {
      const std::string name = std::string("joint_") + joints[i] + side;
      add(name, points[i], name);
    }
  };
  add_limb(analysis.body.arm_left, {"shoulder", "elbow", "wrist"}, "_L");
  add_limb(analysis.body.arm_right, {"shoulder", "elbow", "wrist"}, "_R");
  add_limb(analysis.body.leg_left, {"hip", "knee", "ankle"}, "_L");
  add_limb(analysis.body.leg_right, {"hip", "knee", "ankle"}, "_R");
  const auto add_girth = [&](const std::string& name, double girth, const std::string& column) {
    errors[name].emplace_back(std::abs(1000.0 * girth - 10.0 * truth.measurements.at(column)), id);
  };
  add_girth("bust girth", analysis.body.measurements.bust.girth, "bust_tape_cm");
  add_girth("waist girth", analysis.body.measurements.waist.girth, "waist_min_tape_cm");
  add_girth("hip girth", analysis.body.measurements.hip.girth, "hip_tape_cm");
}

void PrintTable(const std::map<std::string, Errors>& errors) {
  std::printf("%-20s %5s %8s %8s %8s  %s\n", "error (mm)", "n", "mean", "p95", "max", "worst");
  for (const auto& [name, list] : errors) {
    Errors sorted = list;
    std::sort(sorted.begin(), sorted.end());
    const size_t p95 = std::min(sorted.size() - 1, static_cast<size_t>(0.95 * static_cast<double>(sorted.size())));
    std::printf("%-20s %5zu %8.1f %8.1f %8.1f  %s\n", name.c_str(), sorted.size(), Mean(sorted), sorted[p95].first,
                sorted.back().first, sorted.back().second.c_str());
  }
}

struct Limit {
  const char* name;
  double limit_mm;
};
constexpr Limit kLandmarkLimits[] = {
    {"front_neck", 15.0}, {"crotch height", 5.0}, {"acromion_L", 20.0},
    {"acromion_R", 20.0}, {"armpit_L", 15.0},     {"armpit_R", 15.0},
};
// What sleeves and legs are turned onto.
constexpr double kJointLimitMm = 30.0;
// ISO 20685-1: the largest error of a large girth.
constexpr double kGirthLimitMm = 9.0;

TEST(Population, LandmarksAndGirthsMeetTheirLimitsOnAll104Bodies) {
  FR_REQUIRE_TEST_DATA();
  const std::map<std::string, testing::BodyTruth> truths = testing::ReadPopulationTruth();
  ASSERT_EQ(truths.size(), 104u);
  std::map<std::string, Errors> errors;
  for (const auto& [id, truth] : truths) {
    const Result<BodyAnalysis> analysis = AnalyseScan(testing::ReadBody("population/" + id + ".ply"), {});
    ASSERT_TRUE(analysis.ok()) << id << ": " << analysis.status().ToString();
    EXPECT_EQ(analysis->frame.up + analysis->frame.facing + analysis->frame.unit, "+y+zcm") << id;
    AddErrors(id, *analysis, truth, errors);
  }
  PrintTable(errors);
  for (const Limit& limit : kLandmarkLimits) {
    EXPECT_EQ(errors[limit.name].size(), 104u) << limit.name;
    EXPECT_GE(PartWithin(errors[limit.name], limit.limit_mm), 0.95) << limit.name;
  }
  for (const auto& [name, list] : errors) {
    if (name.rfind("joint_", 0) != 0) continue;
    EXPECT_GE(PartWithin(list, kJointLimitMm), 0.95) << name;
  }
  for (const char* name : {"bust girth", "waist girth", "hip girth"}) {
    EXPECT_LE(Mean(errors[name]), kGirthLimitMm) << name;
  }
}

// Holes at armpits, crotch, crown and soles, dropouts, islands and 0.3 mm of noise, against the truth of the closed
// body that was scanned.
TEST(Population, RawScansMeetTheSameLimits) {
  FR_REQUIRE_TEST_DATA();
  const std::map<std::string, testing::BodyTruth> truths = testing::ReadPopulationTruth();
  for (const std::string id : {"p001", "p002"}) {
    const Result<BodyAnalysis> analysis = AnalyseScan(testing::ReadBody("scans/" + id + "_scan.ply"), {});
    ASSERT_TRUE(analysis.ok()) << id << ": " << analysis.status().ToString();
    EXPECT_GE(analysis->cleaning.islands, 7);
    std::map<std::string, Errors> errors;
    AddErrors(id, *analysis, truths.at(id), errors);
    PrintTable(errors);
    for (const Limit& limit : kLandmarkLimits) EXPECT_LE(Mean(errors[limit.name]), limit.limit_mm) << limit.name;
    for (const auto& [name, list] : errors) {
      if (name.rfind("joint_", 0) != 0) continue;
      EXPECT_LE(Mean(list), kJointLimitMm) << name;
    }
    for (const char* name : {"bust girth", "waist girth", "hip girth"}) {
      EXPECT_LE(Mean(errors[name]), kGirthLimitMm) << name;
    }
  }
}

// The exporter's file of the same scan: z up, facing -y. Its file coordinates are the PLY's, turned.
TEST(Population, AnAseExportGivesTheSameBodyAsThePly) {
  FR_REQUIRE_TEST_DATA();
  const Result<BodyAnalysis> ply = AnalyseScan(testing::ReadBody("scans/p002_scan.ply"), {});
  const Result<BodyAnalysis> ase = AnalyseScan(testing::ReadBody("scans/p002_scan.ase.zst"), {});
  ASSERT_TRUE(ply.ok() && ase.ok()) << ase.status().ToString();
  EXPECT_EQ(ase->frame.up, "+z");
  EXPECT_EQ(ase->frame.facing, "-y");
  EXPECT_EQ(ase->frame.unit, "cm");
  for (const Limit& limit : kLandmarkLimits) {
    const std::string name = limit.name == std::string("crotch height") ? "crotch" : limit.name;
    const BodyLandmark landmark = *LandmarkFromName(name);
    const Eigen::Vector3d in_ply = ply->canonical_from_file.Inverse() * ply->body.landmarks[landmark].position;
    const Eigen::Vector3d in_ase = ase->canonical_from_file.Inverse() * ase->body.landmarks[landmark].position;
    EXPECT_LT((Eigen::Vector3d(in_ase.x(), in_ase.z(), -in_ase.y()) - in_ply).norm(), 0.5) << name;
  }
}

}  // namespace
}  // namespace fitroom
