#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "common/base/status.h"
#include "common/body/body.h"
#include "common/body/body_frame.h"
#include "common/codec/hash.h"

namespace fitroom::body_center {

// A scan file that is fit to be stored: read, checked, turned into the canonical frame, measured and packed.
struct AcceptedScan {
  FrameReport frame;
  Body body;
  std::string packed_mesh;  // common/codec; the body's mesh.
  Hash256 packed_mesh_hash;
};

// Accepts or refuses the bytes of a scan file. `file_name` is for messages; `is_cancelled` is polled between the steps.
// INVALID_ARGUMENT with the place and a remedy for bytes that are not a scan of one body; CANCELLED.
using ScanAcceptor =
    std::function<Result<AcceptedScan>(std::string_view bytes, std::string_view file_name,
                                       const FrameOverrides& overrides, const std::function<bool()>& is_cancelled)>;

// The real acceptor.
Result<AcceptedScan> AcceptScan(std::string_view bytes, std::string_view file_name, const FrameOverrides& overrides,
                                const std::function<bool()>& is_cancelled);

}  // namespace fitroom::body_center
