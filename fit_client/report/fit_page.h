#pragma once

#include <span>
#include <string>

#include "fit_client/report/fit_report.h"

namespace fitroom {

// Returns a page (HTML 5, no script, nothing loaded from anywhere but the folder it lies in) with a fit's verdict,
// pictures, sizes and zones, one section a garment, the innermost first. Shows those pictures and links those files
// that the last report's `files` name. Everything that comes from outside is escaped.
std::string WriteFitPage(std::span<const FitReport> garments);

}  // namespace fitroom
