#pragma once

#include <map>
#include <string>

#include <Eigen/Core>

#include "fit_client/fit/grading/grade_measures.h"
#include "fit_client/fit/panels/pattern.h"

namespace fitroom::grading {

// How far the cardinal points of a pattern move when it is graded (unit: metre). Points that are not named follow their
// neighbours along the outline.
struct GradeMoves {
  std::map<std::string, Eigen::Vector2d> shared;      // On both panels.
  std::map<std::string, Eigen::Vector2d> front_only;  // Necks, waists and hems may differ.
  std::map<std::string, Eigen::Vector2d> back_only;
};

// What is to be added to each measure, by name (unit: metre); "crotch_depth" stands for what a bottom's rise adds
// between waist and crotch.
using Increments = MeasureMap;

// Turns increments into moves of the cardinal points: the grade rules of the kind.
GradeMoves MovesFor(const GarmentPattern& pattern, const MeasureMap& measures, const Increments& increments);

// Moves a pattern's outlines. Between the named points the displacement is interpolated along each section by monotone
// cubics (Fritsch and Carlson, "Monotone piecewise cubic interpolation", 1980) over the samples' numbers, so that the
// opposite moves undo it. Pixels stay with their points; equal points of front and back move equally, to the bit, and
// what mirrors itself goes on doing so.
GarmentPattern ApplyMoves(const GarmentPattern& pattern, const GradeMoves& moves);

}  // namespace fitroom::grading
