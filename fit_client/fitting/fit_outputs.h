#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/progress.h"
#include "common/base/status.h"
#include "fit_client/fitting/fit_inputs.h"
#include "fit_client/fitting/fit_outfit.h"
#include "fit_client/fitting/stopwatch.h"
#include "fit_client/report/fit_report.h"

namespace fitroom {

struct FitOutputOptions {
  bool pictures = true;  // PNGs of the views and the stages.
  bool glb = true;       // A 3D model for any viewer.
  bool maps = false;     // Strain, pressure and gap on the outermost garment.
  bool film = false;     // An animated WebP of the outermost garment's dressing.
  bool meshes = false;   // Garment, rest panels, body and seams as OBJ and text, to be measured by other programs.
  int thread_count = 1;
  std::vector<OutputFile> written_before;  // Of the same fit, such as the sheet of sizes: the reports list them too.
};

// Draws and writes everything a fit shows into `folder`, which is made where it is missing: pictures, stage pictures,
// fitted.glb, report.json and report.txt. Times, memory and the list of files are filled into the reports first.
// Fails like DrawFitPictures() and WriteFileAtomically(); files already written stay.
Status WriteFitOutputs(const std::filesystem::path& folder, const BodyInput& body, Outfit& outfit,
                       const FitOutputOptions& options, Stopwatch& stopwatch, const ProgressSink& progress);

// Draws all sizes side by side into `folder`/sizes.png, the recommended one framed, and returns what it wrote. Fails
// like DrawSizeSheet().
Result<OutputFile> WriteSizeSheet(const std::filesystem::path& folder, const std::vector<Outfit>& sizes,
                                  int thread_count);

// Returns the reports of all garments as one text for people, the innermost first.
std::string OutfitText(const Outfit& outfit);
// Returns the report for programs: that of the one garment, or {"garments": [...]}, the innermost first.
std::string OutfitJson(const Outfit& outfit);

}  // namespace fitroom
