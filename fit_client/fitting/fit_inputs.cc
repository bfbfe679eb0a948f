#include "fit_client/fitting/fit_inputs.h"

#include <utility>

#include "common/body/analyse_scan.h"
#include "common/garment/garment_folder.h"
#include "common/scan_file/scan_file.h"

namespace fitroom {

Result<BodyInput> LoadScan(const std::filesystem::path& file, const FrameOverrides& overrides) {
  BodyInput input;
  input.name = file.filename().string();
  FR_ASSIGN_OR_RETURN(const RawScan scan, ReadScanFile(file));
  Result<BodyAnalysis> analysis = AnalyseScan(scan.mesh, overrides);
  if (!analysis.ok()) return analysis.status().At(file.string());
  input.body = std::move(analysis->body);
  input.notes = std::move(analysis->frame.reasons);
  return input;
}

Result<GarmentInput> LoadGarment(const std::filesystem::path& folder) {
  GarmentInput input;
  FR_ASSIGN_OR_RETURN(input.garment, ReadGarmentFolder(folder));
  FR_ASSIGN_OR_RETURN(input.front_texture, ReadGarmentTexture(folder, input.garment.front));
  if (input.garment.back) {
    FR_ASSIGN_OR_RETURN(input.back_texture, ReadGarmentTexture(folder, *input.garment.back));
  }
  return input;
}

}  // namespace fitroom
