#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/body/body.h"
#include "common/body/plane_section.h"

namespace fitroom {

// Tape girths of a body at places that its own measurements do not hold: the perimeter of the convex hull of a plane
// section. Refers to the body, which must outlive it and stay unchanged. Safe to read from several threads.
//
// Every function returns nothing where the scan lacks the landmark, or where the section is open by more than a tenth
// of itself.
class TapeGirths {
 public:
  explicit TapeGirths(const Body& body);

  // Round the trunk at a height, arms left out; below the crotch round both legs together (unit: metre).
  std::optional<double> TrunkAt(double height) const;
  // The outlines that TrunkAt() measures, as (x, z); none where the body does not reach. `of`: instead of the body's
  // own mesh one that is worn on it, for example the closed surface of a garment.
  std::vector<Eigen::Vector2d> TrunkOutlineAt(double height) const;
  std::vector<Eigen::Vector2d> TrunkOutlineAt(double height, const HeightIndex& of) const;
  // The same in a plane that may be tilted, in its coordinates.
  std::vector<Eigen::Vector2d> TrunkOutlineIn(const SectionPlane& plane) const;
  std::vector<Eigen::Vector2d> TrunkOutlineIn(const SectionPlane& plane, const HeightIndex& of) const;
  // Round one leg, or the mean of both, at a height below the crotch.
  std::optional<double> LegAt(double height) const;
  // Half way between hip joint and knee at most, just below the crotch: where trousers' thighs are measured.
  std::optional<GirthMeasurement> Thigh() const;
  std::optional<GirthMeasurement> Knee() const;
  // Square to the upper arm, `below_armpit` along it (unit: metre); the mean of both arms, or the one that was found.
  std::optional<GirthMeasurement> UpperArm(double below_armpit) const;
  // The straight way between the acromions (unit: metre).
  std::optional<double> ShoulderBreadth() const;

 private:
  // One trunk, or both legs.
  std::vector<SectionLoop> TrunkLoopsAt(double height, const HeightIndex& of) const;
  // Of outlines in a plane at about this height those of the trunk or the legs, without the arms.
  std::vector<SectionLoop> OfTrunk(std::vector<SectionLoop> loops, const SectionPlane& plane) const;
  std::optional<double> LimbGirth(const Eigen::Vector3d& centre, const Eigen::Vector3d& direction, double reach) const;

  const Body& body_;
  HeightIndex index_;
};

}  // namespace fitroom
