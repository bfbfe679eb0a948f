#pragma once

#include "common/base/status.h"
#include "fit_client/fit/solver/cloth_model.h"
#include "fit_client/fit/solver/cloth_solver.h"
#include "fit_client/fit/solver/drape_run.h"

namespace fitroom {

// One welded garment on its way up the body and to its belt. Refers to all of them.
struct WeldedCloth {
  DrapeRun& run;
  const ClothModel& model;
  ClothSolver& solver;
  ClothState& state;
};

// Moves the garment up without gravity, by the drag of an upward wind at its waist, until the crotch has touched the
// body and the cloth above it is taut, the waist is where it belongs, or nothing rises any more. Fails with INTERNAL
// where the state stops being finite.
Status PullUp(const PullUpOptions& pull, const WeldedCloth& cloth);

// Asks the options where the waist is to be held, and keeps it as the run's belt: vertices of the mesh.
// INVALID_ARGUMENT (VERTEX_OUT_OF_RANGE) for a vertex that does not exist; fails like the options' `attach`.
Status AskForBelt(DrapeRun& run);

// Attaches the run's belt, as wide open as its seams; returns the longest way to a target (unit: metre).
double HoldBelt(const WeldedCloth& cloth);

// Asks for the belt, carries the waist to its place on it and lets the cloth below follow, without gravity.
// Fails like AskForBelt(), and with INTERNAL where the state stops being finite.
Status CarryToBelt(const WeldedCloth& cloth);

}  // namespace fitroom
