#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/base/executor.h"
#include "common/base/status.h"
#include "common/body/body.h"
#include "fit_client/fit/cloth_mesh.h"
#include "fit_client/fit/paper/paper_drape.h"

namespace fitroom::paper {

// Returns the shoulder-sleeve points e1 ... e8 of both panels that lie over the shoulder at `positions`, inside the
// acromions; the others belong to the arm and do not touch.
std::vector<int> ShoulderVertices(const ClothMesh& cloth, const Body& body, std::span<const Eigen::Vector3d> positions);

// Finds what a run has to know of a bottom of two panels, from its named points: the top edge e1 - e3 of both panels,
// the outseams e1 - e2 and e3 - e4 of the front, and the crotch with the body's for its goal. A skirt has no crotch:
// its front waist centre goes to the body's front waist. NOT_FOUND (POINT_MISSING), INVALID_ARGUMENT (PANEL_OUTLINE) or
// FAILED_PRECONDITION (LANDMARK_MISSING) where a point is missing.
Result<PaperBottom> FindPaperBottom(const ClothMesh& cloth, const Body& body);

// A garment put on as printed, at the moments that the method's figures show. Positions, one a vertex (unit: metre).
struct DressedAsPrinted {
  std::vector<Eigen::Vector3d> start;
  std::vector<Eigen::Vector3d> merging;    // Half way to being sewn.
  std::vector<Eigen::Vector3d> stitched;   // Sewn, or as far as it came.
  std::vector<Eigen::Vector3d> pulled_up;  // Bottoms: on their belt. Empty for tops.
  std::vector<Eigen::Vector3d> final;
  DrapeReport report;
  PaperReport paper;
};

// Puts a garment on `collider`, the body without holes, from `start` (one position a vertex, canonical frame), a top or
// a bottom as its named points say. `progress` gets the stage and the steps so far, and may be empty. Fails like
// FindPaperBottom() and PaperDrape().
Result<DressedAsPrinted> DressAsPrinted(const ClothMesh& cloth, const Body& body, const TriangleMesh& collider,
                                        std::span<const Eigen::Vector3d> start, const PaperOptions& options,
                                        Executor& executor,
                                        const std::function<void(PaperStage stage, int step)>& progress);

}  // namespace fitroom::paper
