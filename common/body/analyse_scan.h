#pragma once

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/body/body_frame.h"
#include "common/body/scan_cleaning.h"

namespace fitroom {

// A raw scan understood: the body in its canonical frame, and how that frame lies in the file.
struct BodyAnalysis {
  Body body;
  FrameReport frame;
  Similarity canonical_from_file;
  CleaningCounts cleaning;
};

// Turns a raw scan, in the file's own frame and unit, into a body ready to be measured and dressed: cleans it, finds
// its frame, its landmarks, its limbs' axes and its girths. Deterministic, on the calling thread only. Fails with the
// errors of CleanScan() and DetectFrame(), and with LANDMARKS_NOT_FOUND where a landmark that dressing cannot do
// without (front neck, acromions, armpits, crotch) is missing; the message names it.
Result<BodyAnalysis> AnalyseScan(const TriangleMesh& raw, const FrameOverrides& overrides);

}  // namespace fitroom
